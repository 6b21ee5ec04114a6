//! Meshes of every format: one quadrilateral in all of them, cameras, nodes, and files that are wrong.
//! Clause CH-2.

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

#[test]
fn colours_are_parts_of_their_largest_code() {
    for (kind, shape, width) in
        [(5121, "VEC3", 3), (5123, "VEC4", 4), (5126, "VEC3", 3), (5126, "VEC4", 4)]
    {
        let (file, mesh) = quad(kind, shape);
        let mesh = parse_gltf(&file.text(&format!("{mesh}, {ONE}"))).unwrap();
        let color = mesh.sets.iter().find(|set| set.name == "color").unwrap();
        assert_eq!(color.components, width);
        // The last corner of the second triangle: 51, 102, 204 of 255.
        for (k, want) in [0.2, 0.4, 0.8, 1.0].into_iter().enumerate().take(width) {
            assert!(
                (color.at(1, k)[2] - want).abs() < 1e-7,
                "{kind} {shape}: {:?}",
                color.at(1, k)
            );
        }
    }
}

/// Strips and fans in the order of the format; nodes one below another; the camera of the file.
#[test]
fn nodes_modes_and_a_camera() {
    let mut file = Gltf::default();
    let places: [[f32; 3]; 5] =
        [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [-1., 0.5, 0.]];
    let position = file.floats("VEC3", 5, places.as_flattened());
    let normal = file.floats("VEC3", 5, [[0f32, 0., 1.]; 5].as_flattened());
    let primitive = |mode: u32| {
        format!(
            r#"{{"attributes": {{"POSITION": {position}, "NORMAL": {normal}}}, "mode": {mode}}}"#
        )
    };
    let meshes = format!(
        r#""meshes": [{{"primitives": [{}, {}, {}]}}]"#,
        primitive(5),
        primitive(1),
        primitive(6)
    );
    // A quarter turn about x takes y to z, and z to -y.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let members = format!(
        r#"{meshes}, "cameras": [{{"type": "perspective", "perspective": {{"yfov": 1.5707964, "znear": 1}}}}],
        "nodes": [
            {{"translation": [0, 0, -3], "children": [1]}},
            {{"rotation": [{half}, 0, 0, {half}], "scale": [2, 2, 2], "mesh": 0}},
            {{"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,2,1], "camera": 0}}
        ], "scenes": [{{"nodes": []}}, {{"nodes": [2, 0]}}], "scene": 1"#
    );
    let mesh = parse_gltf(&file.text(&members)).unwrap();
    let moved = |n: usize| {
        let [x, y, z] = places[n].map(f64::from);
        [2.0 * x, -2.0 * z, 2.0 * y - 3.0]
    };
    let strip = [[0, 1, 2], [1, 3, 2], [2, 3, 4]];
    let fan = [[1, 2, 0], [2, 3, 0], [3, 4, 0]];
    let want: Vec<[Point; 3]> = [strip, fan].concat().iter().map(|n| n.map(moved)).collect();
    assert_eq!(mesh.triangles.len(), want.len());
    let near = |a: &Point, b: &Point| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    for (got, want) in mesh.triangles.iter().zip(&want) {
        assert!(got.iter().zip(want).all(|(a, b)| near(a, b)), "{got:?} {want:?}");
    }
    let last = Place::Primitive { node: 1, mesh: 0, primitive: 2, triangle: 2 };
    assert_eq!(mesh.places[5], last);
    assert_eq!(last.to_string(), "nodes[1]: meshes[0].primitives[2]: triangle 2 (from 0)");
    let normals = values(&mesh, "normal").unwrap();
    assert!(normals.chunks(3).all(|n| near(&[n[0], n[1], n[2]], &[0.0, -1.0, 0.0])), "{normals:?}");
    let camera = mesh.camera.unwrap();
    assert_eq!((camera.eye, camera.far), ([0.0, 0.0, 2.0], f64::INFINITY));
    // The window: (0, 0, -3) is 5 before the eye, straight ahead.
    let seen = guardbit::scene::camera::view(&mesh, &VIEW).unwrap();
    let Triangle::Real { xy, z: Some(z) } = &seen.triangles[0] else { panic!("reals") };
    assert_eq!((xy[0], seen.w[0][0]), ([32.0, 24.0], 5.0));
    assert!((z[0] - 0.8 * VIEW.depth_max_real()).abs() < 1.0, "{z:?}");
}

/// A change of the text, and what the message says; nothing where there is none.
const GLTF_WRONG: &[(&str, &str, &str)] = &[
    ("\"2.0\"", "\"1.0\"", "glTF 1.0: version 2.0 is read"),
    (
        "\"asset\"",
        "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"asset\"",
        "requires the extension KHR_draco_mesh_compression",
    ),
    ("\"asset\"", "\"asset", "the JSON of the glTF file"),
    ("\"scene\": 0", "\"scene\": 3", "scene is 3: there are 1 scenes, 0 <= index < 1"),
    ("\"nodes\": [0]", "\"nodes\": [9]", "scenes[0].nodes[0] is 9: there are 1 nodes"),
    ("{\"mesh\": 0}", "{\"mesh\": 1}", "nodes[0].mesh is 1: there are 1 meshes"),
    (
        "{\"mesh\": 0}",
        "{\"mesh\": 0, \"children\": [0]}",
        "nodes[0] has two parents, or is below itself",
    ),
    ("{\"mesh\": 0}", "{\"mesh\": 0, \"skin\": 0}", "nodes[0] has a skin"),
    ("{\"mesh\": 0}", "{\"mesh\": 0, \"weights\": [0.5]}", "morph targets with weights"),
    (
        "{\"mesh\": 0}",
        "{\"mesh\": 0, \"rotation\": [0, 0, 0, 0]}",
        "nodes[0]: the transform is not finite",
    ),
    ("{\"mesh\": 0}", "{\"mesh\": 0, \"camera\": 2}", "nodes[0].camera is 2: there are 0 cameras"),
    ("{\"mesh\": 0}", "{}", "no triangles"),
    ("\"POSITION\": 0", "\"POSITION\": 40", "meshes[0].primitives[0] is 40: there are 5 accessors"),
    ("\"POSITION\": 0,", "", "meshes[0].primitives[0] has no POSITION"),
    (
        "\"POSITION\": 0",
        "\"POSITION\": 1",
        "POSITION: accessors[1] is VEC2 OF F32; VEC3 of float is needed",
    ),
    ("\"indices\": 4", "\"indices\": 0", "accessors[0] is VEC3 OF F32; SCALAR of unsigned byte"),
    ("\"indices\": 4", "\"indices\": 4, \"mode\": 4", ""),
    (
        "\"SCALAR\", \"count\": 6",
        "\"SCALAR\", \"count\": 5",
        "5 vertices in a row; a multiple of 3",
    ),
    (
        "\"SCALAR\", \"count\": 6",
        "\"SCALAR\", \"count\": 7",
        "accessors[4]: its 7 elements end at byte 7, but bufferViews[4] has 6 bytes",
    ),
    (
        "\"SCALAR\", \"count\": 6",
        "\"SCALAR\", \"count\": 1000000000000",
        "the scene has 1000000000000 vertices or more; 67108864 at most",
    ),
    (
        "\"VEC2\", \"count\": 4",
        "\"VEC2\", \"count\": 3",
        "TEXCOORD_0 has 3 elements, but POSITION has 4",
    ),
    (
        "\"componentType\": 5121",
        "\"componentType\": 7",
        "accessors[3]: `type` or `componentType` is none of",
    ),
    (
        "\"bufferView\": 0,",
        "\"bufferView\": 0, \"sparse\": {\"count\": 1, \"indices\": {\"bufferView\": 0, \
          \"componentType\": 5121}, \"values\": {\"bufferView\": 0}},",
        "accessors[0]: it is sparse",
    ),
    ("\"bufferView\": 0,", "", "accessors[0]: it has no bufferView"),
    (
        "\"bufferView\": 0,",
        "\"bufferView\": 8,",
        "accessors[0].bufferView is 8: there are 5 bufferViews",
    ),
    (
        "\"bufferView\": 0,",
        "\"bufferView\": 0, \"byteOffset\": 18446744073709551615,",
        "but bufferViews[0] has 48",
    ),
    ("\"byteLength\": 48}", "\"byteLength\": 48, \"byteStride\": 8}", "accessors[0]: byteStride"),
    (
        "\"byteLength\": 48}",
        "\"byteLength\": 4800}",
        "bufferViews[0]: byteOffset + byteLength = 4800, but buffers[0]",
    ),
    ("{\"buffer\": 0,", "{\"buffer\": 1,", "bufferViews[0].buffer is 1: there are 1 buffers"),
    ("{\"byteLength\": ", "{\"byteLength\": 1", "buffers[0]: byteLength = 1"),
    (";base64,", ",", "buffers[0]: the data of its uri is not base64"),
    (";base64,", ";base64,*", "buffers[0]: the base64 of its uri has a wrong character"),
    ("data:application/octet-stream;base64,", "https://", "names no file beside this one"),
    ("data:application/octet-stream;base64,", "none/", "buffers[0]: the file none/"),
];

/// What a glTF file refuses, by a change of the quadrilateral's text.
#[test]
fn errors_of_gltf_name_the_place() {
    let (file, mesh) = quad(5121, "VEC3");
    let text = file.text(&format!("{mesh}, {ONE}"));
    let mut cut = file.binary(&format!("{mesh}, {ONE}"));
    cut.pop();
    let nan = {
        let mut other = quad(5126, "VEC3");
        other.0.bytes[4..8].copy_from_slice(&f32::NAN.to_le_bytes());
        other.0.text(&format!("{}, {ONE}", other.1))
    };
    let refused = |text: &str, want: &str| {
        let error = parse_gltf(text).unwrap_err().to_string();
        assert!(error.contains(want), "{want}: {error}");
    };
    assert!(parse_gltf(&text).is_ok());
    let mut other = quad(5121, "VEC3");
    let last = other.0.bytes.len() - 8;
    other.0.bytes[last + 2] = 4;
    let outside = other.0.text(&format!("{}, {ONE}", other.1));
    refused(&outside, "meshes[0].primitives[0]: index 2 is vertex 4: 0 <= vertex < 4 is needed");
    refused(&nan, "meshes[0].primitives[0]: POSITION: element 0 of accessors[0] is NaN");
    let error = gltf::parse(&cut, Path::new("")).unwrap_err().to_string();
    assert!(error.contains("bytes, but has") && error.contains("cut short"), "{error}");
    for length in [0, 4, 11, 12, 15, 19, 20, 100] {
        assert!(gltf::parse(&cut[..length], Path::new("")).is_err());
    }
    let mut tiny = cut.clone();
    tiny[8..12].copy_from_slice(&7u32.to_le_bytes());
    let error = gltf::parse(&tiny, Path::new("")).unwrap_err().to_string();
    assert!(error.contains("no JSON chunk"), "{error}");
    for (change, with, want) in GLTF_WRONG {
        assert!(text.contains(change), "{change}");
        if want.is_empty() {
            assert!(parse_gltf(&text.replacen(change, with, 1)).is_ok(), "{with}");
        } else {
            refused(&text.replacen(change, with, 1), want);
        }
    }
    let camera = |body: &str| {
        let node = format!("{{\"mesh\": 0, \"camera\": 0}}], \"cameras\": [{body}");
        text.replacen("{\"mesh\": 0}", &node, 1)
    };
    for (body, want) in [
        (
            r#"{"type": "perspective", "perspective": {"yfov": 3.2, "znear": 1}}"#,
            "cameras[0]: 0 < yfov < pi is",
        ),
        (
            r#"{"type": "perspective", "perspective": {"yfov": 1, "znear": 0}}"#,
            "cameras[0]: 0 < znear is needed",
        ),
        (
            r#"{"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}}"#,
            "znear < zfar is needed",
        ),
        (r#"{"type": "perspective"}"#, "cameras[0]: `perspective` or `orthographic`"),
        (
            r#"{"type": "orthographic", "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 1}}"#,
            "0 < xmag",
        ),
    ] {
        refused(&camera(body), want);
    }
}

/// A mesh drawn by many nodes, and a chain of nodes as long as a file may have.
#[test]
fn many_nodes_neither_overflow_the_stack_nor_fill_the_memory() {
    let (file, mesh) = quad(5121, "VEC3");
    let count = 20_000;
    let chain: Vec<String> = (1..count).map(|n| format!("{{\"children\": [{n}]}}")).collect();
    let members = format!(
        r#"{mesh}, "nodes": [{}, {{"mesh": 0}}], "scenes": [{{"nodes": [0]}}]"#,
        chain.join(",")
    );
    assert_eq!(parse_gltf(&file.text(&members)).unwrap().triangles.len(), 2);
    let nodes = vec!["{\"mesh\": 0}"; 100].join(",");
    let list: Vec<String> = (0..100).map(|n| n.to_string()).collect();
    let many = vec![r#"{"attributes": {"POSITION": 5}}"#; 100].join(",");
    let mut file = file;
    file.accessor(5126, "VEC3", 10_000, &[0; 12]);
    let members = format!(
        r#""meshes": [{{"primitives": [{many}]}}], "nodes": [{nodes}], "scenes": [{{"nodes": [{}]}}]"#,
        list.join(",")
    );
    let error = parse_gltf(&file.text(&members)).unwrap_err().to_string();
    assert!(error.contains("67110000 vertices or more; 67108864 at most"), "{error}");
}

/// The same for the PLY text.
const PLY_WRONG: &[(&str, &str, &str)] = &[
    ("ply\n", "plan\n", "line 1: the file does not begin with `ply`"),
    (
        "format ascii 1.0",
        "format ascii 2.0",
        "line 2: `format ascii 2.0` is no line of a PLY header; write `format ascii",
    ),
    ("format ascii 1.0\n", "", "a line `format` comes before"),
    ("comment by hand", "remark by hand", "line 3: `remark by hand`"),
    ("property float x", "property half x", "line 5: `property half x`"),
    ("property float x", "property float y", "line 6: `y` is given twice"),
    ("element edge 1", "element vertex 1", "line 16: `vertex` is given twice"),
    ("element vertex 4", "element vertex -4", "line 4: `element vertex -4`"),
    (
        "element vertex 4",
        "element vertex 1000000000000",
        "element `vertex`: the header counts 1000000000000, which need",
    ),
    (
        "element edge 1\nproperty list uchar short ends",
        "element edge 1000000000000",
        "`edge`: the header counts 1000000000000 without a property",
    ),
    ("element vertex 4\n", "property float w\nelement vertex 4\n", "an element comes first"),
    ("end_header\n", "", "is no line of a PLY header"),
    ("property float x", "property float a", "element `vertex` has no property `x`"),
    ("property float x", "property list uchar float x", "`x` is a list, one number is needed"),
    (
        "list uchar int vertex_indices",
        "list uchar int corners",
        "no list `vertex_indices` or `vertex_index`",
    ),
    (
        "list uchar int vertex_indices",
        "list uchar float vertex_index",
        "as a list of whole numbers",
    ),
    (
        "property uchar flags\nproperty list uchar int vertex_indices",
        "property uchar vertex_indices",
        "as a list of whole",
    ),
    ("\n2 0 0 ", "\n2 nan 0 ", "line 23: vertex 1 (from 0): `y` is NaN"),
    ("\n2 0 0 ", "\n2 1e39 0 ", "line 23: vertex 1 (from 0): `y` is inf"),
    ("\n2 0 0 ", "\n2 x 0 ", "line 23: vertex 1 (from 0): `y` is `x`: one `float` is needed"),
    (" 255 0 0 ", " 256 0 0 ", "line 22: vertex 0 (from 0): `red` is `256`: one `uchar` is needed"),
    ("7 4 0 1 2 3", "7 4 0 1 2", "line 27: face 0 (from 0): the file ends in `vertex_indices`"),
    (
        "7 4 0 1 2 3",
        "7 4 0 1 2 4",
        "line 27: face 0 (from 0): corner 3 is vertex 4: 0 <= vertex <= 4 - 1",
    ),
    ("7 4 0 1 2 3", "7 4 0 1 2 -1", "corner 3 is vertex -1"),
    ("7 4 0 1 2 3", "7 2 0 1", "line 27: face 0 (from 0): 2 corners, at least 3"),
    ("element face 1", "element face 0", "no faces: the mesh has 4 vertices"),
    ("element vertex 4", "element point 4", "no `element vertex`"),
];

#[test]
fn ply_errors_name_line_and_element() {
    let text = String::from_utf8(as_ply("ascii")).unwrap();
    assert!(text.contains("7 4 0 1 2 3"));
    for (change, with, want) in PLY_WRONG {
        assert!(text.contains(change), "{change}");
        let error = ply::parse(text.replacen(change, with, 1).as_bytes()).unwrap_err().to_string();
        assert!(error.contains(want), "{want}: {error}");
    }
    let file = as_ply("binary_little_endian");
    for length in 0..file.len() {
        let error = ply::parse(&file[..length]).unwrap_err().to_string();
        assert!(!error.is_empty());
    }
    let error = ply::parse(&file[..file.len() - 4]).unwrap_err().to_string();
    assert!(error.contains("face 0 (from 0): the file ends in `vertex_indices`"), "{error}");
    // A concave face is covered once: the arrow has area 1 less the notch.
    let arrow = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                 element face 1\nproperty list uint uint vertex_index\nend_header\n\
                 0 0 0 4 0 0 4 4 0 2 1 0 0 4 0\n5 0 1 2 3 4\n";
    let mesh = ply::parse(arrow.as_bytes()).unwrap();
    let twice =
        |[a, b, c]: &[Point; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let areas: Vec<f64> = mesh.triangles.iter().map(twice).collect();
    assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
    assert!((areas.iter().sum::<f64>() - 2.0 * (16.0 - 6.0)).abs() < 1e-12);
    let error = ply::parse(arrow.replace("0 1 2 3 4\n", "0 2 1 3 4\n").as_bytes()).unwrap_err();
    let want = "line 11: face 0 (from 0): the face crosses itself: the side from corner 0 and the side from corner 3";
    assert!(error.to_string().contains(want), "{error}");
}
