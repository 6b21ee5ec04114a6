//! Scenes of meshes and of JSON Lines by the command: pictures, sets and budgets see their values.

use crate::channels::channel;
use crate::gltf::Gltf;
use crate::run::{Ran, run_in};
use crate::set::tv_rows;
use std::path::Path;

/// The small profile with a colour of 8 bits and texture coordinates in perspective.
fn profile(folder: &Path) {
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let w = "\n[w]\nguard = 1\ninteger = 8\ninterpolation = 8\nrounding = \"nearest-even\"\nclamp = \"guard\"\n";
    let color = channel("color", r#"["r", "g", "b"]"#, 8, "correction = \"affine\"");
    let quotient = "correction = { quotient = { rounding = \"nearest-even\" } }";
    let map = channel("map", r#"["u", "v"]"#, 8, &format!("source = \"texcoord\"\n{quotient}"));
    std::fs::write(folder.join("p.toml"), format!("{tiny}{w}{color}{map}")).unwrap();
}

fn write(folder: &Path, name: &str, content: &str) {
    std::fs::write(folder.join(name), content).unwrap();
}

/// Rows of `channel.cfg` without the number of the test: x y q, r g b, u v of each vertex.
fn given(folder: &Path, set: &str) -> Vec<Vec<u128>> {
    let text = std::fs::read_to_string(folder.join(set).join("channel.cfg.tv")).unwrap();
    tv_rows(&text).into_iter().map(|row| row[1..].to_vec()).collect()
}

/// Triangles before a camera of a right angle, in the window of 4 x 4 pixels: x, y, z and red, green, blue, u, v.
fn gltf(change: [&str; 2]) -> String {
    let places = [
        [-2f32, -2., -2.],
        [2., -2., -4.],
        [-2., 2., -2.],
        [-2., -2., 1.],
        [0., 0., -2.],
        [0., 1., -2.],
    ];
    let mut file = Gltf::default();
    let position = file.floats("VEC3", 6, places.as_flattened());
    let color =
        file.accessor(5121, "VEC3", 6, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    let map = file.floats("VEC2", 6, &[0., 0., 1., 0., 0.2, 1., 0., 0., 0., 0., 0., 0.]);
    let members = format!(
        r#""meshes": [{{"primitives": [{{"attributes": {{"POSITION": {position}, "COLOR_0": {color},
        "TEXCOORD_0": {map}}}}}]}}],
        "cameras": [{{"type": "perspective", "perspective": {{"yfov": 1.5707964, "znear": 1, "zfar": 9}}}}],
        "nodes": [{{"mesh": 0}}, {{"camera": 0}}], "scenes": [{{"nodes": [0, 1]}}]"#
    );
    assert!(members.contains(change[0]), "{change:?}");
    file.text(&members.replacen(change[0], change[1], 1))
}

/// Clauses CH-2, CH-4 and CH-15: the codes of a scene test are those of the mesh, and the set holds them.
#[test]
fn a_set_has_the_values_of_its_mesh() {
    let home = tempfile::tempdir().unwrap();
    let run = |line: &str| -> Ran { run_in(home.path(), line) };
    profile(home.path());
    write(home.path(), "m.gltf", &gltf(["", ""]));
    let ran = run("vectors p.toml --scene m.gltf --count 4000 --out set").ends(0);
    // The second triangle has a vertex behind the eye.
    assert!(ran.err.contains("note: m.gltf: 1 triangles are left out"), "{}", ran.err);
    let why = "nodes[0]: meshes[0].primitives[0]: triangle 1 (from 0): vertex 0 is -1 before the eye: 1 < distance <= 9";
    assert!(ran.err.contains(why), "{}", ran.err);
    // Two sub-pixels a pixel. At distance 2 of a right angle a pixel is 1 wide: x = -2 is the left side of the
    // window, y = -2 its lower one. At 4, x = 2 is a quarter from the right, y = -2 a quarter from below.
    // 1/w: the nearest has 255; half as near is 127.5, which goes to the even 128. u, v by 255.
    let want =
        [[0, 8, 255, 1, 2, 3, 0, 0], [6, 6, 128, 4, 5, 6, 255, 0], [0, 0, 255, 7, 8, 9, 51, 255]];
    let want: Vec<u128> = want.concat();
    assert_eq!(given(home.path(), "set").iter().filter(|row| **row == want).count(), 1);
    run("verify set --recompute").ends(0);
    let scene = std::fs::read_to_string(home.path().join("set/scene.jsonl")).unwrap();
    let line = r#""q":[255,128,255],"channels":{"color":[[1,2,3],[4,5,6],[7,8,9]],"map":[[0,0],[255,0],[51,255]]}}"#;
    assert!(scene.trim_end().ends_with(line), "{scene}");
    // The scene of a set is a scene, with the same codes.
    run("vectors p.toml --scene set/scene.jsonl --count 4000 --out again").ends(0);
    assert_eq!(given(home.path(), "again"), given(home.path(), "set"));
    let changed = scene.replace("[7,8,9]", "[7,8,8]");
    std::fs::write(home.path().join("set/scene.jsonl"), changed).unwrap();
    let ran = run("verify set --recompute").ends(1);
    assert!(ran.out.contains("scene.jsonl"), "{}", ran.out);
}

/// Clause CH-2: what a mesh lacks is refused by its place, by sets and by pictures alike.
#[test]
fn what_a_mesh_lacks_is_named() {
    let home = tempfile::tempdir().unwrap();
    profile(home.path());
    let refused = |name: &str, content: &str, about: &[&str]| {
        write(home.path(), name, content);
        for line in
            ["vectors p.toml --count 400 --out set", "render p.toml --show channel --out a.png"]
        {
            run_in(home.path(), &format!("{line} --scene {name}")).complains(2, about);
        }
        assert!(!home.path().join("set").exists());
    };
    let two = r#"{"mesh": 1}, {"mesh": 0}"#;
    let mesh = r#""meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}, "#;
    let both = gltf(["{\"mesh\": 0}", two]).replacen("\"meshes\": [", mesh, 1).replacen(
        "[0, 1]}]",
        "[0, 1, 2]}]",
        1,
    );
    let first = "m.gltf: nodes[1]: meshes[0].primitives[0]: triangle 0 (from 0): channel \"map\"";
    refused("m.gltf", &both, &[first, "the primitive has no TEXCOORD_0"]);
    refused(
        "m.gltf",
        &gltf(["\"TEXCOORD_0\": 2", "\"TEXCOORD_1\": 2"]),
        &["m.gltf: nodes[0]", "no \"texcoord\"", "it has color"],
    );
    refused(
        "m.gltf",
        &gltf(["\"znear\": 1", "\"znear\": 8"]),
        &["m.gltf: no triangle can be drawn", "8 < distance <= 9"],
    );
    refused("m.stl", "solid\nendsolid\n", &["m.stl: the mesh has no facets"]);
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    refused(
        "m.stl",
        &format!("solid\n{facet}endsolid\n"),
        &["m.stl: line 2", "no \"color\"", "it has normal"],
    );
    let line = r#"{"f": [[0,0],[4,0],[0,4]], "w": [1,2,4], "channels": {"color": [[0,0,1],[1,0,0],[0,1,0]], "texcoord": [[0,0],[1,0],[0,1]]}}"#;
    let lines = |from: &str, to: &str| {
        assert!(line.contains(from));
        format!("{line}\n\n{}\n", line.replace(from, to))
    };
    refused(
        "m.jsonl",
        &lines("\"w\": [1,2,4],", "\"w\": [1,0,4],"),
        &["m.jsonl: line 3: vertex 1: w = 0: 0 < w"],
    );
    refused(
        "m.jsonl",
        &lines("\"w\": [1,2,4],", ""),
        &["m.jsonl: line 3", "each vertex needs its 1/w"],
    );
    refused(
        "m.jsonl",
        &lines("[1,0,0]", "[1,{\"bits\": \"7fc00000\"},0]"),
        &["m.jsonl: line 3", "vertex 1: NaN is not finite"],
    );
    refused(
        "m.jsonl",
        &lines("\"texcoord\"", "\"detail\""),
        &["m.jsonl: line 3", "no \"texcoord\"", "it has color, detail"],
    );
    refused(
        "m.jsonl",
        &format!("{line}\n{{\"v\": [[0,0],[4,0],[0,4]]}}\n"),
        &["m.jsonl: line 2", "it has none"],
    );
    let codes = r#"{"v": [[0,0],[4,0],[0,4]], "q": [1,2,4], "channels": {"color": [[0,0,256],[1,0,0],[0,1,0]], "map": [[0,0],[1,0],[0,1]]}}"#;
    refused("m.jsonl", codes, &["m.jsonl: line 1: channel \"color\", vertex 0: b = 256"]);
    refused(
        "m.jsonl",
        &codes.replace("[1,2,4]", "[1,2,0]").replace("256", "25"),
        &["line 1: vertex 2: q = 0: 1 <= q"],
    );
}

/// Clauses CH-2 and CH-15: lines of `eval` are scenes of sets, pictures and budgets, codes and reals side by side.
#[test]
fn json_lines_carry_channels() {
    let home = tempfile::tempdir().unwrap();
    profile(home.path());
    let lines = concat!(
        r#"{"id": 1, "v": [[0,0,1],[8,0,2],[0,8,3]], "q": [255,128,64], "channels": {"map": [[0,1],[2,3],[4,5]], "color": [[9,9,9,1],[8,8,8,1],[7,7,7,1]], "more": [[1],[2],[3]]}}"#,
        "\n\n",
        r#"{"f": [[0,0,1],[4,0,2],[0,4,3]], "w": [2,2,4], "channels": {"color": [[0,0,1],[1,0,0],[0,1,0.5]], "texcoord": [[0,0],[1,0],[0,0.2]]}}"#,
        "\n"
    );
    write(home.path(), "s.jsonl", lines);
    run_in(home.path(), "vectors p.toml --scene s.jsonl --count 4000 --out set").ends(0);
    let rows = given(home.path(), "set");
    let codes = [[0, 0, 255, 9, 9, 9, 0, 1], [8, 0, 128, 8, 8, 8, 2, 3], [0, 8, 64, 7, 7, 7, 4, 5]]
        .concat();
    let reals = [
        [0, 0, 255, 0, 0, 255, 0, 0],
        [8, 0, 255, 255, 0, 0, 255, 0],
        [0, 8, 128, 0, 255, 128, 0, 51],
    ]
    .concat();
    assert!(rows.contains(&codes) && rows.contains(&reals));
    run_in(home.path(), "verify set --recompute").ends(0);
    let ran = run_in(home.path(), "budget p.toml --scene s.jsonl").ends(0);
    // 255 / 64 of the first line, 2 of the other.
    assert!(ran.out.contains("w changes by a factor of 3.9844 over triangle 0"), "{}", ran.out);
    let ran =
        run_in(home.path(), "render p.toml --scene s.jsonl --show channel --zoom 1 --out a.png")
            .ends(0);
    assert!(ran.out.contains("channel color, codes 0 to 255"), "{}", ran.out);
    let trace =
        run_in(home.path(), "trace p.toml --scene s.jsonl --count 4000 --test channel/scene/0")
            .ends(0);
    assert!(trace.out.contains("9, 8, 7") || trace.out.contains("255, 0"), "{}", trace.out);
}
