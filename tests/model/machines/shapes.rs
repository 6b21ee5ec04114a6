//! Polygons and homogeneous vertices on the machines that take them. Spec clauses `A-2` and `A-8`.

use guardbit::case::Words;
use guardbit::model::{Drawing, Model};
use guardbit::profile::load;

/// Clause A-2: quadrilaterals, concave and crossing ones too, by two walked sides at a time: the
/// samples inside by parity, but for those nearer to an edge than the walk can tell.
#[test]
fn walked_polygons_cover_what_parity_says() {
    let mut base = load("sgi-4k").unwrap();
    base.window = guardbit::profile::WindowConfig { width: 16, height: 16 };
    let profile = base.with_machine("gouraud").unwrap();
    let model = Model::new(&profile).unwrap();
    let mut covered = 0;
    for index in 0..300 {
        let mut words = Words::new(5, 3, index);
        // Off the rows of samples, so that every crossing is a plain one.
        let mut at = || words.between(0, 63) * 256 + 128;
        let xy: Vec<[i128; 2]> = (0..4).map(|_| [at(), at()]).collect();
        let polygon = guardbit::setup::Polygon { z: Some(vec![9, 9, 9, 9]), xy: xy.clone() };
        let mut drawing = Drawing::default();
        model.draw(&model.place(polygon).unwrap(), &mut drawing).unwrap();
        for y in 0..16u32 {
            for x in 0..16u32 {
                let at = [i128::from(x) * 1024 + 512, i128::from(y) * 1024 + 512];
                let right = (0..4).filter(|k| {
                    let (a, b) = (xy[*k], xy[(k + 1) % 4]);
                    let crosses = (a[1] <= at[1]) != (b[1] <= at[1]);
                    let side = (b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]);
                    crosses && (side < 0) == (b[1] > a[1])
                });
                let inside = right.count() % 2 == 1;
                // A sample on an edge goes by the walk's rounding.
                let on_edge = (0..4).any(|k| {
                    let (a, b) = (xy[k], xy[(k + 1) % 4]);
                    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
                    dx * (at[1] - a[1]) == dy * (at[0] - a[0])
                });
                if on_edge {
                    continue;
                }
                let drawn = drawing.spans.iter().any(|s| s.y == y && (s.x0..s.x1).contains(&x));
                assert_eq!(drawn, inside, "{xy:?} at {x} {y}");
                covered += u32::from(drawn);
            }
        }
        assert!(drawing.depth.iter().all(|z| *z == 9), "a level polygon is level");
    }
    assert!(covered > 5000);
}

/// Clause A-8: homogeneous vertices on both sides of the eye cover the samples whose eye ray meets the
/// triangle in front, found by solving for the ray's weights as rationals.
#[test]
fn homogeneous_vertices_cover_what_the_eye_sees() {
    use guardbit::setup::ClipTriangle;
    let mut base = load("tiny").unwrap();
    base.depth = None;
    let profile = base.with_machine("homogeneous").unwrap();
    let model = Model::new(&profile).unwrap();
    let grid = profile.grid().unwrap();
    let (mut seen, mut behind, mut flat) = (0, 0, 0);
    for index in 0..20_000 {
        let mut words = Words::new(8, 2, index);
        let mut vertex = || {
            let w = words.between(-2, 3);
            [words.between(-6, 14) * w.abs().max(1), words.between(-6, 14) * w.abs().max(1), w]
        };
        let xyw = [vertex(), vertex(), vertex()];
        let triangle = ClipTriangle { xyw, z: None };
        let mut drawing = Drawing::default();
        model.draw(&triangle, &mut drawing).unwrap();
        let det3 = |[a, b, c]: [[i128; 3]; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let whole = det3(xyw);
        assert_eq!(drawing.zero_area, whole == 0, "{xyw:?}");
        flat += u32::from(whole == 0);
        for (y, x) in (0..4).flat_map(|y| (0..4).map(move |x| (y, x))) {
            let at = grid.position(x, y);
            let p = [at[0], at[1], 1];
            // Cramer: p = (d0 v0 + d1 v1 + d2 v2) / whole.
            let d = [0, 1, 2].map(|k| {
                let mut columns = xyw;
                columns[k] = p;
                det3(columns) * whole.signum()
            });
            let drawn = drawing
                .spans
                .iter()
                .any(|s| i128::from(s.y) == y && (s.x0..s.x1).contains(&u32::try_from(x).unwrap()));
            if d.iter().all(|d| *d > 0) && whole != 0 {
                assert!(drawn, "{xyw:?} at {x} {y}");
                seen += 1;
                behind += u32::from(xyw.iter().any(|v| v[2] <= 0));
            } else if d.iter().any(|d| *d < 0) || whole == 0 {
                assert!(!drawn, "{xyw:?} at {x} {y}");
            }
        }
    }
    assert!(seen > 5000 && behind > 1000 && flat > 20, "{seen} {behind} {flat}");
}

/// Clause A-8: two homogeneous triangles that share an edge have each sample on it once, wherever the
/// vertices lie.
#[test]
fn shared_homogeneous_edges_have_no_holes_and_no_double_hits() {
    use guardbit::setup::ClipTriangle;
    let mut base = load("tiny").unwrap();
    base.depth = None;
    let model = Model::new(&base.with_machine("homogeneous").unwrap()).unwrap();
    let mut met = 0;
    for index in 0..20_000 {
        let mut words = Words::new(9, 2, index);
        // A quadrilateral around the window, with a diagonal through samples, each vertex scaled.
        let mut scaled = |x: i128, y: i128| {
            let w = words.between(1, 3);
            [x * w, y * w, w]
        };
        let a = scaled(-3 + i128::from(index) % 5, -5);
        let b = scaled(30, -4);
        let c = scaled(12 - i128::from(index) % 7, 14);
        let d = scaled(-20, 13);
        let cover = |xyw| {
            let mut drawing = Drawing::default();
            model.draw(&ClipTriangle { xyw, z: None }, &mut drawing).unwrap();
            drawing.spans
        };
        let mut hits = [0; 16];
        for span in [cover([a, b, c]), cover([a, c, d])].concat() {
            (span.x0..span.x1).for_each(|x| hits[(span.y * 4 + x) as usize] += 1);
        }
        assert_eq!(hits, [1; 16], "{a:?} {b:?} {c:?} {d:?}");
        met += 1;
    }
    assert_eq!(met, 20_000);
}
