//! Coverage of random triangles against brute force, and the promises of fill rules.

use crate::oracle::{covers, polygon_covers};
use crate::property::{base, cases, draw, grids, pixels, vertex};
use guardbit::bits::SpanEvents;
use guardbit::cover::{EdgeStorage, EdgeWordConfig, FillRule, Rect};
use guardbit::dda::{Line, Processor, twin};
use guardbit::format::Clamp;
use guardbit::machine::EdgeWalkConfig;
use guardbit::model::{Drawing, Model, Span, View};
use guardbit::profile::{Form, Profile};
use guardbit::setup::Triangle;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn rules() -> impl Strategy<Value = FillRule> {
    prop::sample::select(&FillRule::ALL[..])
}

fn storages() -> impl Strategy<Value = EdgeStorage> {
    prop::sample::select(&[EdgeStorage::Full, EdgeStorage::Shifted][..])
}

/// A profile whose edge words hold everything.
fn exact(s: u32, offset: [u32; 2], rule: FillRule, storage: EdgeStorage) -> Profile {
    let mut profile = base(s, offset);
    profile.depth = None;
    profile.form =
        Form::EdgeFunction(EdgeWordConfig { rule, storage, width: 40, conservative: None }.into());
    profile
}

fn sample(profile: &Profile, x: u32, y: u32) -> [i128; 2] {
    let offset = profile.sample.unwrap();
    let at = |pixel: u32, by: u32| (i128::from(pixel) << profile.vertex.sub_pixel) + i128::from(by);
    [at(x, offset.x), at(y, offset.y)]
}

fn brute(profile: &Profile, inside: impl Fn([i128; 2]) -> bool) -> BTreeSet<(u32, u32)> {
    let (width, height) = (profile.window.width, profile.window.height);
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (y, x)))
        .filter(|(y, x)| inside(sample(profile, *x, *y)))
        .collect()
}

fn area2(a: [i128; 2], b: [i128; 2], c: [i128; 2]) -> i128 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// How often each pixel is hit by a list of triangles.
fn hits(model: &Model, triangles: &[[[i128; 2]; 3]]) -> BTreeMap<(u32, u32), u32> {
    let mut hits = BTreeMap::new();
    for xy in triangles {
        for pixel in pixels(&draw(model, &Triangle { xy: *xy, z: None })) {
            *hits.entry(pixel).or_default() += 1;
        }
    }
    hits
}

/// A profile's grid and the three vertices of a triangle on it.
fn scenes() -> impl Strategy<Value = ((u32, [u32; 2]), [[i128; 2]; 3])> {
    grids().prop_flat_map(|(s, offset)| {
        (Just((s, offset)), [vertex(s, offset), vertex(s, offset), vertex(s, offset)])
    })
}

proptest! {
    #![proptest_config(cases(800))]

    // Clauses C-1, C-2, C-3, C-4, C-7, E-1, E-2, T-1, T-2, T-3
    #[test]
    fn coverage_is_exact(
        ((s, offset), xy) in scenes(), rule in rules(), storage in storages(), order in 0..6usize,
    ) {
        let profile = exact(s, offset, rule, storage);
        let expected = brute(&profile, |p| covers(xy, p, rule));
        for processor in Processor::available() {
            let view = View { processor, ..View::default() };
            let model = Model::with_view(&profile, view).unwrap();
            let drawing = draw(&model, &Triangle { xy, z: None });
            prop_assert_eq!(&pixels(&drawing), &expected, "{}", processor.name());
            prop_assert_eq!(drawing.zero_area, area2(xy[0], xy[1], xy[2]) == 0);
        }
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let turned = orders[order].map(|n: usize| xy[n]);
        let model = Model::new(&profile).unwrap();
        prop_assert_eq!(pixels(&draw(&model, &Triangle { xy: turned, z: None })), expected);
    }

    // Clauses C-4, C-5, C-7, E-3
    #[test]
    fn narrow_words_wrap_inside_the_bounding_box(
        ((s, offset), xy) in scenes(), rule in rules(), storage in storages(), width in 2..=18u32,
    ) {
        prop_assume!(area2(xy[0], xy[1], xy[2]) != 0);
        let mut profile = exact(s, offset, rule, storage);
        profile.form = Form::EdgeFunction(EdgeWordConfig { rule, storage, width, conservative: None }.into());
        let [a, b, c] = xy;
        let v = if area2(a, b, c) < 0 { [a, c, b] } else { xy };
        let inside = |p: [i128; 2]| {
            let boxed = (0..2).all(|axis| {
                let values = v.map(|vertex| vertex[axis]);
                (*values.iter().min().unwrap()..=*values.iter().max().unwrap()).contains(&p[axis])
            });
            boxed && (0..3).all(|k| {
                let (from, to) = (v[k], v[(k + 1) % 3]);
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let owner = match rule {
                    FillRule::TopLeft => dy < 0 || dy == 0 && dx > 0,
                    FillRule::Shadow => dy > 0 || dy == 0 && dx > 0,
                };
                let e = dx * (p[1] - from[1]) - dy * (p[0] - from[0]) - i128::from(!owner);
                let stored = if storage == EdgeStorage::Full { e } else { e.div_euclid(1 << s) };
                stored.rem_euclid(1 << width) < 1 << (width - 1)
            })
        };
        let drawing = draw(&Model::new(&profile).unwrap(), &Triangle { xy, z: None });
        prop_assert_eq!(pixels(&drawing), brute(&profile, inside));
    }

    // Clauses C-2, C-3
    #[test]
    fn both_diagonals_of_a_quad_cover_it_once(
        ((s, offset), corners) in grids().prop_flat_map(|(s, offset)| {
            let corner = || vertex(s, offset);
            (Just((s, offset)), [corner(), corner(), corner(), corner()])
        }),
        rule in rules(), storage in storages(),
    ) {
        let [a, b, c, d] = corners;
        let turns = [area2(a, b, c), area2(b, c, d), area2(c, d, a), area2(d, a, b)];
        let model = Model::new(&exact(s, offset, rule, storage)).unwrap();
        // Either side of a shared edge, whatever the quad: no sample twice.
        if turns[0].signum() * turns[2].signum() > 0 {
            let once = hits(&model, &[[a, b, c], [c, d, a]]);
            prop_assert!(once.values().all(|n| *n == 1), "double hit");
            // Convex: the other diagonal covers the very same samples, so neither leaves a hole.
            if turns.iter().all(|t| t.signum() == turns[0].signum()) {
                prop_assert_eq!(once, hits(&model, &[[b, c, d], [b, d, a]]));
            }
        }
    }

    // Clauses C-2, C-3
    #[test]
    fn a_fan_covers_its_polygon_once(
        ((s, offset), centre) in grids()
            .prop_flat_map(|(s, offset)| (Just((s, offset)), vertex(s, offset))),
        spokes in prop::collection::btree_set((0..64i128, 1..12i128), 0..12),
        rule in rules(), storage in storages(),
    ) {
        // Spokes along a square's outline, in order; the four diagonals keep each turn short.
        let mut rim: Vec<(i128, [i128; 2])> = Vec::new();
        let place = |at: i128| match at / 16 {
            0 => [at - 8, -8],
            1 => [8, at - 24],
            2 => [40 - at, 8],
            _ => [-8, 56 - at],
        };
        for (at, length) in spokes.into_iter().chain([(0, 5), (16, 3), (32, 9), (48, 7)]) {
            if rim.iter().all(|(other, _)| *other != at) {
                rim.push((at, place(at).map(|v| v * length / 8)));
            }
        }
        rim.sort_unstable();
        let profile = exact(s, offset, rule, storage);
        let (low, high) = profile.vertex.range();
        let rim: Vec<[i128; 2]> = rim
            .iter()
            .map(|(_, [x, y])| [centre[0] + x, centre[1] + y])
            .collect();
        prop_assume!(rim.iter().flatten().all(|v| (low..=high).contains(v)));
        let fan: Vec<_> = (0..rim.len())
            .map(|n| [centre, rim[n], rim[(n + 1) % rim.len()]])
            .collect();
        // Rounding the spokes to integers can fold the rim; such a fan is no fan.
        prop_assume!(fan.iter().all(|[a, b, c]| area2(*a, *b, *c) > 0));
        let hits = hits(&Model::new(&profile).unwrap(), &fan);
        prop_assert!(hits.values().all(|n| *n == 1), "double hit");
        let expected = brute(&profile, |p| polygon_covers(&rim, p, rule));
        prop_assert_eq!(hits.into_keys().collect::<BTreeSet<_>>(), expected);
    }
}

/// The part of a drawing inside a rectangle, events by looking at every sample.
fn cut(model: &Model, whole: &Drawing, rect: Rect) -> Drawing {
    let mut part =
        Drawing { setup: whole.setup.clone(), zero_area: whole.zero_area, ..Drawing::default() };
    let mut depth = whole.depth.iter().copied();
    let mut values = BTreeMap::new();
    for span in &whole.spans {
        for x in span.x0..span.x1 {
            if let Some(z) = depth.next() {
                values.insert((span.y, x), z);
            }
        }
    }
    let mut total = SpanEvents::default();
    for span in &whole.spans {
        let (x0, x1) = (span.x0.max(rect.x0), span.x1.min(rect.x1));
        if x0 >= x1 || span.y < rect.y0 || span.y >= rect.y1 {
            continue;
        }
        part.spans.push(Span { y: span.y, x0, x1 });
        part.depth.extend((x0..x1).filter_map(|x| values.get(&(span.y, x))));
        if let (Some(depth), false) = (model.depth(), values.is_empty()) {
            let [start, dx, dy] = whole.raw_setup()[whole.setup.len() - 3..] else {
                unreachable!()
            };
            let start = start + dx * i128::from(x0) + dy * i128::from(span.y);
            let line = Line { start, slope: dx, count: u64::from(x1 - x0) };
            let place = guardbit::bits::Place { y: span.y.into(), x: x0.into() };
            total.append(&twin::span_events(depth.read_out(), line, place));
        }
    }
    part.events.total = total;
    part
}

proptest! {
    #![proptest_config(cases(400))]

    // Clauses C-6, G-5, V-2, V-3
    #[test]
    fn a_scissor_or_a_smaller_window_only_takes_away(
        ((s, offset), xy) in scenes(),
        z in prop::option::of([0..8i128, 0..8i128, 0..8i128]),
        clamp in prop::sample::select(&[Clamp::Wrap, Clamp::Guard, Clamp::Sign, Clamp::Saturate][..]),
        walks in any::<bool>(), width in 4..30u32,
        (x0, y0, across, down) in (0..20u32, 0..16u32, 0..20u32, 0..16u32),
        small in (1..=16u32, 1..=12u32),
    ) {
        let mut profile = base(s, offset);
        profile.depth.as_mut().unwrap().clamp = clamp;
        profile.form = if walks {
            let rounding = guardbit::bits::Rounding::NearestEven;
            Form::EdgeWalk(EdgeWalkConfig { guard: 1, integer: 7, fraction: width / 4, rounding, clamp: Clamp::Guard })
        } else {
            let (rule, storage) = (FillRule::TopLeft, EdgeStorage::Shifted);
            Form::EdgeFunction(EdgeWordConfig { rule, storage, width, conservative: None }.into())
        };
        let triangle = Triangle { xy, z };
        let model = Model::new(&profile).unwrap();
        let whole = draw(&model, &triangle);
        prop_assert_eq!(&cut(&model, &whole, model.clip()), &whole);
        let scissor = Rect { x0, y0, x1: x0 + across, y1: y0 + down };
        let view = View { scissor: Some(scissor), ..View::default() };
        let scissored = draw(&Model::with_view(&profile, view).unwrap(), &triangle);
        prop_assert_eq!(scissored, cut(&model, &whole, scissor));
        let view = View { window: Some(small), ..View::default() };
        let smaller = draw(&Model::with_view(&profile, view).unwrap(), &triangle);
        prop_assert_eq!(smaller, cut(&model, &whole, Rect { x0: 0, y0: 0, x1: small.0, y1: small.1 }));
    }
}
