//! `verify --dut`: a device's defect is called by its name.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::device;
#[cfg(feature = "cli")]
use crate::run;
use crate::set;
use device::{Clocked, Drawer, Reader, Slip, Stepper};
use guardbit::bits::Rounding;
use guardbit::format::Clamp;
use guardbit::profile::{Form, Profile};
use guardbit::setup::Triangle;
use guardbit::vector::bench::{
    Rig, SetupBench, Source, TestBench, TriangleBench, WalkBench, WalkKind,
};
use guardbit::vector::check;
use guardbit::vector::device::Device;
use guardbit::vector::dump::{self, CompareError, DumpReport};
use guardbit::vector::emit;
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::SetRequest;
use set::{Set, options, profile, request, tree, write_set};
use std::path::PathBuf;
use tempfile::TempDir;

/// The first line, from 1, in which two contents differ.
pub(crate) fn first_line(a: &[u8], b: &[u8]) -> u64 {
    let lines = |bytes: &'_ [u8]| -> Vec<Vec<u8>> {
        bytes.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect()
    };
    let (a, b) = (lines(a), lines(b));
    (0..=a.len()).find(|n| a.get(*n) != b.get(*n)).unwrap() as u64 + 1
}

/// A set, and what its benches are made from.
pub(crate) struct Golden {
    pub(crate) set: Set,
    pub(crate) source: Source,
    pub(crate) profile: Profile,
    pub(crate) keep: TempDir,
}

impl Golden {
    pub(crate) fn of(request: SetRequest, count: u64) -> Self {
        let (profile, scene) = (request.profile.clone(), request.scene.clone());
        let values = std::sync::Arc::default();
        let source = Source { profile: profile.clone(), scene, values, seed: 1, count };
        let set = set::write_request(request, &options(count));
        Self { set, source, profile, keep: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn named(name: &str, count: u64) -> Self {
        Self::of(request(&profile(name), "fan"), count)
    }

    /// A file of the set as a device at a bench answers it.
    pub(crate) fn answered<B: TestBench>(
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
    pub(crate) fn walked(&self, stem: &str, stepper: Stepper) -> String {
        let kind = if stem == "dda" { WalkKind::Depth } else { WalkKind::Edge };
        let bench = WalkBench::new(kind, &self.source).unwrap();
        self.answered(&format!("{stem}.exp.tv"), &bench, Clocked::new(stepper))
    }

    /// The whole file as a drawing device answers it.
    pub(crate) fn drawn(&self, name: &str, drawer: &Drawer) -> String {
        if name == "setup.exp.tv" {
            self.answered(name, &SetupBench::new(&self.source), *drawer)
        } else {
            self.answered(name, &TriangleBench::new(&self.source), *drawer)
        }
    }

    pub(crate) fn dump(&self, name: &str, text: &str) -> PathBuf {
        let path = self.keep.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    }

    pub(crate) fn compare(&self, name: &str, text: &str) -> Result<DumpReport, CompareError> {
        let (sets, _) = check::open(&self.set.folder()).unwrap();
        dump::compare(&sets[0], &self.dump(name, text), None, 20)
    }

    /// A dump that disagrees: the first divergence is the first there is, and is shown.
    pub(crate) fn disagrees(&self, name: &str, text: &str) -> DumpReport {
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

    /// What goes wrong of a stepper with each of these slips.
    fn blames_slips(&self, stem: &str, right: Stepper, slips: &[(Slip, &str)]) -> Vec<String> {
        let wrong = slips.iter().filter_map(|(slip, cause)| {
            let stepper = Stepper { slip: *slip, ..right };
            self.blames(&format!("{stem}.exp.tv"), &self.walked(stem, stepper), cause)
        });
        wrong.collect()
    }

    /// Whether the defect shows and its cause is among those named; else what went wrong.
    pub(crate) fn blames(&self, name: &str, text: &str, cause: &str) -> Option<String> {
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
pub(crate) const PROFILES: [(&str, u64); 3] = [("tiny", 4300), ("sgi-4k", 6000), ("d3d11", 6000)];

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
        faults.extend(golden.blames_slips(
            "dda",
            Stepper::depth(right),
            &[
                (Slip::Late, "each row shows the state before its clock edge"),
                (Slip::LateOut, "the read-out lags the accumulator by one clock"),
                (Slip::Swapped, "dx and dy are exchanged"),
                (Slip::HoldSteps, "a hold acts as a step right"),
                (Slip::Negated, "subtracted where added belongs"),
                (Slip::OnlyX, "a step down acts as a step right"),
                (Slip::RoundsOut, "rounded to nearest, where the fraction belongs"),
                (Slip::WrongEnd, "zero and the maximum are exchanged"),
            ],
        ));
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
        faults.extend(golden.blames_slips(
            "edge",
            right,
            &[
                (Slip::Late, "each row shows the state before its clock edge"),
                (Slip::LateOut, "the sign test lags the edge word by one clock"),
                (Slip::Swapped, "dx and dy are exchanged"),
                (Slip::HoldSteps, "a hold acts as a step right"),
                (Slip::Negated, "subtracted where added belongs"),
                (Slip::OnlyX, "a step down acts as a step right"),
                (Slip::ZeroOutside, "the sign test of an edge word: > instead of >="),
                (Slip::Inverted, "the sign test of an edge word: < instead of >="),
            ],
        ));
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// What makes a right device a wrong one, the files in which it shows, and what it is called.
type Defect<'a> = (&'a dyn Fn(&mut Drawer), &'a [&'a str], String);

// A test a profile: they take longest of all, and run beside each other.
#[test]
fn defects_of_set_up_and_drawing_are_called_by_name() {
    called_by_name(PROFILES[0]);
}

#[test]
fn defects_of_set_up_and_drawing_in_sgi_4k_are_called_by_name() {
    called_by_name(PROFILES[1]);
}

#[test]
fn defects_of_set_up_and_drawing_in_d3d11_are_called_by_name() {
    called_by_name(PROFILES[2]);
}

#[track_caller]
fn called_by_name((name, count): (&str, u64)) {
    let all = &["setup.exp.tv", "span.exp.tv", "depth.exp.tv"][..];
    let (set_up, spans, depths) = (&all[..1], &all[1..2], &all[2..]);
    let (covers, values, draws) = (all, &["setup.exp.tv", "depth.exp.tv"][..], &all[1..]);
    let mut faults: Vec<String> = Vec::new();
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
    assert!(faults.is_empty(), "{faults:#?}");
}

/// What holds in the rows that differ: the winding of their triangles, and the side of the box that rows too
/// many lie beside.
#[test]
fn rows_that_differ_say_what_they_have_in_common() {
    let golden = Golden::named("tiny", 3000);
    let (cfg, exp) = (golden.set.text("setup.cfg.tv"), golden.set.text("setup.exp.tv"));
    let signed = golden.profile.vertex.signed;
    let turned = cfg.lines().zip(exp.lines()).map(|(cfg, exp)| {
        let words: Vec<i64> =
            cfg.split('_').map(|word| i64::from_str_radix(word, 16).unwrap()).collect();
        assert!(!signed);
        let [a, b, c] = [0, 3, 6].map(|k| [words[k], words[k + 1]]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        let mut words: Vec<String> = exp.split('_').map(str::to_owned).collect();
        if area < 0 {
            let depth_dx = u64::from_str_radix(&words[10], 16).unwrap();
            words[10] = format!("{:0width$x}", depth_dx ^ 1, width = words[10].len());
        }
        words.join("_") + "\n"
    });
    let report = golden.compare("setup.exp.tv", &turned.collect::<String>()).unwrap();
    let [differs] = &report.observed.differ[..] else { panic!("{:?}", report.observed) };
    assert_eq!(differs.column, "depth_dx");
    let fact = "exactly where the triangle's area is negative";
    assert!(differs.facts.iter().any(|known| known == fact), "{:?}", differs.facts);

    // A sample more at the end of each row of a box.
    let boxes: std::collections::BTreeMap<u64, u64> = golden
        .set
        .text("triangle.cfg.tv")
        .lines()
        .map(|line| {
            let words: Vec<&str> = line.split('_').collect();
            let number = |word: &str| u64::from_str_radix(word, 16).unwrap();
            (number(words[0]), number(words[words.len() - 1]))
        })
        .collect();
    let depths = golden.set.text("depth.exp.tv");
    let more = depths.lines().map(|line| {
        let words: Vec<&str> = line.split('_').collect();
        let number = |word: &str| u64::from_str_radix(word, 16).unwrap();
        let end = boxes[&number(words[0])];
        if number(words[2]) + 1 < end {
            return format!("{line}\n");
        }
        let beyond = format!("{:0width$x}", end, width = words[2].len());
        format!("{line}\n{}_{}_{beyond}_{}\n", words[0], words[1], words[3])
    });
    let report = golden.compare("depth.exp.tv", &more.collect::<String>()).unwrap();
    assert!(report.observed.extra > 2);
    assert_eq!(report.observed.extra_facts, ["each beside the right side of its box"]);
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
                assert!(ran.out.contains(&name) && ran.out.contains("FAIL: 1 finding"));
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
