//! The committed golden sets: made again byte for byte, and recomputed.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;
use crate::set;

use guardbit::model::MODEL_VERSION;
use guardbit::vector::bench::Source;
use guardbit::vector::check::{self, CheckOptions};
use guardbit::vector::write::Monitor;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const POLICY: &str = "If the change is meant: raise MODEL_VERSION in src/model.rs (once between two \
                      releases), name the change in CHANGELOG.md, run the lines of \
                      vectors/README.md again and commit the sets with it. A golden file is never \
                      edited by hand.";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("vectors")
}

/// The lines of vectors/README.md that make the sets: arguments and the set's name.
fn recipes() -> Vec<(String, String)> {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let lines = readme.lines().filter_map(|line| line.strip_prefix("guardbit "));
    lines
        .map(|line| {
            let (before, after) = line.split_once("--out vectors/").unwrap();
            (format!("{before}--out {after}"), after.split_whitespace().next().unwrap().to_owned())
        })
        .collect()
}

/// Where two contents part, for a person.
fn difference(golden: &[u8], made: &[u8]) -> String {
    let (golden, made) = (String::from_utf8_lossy(golden), String::from_utf8_lossy(made));
    let mut lines = golden.lines().zip(made.lines()).enumerate();
    match lines.find(|(_, (a, b))| a != b) {
        Some((n, (a, b))) => format!("line {}: {a:?} was committed, {b:?} is made", n + 1),
        None => format!("{} bytes were committed, {} are made", golden.len(), made.len()),
    }
}

#[test]
fn sets_are_made_again_byte_for_byte() {
    let recipes = recipes();
    let names: BTreeSet<String> = recipes.iter().map(|(_, name)| name.clone()).collect();
    let folders: BTreeSet<String> = std::fs::read_dir(root())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "README.md")
        .collect();
    assert_eq!(names, folders, "vectors/README.md names every set");
    for (arguments, name) in recipes {
        let home = tempfile::tempdir().unwrap();
        run::run_in(home.path(), &arguments).ends(0);
        let (golden, made) = (set::tree(&root().join(&name)), set::tree(&home.path().join(&name)));
        let list = |tree: &[(String, Vec<u8>)]| -> Vec<String> {
            tree.iter().map(|(name, _)| name.clone()).collect()
        };
        assert_eq!(list(&golden), list(&made), "vectors/{name} has other files.\n{POLICY}");
        for ((file, golden), (_, made)) in golden.iter().zip(&made) {
            assert!(
                golden == made,
                "vectors/{name}/{file} is not what the model makes: {}\n{POLICY}",
                difference(golden, made)
            );
        }
    }
}

#[test]
fn sets_stand_up_to_recomputation_and_hold_every_directed_class() {
    for (_, name) in recipes() {
        let options = CheckOptions { recompute: true, threads: 2, ..CheckOptions::default() };
        let report = check::check(&root().join(&name), options, &Monitor::default()).unwrap();
        assert_eq!(report.findings, [], "{name}\n{POLICY}");
        let manifest = &report.sets[0].manifest;
        assert!(report.rows > manifest.count, "{name}");
        let source = Source {
            profile: set::profile(&name),
            scene: set::request(&set::profile(&name), "fan").scene,
            values: std::sync::Arc::default(),
            seed: manifest.seed,
            count: manifest.count,
        };
        for bench in source.benches() {
            for group in bench.groups().iter().filter(|group| group.tests > 0) {
                let listed = manifest.groups.iter().find(|entry| {
                    (entry.bench.as_str(), entry.tag.as_str()) == (bench.name(), group.class.tag)
                });
                // No walk of a directed class is cut off by the count.
                assert_eq!(
                    listed.map(|entry| entry.tests),
                    Some(group.tests),
                    "{name} {} {}",
                    bench.name(),
                    group.class.tag
                );
            }
        }
    }
}

#[test]
fn the_changelog_names_the_model_version_of_the_sets() {
    let changelog = std::fs::read_to_string(root().join("../CHANGELOG.md")).unwrap();
    assert!(changelog.contains(&format!("model version {MODEL_VERSION}")), "{POLICY}");
    for (_, name) in recipes() {
        let (sets, findings) = check::open(&root().join(&name)).unwrap();
        assert_eq!(findings, []);
        assert_eq!(sets[0].manifest.model_version, MODEL_VERSION, "{POLICY}");
    }
}

#[test]
fn the_sets_stay_small() {
    let bytes: usize = set::tree(&root()).iter().map(|(_, bytes)| bytes.len()).sum();
    assert!(bytes < 2_000_000, "{bytes} bytes of golden vectors");
}
