//! Conservative coverage on the command line: refusals, proofs, causes. Spec chapter 27.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run::run_in;
use guardbit::exact::Square;
use guardbit::explore::prove::{Overrides, Question, prove};
use guardbit::profile::{Profile, load, parse};
use std::path::Path;

const TABLE: &str = "[form.edge-function.conservative]\nmode = \"outer\"\ngrow = 2\n";

/// `tiny` with a table behind its edge words, and other changes.
fn tiny(table: &str, changes: &[[&str; 2]]) -> String {
    let mut text = load("tiny").unwrap().to_toml().replace("[depth]", &format!("{table}\n[depth]"));
    for [old, new] in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    text
}

fn profile(table: &str, changes: &[[&str; 2]]) -> Profile {
    parse(&tiny(table, changes), "tiny.toml").unwrap()
}

// Clauses CR-1, CR-4, CR-7
#[test]
fn what_squares_do_not_go_with_is_refused_at_its_line() {
    let tiles = tiny(TABLE, &[]).replace("[form.edge-function", "[form.tiles.edge");
    let tiles = tiles.replace("[form.tiles.edge]", "[form.tiles]\ntile = 2\n\n[form.tiles.edge]");
    assert!(parse(&tiles, "tiles.toml").unwrap().conservative().is_some());
    let per_pixel = tiny(TABLE, &[]).replace("edge-function", "engine-per-pixel");
    let shares = "[form.barycentric]\nwalk-fraction = 4\ncoordinate = 8\nrounding = \"floor\"\n";
    let barycentric = tiles
        .replace("[form.tiles]\ntile = 2\n", shares)
        .replace("[form.tiles.", "[form.barycentric.");
    let sample = "[sample]\nx = 0\ny = 0\n";
    let several = "[multisample]\nsamples = 4\ndepth = \"centre\"\n";
    let fine = [["sub-pixel = 1", "sub-pixel = 4"], ["width = 6", "width = 20"]];
    for (text, field, reason) in [
        (
            tiny(&TABLE.replace("= 2", "= 5"), &[]),
            "conservative.grow",
            "grow <= 2^(sub-pixel + 1) = 4",
        ),
        (tiny(TABLE, &[]) + sample, "edge-function.conservative", "middle is (1, 1)"),
        (
            tiny(TABLE, &[["sub-pixel = 1", "sub-pixel = 0"]]) + sample,
            "conservative",
            "sub-pixel is 0",
        ),
        (
            tiny(TABLE, &fine) + several,
            "edge-function.conservative",
            "one answer for a whole pixel",
        ),
        (
            tiny(
                "[form.edge-function.conservative]\nmode = \"inner\"\ndegenerate = \"draw\"\n",
                &[],
            ),
            "conservative.degenerate",
            "no square lies in a triangle without area",
        ),
        (tiny(&TABLE.replace("outer", "both"), &[]), "conservative.mode", "`outer` or `inner`"),
        (per_pixel, "engine-per-pixel.conservative", "no bounding box"),
        (barycentric, "barycentric.edge.conservative", "misses squares that a side only touches"),
    ] {
        let error = parse(&text, "own.toml").unwrap_err().to_string();
        let line = error.split(':').nth(1).and_then(|line| line.parse::<usize>().ok()).unwrap();
        assert!(error.starts_with("own.toml:") && line > 1, "{error}");
        assert!(error.contains(field) && error.contains(reason), "{error}");
    }
    // A machine without edge words would draw something else, so there is none.
    let squares = profile(TABLE, &[]);
    assert!(squares.with_machine("tiles").unwrap().validate().is_ok());
    assert_eq!(squares.with_machine("edge-walk"), None);
    assert!(!squares.covers_exactly());
}

// Clause CR-7
#[test]
fn measures_of_samples_refuse_squares() {
    let home = Path::new(".");
    for line in [
        "compare d3d12-outer --scene triangle",
        "fit d3d12-inner --scene triangle",
        "explore d3d12-outer --scene triangle --vary guard=0..1 --no-speed",
    ] {
        run_in(home, line).complains(2, &["coverage is conservative", "clause C-2"]);
    }
}

// Clause CR-8
#[test]
fn a_proved_width_is_that_of_every_edge_and_pixel() {
    let points: Vec<[i128; 2]> = (0..81).map(|n| [n % 9, n / 9]).collect();
    for mode in ["outer", "inner"] {
        for grow in [0, 1, 3] {
            let table =
                format!("[form.edge-function.conservative]\nmode = \"{mode}\"\ngrow = {grow}\n");
            let profile = profile(&table, &[]);
            // Every edge of the field at the corner of every square that decides, in quarters of a sub-pixel
            // squared; the middle of pixel (x, y) is (2x + 1, 2y + 1) sub-pixels, the half side 1 + grow / 2.
            let (mut low, mut high) = (0, 0);
            for from in &points {
                for to in &points {
                    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
                    for n in 0..16 {
                        let [x, y] = [2 * (n % 4) + 1, 2 * (n / 4) + 1];
                        let corners = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(|[right, down]| {
                            let at = [2 * x + right * (2 + grow), 2 * y + down * (2 + grow)];
                            dx * (at[1] - 2 * from[1]) - dy * (at[0] - 2 * from[0])
                        });
                        let decides = if mode == "outer" {
                            corners.iter().max()
                        } else {
                            corners.iter().min()
                        };
                        let word = decides.unwrap().div_euclid(2);
                        (low, high) = (word.min(low), word.max(high));
                    }
                }
            }
            let bits = |low: i128, high: i128| {
                (1u32..64).find(|n| -(1i128 << (n - 1)) <= low && high < 1 << (n - 1)).unwrap()
            };
            let question = Question::new(&profile, Overrides::default()).unwrap();
            let proofs = prove(&question);
            let proved = |name: &str| proofs.iter().find(|proof| proof.claim == name).unwrap().bits;
            assert_eq!(proved("edge.full"), Some(bits(low, high)), "{mode} {grow}");
            let stored = bits(low.div_euclid(2), high.div_euclid(2));
            assert_eq!(proved("edge.stored"), Some(stored), "{mode} {grow}");
            assert_eq!(profile.exact_edge_width(), Some(stored), "{mode} {grow}");
        }
    }
}

// Clause CR-5
#[test]
fn a_growth_that_does_not_pay_for_the_snap_is_shown_at_a_triangle() {
    for (mode, snap, needed) in
        [("outer", "nearest-even", 1), ("outer", "floor", 2), ("inner", "ceiling", 2)]
    {
        let mut profile = load("d3d12-outer").unwrap();
        profile.window = guardbit::profile::WindowConfig { width: 64, height: 64 };
        for grow in 0..=needed {
            let mut text = profile.to_toml().replace("grow = 2", &format!("grow = {grow}"));
            text = text.replace("snap = \"nearest-even\"", &format!("snap = \"{snap}\""));
            if mode == "inner" {
                text = text.replace("\"outer\"", "\"inner\"").replace("\"draw\"", "\"cull\"");
            }
            let profile = parse(&text, "own.toml").unwrap();
            let proofs = prove(&Question::new(&profile, Overrides::default()).unwrap());
            let proof = proofs.iter().find(|proof| proof.claim == "conservative.snap").unwrap();
            assert_eq!((proof.bits, proof.given), (Some(needed), Some(grow)));
            assert_eq!(proof.sufficient, grow == needed);
            let witness = proof.witness.as_ref().unwrap();
            assert_eq!(witness.bits, grow.min(needed - 1));
            // Judged anew, in 1/32 of a sub-pixel: what the text says of the vertices before the snap.
            let moved = witness.expected.split_once("coordinate is ").unwrap().1;
            let (parts, way) = moved.split_once(" sub-pixel ").unwrap();
            let [part, whole] =
                [0, 1].map(|n| parts.split('/').nth(n).unwrap().parse::<i128>().unwrap());
            let by = if way.starts_with("larger") { 32 * part / whole } else { -32 * part / whole };
            let xy: [[i128; 2]; 3] = witness.triangle.clone().try_into().unwrap();
            let [real, snapped] = [by, 0].map(|by| xy.map(|v| v.map(|at| 32 * at + by)));
            let square = |halves: i128| Square {
                middle: witness.pixel.unwrap().map(|at| 32 * (256 * at + 128)),
                half_side: 32 * 128 + 16 * halves,
            };
            let grown = square(witness.bits.into());
            if mode == "outer" {
                assert!(square(0).touches(real) && !grown.touches(snapped), "{witness:?}");
            } else {
                assert!(grown.lies_in(snapped) && !square(0).lies_in(real), "{witness:?}");
            }
        }
    }
    // A triangle that the snap flattens is lost at any growth, if it is culled.
    let text = load("d3d12-outer").unwrap().to_toml().replace("\"draw\"", "\"cull\"");
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("culled.toml"), text).unwrap();
    let ran = run_in(home.path(), "prove culled.toml --claim conservative").ends(1);
    for says in ["TOO FEW", "degenerate = \"cull\"", "no area is left"] {
        assert!(ran.out.contains(says), "{says}: {}", ran.out);
    }
    run_in(home.path(), "prove d3d12-inner --claim conservative --window 64x64").ends(0);
}

// Clause CR-10
#[test]
fn a_set_of_squares_recomputes_and_names_what_a_device_did() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(home.path().join(name), text).unwrap();
    let draw = format!("{TABLE}degenerate = \"draw\"\n");
    write("own.toml", tiny(&draw, &[["width = 6", "width = 7"]]));
    let set = |profile: &str, out: &str| {
        let line = format!("vectors {profile} --scene fan --count 300 --out {out}");
        run_in(home.path(), &line).ends(0);
    };
    set("own.toml", "set");
    run_in(home.path(), "verify set --recompute").ends(0);
    let read = |name: &str| std::fs::read_to_string(home.path().join(name)).unwrap();
    assert!(read("set/manifest.json").contains("adds no offset for squares"));
    for (old, new, cause) in [
        ("grow = 2", "grow = 3", "conservative.grow is 3 instead of 2"),
        (
            "degenerate = \"draw\"",
            "degenerate = \"cull\"",
            "conservative.degenerate is cull instead of draw",
        ),
        (&*draw, "", "conservative is left out, so that samples decide instead of in force"),
    ] {
        let other = tiny(&draw, &[["width = 6", "width = 7"]]);
        assert!(other.contains(old), "{old}");
        write("other.toml", other.replace(old, new));
        set("other.toml", "other");
        std::fs::copy(home.path().join("other/setup.exp.tv"), home.path().join("setup.dut.tv"))
            .unwrap();
        std::fs::remove_dir_all(home.path().join("other")).unwrap();
        let line = "verify set --dut setup.dut.tv --file setup.exp.tv";
        let ran = run_in(home.path(), line).ends(1);
        assert!(
            ran.out.contains(&format!("likely cause: form.edge-function.{cause}")),
            "{}",
            ran.out
        );
    }
}
