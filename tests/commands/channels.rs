//! Channels by the command: `eval`, a set, and dumps of devices with typical faults.

use crate::run::{pipe_in, run_in};
use crate::set::tv_rows;
use std::path::Path;

/// A channel of 8 bits under the guard clamp, unless `rest` says otherwise.
pub(crate) fn channel(name: &str, components: &str, interpolation: u32, rest: &str) -> String {
    format!(
        "\n[[channel]]\nname = \"{name}\"\ncomponents = {components}\nguard = 1\ninteger = 8\n\
         interpolation = {interpolation}\nrounding = \"nearest-even\"\nclamp = \"guard\"\n{rest}\n"
    )
}

/// A colour, texture coordinates by quotient and by a reciprocal unit, a number of each face.
fn channels() -> String {
    let w = "\n[w]\nguard = 1\ninteger = 8\ninterpolation = 8\nrounding = \"nearest-even\"\nclamp = \"guard\"\n";
    let unit = r#"
[channel.correction.reciprocal]
rounding = "nearest-even"

[channel.correction.reciprocal.unit]
operand = 12
index = 4
entry = 8
refine = { newton = { bits = [14] } }
"#;
    let affine = "start-bias = \"half\"\ncorrection = \"affine\"";
    let quotient = "correction = { quotient = { rounding = \"nearest-even\" } }";
    let flat = "correction = { flat = { provoking = \"last\" } }";
    [
        w.to_owned(),
        channel("color", r#"["r", "g"]"#, 4, affine),
        channel("texcoord", r#"["u", "v"]"#, 8, quotient),
        channel("detail", r#"["u"]"#, 8, unit),
        channel("face", r#"["id"]"#, 0, flat),
    ]
    .concat()
}

fn profile(folder: &Path, name: &str, change: [&str; 2]) {
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    assert!(channels().contains(change[0]), "{change:?}");
    let text = tiny + &channels().replacen(change[0], change[1], 1);
    std::fs::write(folder.join(name), text).unwrap();
}

fn eval(folder: &Path, profile: &str, line: &str) -> (Option<i32>, String) {
    let ran = pipe_in(folder, &format!("eval {profile}"), line);
    (ran.status, ran.out)
}

/// Clauses CH-2 to CH-5 at one sample, by hand: the triangle (0, 0), (8, 0), (0, 8) in halves of a pixel,
/// sample (1, 1) of pixel (0, 0) has weights 6/8, 1/8, 1/8.
#[test]
fn eval_answers_with_codes() {
    let home = tempfile::tempdir().unwrap();
    profile(home.path(), "p.toml", ["", ""]);
    let line = r#"{"v":[[0,0],[8,0],[0,8]],"q":[255,128,64],"channels":{"color":[[0,8],[8,8],[16,8]],"texcoord":[[0,0],[80,0],[0,160]],"detail":[[40],[40],[40]],"face":[[1],[2],[3]]}}"#;
    let (status, out) = eval(home.path(), "p.toml", line);
    assert_eq!(status, Some(0), "{out}");
    let answer: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(answer["rows"], serde_json::json!([[0, 0, 3], [1, 0, 2], [2, 0, 1]]));
    let first = |name: &str| answer["channels"][name][0].clone();
    // 0 6/8 + 8/8 + 16/8 = 3.
    assert_eq!(first("color"), serde_json::json!([3, 8]));
    // 80 128 / (6 255 + 128 + 64) = 5.95; 160 64 / 1722 = 5.95.
    assert_eq!(first("texcoord"), serde_json::json!([6, 6]));
    assert_eq!(first("detail"), serde_json::json!([40]));
    assert_eq!(first("face"), serde_json::json!([3]));
    let real = r#"{"f":[[0,0],[4,0],[0,4]],"w":[1,2,4],"channels":{"color":[[0,0],[1,0],[0,1]],"texcoord":[[0,0],[1,0],[0,1]],"detail":[[0.5],[0.5],[0.5]],"face":[[0],[0],[1]]}}"#;
    let (status, out) = eval(home.path(), "p.toml", real);
    assert!(status == Some(0) && out.contains(r#""face": [[255]"#), "{out}");
    for (line, want) in [
        (line.replace("255,128,64", "255,128,0"), "vertex 2: q = 0: 1 <= q <= 255"),
        (line.replace(r#""q":[255,128,64],"#, ""), "each vertex needs its 1/w"),
        (line.replace("[80,0]", "[80,256]"), "v = 256: 0 <= v <= 255"),
        (line.replace(r#""face":"#, r#""fase":"#), "channel \\\"fase\\\" is unknown"),
        (line.replace("[[40],[40],[40]]", "[[4,0],[4,0],[4,0]]"), "2 components are given"),
        (real.replace("[1,2,4]", "[1,-2,4]"), "vertex 1: w = -2: 0 < w"),
    ] {
        let (status, out) = eval(home.path(), "p.toml", &line);
        assert!(status == Some(2) && out.contains(want), "{want}: {out}");
    }
    let (status, out) = eval(home.path(), "tiny", line);
    assert!(status == Some(2) && out.contains("has no [[channel]]"), "{out}");
}

/// Clause CH-21 by hand: u rises by 16 a pixel to the right, v by 8 a pixel downward. With 64 texels for 64 codes
/// the longer axis has 16 texels, so the level is 4, in quarters 16.
#[test]
fn levels_of_detail_are_answered_and_filed() {
    let home = tempfile::tempdir().unwrap();
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let rest = "correction = \"affine\"\ndetail = { texels = [64, 64], unit = 64, length = \"exact\", fraction = 2, levels = 6 }";
    let text = tiny + &channel("texcoord", r#"["u", "v"]"#, 4, rest);
    std::fs::write(home.path().join("p.toml"), text).unwrap();
    let line = r#"{"v":[[0,0],[8,0],[0,8]],"channels":{"texcoord":[[0,0],[64,0],[0,32]]}}"#;
    let (status, out) = eval(home.path(), "p.toml", line);
    assert_eq!(status, Some(0), "{out}");
    let answer: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(answer["detail"], serde_json::json!({"texcoord": [16, 16, 16, 16, 16, 16]}));
    let scene = format!("{line}\n");
    std::fs::write(home.path().join("s.jsonl"), scene).unwrap();
    run_in(home.path(), "vectors p.toml --scene s.jsonl --count 600 --out set").ends(0);
    run_in(home.path(), "verify set --recompute").ends(0);
    let file = home.path().join("set/channel-texcoord-detail.exp.tv");
    let rows = tv_rows(&std::fs::read_to_string(file).unwrap());
    // The test of the scene: its number, y and x of a pixel, and 16 0 0 8 by 9 bits, 16 by 5.
    let wanted = rows.iter().filter(|row| row[3..] == [16, 0, 0, 8, 16]);
    assert_eq!(wanted.count(), 6);
}

/// Clauses CH-13 and CH-15: the words of a set are those of the planes of its own vertices, and dumps of
/// typical faults are called by name.
#[test]
fn a_set_has_channels_and_names_their_faults() {
    let home = tempfile::tempdir().unwrap();
    let vectors = |name: &str| {
        let line = format!("vectors {name}.toml --scene fan --count 4000 --out {name}");
        run_in(home.path(), &line).ends(0)
    };
    profile(home.path(), "set.toml", ["", ""]);
    vectors("set");
    run_in(home.path(), "verify set --recompute").ends(0);
    let rows =
        |file: &str| tv_rows(&std::fs::read_to_string(home.path().join("set").join(file)).unwrap());
    let (cfg, setup) = (rows("channel.cfg.tv"), rows("channel-setup.exp.tv"));
    assert_eq!(cfg.len(), setup.len());
    let mut planes = 0;
    for (given, words) in cfg.iter().zip(&setup) {
        // test, then a vertex: x y q, r g, u v, u, id.
        let vertex = |n: usize| given[1 + 9 * n..][..9].to_vec();
        let v = [0, 1, 2].map(|n| vertex(n).into_iter().map(u128::cast_signed).collect::<Vec<_>>());
        let area =
            (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
        if area == 0 {
            assert!(words[1..].iter().all(|word| *word == 0));
            continue;
        }
        // w_dx, the change of q to the right: 2 sub-pixels a pixel, 8 bits below the point.
        let rise = |part: usize| {
            let (one, two) = (v[1][part] - v[0][part], v[2][part] - v[0][part]);
            one * (v[2][1] - v[0][1]) - two * (v[1][1] - v[0][1])
        };
        let exact = guardbit::exact::ratio(rise(2) << (1 + 8), area).unwrap();
        let nearest = guardbit::exact::round(&exact, guardbit::bits::Rounding::NearestEven);
        let nearest = i128::try_from(nearest).unwrap();
        assert_eq!(words[2], nearest.cast_unsigned() & 0x1_ffff, "{given:?}");
        planes += 1;
    }
    assert!(planes > 100, "{planes}");
    for (file, change, cause) in [
        (
            "detail",
            ["refine = { newton = { bits = [14] } }\n", ""],
            "the last Newton step is missing",
        ),
        ("detail", ["operand = 12", "operand = 11"], "the operand has 11 bits"),
        ("texcoord", ["{ quotient = ", "{ constant-w = "], "w is constant along a span"),
        (
            "texcoord",
            ["correction = { quotient", "at = \"corner\"\ncorrection = { quotient"],
            "at is corner",
        ),
        ("color", ["start-bias = \"half\"\n", ""], "start-bias is none"),
        ("face", ["\"last\"", "\"first\""], "the first vertex is provoking"),
    ] {
        let _ = std::fs::remove_dir_all(home.path().join("other"));
        profile(home.path(), "other.toml", change);
        vectors("other");
        let line = format!("verify set --dut other/channel-{file}.exp.tv");
        let ran = run_in(home.path(), &line).ends(1);
        let want = format!("likely cause: channel {file}: {cause}");
        assert!(ran.out.contains(&want) && ran.out.contains("placed: interpolator"), "{}", ran.out);
    }
    run_in(home.path(), "export set.toml --as c").complains(2, &["no reference", "channels"]);
}

/// Clauses CH-2 and CH-3: a mesh brings its values to a picture, looked at by its pixels; what it lacks is
/// named by its line.
#[test]
fn pictures_show_channels_of_a_mesh() {
    let home = tempfile::tempdir().unwrap();
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let affine = "correction = \"affine\"";
    let color = channel("color", r#"["r", "g", "b"]"#, 8, affine);
    let texture = channel("map", r#"["u", "v"]"#, 8, &format!("source = \"texcoord\"\n{affine}"));
    std::fs::write(home.path().join("p.toml"), format!("{tiny}{color}{texture}")).unwrap();
    let mesh = "v 0 0 0 1 0 .5\nv 9 0 0 1 0 .5\nv 9 9 0 1 0 .5\nv 0 9 0 1 0 .5\n\
                vt .1 .1\nvt .2 .1\nvt .2 .2\nvt .1 .2\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(home.path().join("m.obj"), mesh).unwrap();
    let render = |rest: &str| {
        run_in(home.path(), &format!("render p.toml --scene m.obj --zoom 1 --out p.png {rest}"))
    };
    let colours = || {
        let file = std::fs::File::open(home.path().join("p.png")).unwrap();
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels.chunks(3).map(<[u8]>::to_vec).collect::<Vec<_>>()
    };
    render("--show channel").ends(0);
    // 1 is 255; 0.5 is 127.5, which goes to the even 128.
    let painted = colours().iter().filter(|pixel| **pixel == [255, 0, 128]).count();
    assert!(painted >= 4 && colours().iter().all(|p| *p == [255, 0, 128] || *p == [24, 26, 32]));
    render("--show checker --channel map --squares 2").ends(0);
    // All coordinates lie in the first square.
    assert!(colours().iter().any(|pixel| *pixel == [222, 214, 190]));
    assert!(!colours().iter().any(|pixel| *pixel == [40, 44, 60]));
    render("--show checker --channel none")
        .complains(2, &["channels of the profile are color, map"]);
    run_in(home.path(), "render tiny --show channel").complains(2, &["has no channels"]);
    run_in(home.path(), "render p.toml --scene knot --show channel")
        .complains(2, &["has no \"color\""]);
    std::fs::write(home.path().join("m.obj"), mesh.replace("2/2", "2")).unwrap();
    render("--show channel")
        .complains(2, &["m.obj: line 9: channel", "corner 2 of `f` has no texture"]);
    std::fs::write(home.path().join("m.obj"), mesh.replace("v 9 9 0 1 0 .5", "v 4 -9 0 1 0 .5"))
        .unwrap();
    render("--show channel").complains(2, &["m.obj: line 9: `f` crosses itself"]);
}

/// Clauses A-12 and M-9: the errors of a channel for every machine, by hand, and as a picture with its scale. The code
/// of `r` is x + 1/2 exactly; half a code is added and the fraction is cut off, so that each is 1/2 too large. `g`
/// is 0. A value for each triangle needs no channel.
#[test]
fn errors_of_a_channel_are_compared_and_drawn() {
    let home = tempfile::tempdir().unwrap();
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let affine = "start-bias = \"half\"\ncorrection = \"affine\"";
    let channels =
        channel("color", r#"["r", "g"]"#, 8, affine) + &channel("face", r#"["id"]"#, 8, affine);
    std::fs::write(home.path().join("p.toml"), tiny + &channels).unwrap();
    let end = 4.0 / 255.0;
    let line = format!(
        r#"{{"f": [[0,0],[4,0],[0,4]], "channels": {{"color": [[0,0],[{end},0],[0,0]], "face": [[1],[1],[1]]}}}}"#
    );
    std::fs::write(home.path().join("s.jsonl"), line).unwrap();
    let run = |line: &str| run_in(home.path(), line).ends(0);
    let ran = run("compare p.toml --scene s.jsonl --no-time --json");
    let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
    for row in report["machines"].as_array().unwrap() {
        let channels = row["channels"].as_array().unwrap();
        assert_eq!(channels.len(), 1, "{row}");
        let ulp = &channels[0]["ulp"];
        for (figure, want) in [("worst", 0.5), ("mean", 0.25), ("rms", 0.125f64.sqrt())] {
            let seen = ulp[figure].as_f64().unwrap();
            assert!((seen - want).abs() < 1e-9, "{}: {figure} {seen}", row["name"]);
        }
    }
    // The scene has no depth, either.
    let saved = report["saved"].as_array().unwrap();
    assert_eq!((saved.len(), &saved[1]["evaluator"]), (2, &"channel face".into()));
    assert!(saved[1]["area_um2"].as_f64().unwrap() > 0.0, "{saved:?}");
    let ran = run("compare p.toml --scene s.jsonl --no-time");
    assert!(ran.out.contains("left out: channel face (the scene has one value"), "{}", ran.out);
    let ran = run("compare p.toml --scene knot --no-time");
    assert!(ran.out.contains("left out: channel color (the vertices"), "{}", ran.out);
    let render = "render p.toml --scene s.jsonl --window 4x4 --show error --out e.png";
    let ran = run(&format!("{render} --channel color"));
    let want = "0 missing, 0 extra, error of color worst 0.500 mean 0.500 ULP; blue: 1/512 ULP or \
                less, red: 1/2 ULP";
    assert!(ran.out.contains(want), "{}", ran.out);
    let file = std::fs::File::open(home.path().join("e.png")).unwrap();
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    // 4 pixels, each of 64 x 64, and a legend of 32 rows; every covered pixel is at the end of the scale.
    assert_eq!((reader.info().width, reader.info().height), (256, 256 + 32));
    assert_eq!(pixels[..3], [206, 44, 40]);
    run_in(home.path(), &format!("{render} --channel none")).complains(2, &["color, face"]);
    run_in(home.path(), "render tiny --show error --channel color")
        .complains(2, &["has no channels"]);
    run_in(home.path(), "render p.toml --scene knot --show error --channel color")
        .complains(2, &["no errors to show"]);
}

/// The README's profile draws a mesh with texture coordinates and colours, and its set verifies.
#[test]
fn the_readmes_profile_draws_a_mesh() {
    let home = tempfile::tempdir().unwrap();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in ["textured.toml", "cubes.gltf"] {
        std::fs::copy(examples.join(name), home.path().join(name)).unwrap();
    }
    let run = |line: &str| run_in(home.path(), line).ends(0);
    let small = "--scene cubes.gltf --window 64x64 --out a.png";
    let ran = run(&format!("render textured.toml {small} --show channel --channel color"));
    assert!(ran.out.contains("960 triangles of cubes"), "{}", ran.out);
    run(&format!("render textured.toml {small} --show checker --channel map"));
    let ran = run("vectors textured.toml --scene cubes.gltf --count 1000 --out set");
    assert_eq!(ran.err, "");
    let manifest = std::fs::read_to_string(home.path().join("set/manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let of_scene =
        |group: &&serde_json::Value| group["bench"] == "channel" && group["tag"] == "scene";
    assert!(manifest["groups"].as_array().unwrap().iter().find(of_scene).is_some());
    let ran = run("verify set --recompute");
    assert!(ran.out.contains("PASS"), "{}", ran.out);
    // A mesh of large triangles alone gives the bench none, and the command says so.
    let quad =
        "v 0 0 0 1 0 0\nv 9 0 0 0 1 0\nv 9 0 9 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    std::fs::write(home.path().join("quad.obj"), quad).unwrap();
    let ran = run("vectors textured.toml --scene quad.obj --count 1000 --out large");
    assert!(ran.err.contains("note: quad.obj: no triangle is small enough"), "{}", ran.err);
    let ran = run("vectors textured.toml --scene fan --count 1000 --out own");
    assert!(ran.err.contains("note: fan: the vertices carry no values"), "{}", ran.err);
}
