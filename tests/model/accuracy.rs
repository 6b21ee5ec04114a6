//! Errors summed in closed form, against the truth sample by sample: rationals, hits counted one by
//! one, and the values that the model really draws. Clauses M-1, M-2, M-3, M-4, M-5, M-6, M-7.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(clippy::cast_precision_loss, reason = "errors are real numbers")]

use guardbit::bits::{Event, Rounding};
use guardbit::case::Words;
use guardbit::cover::{EdgeStorage, EdgeWordConfig, FillRule, Rect};
use guardbit::exact::{self, Rule, covers, plane_at, ratio};
use guardbit::format::Clamp;
use guardbit::machine::EdgeWalkConfig;
use guardbit::measure::accuracy::{Drawn, Reference, Stage, Tally, Truth, measure};
use guardbit::measure::error::{SampleError, exact_rule, triangle_error};
use guardbit::model::{Drawing, Model};
use guardbit::profile::{Form, Profile, WindowConfig, load};
use guardbit::scene::{self, Lens, Scene};
use guardbit::setup::{Division, Triangle};
use guardbit::value::{DepthConfig, StartBias};
use num_traits::ToPrimitive;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A place in a list of so many.
fn index(words: &mut Words, count: u64) -> usize {
    usize::try_from(words.below(count)).unwrap()
}

/// The profile of a random case: a toy with every knob turned.
fn profile(words: &mut Words) -> Profile {
    let mut profile = load("tiny").unwrap();
    profile.window = WindowConfig { width: 11, height: 9 };
    profile.vertex.integer = 4;
    profile.vertex.sub_pixel = 1 + u32::try_from(words.below(3)).unwrap();
    profile.vertex.snap = Rounding::ALL[index(words, Rounding::ALL.len() as u64)];
    let pick = |words: &mut Words, n: u64| u32::try_from(words.below(n)).unwrap();
    profile.form = if words.below(3) == 0 {
        Form::EdgeWalk(EdgeWalkConfig {
            guard: 1,
            integer: 4,
            fraction: pick(words, 6),
            rounding: Rounding::ALL[index(words, Rounding::ALL.len() as u64)],
            clamp: Clamp::Guard,
        })
    } else {
        Form::EdgeFunction(
            EdgeWordConfig {
                rule: FillRule::ALL[index(words, 2)],
                storage: [EdgeStorage::Full, EdgeStorage::Shifted][index(words, 2)],
                width: 6 + pick(words, 12),
                conservative: None,
            }
            .into(),
        )
    };
    profile.depth = Some(DepthConfig {
        guard: pick(words, 3),
        integer: 2 + pick(words, 4),
        interpolation: pick(words, 6),
        rounding: Rounding::ALL[index(words, Rounding::ALL.len() as u64)],
        division: match words.below(3) {
            0 => Division::Reciprocal { bits: 3 + pick(words, 8) },
            _ => Division::Quotient,
        },
        clamp: [Clamp::Wrap, Clamp::Guard, Clamp::Sign, Clamp::Saturate][index(words, 4)],
        start_bias: [StartBias::None, StartBias::Half][index(words, 2)],
        format: None,
        bias: None,
    });
    profile.validate().unwrap();
    profile
}

/// A small scene of integer triangles that overlap, some without area.
fn triangles(words: &mut Words, profile: &Profile) -> Vec<scene::Triangle> {
    let high = 16 << profile.vertex.sub_pixel;
    let top = i64::try_from(profile.depth_max()).unwrap();
    (0..6)
        .map(|n| {
            let mut point = || [words.between(0, high), words.between(0, high)];
            let mut xy = [point(), point(), point()];
            if n == 5 {
                xy[2] = xy[0];
            }
            let z = [(); 3].map(|()| words.between(0, top));
            scene::Triangle::Lattice { xy, z: Some(z) }
        })
        .collect()
}

fn stage_of(triangles: Vec<scene::Triangle>, lens: Option<Lens>, base: &Profile) -> Stage {
    let scene = Scene { lens, ..Scene::new("case", triangles) };
    let reference = Reference::new(scene, base);
    let (grid, clip) = (base.grid().unwrap(), base.window().unwrap());
    let truth = Truth::new(&reference, &grid, clip, exact_rule(&base.form));
    Stage::new(&reference, &truth, base).unwrap()
}

fn snapped(model: &Model, triangles: &[scene::Triangle]) -> Vec<Triangle> {
    triangles.iter().map(|triangle| *model.snap(triangle).unwrap()).collect()
}

fn real(value: &exact::Rational) -> f64 {
    value.numer().to_f64().unwrap() / value.denom().to_f64().unwrap()
}

#[track_caller]
fn near(got: f64, wanted: f64, what: &str) {
    assert!((got - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{what}: {got}, not {wanted}");
}

#[test]
fn arithmetic_errors_are_those_of_every_sample() {
    let mut seen = Tally::default();
    for index in 0..250 {
        let mut words = Words::new(1, 40, index);
        let profile = profile(&mut words);
        let given = triangles(&mut words, &profile);
        let lens = (index % 2 == 0).then_some(Lens { near: 1.0, far: 7.0 });
        let stage = stage_of(given.clone(), lens, &profile);
        let drawn = Drawn::new(&stage, &profile).unwrap();
        let tally = measure(&stage, &drawn, &profile).tally;
        let model = Model::new(&profile).unwrap();
        let grid = profile.grid().unwrap();
        let (mut worst, mut sum, mut squares, mut count) = (0.0f64, 0.0, 0.0, 0);
        let (mut far, mut distances) = (0.0f64, 0.0);
        let (mut missing, mut extra) = (0, 0);
        let mut surplus: BTreeMap<(u32, u32), i32> = BTreeMap::new();
        for triangle in snapped(&model, &given) {
            triangle_error(&model, &model.place(triangle).unwrap(), |x, y, error| match error {
                SampleError::Missing => {
                    missing += 1;
                    *surplus.entry((x, y)).or_default() -= 1;
                }
                SampleError::Extra => {
                    extra += 1;
                    *surplus.entry((x, y)).or_default() += 1;
                }
                SampleError::Depth(ulp) => {
                    worst = worst.max(ulp.abs());
                    sum += ulp;
                    squares += ulp * ulp;
                    count += 1;
                    let at = grid.position(x.into(), y.into());
                    let code = plane_at(triangle.xy, triangle.z.unwrap(), at).unwrap();
                    let part = real(&code) / profile.depth_max() as f64;
                    // Distance by its definition, and its change by a small difference.
                    let distance = |part: f64| 7.0 / (7.0 - part * 6.0);
                    let steep = if lens.is_some() {
                        (distance(part + 1e-6) - distance(part - 1e-6)) / 2e-6
                    } else {
                        1.0
                    };
                    let off = ulp / profile.depth_max() as f64 * steep;
                    far = far.max(off.abs());
                    distances += off;
                }
            });
        }
        assert_eq!((tally.missing, tally.extra), (missing, extra), "case {index}: {profile:?}");
        let count_of = |sign| surplus.values().filter(|n| n.signum() == sign).count() as u64;
        assert_eq!((tally.holes, tally.double_hits), (count_of(-1), count_of(1)), "case {index}");
        assert_eq!(tally.depth.ulp.count, count, "case {index}");
        let what = format!("case {index}: {profile:?}");
        near(tally.depth.ulp.worst, worst, &what);
        near(tally.depth.ulp.sum, sum, &what);
        near(tally.depth.ulp.squares, squares, &what);
        let close = |got: f64, wanted: f64| (got - wanted).abs() <= 1e-6 * wanted.abs().max(1.0);
        assert!(close(tally.depth.world.worst, far), "{what}");
        assert!(close(tally.depth.world.sum, distances), "{what}");
        seen.merge(&tally);
    }
    // The cases met everything that they were to check.
    assert!(seen.missing > 100 && seen.extra > 100 && seen.wraps > 100 && seen.clamps > 100);
    assert!(seen.holes > 50 && seen.double_hits > 50 && seen.inversions > 50 && seen.ties > 50);
    assert!(seen.depth.ulp.count > 5_000);
}

#[test]
fn wraps_and_clamps_are_the_events_of_the_model() {
    for index in 0..300 {
        let mut words = Words::new(1, 41, index);
        let mut profile = profile(&mut words);
        // Exact coverage: the model then looks at the very samples that are measured.
        let wide = EdgeWordConfig {
            rule: FillRule::TopLeft,
            storage: EdgeStorage::Full,
            width: 40,
            conservative: None,
        };
        profile.form = Form::EdgeFunction(wide.into());
        let given = triangles(&mut words, &profile);
        let stage = stage_of(given.clone(), None, &profile);
        let tally = measure(&stage, &Drawn::new(&stage, &profile).unwrap(), &profile).tally;
        let model = Model::new(&profile).unwrap();
        let mut drawing = Drawing::default();
        for triangle in snapped(&model, &given) {
            model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        }
        let events = drawing.events.total;
        assert_eq!(tally.wraps, events.count(Event::Wrap), "{profile:?}");
        let clamps = events.count(Event::ClampAbove) + events.count(Event::ClampBelow);
        assert_eq!(tally.clamps, clamps, "{profile:?}");
        assert_eq!(stage.samples, drawing.samples());
    }
}

/// Every code the model draws at each pixel, beside the exact depth there.
fn layers(profile: &Profile, given: &[scene::Triangle]) -> BTreeMap<(u32, u32), Vec<Layer>> {
    let model = Model::new(profile).unwrap();
    let grid = profile.grid().unwrap();
    let mut layers: BTreeMap<(u32, u32), Vec<Layer>> = BTreeMap::new();
    for triangle in snapped(&model, given) {
        let mut drawing = Drawing::default();
        model.draw(&model.place(triangle).unwrap(), &mut drawing).unwrap();
        let mut codes = drawing.depth.iter();
        for span in &drawing.spans {
            for x in span.x0..span.x1 {
                let at = grid.position(x.into(), span.y.into());
                let exact = plane_at(triangle.xy, triangle.z.unwrap(), at).unwrap();
                let code = *codes.next().unwrap();
                layers.entry((x, span.y)).or_default().push(Layer { exact, code });
            }
        }
    }
    layers
}

struct Layer {
    exact: exact::Rational,
    code: u64,
}

#[test]
fn the_order_of_surfaces_is_that_of_the_drawn_codes() {
    let (mut inversions, mut ties) = (0, 0);
    for index in 0..150 {
        let mut words = Words::new(1, 42, index);
        let mut profile = profile(&mut words);
        let rule = FillRule::TopLeft;
        let wide =
            EdgeWordConfig { rule, storage: EdgeStorage::Full, width: 40, conservative: None };
        profile.form = Form::EdgeFunction(wide.into());
        let given = triangles(&mut words, &profile);
        let stage = stage_of(given.clone(), None, &profile);
        let tally = measure(&stage, &Drawn::new(&stage, &profile).unwrap(), &profile).tally;
        let (mut inverted, mut tied) = (0, 0);
        for pixel in layers(&profile, &given).values_mut() {
            pixel.sort_by(|a, b| a.exact.cmp(&b.exact));
            // Faces at one depth have no order; their neighbours are those beside them in drawing
            // order, which the stable sort keeps.
            for two in pixel.windows(2).filter(|two| two[0].exact != two[1].exact) {
                match two[0].code.cmp(&two[1].code) {
                    Ordering::Less => {}
                    Ordering::Equal => tied += 1,
                    Ordering::Greater => inverted += 1,
                }
            }
        }
        assert_eq!((tally.inversions, tally.ties), (inverted, tied), "case {index} {profile:?}");
        inversions += inverted;
        ties += tied;
    }
    assert!(inversions > 50 && ties > 50, "{inversions} {ties}");
}

/// Random real vertices on a fine lattice of 2^-20 pixels, so that doubles hold them exactly.
fn real_triangles(words: &mut Words, top: u64) -> Vec<([[i128; 2]; 3], [i128; 3])> {
    (0..5)
        .map(|_| {
            let mut point = || [(); 2].map(|()| words.between(0, 15 << 20));
            let xy = [point(), point(), point()];
            (xy, [(); 3].map(|()| i128::from(words.below(top + 1))))
        })
        .collect()
}

#[test]
fn snap_errors_are_those_of_every_sample() {
    let (mut missing, mut extra, mut vanished) = (0, 0, 0);
    for index in 0..80 {
        let mut words = Words::new(1, 43, index);
        let mut profile = profile(&mut words);
        let rule = FillRule::TopLeft;
        let wide =
            EdgeWordConfig { rule, storage: EdgeStorage::Full, width: 40, conservative: None };
        profile.form = Form::EdgeFunction(wide.into());
        profile.depth.as_mut().unwrap().integer = 10;
        let fine = real_triangles(&mut words, profile.depth_max());
        let given: Vec<scene::Triangle> = fine
            .iter()
            .map(|(xy, z)| scene::Triangle::Real {
                xy: xy.map(|v| v.map(|value| value as f64 / f64::from(1 << 20))),
                z: Some(z.map(|code| code as f64)),
            })
            .collect();
        let stage = stage_of(given.clone(), None, &profile);
        let model = Model::new(&profile).unwrap();
        let grid = profile.grid().unwrap();
        let Rect { x1: width, y1: height, .. } = profile.window().unwrap();
        let (mut gone, mut new, mut lost) = (0, 0, 0);
        let (mut worst, mut sum, mut attribute) = (0.0f64, 0.0, 0.0f64);
        for ((before, z), after) in fine.iter().zip(snapped(&model, &given)) {
            lost += u64::from(after.area2() == 0);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let at = grid.position(x.into(), y.into());
                let up = 20 - profile.vertex.sub_pixel;
                let fine_at = at.map(|value| value << up);
                let was = covers(*before, fine_at, Rule::TopLeft);
                let is = covers(after.xy, at, Rule::TopLeft);
                match (was, is) {
                    (true, false) => gone += 1,
                    (false, true) => new += 1,
                    (false, false) => {}
                    (true, true) => {
                        let off = |z_before, z_after| {
                            let off = plane_at(after.xy, z_after, at).unwrap()
                                - plane_at(*before, z_before, fine_at).unwrap();
                            real(&off)
                        };
                        let moved = off(*z, after.z.unwrap());
                        worst = worst.max(moved.abs());
                        sum += moved;
                        let top = i128::from(profile.depth_max());
                        attribute = attribute.max(off([0, top, 0], [0, top, 0]).abs());
                    }
                }
            }
        }
        assert_eq!((stage.snap.missing, stage.snap.extra), (gone, new), "case {index}");
        assert_eq!(stage.snap.vanished, lost);
        let what = format!("case {index}");
        near(stage.snap.depth.ulp.worst, worst, &what);
        near(stage.snap.depth.ulp.sum, sum, &what);
        near(stage.snap.attribute.ulp.worst, attribute, &what);
        missing += gone;
        extra += new;
        vanished += lost;
    }
    assert!(missing > 20 && extra > 20, "{missing} {extra} {vanished}");
}

#[test]
fn an_integer_scene_on_its_own_grid_has_no_snap_error_and_on_a_coarser_one_has() {
    let profile = load("tiny").unwrap();
    let xy = [[1, 1], [7, 2], [2, 7]];
    let given = vec![scene::Triangle::Lattice { xy, z: Some([0, 7, 3]) }];
    let scene = Scene::new("case", given);
    let reference = Reference::new(scene, &profile);
    let (clip, rule) = (profile.window().unwrap(), Rule::TopLeft);
    let on = |profile: &Profile| {
        let truth = Truth::new(&reference, &profile.grid().unwrap(), clip, rule);
        Stage::new(&reference, &truth, profile).unwrap()
    };
    assert_eq!(on(&profile).snap.missing + on(&profile).snap.extra, 0);
    assert_eq!(on(&profile).snap.depth.ulp.worst.to_bits(), 0f64.to_bits());
    // The same positions on a grid four times as fine, and depths of twice the bits.
    let mut finer = profile.clone();
    finer.vertex.sub_pixel = 3;
    assert_eq!(on(&finer).faces[0].triangle.xy, xy.map(|v| v.map(|value| value << 2)));
    assert_eq!(on(&finer).snap.missing + on(&finer).snap.extra, 0);
    finer.depth.as_mut().unwrap().integer = 6;
    // 3/7 of 63 is 27.
    assert_eq!(on(&finer).faces[0].triangle.z, Some([0, 63, 27]));
    // On a coarser grid, samples at the pixel's corner, odd coordinates have to move.
    let mut coarser = profile;
    coarser.vertex.sub_pixel = 0;
    coarser.sample = Some(guardbit::cover::SampleConfig::sub_pixels(0, 0));
    assert!(on(&coarser).snap.depth.ulp.worst > 0.1);
}

#[test]
fn distance_is_worth_most_where_it_changes_most() {
    // A plane that faces the camera at the far end: one code there is far (far - near) / near of
    // the codes' part, and a tenth of that in the middle of the world's near half.
    let lens = Lens { near: 1.0, far: 10.0 };
    let exact = |part: f64| {
        let d = 10.0 / (10.0 - 9.0 * part);
        d * d * 9.0 / 10.0
    };
    for part in [0.0, 0.5, 0.9, 1.0] {
        near(lens.steepness(part), exact(part), "steepness");
    }
    near(lens.steepness(1.0), 90.0, "at the far plane");
    assert_eq!(ratio(1, 2), Some(exact::dyadic(1, 1)));
}

/// A code of 64 bits is no real number: neither a finer grid nor the order of surfaces may take it
/// for one.
#[test]
fn depth_of_64_bits_keeps_every_bit() {
    let mut base = load("tiny").unwrap();
    let top = i128::from(u64::MAX);
    base.depth = base.depth.map(|d| DepthConfig { integer: 64, interpolation: 12, ..d });
    let face = |xy, z| scene::Triangle::Lattice { xy, z: Some(z) };
    let small = [[0, 0], [7, 1], [1, 7]];
    let large = [[0, 0], [8, 0], [0, 8]];
    // One code apart from vertex to vertex: no evaluator that is less than half a code off exchanges
    // any two.
    let near = |xy| face(xy, [top - 1, 0, 0]);
    let far = |xy| face(xy, [top, 1, 1]);
    let given = vec![near(large), far(large), near(small), far(small)];
    let stage = stage_of(given.clone(), None, &base);
    let drawn = Drawn::new(&stage, &base).unwrap();
    let tally = measure(&stage, &drawn, &base).tally;
    assert!(tally.depth.ulp.worst < 0.5);
    assert_eq!((tally.inversions, tally.ties), (0, 0));

    let scene = Scene::new("deep", given);
    let reference = Reference::new(scene, &base);
    let mut finer = base.clone();
    finer.vertex.sub_pixel = 3;
    let moved = reference.triangle(1, &finer);
    assert_eq!(moved, face(large.map(|v| v.map(|n| n << 2)), [top, 1, 1]));
}
