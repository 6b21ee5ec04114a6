//! What a scene requires, against every sample of it. Clause M-8.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(clippy::cast_precision_loss, clippy::float_cmp, reason = "the very numbers are meant")]

use guardbit::bits::Event;
use guardbit::case::Words;
use guardbit::exact::{Rule, covers, edge_value};
use guardbit::format::Clamp;
use guardbit::measure::accuracy::Reference;
use guardbit::measure::require::{Requirements, require};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Form, Profile, WindowConfig, load};
use guardbit::scene::{self, Lens, Scene};
use guardbit::setup::{Snapped, Triangle};

fn base() -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window = WindowConfig { width: 9, height: 7 };
    profile.vertex.integer = 4;
    profile.vertex.sub_pixel = 2;
    if let Form::EdgeFunction(edges) = &mut profile.form {
        edges.width = 30;
    }
    profile.depth.as_mut().unwrap().guard = 4;
    profile
}

fn scene_of(triangles: Vec<scene::Triangle>, lens: Option<Lens>) -> Scene {
    Scene { lens, ..Scene::new("case", triangles) }
}

fn bits(found: &Requirements, field: &str) -> u32 {
    found.bits.iter().find(|bits| bits.field == field).unwrap().needs
}

fn range(found: &Requirements, name: &str) -> [f64; 2] {
    let range = found.ranges.iter().find(|range| range.name == name).unwrap();
    [range.low, range.high]
}

fn needed(found: &Requirements, name: &str) -> bool {
    found.evaluators.iter().find(|evaluator| evaluator.name == name).unwrap().needed
}

/// Pixels of the window that a triangle covers, by the textbook test.
fn covered(profile: &Profile, triangle: &Triangle) -> Vec<[u32; 2]> {
    let grid = profile.grid().unwrap();
    let all =
        (0..profile.window.height).flat_map(|y| (0..profile.window.width).map(move |x| [x, y]));
    all.filter(|[x, y]| covers(triangle.xy, grid.position((*x).into(), (*y).into()), Rule::TopLeft))
        .collect()
}

/// Two's complement bits of a value.
fn signed(value: i128) -> u32 {
    (1..128).find(|n| (-(1 << (n - 1))..1 << (n - 1)).contains(&value)).unwrap()
}

#[test]
fn ranges_and_bits_are_those_of_every_sample() {
    let (mut overlaps, mut guarded) = (0, 0);
    for index in 0..200 {
        let mut words = Words::new(2, 50, index);
        let profile = base();
        let model = Model::new(&profile).unwrap();
        let count = 1 + words.below(3);
        let given: Vec<scene::Triangle> = (0..count)
            .map(|_| {
                let mut point = || [words.between(0, 48), words.between(0, 36)];
                let xy = [point(), point(), point()];
                let z = [(); 3].map(|()| words.between(0, 1) * 7);
                scene::Triangle::Lattice { xy, z: Some(z) }
            })
            .collect();
        let triangles: Vec<Snapped<Triangle>> = given
            .iter()
            .map(|triangle| model.snap(triangle).unwrap())
            .filter(|triangle| triangle.area2() != 0)
            .collect();
        if triangles.is_empty() {
            continue;
        }
        let found = require(&Reference::new(scene_of(given, None), &profile), &profile).unwrap();
        assert_eq!(found.triangles, triangles.len());
        let pixels: Vec<Vec<[u32; 2]>> =
            triangles.iter().map(|triangle| covered(&profile, triangle)).collect();
        assert_eq!(found.samples, pixels.iter().map(|p| p.len() as u64).sum::<u64>());

        let xs = || triangles.iter().flat_map(|t| t.xy).map(|v| v[0] as f64 / 4.0);
        let ends = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            })
        };
        assert_eq!(range(&found, "x"), ends(&mut xs()));
        let areas = triangles.iter().map(|t| t.area2().abs() as f64);
        assert_eq!(range(&found, "twice area"), ends(&mut areas.into_iter()));
        let all = || pixels.iter().flatten();
        if all().next().is_none() {
            assert!(!needed(&found, "coverage"));
            continue;
        }
        let walks = all().map(|[x, y]| f64::from(x + y));
        assert_eq!(range(&found, "walk")[1], ends(&mut walks.into_iter())[1]);

        // A sample that two triangles cover.
        let twice = all().any(|pixel| all().filter(|other| *other == pixel).count() > 1);
        assert_eq!(needed(&found, "depth test"), twice);
        overlaps += u32::from(twice);

        // The edge word: every value in every bounding box, biased and shifted.
        let grid = profile.grid().unwrap();
        let mut width = 2;
        for triangle in triangles.iter().map(|t| t.normalised()) {
            let side = |axis: usize, end: u32| {
                let (low, high) = triangle.extent(axis);
                let at = |n: u32| grid.position(n.into(), n.into())[axis];
                (0..end).filter(move |n| (low..=high).contains(&at(*n))).collect::<Vec<_>>()
            };
            for y in side(1, profile.window.height) {
                for x in side(0, profile.window.width) {
                    let at = grid.position(x.into(), y.into());
                    for k in 0..3 {
                        let (from, to) = (triangle.xy[k], triangle.xy[(k + 1) % 3]);
                        let value = edge_value(from, to, at).to_integer();
                        let value = i128::try_from(value).unwrap();
                        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
                        let owns = dy < 0 || (dy == 0 && dx > 0);
                        let stored = (value - i128::from(!owns)) >> profile.vertex.sub_pixel;
                        width = width.max(signed(stored));
                    }
                }
            }
        }
        assert_eq!(bits(&found, "edge-width").max(2), width, "case {index}");

        // Guard bits: the fewest at which the model reports no wrap.
        let wraps = |guard: u32| {
            let mut profile = profile.clone();
            let depth = profile.depth.as_mut().unwrap();
            (depth.guard, depth.clamp) = (guard, Clamp::Guard);
            let model = Model::new(&profile).unwrap();
            let mut drawing = Drawing::default();
            for triangle in &triangles {
                model.draw(triangle, &mut drawing).unwrap();
            }
            drawing.events.total.count(Event::Wrap)
        };
        let guard = (0..6).find(|guard| wraps(*guard) == 0).unwrap();
        assert_eq!(bits(&found, "guard"), guard, "case {index}");
        assert_eq!(needed(&found, "guard clamp"), guard > 0);
        guarded += u32::from(guard > 0);
    }
    assert!(overlaps > 20 && guarded > 10, "both ways were met: {overlaps} {guarded}");
}

#[test]
fn the_interpolation_bits_are_the_bound_of_the_walk() {
    // One sample in pixel (8, 6): 14 steps and a start, each off by half a unit at most.
    let profile = base();
    let xy = [[33, 25], [36, 25], [33, 28]];
    let given = vec![scene::Triangle::Lattice { xy, z: Some([0, 3, 5]) }];
    let found = require(&Reference::new(scene_of(given, None), &profile), &profile).unwrap();
    assert_eq!(found.samples, 1);
    // 15 / 2^(F+1) < 1/2 needs 2^F > 15.
    assert_eq!(bits(&found, "interpolation"), 4);
}

#[test]
fn an_evaluator_is_needed_when_something_depends_on_it() {
    let profile = base();
    let found = |xy: [[i128; 2]; 3], z: [i128; 3], lens| {
        let given = vec![scene::Triangle::Lattice { xy, z: Some(z) }];
        require(&Reference::new(scene_of(given, lens), &profile), &profile).unwrap()
    };
    let on_pixels = [[0, 0], [12, 0], [0, 12]];
    let lens = Some(Lens { near: 1.0, far: 9.0 });
    let flat = found(on_pixels, [3, 3, 3], lens);
    for (name, wanted) in [
        ("coverage", true),
        ("sub-pixel positions", false),
        ("scissor", false),
        ("depth test", false),
        ("depth plane", false),
        ("perspective", false),
    ] {
        assert_eq!(needed(&flat, name), wanted, "{name}");
    }
    assert_eq!(bits(&flat, "sub-pixel"), 0);
    assert_eq!(bits(&flat, "vertex-integer"), 2);
    assert_eq!(bits(&flat, "integer"), 2);
    let sloped = found([[0, 0], [13, 0], [0, 12]], [0, 3, 3], lens);
    assert!(needed(&sloped, "depth plane") && needed(&sloped, "sub-pixel positions"));
    // w from 1 to 9 / (9 - 8 3/7) = 21/13: an affine value is off by (sqrt r - 1) / (sqrt r + 1).
    let perspective = sloped.evaluators.iter().find(|e| e.name == "perspective").unwrap();
    assert!(perspective.needed);
    let root = (21.0f64 / 13.0).sqrt();
    let off = format!("{:.3} %", 100.0 * (root - 1.0) / (root + 1.0));
    assert!(perspective.evidence.contains(&off), "{} in {}", off, perspective.evidence);
    // The window has 9 x 7 pixels, the field 16.
    assert!(needed(&found([[0, 0], [60, 0], [0, 12]], [0, 0, 0], None), "scissor"));
}

/// Clause M-8: a machine that walks no depth plane has no statement of guard and interpolation bits.
#[test]
fn no_bound_of_a_plane_is_stated_for_other_means() {
    let triangle = scene::Triangle::Lattice { xy: [[0, 0], [32, 0], [0, 24]], z: Some([0, 7, 3]) };
    let of = |name: &str| {
        let profile = base().with_machine(name).unwrap();
        let scene = scene_of(vec![triangle.clone()], None);
        let found = require(&Reference::new(scene, &profile), &profile).unwrap();
        let fields = found.bits.iter().map(|bits| bits.field).collect::<Vec<_>>();
        let words = guardbit::measure::budget::report(&profile).unwrap().words;
        let depth = words.into_iter().find(|word| word.name == "depth").unwrap();
        (fields, depth.facts.iter().any(|fact| fact.name == "longest walk"))
    };
    for name in ["gouraud", "barycentric"] {
        let (fields, walk) = of(name);
        assert!(fields.contains(&"integer") && !walk, "{name}: {fields:?}");
        assert!(!fields.contains(&"interpolation") && !fields.contains(&"guard"), "{fields:?}");
    }
    let (fields, walk) = of("edge-function");
    assert!(fields.contains(&"interpolation") && fields.contains(&"guard") && walk);
}
