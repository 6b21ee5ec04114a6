//! A smoke run of the fuzz targets: seeds that are read, and the same seeds spoiled.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/targets.rs"]
#[allow(unreachable_pub, reason = "public for the fuzz binaries")]
mod targets;

use guardbit::case::Words;
use guardbit::profile::BUILTIN;

/// Spoiled copies of each seed.
const COPIES: u64 = 60;

/// Texts that the targets take as they are.
fn seeds(target: &str) -> Vec<String> {
    let own: &[&str] = match target {
        "profile" => return BUILTIN.iter().map(|(_, text)| (*text).to_owned()).collect(),
        "eval" => &[
            r#"{"id": 1, "v": [[0,0,0],[8,0,7],[0,8,7]]}"#,
            r#"{"id": null, "f": [[0.5,{"bits": "7fc00000"}],[4,0],[0,4]]}"#,
            r#"{"line": [[1,1],[5,1]]}"#,
            r#"{"point": [3,5]}"#,
            r#"{"polygon": [[0,0],[8,0],[8,8],[0,8]]}"#,
            r#"{"clip": [[0,0,0,1],[8,0,7,1],[0,8,7,1]]}"#,
            r#"{"words": ["64","64","96","64","64","96","48","48","127","127"]}"#,
        ],
        "scene" => &[
            "{\"v\": [[0,0],[8,0],[0,8]]}\n\n{\"f\": [[0,0,1e300],[4.5,0,0],[0,-4,1]]}\n",
            r#"{"v": [[0,0],[8,0],[0,8]], "q": [1,2,3], "channels": {"c": [[1],[2],[3]], "d": [[],[],[]]}}"#,
        ],
        "mesh" => &[
            "v 0 0 0\nv 1e3 0 0\nv 0 1 .5\nv 0 0 1 # a comment\nf 1 2 3 -1\n",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty double y\nproperty short z\n\
             property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
             property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 1 2 3\n0 .5 0 1 2 3\n3 0 1 2\n",
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
            r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"camera":0,"scale":[1,2,3]}],
            "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],"buffers":[{"byteLength":36,
            "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
            "bufferViews":[{"buffer":0,"byteLength":36}],
            "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":0},"mode":5}]}]}"#,
        ],
        "layout" => &["x:11", "-mode:4@28 rows:11@16 count:11", "a[16]:8@4 %d", "b:32 %8x"],
        "words" => &["64 64 96 64 64 96 48 48 127 127", "0 ffffffff 80000000"],
        "axis" => &["guard=0..2,4", "form=tiles,scanline", "rounding=floor", "edge-width=exact"],
        "dump" => &["00000000_0000000001_000000\n00000000_xxxxxxxxxx_0z0000 // late\r\n"],
        "set" => {
            let home = tempfile::tempdir().unwrap();
            let set = home.path().join("sets");
            let manifest = targets::write_set(&set).to_text();
            return vec![manifest, std::fs::read_to_string(set.join("sets.json")).unwrap()];
        }
        other => panic!("no seed for {other}"),
    };
    own.iter().map(|seed| (*seed).to_owned()).collect()
}

/// The seed with a few bytes changed, taken out, doubled or swapped for a hostile piece.
fn spoiled(seed: &[u8], mut draw: Words) -> Vec<u8> {
    const PIECES: [&str; 12] = [
        "",
        "\0",
        "\n",
        "-",
        "99999999999999999999999999999999999999999",
        "1e999",
        "[[[[",
        "}",
        "\"",
        "_",
        "\u{feff}",
        "=",
    ];
    let mut text = seed.to_vec();
    for _ in 0..=draw.below(4) {
        let at = usize::try_from(draw.below(text.len() as u64 + 1)).unwrap();
        let piece = PIECES[usize::try_from(draw.below(12)).unwrap()].as_bytes();
        let end = (at + usize::try_from(draw.below(6)).unwrap()).min(text.len());
        match draw.below(4) {
            0 => drop(text.splice(at..end, piece.iter().copied())),
            1 => text.truncate(at),
            2 => text.extend_from_within(at..end),
            _ => text.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << draw.below(8)),
        }
    }
    text
}

/// A text with one of its numbers replaced by another, mostly by one at the end of a type: what grammars allow and
/// nobody writes.
fn renumbered(text: &str, mut draw: Words) -> String {
    const NUMBERS: [&str; 8] =
        ["0", "1", "2", "129", "4294967295", "4294967296", "18446744073709551615", "-1"];
    let digit = |at: &usize| text.as_bytes()[*at].is_ascii_digit();
    let begins: Vec<usize> =
        (0..text.len()).filter(|at| digit(at) && (*at == 0 || !digit(&(at - 1)))).collect();
    if begins.is_empty() {
        return text.to_owned();
    }
    let at = begins[usize::try_from(draw.below(begins.len() as u64)).unwrap()];
    let end = (at..text.len()).find(|at| !digit(at)).unwrap_or(text.len());
    let number = NUMBERS[usize::try_from(draw.below(8)).unwrap()];
    format!("{}{number}{}", &text[..at], &text[end..])
}

#[test]
fn numbers_at_the_ends_of_their_types_do_no_harm() {
    for (name, copies) in [("set", 8), ("profile", 1), ("eval", 25), ("scene", 25)] {
        let (_, target) = targets::TARGETS.into_iter().find(|(known, _)| *known == name).unwrap();
        for (n, seed) in seeds(name).iter().enumerate() {
            for copy in 0..copies {
                let text = renumbered(seed, Words::new(21, n as u64, copy));
                target(text.as_bytes());
            }
        }
    }
}

#[test]
fn readers_take_what_is_right_and_survive_what_is_not() {
    for (name, target) in targets::TARGETS {
        let seeds = seeds(name);
        target(&[]);
        target(&[0xff; 9]);
        for (n, seed) in seeds.iter().enumerate() {
            target(seed.as_bytes());
            for copy in 0..COPIES {
                let key = Words::new(20, n as u64, copy);
                target(&spoiled(seed.as_bytes(), key));
            }
        }
    }
}

/// A target that takes nothing would test nothing: each seed is read by its reader.
#[test]
fn the_seeds_are_read() {
    use guardbit::{explore::space::Axis, format::Layout, profile, scene};
    for seed in seeds("profile") {
        profile::parse(&seed, "seed").unwrap();
    }
    for seed in seeds("eval") {
        scene::lines::parse_line(&seed).unwrap();
    }
    scene::lines::parse_scene(&seeds("scene")[0]).unwrap();
    let meshes = seeds("mesh");
    assert_eq!(scene::mesh::obj::parse(&meshes[0]).unwrap().triangles.len(), 2);
    assert_eq!(scene::mesh::ply::parse(meshes[1].as_bytes()).unwrap().triangles.len(), 1);
    assert_eq!(scene::mesh::stl::parse(meshes[2].as_bytes()).unwrap().triangles.len(), 1);
    let gltf = scene::mesh::gltf::parse(meshes[3].as_bytes(), std::path::Path::new("")).unwrap();
    assert_eq!(gltf.triangles.len(), 1);
    Layout::parse(&seeds("layout")).unwrap();
    for seed in seeds("axis") {
        Axis::parse(&seed).unwrap();
    }
    assert!(targets::TARGETS.iter().all(|(name, _)| !seeds(name).is_empty()));
}
