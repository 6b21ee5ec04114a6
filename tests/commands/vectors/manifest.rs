//! What a set says of itself: manifest, columns, packages.

use super::{rule, zoo};
use crate::device::Reader;
use crate::set;
use crate::set::{options, profile, source, tree, write_set};
use guardbit::cover::{DepthAt, MultisampleConfig};
use guardbit::format::Role;
use guardbit::machine::triangle_machines;
use guardbit::profile::{Form, Profile, WindowConfig};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

// Clause N-3 and Clause N-8 and Clause N-9
#[test]
fn the_manifest_says_what_is_there() {
    for profile in zoo() {
        let set = write_set(&profile, "fan", &options(2600));
        let name = &profile.name;
        let text = set.text("manifest.json");
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["schema"], 3);
        assert_eq!(json["seed"], 1);
        assert_eq!(json["count"], 2600);
        let depth = profile.depth.unwrap();
        for (key, bits) in [
            ("guard", depth.guard),
            ("integer", depth.integer),
            ("interpolation", depth.interpolation),
        ] {
            assert_eq!(json["profile"]["depth"][key], bits, "{name}");
        }
        // Every file but the manifest itself, with its digest, length and rows.
        let files = json["files"].as_array().unwrap();
        let mut listed: Vec<String> =
            files.iter().map(|file| file["name"].as_str().unwrap().to_owned()).collect();
        listed.sort();
        let present: Vec<String> = tree(&set.folder()).into_iter().map(|(name, _)| name).collect();
        let present: Vec<String> =
            present.into_iter().filter(|name| name != "manifest.json").collect();
        assert_eq!(listed, present);
        for file in files {
            let file_name = file["name"].as_str().unwrap();
            let bytes = set.bytes(file_name);
            assert_eq!(file["bytes"], bytes.len(), "{file_name}");
            let lines = bytes.split(|byte| *byte == b'\n').count() - 1;
            assert_eq!(file["rows"], lines, "{file_name}");
            assert_eq!(file["sha256"], sha256(&bytes), "{file_name}");
            let columns = file["columns"].as_array().unwrap();
            assert_eq!(columns.is_empty(), file_name.strip_suffix(".tv").is_none(), "{file_name}");
            for column in columns {
                let meaning = column["meaning"].as_str().unwrap();
                assert!(meaning.ends_with('.') && meaning.len() > 3, "{file_name}: {meaning}");
            }
        }
        // Its own digest: with the digest emptied, the bytes hash to it.
        let digest = json["digest"].as_str().unwrap();
        let empty = text.replace(digest, "");
        assert_eq!(sha256(empty.as_bytes()), digest);
        assert!(text.ends_with(&format!("\"digest\": \"{digest}\"\n}}\n")));
        // Groups sum to the rows of the first expectation file, and to the configuration's tests.
        for (bench, cfg, exp) in [
            ("dda", "dda.cfg.tv", "dda.exp.tv"),
            ("edge", "edge.cfg.tv", "edge.exp.tv"),
            ("setup", "setup.cfg.tv", "setup.exp.tv"),
            ("triangle", "triangle.cfg.tv", "triangle.exp.tv"),
        ] {
            if !listed.iter().any(|name| name == exp) {
                continue;
            }
            let sum = |key: &str| -> u64 {
                let groups = json["groups"].as_array().unwrap().iter();
                groups.filter(|g| g["bench"] == bench).map(|g| g[key].as_u64().unwrap()).sum()
            };
            assert_eq!(sum("tests"), set.rows(cfg).len() as u64, "{name} {bench}");
            assert_eq!(sum("rows"), set.rows(exp).len() as u64, "{name} {bench}");
        }
        for group in json["groups"].as_array().unwrap() {
            assert!(group["catches"].as_str().unwrap().len() > 10, "{group}");
        }
        // Coverage counts each row once.
        let covered = |bench: &str| -> u64 {
            let entries = json["coverage"].as_array().unwrap();
            let entry = entries.iter().find(|entry| entry["bench"] == bench).unwrap();
            let cells = entry["cells"].as_array().unwrap().iter();
            // Octant, zone and remainder; the other cells are goals of the bench.
            let zones = [".inside.", ".above.", ".below."];
            let of_rows =
                cells.filter(|c| zones.iter().any(|z| c["cell"].as_str().unwrap().contains(z)));
            of_rows.map(|c| c["rows"].as_u64().unwrap()).sum()
        };
        assert_eq!(covered("dda"), 2600, "{name}");
        assert_eq!(covered("triangle"), set.rows("depth.exp.tv").len() as u64, "{name}");
    }
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |text, byte| format!("{text}{byte:02x}"))
}

#[test]
fn nothing_tells_where_or_when_a_set_was_made() {
    let [a, b] = [(); 2].map(|()| write_set(&profile("tiny"), "fan", &options(300)));
    assert_ne!(a.folder(), b.folder());
    assert!(tree(&a.folder()) == tree(&b.folder()));
    let folder = a.folder();
    let home = folder.parent().unwrap().to_str().unwrap();
    for (name, bytes) in tree(&folder) {
        let text = String::from_utf8(bytes).unwrap();
        assert!(!text.contains(home) && !text.contains(env!("CARGO_MANIFEST_DIR")), "{name}");
        if name == "manifest.json" {
            for key in ["time", "date", "host", "path", "user"] {
                assert!(!text.contains(&format!("\"{key}\"")), "{name}: {key}");
            }
        }
    }
}

// Clause N-2
#[test]
fn columns_are_named_and_wide_as_the_conventions_fix() {
    let fixed = [
        ("dda.cfg.tv", vec!["init", "dx", "dy"]),
        ("dda.exp.tv", vec!["op", "acc", "out"]),
        ("edge.cfg.tv", vec!["e0", "ea", "eb"]),
        ("edge.exp.tv", vec!["op", "e", "in"]),
        ("span.exp.tv", vec!["test", "y", "x_begin", "x_end"]),
        ("depth.exp.tv", vec!["test", "y", "x", "depth"]),
    ];
    for profile in zoo() {
        let set = write_set(&profile, "triangle", &options(300));
        let columns = |name: &str| {
            set.manifest.files.iter().find(|file| file.name == name).map(|file| &file.columns)
        };
        let width = |file: &str, name: &str| {
            let found = columns(file).unwrap().iter().find(|column| column.name == name);
            found.unwrap().width
        };
        for (file, names) in &fixed {
            let Some(columns) = columns(file) else {
                assert!(file.starts_with("edge") && rule(&profile).is_none(), "{file}");
                continue;
            };
            let found: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            assert_eq!(found, *names, "{file}");
        }
        let reader = Reader::of(&profile);
        for (file, name) in [("dda.cfg.tv", "init"), ("dda.cfg.tv", "dx"), ("dda.exp.tv", "acc")] {
            assert_eq!(width(file, name), reader.width(), "{} {name}", profile.name);
        }
        assert_eq!(width("dda.exp.tv", "out"), reader.integer);
        assert_eq!(width("dda.exp.tv", "op"), 2);
        if let Form::EdgeFunction(edges) = profile.form {
            for (file, name) in [("edge.cfg.tv", "e0"), ("edge.cfg.tv", "eb"), ("edge.exp.tv", "e")]
            {
                assert_eq!(width(file, name), edges.width);
            }
            assert_eq!(width("edge.exp.tv", "in"), 1);
        }
        // Golden rows: lower-case hexadecimal, padded to whole nibbles, within their widths.
        for file in set.manifest.files.iter().filter(|file| !file.columns.is_empty()) {
            let text = set.text(&file.name);
            assert!(text.is_empty() || text.ends_with('\n'), "{}", file.name);
            let rows = set.rows(&file.name);
            let widths: Vec<u32> = file.columns.iter().map(|column| column.width).collect();
            for (line, words) in text.lines().zip(&rows) {
                // Written again from its words, a row is the same: digits, case, padding, mask.
                assert_eq!(line, set::tv_line(words, &widths), "{} {}", profile.name, file.name);
            }
        }
    }
}

/// Machines, primitives and numbers of samples of every kind.
fn profiles_of_every_column() -> Vec<Profile> {
    let mut list: Vec<Profile> =
        guardbit::profile::BUILTIN.iter().map(|(n, _)| profile(n)).collect();
    let small = |name: &str| {
        let mut made = profile(name);
        made.window = WindowConfig { width: 64, height: 64 };
        made
    };
    for kind in triangle_machines() {
        list.push(small("sgi-4k").with_machine(kind.name).unwrap());
    }
    for depth in [DepthAt::Centre, DepthAt::Sample] {
        let multisample = Some(MultisampleConfig::standard(4, depth));
        list.push(Profile { multisample, ..small("sgi-4k") });
    }
    list
}

// Clause N-16
#[test]
fn every_column_has_a_role_and_comes_in_the_order_of_roles() {
    let mut used = BTreeSet::new();
    for profile in profiles_of_every_column() {
        let source = source(&profile, "triangle", 300);
        for bench in source.benches() {
            // Registers and records carry the names of the hardware's own manual.
            let words = bench.name() == "words";
            for spec in bench.files().into_iter().chain(bench.operand_file()) {
                let place = format!("{} {}", profile.name, spec.stem);
                let columns = spec.columns.iter().map(|column| column.name.as_str());
                let mut before = None;
                for name in columns.take(if words { 1 } else { usize::MAX }) {
                    let found = Role::find(name).unwrap_or_else(|| panic!("{place}: {name}"));
                    used.insert(found.rank);
                    // Those of a vertex, edge, side or share stand together.
                    let family = found.role.pattern.split_once("{k}").map(|(family, _)| family);
                    let first = Role::ALL.iter().position(|role| {
                        family.map_or(role.pattern == found.role.pattern, |family| {
                            role.pattern.starts_with(&format!("{family}{{k}}"))
                        })
                    });
                    let sample = found.sample.unwrap_or(usize::MAX);
                    let order = Some((first, sample, found.k, found.rank));
                    assert!(order > before, "{place}: {name} comes too late");
                    before = order;
                }
            }
        }
    }
    let unused: Vec<_> =
        (0..Role::ALL.len()).filter(|rank| !used.contains(rank)).map(|r| Role::ALL[r]).collect();
    assert_eq!(unused, [], "no column has this role");
}

// Clause N-16
#[test]
fn the_specification_lists_every_role() {
    let spec = include_str!("../../../spec/09-vectors.md");
    let (_, clause) = spec.split_once("### N-16 ").unwrap();
    let clause = clause.split("\n### ").next().unwrap();
    let rows: Vec<&str> = clause.lines().filter(|line| line.starts_with("| `")).collect();
    let expected: Vec<String> = Role::ALL
        .iter()
        .map(|role| {
            let [name, meaning] = [role.pattern, role.meaning].map(|t| t.replace("{k}", "K"));
            format!("| `{name}` | {meaning} |")
        })
        .collect();
    assert_eq!(rows, expected);
}

#[test]
fn packages_count_the_rows_of_the_manifest() {
    let set = write_set(&profile("tiny"), "fan", &options(700));
    let mut found = 0;
    for file in set.manifest.files.iter().filter(|file| !file.columns.is_empty()) {
        let stem = file.name.strip_suffix(".tv").unwrap();
        let upper = format!("{}_ROWS", stem.replace('.', "_").to_uppercase());
        let rows = file.rows;
        for (package, line) in [
            ("pkg.sv", format!("localparam logic [63:0] {upper} = 64'd{rows};")),
            ("pkg.vh", format!("`define GUARDBIT_{upper} 64'd{rows}\n")),
            ("pkg.vhd", format!("constant {upper} : unsigned(63 downto 0) := x\"{rows:016x}\";")),
            ("pkg.h", format!("{upper} UINT64_C({rows})\n")),
        ] {
            let text = set.text(package);
            assert!(text.contains(&line), "{package} lacks {line:?}");
            found += 1;
        }
    }
    assert_eq!(found, 4 * 10);
}
