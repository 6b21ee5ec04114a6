//! The command at its edges: pictures, waves, differences, streams, and what goes wrong.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;
use crate::set;

use run::{Ran, guardbit, run_in};
use set::{copy, options, profile, tree, write_set};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tempfile::TempDir;

fn home() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn json(ran: &Ran) -> serde_json::Value {
    serde_json::from_str(&ran.out).unwrap()
}

/// Keys of an object, sorted.
fn keys(value: &serde_json::Value) -> Vec<&str> {
    let mut keys: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

/// Width, height and pixels of a PNG.
fn picture(path: &Path) -> (u32, u32, Vec<[u8; 3]>) {
    let decoder = png::Decoder::new(BufReader::new(File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let pixels = bytes.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
    (info.width, info.height, pixels)
}

#[test]
fn every_picture_has_its_size_and_more_than_one_colour() {
    let home = home();
    let mut pictures = BTreeSet::new();
    for show in ["image", "depth", "coverage", "error"] {
        for profile in ["sgi-4k", "sgi-4k-walk"] {
            let out = format!("{show}-{profile}.png");
            let arguments = format!(
                "render {profile} --scene terrain --window 60x40 --zoom 3 --show {show} --out {out}"
            );
            let ran = run_in(home.path(), &arguments).ends(0);
            assert!(
                ran.out.starts_with(&format!("{out}: 180 x 120, 2048 triangles")),
                "{}",
                ran.out
            );
            let (width, height, pixels) = picture(&home.path().join(&out));
            assert_eq!((width, height), (180, 120));
            let colours: BTreeSet<&[u8; 3]> = pixels.iter().collect();
            assert!(colours.len() >= 3, "{out}: {colours:?}");
            // Each pixel is a block of three by three.
            for (n, pixel) in pixels.iter().enumerate() {
                let (x, y) = (n % 180 / 3 * 3, n / 180 / 3 * 3);
                assert_eq!(*pixel, pixels[y * 180 + x]);
            }
            pictures.insert(pixels);
        }
    }
    assert!(pictures.len() >= 4, "different things look different: {}", pictures.len());
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 8, "nothing else is left");
}

#[test]
fn the_walked_edge_shows_its_errors_and_the_exact_machine_has_none() {
    let home = home();
    let summary = |profile: &str| {
        let arguments = format!("render {profile} --scene fan --window 64x64 --show error");
        run_in(home.path(), &arguments).ends(0).out
    };
    let exact = summary("sgi-4k");
    assert!(exact.contains(", 0 missing, 0 extra, depth error worst 0."), "{exact}");
    assert!(home.path().join("guardbit.png").is_file());
    // A window cut to one corner draws that corner only.
    let arguments = "render sgi-4k --scene fan --window 64x64 --scissor 0,0,32,64 --show coverage";
    run_in(home.path(), arguments).ends(0);
    let (width, _, pixels) = picture(&home.path().join("guardbit.png"));
    let drawn = |right: bool| {
        let mine = pixels.iter().enumerate();
        let mine = mine.filter(|(n, _)| (n % width as usize >= width as usize / 2) == right);
        mine.map(|(_, pixel)| pixel).collect::<BTreeSet<_>>().len()
    };
    assert_eq!((drawn(true), drawn(false) > 1), (1, true));
}

#[test]
fn pictures_that_cannot_be_are_refused() {
    let home = home();
    for (window, about) in [
        ("0x5", "0 x 5: a window has 1 to 65536"),
        ("5x0", "1 to 65536"),
        ("70000x5", "70000 x 5"),
        ("5", "a size is WIDTHxHEIGHT"),
        ("axb", "a size is WIDTHxHEIGHT"),
        ("", "a size is WIDTHxHEIGHT"),
        ("99999999999x5", "a size is WIDTHxHEIGHT"),
        ("65536x65536", "at most 2^26 pixels"),
        ("4096x4096 --zoom 256", "at most 2^26 pixels"),
        ("8x8 --zoom 0", "0"),
        ("8x8 --scissor 3,0,2,8", "X0 <= X1"),
        ("8x8 --scissor 3,0,2", "X0 <= X1"),
    ] {
        run_in(home.path(), &format!("render tiny --scene fan --window={window}"))
            .complains(2, &[about]);
    }
    run_in(home.path(), "render tiny --scene fan --out none/a.png").complains(3, &["none/a.png"]);
    run_in(home.path(), "render tiny --scene fan --out .").complains(3, &["."]);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0, "nothing is left behind");
}

/// Signals by name with their widths, and the values of all at each time at which one changes.
type Waves = (Vec<(String, u32)>, Vec<(u64, BTreeMap<String, String>)>);

fn waves(path: &Path) -> Waves {
    let mut parser = vcd::Parser::new(BufReader::new(File::open(path).unwrap()));
    let header = parser.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, vcd::TimescaleUnit::NS)));
    let mut names = BTreeMap::new();
    let mut list = Vec::new();
    let module = header.items.iter().find_map(|item| match item {
        vcd::ScopeItem::Scope(scope) => Some(scope),
        _ => None,
    });
    for item in &module.unwrap().items {
        if let vcd::ScopeItem::Var(var) = item {
            names.insert(var.code, var.reference.clone());
            list.push((var.reference.clone(), var.size));
        }
    }
    let (mut now, mut state, mut samples) = (0, BTreeMap::new(), Vec::new());
    for command in parser {
        match command.unwrap() {
            vcd::Command::Timestamp(time) => {
                if !state.is_empty() {
                    samples.push((now, state.clone()));
                }
                now = time;
            }
            vcd::Command::ChangeScalar(id, value) => {
                state.insert(names[&id].clone(), value.to_string());
            }
            vcd::Command::ChangeVector(id, value) => {
                state.insert(names[&id].clone(), value.to_string());
            }
            other => panic!("{other:?}"),
        }
    }
    (list, samples)
}

#[test]
fn waves_hold_the_rows_of_the_test() {
    let home = home();
    for (profile, test) in [
        ("tiny", "dda/guard-boundary/3"),
        ("sgi-4k", "dda/random/2"),
        ("tiny", "edge/widest-slopes/1"),
    ] {
        let arguments =
            format!("trace {profile} --scene fan --test {test} --vcd a.vcd --fst a.fst");
        let text = run_in(home.path(), &arguments).ends(0).out;
        assert!(text.starts_with(&format!("{test}: a walk from ")), "{text}");
        let only = format!("vectors {profile} --scene fan --only {test}");
        let only = run_in(home.path(), &only).ends(0).out;
        let rows = |end: &str| -> Vec<Vec<u128>> {
            let lines = only.lines().filter_map(|line| line.split_once(&format!("{end}: ")));
            set::tv_rows(&lines.map(|(_, row)| row).collect::<Vec<_>>().join("\n"))
        };
        let (cfg, exp) = (rows("cfg.tv"), rows("exp.tv"));
        assert!(cfg.len() == 1 && exp.len() >= 8, "{only}");
        assert_eq!(text.lines().filter(|line| line.contains("  op=")).count(), exp.len());
        let (signals, samples) = waves(&home.path().join("a.vcd"));
        let names: Vec<&str> = signals.iter().map(|(name, _)| name.as_str()).collect();
        let expected = if test.starts_with("dda") {
            ["clk", "init", "dx", "dy", "op", "acc", "out_v"]
        } else {
            ["clk", "e0", "ea", "eb", "op", "e", "in_v"]
        };
        assert_eq!(names, expected);
        // One clock a row: up at its start, down in its middle.
        let up: Vec<_> = samples.iter().filter(|(_, state)| state["clk"] == "1").collect();
        assert_eq!(up.len(), exp.len());
        for (n, ((time, state), row)) in up.into_iter().zip(&exp).enumerate() {
            assert_eq!(*time, 10 * n as u64);
            let words = cfg[0].iter().chain(row);
            for ((name, width), word) in signals[1..].iter().zip(words) {
                let bits = &state[name];
                assert_eq!(bits.len(), *width as usize, "{name}");
                assert_eq!(u128::from_str_radix(bits, 2).unwrap(), *word, "{test} {n} {name}");
            }
        }
        // An FST begins with its header block: kind 0, 329 bytes long.
        let fst = std::fs::read(home.path().join("a.fst")).unwrap();
        assert!(fst.len() > 400);
        assert_eq!(fst[..9], [0, 0, 0, 0, 0, 0, 0, 1, 0x49]);
        run_in(home.path(), &arguments).ends(0);
        assert_eq!(std::fs::read(home.path().join("a.fst")).unwrap(), fst, "the same again");
    }
    // Triangles have a text, too.
    for test in ["setup/random/3", "triangle/random/1"] {
        let ran = run_in(home.path(), &format!("trace tiny --scene fan --test {test}")).ends(0);
        assert!(ran.out.starts_with(&format!("{test}: triangle (")), "{}", ran.out);
    }
    run_in(home.path(), "trace tiny --test none").complains(2, &["no test \"none\""]);
    for wave in ["--vcd none/a", "--fst none/a"] {
        run_in(home.path(), &format!("trace tiny --scene fan {wave}")).complains(3, &["none/a"]);
    }
}

#[test]
fn differences_are_named_and_end_with_status_1() {
    let home = home();
    let same = run_in(home.path(), "diff tiny tiny").ends(0);
    assert_eq!(same.out, "no difference\n");
    let ran = run_in(home.path(), "diff tiny sgi-4k").ends(1);
    assert!(ran.out.contains("depth.guard: 1 -> 2\n"), "{}", ran.out);
    let ran = run_in(home.path(), "diff sgi-4k sgi-4k-walk --json").ends(1);
    let changes = json(&ran);
    for change in changes.as_array().unwrap() {
        assert_eq!(keys(change), ["left", "right", "what"]);
    }
    assert_eq!(json(&run_in(home.path(), "diff tiny tiny --json").ends(0)), serde_json::json!([]));
    // Sets.
    let a = write_set(&profile("tiny"), "fan", &options(300));
    let b = write_set(&profile("tiny"), "fan", &options(301));
    copy(&a.folder(), &home.path().join("a"));
    copy(&b.folder(), &home.path().join("b"));
    run_in(home.path(), "diff a a").ends(0);
    let ran = run_in(home.path(), "diff a b").ends(1);
    assert!(ran.out.contains("tiny: count: 300 -> 301\n"), "{}", ran.out);
    assert!(ran.out.contains("tiny: dda.exp.tv (1 of 301 lines, first 301): nothing -> "));
    // One row edited, the manifest left alone: the bytes count, not what a manifest says of them.
    let path = home.path().join("a/edge.exp.tv");
    let text = std::fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let edited = text.replacen(lines[6], "3_3f_1", 1);
    copy(&a.folder(), &home.path().join("c"));
    std::fs::write(&path, edited).unwrap();
    let ran = run_in(home.path(), "diff c a").ends(1);
    let line = lines.iter().position(|line| *line == lines[6]).unwrap() + 1;
    let expected =
        format!("tiny: edge.exp.tv (1 of 300 lines, first {line}): {} -> 3_3f_1\n", lines[6]);
    assert_eq!(ran.out, expected);
    std::fs::write(&path, text.trim_end()).unwrap();
    let ran = run_in(home.path(), "diff a c").ends(1);
    assert!(ran.out.contains("without a newline at the end"), "{}", ran.out);
    run_in(home.path(), "diff a tiny")
        .complains(2, &["one input is the folder of a set and the other is not"]);
    run_in(home.path(), "diff none tiny").complains(2, &["no profile \"none\""]);
    std::fs::create_dir(home.path().join("empty")).unwrap();
    run_in(home.path(), "diff a empty").complains(2, &["empty", "manifest.json"]);
}

#[test]
fn reports_keep_their_keys() {
    let home = home();
    let ran = run_in(home.path(), "claims --only edge.width --json").ends(0);
    let claims = json(&ran);
    assert!(claims.as_array().unwrap().len() >= 5);
    for claim in claims.as_array().unwrap() {
        assert_eq!(keys(claim), ["expected", "good", "got", "id", "what"]);
        assert!(claim["id"].as_str().unwrap().starts_with("edge.width"), "{claim}");
        assert_eq!(claim["good"], true);
    }
    let one = run_in(home.path(), "claims --only edge.width --json --threads 1").ends(0);
    assert_eq!(one.out, ran.out, "threads do not show");
    let text = run_in(home.path(), "claims --only edge.width").ends(0).out;
    assert!(text.ends_with(", 0 unmet\n") && text.contains("good   edge.width."), "{text}");
    run_in(home.path(), "claims --only none")
        .complains(2, &["the id of no claim begins with this text"]);

    for name in ["tiny", "sgi-4k", "sgi-4k-walk", "d3d11"] {
        let report = json(&run_in(home.path(), &format!("budget {name} --json")).ends(0));
        assert_eq!(report["profile"], name);
        for word in report["words"].as_array().unwrap() {
            let bits = |field: &serde_json::Value| field["bits"].as_u64().unwrap();
            let sum: u64 = word["fields"].as_array().unwrap().iter().map(bits).sum();
            assert_eq!(word["width"], sum, "{word}");
        }
    }
    let ran = run_in(home.path(), "speed --json --repeats 1").ends(0);
    let report = json(&ran);
    assert_eq!(keys(&report["ratios"]), ["depth_walk", "depth_walk_logged", "edges_exact"]);
    for (key, ratio) in report["ratios"].as_object().unwrap() {
        assert!(ratio.as_f64().unwrap() > 0.0, "{key}");
    }
    let kernels: BTreeSet<&str> = report["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["kernel"].as_str().unwrap())
        .collect();
    assert_eq!(Vec::from_iter(kernels), keys(&report["ratios"]));
    run_in(home.path(), "speed --repeats 0").complains(2, &["--repeats"]);
    // The sections that came later.
    let column = |section: &str, key: &str| -> Vec<f64> {
        report[section].as_array().unwrap().iter().map(|row| row[key].as_f64().unwrap()).collect()
    };
    assert_eq!(column("lanes", "width"), [16., 24., 32., 39., 48., 64., 80., 120.]);
    let pixels: Vec<f64> = (0..8).map(|n| 4f64.powi(n)).collect();
    // Three machines, event log off and on.
    assert_eq!(column("forms", "pixels"), pixels.repeat(6));
    let (worst, bound) = (column("trade", "worst_ulp"), column("trade", "bound_ulp"));
    assert!(worst.len() > 8 && worst.iter().zip(&bound).all(|(worst, bound)| worst <= bound));
    for (section, key) in [
        ("lanes", "ratio"),
        ("forms", "ns_per_triangle"),
        ("trade", "ratio"),
        ("fill", "ratio"),
        ("registers", "thousands_per_second"),
    ] {
        assert!(column(section, key).iter().all(|figure| *figure > 0.0), "{section} {key}");
    }
    assert_eq!(report["findings"].as_array().unwrap().len(), 6);
}

#[test]
fn speed_measures_what_is_asked_for() {
    let home = home();
    let ran =
        run_in(home.path(), "speed --repeats 1 --only lanes,trade --json --svg speed.svg").ends(0);
    assert_eq!(keys(&json(&ran)), ["findings", "lanes", "trade"]);
    let chart = std::fs::read_to_string(home.path().join("speed.svg")).unwrap();
    let trade = json(&ran)["trade"].as_array().unwrap().len();
    // A point a budget, and a mark a lane in the legend.
    assert_eq!(chart.matches("<circle").count(), trade + 3);
    assert!(chart.contains("ULP") && chart.contains("i128"));
    let text = run_in(home.path(), "speed --repeats 1 --only forms").ends(0).out;
    assert_eq!(text.lines().count(), 1 + 6 * 8 + 1, "{text}");
    assert!(text.lines().last().unwrap().starts_with("a one-pixel triangle takes"), "{text}");
    run_in(home.path(), "speed --only lanes --svg other.svg")
        .complains(2, &["trade", "--only", "hint: "]);
    run_in(home.path(), "speed --only speed").complains(2, &["ratios, lanes, forms, trade"]);
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 1, "one chart, nothing else");
}

#[test]
fn a_stream_is_the_file() {
    let home = home();
    run_in(home.path(), "vectors tiny --scene fan --count 3000 --out set").ends(0);
    run_in(home.path(), "vectors tiny --scene fan --count 3000 --out zst --zstd").ends(0);
    let file = |path: &str| std::fs::read(home.path().join(path)).unwrap();
    let stream = |more: &str| {
        let arguments = format!("vectors tiny --scene fan --count 3000 --out - {more}");
        let ran = run_in(home.path(), &arguments).ends(0);
        assert_eq!(ran.err, "");
        ran.bytes
    };
    assert!(stream("") == file("set/dda.exp.tv"));
    for name in ["dda.cfg", "edge.exp", "setup.exp", "span.exp", "depth.exp", "triangle.cfg"] {
        assert!(stream(&format!("--file {name}")) == file(&format!("set/{name}.tv")), "{name}");
    }
    assert!(stream("--file edge.exp.tv") == file("set/edge.exp.tv"));
    assert!(stream("--zstd") == file("zst/dda.exp.tv.zst"));
    assert!(stream("--zstd --file span.exp.tv.zst") == file("zst/span.exp.tv.zst"));
    let joined: Vec<u8> =
        (0..4).flat_map(|n| stream(&format!("--shard {n}/4 --format csv"))).collect();
    assert!(joined == stream("--format csv"));
    let operands = String::from_utf8(stream("--format testfloat --file edge")).unwrap();
    assert_eq!(operands.lines().count(), 3000);
    run_in(home.path(), "vectors tiny --scene fan --out - --file none")
        .complains(2, &["--file none", "dda.cfg, dda.exp"]);
    for only in ["--only dda/wrap/0 --format bin", "--only triangle/random/0 --format testfloat"] {
        run_in(home.path(), &format!("vectors tiny --scene fan {only}"))
            .complains(2, &["--format"]);
    }
    let folders = std::fs::read_dir(home.path()).unwrap().count();
    assert_eq!(folders, 2, "a stream leaves no folder");
}

#[test]
fn sets_of_the_default_job_lie_side_by_side() {
    let home = home();
    let ran = run_in(home.path(), "vectors --scene triangle --count 40").ends(0);
    assert_eq!(ran.out.lines().count(), 4);
    let names: BTreeSet<String> = tree(&home.path().join("guardbit-vectors"))
        .into_iter()
        .map(|(name, _)| name.split('/').next().unwrap().to_owned())
        .collect();
    let expected = ["sets.json", "sgi-4k", "sgi-4k-g1", "sgi-4k-g3", "sgi-4k-g4"];
    assert_eq!(Vec::from_iter(names), expected);
    run_in(home.path(), "verify").ends(0);
    run_in(home.path(), "verify --recompute --profile sgi-4k").ends(0);
    run_in(home.path(), "vectors --scene triangle --count 40")
        .complains(2, &["guardbit-vectors exists", "hint: ", "--force"]);
    run_in(home.path(), "vectors --scene triangle --count 41 --force").ends(0);
    run_in(home.path(), "verify").ends(0);
    // A dump answers one set.
    std::fs::write(home.path().join("dda.exp.tv"), "0_0_0\n").unwrap();
    run_in(home.path(), "verify --dut dda.exp.tv").complains(2, &["holds 4 sets", "sgi-4k-g3"]);
    // What a bench dumps beside a set does not disturb the check, and goes with the set. Nothing else does.
    let dumped = "guardbit-vectors/sgi-4k-g3/dda.exp.dut.tv";
    std::fs::write(home.path().join(dumped), "0_0_0\n").unwrap();
    run_in(home.path(), "verify").ends(0);
    for stranger in ["dda.exp.dut.txt", "dda.cfg.dut.tv", "mine.exp.dut.tv", "sim.vvp"] {
        let stranger = format!("guardbit-vectors/sgi-4k-g3/{stranger}");
        std::fs::write(home.path().join(&stranger), "0_0_0\n").unwrap();
        run_in(home.path(), "vectors --scene triangle --count 41 --force")
            .complains(2, &[&stranger, "does not belong to a vector set"]);
        assert!(home.path().join(dumped).is_file());
        std::fs::remove_file(home.path().join(&stranger)).unwrap();
    }
    run_in(home.path(), "vectors --scene triangle --count 41 --force").ends(0);
    assert!(!home.path().join(dumped).exists());
    std::fs::create_dir(home.path().join("mine")).unwrap();
    std::fs::write(home.path().join("mine/thesis.txt"), "years").unwrap();
    run_in(home.path(), "vectors tiny --scene fan --count 9 --out mine --force")
        .complains(2, &["mine/thesis.txt does not belong to a vector set"]);
    assert!(home.path().join("mine/thesis.txt").is_file());
}

#[test]
fn bad_scenes_are_named_with_file_and_line() {
    let home = home();
    let write = |name: &str, text: &str| std::fs::write(home.path().join(name), text).unwrap();
    write("short.obj", "v 0 0 0\nv 1 0\nf 1 2 3\n");
    write("lost.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 9\n");
    write("two.jsonl", "{\"v\": [[0,0],[1,1],[0,8]]}\n\n{\"v\": [[0,0],[1,1]]}\n");
    write("half.jsonl", "{\"v\": [[0,0],[1,1],[0,8]]}\n{\"v\": [[0,0],[1,1],[0,8\n");
    write("far.jsonl", "{\"v\": [[0,0],[1,1],[0,9999]]}\n");
    write("empty.jsonl", "");
    std::fs::write(home.path().join("raw.jsonl"), b"\n\xff\n").unwrap();
    for command in ["vectors tiny --count 10", "render tiny", "trace tiny"] {
        for (scene, status, about) in [
            ("short.obj", 2, "short.obj: line 2: "),
            ("lost.obj", 2, "lost.obj: line 5: "),
            ("two.jsonl", 2, "two.jsonl: line 3: "),
            ("half.jsonl", 2, "half.jsonl: line 2: "),
            ("raw.jsonl", 2, "raw.jsonl: line 2: "),
            ("far.jsonl", 2, "9999 is outside the vertex field"),
            ("empty.jsonl", 2, "empty.jsonl: the file has no triangles"),
            ("none", 2, "no scene `none`"),
            ("none.obj", 3, "none.obj: the file cannot be read"),
            ("./none", 3, "./none: the file cannot be read"),
        ] {
            run_in(home.path(), &format!("{command} --scene {scene}")).complains(status, &[about]);
        }
    }
    run_in(home.path(), "vectors none").complains(2, &["no profile \"none\"", "tiny"]);
    run_in(home.path(), "vectors ./none.toml").complains(3, &["./none.toml"]);
    assert!(!home.path().join("guardbit-vectors").exists());
    assert!(!home.path().join("guardbit.png").exists());
}

#[test]
fn absurd_numbers_are_refused_or_served() {
    let home = home();
    for arguments in [
        "--count 0",
        "--count=-1",
        "--count 1e3",
        "--count 18446744073709551616",
        "--threads 0",
        "--threads 1025",
        "--shard 3/3",
        "--shard 0/0",
        "--shard 1",
        "--shard=-1/2",
        "--shard 0/18446744073709551616",
        "--seed=-1",
        "--seed 18446744073709551616",
        "--window 0x0",
        "--format pdf",
        "--size huge",
    ] {
        let option = arguments.split([' ', '=']).next().unwrap();
        let about = if option == "--window" { "0 x 0" } else { option };
        run_in(home.path(), &format!("vectors tiny --scene fan {arguments}"))
            .complains(2, &[about]);
    }
    assert_eq!(std::fs::read_dir(home.path()).unwrap().count(), 0);
    // The largest that there are: the last of 2^64 - 1 parts of 2^64 - 1 rows.
    let largest = u64::MAX;
    for (n, shard) in
        [format!("{}/{largest}", largest - 1), format!("0/{largest}")].iter().enumerate()
    {
        let arguments =
            format!("vectors tiny --scene fan --count {largest} --seed {largest} --shard {shard}");
        run_in(home.path(), &format!("{arguments} --threads 1024 --out s{n}")).ends(0);
        run_in(home.path(), &format!("verify s{n} --recompute")).ends(0);
    }
}

/// Starts a command with its standard output piped.
fn spawn(folder: &Path, arguments: &str) -> std::process::Child {
    let mut command = guardbit();
    command.current_dir(folder).args(arguments.split_whitespace());
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn a_closed_pipe_is_a_quiet_end() {
    let home = home();
    for arguments in [
        "vectors tiny --scene fan --count 100000000 --out -",
        "vectors tiny --scene fan --count 100000000 --out - --zstd",
        "trace sgi-4k --scene fan --test triangle/range-ends/4",
        "budget --json",
        "profile schema",
    ] {
        let mut child = spawn(home.path(), arguments);
        let mut pipe = child.stdout.take().unwrap();
        let mut some = [0; 16];
        if arguments.starts_with("vectors") {
            pipe.read_exact(&mut some).unwrap();
        }
        drop(pipe);
        let ran = Ran::from(child.wait_with_output().unwrap()).ends(0);
        assert_eq!(ran.err, "", "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_a_failure_of_output() {
    let home = home();
    run_in(home.path(), "vectors tiny --scene fan --count 50 --out set").ends(0);
    for arguments in [
        "vectors tiny --scene fan --count 50 --out -",
        "vectors tiny --scene fan --only dda/wrap/0",
        "vectors tiny --scene fan --count 50 --out other",
        "verify set",
        "budget",
        "budget --json",
        "diff tiny sgi-4k",
        "trace tiny --scene fan",
        "profile list",
        "profile show tiny",
        "profile schema",
        "claims --only edge.width.d3d",
        "claims --only edge.width.d3d --json",
        "render tiny --scene fan",
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut command = guardbit();
        command.current_dir(home.path()).args(arguments.split_whitespace()).stdout(full);
        let ran = Ran::from(command.stderr(Stdio::piped()).output().unwrap());
        ran.complains(3, &["standard output: "]);
    }
}

/// Ctrl-C.
#[cfg(unix)]
fn interrupt(child: &std::process::Child) {
    signal(child, "-INT");
}

#[cfg(unix)]
fn signal(child: &std::process::Child, which: &str) {
    let mut kill = std::process::Command::new("kill");
    assert!(kill.args([which, &child.id().to_string()]).status().unwrap().success());
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_behind() {
    let home = home();
    run_in(home.path(), "vectors tiny --scene triangle --count 20 --out old").ends(0);
    let before = tree(home.path());
    for (n, arguments) in [
        "vectors sgi-4k --scene triangle --count 400000000 --out new",
        "vectors --scene triangle --count 400000000 --out new",
        "vectors sgi-4k --scene triangle --count 400000000 --out old --force",
    ]
    .iter()
    .enumerate()
    {
        let child = spawn(home.path(), arguments);
        // Wait until it is well under way: bytes in the folder beside.
        let begun = Instant::now();
        let rows = || {
            let places = [home.path().to_owned(), home.path().join("old")];
            let folders = places.iter().flat_map(|place| std::fs::read_dir(place).unwrap());
            let mut partial = folders
                .flatten()
                .filter(|entry| entry.file_name().to_string_lossy().contains("partial"));
            partial.next().is_some_and(|folder| {
                // Metadata only: the files grow while they are looked at.
                let written = |folder: &Path| {
                    std::fs::read_dir(folder).into_iter().flatten().flatten().any(|entry| {
                        let name = entry.file_name().to_string_lossy().into_owned();
                        name.contains(".tv") && entry.metadata().is_ok_and(|file| file.len() > 0)
                    })
                };
                let below = std::fs::read_dir(folder.path()).into_iter().flatten().flatten();
                written(&folder.path()) || below.into_iter().any(|entry| written(&entry.path()))
            })
        };
        while !rows() {
            assert!(begun.elapsed() < Duration::from_secs(20), "{arguments}: does not begin");
            std::thread::sleep(Duration::from_millis(5));
        }
        interrupt(&child);
        let ran = Ran::from(child.wait_with_output().unwrap());
        ran.complains(130, &["interrupted"]);
        assert!(tree(home.path()) == before, "run {n}: what was there stays, and nothing else");
        let entries = std::fs::read_dir(home.path()).unwrap().count();
        assert_eq!(entries, 1, "no empty folder either");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_a_check_at_once() {
    let home = home();
    run_in(home.path(), "vectors sgi-4k --scene triangle --count 1500000 --out set").ends(0);
    let mut child = spawn(home.path(), "verify set --recompute");
    std::thread::sleep(Duration::from_millis(150));
    // A machine quick enough to be done by now has nothing to show.
    if child.try_wait().unwrap().is_none() {
        // Nothing is caught here, and a job in the background inherits that INT is ignored.
        signal(&child, "-TERM");
        let output = child.wait_with_output().unwrap();
        assert!(
            output.status.success() != output.stdout.is_empty(),
            "a verdict or none: {output:?}"
        );
    }
}

/// The fenced blocks of one kind in a section of the README.
fn readme_blocks(section: &str, kind: &str) -> Vec<String> {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let text = std::fs::read_to_string(readme).unwrap();
    let section = text.split("\n## ").find(|part| part.starts_with(section)).unwrap();
    let open = format!("```{kind}\n");
    section.split(&open).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

#[cfg(unix)]
#[test]
fn the_readmes_walk_works_as_printed() {
    let home = home();
    // The README's first command; its walk stands on what that wrote.
    run_in(home.path(), "vectors").ends(0);
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut verdicts = Vec::new();
    let blocks = readme_blocks("Five minutes", "sh");
    for line in blocks.iter().flat_map(|block| block.lines()) {
        let mut shell = std::process::Command::new("sh");
        let ran = shell.args(["-c", line]).current_dir(home.path()).env("PATH", &path).output();
        let ran = ran.unwrap();
        let is_verify = line.starts_with("guardbit verify");
        assert_eq!(ran.status.code(), Some(i32::from(is_verify)), "{line}: {ran:?}");
        if is_verify {
            verdicts.push(String::from_utf8(ran.stdout).unwrap());
        }
    }
    assert_eq!(verdicts, readme_blocks("Five minutes", "text"));
    for made in ["walk.vcd", "walk.fst"] {
        assert!(home.path().join(made).metadata().unwrap().len() > 0, "{made}");
    }
    // And the example under the table of commands.
    let example = readme_blocks("Commands", "console").concat();
    let (command, answer) = example.trim().split_once('\n').unwrap();
    let line = command.strip_prefix("$ ").unwrap();
    let ran = std::process::Command::new("sh").args(["-c", line]).env("PATH", &path).output();
    assert_eq!(String::from_utf8(ran.unwrap().stdout).unwrap().trim(), answer);
}

/// A small mesh to stand in for the reader's own: a bent strip, in the form of an OBJ file.
fn strip() -> String {
    let vertex = |n: i32| {
        let (along, side) = (n / 2, n % 2);
        format!("v {along} {} {}\n", side * 3, along * along % 7)
    };
    let face = |n: i32| format!("f {} {} {}\n", n, n + 1, n + 2);
    (0..24).map(vertex).chain((1..=22).map(face)).collect()
}

#[cfg(unix)]
#[test]
fn the_readmes_search_works_as_printed() {
    let home = home();
    std::fs::write(home.path().join("bunny.obj"), strip()).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_guardbit")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let section = "How few bits are enough?";
    let commands = readme_blocks(section, "sh").concat().replace("\\\n", " ");
    let mut outputs = Vec::new();
    for line in commands.lines() {
        let mut shell = std::process::Command::new("sh");
        let ran = shell.args(["-c", line]).current_dir(home.path()).env("PATH", &path).output();
        let ran = ran.unwrap();
        assert_eq!(ran.status.code(), Some(0), "{line}: {ran:?}");
        outputs.push(String::from_utf8(ran.stdout).unwrap());
    }
    assert_eq!(outputs.len(), 6);
    for made in ["bunny.html", "bunny.svg", "bunny.toml", "sgi-4k.smt2", "sgi-4k.g"] {
        assert!(home.path().join(made).metadata().unwrap().len() > 0, "{made}");
    }
    // What is printed has the lines that the README shows, whatever the mesh.
    let shown = readme_blocks(section, "text").concat();
    let label = |line: &str| line.split_whitespace().next().unwrap_or("").to_owned();
    for line in shown.lines().filter(|line| !line.starts_with([' ', '.'])) {
        let there = outputs[1].lines().any(|printed| label(printed) == label(line));
        assert!(there, "{line}: {}", outputs[1]);
    }
}
