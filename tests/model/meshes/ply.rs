//! Errors and concave faces of PLY files. Clause CH-2.

use super::*;

/// A change of the text, and what the message says.
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
