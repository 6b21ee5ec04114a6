//! The depth bias by the command: `eval`, sets, dumps and `explore`.

use crate::run::{pipe_in, run_in};
use crate::set::{tv_line, tv_rows};
use guardbit::bits::Rounding;
use guardbit::exact::{ratio, round};
use num_traits::ToPrimitive;
use std::path::Path;

/// The toy with this table of a bias.
fn profile(folder: &Path, name: &str, bias: &str) {
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    std::fs::write(folder.join(name), format!("{tiny}\n[depth.bias]\n{bias}\n")).unwrap();
}

fn eval(folder: &Path, profile: &str, lines: &str) -> (Option<i32>, Vec<serde_json::Value>) {
    let ran = pipe_in(folder, &format!("eval {profile}"), lines);
    let answers = ran.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    (ran.status, answers)
}

/// Clause Z-7: a line's bias stands in place of the profile's for that line alone, in the steps of the stored
/// format. By hand: a flat triangle of depth 2.
#[test]
fn a_line_of_eval_has_the_bias_of_its_draw_call() {
    let home = tempfile::tempdir().unwrap();
    profile(home.path(), "own.toml", "constant = 1\nunit = 2");
    let flat = r#""v":[[0,0,2],[4,0,2],[0,4,2]]"#;
    let line = |bias: &str| format!("{{{flat}{bias}}}\n");
    let biases = [
        "",
        r#","bias":{}"#,
        r#","bias":{"constant":-1}"#,
        r#","bias":{"constant":7,"clamp":3}"#,
        "",
    ];
    let (status, answers) = eval(home.path(), "own.toml", &biases.map(line).concat());
    let codes: Vec<i64> = answers.iter().map(|answer| answer["z"][0].as_i64().unwrap()).collect();
    assert_eq!((status, codes), (Some(0), vec![4, 2, 1, 5, 4]));
    // 1 - 2/7 is 5/7 of [1/2, 1): a code of 2 fraction bits is 1/8, and -2 of them make it nearer by 2/8 to
    // 27/28, which is 7.71 eighths: 1.93 2^-1, the largest code 111.
    let text = std::fs::read_to_string(home.path().join("own.toml")).unwrap();
    let float = "[depth.format.float-far-zero]\nexponent = 1\nmantissa = 2\n";
    std::fs::write(home.path().join("float.toml"), format!("{text}{float}")).unwrap();
    let lines =
        [r#","bias":{}"#, r#","bias":{"constant":-2}"#, r#","bias":{"constant":8}"#].map(line);
    let (status, answers) = eval(home.path(), "float.toml", &lines.concat());
    // 5/7 is 5.71 eighths: 6, e = 1 and m = 2.
    assert_eq!((&answers[0]["z"][0], &answers[1]["z"][0]), (&6.into(), &7.into()));
    let error = answers[2]["error"].as_str().unwrap();
    assert!(status == Some(2) && error.contains("8 * 1 = 8 >= 2^3"), "{error}");
    for (tail, want) in [
        (r#","bias":{"constant":0.5}"#, "field `bias.constant`: 0.5 is not an integer"),
        (r#","bias":{"unit":0}"#, "field `bias.unit`"),
        (r#","bias":{"unit":-1}"#, "field `bias.unit`: a whole number from 1"),
        (r#","bias":{"clamp":8}"#, "field `bias.clamp`"),
        (r#","bias":{"slop":1}"#, "field `bias.slop`: unknown key; the keys of a depth bias are"),
        (r#","bias":{"slope":1,"slope":1}"#, "field `bias.slope`: the key is given twice"),
        (r#","bias":{"slope":9223372036854775808}"#, "field `bias.slope`: a whole number"),
        (r#","bias":[1]"#, "field `bias`: a JSON object is needed"),
    ] {
        let (status, answers) = eval(home.path(), "own.toml", &line(tail));
        let error = answers[0]["error"].as_str().unwrap();
        assert!(status == Some(2) && error.contains(want), "{want}: {error}");
    }
    let (_, answers) = eval(home.path(), "own.toml", "{\"line\":[[0,0],[2,2]],\"bias\":{}}");
    assert!(answers[0]["error"].as_str().unwrap().contains("only triangles"), "{answers:?}");
    let bare = text.split("[depth]").next().unwrap();
    std::fs::write(home.path().join("bare.toml"), bare).unwrap();
    let (_, answers) =
        eval(home.path(), "bare.toml", "{\"v\":[[0,0],[4,0],[0,4]],\"bias\":{\"constant\":1}}");
    let error = answers[0]["error"].as_str().unwrap();
    assert!(error.contains("field `bias`: the profile has no [depth]"), "{error}");
}

/// Clauses Z-7 and J-2: set-up rows hold the biased start, the set recomputes, says that no device sets it up,
/// and a dump without a term of the bias is called by its name.
#[test]
fn a_set_has_the_biased_start() {
    let home = tempfile::tempdir().unwrap();
    profile(home.path(), "with.toml", "constant = 2\nslope = 256");
    let line = "vectors with.toml --scene fan --count 300 --out with";
    run_in(home.path(), line).ends(0);
    run_in(home.path(), "verify with --recompute").ends(0);
    let rows = |file: &str| {
        tv_rows(&std::fs::read_to_string(home.path().join("with").join(file)).unwrap())
    };
    let (cfg, exp) = (rows("setup.cfg.tv"), rows("setup.exp.tv"));
    let mut widths = vec![6; 9];
    widths.extend([7, 7, 7, 1]);
    let (mut dump, mut moved) = (String::new(), 0);
    for (given, words) in cfg.iter().zip(&exp) {
        let v: Vec<i128> = given.iter().map(|word| word.cast_signed()).collect();
        let vertex = |n: usize| [v[3 * n], v[3 * n + 1], v[3 * n + 2]];
        let [a, b, c] = [0, 1, 2].map(vertex);
        let cross =
            |p: usize, q: usize| (b[p] - a[p]) * (c[q] - a[q]) - (c[p] - a[p]) * (b[q] - a[q]);
        let area = cross(0, 1);
        let mut without = words.clone();
        if area == 0 {
            assert!(words[9..12].iter().all(|word| *word == 0));
        } else {
            // 2 sub-pixels a pixel, 8 units a code, nearest-even; the sample of pixel (0, 0) is (1, 1).
            let (gx, gy) = (cross(2, 1), cross(0, 2));
            let near = |n: i128| {
                let exact = ratio(n, area).unwrap();
                round(&exact, Rounding::NearestEven).to_i128().unwrap()
            };
            let start = near(8 * (a[2] * area + gx * (1 - a[0]) + gy * (1 - a[1])));
            let [dx, dy] = [near(16 * gx), near(16 * gy)];
            let word = |value: i128| value.rem_euclid(128).cast_unsigned();
            let bias = 2 * 8 + dx.abs().max(dy.abs());
            assert_eq!(words[9..12], [start + bias, dx, dy].map(word), "{given:?}");
            without[9] = word(start + 2 * 8);
            moved += usize::from(dx != 0 || dy != 0);
        }
        dump += &(tv_line(&without, &widths) + "\n");
    }
    assert!(moved > 100, "{moved}");
    let manifest = std::fs::read_to_string(home.path().join("with/manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let unchecked = manifest["unchecked"].as_array().unwrap();
    assert!(
        unchecked.iter().any(|one| one["bench"] == "setup"
            && one["reason"].as_str().unwrap().contains("[depth.bias]"))
    );
    std::fs::write(home.path().join("setup.exp.dut.tv"), dump).unwrap();
    let ran = run_in(home.path(), "verify with --dut setup.exp.dut.tv").ends(1);
    assert!(ran.out.contains("depth.bias.slope is left out"), "{}", ran.out);
    // What does not count a bias says so.
    run_in(home.path(), "prove with.toml")
        .complains(2, &["[depth.bias]", "leave [depth.bias] out"]);
    run_in(home.path(), "export with.toml --as c").complains(2, &["[depth.bias]"]);
    let scene = "{\"v\":[[0,0],[4,0],[0,4]],\"bias\":{\"constant\":1}}\n";
    std::fs::write(home.path().join("scene.jsonl"), scene).unwrap();
    run_in(home.path(), "vectors tiny --scene scene.jsonl --out x")
        .complains(2, &["scene.jsonl", "field `bias`", "a triangle of a scene has no depth bias"]);
}

/// Clauses Q-1 and Z-7: the order of surfaces is measured under a bias. Two surfaces fall 2 codes a pixel, and a
/// flat one lies behind them.
#[test]
fn explore_varies_the_bias() {
    let home = tempfile::tempdir().unwrap();
    let mut profile = guardbit::profile::load("sgi-4k").unwrap();
    profile.window = guardbit::profile::WindowConfig { width: 16, height: 16 };
    let text = profile.to_toml();
    std::fs::write(home.path().join("p.toml"), format!("{text}\n[depth.bias]\n")).unwrap();
    // In sub-pixels of 1/1024: 16 pixels are 16384.
    let near = r#"{"v":[[0,0,1000],[16384,0,1032],[0,16384,1000]]}"#;
    let far = r#"{"v":[[0,0,1008],[16384,0,1040],[0,16384,1008]]}"#;
    let flat = r#"{"v":[[0,0,1040],[16384,0,1040],[0,16384,1040]]}"#;
    std::fs::write(home.path().join("s.jsonl"), [near, far, flat].join("\n")).unwrap();
    let vary = "explore p.toml --scene s.jsonl --vary bias-slope=0,1280,12800 --vary bias-constant=-2..2 \
                --objective inversions --objective area --csv";
    let ran = run_in(home.path(), vary).ends(0);
    let mut lines = ran.out.lines();
    let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| heads.iter().position(|head| *head == name).unwrap();
    let [slope, constant, inversions, worst] =
        ["bias-slope", "bias-constant", "inversions", "depth-worst"].map(column);
    let mut seen = 0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |at: usize| cells[at].parse::<f64>().unwrap();
        // A constant moves all alike. In column x the flat one is 31 - 2 x codes behind. Five slopes, 10 codes,
        // take the steep ones behind it from column 11 on; 50 slopes, 100 codes, at all 120 covered pixels.
        match cells[slope].parse::<i64>().unwrap() {
            0 => assert!(number(inversions) == 0.0, "{line}"),
            1280 => assert!((1.0..120.0).contains(&number(inversions)), "{line}"),
            _ => assert!(number(inversions) >= 120.0, "{line}"),
        }
        assert!((-2.0..=2.0).contains(&number(constant)) && number(worst) < 0.5, "{line}");
        seen += 1;
    }
    assert_eq!(seen, 15);
    run_in(home.path(), "explore sgi-4k --scene fan --vary bias-constant=0..2")
        .complains(2, &["bias-constant: the profile does not have this field"]);
    run_in(home.path(), "explore p.toml --scene s.jsonl --vary bias-slope=steep")
        .complains(2, &["bias-slope = steep: a whole number with its sign is expected"]);
}
