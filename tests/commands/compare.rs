//! `guardbit compare`: its keys, its figures against independent ones, and what it refuses.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::machine::triangle_machines;
use serde_json::Value;
use std::process::{Command, Output};

fn guardbit(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_guardbit")).args(arguments).output().unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = guardbit(arguments);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{stderr}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn machine<'a>(report: &'a Value, name: &str) -> &'a Value {
    report["machines"].as_array().unwrap().iter().find(|row| row["name"] == name).unwrap()
}

/// Clause A-12: the keys that outside programs read, every machine, and exact ones exact.
#[test]
fn every_machine_has_a_row_with_the_agreed_keys() {
    let report = json(&["compare", "--scene", "terrain", "--window", "160x120", "--json"]);
    assert_eq!(report["scene"], "terrain");
    let rows = report["machines"].as_array().unwrap();
    assert_eq!(rows.len(), triangle_machines().count());
    for row in rows {
        for key in [
            "name",
            "exact",
            "coverage_differs",
            "holes",
            "double_hits",
            "depth_worst_ulp",
            "depth_mean_ulp",
            "ops",
            "accumulator_bits",
            "ns_per_fragment",
        ] {
            assert!(!row[key].is_null(), "{key} in {row}");
        }
        for part in ["triangle", "fragment"] {
            for kind in ["add", "multiply", "divide", "compare"] {
                assert!(row["ops"][part][kind].is_number(), "{part} {kind} in {row}");
            }
        }
        assert!(row["ns_per_fragment"].as_f64().unwrap() > 0.0);
        // Errors use a part of what their clauses allow.
        let part = row["depth_of_bound"].as_f64().unwrap();
        assert!(part > 0.001 && part <= 1.0, "{row}");
        assert_eq!(row["beyond_bound"], 0, "{row}");
        if row["exact"] == true {
            for key in ["coverage_differs", "holes", "double_hits"] {
                assert_eq!(row[key], 0, "{key} in {row}");
            }
        }
    }
    let exact = rows.iter().filter(|row| row["exact"] == true).count();
    let base = guardbit::profile::load("sgi-4k").unwrap();
    let by_construction = triangle_machines()
        .filter(|kind| base.with_machine(kind.name).unwrap().covers_exactly())
        .count();
    assert_eq!(exact, by_construction);
    assert!(exact >= 6);
}

/// Clause A-11: operations and work of a right triangle of 6 by 4 pixels, counted by hand.
#[test]
fn work_and_operations_of_one_triangle_are_as_counted_by_hand() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("one.jsonl");
    // Corners (0, 0), (6, 0), (0, 4): rows of 5, 4, 2 and 1 samples, as x < 6 (1 - (y + 1/2) / 4).
    std::fs::write(&scene, "{\"v\": [[0,0,0],[6144,0,600],[0,4096,900]]}\n").unwrap();
    let path = scene.to_str().unwrap();
    let report = json(&["compare", "--scene", path, "--window", "64x64", "--json", "--no-time"]);
    assert_eq!((&report["samples"], &report["triangles"]), (&12.into(), &1.into()));
    let work = |name: &str, key: &str| machine(&report, name)["work"][key].as_u64().unwrap();
    // The box of 6 by 4 samples; what is covered; the window; one tile of 16 by 16.
    assert_eq!(work("edge-function", "visits"), 24);
    assert_eq!(work("edge-walk", "visits"), 12);
    assert_eq!(work("engine-per-pixel", "visits"), 4096);
    assert_eq!((work("tiles", "tiles"), work("tiles", "visits")), (1, 256));
    // Three edge words stepped and tested at 24 places, three down at each of 4 rows, a jump to each of
    // 4 runs, and at 12 a step of depth and the bias of its read-out: (72 + 12 + 8 + 24) / 12
    // additions.
    let fragment = &machine(&report, "edge-function")["ops"]["fragment"];
    assert!((fragment["add"].as_f64().unwrap() - 116.0 / 12.0).abs() < 1e-12, "{fragment}");
    assert!((fragment["multiply"].as_f64().unwrap() - 8.0 / 12.0).abs() < 1e-12, "{fragment}");
    // Two walked sides of three with two quotients each, and the plane's three.
    assert_eq!(machine(&report, "edge-walk")["ops"]["triangle"]["divide"], 9);
    // No plane, but two quotients of depth an edge; one more for each of four spans of twelve samples.
    let gouraud = &machine(&report, "gouraud")["ops"];
    assert_eq!(gouraud["triangle"]["divide"], 12);
    assert!((gouraud["fragment"]["divide"].as_f64().unwrap() - 4.0 / 12.0).abs() < 1e-12);
    // 35 bits of each edge, 39 of depth.
    assert_eq!(machine(&report, "edge-function")["accumulator_bits"], 3 * 35 + 39);
}

/// Clause A-13: a scene without depth has no depth evaluator, and the report says what that saves.
#[test]
fn an_evaluator_that_the_scene_does_not_need_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("flat.jsonl");
    std::fs::write(&scene, "{\"v\": [[0,0],[6144,0],[0,4096]]}\n").unwrap();
    let path = scene.to_str().unwrap();
    let report = json(&["compare", "--scene", path, "--window", "64x64", "--json", "--no-time"]);
    let saved = &report["saved"][0];
    assert_eq!((&saved["evaluator"], &saved["bits"]), (&"depth".into(), &39.into()));
    assert!(saved["triangle"].as_u64().unwrap() > 0 && saved["fragment"].as_u64().unwrap() > 0);
    let row = machine(&report, "edge-function");
    assert!(row["depth_worst_ulp"].is_null());
    assert_eq!(row["accumulator_bits"], 3 * 35);
    let text = guardbit(&["compare", "--scene", path, "--window", "64x64", "--no-time"]);
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("left out: depth"), "{text}");
}

/// Clause O-4: orders read alike with wrapping accumulators, and some do not with others.
#[test]
fn orders_are_compared_by_what_their_accumulators_read() {
    let report = json(&[
        "compare",
        "--scene",
        "knot",
        "--window",
        "64x64",
        "--show",
        "traversal",
        "--stamp",
        "2x2",
        "--json",
    ]);
    let rows = report["traversal"].as_array().unwrap();
    assert_eq!(rows.len(), 7);
    for row in rows {
        assert_eq!((&row["coverage_differs"], &row["wrapping_differs"]), (&0.into(), &0.into()));
    }
    let sum = |key: &str| rows.iter().map(|row| row[key].as_u64().unwrap()).sum::<u64>();
    assert!(sum("floating_differs") > 0 && sum("sticky_differs") > 0, "{rows:?}");
    let of = |order: &str, key: &str| {
        rows.iter().find(|row| row["order"] == order).unwrap()[key].as_f64().unwrap()
    };
    assert!(of("bounding-box", "floating_differs") < 0.5);
    assert!(of("zigzag", "visits_per_fragment") < of("bounding-box", "visits_per_fragment"));
    assert!(of("tiles", "tiles") > 0.0);
}

/// Cost against size: set-up outweighs a pixel of a small triangle, and no machine's cost a pixel
/// grows from one size to the next but by its own overhead.
#[test]
fn cost_against_size_falls_as_triangles_grow() {
    let report =
        json(&["compare", "--window", "512x512", "--show", "sizes", "--no-time", "--json"]);
    let rows = report["sizes"].as_array().unwrap();
    let cost = |machine: &str, pixels: u64| {
        let row = rows.iter().find(|r| r["machine"] == machine && r["pixels"] == pixels).unwrap();
        row["operations"].as_f64().unwrap() / row["covered"].as_f64().unwrap()
    };
    for machine in ["edge-function", "edge-walk", "gouraud", "barycentric", "scanline", "tiles"] {
        assert!(cost(machine, 10) > 1.3 * cost(machine, 10_000), "{machine}");
    }
    // Lecture A: an engine at every pixel is extremely inefficient for small triangles.
    assert!(cost("engine-per-pixel", 10) > 100.0 * cost("edge-function", 10));
}

#[test]
fn pictures_are_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    let out = path.to_str().unwrap();
    let common = ["compare", "--scene", "fan", "--window", "64x48", "--no-time", "--svg"];
    let ran = guardbit(&[&common[..], &[out]].concat());
    assert_eq!(ran.status.code(), Some(0), "{}", String::from_utf8_lossy(&ran.stderr));
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.matches("<image").count(), triangle_machines().count());
    assert!(text.trim_end().ends_with("</svg>") && text.contains("recursive descent"));
    let nowhere = folder.path().join("no/such/b.svg");
    let ran = guardbit(&[&common[..], &[nowhere.to_str().unwrap()]].concat());
    assert_eq!(ran.status.code(), Some(3));
    assert!(ran.stdout.is_empty());
}

#[test]
fn nonsense_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let outside = folder.path().join("outside.jsonl");
    std::fs::write(&outside, "{\"v\": [[0,0],[9999999999,0],[0,5]]}\n").unwrap();
    let outside = outside.to_str().unwrap();
    for (arguments, status, hint) in [
        (&["--machines", "pineda"][..], 2, "edge-function"),
        (&["--stamp", "3x3"], 2, "1x1"),
        (&["--scene", "nothing"], 2, "knot"),
        (&["--scene", outside, "--no-time"], 2, "no triangle can be drawn"),
        (&["--scene", outside, "--no-time"], 2, "1 triangles are left out"),
        (&["--window", "0x5"], 2, "1 to 65536"),
        (&["--show", "traversal", "--svg", "x.svg"], 2, "machines"),
        (&["missing.toml"], 3, "missing.toml"),
    ] {
        let ran = guardbit(&[&["compare"], arguments].concat());
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(status), "{arguments:?}: {stderr}");
        assert!(stderr.contains(hint), "{arguments:?}: {stderr}");
    }
}

/// Machines, orders of visits and depth formats are axes of `explore`, and agree with `compare`.
#[test]
fn machines_orders_and_formats_are_axes_of_explore() {
    let common = ["--scene", "terrain", "--window", "160x120", "--json"];
    let explored = |axis: &[&str]| {
        let report = json(&[&["explore"], &common[..], axis].concat());
        report.as_array().unwrap().clone()
    };
    let names: Vec<&str> = triangle_machines().map(|kind| kind.name).collect();
    let records = explored(&["--vary", &format!("form={}", names.join(","))]);
    let compared = json(&[&["compare", "--no-time"], &common[..]].concat());
    assert_eq!(records.len(), names.len());
    for record in &records {
        let name = record["budget"]["form"].as_str().unwrap();
        let row = machine(&compared, name);
        let arithmetic = &record["accuracy"]["arithmetic"];
        assert_eq!(arithmetic["misclassified"], row["coverage_differs"], "{name}");
        assert_eq!(arithmetic["depth"]["ulp"]["worst"], row["depth_worst_ulp"], "{name}");
        assert_eq!(record["cost"]["adder_bits"], row["accumulator_bits"], "{name}");
    }
    let orders = "traversal=rows,bounding-box,backtrack,zigzag,tiles,binned,morton,hilbert";
    let records = explored(&["--vary", orders]);
    assert_eq!(records.len(), 8);
    for record in &records {
        assert_eq!(record["accuracy"], records[0]["accuracy"]);
    }
    let costs: Vec<f64> =
        records.iter().map(|r| r["operations_per_fragment"].as_f64().unwrap()).collect();
    assert!(costs[3] < costs[1], "zigzag visits less than the box: {costs:?}");
    let stamps = explored(&["--vary", "traversal=zigzag", "--vary", "stamp=1x1,2x1,2x2"]);
    assert_eq!(stamps.len(), 3);
    let formats =
        "depth-format=z-over-w,one-over-w,object-z,inverse-z,float-far-zero,float-near-zero";
    // The last scene given counts as well: one with many surfaces behind each other.
    let records = explored(&["--vary", formats, "--vary", "integer=6", "--scene", "knot"]);
    let ties: Vec<u64> = records
        .iter()
        .map(|record| record["accuracy"]["arithmetic"]["ties"].as_u64().unwrap())
        .collect();
    assert!(ties.len() == 6 && ties[0] > 10 && ties.iter().any(|t| t != &ties[0]), "{ties:?}");
    let ran = guardbit(&["fit", "--scene", "terrain", "--vary", "form=tiles,gouraud"]);
    assert_eq!(ran.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&ran.stderr)
            .contains("use `guardbit explore`: it measures every machine")
    );
}

/// Clause RG-22: a square cut along the diagonal that its pixels' samples lie on: four pixels are hit twice by
/// the tile machine without a fill rule; with samples at corners, such machines also draw the sides on the right and
/// below, five rows of five, and five pixels twice; all others four rows of four. Moved by a quarter of
/// a pixel it is still covered by all but the machine of whole pixels, whose vertices stay where they were.
#[test]
fn a_square_through_every_rasterizer() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("square.jsonl");
    let square = |by: f64| {
        let at = |x: f64, y: f64| format!("[{},{}]", x + by, y);
        let [a, b, c, d] = [at(2.0, 2.0), at(6.0, 2.0), at(6.0, 6.0), at(2.0, 6.0)];
        format!("{{\"f\": [{a},{b},{c}]}}\n{{\"f\": [{a},{c},{d}]}}\n")
    };
    let compare = |text: String| {
        std::fs::write(&scene, text).unwrap();
        let scene = scene.to_str().unwrap();
        let svg = folder.path().join("all.svg");
        let report = json(&[
            "compare",
            "--profiles",
            "--scene",
            scene,
            "--window",
            "8x8",
            "--json",
            "--svg",
            svg.to_str().unwrap(),
        ]);
        let drawn = std::fs::read_to_string(svg).unwrap();
        assert_eq!(drawn.matches("<image").count(), 30, "a picture and a map each");
        report["profiles"].as_array().unwrap().clone()
    };
    let rows = compare(square(0.0));
    assert_eq!(rows.len(), 15);
    for row in &rows {
        let name = row["profile"].as_str().unwrap();
        let [hits, holes, few, many] =
            ["hits", "holes", "too_few", "too_many"].map(|key| row[key].as_u64().unwrap());
        assert_eq!((holes, few, row["refused"].as_u64()), (0, 0, Some(0)), "{name}");
        match name {
            "vortex" => assert_eq!((hits, many), (20, 4)),
            "rasterix" | "picogs" | "graphite" => assert_eq!((hits, many), (30, 14), "{name}"),
            // Coverage is shared along the diagonal: both triangles draw there.
            "n64" | "n64-rtl" => assert!(many >= 4, "{many}"),
            _ => assert_eq!((hits, many), (16, 0), "{name}"),
        }
        let exact = ["ps1", "ps1-rtl", "voodoo", "virge"].contains(&name);
        if let (true, Some(worst)) = (exact, row["colour_worst"].as_f64()) {
            assert!(worst < 4.0, "{name}: {worst}");
        }
    }
    let moved = compare(square(0.75));
    for row in &moved {
        let name = row["profile"].as_str().unwrap();
        let wrong = row["too_few"].as_u64().unwrap() + row["too_many"].as_u64().unwrap();
        match name {
            // Half a pixel and more to the next whole one: a column starts late, or ends.
            "ps1" | "ps1-rtl" => assert_eq!(row["colours_off"].as_u64().map(|n| n > 0), Some(true)),
            "vortex" | "n64" | "n64-rtl" | "rasterix" | "picogs" | "graphite" => {}
            _ => assert_eq!(wrong, 0, "{name}"),
        }
    }
    // A grid as fine as the reference's own half, and integers of the profile that the scene is given in.
    let fine = folder.path().join("fine.toml");
    let text = guardbit(&["profile", "show", "sgi-4k"]).stdout;
    let text = String::from_utf8(text).unwrap();
    let text =
        text.replace("integer = 12", "integer = 8").replace("sub-pixel = 10", "sub-pixel = 24");
    let text = text.split("[depth]").next().unwrap().replace("width = 35", "width = 64");
    let text = text.replace("width = 4096", "width = 64").replace("height = 4096", "height = 64");
    std::fs::write(&fine, text).unwrap();
    std::fs::write(&scene, "{\"v\": [[512,512],[1536,512],[512,1536]]}\n").unwrap();
    let both = format!("{},vulkan-4bit", fine.display());
    let report = json(&[
        "compare",
        "vulkan-4bit",
        "--profiles",
        &both,
        "--scene",
        scene.to_str().unwrap(),
        "--window",
        "8x8",
        "--json",
    ]);
    for row in report["profiles"].as_array().unwrap() {
        // Legs of four pixels in 1/256: 4 + 3 + 2 + 1 samples, less the four on the slanting side.
        assert_eq!((row["hits"].as_u64(), row["holes"].as_u64()), (Some(6), Some(0)), "{row}");
    }
    let other = guardbit(&["compare", "--profiles", "ps2", "--scene", "fan"]);
    assert_eq!(other.status.code(), Some(2));
    let refused = guardbit(&["explore", "n64", "--vary", "sub-pixel=2", "--scene", "fan"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("n64 is a register-level machine"));
}

/// Clause A-12: where no bound is stated there is none, not a bound that is not used at all; coverage is still checked.
#[test]
fn a_profile_without_a_stated_bound_has_none() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("one.jsonl");
    std::fs::write(&scene, "{\"v\": [[0,0,0],[6144,0,600],[0,4096,900]]}\n").unwrap();
    let file = folder.path().join("changed.toml");
    for change in [
        |profile: &mut guardbit::profile::Profile| {
            profile.depth.as_mut().unwrap().division =
                guardbit::setup::Division::Reciprocal { bits: 30 };
        },
        |profile: &mut guardbit::profile::Profile| {
            profile.depth.as_mut().unwrap().clamp = guardbit::format::Clamp::Sign;
        },
    ] {
        let mut profile = guardbit::profile::load("sgi-4k").unwrap();
        change(&mut profile);
        std::fs::write(&file, profile.to_toml()).unwrap();
        let arguments = |last| {
            let [file, scene] = [&file, &scene].map(|path| path.to_str().unwrap());
            ["compare", file, "--scene", scene, "--window", "64x64", "--no-time", last]
        };
        let report = json(&arguments("--json"));
        let rows = report["machines"].as_array().unwrap();
        assert_eq!(rows.len(), triangle_machines().count());
        for row in rows {
            assert!(row["depth_of_bound"].is_null(), "{row}");
            assert_eq!(row["beyond_bound"], 0, "{row}");
        }
        let text = guardbit(&arguments("--machines=tiles"));
        assert_eq!(text.status.code(), Some(0));
        let text = String::from_utf8(text.stdout).unwrap();
        assert!(text.contains(" none "), "{text}");
        assert!(text.contains("so it is not checked: tiles"), "{text}");
    }
}
