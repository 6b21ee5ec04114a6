//! Meshes of every format: one quadrilateral in all of them. Clause CH-2.

#[path = "meshes/gltf.rs"]
mod gltf_files;
#[path = "meshes/ply.rs"]
mod ply_files;

use crate::gltf::Gltf;
use guardbit::scene::mesh::{Mesh, MeshError, Point, gltf, obj, ply, stl};
use guardbit::scene::{self, Attributes, Place, Scene, Triangle, Viewport};
use std::path::Path;

const VIEW: Viewport = Viewport { width: 64, height: 48, depth_max: 0xff_ffff };

/// A quadrilateral on a slope: x, y, z, then u, v, then red, green, blue of 255.
const QUAD: [([f32; 3], [f32; 2], [u8; 3]); 4] = [
    ([0.0, 0.0, 0.0], [0.0, 0.0], [255, 0, 0]),
    ([2.0, 0.0, 0.0], [1.0, 0.0], [0, 255, 0]),
    ([2.0, 1.0, 0.5], [1.0, 0.5], [0, 0, 255]),
    ([0.0, 1.0, 0.5], [0.0, 0.5], [51, 102, 204]),
];
const NORMAL: [f32; 3] = [0.0, -0.5, 1.0];

/// Nodes and scene of a file with one mesh.
const ONE: &str = r#""nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0"#;

fn as_obj() -> String {
    let line = |(place, uv, rgb): &([f32; 3], [f32; 2], [u8; 3])| {
        let [x, y, z] = place;
        let [r, g, b] = rgb.map(|code| f64::from(code) / 255.0);
        format!("v {x} {y} {z} {r:?} {g:?} {b:?}\nvt {} {}\n", uv[0], uv[1])
    };
    let [x, y, z] = NORMAL;
    let lines: Vec<String> = QUAD.iter().map(line).collect();
    format!("{}vn {x} {y} {z}\nf 1/1/1 2/2/1 3/3/1 4/4/1\n", lines.concat())
}

/// Header, then numbers of a vertex as words, or as bytes of a binary file.
fn as_ply(encoding: &str) -> Vec<u8> {
    let mut file = format!(
        "ply\nformat {encoding} 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n\
         property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n\
         property uchar green\nproperty uchar blue\nproperty float s\nproperty double t\n\
         element edge 1\nproperty list uchar short ends\n\
         element face 1\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    if encoding == "ascii" {
        for (at, uv, rgb) in QUAD {
            let (at, n) = (at.map(|v| v.to_string()), NORMAL.map(|v| v.to_string()));
            let rgb = rgb.map(|v| v.to_string());
            let line = [&at[..], &n, &rgb, &uv.map(|v| v.to_string())].concat().join(" ");
            file.extend(format!("{line}\n").bytes());
        }
        file.extend(b"2 0 1\n7 4 0 1 2 3");
        return file;
    }
    let big = encoding == "binary_big_endian";
    let mut put = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        if big {
            bytes.reverse();
        }
        file.extend(bytes);
    };
    for (at, uv, rgb) in QUAD {
        at.iter().chain(&NORMAL).for_each(|value| put(&value.to_le_bytes()));
        for code in rgb {
            put(&[code]);
        }
        put(&uv[0].to_le_bytes());
        put(&f64::from(uv[1]).to_le_bytes());
    }
    put(&[2]);
    for end in [0i16, 1] {
        put(&end.to_le_bytes());
    }
    put(&[7]);
    put(&[4]);
    for corner in [0i32, 1, 2, 3] {
        put(&corner.to_le_bytes());
    }
    file
}

fn as_stl(binary: bool) -> Vec<u8> {
    let facets = [[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|n: usize| QUAD[n].0));
    if !binary {
        let [x, y, z] = NORMAL;
        let vertex = |[x, y, z]: &[f32; 3]| format!("vertex {x} {y} {z}\n");
        let facet = |corners: &[[f32; 3]; 3]| {
            let corners: String = corners.iter().map(vertex).collect();
            format!("facet normal {x} {y} {z}\nouter loop\n{corners}endloop\nendfacet\n")
        };
        let facets: String = facets.iter().map(facet).collect();
        return format!("solid quad\n{facets}endsolid quad\n").into_bytes();
    }
    let mut file = vec![0; 80];
    file.extend(2u32.to_le_bytes());
    for corners in facets {
        let numbers = NORMAL.iter().chain(corners.as_flattened());
        file.extend(numbers.flat_map(|value| value.to_le_bytes()));
        file.extend([0; 2]);
    }
    file
}

/// The quadrilateral, with its colours as bytes, shorts or floats of three or four components.
fn quad(color: u32, shape: &str) -> (Gltf, String) {
    let mut file = Gltf::default();
    let places: Vec<f32> = QUAD.iter().flat_map(|(at, ..)| *at).collect();
    let uvs: Vec<f32> = QUAD.iter().flat_map(|(_, uv, _)| *uv).collect();
    let (position, texcoord) = (file.floats("VEC3", 4, &places), file.floats("VEC2", 4, &uvs));
    let normal = file.floats("VEC3", 4, [NORMAL; 4].as_flattened());
    let mut bytes = Vec::new();
    for (.., rgb) in QUAD {
        let alpha = (shape == "VEC4").then_some(255);
        for code in rgb.into_iter().chain(alpha) {
            match color {
                5121 => bytes.push(code),
                5123 => bytes.extend((u16::from(code) * 257).to_le_bytes()),
                _ => bytes.extend((f32::from(code) / 255.0).to_le_bytes()),
            }
        }
    }
    let color = file.accessor(color, shape, 4, &bytes);
    let indices = file.accessor(5121, "SCALAR", 6, &[0, 1, 2, 0, 2, 3]);
    let mesh = format!(
        r#""meshes": [{{"primitives": [{{"attributes": {{"POSITION": {position}, "TEXCOORD_0": {texcoord},
        "NORMAL": {normal}, "COLOR_0": {color}}}, "indices": {indices}}}]}}]"#
    );
    (file, mesh)
}

fn parse_gltf(text: &str) -> Result<Mesh, MeshError> {
    Ok(gltf::parse(text.as_bytes(), Path::new(""))?)
}

/// The values of one name, or none.
fn values<'a>(mesh: &'a Mesh, name: &str) -> Option<&'a [f64]> {
    mesh.sets.iter().find(|set| set.name == name).map(|set| &set.values[..])
}

#[test]
fn every_format_gives_the_same_triangles_and_values() {
    let want = obj::parse(&as_obj()).unwrap();
    assert_eq!(want.triangles.len(), 2);
    let (file, mesh) = quad(5121, "VEC3");
    let members = format!("{mesh}, {ONE}");
    let normal = [NORMAL.map(f64::from); 6];
    for (name, got) in [
        ("gltf", gltf::parse(file.text(&members).as_bytes(), Path::new("")).unwrap()),
        ("glb", gltf::parse(&file.binary(&members), Path::new("")).unwrap()),
        ("ascii ply", ply::parse(&as_ply("ascii")).unwrap()),
        ("little ply", ply::parse(&as_ply("binary_little_endian")).unwrap()),
        ("big ply", ply::parse(&as_ply("binary_big_endian")).unwrap()),
        ("ascii stl", stl::parse(&as_stl(false)).unwrap()),
        ("binary stl", stl::parse(&as_stl(true)).unwrap()),
    ] {
        assert_eq!(got.triangles, want.triangles, "{name}");
        if name.ends_with("stl") {
            assert_eq!(got.sets.len(), 1);
        } else {
            assert_eq!(values(&got, "texcoord"), values(&want, "texcoord"), "{name}");
            assert_eq!(values(&got, "color"), values(&want, "color"), "{name}");
        }
        if !name.starts_with("gl") {
            // glTF brings normals to length 1.
            assert_eq!(values(&got, "normal"), Some(normal.as_flattened()), "{name}");
        }
    }
    let places = |mesh: Mesh| mesh.places;
    assert_eq!(places(ply::parse(&as_ply("ascii")).unwrap()), [Place::Line(27); 2]);
    assert_eq!(places(ply::parse(&as_ply("binary_little_endian")).unwrap()), [Place::Face(0); 2]);
    assert_eq!(places(stl::parse(&as_stl(true)).unwrap()), [0, 1].map(Place::Facet));
}

/// A file, its scene, and the scene of the same mesh as OBJ.
#[test]
fn files_are_read_by_their_endings_and_framed_alike() {
    let home = tempfile::tempdir().unwrap();
    let load = |name: &str, content: &[u8]| -> Scene {
        let path = home.path().join(name);
        std::fs::write(&path, content).unwrap();
        scene::load(path.to_str().unwrap(), &VIEW).unwrap()
    };
    let want = load("quad.obj", as_obj().as_bytes());
    let (file, mesh) = quad(5126, "VEC4");
    let members = format!("{mesh}, {ONE}");
    std::fs::write(home.path().join("a b.bin"), &file.bytes).unwrap();
    for (name, content) in [
        ("a.gltf", file.text(&members).into_bytes()),
        ("beside.gltf", file.json(Some("a%20b.bin"), &members).into_bytes()),
        ("a.GLB", file.binary(&members)),
        ("a.ply", as_ply("binary_big_endian")),
        ("a.stl", as_stl(true)),
    ] {
        let got = load(name, &content);
        assert_eq!(got.triangles, want.triangles, "{name}");
        let (Attributes::Mesh { w, .. }, Attributes::Mesh { w: of_obj, .. }) =
            (&got.attributes, &want.attributes)
        else {
            panic!("meshes");
        };
        assert_eq!(w, of_obj);
    }
}
