//! `verify`: no change of a set goes unseen, and a device's defect is called by its name.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::device;
#[cfg(feature = "cli")]
use crate::run;
use crate::set;

use device::{Clocked, Drawer, Reader, Slip, Stepper};
use guardbit::bits::Rounding;
use guardbit::format::Clamp;
use guardbit::model::MODEL_VERSION;
use guardbit::profile::{Form, Profile};
use guardbit::setup::Triangle;
use guardbit::vector::bench::{
    Rig, SetupBench, Source, TestBench, TriangleBench, WalkBench, WalkKind,
};
use guardbit::vector::check::{self, CheckError, CheckOptions, CheckReport};
use guardbit::vector::device::Device;
use guardbit::vector::dump::{self, CompareError, DumpReport};
use guardbit::vector::emit;
use guardbit::vector::manifest::Manifest;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Monitor, Options, SetIndex, SetRequest};
use set::{Set, copy, options, profile, request, tree, write_set};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use tempfile::TempDir;

fn checked(dir: &Path, options: CheckOptions<'_>) -> Result<CheckReport, CheckError> {
    check::check(dir, CheckOptions { threads: 1, ..options }, &Monitor::default())
}

/// File and line of the first complaint about a folder, or `None` if there is none.
fn complaint(dir: &Path) -> Option<(String, Option<u64>)> {
    match checked(dir, CheckOptions::default()) {
        Ok(report) => report.findings.first().map(|finding| {
            assert!(!finding.message.is_empty());
            (finding.file.file_name().unwrap().to_str().unwrap().to_owned(), finding.line)
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

/// The first line, from 1, in which two contents differ.
fn first_line(a: &[u8], b: &[u8]) -> u64 {
    let lines = |bytes: &'_ [u8]| -> Vec<Vec<u8>> {
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect()
    };
    let (a, b) = (lines(a), lines(b));
    (0..=a.len()).find(|n| a.get(*n) != b.get(*n)).unwrap() as u64 + 1
}

// Clause N-12 and Clause N-9
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn every_single_change_is_caught_and_its_place_named() {
    let golden = write_set(&profile("tiny"), "triangle", &options(400));
    assert_eq!(complaint(&golden.folder()), None);
    let files = tree(&golden.folder());
    assert_eq!(files.len(), 22);
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
    assert_eq!(complaint(&out), Some(("manifest.json".to_owned(), None)));
    // One set's file in the other's place.
    std::fs::remove_dir_all(out.join("tiny")).unwrap();
    std::fs::rename(home.path().join("old"), out.join("tiny")).unwrap();
    std::fs::copy(out.join("tiny/dda.exp.tv"), out.join("d3d11/dda.exp.tv")).unwrap();
    assert_eq!(complaint(&out), Some(("dda.exp.tv".to_owned(), Some(1))));
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

/// A set, and what its benches are made from.
struct Golden {
    set: Set,
    source: Source,
    profile: Profile,
    keep: TempDir,
}

impl Golden {
    fn of(request: SetRequest, count: u64) -> Self {
        let (profile, scene) = (request.profile.clone(), request.scene.clone());
        let source = Source { profile: profile.clone(), scene, seed: 1, count };
        let set = set::write_request(request, &options(count));
        Self { set, source, profile, keep: tempfile::tempdir().unwrap() }
    }

    fn named(name: &str, count: u64) -> Self {
        Self::of(request(&profile(name), "fan"), count)
    }

    /// A file of the set as a device at a bench answers it.
    fn answered<B: TestBench>(
        &self,
        name: &str,
        bench: &B,
        device: impl Device<B::Test> + 'static,
    ) -> String {
        let mut files = Kept(vec![Vec::new(); bench.files().len()]);
        let mut rig = Rig::new(bench, Box::new(device), RowFormat::Tv);
        emit::run(bench, &mut rig, (Shard::WHOLE, self.source.count), &mut files).unwrap();
        let stem = name.strip_suffix(".tv").unwrap();
        let file = bench.files().iter().position(|spec| spec.stem == stem).unwrap();
        String::from_utf8(files.0.swap_remove(file)).unwrap()
    }

    /// The whole file as a stepper answers it.
    fn walked(&self, stem: &str, stepper: Stepper) -> String {
        let kind = if stem == "dda" { WalkKind::Depth } else { WalkKind::Edge };
        let bench = WalkBench::new(kind, &self.source).unwrap();
        self.answered(&format!("{stem}.exp.tv"), &bench, Clocked::new(stepper))
    }

    /// The whole file as a drawing device answers it.
    fn drawn(&self, name: &str, drawer: &Drawer) -> String {
        if name == "setup.exp.tv" {
            self.answered(name, &SetupBench::new(&self.source), *drawer)
        } else {
            self.answered(name, &TriangleBench::new(&self.source), *drawer)
        }
    }

    fn dump(&self, name: &str, text: &str) -> PathBuf {
        let path = self.keep.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    fn compare(&self, name: &str, text: &str) -> Result<DumpReport, CompareError> {
        let (sets, _) = check::open(&self.set.folder()).unwrap();
        dump::compare(&sets[0], &self.dump(name, text), None, 20)
    }

    /// A dump that disagrees: the first divergence is the first there is, and is shown.
    fn disagrees(&self, name: &str, text: &str) -> DumpReport {
        let report = self.compare(name, text).unwrap();
        assert!(report.total > 0, "{name}: the defect does not show");
        let golden = self.set.text(name);
        if !name.starts_with("span") && !name.starts_with("depth") {
            let line = first_line(golden.as_bytes(), text.as_bytes());
            let first = &report.mismatches[0];
            assert_eq!((first.row, first.line), (Some(line), Some(line)), "{name}");
            let at = usize::try_from(line).unwrap() - 1;
            let (wanted, got) = (golden.lines().nth(at).unwrap(), text.lines().nth(at).unwrap());
            for (wanted, got) in wanted.split('_').zip(got.split('_')) {
                if wanted != got {
                    let both = format!("expected {wanted}, got {got}: off by ");
                    assert!(first.text.contains(&both), "{both}: {}", first.text);
                }
            }
            let differing = golden.lines().zip(text.lines()).filter(|(a, b)| a != b).count();
            assert_eq!(report.total, differing as u64, "{name}");
        }
        report
    }

    /// Whether the defect shows and its cause is among those named; else what went wrong.
    fn blames(&self, name: &str, text: &str, cause: &str) -> Option<String> {
        let place = format!("{} {name}: {cause:?}", self.profile.name);
        if text == self.set.text(name) {
            return Some(format!("{place} does not show"));
        }
        let report = self.disagrees(name, text);
        let named = report.causes.iter().any(|found| found.contains(cause));
        (!named).then(|| format!("{place} is not among {:?}", report.causes))
    }
}

/// The files of a bench, kept.
struct Kept(Vec<Vec<u8>>);

impl emit::Output for Kept {
    fn bytes(&mut self, file: usize, bytes: &[u8]) -> std::io::Result<bool> {
        self.0[file].extend_from_slice(bytes);
        Ok(true)
    }
}

/// Enough rows for every directed class of the profile, some of the scene, some random.
const PROFILES: [(&str, u64); 3] = [("tiny", 4300), ("sgi-4k", 6000), ("d3d11", 6000)];

#[test]
fn a_device_that_works_passes() {
    for (name, count) in PROFILES {
        let golden = Golden::named(name, count);
        let Form::EdgeFunction(edges) = golden.profile.form else { panic!() };
        let drawer = Drawer::of(&golden.profile);
        let files = [
            ("dda.exp.tv", golden.walked("dda", Stepper::depth(Reader::of(&golden.profile)))),
            ("edge.exp.tv", golden.walked("edge", Stepper::edge(edges.width))),
            ("setup.exp.tv", golden.drawn("setup.exp.tv", &drawer)),
            ("span.exp.tv", golden.drawn("span.exp.tv", &drawer)),
            ("depth.exp.tv", golden.drawn("depth.exp.tv", &drawer)),
        ];
        for (file, text) in files {
            let report = golden.compare(file, &text).unwrap();
            assert_eq!((report.total, report.short), (0, false), "{name} {file}");
            assert_eq!(report.rows, report.expected_rows);
            assert_eq!(report.rows, golden.set.rows(file).len() as u64);
            assert_eq!(report.causes, [""; 0]);
        }
    }
}

/// The depth columns of a vertex are zero where a scene has none, and what a device answers to zeros is
/// what the set expects.
#[test]
fn a_scene_without_depth_has_a_depth_of_zero() {
    let profile = profile("d3d11");
    let mut request = request(&profile, "fan");
    let flat = request.scene.iter().map(|triangle| Triangle { z: None, ..*triangle });
    request.scene = std::sync::Arc::new(flat.collect());
    let golden = Golden::of(request, 4000);
    let drawer = Drawer::of(&profile);
    assert!(drawer.half, "a start that is not zero");
    let scene = golden.set.manifest.groups.iter().find(|g| g.bench == "setup" && g.tag == "scene");
    assert!(scene.unwrap().tests > 0);
    for file in ["setup.exp.tv", "span.exp.tv", "depth.exp.tv"] {
        let text = golden.drawn(file, &drawer);
        assert_eq!(golden.set.text(file), text, "{file}");
    }
}

// Clause N-14
#[test]
fn defects_of_a_depth_stepper_are_called_by_name() {
    let mut faults: Vec<String> = Vec::new();
    for (name, count) in PROFILES {
        let golden = Golden::named(name, count);
        let right = Reader::of(&golden.profile);
        let (port, guard) = (right.width(), right.guard);
        let reader = |reader: Reader| {
            let stepper = Stepper { port, ..Stepper::depth(reader) };
            golden.walked("dda", stepper)
        };
        for clamp in [Clamp::Wrap, Clamp::Sign, Clamp::Saturate] {
            let cause = format!("depth.clamp is {} instead of guard", clamp.name());
            faults.extend(golden.blames("dda.exp.tv", &reader(Reader { clamp, ..right }), &cause));
        }
        for other in [guard - 1, guard + 1] {
            let cause = format!("depth.guard is {other} instead of {guard}");
            faults.extend(golden.blames(
                "dda.exp.tv",
                &reader(Reader { guard: other, ..right }),
                &cause,
            ));
        }
        for (slip, cause) in [
            (Slip::Late, "each row shows the state before its clock edge"),
            (Slip::LateOut, "the read-out lags the accumulator by one clock"),
            (Slip::Swapped, "dx and dy are exchanged"),
            (Slip::HoldSteps, "a hold acts as a step right"),
            (Slip::Negated, "subtracted where added belongs"),
            (Slip::OnlyX, "a step down acts as a step right"),
            (Slip::RoundsOut, "rounded to nearest, where the fraction belongs"),
            (Slip::WrongEnd, "zero and the maximum are exchanged"),
        ] {
            let stepper = Stepper { slip, ..Stepper::depth(right) };
            faults.extend(golden.blames("dda.exp.tv", &golden.walked("dda", stepper), cause));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn defects_of_an_edge_stepper_are_called_by_name() {
    let mut faults: Vec<String> = Vec::new();
    for (name, count) in PROFILES {
        let golden = Golden::named(name, count);
        let Form::EdgeFunction(edges) = golden.profile.form else { panic!() };
        let right = Stepper::edge(edges.width);
        for width in [edges.width - 1, edges.width + 1] {
            let cause = format!("form.edge-function.width is {width} instead of {}", edges.width);
            faults.extend(golden.blames(
                "edge.exp.tv",
                &golden.walked("edge", Stepper { width, ..right }),
                &cause,
            ));
        }
        for (slip, cause) in [
            (Slip::Late, "each row shows the state before its clock edge"),
            (Slip::LateOut, "the sign test lags the edge word by one clock"),
            (Slip::Swapped, "dx and dy are exchanged"),
            (Slip::HoldSteps, "a hold acts as a step right"),
            (Slip::Negated, "subtracted where added belongs"),
            (Slip::OnlyX, "a step down acts as a step right"),
            (Slip::ZeroOutside, "the sign test of an edge word: > instead of >="),
            (Slip::Inverted, "the sign test of an edge word: < instead of >="),
        ] {
            faults.extend(golden.blames(
                "edge.exp.tv",
                &golden.walked("edge", Stepper { slip, ..right }),
                cause,
            ));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// What makes a right device a wrong one, the files in which it shows, and what it is called.
type Defect<'a> = (&'a dyn Fn(&mut Drawer), &'a [&'a str], String);

#[test]
fn defects_of_set_up_and_drawing_are_called_by_name() {
    let all = &["setup.exp.tv", "span.exp.tv", "depth.exp.tv"][..];
    let (set_up, spans, depths) = (&all[..1], &all[1..2], &all[2..]);
    let (covers, values, draws) = (all, &["setup.exp.tv", "depth.exp.tv"][..], &all[1..]);
    let mut faults: Vec<String> = Vec::new();
    for (name, count) in PROFILES {
        let golden = Golden::named(name, count);
        let right = Drawer::of(&golden.profile);
        let half = right.sample[0];
        let guard = right.reader.guard;
        let roundings = [Rounding::Floor, Rounding::TowardZero, Rounding::NearestAway];
        let mut defects: Vec<Defect<'_>> = Vec::new();
        let round: Vec<_> = roundings
            .into_iter()
            .map(|rounding| (rounding, move |d: &mut Drawer| d.rounding = rounding))
            .collect();
        for (rounding, change) in &round {
            if *rounding == Rounding::NearestAway && name == "tiny" {
                // The triangles with ties do not fit its field.
                continue;
            }
            let cause = format!("depth.rounding is {rounding} instead of nearest-even");
            // A tie is too rare to reach a drawn depth everywhere.
            let files = if *rounding == Rounding::NearestAway { set_up } else { values };
            defects.push((change, files, cause));
        }
        // Covered samples leave the range by a rounding, downward only: no other clamp shows, one
        // guard bit is enough, and with half a unit added to the start nothing leaves it.
        let (files, few) = (if right.half { &[] } else { depths }, guard == 1);
        let wraps = |d: &mut Drawer| d.reader.clamp = Clamp::Wrap;
        defects.push((&wraps, files, "depth.clamp is wrap instead of guard".to_owned()));
        let fewer = move |d: &mut Drawer| d.reader.guard = guard - 1;
        let cause = format!("depth.guard is {} instead of {guard}", guard - 1);
        defects.push((&fewer, if few { depths } else { &[] }, cause));
        let other = if right.half { "none instead of half" } else { "half instead of none" };
        let flip = |d: &mut Drawer| d.half = !d.half;
        defects.push((&flip, values, format!("depth.start-bias is {other}")));
        let reciprocal = "a reciprocal of 12 bits".to_owned();
        // The areas of the toy are so small that 12 bits are as good as a quotient.
        let files = if name == "tiny" { &[] } else { values };
        defects.push((&|d| d.reciprocal = Some(12), files, reciprocal));
        let coarse = |d: &mut Drawer| d.reader.fraction -= 1;
        let f = right.reader.fraction;
        let cause = format!("depth.interpolation is {} instead of {f}", f - 1);
        defects.push((&coarse, set_up, cause));
        let shadow = "rule is shadow instead of top-left".to_owned();
        defects.push((&|d| d.shadow = true, covers, shadow));
        defects.push((&|d| d.shifted = false, set_up, "storage is full".to_owned()));
        let corner = format!("sample is (0, 0) instead of ({half}, {half})");
        defects.push((&|d| d.sample = [0, 0], covers, corner));
        if name != "tiny" {
            let beside = format!("sample is ({}, {half}) instead of", half + 1);
            defects.push((&|d| d.sample[0] += 1, covers, beside));
        }
        defects.push((&|d| d.turns_round = false, covers, "not reversed".to_owned()));
        let end = "include the pixel at their right end".to_owned();
        defects.push((&|d| d.right_included = true, draws, end));
        let end = "leave out the pixel at their left end".to_owned();
        defects.push((&|d| d.left_excluded = true, draws, end));
        defects.push((&|d| d.rows_late = true, draws, "one too high".to_owned()));
        assert_eq!(spans.len(), 1);
        for (change, files, cause) in defects {
            let mut drawer = right;
            change(&mut drawer);
            for file in files {
                faults.extend(golden.blames(file, &golden.drawn(file, &drawer), &cause));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn two_defects_at_once_are_called_nothing() {
    let golden = Golden::named("sgi-4k", 4000);
    let right = Reader::of(&golden.profile);
    let stepper =
        Stepper { slip: Slip::HoldSteps, ..Stepper::depth(Reader { clamp: Clamp::Sign, ..right }) };
    let report = golden.disagrees("dda.exp.tv", &golden.walked("dda", stepper));
    assert_eq!(report.causes, [""; 0]);
    assert!(report.tried > 10);
    // One wrong bit in one row is no systematic change, wherever it is.
    for n in [0, 1, 900] {
        let text = golden.set.text("dda.exp.tv");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let flipped = if lines[n].ends_with('0') { "1" } else { "0" };
        let end = lines[n].len() - 1;
        lines[n].replace_range(end.., flipped);
        let report = golden.disagrees("dda.exp.tv", &(lines.join("\n") + "\n"));
        assert_eq!(report.total, 1);
        assert_eq!(report.causes, [""; 0], "row {n}");
    }
}

// Clause N-13
#[test]
fn a_simulators_latitude_is_accepted() {
    let golden = Golden::named("tiny", 1000);
    for name in ["dda.exp.tv", "setup.exp.tv", "span.exp.tv", "depth.exp.tv", "triangle.exp.tv"] {
        let text = golden.set.text(name);
        let changed = [
            text.replace('\n', "\r\n"),
            text.trim_end().to_owned(),
            format!("// a header\n\n{}", text.replace('\n', "  // at 10 ns\n\n  // more\n")),
            text.to_uppercase(),
            text.replace('\n', "\n\n \t\n"),
        ];
        for text in &changed {
            assert_eq!(golden.compare(name, text).unwrap().total, 0, "{name}: {text:.80}");
        }
    }
}

// Clause N-13
#[test]
fn keyed_rows_come_in_any_order_and_others_do_not() {
    let golden = Golden::named("tiny", 1000);
    for name in ["span.exp.tv", "depth.exp.tv", "triangle.exp.tv"] {
        let text = golden.set.text(name);
        let mut lines: Vec<&str> = text.lines().collect();
        lines.reverse();
        let middle = lines.len() / 3;
        lines.rotate_left(middle);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!((report.total, report.rows), (0, lines.len() as u64), "{name}");
        // A row twice is a row too much.
        lines.insert(5, lines[0]);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!(report.total, 1, "{name}");
        assert!(report.mismatches[0].text.contains("extra row"), "{:?}", report.mismatches);
        assert_eq!(report.mismatches[0].row, None);
        assert!(!report.lost, "{name}: nothing is missing");
        // Two rows gone from the middle.
        lines.drain(4..7);
        let report = golden.compare(name, &lines.join("\n")).unwrap();
        assert_eq!(report.total, 2, "{name}");
        assert!(!report.short, "{name}");
        assert!(report.lost && report.causes.is_empty(), "{name}: rows are missing, no more");
        for mismatch in &report.mismatches {
            assert!(mismatch.text.contains("missing: test "), "{mismatch:?}");
            assert!(mismatch.line.is_none() && mismatch.row.is_some());
        }
        // A row of a test that the set does not have.
        let stranger = format!("{}\nffff{}\n", text.trim_end(), &lines[0][4..]);
        let report = golden.compare(name, &stranger).unwrap();
        assert_eq!(report.total, 1, "{name}");
        assert!(report.mismatches[0].text.contains("the set has no test"));
    }
    let text = golden.set.text("dda.exp.tv");
    let mut lines: Vec<&str> = text.lines().collect();
    lines.swap(100, 101);
    assert_ne!(lines[100], lines[101]);
    assert_eq!(golden.compare("dda.exp.tv", &lines.join("\n")).unwrap().total, 2);
}

// Clause N-13
#[test]
fn unknown_digits_disagree_and_masked_ones_do_not() {
    let golden = Golden::named("sgi-4k", 1000);
    let text = golden.set.text("dda.exp.tv");
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let with = |n: usize, line: String| {
        let mut lines = lines.clone();
        lines[n] = line;
        golden.compare("dda.exp.tv", &lines.join("\n")).unwrap()
    };
    for unknown in ["x", "X", "z", "Z"] {
        let line = lines[7].clone();
        let report = with(7, line[..line.len() - 1].to_owned() + unknown);
        assert_eq!(report.total, 1);
        let mismatch = &report.mismatches[0];
        assert_eq!((mismatch.row, mismatch.line), (Some(8), Some(8)));
        assert!(mismatch.text.contains("out: expected") && mismatch.text.contains("unknown"));
        assert!(!mismatch.text.contains("acc:"), "{}", mismatch.text);
        assert_eq!(report.causes, [""; 0]);
    }
    // op 1 digit, acc 10, out 6.
    let (op, acc, out) = (&lines[7][..1], &lines[7][2..12], &lines[7][13..]);
    let masked = |row: &str, mask: &str| with(7, format!("{row}_{mask}")).total;
    assert_eq!(masked(&lines[7], "00000000000000000"), 0);
    assert_eq!(masked(&format!("{op}_{acc}_xxxxxx"), "00000000000ffffff"), 0);
    assert_eq!(masked(&format!("{op}_{acc}_xxxxxx"), "00000000000fffffe"), 1);
    assert_eq!(masked(&format!("{op}_{}x_{out}", &acc[..9]), "0000000000f000000"), 0);
    let other = if acc.ends_with('1') { "0" } else { "1" };
    assert_eq!(masked(&format!("{op}_{}{other}_{out}", &acc[..9]), "00000000000000000"), 1);
    assert_eq!(masked(&format!("{op}_{}{other}_{out}", &acc[..9]), "0000000000f000000"), 0);
    assert_eq!(masked(&format!("3_{acc}_{out}"), "f0000000000000000"), 0);
    // A whole dump with its masks: what is looked at still tells the defect.
    let sign = Stepper::depth(Reader { clamp: Clamp::Sign, ..Reader::of(&golden.profile) });
    let text = golden.walked("dda", sign).replace('\n', "_0ffffffffff000000\n");
    let report = golden.compare("dda.exp.tv", &text).unwrap();
    assert!(report.total > 0);
    assert!(report.causes.iter().any(|cause| cause.contains("depth.clamp is sign")));
}

// Clause J-5
#[test]
fn rows_lost_from_an_ordered_file_are_told_from_wrong_ones() {
    let golden = Golden::named("tiny", 1000);
    let text = golden.set.text("setup.exp.tv");
    let mut lines: Vec<&str> = text.lines().collect();
    // The first row that has words is lost; some rows later another.
    let first = lines.iter().position(|line| line.ends_with("_0")).unwrap();
    lines.remove(first + 20);
    lines.remove(first);
    let report = golden.compare("setup.exp.tv", &lines.join("\n")).unwrap();
    assert!(report.lost && report.causes.is_empty(), "{:?}", report.causes);
    // One row is of another triangle: not lost, but wrong.
    lines[first] = "00_00_00_00_00_00_00_00_00_00_00_00_0";
    let report = golden.compare("setup.exp.tv", &lines.join("\n")).unwrap();
    assert!(!report.lost && report.causes.is_empty(), "{:?}", report.causes);
}

#[test]
fn a_dump_that_stops_early_is_said_to() {
    let golden = Golden::named("tiny", 2000);
    for name in [
        "dda.exp.tv",
        "edge.exp.tv",
        "setup.exp.tv",
        "span.exp.tv",
        "depth.exp.tv",
        "triangle.exp.tv",
    ] {
        let text = golden.set.text(name);
        let lines: Vec<&str> = text.lines().collect();
        for kept in [1, lines.len() / 2, lines.len() - 1] {
            let report = golden.compare(name, &lines[..kept].join("\n")).unwrap();
            assert!(report.short, "{name}: {kept} rows of {}", lines.len());
            assert_eq!(report.rows, kept as u64);
            assert_eq!(report.expected_rows, lines.len() as u64);
            assert!(report.total > 0);
        }
        // Cut in the middle of a row: no row, and said where.
        let cut = text[..text.len() / 2].trim_end();
        let last = cut.lines().last().unwrap();
        if last.len() < lines[0].len() {
            let count = cut.lines().count() as u64;
            let report = golden.compare(name, cut).unwrap();
            assert_eq!((report.cut, report.rows, report.short), (Some(count), count - 1, true));
            assert!(!report.disagrees, "{name}");
            // The same in the middle of a dump is no row.
            let error = golden.compare(name, &format!("{cut}\n{}\n", lines[0])).unwrap_err();
            assert!(error.to_string().contains(&format!("{name}:{count}:")), "{error}");
        }
        // The beginning of a row after the last.
        let report = golden.compare(name, &format!("{text}0")).unwrap();
        assert_eq!((report.total, report.short, report.disagrees), (1, false, true), "{name}");
    }
    // A defect is known from a short dump, too.
    let stepper = Stepper { slip: Slip::HoldSteps, ..Stepper::depth(Reader::of(&golden.profile)) };
    let text = golden.walked("dda", stepper);
    let lines: Vec<&str> = text.lines().collect();
    let report = golden.compare("dda.exp.tv", &lines[..lines.len() - 1].join("\n")).unwrap();
    assert!(
        report.short
            && report.causes.iter().any(|cause| cause.contains("a hold acts as a step right"))
    );
    // Rows after the last.
    let text = golden.set.text("edge.exp.tv");
    let report = golden.compare("edge.exp.tv", &format!("{text}0_00_0\n0_00_0\n")).unwrap();
    assert_eq!((report.total, report.short), (2, false));
    assert_eq!(report.mismatches[0].line, Some(2001));
}

#[test]
fn what_is_no_dump_is_refused_with_its_line() {
    let golden = Golden::named("sgi-4k", 300);
    let good = golden.set.text("dda.exp.tv");
    let line = good.lines().next().unwrap();
    let cases: [(&str, &str); 14] = [
        ("0_8000000000_000000", "acc"), // a bit more than 39
        ("4_0000000000_000000", "op"),
        ("0_00000000000_000000", "acc"),
        ("0_000000000_000000", "acc"),
        ("0_0000000000", "the row has 2 columns, but 3 are needed"),
        ("0", "the row has 1 columns, but 3 are needed"),
        ("0_0000000000_000000_0", "don't-care mask of 17 digits"),
        ("0_0000000000_000000_00000000000000000_0", "don't-care mask"),
        ("0_0000000000_00000g", "'g'"),
        ("0_0000000000_-00001", "'-'"),
        ("0 0000000000 000000", "column"),
        ("op_acc_out", "op"),
        ("0_0000000000_0000\u{e9}", "'\u{e9}'"),
        ("__", "op"),
    ];
    for (bad, about) in cases {
        let text = format!("{line}\n\n// fine so far\n{bad}\n{line}\n");
        let error = golden.compare("dda.exp.tv", &text).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv:4: ") && error.contains(about), "{bad}: {error}");
    }
    for empty in ["", "\n", "// nothing\n", "\r\n\r\n"] {
        let error = golden.compare("dda.exp.tv", empty).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv: the dump has no rows"), "{error}");
    }
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let path = golden.keep.path().join("dda.exp.tv");
    for garbage in [b"\xff\xfe\x00".to_vec(), vec![b'0'; 1 << 17], vec![0; 64]] {
        std::fs::write(&path, garbage).unwrap();
        let error = dump::compare(&sets[0], &path, None, 20).unwrap_err().to_string();
        assert!(error.contains("dda.exp.tv:1: "), "{error}");
    }
    // A dump of another name must say what it is.
    let path = golden.dump("simulated.txt", &good);
    let error = dump::compare(&sets[0], &path, None, 20).unwrap_err().to_string();
    assert!(error.contains("simulated.txt") && error.contains("dda.exp, edge.exp"), "{error}");
    assert_eq!(dump::compare(&sets[0], &path, Some("dda.exp"), 20).unwrap().total, 0);
    assert_eq!(dump::compare(&sets[0], &path, Some("dda.exp.tv"), 20).unwrap().total, 0);
    assert!(dump::compare(&sets[0], &path, Some("dda.cfg"), 20).is_err());
    assert!(dump::compare(&sets[0], &path, Some("edge.exp"), 20).is_err());
}

/// The name, the width and the word of each column.
type Row = Vec<(String, usize, u128)>;

/// The rows of a file, with the manifest's widths.
fn bits(golden: &Golden, name: &str) -> Vec<Row> {
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let file = sets[0].manifest.files.iter().find(|file| file.name == name).unwrap();
    let words = |line: &str| {
        let fields = line.split('_').zip(&file.columns);
        let word = |(field, column): (&str, &guardbit::format::Column)| {
            let width = usize::try_from(column.width).unwrap();
            (column.name.clone(), width, u128::from_str_radix(field, 16).unwrap())
        };
        fields.map(word).collect()
    };
    golden.set.text(name).lines().map(words).collect()
}

fn utf16(text: &str, low_first: bool) -> Vec<u8> {
    let bytes =
        text.encode_utf16().map(|c| if low_first { c.to_le_bytes() } else { c.to_be_bytes() });
    bytes.flatten().collect()
}

/// Clause N-13: what simulators and scripts write is read, and what was assumed is said.
#[test]
fn a_dump_may_have_the_forms_of_simulators() {
    let golden = Golden::named("tiny", 600);
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    for name in ["dda.exp.tv", "setup.exp.tv", "depth.exp.tv"] {
        let text = golden.set.text(name);
        let rows = bits(&golden, name);
        let lines = |line: &dyn Fn(&Row) -> String| {
            rows.iter().map(|row| line(row) + "\n").collect::<String>()
        };
        let joined = |separator: &str, digits: &dyn Fn(usize, u128) -> String| {
            lines(&|row| {
                let words = row.iter().map(|(_, width, word)| digits(*width, *word));
                words.collect::<Vec<_>>().join(separator)
            })
        };
        let padded =
            |width: usize, word: u128| format!("{word:0digits$x}", digits = width.div_ceil(4));
        let packed = lines(&|row| {
            // From the last digit to the first.
            let mut all: Vec<u8> = Vec::new();
            for (_, width, word) in row.iter().rev() {
                all.extend((0..*width).map(|bit| u8::try_from(word >> bit & 1).unwrap()));
            }
            let digit =
                |bits: &[u8]| bits.iter().rev().fold(0, |digit, bit| digit << 1 | u32::from(*bit));
            let digits = all.chunks(4).rev().map(|bits| char::from_digit(digit(bits), 16).unwrap());
            digits.collect()
        });
        // A column more in front, and the others from the last to the first.
        let names: Vec<&str> = rows[0].iter().map(|(name, ..)| name.as_str()).rev().collect();
        let csv = format!("\"time\",{}\n", names.join(","))
            + &lines(&|row| {
                let words = row.iter().rev().map(|(_, width, word)| padded(*width, *word));
                format!("1.5ns,{}", words.collect::<Vec<_>>().join(","))
            });
        let memory = text.replace('_', "");
        let plain = |text: String| text.into_bytes();
        let cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
            ("golden", plain(text.clone()), &[]),
            ("CRLF", plain(text.replace('\n', "\r\n")), &[]),
            ("capitals", plain(text.to_uppercase()), &[]),
            ("memory image", plain(format!("// 0x00000000\n@0\n{memory}")), &["$writememh"]),
            ("packed", plain(packed), &["side by side"]),
            ("blanks", plain(joined(" ", &padded)), &["$fdisplay"]),
            ("short", plain(joined("\t", &|_, word| format!("{word:x}"))), &["$fdisplay"]),
            ("CSV with a header", plain(csv), &["names of the first line", "hexadecimal", "time"]),
            (
                "CSV",
                plain(joined(";", &|_, word| format!("0x{word:x}"))),
                &["CSV without a header"],
            ),
            ("mark", [b"\xef\xbb\xbf", text.as_bytes()].concat(), &["byte order mark"]),
            ("UTF-16", utf16(&format!("\u{feff}{text}"), true), &["low byte first"]),
            ("UTF-16", utf16(&format!("\u{feff}{text}"), false), &["high byte first"]),
            ("UTF-16 without a mark", utf16(&text, true), &["low byte first"]),
            ("UTF-16 without a mark", utf16(&text, false), &["high byte first"]),
        ];
        for (what, bytes, says) in cases {
            // Columns that fill whole digits are packed as they are padded, and one column is golden.
            let whole = rows[0].iter().all(|(_, width, _)| width % 4 == 0);
            let path = golden.keep.path().join(name);
            std::fs::write(&path, &bytes).unwrap();
            let report = dump::compare(&sets[0], &path, None, 20)
                .unwrap_or_else(|error| panic!("{name} {what}: {error}"));
            assert_eq!((report.total, report.rows), (0, rows.len() as u64), "{name} {what}");
            let said = report.assumed.join("\n");
            for say in says.iter().filter(|say| !(whole && **say == "side by side")) {
                assert!(said.contains(say), "{name} {what}: {said:?}");
            }
            assert_eq!(said.is_empty(), says.is_empty(), "{name} {what}: {said:?}");
            // The last digit of the last row is another one, in whatever form.
            let at = bytes.iter().rposition(u8::is_ascii_hexdigit).unwrap();
            let mut spoilt = bytes.clone();
            spoilt[at] = if bytes[at] == b'0' { b'1' } else { b'0' };
            std::fs::write(&path, &spoilt).unwrap();
            let report = dump::compare(&sets[0], &path, None, 20);
            // A key that is another one leaves a row over and one missing.
            let wrong = report.unwrap_or_else(|error| panic!("{name} {what}: {error}"));
            assert!((1..=2).contains(&wrong.total), "{name} {what}: {}", wrong.total);
            let lines = String::from_utf8_lossy(&bytes).matches('\n').count() as u64;
            assert_eq!(
                wrong.mismatches[wrong.mismatches.len() - 1].line.unwrap_or(lines),
                lines,
                "{name} {what}"
            );
        }
        // An image that leaves rows out, and a header that lacks a column.
        for (bad, says) in [
            (format!("@1\n{memory}"), "goes on at row 1, but 0 rows are before it"),
            (format!("{}@ff\n{memory}", memory.split_inclusive('\n').next().unwrap()), "1 rows"),
            (format!("{},time\n0,0\n", names[0]), "the header has no column"),
            (format!("{0},{0}\n", names.join(",")), "times"),
        ] {
            let error = golden.compare(name, &bad).unwrap_err().to_string();
            assert!(error.contains(says), "{name}: {error}");
        }
    }
}

/// Clause N-13: a dump of another unit or of another set says whose it is, and one file of several that a device
/// answers says which are left.
#[test]
fn a_dump_of_another_origin_says_so() {
    let home = tempfile::tempdir().unwrap();
    let requests = ["tiny", "d3d11", "sgi-4k"].map(|name| request(&profile(name), "triangle"));
    write::write(&requests, home.path(), true, &options(300), &Monitor::default()).unwrap();
    let open = |name: &str| check::open(&home.path().join(name)).unwrap().0.remove(0);
    let (tiny, sgi) = (open("tiny"), open("sgi-4k"));
    let compare = |set, folder: &str, name: &str, file: Option<&str>| {
        dump::compare(set, &home.path().join(folder).join(name), file, 20)
    };
    // Another unit.
    let error = compare(&sgi, "sgi-4k", "edge.exp.tv", Some("dda.exp")).unwrap_err().to_string();
    assert!(
        error.contains("edge.exp.tv:1: ")
            && error.contains("the columns of edge.exp.tv, not of dda.exp.tv"),
        "{error}"
    );
    // Another set: of other widths, and of the same.
    let error = compare(&tiny, "sgi-4k", "dda.exp.tv", None).unwrap_err().to_string();
    assert!(error.contains("dda.exp.tv:1: "), "{error}");
    let report = compare(&sgi, "d3d11", "triangle.exp.tv", None).unwrap();
    let origin = report.origin.unwrap();
    assert!(
        origin.contains("rows are those of the set d3d11 in ")
            && origin.contains("not with sgi-4k"),
        "{origin}"
    );
    // Half of what the engine answers.
    let report = compare(&tiny, "tiny", "span.exp.tv", None).unwrap();
    assert_eq!((report.total, report.origin), (0, None));
    assert_eq!(report.others, ["triangle.exp.tv", "depth.exp.tv"]);
    assert!(compare(&tiny, "tiny", "dda.exp.tv", None).unwrap().others.is_empty());
}

#[test]
fn mismatches_are_counted_beyond_those_kept() {
    let golden = Golden::named("tiny", 1000);
    let stepper = Stepper { slip: Slip::Negated, ..Stepper::depth(Reader::of(&golden.profile)) };
    let path = golden.dump("dda.exp.tv", &golden.walked("dda", stepper));
    let (sets, _) = check::open(&golden.set.folder()).unwrap();
    let totals: Vec<(usize, u64)> = [1, 5, 100_000]
        .into_iter()
        .map(|most| {
            let report = dump::compare(&sets[0], &path, None, most).unwrap();
            (report.mismatches.len(), report.total)
        })
        .collect();
    let total = totals[2].1;
    assert!(total > 100);
    assert_eq!(totals, [(1, total), (5, total), (usize::try_from(total).unwrap(), total)]);
}

#[cfg(feature = "cli")]
mod command {
    use super::*;
    use run::run_in;

    #[test]
    fn a_changed_set_ends_with_status_1_or_2_and_its_place() {
        let golden = write_set(&profile("tiny"), "triangle", &options(100));
        let ran = run_in(&golden.folder(), "verify .").ends(0);
        assert!(ran.out.contains("PASS: ") && ran.err.is_empty(), "{} {}", ran.out, ran.err);
        run_in(&golden.folder(), "verify . --recompute --threads 2").ends(0);
        for (name, bytes) in tree(&golden.folder()) {
            let mut damaged = bytes.clone();
            let middle = bytes.len() / 2;
            damaged[middle] = if bytes[middle] == b'0' { b'1' } else { b'0' };
            std::fs::write(golden.file(&name), &damaged).unwrap();
            let ran = run_in(&golden.folder(), "verify .");
            if ran.status == Some(2) {
                let ran = ran.complains(2, &[&format!("{name}:")]);
                assert_eq!(name, "manifest.json", "{}", ran.err);
            } else {
                let ran = ran.ends(1);
                let place = format!("{name}:{}: ", first_line(&bytes, &damaged));
                assert!(name == "manifest.json" || ran.out.contains(&place), "{}", ran.out);
                assert!(ran.out.contains(&name) && ran.out.contains("FAIL: 1 findings"));
            }
            std::fs::write(golden.file(&name), &bytes).unwrap();
        }
        run_in(&golden.folder(), "verify . --profile tiny").ends(0);
        let ran = run_in(&golden.folder(), "verify . --profile d3d11");
        ran.complains(2, &["manifest.json", "name = \"d3d11\""]);
        run_in(&golden.folder(), "verify . --profile none").complains(2, &["no profile \"none\""]);
        let home = tempfile::tempdir().unwrap();
        run_in(home.path(), "verify").complains(2, &["guardbit-vectors", "manifest.json"]);
        run_in(home.path(), "verify .").complains(2, &["manifest.json"]);
    }

    #[test]
    fn dumps_end_with_a_verdict_a_status_and_a_cause() {
        let golden = Golden::named("tiny", 2000);
        let (set, home) = (golden.set.folder(), golden.keep.path().to_owned());
        let set = set.display();
        let good = golden.set.text("dda.exp.tv");
        golden.dump("dda.exp.tv", &good);
        let ran = run_in(&home, &format!("verify {set} --dut dda.exp.tv")).ends(0);
        assert_eq!(ran.out, "PASS: 2000 rows of dda.exp.tv agree\n");
        let stepper =
            Stepper { slip: Slip::HoldSteps, ..Stepper::depth(Reader::of(&golden.profile)) };
        let bad = golden.walked("dda", stepper);
        golden.dump("run.txt", &bad);
        run_in(&home, &format!("verify {set} --dut run.txt")).complains(2, &["run.txt", "--file"]);
        let verify = format!("verify {set} --dut run.txt --file dda.exp.tv");
        let ran = run_in(&home, &verify).ends(1);
        let cause = "likely cause: operation of the DDA: a hold acts as a step right\n";
        assert!(ran.out.contains(cause), "{}", ran.out);
        let line = first_line(good.as_bytes(), bad.as_bytes());
        let first = ran.out.lines().next().unwrap();
        let place = format!("run.txt:{line} dda.exp.tv:{line} dda/");
        assert!(first.starts_with(&place), "{first}");
        let mismatches = |text: &str| text.lines().filter(|l| l.starts_with("run.txt:")).count();
        assert_eq!(mismatches(&ran.out), 20);
        for (errors, shown) in [(0, 0), (1, 1), (3, 3)] {
            let ran = run_in(&home, &format!("{verify} --errors {errors}")).ends(1);
            assert_eq!(mismatches(&ran.out), shown);
            assert!(ran.out.contains("FAIL: ") && ran.out.contains("likely cause"), "{}", ran.out);
        }
        golden.dump("edge.exp.tv", "");
        run_in(&home, &format!("verify {set} --dut edge.exp.tv"))
            .complains(2, &["edge.exp.tv: the dump has no rows"]);
        golden.dump("edge.exp.tv", "0_00_0\nhello\n");
        run_in(&home, &format!("verify {set} --dut edge.exp.tv"))
            .complains(2, &["edge.exp.tv:2: "]);
        run_in(&home, &format!("verify {set} --dut none.exp.tv --file dda.exp"))
            .complains(3, &["none.exp.tv"]);
        for (name, kept) in [("dda.exp.tv", 500), ("span.exp.tv", 20)] {
            let text = golden.set.text(name);
            let lines: Vec<&str> = text.lines().take(kept).collect();
            golden.dump(name, &lines.join("\n"));
            let ran = run_in(&home, &format!("verify {set} --dut {name}")).ends(1);
            assert!(ran.out.contains("stopped early"), "{}", ran.out);
        }
    }
}
