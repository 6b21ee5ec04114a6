//! Envelopes against plain twins: vertices rounded as integers, samples placed by where the outline crosses their row,
//! and the model itself in profiles of each width and snap.
#![allow(clippy::cast_precision_loss, reason = "small integers")]

use crate::oracle::covers;
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::FillRule;
use guardbit::exact::{Position, classify, round_dyadic};
use guardbit::measure::envelope::{
    Alone, Api, Class, Envelope, Family, Move, Rule, Search, Shape, Snap, Way, check, search,
    witness,
};
use guardbit::model::{Drawing, Model};
use guardbit::profile;
use guardbit::scene::Triangle;

const SIDE: u32 = 8;
const WINDOW: (u32, u32) = (SIDE, SIDE);
/// Bits below the pixel of the tests' coordinates; binary32 holds them.
const FINE: u32 = 14;

type Fine = [[i128; 2]; 3];

fn shape(fine: &Fine) -> Shape {
    fine.map(|vertex| vertex.map(|value| value as f64 / f64::from(1 << FINE)))
}

fn family(api: Api, bits: Option<(u32, u32)>) -> Family {
    Family::new(api, bits, &[]).unwrap()
}

/// Triangles of every kind that matters: small ones, slivers, corners and edges at samples and at ties of the snap.
fn triangle(index: u64) -> Fine {
    let mut words = Words::new(16, 4, index);
    let kind = words.below(4);
    let (pixel, half) = (1i64 << FINE, 1i64 << (FINE - 1));
    let near = [0; 2].map(|_| i64::try_from(words.below(8)).unwrap() * pixel + half);
    // A whole number of some unit.
    let mut between = |low: i64, high: i64, unit: i64| words.between(low, high) * i128::from(unit);
    [[0; 2]; 3].map(|_: [i128; 2]| {
        near.map(|near| match kind {
            0 => between(-pixel, 9 * pixel, 1),
            // A little around one sample.
            1 => i128::from(near) + between(-pixel / 16, pixel / 16, 1),
            // On the coarsest grid or half way, where samples are.
            2 => between(-32, 288, pixel / 32),
            // Near a sample or at it.
            _ => i128::from(near) + between(-2, 2, pixel) + between(-2, 2, pixel / 64),
        })
    })
}

/// The twin of a snap.
fn snapped(fine: &Fine, way: Way) -> Fine {
    let shift = FINE - way.bits;
    fine.map(|vertex| {
        vertex.map(|value| match way.snap {
            Snap::Round(rounding) => round_dyadic(value, shift, rounding),
            // The integers r with |r 2^shift - value| <= 0.6 2^shift.
            Snap::TolerantUp | Snap::TolerantDown => {
                let floor = value >> shift;
                let mut fits = (floor - 1..=floor + 1)
                    .filter(|r| 5 * ((r << shift) - value).abs() <= 3 << shift);
                match way.snap {
                    Snap::TolerantUp => fits.next_back().unwrap(),
                    _ => fits.next().unwrap(),
                }
            }
        })
    })
}

fn sample(bits: u32, [x, y]: [u32; 2]) -> [i128; 2] {
    let centre = |pixel: u32| (i128::from(pixel) << bits) + (1 << (bits - 1));
    [centre(x), centre(y)]
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| [x, y]))
}

/// Where a sample lies, by the three sides that it is on.
fn position(v: Fine, at: [i128; 2]) -> Position {
    let side = |n: usize| {
        let ([ax, ay], [bx, by]) = (v[n], v[(n + 1) % 3]);
        ((bx - ax) * (at[1] - ay) - (by - ay) * (at[0] - ax)).signum()
    };
    let area =
        (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    let sides = [0, 1, 2].map(|n| side(n) * area.signum());
    match sides.into_iter().min() {
        Some(1) => Position::Inside,
        Some(0) if area != 0 => Position::OnEdge,
        _ => Position::Outside,
    }
}

/// The twin of a triangle's envelope: whether some rasterizer covers each pixel, and whether some does not.
fn twin(family: &Family, fine: &Fine) -> Vec<Class> {
    let placed: Vec<(u32, Fine)> =
        family.ways.iter().map(|way| (way.bits, snapped(fine, *way))).collect();
    let of = |pixel| {
        let (mut covered, mut missed) = (false, false);
        for (bits, placed) in &placed {
            let at = sample(*bits, pixel);
            let (can, need) = if family.api == Api::D3d11 {
                let covered = covers(*placed, at, FillRule::TopLeft);
                (covered, covered)
            } else {
                let at = position(*placed, at);
                (at != Position::Outside, at == Position::Inside)
            };
            covered |= can;
            missed |= !need;
        }
        match (covered, missed) {
            (true, false) => Class::Must,
            (true, true) => Class::May,
            _ => Class::MustNot,
        }
    };
    pixels().map(of).collect()
}

/// Clauses EN-1, EN-2, EN-3, EN-4 and EN-5: random triangles against the twin, alone and as a scene.
fn agrees_with_the_twin(cases: std::ops::Range<u64>) -> [u64; 3] {
    let families = Api::ALL.map(|api| family(api, None));
    let mut seen = [0; 3];
    for index in cases {
        let fine = triangle(index);
        let family = &families[usize::try_from(index % 4).unwrap()];
        let want = twin(family, &fine);
        let scene = [shape(&fine)];
        let envelope = Envelope::of(family, &scene, WINDOW, 1).unwrap();
        let got: Vec<Class> = envelope.classes().collect();
        assert_eq!(got, want, "case {index}, {:?}: {fine:?}", family.api);
        let mut alone = vec![Class::MustNot; want.len()];
        // The twin's own way to place a sample, against that of exact rationals.
        let pixel = [u32::try_from(index % 8).unwrap(), u32::try_from(index / 8 % 8).unwrap()];
        let (placed, at) = (snapped(&fine, family.ways[0]), sample(family.ways[0].bits, pixel));
        assert_eq!(position(placed, at), classify(placed, at), "case {index}, {pixel:?}");
        for ([x, y], class) in Alone::of(family, &scene[0], WINDOW).pixels() {
            alone[(y * SIDE + x) as usize] = class;
        }
        assert_eq!(alone, want, "case {index}, alone");
        for class in &want {
            seen[*class as usize] += 1;
        }
    }
    seen
}

#[test]
fn envelopes_are_those_of_the_twin() {
    let seen = agrees_with_the_twin(0..64);
    assert!(seen.iter().all(|count| *count > 20), "every class comes up: {seen:?}");
}

#[test]
#[ignore = "long: 100,000 triangles in every way"]
fn long_envelopes_are_those_of_the_twin() {
    let threads: Vec<_> = (0..2u64)
        .map(|n| std::thread::spawn(move || agrees_with_the_twin(n * 50_000..(n + 1) * 50_000)))
        .collect();
    for thread in threads {
        println!("MUST, MAY, MUST NOT: {:?}", thread.join().unwrap());
    }
}

/// The model in a profile of these sub-pixel bits and this snap.
fn model(way: Way, rule: &str) -> Option<Model> {
    let Snap::Round(snap) = way.snap else { return None };
    let mut profile = profile::load("vulkan-8bit").unwrap();
    (profile.window.width, profile.window.height) = WINDOW;
    (profile.vertex.sub_pixel, profile.vertex.snap) = (way.bits, snap);
    profile.depth = None;
    let text = profile.to_toml().replace("\"top-left\"", &format!("\"{rule}\""));
    Model::new(&profile::parse(&text, "way").unwrap()).ok()
}

fn drawn(model: &Model, shape: &Shape) -> Vec<bool> {
    let mut drawing = Drawing::default();
    let triangle = model.snap(&Triangle::Real { xy: *shape, z: None }).unwrap();
    model.draw(&triangle, &mut drawing).unwrap();
    let mut covered = vec![false; (SIDE * SIDE) as usize];
    for span in &drawing.spans {
        (span.x0..span.x1).for_each(|x| covered[(span.y * SIDE + x) as usize] = true);
    }
    covered
}

/// Clauses EN-1 and EN-6: the model in each way of a family draws no pixel that it must not and all that it must,
/// each of its pictures is legal, and a witness with a rule of the model draws what it should.
#[test]
fn the_model_in_each_way_stays_in_the_envelope() {
    let family = family(Api::Vulkan, Some((4, 9)));
    let models: Vec<[Model; 2]> = family
        .ways
        .iter()
        .map(|way| ["top-left", "shadow"].map(|rule| model(*way, rule).unwrap()))
        .collect();
    let mut witnesses = 0;
    for index in 0..12 {
        let scene = [shape(&triangle(index))];
        let envelope = Envelope::of(&family, &scene, WINDOW, 1).unwrap();
        let classes: Vec<Class> = envelope.classes().collect();
        let pictures: Vec<[Vec<bool>; 2]> = models
            .iter()
            .map(|rules| rules.each_ref().map(|model| drawn(model, &scene[0])))
            .collect();
        for picture in pictures.as_flattened() {
            for (class, covered) in classes.iter().zip(picture) {
                let legal = *class == Class::May || (*class == Class::Must) == *covered;
                assert!(legal, "case {index}: {class:?}, drawn {covered}");
            }
        }
        // Every way twice would take long.
        for picture in [&pictures[0][1], &pictures[family.ways.len() - 1][0]] {
            let verdict = check(&family, &scene, &envelope, (picture, WINDOW)).unwrap();
            assert!(verdict.wrong.is_empty() && verdict.ways > 0, "case {index}: {verdict:?}");
        }
        for (n, pixel) in pixels().enumerate().filter(|(n, _)| classes[*n] == Class::May) {
            for (found, want) in witness(&family, &scene, pixel).into_iter().zip([true, false]) {
                let found = found.unwrap();
                let way = family.ways.iter().position(|way| *way == found.way).unwrap();
                let rule = match found.rule {
                    Rule::TOP_LEFT => 0,
                    Rule::TOP_RIGHT => 1,
                    _ => continue,
                };
                assert_eq!(pictures[way][rule][n], want, "case {index}, {pixel:?}: {found}");
                witnesses += 1;
            }
        }
    }
    assert!(witnesses > 20, "{witnesses} witnesses");
}

/// Clauses EN-5 and EN-6: of triangles around a sample exactly one has it, whatever the rule.
#[test]
fn a_sample_inside_a_fan_is_covered_once() {
    // Six corners around (2.5, 2.5) in halves of a pixel, clockwise; all on the coarsest grid.
    let ring = [[8, 5], [7, 8], [3, 7], [2, 5], [4, 2], [6, 3]];
    let halves: Vec<Fine> = (0..6).map(|n| [[5, 5], ring[n], ring[(n + 1) % 6]]).collect();
    let fan: Vec<Shape> =
        halves.iter().map(|fine| fine.map(|vertex| vertex.map(|half| half as f64 / 2.0))).collect();
    let family = family(Api::OpenGl, None);
    let class = |scene: &[Shape]| {
        let envelope = Envelope::of(&family, scene, WINDOW, 2).unwrap();
        envelope.classes().nth((2 * SIDE + 2) as usize).unwrap()
    };
    assert_eq!(class(&fan), Class::Must);
    for n in 0..6 {
        let mut less = fan.clone();
        assert_eq!(class(&[less.remove(n)]), Class::May, "one triangle of the fan");
        assert_eq!(class(&less), Class::May, "all but one");
    }
    // Rules in every direction give the sample to one triangle of the fan.
    for [x, y] in [[1, 0], [3, 1], [-2, 5], [-7, -1], [1, -9]] {
        let rule = Rule { toward: [x, y], then: [-y, x] };
        let owners = halves.iter().filter(|v| {
            // The edges that meet at the sample; the area is positive.
            let edges = [[0, 1], [2, 0]]
                .map(|[from, to]: [usize; 2]| [v[to][0] - v[from][0], v[to][1] - v[from][1]]);
            edges.iter().all(|edge| rule.owns(*edge))
        });
        assert_eq!(owners.count(), 1, "{rule}");
    }
}

/// Clause EN-6: pictures that break a clause, and one that no single rasterizer draws.
#[test]
fn pictures_are_judged_by_pixel_and_as_a_whole() {
    let family = family(Api::Vulkan, Some((4, 5)));
    // Two triangles that share the diagonal of pixels (0, 0) to (3, 3), through their samples.
    let square = |from: f64, to: f64| {
        [[[from, from], [to, from], [to, to]], [[from, from], [to, to], [from, to]]]
    };
    let scene = square(0.0, 4.0);
    let envelope = Envelope::of(&family, &scene, WINDOW, 1).unwrap();
    assert_eq!(envelope.count(), [16, 0, 48]);
    let mut picture: Vec<bool> = envelope.classes().map(|class| class == Class::Must).collect();
    let verdict = check(&family, &scene, &envelope, (&picture, WINDOW)).unwrap();
    assert_eq!((verdict.wrong.len(), verdict.ways), (0, family.ways.len()));
    for (n, clause) in [(0, "EN-5"), (1, "EN-4"), (7, "EN-4")] {
        picture[n] = !picture[n];
        let verdict = check(&family, &scene, &envelope, (&picture, WINDOW)).unwrap();
        let [wrong] = verdict.wrong[..] else { panic!("{verdict:?}") };
        let x = u32::try_from(n).unwrap();
        assert_eq!((wrong.pixel, wrong.clause, verdict.drawn_by), ([x, 0], clause, None));
        picture[n] = !picture[n];
    }
    // The left edge of a triangle through one sample, the right edge of another through the next: one rule gives
    // both or none of these samples, if the edges are parallel and the triangles lie on the same side.
    let left = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x, 1.0]];
    let scene = [left(0.5), left(3.5)];
    let envelope = Envelope::of(&family, &scene, WINDOW, 1).unwrap();
    let mut picture = vec![false; 64];
    for (first, second, legal) in
        [(false, false, true), (true, true, true), (true, false, false), (false, true, false)]
    {
        (picture[0], picture[3]) = (first, second);
        let verdict = check(&family, &scene, &envelope, (&picture, WINDOW)).unwrap();
        assert_eq!((verdict.wrong.len(), verdict.drawn_by.is_some()), (0, legal));
    }
    assert!(check(&family, &scene, &envelope, (&picture, (4, 16))).is_err());
}

/// Clause EN-7: what is found is enough by the twin, and nothing smaller of its kind is.
#[test]
fn a_move_is_enough_and_the_smallest_of_its_kind() {
    let family = family(Api::WebGpu, Some((4, 8)));
    let unit = 1i128 << FINE;
    // A triangle of 3 x 3 pixels whose left edge runs through samples, 1/64 pixel off.
    let fine =
        [[unit / 2 + unit / 64, -unit / 2], [4 * unit, unit], [unit / 2 + unit / 64, 5 * unit]];
    let want: Vec<bool> =
        pixels().map(|pixel| classify(fine, sample(FINE, pixel)) == Position::Inside).collect();
    let decided = |by: Move| {
        let mut moved = fine;
        for (vertex, steps) in moved.iter_mut().zip(by.steps) {
            (0..2).for_each(|axis| vertex[axis] += i128::from(steps[axis]) * unit / 16);
        }
        let classes = twin(&family, &moved);
        classes.iter().zip(&want).all(|(class, want)| match class {
            Class::May => false,
            Class::Must => *want,
            Class::MustNot => !want,
        })
    };
    assert!(!decided(Move { steps: [[0; 2]; 3] }));
    let Search::Found(found) = search(&family, &shape(&fine), WINDOW, 4) else { panic!("nothing") };
    assert!(decided(found), "{found:?}");
    for size in 1..found.most() {
        let size = i32::try_from(size).unwrap();
        for x in -size..=size {
            for y in -size..=size {
                assert!(!decided(Move { steps: [[x, y]; 3] }), "all by {x}, {y}");
            }
        }
    }
    // A sliver through samples of a row: no move of one step makes it thick enough.
    let sliver = [[0.2, 3.498], [7.8, 3.499], [7.8, 3.503]];
    assert_eq!(search(&family, &sliver, WINDOW, 1), Search::Nothing);
    // Vertices on the coarsest grid, and no sample on an edge.
    let plain = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.25]];
    assert_eq!(search(&family, &plain, WINDOW, 1), Search::Decided);
}

/// Clause EN-3: the ends of Direct3D's tolerance for every eighth of a unit, and for binary32 numbers beside 0.4.
#[test]
fn tolerant_snaps_are_the_ends_of_the_tolerance() {
    for eighths in -40i128..=40 {
        let value = eighths as f64 / 8.0 / 256.0;
        for (snap, want) in [
            (Snap::TolerantUp, (5 * eighths + 24).div_euclid(40)),
            (Snap::TolerantDown, -(24 - 5 * eighths).div_euclid(40)),
            (Snap::Round(Rounding::Floor), eighths.div_euclid(8)),
        ] {
            assert_eq!(snap.apply(value, 8), Some(want), "{eighths}/8 by {snap}");
        }
    }
}
