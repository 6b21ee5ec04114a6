//! The command at its edges: differences, reports, streams, and bad input.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::run;
use crate::set;

use run::{Ran, run_in};
use set::{copy, options, profile, tree, write_set};
use std::collections::BTreeSet;
use tempfile::TempDir;

pub(crate) fn home() -> TempDir {
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
