//! The staircase of rooms, the denied tokens and the shape of files, read from the sources.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The rooms of `src`, ground floor first; each imports only from those before it.
const ROOMS: [&str; 15] = [
    "bits", "format", "exact", "dda", "setup", "cover", "value", "machine", "profile", "scene",
    "model", "case", "measure", "vector", "explore",
];

/// Rooms where bits are decided: no floating point but in the one file that reads it.
const NO_FLOATS: [&str; 7] = ["bits", "dda", "setup", "cover", "value", "machine", "exact"];
const FLOATS_ALLOWED: [&str; 4] = [
    "src/setup/snap.rs",
    "src/setup/viewport.rs",
    "src/setup/viewport/transform.rs",
    "src/value/correct/quotient.rs",
];

struct Source {
    /// From the root, with forward slashes.
    path: String,
    /// The room, `cli` and `main` included.
    room: String,
    /// Code alone: comments, strings and unit tests are gone.
    code: String,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut folders, mut found) = (vec![root.join("src")], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path: PathBuf = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let parts: Vec<String> = path
                    .strip_prefix(root)
                    .unwrap()
                    .iter()
                    .map(|part| part.to_string_lossy().into_owned())
                    .collect();
                let room = parts[1].trim_end_matches(".rs").to_owned();
                // Files of unit tests, `x/tests.rs`, are no code of a room.
                if parts.last().unwrap() != "tests.rs" {
                    let text = std::fs::read_to_string(&path).unwrap();
                    found.push(Source { path: parts.join("/"), room, code: code(&text) });
                }
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(found.len() > 40, "the sources were found");
    found
}

/// Drops comments, strings, and what follows `#[cfg(test)]` or `#[cfg(doctest)]` at the margin.
fn code(text: &str) -> String {
    let text = text.split("\n#[cfg(test)]").next().unwrap();
    let text = text.split("\n#[cfg(doctest)]").next().unwrap();
    let bytes = text.as_bytes();
    let (mut out, mut at) = (String::new(), 0);
    while at < bytes.len() {
        let rest = &text[at..];
        let skip = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(raw) = raw_string(rest) {
            raw
        } else if rest.starts_with("'\"'") {
            3
        } else if rest.starts_with("b'\"'") {
            4
        } else if rest.starts_with('"') {
            plain_string(rest)
        } else {
            let c = rest.chars().next().unwrap();
            out.push(c);
            at += c.len_utf8();
            continue;
        };
        // Lines stay lines, so that they can be counted.
        out.extend(rest[..skip].chars().filter(|c| *c == '\n'));
        at += skip;
    }
    out
}

/// The length of a `"..."` at the start of a text.
fn plain_string(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !escaped => return at + 1,
            _ => escaped = c == '\\' && !escaped,
        }
    }
    text.len()
}

/// The length of an `r#"..."#` at the start of a text.
fn raw_string(text: &str) -> Option<usize> {
    let hashes = text.strip_prefix('r')?;
    let count = hashes.len() - hashes.trim_start_matches('#').len();
    hashes[count..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(count));
    let open = 2 + count;
    Some(text[open..].find(&end).map_or(text.len(), |at| open + at + end.len()))
}

/// Identifiers and `::` of the code, in order.
fn tokens(code: &str) -> Vec<&str> {
    let (mut tokens, mut rest) = (Vec::new(), code);
    while let Some(c) = rest.chars().next() {
        let word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if word(c) {
            rest.find(|c| !word(c)).unwrap_or(rest.len())
        } else if rest.starts_with("::") {
            2
        } else {
            c.len_utf8()
        };
        if !c.is_whitespace() {
            tokens.push(&rest[..length]);
        }
        rest = &rest[length..];
    }
    tokens
}

/// The rooms that follow `root::` in the code, groups `root::{a, b::c}` included.
fn imports<'a>(tokens: &[&'a str], root: &str) -> BTreeSet<&'a str> {
    let mut rooms = BTreeSet::new();
    for (n, window) in tokens.windows(3).enumerate() {
        if window[0] != root || window[1] != "::" {
            continue;
        }
        if window[2] != "{" {
            rooms.insert(window[2]);
            continue;
        }
        let mut depth = 0;
        for (m, token) in tokens[n + 2..].iter().enumerate() {
            match *token {
                "{" => depth += 1,
                "}" => depth -= 1,
                name if depth == 1 && ["{", ","].contains(&tokens[n + 1 + m]) => {
                    rooms.insert(name);
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
    }
    rooms
}

fn floor(room: &str) -> Option<usize> {
    ROOMS.iter().position(|known| *known == room)
}

#[test]
fn the_reader_sees_what_it_should() {
    let code = code(
        "use a::b; // crate::x\n/* f64 */ let s = \"crate::y \\\" f64\"; r#\"crate::\"z\"#; '\"'; crate::{c, d::{e, f}, g};\n#[cfg(test)]\nmod t { crate::h }",
    );
    assert_eq!(code.matches('\n').count(), 1);
    assert!(!code.contains("f64"), "{code}");
    let imports = imports(&tokens(&code), "crate");
    assert_eq!(imports.into_iter().collect::<Vec<_>>(), ["c", "d", "g"]);
}

#[test]
fn the_list_of_rooms_is_the_library() {
    let sources = sources();
    let library = &sources.iter().find(|source| source.path == "src/lib.rs").unwrap().code;
    let tokens = tokens(library);
    let modules: BTreeSet<&str> =
        tokens.windows(3).filter(|w| w[0] == "pub" && w[1] == "mod").map(|w| w[2]).collect();
    let files: BTreeSet<&str> = sources
        .iter()
        .map(|source| source.room.as_str())
        .filter(|room| !["lib", "main"].contains(room))
        .collect();
    assert_eq!(modules, files, "lib.rs and the files of src");
    let unknown: Vec<_> =
        modules.iter().filter(|room| floor(room).is_none() && **room != "cli").collect();
    assert!(unknown.is_empty(), "not in the list of this test: {unknown:?}");
}

#[test]
fn rooms_import_only_from_below() {
    let mut climbs = Vec::new();
    for source in sources() {
        let Some(own) = floor(&source.room) else { continue };
        for room in imports(&tokens(&source.code), "crate") {
            match floor(room) {
                None => climbs.push(format!("{}: crate::{room} is no room", source.path)),
                Some(other) if other > own => {
                    climbs
                        .push(format!("{}: crate::{room} lies above {}", source.path, source.room));
                }
                // Both are top floors, and neither knows of the other.
                Some(_) if source.room == "explore" && room == "vector" => {
                    climbs.push(format!("{}: explore imports vector", source.path));
                }
                Some(_) => {}
            }
        }
    }
    assert!(climbs.is_empty(), "{climbs:#?}");
}

#[test]
fn the_command_sees_only_the_public_library() {
    for source in sources().iter().filter(|s| ["main", "cli"].contains(&s.room.as_str())) {
        let tokens = tokens(&source.code);
        let inner = imports(&tokens, "crate");
        assert!(inner.iter().all(|name| *name == "cli"), "{}: {inner:?}", source.path);
        let rooms = imports(&tokens, "guardbit");
        let above = |room: &str| source.room == "main" && room == "cli";
        let unknown: Vec<_> =
            rooms.iter().filter(|room| floor(room).is_none() && !above(room)).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", source.path);
    }
}

#[test]
fn nobody_climbs_two_stairs_or_hides_in_mod_rs() {
    for source in sources() {
        let tokens = tokens(&source.code);
        let climbs = tokens.windows(3).any(|w| w == ["super", "::", "super"]);
        assert!(!climbs, "{}: super::super", source.path);
        assert!(!source.path.ends_with("mod.rs"), "{}", source.path);
    }
}

/// A bench makes stimulus and a reference answers it: neither knows what a suspect does wrong. All that
/// a bench says of suspects is that there are some.
#[test]
fn benches_and_the_reference_know_no_defect() {
    let mut seen = 0;
    for source in sources() {
        let within = |folder: &str| {
            let path = source.path.trim_end_matches(".rs");
            path == folder || path.starts_with(&format!("{folder}/"))
        };
        if !within("src/vector/bench") && !within("src/vector/device") {
            continue;
        }
        seen += 1;
        let tokens = tokens(&source.code);
        for word in ["quirk", "slip", "defect", "Quirk", "Slip", "Suspect"] {
            assert!(!tokens.contains(&word), "{}: {word}", source.path);
        }
        let used = tokens.windows(3).filter(|w| w[..2] == ["suspect", "::"]);
        for window in used {
            assert_eq!(window[2], "Suspects", "{}", source.path);
            assert_eq!(source.path, "src/vector/bench.rs", "no single bench names suspects");
        }
    }
    assert!(seen > 10, "{seen} files of benches and of the reference");
}

#[test]
fn no_floating_point_where_a_bit_is_decided() {
    let mut seen_where_allowed = BTreeSet::new();
    for source in sources().iter().filter(|s| NO_FLOATS.contains(&s.room.as_str())) {
        let floats = tokens(&source.code).iter().filter(|t| ["f32", "f64"].contains(t)).count();
        if floats > 0 {
            let allowed = FLOATS_ALLOWED.contains(&source.path.as_str());
            assert!(allowed, "{}: f32 or f64", source.path);
            seen_where_allowed.insert(source.path.clone());
        }
    }
    assert_eq!(seen_where_allowed.len(), FLOATS_ALLOWED.len(), "an exception is no longer needed");
}

#[test]
fn files_stay_readable() {
    for source in sources() {
        let lines = source.code.lines().filter(|line| !line.trim().is_empty()).count();
        assert!(lines <= 300, "{}: {lines} lines of code, 300 at most", source.path);
    }
}

/// The machines and the engines behind registers, as `src/machine` lists them: the variants of the list and
/// the modules they live in.
fn listed(path: &str, head: &str) -> Vec<(String, Option<String>)> {
    let list = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let block = list.split(&format!("\n{head}! {{\n")).nth(1).unwrap().split("\n}").next().unwrap();
    let lines = block.lines().map(str::trim).filter(|line| line.ends_with(';'));
    let lines = lines.map(|line| {
        let module =
            line.split(" in ").nth(1).map(|module| module.trim_end_matches(';').to_owned());
        (line.split('(').next().unwrap().to_owned(), module)
    });
    lines.collect()
}

/// Where code tells machines apart: a variant of a list, or the name of a machine as a pattern.
fn told_apart(code: &str, raw: &str, names: &[String]) -> Vec<String> {
    let tokens = tokens(code);
    let lists =
        tokens.windows(3).filter(|w| ["Form", "EngineConfig"].contains(&w[0]) && w[1] == "::");
    let variants =
        lists.filter(|w| w[2].starts_with(|c: char| c.is_uppercase() || c == '{' || c == '*'));
    let mut found: Vec<String> = variants.map(<[&str]>::concat).collect();
    for name in names {
        for pattern in [format!("\"{name}\" =>"), format!("\"{name}\" |"), format!("== \"{name}\"")]
        {
            found.extend(raw.contains(&pattern).then_some(pattern));
        }
    }
    found
}

#[test]
fn machines_are_told_apart_in_their_room_alone() {
    let machines = listed("src/machine.rs", "list::machines");
    let engines = listed("src/machine/register/engine.rs", "engines");
    assert!(machines.len() >= 9 && engines.len() >= 4, "the lists were read");
    let names: Vec<String> = guardbit::machine::kinds().map(|kind| kind.name.to_owned()).collect();
    // The reader sees what would come back.
    let old = "match profile.form { Form::Scanline(_) => 1, _ => 2 }; use Form::{Tiles};";
    assert_eq!(told_apart(old, old, &names), ["Form::Scanline", "Form::{"]);
    assert_eq!(told_apart("", "(\"tiles\" => 1)", &names), ["\"tiles\" =>"]);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for source in sources().iter().filter(|source| source.room != "machine") {
        let raw = std::fs::read_to_string(root.join(&source.path)).unwrap();
        let raw = raw.split("\n#[cfg(test)]").next().unwrap();
        let found = told_apart(&source.code, raw, &names);
        assert!(found.is_empty(), "{}: {found:?}: ask `machine::Rasterizer`", source.path);
    }
}

/// A machine is a folder: what it draws beside what a profile, a budget and a search ask of it.
#[test]
fn every_machine_has_a_folder() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/machine");
    for (variant, module) in listed("src/machine.rs", "list::machines") {
        let module = module.unwrap();
        let folder = root.join(&module);
        assert!(folder.with_extension("rs").is_file(), "{variant}: {module}.rs");
        assert!(folder.join("form.rs").is_file(), "{variant}: {module}/form.rs");
    }
    let engines = listed("src/machine/register/engine.rs", "engines");
    let folders = std::fs::read_dir(root.join("register")).unwrap();
    let folders = folders.filter(|entry| entry.as_ref().unwrap().path().join("form.rs").is_file());
    assert_eq!(folders.count(), engines.len());
}
