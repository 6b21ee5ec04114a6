//! Modes, nodes, cameras and errors of glTF files. Clause CH-2.

use super::*;

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
