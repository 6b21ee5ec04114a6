//! The edge walk against its clauses in exact rationals, and against exact coverage.

use crate::oracle::covers;
use crate::property::rounding::{round, roundings};
use crate::property::{base, cases, draw, grids, pixels, vertex};
use guardbit::bits::Rounding;
use guardbit::cover::FillRule;
use guardbit::format::Clamp;
use guardbit::machine::EdgeWalkConfig;
use guardbit::model::Model;
use guardbit::profile::Form;
use guardbit::setup::Triangle;
use num_bigint::BigInt;
use num_integer::Integer;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Columns [left, right) of a row, from the clauses.
fn row(
    v: [[i128; 2]; 3],
    y: i128,
    (s, offset): (u32, [u32; 2]),
    config: EdgeWalkConfig,
) -> Option<(i128, i128)> {
    let one = BigInt::from(1);
    let sample_y = |row: i128| (row << s) + i128::from(offset[1]);
    let mut ends = [None, None];
    for k in 0..3 {
        let (from, to) = (v[k], v[(k + 1) % 3]);
        let (top, bottom) = if from[1] < to[1] { (from, to) } else { (to, from) };
        let crosses = |row: i128| top[1] <= sample_y(row) && sample_y(row) < bottom[1];
        if !crosses(y) {
            continue;
        }
        let mut first = y;
        while crosses(first - 1) {
            first -= 1;
        }
        // x = top + (sample - top) dx/dy, in pixels; then scaled by 2^f and rounded.
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        let numerator = BigInt::from(top[0] * dy + (sample_y(first) - top[1]) * dx);
        let start =
            round(config.rounding, &(numerator << config.fraction), &(BigInt::from(dy) << s));
        let slope =
            round(config.rounding, &(BigInt::from(dx) << config.fraction), &BigInt::from(dy));
        let x = start + slope * (y - first);
        // The representative in the guard range.
        let width = config.guard + config.integer + config.fraction;
        let lowest = (&one << (config.integer + config.fraction - 1)) - (&one << (width - 1));
        let x = (x - &lowest).mod_floor(&(&one << width)) + lowest;
        // ceil(x - ox / 2^s)
        let exact = (x << s) - (BigInt::from(offset[0]) << config.fraction);
        let pixel = exact.div_ceil(&(&one << (config.fraction + s)));
        ends[usize::from(from[1] < to[1])] = Some(i128::try_from(pixel).unwrap());
    }
    ends[0].zip(ends[1])
}

fn scenes() -> impl Strategy<Value = ((u32, [u32; 2]), [[i128; 2]; 3])> {
    grids().prop_flat_map(|(s, offset)| {
        (Just((s, offset)), [vertex(s, offset), vertex(s, offset), vertex(s, offset)])
    })
}

fn normalised([a, b, c]: [[i128; 2]; 3]) -> ([[i128; 2]; 3], i128) {
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    (if area < 0 { [a, c, b] } else { [a, b, c] }, area.abs())
}

proptest! {
    #![proptest_config(cases(600))]

    // Clauses K-1, K-2, K-3, K-4, K-5
    #[test]
    fn rows_follow_the_clauses(
        (grid, xy) in scenes(), rounding in roundings(),
        guard in 0..=2u32, integer in 3..=7u32, fraction in 0..=14u32,
    ) {
        let config = EdgeWalkConfig { guard, integer, fraction, rounding, clamp: Clamp::Guard };
        let mut profile = base(grid.0, grid.1);
        profile.depth = None;
        profile.form = Form::EdgeWalk(config);
        let (v, area) = normalised(xy);
        let mut expected = BTreeSet::new();
        for y in 0..12u32 {
            if let (Some((left, right)), true) = (row(v, y.into(), grid, config), area > 0) {
                expected.extend((0..16u32).filter(|x| (left..right).contains(&i128::from(*x))).map(|x| (y, x)));
            }
        }
        let model = Model::new(&profile).unwrap();
        prop_assert_eq!(pixels(&draw(&model, &Triangle { xy, z: None })), expected);
    }

    // Clauses K-3, K-4, C-2
    #[test]
    fn enough_floored_bits_are_exact(((s, offset), xy) in scenes()) {
        // Half-open fields of 2^6 pixels: 2k + 2s = 20 bits at most.
        let (guard, integer, rounding) = (2, 7, Rounding::Floor);
        let mut profile = base(s, offset);
        profile.depth = None;
        profile.form = Form::EdgeWalk(EdgeWalkConfig { guard, integer, fraction: 24, rounding, clamp: Clamp::Guard });
        let mut expected = BTreeSet::new();
        for (y, x) in (0..12u32).flat_map(|y| (0..16u32).map(move |x| (y, x))) {
            let at = |pixel: u32, by: u32| i128::from((pixel << s) + by);
            if covers(xy, [at(x, offset[0]), at(y, offset[1])], FillRule::TopLeft) {
                expected.insert((y, x));
            }
        }
        let model = Model::new(&profile).unwrap();
        prop_assert_eq!(pixels(&draw(&model, &Triangle { xy, z: None })), expected);
    }
}
