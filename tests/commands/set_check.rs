//! `verify`: no change of a set goes unseen.

use crate::set;

use crate::verify::first_line;
use guardbit::bits::Rounding;
use guardbit::model::MODEL_VERSION;
use guardbit::vector::check::{self, CheckError, CheckOptions, CheckReport};
use guardbit::vector::manifest::Manifest;
use guardbit::vector::write::{self, Monitor, Options, SetIndex};
use set::{copy, options, profile, request, tree, write_set};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

fn checked(dir: &Path, options: CheckOptions<'_>) -> Result<CheckReport, CheckError> {
    check::check(dir, CheckOptions { threads: 1, ..options }, &Monitor::default())
}

/// File and line of the first complaint about a folder, or `None` if there is none.
fn complaint(dir: &Path) -> Option<(String, Option<u64>)> {
    match checked(dir, CheckOptions::default()) {
        Ok(report) => report.findings.first().map(|finding| {
            assert!(!finding.message.is_empty());
            let file = finding.file.strip_prefix(dir).unwrap_or(&finding.file);
            (file.to_str().unwrap().to_owned(), finding.line)
        }),
        Err(CheckError::Malformed { path, line, .. }) => Some((name_of(&path), Some(line as u64))),
        Err(CheckError::OtherModel { path, .. }) => Some((name_of(&path), None)),
        Err(other) => panic!("{other}"),
    }
}

fn name_of(path: &str) -> String {
    Path::new(path).file_name().unwrap().to_str().unwrap().to_owned()
}

/// Every way to change one character at each of these places, and whole lines here and there.
fn damages(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut list = Vec::new();
    let step = match bytes.len() {
        0..300 => 1,
        300..10_000 => bytes.len() / 20 + 1,
        _ => bytes.len() / 7 + 1,
    };
    for at in (0..bytes.len()).step_by(step).chain([bytes.len() - 1]) {
        let mut replaced = bytes.to_vec();
        replaced[at] = if bytes[at] == b'7' { b'8' } else { b'7' };
        list.push((format!("byte {at} replaced"), replaced));
        let mut deleted = bytes.to_vec();
        deleted.remove(at);
        list.push((format!("byte {at} deleted"), deleted));
        let mut inserted = bytes.to_vec();
        inserted.insert(at, b'3');
        list.push((format!("byte {at} inserted"), inserted));
    }
    let lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    for n in (0..lines.len()).step_by(lines.len() / 5 + 1) {
        let mut doubled = lines.clone();
        doubled.insert(n, lines[n]);
        list.push((format!("line {n} doubled"), doubled.concat()));
        let mut without = lines.clone();
        without.remove(n);
        list.push((format!("line {n} left out"), without.concat()));
        list.push((format!("cut before line {n}"), lines[..n].concat()));
        if let Some(other) = (n + 1..lines.len()).find(|other| lines[*other] != lines[n]) {
            let mut swapped = lines.clone();
            swapped.swap(n, other);
            list.push((format!("line {n} swapped with {other}"), swapped.concat()));
        }
    }
    list.push(("a line more".to_owned(), [bytes, b"0\n"].concat()));
    list.push(("no final newline".to_owned(), bytes[..bytes.len() - 1].to_vec()));
    list.push(("CRLF".to_owned(), String::from_utf8_lossy(bytes).replace('\n', "\r\n").into()));
    list.push(("not UTF-8".to_owned(), [&bytes[..bytes.len() / 2], b"\xff\xfe"].concat()));
    list
}

// Clause N-12 and Clause N-9
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn every_single_change_is_caught_and_its_place_named() {
    let golden = write_set(&profile("tiny"), "triangle", &options(400));
    assert_eq!(complaint(&golden.folder()), None);
    let mut files = tree(&golden.folder());
    assert_eq!(files.len(), 29);
    // Of the texts in a folder of their own, short ones are enough.
    files.retain(|(name, _)| !name.starts_with("formal/") || name.ends_with("/dda.sby"));
    let (next, tried) = (AtomicUsize::new(0), AtomicUsize::new(0));
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let home = tempfile::tempdir().unwrap();
                let folder = home.path().join("set");
                copy(&golden.folder(), &folder);
                while let Some((name, bytes)) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let path = folder.join(name);
                    for (how, damaged) in damages(bytes) {
                        if damaged == *bytes {
                            continue;
                        }
                        tried.fetch_add(1, Ordering::Relaxed);
                        std::fs::write(&path, &damaged).unwrap();
                        let place = complaint(&folder);
                        let Some((file, line)) = place else { panic!("{name}: {how}: not seen") };
                        assert_eq!(file, *name, "{how}");
                        // A manifest's own digest may be what no longer fits, further down.
                        let expected = first_line(bytes, &damaged);
                        if name != "manifest.json" {
                            assert_eq!(line, Some(expected), "{name}: {how}");
                        }
                    }
                    std::fs::remove_file(&path).unwrap();
                    if name == "manifest.json" {
                        let error = checked(&folder, CheckOptions::default()).unwrap_err();
                        assert!(matches!(error, CheckError::Unfinished(_)), "{error}");
                    } else {
                        assert_eq!(complaint(&folder).unwrap().0, *name, "deleted");
                    }
                    std::fs::write(&path, bytes).unwrap();
                }
            });
        }
    });
    let tried = tried.into_inner();
    assert!(tried > 1000, "{tried} changes tried");
}

/// What a forger does to a manifest.
type Change<'a> = &'a dyn Fn(&mut Manifest);

/// Clause N-7: a bench without files in the operand form has its coverage in the manifest all the same.
#[test]
fn sets_in_the_operand_form_recompute() {
    let format = guardbit::vector::table::RowFormat::TestFloat;
    let golden = write_set(&profile("tiny"), "triangle", &Options { format, ..options(800) });
    let recompute = CheckOptions { recompute: true, ..CheckOptions::default() };
    assert_eq!(checked(&golden.folder(), recompute).unwrap().findings, []);
}

#[test]
fn recomputing_sees_through_a_manifest_made_to_fit() {
    // Whoever edits the rows and mends digest and counts, too, meets the model.
    let golden = write_set(&profile("tiny"), "triangle", &options(4300));
    let recompute = CheckOptions { recompute: true, ..CheckOptions::default() };
    assert_eq!(checked(&golden.folder(), recompute).unwrap().findings, []);
    let forged = |change: &dyn Fn(&Path, &mut Manifest)| {
        let home = tempfile::tempdir().unwrap();
        let folder = home.path().join("set");
        copy(&golden.folder(), &folder);
        let mut manifest = golden.manifest.clone();
        change(&folder, &mut manifest);
        for file in &mut manifest.files {
            let bytes = std::fs::read(folder.join(&file.name)).unwrap();
            file.bytes = bytes.len() as u64;
            file.sha256 = guardbit::vector::manifest::sha256(&bytes);
            if !file.columns.is_empty() {
                file.rows = bytes.split(|byte| *byte == b'\n').count() as u64 - 1;
            }
        }
        std::fs::write(folder.join("manifest.json"), manifest.to_text()).unwrap();
        // Consistent in itself: only the model can tell.
        assert_eq!(checked(&folder, CheckOptions::default()).unwrap().findings, []);
        checked(&folder, recompute).unwrap().findings
    };
    for file in golden.manifest.files.iter().filter(|file| !file.columns.is_empty()) {
        let findings = forged(&|folder, _| {
            let path = folder.join(&file.name);
            let text = std::fs::read_to_string(&path).unwrap();
            let flipped = if text.ends_with("1\n") { "0\n" } else { "1\n" };
            std::fs::write(&path, text[..text.len() - 2].to_owned() + flipped).unwrap();
        });
        let place: Vec<_> =
            findings.iter().map(|f| (f.file.file_name().unwrap(), f.line)).collect();
        assert_eq!(place, [(file.name.as_ref(), Some(file.rows))]);
    }
    let changes: [(&str, Change<'_>); 6] = [
        ("seed", &|m| m.seed += 1),
        ("groups", &|m| m.groups[0].tests += 1),
        ("groups", &|m| m.groups[2].catches = "nothing".to_owned()),
        ("coverage", &|m| m.coverage[0].cells[0].rows += 1),
        ("coverage", &|m| m.coverage[0].cells.clear()),
        ("columns", &|m| m.files[0].columns[0].meaning = "Another.".to_owned()),
    ];
    for (what, change) in changes {
        let findings = forged(&|_, manifest| change(manifest));
        assert!(!findings.is_empty(), "{what}");
    }
    // A file left out of manifest and folder.
    for name in ["edge.exp.tv", "pkg.h", "profile.toml"] {
        let findings = forged(&|folder, manifest| {
            manifest.files.retain(|file| file.name != name);
            std::fs::remove_file(folder.join(name)).unwrap();
        });
        assert!(findings.iter().any(|f| f.to_string().contains(name)), "{name}: {findings:?}");
    }
}

#[test]
fn what_is_no_set_of_this_model_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let error = |dir: &Path| checked(dir, CheckOptions::default()).unwrap_err().to_string();
    assert!(error(home.path()).contains("no manifest.json or sets.json"));
    assert!(error(&home.path().join("none")).contains("no manifest.json or sets.json"));
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    // The set of another profile, and of a neighbour.
    for believed in ["d3d11", "sgi-4k"] {
        let believed = profile(believed);
        let options = CheckOptions { profile: Some(&believed), ..CheckOptions::default() };
        let error = checked(&golden.folder(), options).unwrap_err().to_string();
        assert!(error.contains("name = \"tiny\"") && error.contains("manifest.json"), "{error}");
    }
    let mut believed = profile("tiny");
    believed.depth.iter_mut().for_each(|depth| depth.rounding = Rounding::Floor);
    let options_of = |profile| CheckOptions { profile: Some(profile), ..CheckOptions::default() };
    let error = checked(&golden.folder(), options_of(&believed)).unwrap_err().to_string();
    assert!(error.contains("nearest-even") && error.contains("floor"), "{error}");
    checked(&golden.folder(), options_of(&profile("tiny"))).unwrap();
    // A form that nobody writes.
    let mut manifest = golden.manifest.clone();
    manifest.format = "xml".to_owned();
    std::fs::write(golden.file("manifest.json"), manifest.to_text()).unwrap();
    let recompute = CheckOptions { recompute: true, ..CheckOptions::default() };
    let error = checked(&golden.folder(), recompute).unwrap_err().to_string();
    assert!(
        error
            .contains("format: \"xml\" is unknown; the formats are tv, bin, csv, jsonl, testfloat"),
        "{error}"
    );
    // Another model version, digest mended.
    let mut manifest = golden.manifest.clone();
    manifest.model_version += 1;
    std::fs::write(golden.file("manifest.json"), manifest.to_text()).unwrap();
    let error = checked(&golden.folder(), CheckOptions::default()).unwrap_err().to_string();
    let versions =
        [format!("model version {}", MODEL_VERSION + 1), format!("version {MODEL_VERSION}")];
    assert!(versions.iter().all(|version| error.contains(version)), "{error}");
}

// Clause N-12
#[test]
fn a_set_of_another_schema_is_refused_and_can_be_written_anew() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    let schema = |found: u32| {
        let manifest = Manifest { schema: found, ..golden.manifest.clone() };
        std::fs::write(golden.file("manifest.json"), manifest.to_text()).unwrap();
        let error = checked(&golden.folder(), CheckOptions::default()).unwrap_err();
        assert!(matches!(error, CheckError::OtherSchema { .. }), "{error}");
        let text = error.to_string();
        let says = format!(
            "manifest.json: the set has schema {found}, but this version of guardbit reads schema 3"
        );
        assert!(text.contains(&says), "{text}");
        text
    };
    assert!(schema(4).contains("check the set with the version of guardbit that wrote it"));
    assert!(schema(1).contains("write the set again with `guardbit vectors`"));
    // Fields that this version does not know are no reason to say less.
    let text = golden.text("manifest.json").replacen('{', "{\n  \"older\": true,", 1);
    let (head, _) = text.rsplit_once("\"digest\": \"").unwrap();
    let signed = |digest: &str| format!("{head}\"digest\": \"{digest}\"\n}}\n");
    let text = signed(&guardbit::vector::manifest::sha256(signed("").as_bytes()));
    std::fs::write(golden.file("manifest.json"), text).unwrap();
    let error = checked(&golden.folder(), CheckOptions::default()).unwrap_err();
    assert!(matches!(error, CheckError::OtherSchema { found: 1, .. }), "{error}");
    // It is replaced where that is asked for, and nothing else is.
    let requests = [request(&profile("tiny"), "triangle")];
    let force = Options { force: true, ..options(50) };
    let write = || write::write(&requests, &golden.folder(), false, &force, &Monitor::default());
    std::fs::write(golden.file("notes.txt"), "mine").unwrap();
    assert!(write().unwrap_err().to_string().contains("notes.txt does not belong to a vector set"));
    std::fs::remove_file(golden.file("notes.txt")).unwrap();
    write().unwrap();
    assert_eq!(checked(&golden.folder(), CheckOptions::default()).unwrap().findings, []);
}

// Clause N-10 and Clause N-12
#[test]
fn strangers_among_files_and_sets_are_named() {
    let golden = write_set(&profile("tiny"), "triangle", &options(50));
    std::fs::write(golden.file("more.exp.tv"), "0\n").unwrap();
    assert_eq!(complaint(&golden.folder()), Some(("more.exp.tv".to_owned(), None)));
    // A folder of two sets; a third is copied in, one is edited, one is replaced by another run's.
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("sets");
    let requests = ["tiny", "d3d11"].map(|name| request(&profile(name), "triangle"));
    write::write(&requests, &out, true, &options(50), &Monitor::default()).unwrap();
    assert_eq!(complaint(&out), None);
    copy(&out.join("tiny"), &out.join("copied"));
    assert_eq!(complaint(&out), Some(("copied".to_owned(), None)));
    std::fs::remove_dir_all(out.join("copied")).unwrap();
    let other = write_set(&profile("tiny"), "triangle", &options(51));
    std::fs::rename(out.join("tiny"), home.path().join("old")).unwrap();
    copy(&other.folder(), &out.join("tiny"));
    assert_eq!(complaint(&out), Some(("tiny/manifest.json".to_owned(), None)));
    // One set's file in the other's place.
    std::fs::remove_dir_all(out.join("tiny")).unwrap();
    std::fs::rename(home.path().join("old"), out.join("tiny")).unwrap();
    std::fs::copy(out.join("tiny/dda.exp.tv"), out.join("d3d11/dda.exp.tv")).unwrap();
    assert_eq!(complaint(&out), Some(("d3d11/dda.exp.tv".to_owned(), Some(1))));
    // The index itself.
    let text = std::fs::read_to_string(out.join("sets.json")).unwrap();
    let index: SetIndex = serde_json::from_str(&text).unwrap();
    assert_eq!(index.sets.len(), 2);
    for (how, damaged) in damages(text.as_bytes()) {
        std::fs::write(out.join("sets.json"), damaged).unwrap();
        let seen = match checked(&out, CheckOptions::default()) {
            Ok(report) => !report.findings.is_empty(),
            Err(CheckError::Malformed { .. } | CheckError::Unfinished(_)) => true,
            Err(other) => panic!("{how}: {other}"),
        };
        assert!(seen, "{how}");
    }
}
