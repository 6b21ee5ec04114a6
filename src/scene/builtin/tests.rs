use std::collections::BTreeMap;

use super::*;

const WINDOW: Viewport = Viewport { width: 320, height: 240, depth_max: 0xff_ffff };

const SIZES: [(u32, u32); 9] = [
    (1, 1),
    (2, 2),
    (3, 2),
    (16, 16),
    (320, 240),
    (1920, 1080),
    (65536, 65536),
    (65536, 2),
    (2, 65536),
];

fn vertices(triangle: &Triangle) -> [Point; 3] {
    match *triangle {
        Triangle::Real { xy: [[a, b], [c, d], [e, f]], z: Some([z0, z1, z2]) } => {
            [[a, b, z0], [c, d, z1], [e, f, z2]]
        }
        _ => panic!("{triangle:?}"),
    }
}

fn built(name: &str, viewport: &Viewport) -> Vec<[Point; 3]> {
    make(name, viewport).unwrap().triangles.iter().map(vertices).collect()
}

fn twice_area([[ax, ay, _], [bx, by, _], [cx, cy, _]]: [Point; 3]) -> f64 {
    (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
}

/// Each undirected edge, by the bits of its ends, with how many triangles it belongs to.
fn edges(triangles: &[[Point; 3]]) -> BTreeMap<[[u64; 3]; 2], usize> {
    let mut found = BTreeMap::new();
    for &[a, b, c] in triangles {
        for ends in [[a, b], [b, c], [c, a]] {
            let mut ends = ends.map(|end| end.map(f64::to_bits));
            ends.sort_unstable();
            *found.entry(ends).or_default() += 1;
        }
    }
    found
}

#[test]
fn all_stay_inside_every_window_and_depth_range() {
    for (name, _) in builtin_names() {
        for (width, height) in SIZES {
            for depth_max in [0, 1, 0xffff, u64::MAX] {
                let viewport = Viewport { width, height, depth_max };
                let scene = make(name, &viewport).unwrap();
                assert_eq!((scene.name.as_str(), scene.dropped), (*name, 0));
                assert!(!scene.triangles.is_empty());
                for [x, y, z] in scene.triangles.iter().flat_map(vertices) {
                    let place = format!("{name} {viewport:?}: {x} {y} {z}");
                    assert!((0.0..=f64::from(width)).contains(&x), "{place}");
                    assert!((0.0..=f64::from(height)).contains(&y), "{place}");
                    assert!((0.0..=viewport.depth_max_real()).contains(&z), "{place}");
                }
            }
        }
    }
}

#[test]
fn names_are_known_and_counts_as_described() {
    assert_eq!(make("none", &WINDOW), None);
    let counts: Vec<_> = NAMES.map(|(name, _)| built(name, &WINDOW).len()).to_vec();
    assert_eq!(counts, [1, 96, 96, 24, 3000, 2048]);
    for (name, _) in NAMES {
        assert!(name_list().contains(name));
    }
}

#[test]
fn two_runs_give_the_same_bits() {
    for (name, _) in NAMES {
        assert_eq!(make(name, &WINDOW), make(name, &WINDOW));
    }
}

#[test]
fn scenes_scale_with_the_window() {
    for (name, _) in NAMES.into_iter().filter(|(name, _)| *name != "extremes") {
        let wide = Viewport { width: 3200, height: 2400, ..WINDOW };
        let extent = |view| {
            let xs: Vec<_> = built(name, view).into_iter().flatten().map(|[x, ..]| x).collect();
            let fold = |start, pick: fn(f64, f64) -> f64| xs.iter().copied().fold(start, pick);
            fold(f64::MIN, f64::max) - fold(f64::MAX, f64::min)
        };
        let ratio = extent(&wide) / extent(&WINDOW);
        assert!((9.5..10.5).contains(&ratio), "{name}: {ratio}");
    }
}

#[test]
fn the_knot_is_closed() {
    let edges = edges(&knot::mesh());
    assert_eq!(edges.len(), 4500);
    assert!(edges.values().all(|&count| count == 2));
}

#[test]
fn the_camera_keeps_shared_edges_exactly_shared() {
    let knot = edges(&built("knot", &WINDOW));
    assert!(knot.len() == 4500 && knot.values().all(|&count| count == 2));
    let terrain = edges(&built("terrain", &WINDOW));
    assert_eq!((terrain.len(), terrain.values().sum::<usize>()), (3136, 3 * 2048));
}

#[test]
fn the_knot_crosses_in_front_of_itself() {
    // A tube alone covers a point twice, front and back; where it crosses itself, four times.
    let triangles = built("knot", &WINDOW);
    let layers = |x: f64, y: f64| {
        let point = [x, y, 0.0];
        let inside = |&[a, b, c]: &[Point; 3]| {
            let e =
                [twice_area([a, b, point]), twice_area([b, c, point]), twice_area([c, a, point])];
            e.iter().all(|&e| e > 0.0) || e.iter().all(|&e| e < 0.0)
        };
        triangles.iter().filter(|triangle| inside(triangle)).count()
    };
    let mut crossings = 0;
    for row in 0..60 {
        for column in 0..80 {
            let count = layers(4.0 * f64::from(column) + 0.37, 4.0 * f64::from(row) + 0.71);
            assert_eq!(count % 2, 0, "a closed surface");
            crossings += usize::from(count >= 4);
        }
    }
    assert!(crossings > 50, "{crossings}");
}

#[test]
fn the_terrain_shares_its_edges_and_has_relief() {
    let mesh = terrain::mesh();
    let edges = edges(&mesh);
    assert_eq!(edges.values().filter(|&&count| count == 1).count(), 4 * 32);
    assert_eq!(edges.values().filter(|&&count| count == 2).count(), 2 * 32 * 31 + 32 * 32);
    let heights: Vec<f64> = mesh.iter().flatten().map(|p| p[1]).collect();
    let low = heights.iter().copied().fold(f64::MAX, f64::min);
    let high = heights.iter().copied().fold(f64::MIN, f64::max);
    assert!(low >= 0.0 && high <= 1.0 && high - low > 0.4, "{low} {high}");
}

#[test]
fn the_fan_is_on_quarters_with_its_hub_off_every_pixel_centre() {
    for (width, height) in SIZES {
        let view = Viewport { width, height, ..WINDOW };
        let triangles = built("fan", &view);
        for [x, y, z] in triangles.iter().flatten() {
            for quarters in [4.0 * x, 4.0 * y, *z] {
                assert!(quarters.fract().abs() < f64::MIN_POSITIVE, "{quarters}");
            }
        }
        let [x, y, _] = triangles[0][0];
        assert!(triangles[..64].iter().all(|t| t[0] == triangles[0][0]));
        assert!((x - x.floor() - 0.5).abs() >= 0.25 && (y - y.floor() - 0.5).abs() >= 0.25);
    }
}

#[test]
fn the_fan_tiles_its_rectangle() {
    for (width, height) in SIZES {
        let triangles = built("fan", &Viewport { width, height, ..WINDOW });
        let sum: f64 = triangles.iter().map(|&t| twice_area(t)).sum();
        let all = || triangles.iter().flatten();
        let span = |axis: usize| {
            let high = all().map(|p| p[axis]).fold(f64::MIN, f64::max);
            high - all().map(|p| p[axis]).fold(f64::MAX, f64::min)
        };
        // All of one winding and together as large as the rectangle: neither gap nor overlap.
        assert!(triangles.iter().all(|&t| twice_area(t) >= 0.0), "{width} x {height}");
        assert!((sum - 2.0 * span(0) * span(1)).abs() < 0.01, "{width} x {height}");
    }
}

#[test]
fn the_fan_shares_its_edges_exactly() {
    let edges = edges(&built("fan", &WINDOW));
    let single = edges.values().filter(|&&count| count == 1).count();
    // Outline: top, left and right of the fan, bottom and both ends of the strip.
    assert_eq!(single, 3 * 16 + 16 + 2);
    assert!(edges.values().all(|&count| count <= 2));
}

#[test]
fn slivers_are_long_thin_and_point_everywhere() {
    let triangles = built("slivers", &WINDOW);
    let mut widths = Vec::new();
    let mut octants = [0; 8];
    for [tip, left, right] in triangles {
        let [x, y, _] = camera::sub(left, right);
        let width = (x * x + y * y).sqrt();
        let middle = [f64::midpoint(left[0], right[0]), f64::midpoint(left[1], right[1])];
        let [x, y] = [middle[0] - tip[0], middle[1] - tip[1]];
        assert!((x * x + y * y).sqrt() > 40.0 * width);
        octants[usize::from(x > 0.0)
            + 2 * usize::from(y > 0.0)
            + 4 * usize::from(x.abs() > y.abs())] += 1;
        widths.push(width);
    }
    assert!(octants.iter().all(|&count| count >= 4), "{octants:?}");
    let thin = widths.iter().copied().fold(f64::MAX, f64::min);
    let wide = widths.iter().copied().fold(f64::MIN, f64::max);
    assert!((thin - 1.0 / 64.0).abs() < 1e-9 && (wide - 2.0).abs() < 1e-9, "{thin} {wide}");
}

#[test]
fn extremes_hold_what_they_promise() {
    for (width, height) in SIZES {
        let view = Viewport { width, height, ..WINDOW };
        let triangles = built("extremes", &view);
        let area = f64::from(width) * f64::from(height);
        let sizes: Vec<_> = triangles.iter().map(|&t| twice_area(t)).collect();
        assert!(
            sizes.iter().any(|&a| (a - area).abs() < 0.1)
                && sizes.iter().any(|&a| (a + area).abs() < 0.1)
        );
        assert_eq!(sizes[20..].iter().filter(|a| a.abs() < f64::MIN_POSITIVE).count(), 4);
        assert!(sizes.iter().filter(|a| (a.abs() - 1.0).abs() < 1e-9).count() >= 10);
        // The steepest: the whole range across one pixel.
        let far = view.depth_max_real();
        let steep = |[a, b, c]: &[Point; 3]| {
            let [x, y] = [b[0] - a[0], c[1] - a[1]];
            [x, y] == [1.0, 1.0] && (b[2] - a[2]).abs().max((c[2] - a[2]).abs()) >= far
        };
        assert!(triangles.iter().filter(|t| steep(t)).count() >= 6);
    }
}
