//! The walks of the README, as they are printed.
#![cfg(feature = "cli")]

use crate::command::home;
use crate::run::run_in;
use std::path::Path;

/// The fenced blocks of one kind in a section of the README.
fn readme_blocks(section: &str, kind: &str) -> Vec<String> {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let text = std::fs::read_to_string(readme).unwrap();
    let section = text.split("\n## ").find(|part| part.starts_with(section)).unwrap();
    let open = format!("```{kind}\n");
    section.split(&open).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

#[cfg(unix)]
#[test]
fn the_readmes_walk_works_as_printed() {
    let home = home();
    // The README's first command; its walk stands on what that wrote.
    run_in(home.path(), "vectors").ends(0);
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut verdicts = Vec::new();
    let blocks = readme_blocks("Five minutes", "sh");
    for line in blocks.iter().flat_map(|block| block.lines()) {
        let mut shell = std::process::Command::new("sh");
        let ran = shell.args(["-c", line]).current_dir(home.path()).env("PATH", &path).output();
        let ran = ran.unwrap();
        let is_verify = line.starts_with("guardbit verify");
        assert_eq!(ran.status.code(), Some(i32::from(is_verify)), "{line}: {ran:?}");
        if is_verify {
            verdicts.push(String::from_utf8(ran.stdout).unwrap());
        }
    }
    assert_eq!(verdicts, readme_blocks("Five minutes", "text"));
    for made in ["walk.vcd", "walk.fst"] {
        assert!(home.path().join(made).metadata().unwrap().len() > 0, "{made}");
    }
    // And the example under the table of commands.
    let example = readme_blocks("Commands", "console").concat();
    let (command, answer) = example.trim().split_once('\n').unwrap();
    let line = command.strip_prefix("$ ").unwrap();
    let ran = std::process::Command::new("sh").args(["-c", line]).env("PATH", &path).output();
    assert_eq!(String::from_utf8(ran.unwrap().stdout).unwrap().trim(), answer);
}

/// A small mesh to stand in for the reader's own: a bent strip, in the form of an OBJ file.
fn strip() -> String {
    let vertex = |n: i32| {
        let (along, side) = (n / 2, n % 2);
        format!("v {along} {} {}\n", side * 3, along * along % 7)
    };
    let face = |n: i32| format!("f {} {} {}\n", n, n + 1, n + 2);
    (0..24).map(vertex).chain((1..=22).map(face)).collect()
}

#[cfg(unix)]
#[test]
fn the_readmes_search_works_as_printed() {
    let home = home();
    std::fs::write(home.path().join("bunny.obj"), strip()).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let section = "How few bits are enough?";
    let commands = readme_blocks(section, "sh").concat().replace("\\\n", " ");
    let mut outputs = Vec::new();
    for line in commands.lines() {
        let mut shell = std::process::Command::new("sh");
        let ran = shell.args(["-c", line]).current_dir(home.path()).env("PATH", &path).output();
        let ran = ran.unwrap();
        assert_eq!(ran.status.code(), Some(0), "{line}: {ran:?}");
        outputs.push(String::from_utf8(ran.stdout).unwrap());
    }
    assert_eq!(outputs.len(), 6);
    for made in ["bunny.html", "bunny.svg", "bunny.toml", "sgi-4k.smt2", "sgi-4k.g"] {
        assert!(home.path().join(made).metadata().unwrap().len() > 0, "{made}");
    }
    // What is printed has the lines that the README shows, whatever the mesh.
    let shown = readme_blocks(section, "text").concat();
    let label = |line: &str| line.split_whitespace().next().unwrap_or("").to_owned();
    for line in shown.lines().filter(|line| !line.starts_with([' ', '.'])) {
        let there = outputs[1].lines().any(|printed| label(printed) == label(line));
        assert!(there, "{line}: {}", outputs[1]);
    }
}
