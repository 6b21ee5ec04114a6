//! The specification as a test: its console examples run, its clauses are cited, its citations
//! exist. The Rust examples run as documentation tests (`mod spec` in `src/lib.rs`).
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::bits::Rounding;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A fenced block of a specification file.
struct Block {
    place: String,
    kind: String,
    clause: Option<String>,
    text: String,
}

/// A clause heading, `### G-2 Clamp modes`.
struct Clause {
    id: String,
    title: String,
    place: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn read_spec() -> (Vec<Clause>, Vec<Block>) {
    let (mut clauses, mut blocks) = (Vec::<Clause>::new(), Vec::new());
    for path in files("spec", "md") {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let mut open: Option<Block> = None;
        let first = clauses.len();
        for (n, line) in std::fs::read_to_string(&path).unwrap().lines().enumerate() {
            let place = format!("spec/{name}:{}", n + 1);
            assert!(!line.starts_with("    ") || open.is_some(), "{place}: an indented code block");
            if let Some(fence) = line.strip_prefix("```") {
                if let Some(block) = open.take() {
                    blocks.push(block);
                } else {
                    let clause = clauses[first..].last().map(|clause| clause.id.clone());
                    let kind = fence.to_owned();
                    open = Some(Block { place, kind, clause, text: String::new() });
                }
            } else if let Some(block) = &mut open {
                block.text += line;
                block.text.push('\n');
            } else if let Some(heading) = line.strip_prefix("### ") {
                let (id, title) = heading.split_once(' ').unwrap_or((heading, ""));
                clauses.push(Clause { id: id.to_owned(), title: title.to_owned(), place });
            }
        }
        assert!(open.is_none(), "spec/{name}: a fence is not closed");
    }
    (clauses, blocks)
}

fn is_clause(token: &str) -> bool {
    let mut parts = token.split('-');
    let letter = parts.next().unwrap_or_default();
    let number = parts.next().unwrap_or_default();
    (1..=2).contains(&letter.len())
        && letter.bytes().all(|b| b.is_ascii_uppercase())
        && !number.is_empty()
        && number.bytes().all(|b| b.is_ascii_digit())
        && parts.next().is_none()
}

/// Clause ids in backticks: how the sources and the specification itself cite.
fn in_backticks(text: &str) -> impl Iterator<Item = String> {
    text.lines().flat_map(|line| {
        let quoted: Vec<String> = line.split('`').skip(1).step_by(2).map(str::to_owned).collect();
        let mut all: Vec<String> = quoted.into_iter().filter(|q| is_clause(q)).collect();
        // `G-1` to `G-6` names those between as well.
        if let (true, [first, last]) = (line.contains("` to `"), &all.clone()[..])
            && let (Some((letter, first)), Some((other, last))) =
                (first.split_once('-'), last.split_once('-'))
            && letter == other
        {
            let [first, last] = [first, last].map(|number| number.parse::<u32>().unwrap());
            all.extend((first..last).map(|n| format!("{letter}-{n}")));
        }
        all
    })
}

/// Clause ids after the word "Clause" or "Clauses" in a comment: how the tests cite.
fn in_comments(text: &str) -> impl Iterator<Item = String> {
    text.lines().flat_map(|line| {
        let comment = line.split_once("//").map_or("", |(_, comment)| comment);
        let list = comment.split_once("Clause").map_or("", |(_, list)| list);
        let tokens = list.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'));
        tokens.filter(|token| is_clause(token)).map(str::to_owned).collect::<Vec<_>>()
    })
}

fn citations() -> BTreeMap<String, Vec<String>> {
    let mut cited = BTreeMap::<String, Vec<String>>::new();
    let mut add = |path: &Path, ids: Vec<String>| {
        let place = path.strip_prefix(root()).unwrap().display().to_string();
        for id in ids {
            cited.entry(id).or_default().push(place.clone());
        }
    };
    for path in files("src", "rs") {
        add(&path, in_backticks(&std::fs::read_to_string(&path).unwrap()).collect());
    }
    for path in files("spec", "md") {
        add(&path, in_backticks(&std::fs::read_to_string(&path).unwrap()).collect());
    }
    for path in files("tests", "rs") {
        add(&path, in_comments(&std::fs::read_to_string(&path).unwrap()).collect());
    }
    cited
}

#[test]
fn clauses_are_numbered_once_and_in_order() {
    let (clauses, _) = read_spec();
    assert!(clauses.len() > 40, "the specification was read");
    let mut last = BTreeMap::new();
    for Clause { id, title, place } in &clauses {
        assert!(is_clause(id) && !title.is_empty(), "{place}: {id} {title}");
        let (letter, number) = id.split_once('-').unwrap();
        let number: u32 = number.parse().unwrap();
        let before = last.insert(letter.to_owned(), number).unwrap_or(0);
        assert_eq!(number, before + 1, "{place}: {id} follows {letter}-{before}");
    }
}

#[test]
fn every_citation_has_a_clause() {
    let (clauses, _) = read_spec();
    let known: BTreeSet<&str> = clauses.iter().map(|clause| clause.id.as_str()).collect();
    let cited = citations();
    assert!(cited.len() > 40, "the citations were found");
    let lost: Vec<_> = cited.into_iter().filter(|(id, _)| !known.contains(id.as_str())).collect();
    assert!(lost.is_empty(), "cited, but not in spec/: {lost:?}");
}

#[test]
fn every_clause_is_tested() {
    let (clauses, blocks) = read_spec();
    let cited = citations();
    let untested: Vec<_> = clauses
        .iter()
        .filter(|clause| {
            let example = blocks.iter().any(|b| b.clause.as_ref() == Some(&clause.id));
            let test = cited
                .get(&clause.id)
                .is_some_and(|places| places.iter().any(|place| place.starts_with("tests")));
            !example && !test
        })
        .map(|clause| format!("{}: {} {}", clause.place, clause.id, clause.title))
        .collect();
    assert!(untested.is_empty(), "neither an example nor a test: {untested:#?}");
}

#[test]
fn every_block_is_run() {
    let library = std::fs::read_to_string(root().join("src/lib.rs")).unwrap();
    for block in read_spec().1 {
        assert!(["rust", "console"].contains(&&*block.kind), "{}: ```{}", block.place, block.kind);
        let file = block.place["spec/".len()..].split(':').next().unwrap();
        assert!(
            block.kind != "rust" || library.contains(&format!("\"{file}\"")),
            "{}: {file} is not in `mod spec` of src/lib.rs, so its examples do not run",
            block.place
        );
    }
}

/// Runs one example: `$ guardbit ...`, its standard input as `< ...`, then its standard output.
fn run_example(block: &Block) {
    let place = &block.place;
    let mut commands = Vec::new();
    for line in block.text.lines() {
        if let Some(command) = line.strip_prefix("$ ") {
            let words: Vec<&str> = command.split_whitespace().collect();
            assert_eq!(words[0], "guardbit", "{place}: {command}");
            commands.push((words[1..].to_vec(), String::new(), String::new()));
        } else {
            let (_, input, output) = commands.last_mut().expect(place);
            let (text, line) = line.strip_prefix("< ").map_or((output, line), |line| (input, line));
            *text += line;
            text.push('\n');
        }
    }
    assert!(!commands.is_empty(), "{place}: no command");
    for (words, input, expected) in commands {
        let mut child = Command::new(env!("CARGO_BIN_EXE_guardbit"))
            .args(&words)
            .current_dir(root())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        let output = child.wait_with_output().unwrap();
        let [stdout, stderr] =
            [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
        assert_eq!(stdout, expected, "{place}: {words:?}\n{stderr}");
        // An example that shows an error answer ends with status 2, any other with 0.
        let status = if expected.contains("\"error\":") { 2 } else { 0 };
        assert_eq!(output.status.code(), Some(status), "{place}: {words:?}\n{stderr}");
    }
}

#[test]
fn console_examples_hold() {
    let blocks = read_spec().1;
    let mut run = 0;
    for block in blocks.iter().filter(|block| block.kind == "console") {
        run_example(block);
        run += 1;
    }
    assert!(run >= 5, "console examples were found: {run}");
}

/// Clause R-1: the table has a row for each rounding, in the order of the code's table.
#[test]
fn the_table_of_roundings_is_the_codes() {
    let text = std::fs::read_to_string(root().join("spec/01-words.md")).unwrap();
    let (_, after) = text.split_once("### R-1").unwrap();
    let (clause, _) = after.split_once("### R-2").unwrap();
    let rows: Vec<&str> = clause
        .lines()
        .filter_map(|line| line.strip_prefix("| `"))
        .filter_map(|row| row.split('`').next())
        .collect();
    assert_eq!(rows, Rounding::ALL.map(|rounding| rounding.names().guardbit));
}
