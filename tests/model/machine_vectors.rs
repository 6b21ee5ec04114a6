//! Golden sets of every machine, of lines, points and several samples a pixel: written, verified,
//! recomputed, and a defect in them found.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::cover::{DepthAt, LineConfig, LineRule, MultisampleConfig, PointConfig};
use guardbit::profile::{Profile, WindowConfig, load, parse, triangle_machines};
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

fn guardbit(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_guardbit"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn good(folder: &Path, arguments: &[&str]) -> String {
    let output = guardbit(folder, arguments);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stderr}");
    String::from_utf8(output.stdout).unwrap()
}

/// Writes a set of a profile into `set`.
fn write(folder: &Path, profile: &Profile) {
    std::fs::write(folder.join("profile.toml"), profile.to_toml()).unwrap();
    let common = ["vectors", "profile.toml", "--out", "set", "--count", "3000", "--force"];
    good(folder, &common);
    good(folder, &["verify", "set", "--recompute"]);
}

/// The runs of a set from its first directed triangle on, by the number of the test among these: a plain
/// engine has set-up words before them, and a core of both.
fn spans_of_triangles(set: &Path) -> String {
    let text = std::fs::read_to_string(set.join("manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&text).unwrap();
    let groups = manifest["groups"].as_array().unwrap().iter();
    let before = groups
        .filter(|group| group["bench"] == "triangle")
        .take_while(|group| group["tag"] != "all-bits");
    let first: u64 = before.map(|group| group["tests"].as_u64().unwrap()).sum();
    let rows = std::fs::read_to_string(set.join("span.exp.tv")).unwrap();
    let numbered = rows.lines().filter_map(|row| {
        let (test, rest) = row.split_once('_').unwrap();
        let test = u64::from_str_radix(test, 16).unwrap().checked_sub(first)?;
        Some(format!("{test:08x}_{rest}\n"))
    });
    numbered.collect()
}

/// Every machine has a set that verifies, and its triangle files agree with those of edge functions
/// where the machine is exact.
#[test]
fn every_machine_has_a_golden_set() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut spans = None;
    for machine in triangle_machines().map(|kind| kind.name) {
        let mut profile = load("sgi-4k").unwrap().with_machine(machine).unwrap();
        profile.window = WindowConfig { width: 256, height: 256 };
        write(folder, &profile);
        let span = spans_of_triangles(&folder.join("set"));
        if profile.covers_exactly() {
            assert_eq!(spans.get_or_insert_with(|| span.clone()), &span, "{machine}");
        }
        let traced = good(folder, &["trace", "profile.toml", "--test", "triangle/slivers/0"]);
        assert!(traced.contains("triangle.cfg") && traced.contains("span.exp"), "{traced}");
        // A device without the profile's rounding, or rule, is told by name.
        let mut wrong = profile.clone();
        if let Some(depth) = wrong.depth.as_mut() {
            depth.rounding = guardbit::bits::Rounding::Floor;
        }
        std::fs::write(folder.join("wrong.toml"), wrong.to_toml()).unwrap();
        good(folder, &["vectors", "wrong.toml", "--out", "wrong", "--count", "3000", "--force"]);
        let ran =
            guardbit(folder, &["verify", "set", "--dut", "wrong/setup.exp.tv", "--errors", "1"]);
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        if machine == "barycentric" {
            // Its shares are rounded by a field of its own.
            assert_eq!(ran.status.code(), Some(0), "{text}");
        } else {
            assert_eq!(ran.status.code(), Some(1), "{machine}: {text}");
            assert!(text.contains("depth.rounding is floor"), "{machine}: {text}");
        }
    }
}

/// Quadrilaterals and homogeneous triangles have benches on the machines that draw them, and a rule
/// or a rounding that differs is named.
#[test]
fn quadrilaterals_and_homogeneous_triangles_have_golden_sets() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (machine, kind, has_depth) in
        [("gouraud", "quad", true), ("scanline", "quad", false), ("homogeneous", "clip", true)]
    {
        let mut profile = load("sgi-4k").unwrap().with_machine(machine).unwrap();
        profile.window = WindowConfig { width: 64, height: 64 };
        write(folder, &profile);
        let rows = |file: &str| {
            let path = folder.join("set").join(file);
            std::fs::read_to_string(path).map_or(0, |text| text.lines().count())
        };
        assert!(rows(&format!("{kind}.cfg.tv")) > 10 && rows(&format!("{kind}.exp.tv")) > 100);
        assert_eq!(rows(&format!("{kind}-depth.exp.tv")) > 100, has_depth, "{machine}");
        let class = if kind == "quad" { "concave" } else { "behind" };
        let test = format!("{kind}/{class}/0");
        let traced = good(folder, &["trace", "profile.toml", "--test", &test]);
        assert!(traced.contains(kind) && traced.contains(".cfg"), "{traced}");
        let mut wrong = profile.clone();
        let cause = match &mut wrong.form {
            guardbit::profile::Form::Gouraud(_) => {
                wrong.depth.as_mut().unwrap().rounding = guardbit::bits::Rounding::Floor;
                "depth.rounding is floor"
            }
            guardbit::profile::Form::Scanline(scanline) => {
                scanline.rule = guardbit::cover::FillRule::Shadow;
                "form.scanline.rule is shadow"
            }
            guardbit::profile::Form::Homogeneous(machine) => {
                machine.rule = guardbit::cover::FillRule::Shadow;
                "form.homogeneous.rule is shadow"
            }
            other => panic!("{}", other.name()),
        };
        std::fs::write(folder.join("wrong.toml"), wrong.to_toml()).unwrap();
        good(folder, &["vectors", "wrong.toml", "--out", "wrong", "--count", "3000", "--force"]);
        let file = if machine == "gouraud" { "quad-depth" } else { kind };
        let dump = format!("wrong/{file}.exp.tv");
        let ran = guardbit(folder, &["verify", "set", "--dut", &dump, "--errors", "1"]);
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{machine}: {text}");
        assert!(text.contains(cause), "{machine}: {text}");
    }
}

/// Lines and points have benches where a profile states their rules, and another rule is named.
#[test]
fn lines_and_points_have_golden_sets() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut profile = load("d3d11").unwrap();
    profile.window = WindowConfig { width: 256, height: 256 };
    write(folder, &profile);
    for file in ["line.cfg.tv", "line.exp.tv", "point.cfg.tv", "point.exp.tv"] {
        assert!(
            std::fs::read_to_string(folder.join("set").join(file)).unwrap().lines().count() > 20
        );
    }
    let traced = good(folder, &["trace", "profile.toml", "--test", "line/octants/1"]);
    assert!(traced.contains("line ("), "{traced}");
    let mut wrong = profile.clone();
    wrong.line = Some(LineConfig { rule: LineRule::DiamondVulkan, stipple: None });
    wrong.point = Some(PointConfig::default());
    std::fs::write(folder.join("wrong.toml"), wrong.to_toml()).unwrap();
    good(folder, &["vectors", "wrong.toml", "--out", "wrong", "--count", "3000"]);
    for (file, cause) in
        [("line.exp.tv", "line.rule is diamond-vulkan"), ("point.exp.tv", "point.rule is pixel")]
    {
        let dump = format!("wrong/{file}");
        let ran = guardbit(folder, &["verify", "set", "--dut", &dump, "--errors", "1"]);
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{text}");
        assert!(text.contains(cause), "{text}");
    }
    // A profile without the tables has no such files.
    let mut plain = load("sgi-4k").unwrap();
    plain.window = WindowConfig { width: 256, height: 256 };
    write(folder, &plain);
    assert!(!folder.join("set/line.cfg.tv").exists());
}

/// Several samples a pixel: masks, depth by pixel or by sample, both verified.
#[test]
fn several_samples_have_golden_sets() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (depth, columns) in [(DepthAt::Centre, 4), (DepthAt::Sample, 5)] {
        let mut profile = load("sgi-4k").unwrap();
        profile.window = WindowConfig { width: 128, height: 128 };
        profile.multisample = Some(MultisampleConfig::standard(4, depth));
        write(folder, &profile);
        let first = |file: &str| {
            let text = std::fs::read_to_string(folder.join("set").join(file)).unwrap();
            text.lines().next().unwrap().split('_').count()
        };
        assert_eq!((first("depth.exp.tv"), first("mask.exp.tv")), (columns, 4));
        // One wrong mask is one mismatch.
        let path = folder.join("set/mask.exp.tv");
        let text = std::fs::read_to_string(&path).unwrap();
        let last = if text.ends_with("f\n") { '7' } else { 'f' };
        let broken = format!("{}{last}\n", &text[..text.len() - 2]);
        std::fs::write(folder.join("dump.mask.exp.tv"), broken).unwrap();
        let ran = guardbit(
            folder,
            &["verify", "set", "--dut", "dump.mask.exp.tv", "--file", "mask.exp.tv"],
        );
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{text}");
        assert!(text.contains("1 mismatches"), "{text}");
    }
}

/// Clause S-5: every built-in profile has a set that is made again from its own files, its scene among them,
/// and no triangle of a scene that fills the depth range is left out.
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn every_built_in_profile_has_a_set_that_recomputes() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, _) in guardbit::profile::BUILTIN {
        let set = ["vectors", name, "--scene", "fan", "--out", "set", "--count", "400", "--force"];
        let ran = guardbit(folder, &set);
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!((ran.status.code(), stderr.contains("left out")), (Some(0), false), "{stderr}");
        good(folder, &["verify", "set", "--recompute"]);
    }
}

/// What a device of another profile answers to the words of a set.
struct Device<'a> {
    model: &'a guardbit::model::Model,
    kind: usize,
    test: &'a str,
    text: String,
}

impl guardbit::machine::Sink for Device<'_> {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn record(&mut self, kind: usize, values: &[i64]) {
        if kind != self.kind {
            return;
        }
        self.text += self.test;
        for word in self.model.registers().unwrap().records[kind].words(values) {
            write!(self.text, "_{word:08x}").unwrap();
        }
        self.text.push('\n');
    }
}

/// Machines that begin at registers: a set that verifies, a trace by register names, and a defect in each
/// engine and in channels told by name.
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn register_machines_have_golden_sets() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let defects = [
        (
            "ps1",
            "halves = \"from-anchor\"",
            "halves = \"upper-first\"",
            "anchored.halves is upper-first",
        ),
        ("ps1", "rounding = \"toward-zero\"", "rounding = \"floor\"", "anchored.rounding is floor"),
        (
            "ps1-rtl",
            "anchor = \"leftmost-sorted\"",
            "anchor = \"leftmost-given\"",
            "leftmost-given",
        ),
        ("vortex", "width = 32", "width = 31", "quads.width is 31 instead of 32"),
        ("psp", "rule = \"truncated-side\"", "rule = \"both\"", "quads.rule is both"),
        ("psp", "[sample]\nx = 7", "[sample]\nx = 8", "sample is (8, 7) instead of (7, 7)"),
        ("voodoo", "pixel-bias = 0x7000", "pixel-bias = 0x6fff", "pixel-bias is 28671"),
        ("voodoo", "row-bias = 7", "row-bias = 8", "row-bias is 8 instead of 7"),
        ("voodoo", "start = \"zero\"", "start = \"sign\"", "channels (r, g, b, a): start is sign"),
        ("virge", "shift-along = 0", "shift-along = 1", "channels (z): shift-along is 1"),
        ("virge", "clip = \"closed\"", "clip = \"half-open\"", "slopes.clip is half-open"),
        (
            "n64",
            "drop = 5, correction = 2",
            "drop = 0, correction = 2",
            "channels (r, g, b, a): drop is 0",
        ),
        (
            "n64",
            "clamp = \"guard\", width",
            "clamp = \"wrap\", width",
            "(r, g, b, a): clamp is wrap",
        ),
        ("n64", "correction = 3", "correction = 2", "channels (z): correction is 2"),
        (
            "n64-rtl",
            "signed-distance = true",
            "signed-distance = false",
            "signed-distance is false",
        ),
        ("rasterix", "\"zigzag\"", "\"serpentine\"", "order is serpentine instead of zigzag"),
        ("picogs", "beyond-box = true", "beyond-box = false", "order.beyond-box is false"),
        ("picogs", "replicate = 12", "replicate = 11", "(r, g, b, a): replicate is 11"),
        ("graphite", "try-first = true", "try-first = false", "box.try-first is false"),
        ("graphite", "scale = 63", "scale = 64", "channels (g): scale is 64 instead of 63"),
        ("projf-line", "\"together\"", "\"x-first\"", "lines.stepper.shared.looks is x-first"),
        ("projf-fill", "\"both-ahead\"", "\"upper\"", "lines.draws.fill.middle is upper"),
        ("saturn-line", "unlike = \"y\"", "unlike = \"x\"", "lines.filler.unlike is x"),
    ];
    let mut written = "";
    for (name, from, to, cause) in defects {
        let profile = load(name).unwrap();
        let text = good(folder, &["profile", "show", name]);
        assert!(text.contains(from), "{name}: {from}");
        if written != name {
            written = name;
            std::fs::write(folder.join("profile.toml"), profile.to_toml()).unwrap();
            let set = ["vectors", "profile.toml", "--out", "set", "--count", "1500", "--force"];
            good(folder, &set);
            good(folder, &["verify", "set", "--recompute"]);
        }
        let wrong = parse(&text.replacen(from, to, 1), "wrong").unwrap();
        let model = guardbit::model::Model::new(&wrong).unwrap();
        // The last kind of record is that of pixels or quads.
        let kind = model.registers().unwrap().records.len() - 1;
        let mut device = Device { model: &model, kind, test: "", text: String::new() };
        let cfg = std::fs::read_to_string(folder.join("set/words.cfg.tv")).unwrap();
        for row in cfg.lines() {
            let (test, words) = row.split_once('_').unwrap();
            let words: Vec<u32> =
                words.split('_').map(|word| u32::from_str_radix(word, 16).unwrap()).collect();
            device.test = test;
            model.draw(words.as_slice(), &mut device).unwrap();
        }
        std::fs::write(folder.join("dump.tv"), device.text).unwrap();
        let pixels = if name == "vortex" { "words-q.exp.tv" } else { "words-p.exp.tv" };
        let ran = guardbit(
            folder,
            &["verify", "set", "--dut", "dump.tv", "--file", pixels, "--errors", "1"],
        );
        let text = String::from_utf8_lossy(&ran.stdout).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{name}, {to}: {text}");
        assert!(text.contains(cause), "{name}, {to}: {text}");
        let traced = good(folder, &["trace", "profile.toml", "--test", "words/slivers/0"]);
        assert!(traced.contains("words.cfg (1 rows)"), "{traced}");
    }
}
