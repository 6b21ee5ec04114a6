//! `guardbit identify`: a device on a pipe, cases in a file, and what they may be.
#![allow(clippy::cast_precision_loss, reason = "parts of the window")]

use crate::run::{guardbit, pipe_in, run_in};
use std::fmt::Write as _;
use std::path::Path;

/// A hidden profile in a folder: sgi-4k without depth, changed.
fn hide(folder: &Path, changes: &[[&str; 2]]) {
    let mut text = guardbit::profile::load("sgi-4k").unwrap().to_toml();
    text.truncate(text.find("[depth]").unwrap());
    for [old, new] in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    std::fs::write(folder.join("hidden.toml"), text).unwrap();
    let base = guardbit::profile::load("sgi-4k").unwrap().to_toml();
    std::fs::write(folder.join("base.toml"), &base[..base.find("[depth]").unwrap()]).unwrap();
}

/// What the hidden profile answers to lines, joined with them.
fn capture(folder: &Path, lines: &[String]) -> Vec<serde_json::Value> {
    let ran = pipe_in(folder, "eval hidden.toml --window 32x32", &lines.join("\n"));
    let answers = ran.out;
    let joined = lines.iter().zip(answers.lines()).map(|(line, answer)| {
        let mut case: serde_json::Value = serde_json::from_str(line).unwrap();
        let answer: serde_json::Value = serde_json::from_str(answer).unwrap();
        case["rows"] = answer["rows"].clone();
        case
    });
    joined.collect()
}

/// Triangles on a grid of 1/64 pixel, away from the ends of the window, by a fixed rule.
fn triangles(count: u64) -> Vec<String> {
    let line = |n: u64| {
        let mut words = guardbit::case::Words::new(11, 0, n);
        let mut at = || {
            let [x, y] = [0; 2].map(|_| (384 + words.draw() % 1280) as f64 / 64.0);
            format!("[{x},{y}]")
        };
        format!("{{\"id\": {n}, \"f\": [{}, {}, {}]}}", at(), at(), at())
    };
    (0..count).map(line).collect()
}

fn write(folder: &Path, name: &str, cases: &[serde_json::Value]) {
    let mut text = String::new();
    for case in cases {
        writeln!(text, "{case}").unwrap();
    }
    std::fs::write(folder.join(name), text).unwrap();
}

const IDENTIFY: &str = "identify --base base.toml --window 32x32";

/// Clauses ID-1, ID-3, ID-6 and ID-7: a black box is named, and its cases name it again.
#[test]
fn a_device_on_a_pipe_is_named() {
    let home = tempfile::tempdir().unwrap();
    let changes =
        [["sub-pixel = 10", "sub-pixel = 4"], ["snap = \"nearest-even\"", "snap = \"floor\""]];
    hide(home.path(), &changes);
    let program = env!("CARGO_BIN_EXE_guardbit");
    let device = format!("{program} eval hidden.toml --window 32x32");
    let output = guardbit()
        .args(IDENTIFY.split(' '))
        .args(["--device", &device, "--save", "cases.jsonl", "--json", "--profile-out", "p.toml"])
        .current_dir(home.path())
        .output()
        .unwrap();
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(report["machines"].as_u64().unwrap() > 100_000, "{report}");
    for (name, value) in
        [("sub-pixel", "4"), ("sample", "(1/2, 1/2) of a pixel"), ("rule", "top-left")]
    {
        assert_eq!(report["decided"][name], serde_json::json!([value]), "{name}");
    }
    // No coordinate of the window is negative.
    assert_eq!(report["decided"]["snap"], serde_json::json!(["floor", "toward-zero"]));
    assert!(report["cases"].as_u64().unwrap() <= 16, "{report}");
    assert!(report["stopped"].is_null(), "{report}");
    let profile = guardbit::profile::load(home.path().join("p.toml").to_str().unwrap()).unwrap();
    assert_eq!((profile.vertex.sub_pixel, profile.window.width), (4, 32));
    let ran = run_in(home.path(), &format!("{IDENTIFY} --cases cases.jsonl --next")).ends(0);
    assert!(ran.out.contains("nothing more to draw"), "{}", ran.out);
    assert!(ran.out.contains("sub-pixel            4\n"), "{}", ran.out);
    // A space without the machine: nothing fits, and the cases that show it are named.
    let ran = run_in(home.path(), &format!("{IDENTIFY} --cases cases.jsonl --vary sub-pixel=5..8"));
    let ran = ran.ends(1);
    assert!(ran.out.starts_with("nothing fits"), "{}", ran.out);
    assert!(ran.out.contains("cases.jsonl: line "), "{}", ran.out);
}

/// Clauses ID-2, ID-4 and ID-5: pictures that are moved, mirrored, cut or wrong.
#[test]
fn cases_may_be_moved_partly_known_and_wrong() {
    let home = tempfile::tempdir().unwrap();
    hide(home.path(), &[["sub-pixel = 10", "sub-pixel = 3"]]);
    let mut cases = capture(home.path(), &triangles(12));
    write(home.path(), "good.jsonl", &cases);
    let identify = |rest: &str| run_in(home.path(), &format!("{IDENTIFY} --cases {rest}"));
    let good = identify("good.jsonl").ends(0).out;
    assert!(good.contains("sub-pixel            3\n"), "{good}");
    // Mirrored top to bottom, then one column to the right and one row up.
    let moved = cases.iter().map(|case| {
        let mut case = case.clone();
        let rows: Vec<[i64; 3]> = serde_json::from_value(case["rows"].clone()).unwrap();
        let moved = rows.iter().map(|[y, x0, x1]| [31 - y - 1, x0 + 1, x1 + 1]);
        case["rows"] = serde_json::json!(moved.collect::<Vec<_>>());
        case
    });
    write(home.path(), "moved.jsonl", &moved.collect::<Vec<_>>());
    identify("moved.jsonl").ends(1);
    let moved = identify("moved.jsonl --shift 1 --mirror").ends(0).out;
    assert!(moved.contains("sub-pixel            3\n"), "{moved}");
    assert!(
        moved.contains("picture              mirrored top to bottom, moved by (1, -1)\n"),
        "{moved}"
    );
    // A row that is not there is wrong, unless nothing is known about it.
    let row = cases[4]["rows"][0].clone();
    let [y, x0, x1]: [u32; 3] = serde_json::from_value(row).unwrap();
    cases[4]["rows"].as_array_mut().unwrap().remove(0);
    write(home.path(), "wrong.jsonl", &cases);
    let wrong = identify("wrong.jsonl --wrong 1").ends(0).out;
    assert!(wrong.contains("wrong, if it is this machine: wrong.jsonl: line 5\n"), "{wrong}");
    let none = identify("wrong.jsonl").ends(1).out;
    assert!(none.contains("wrong.jsonl: line 5\n"), "{none}");
    cases[4]["unknown"] = serde_json::json!([[x0, y, x1, y + 1]]);
    write(home.path(), "partly.jsonl", &cases);
    let partly = identify("partly.jsonl").ends(0).out;
    assert!(partly.contains("sub-pixel            3\n"), "{partly}");
    // A picture instead of rows.
    let mut pixels = vec![0u8; 32 * 32];
    for [y, x0, x1] in serde_json::from_value::<Vec<[usize; 3]>>(cases[1]["rows"].clone()).unwrap()
    {
        pixels[y * 32 + x0..y * 32 + x1].fill(200);
    }
    let file = std::fs::File::create(home.path().join("one.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 32, 32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    cases[1].as_object_mut().unwrap().remove("rows");
    cases[1]["png"] = "one.png".into();
    write(home.path(), "picture.jsonl", &cases);
    assert_eq!(identify("picture.jsonl").ends(0).out, partly);
    let small =
        run_in(home.path(), "identify --base base.toml --cases picture.jsonl --window 64x32");
    small.complains(2, &["one.png has 32 x 32 pixels, but the window has 64 x 32"]);
}

#[test]
fn what_is_no_case_is_refused_with_its_line() {
    let home = tempfile::tempdir().unwrap();
    hide(home.path(), &[]);
    let f = r#""f": [[1,1],[9,1],[1,9]]"#;
    for (line, says) in [
        (String::new(), "the file has no case"),
        ("[]".to_owned(), "line 1: a case is a JSON object"),
        ("{".to_owned(), "line 1: EOF"),
        (format!("{{{f}}}"), "a case has one answer"),
        (format!(r#"{{{f}, "rows": [], "out": []}}"#), "a case has one answer"),
        (format!(r#"{{{f}, "rows": [[40,1,2]]}}"#), "not in the window of 32 x 32"),
        (format!(r#"{{{f}, "rows": [[4,5,5]]}}"#), "not in the window"),
        (format!(r#"{{{f}, "rows": [[4,5,7]], "z": [1]}}"#), "fewer values than covered pixels"),
        (format!(r#"{{{f}, "rows": [[4,5,7]], "z": [1,2,3]}}"#), "more values than covered pixels"),
        (format!(r#"{{{f}, "rows": "no"}}"#), "line 1"),
        (format!(r#"{{{f}, "png": "none.png"}}"#), "none.png"),
        (r#"{"v": [[1,1],[9,1],[1,9]], "rows": []}"#.to_owned(), "--lattice"),
        (r#"{"rows": []}"#.to_owned(), "line 1"),
    ] {
        std::fs::write(home.path().join("c.jsonl"), line).unwrap();
        run_in(home.path(), &format!("{IDENTIFY} --cases c.jsonl")).complains(2, &[says]);
    }
    run_in(home.path(), "identify").complains(2, &["nothing to go by"]);
    run_in(home.path(), &format!("{IDENTIFY} --cases none.jsonl")).complains(3, &["none.jsonl"]);
    run_in(home.path(), "identify --device true --save none/c.jsonl")
        .complains(3, &["none/c.jsonl"]);
    run_in(home.path(), "identify --next --vary guard=1").complains(2, &["guard", "--base"]);
    run_in(home.path(), "identify --next --vary sub-pixel=30")
        .complains(2, &["no hypothesis is a valid profile"]);
    run_in(home.path(), "identify --next --base ps1").complains(2, &["--near"]);
}

/// Clause ID-7: a device that hangs, ends or talks nonsense; what was learned is kept.
#[test]
fn a_device_that_does_not_answer_is_given_up() {
    let home = tempfile::tempdir().unwrap();
    hide(home.path(), &[]);
    let ask = |device: &str| {
        let output = guardbit()
            .args(IDENTIFY.split(' '))
            .args(["--vary", "snap=floor", "--timeout", "1", "--device", device])
            .current_dir(home.path())
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let program = env!("CARGO_BIN_EXE_guardbit");
    let once = format!("head -n 1 | {program} eval hidden.toml --window 32x32; sleep 60");
    for (device, says) in [
        ("sleep 60", "stopped: probe 1: no answer within 1 seconds"),
        ("true", "stopped: probe 1: the device"),
        (
            "while read line; do echo '{\"id\": 7}'; done",
            "the device answered with the id of another line",
        ),
        (
            "while read line; do echo '{\"error\": \"no\"}'; done",
            "the device answered with an error: no",
        ),
        (&once, "stopped: probe 2: no answer within 1 seconds; what was learned so far:\n"),
    ] {
        let (status, out) = ask(device);
        assert_eq!(status, Some(2), "{device}: {out}");
        assert!(out.starts_with("stopped: ") && out.contains(says), "{device}: {out}");
    }
}
