//! Attributes against their exact values.
#![allow(
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and its numbers are small"
)]

use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::cover::{DepthAt, MultisampleConfig, SampleGrid};
use guardbit::exact::{Point, Rational, integer, perspective_at, plane_at, ratio};
use guardbit::setup::Triangle;
use guardbit::value::{Interpolation, InterpolationConfig, InterpolationError, Interpolator};

const GRID: SampleGrid = SampleGrid::at([8, 8], 4);
const WAYS: [Interpolation; 5] = [
    Interpolation::Affine,
    Interpolation::Divide,
    Interpolation::Reciprocal { bits: 14 },
    Interpolation::Barycentric,
    Interpolation::ConstantW,
];

fn config(by: Interpolation, fraction: u32) -> InterpolationConfig {
    InterpolationConfig { by, fraction, rounding: Rounding::NearestEven }
}

fn real(value: &Rational) -> f64 {
    let scaled = (value * integer(1 << 60)).floor().to_integer();
    i128::try_from(scaled).unwrap() as f64 / (1i128 << 60) as f64
}

/// Clauses I-1 to I-5: with w = 1 and 3 and an attribute from 0 to 1024 the middle of the edge reads 256 by
/// every means in perspective, 512 by the affine one; constant w along a row cannot know.
#[test]
fn the_screen_midpoint_reads_a_quarter() {
    // The middle of the edge from (0, 1/2) to (16, 1/2) pixels is the corner of pixels 7 and 8; the
    // grid has a sample there with offset 0.
    let grid = SampleGrid::at([0, 8], 4);
    let triangle = Triangle { xy: [[0, 8], [256, 8], [0, 200]], z: None };
    for by in WAYS {
        let made = Interpolator::new(config(by, 20), &triangle, grid, [0, 1024, 0], [1, 3, 1]);
        let value = made.unwrap().at(8, 0, [0, 15]).unwrap() as f64 / f64::from(1 << 20);
        let wanted = match by {
            Interpolation::Affine => 512.0,
            _ => 256.0,
        };
        if by != Interpolation::ConstantW {
            assert!((value - wanted).abs() < 0.1, "{by:?}: {value}");
        }
    }
}

/// Clauses I-2, I-3 and I-4: the stated bounds hold for random triangles and w, near and far.
#[test]
#[ignore = "soak tier: cargo test -- --include-ignored"]
fn errors_stay_within_their_bounds() {
    let mut closest = [0.0f64; 5];
    let mut seen = 0;
    for index in 0..1500 {
        let mut words = Words::new(31, 4, index);
        let mut at = || [words.between(0, 900), words.between(0, 700)];
        let triangle = Triangle { xy: [at(), at(), at()], z: None };
        let span = [4, 60, 65_536][index as usize % 3];
        let w = [(); 3].map(|()| words.between(1, span));
        let u = [(); 3].map(|()| words.between(0, 65_535));
        if triangle.area2() == 0 {
            continue;
        }
        let fraction = 20;
        let unit = (-f64::from(fraction)).exp2();
        for (n, by) in WAYS.into_iter().enumerate().skip(1).take(3) {
            let made = Interpolator::new(config(by, fraction), &triangle, GRID, u, w).unwrap();
            // Samples inside only: outside Q may come to nothing.
            for k in 0..30 {
                let (x, y) = (k * 7 % 57, k * 11 % 44);
                let position = GRID.position(x.into(), y.into());
                if !guardbit::exact::covers(triangle.xy, position, guardbit::exact::Rule::TopLeft) {
                    continue;
                }
                let exact = real(&perspective_at(triangle.xy, u, w, position).unwrap());
                let e = f64::from(1 + x + y) * unit / 2.0;
                // The exact Q, over the power of two above the products of two w.
                let q = [w[1] * w[2], w[2] * w[0], w[0] * w[1]];
                let scale = 128 - (q[0] | q[1] | q[2]).leading_zeros();
                let q_here =
                    real(&plane_at(triangle.xy, q, position).unwrap()) / f64::from(scale).exp2();
                let divide = (e + exact * e) / (q_here - e) + unit / 2.0;
                let bound = match by {
                    Interpolation::Divide => divide,
                    Interpolation::Reciprocal { bits } => {
                        divide * 1.01 + exact * (-f64::from(bits)).exp2()
                    }
                    _ => ((u[1] - u[0]).abs() + (u[2] - u[0]).abs()) as f64 * unit / 2.0,
                };
                let got = made.at(x, y, [x, x]);
                if q_here <= e && by != Interpolation::Barycentric {
                    continue;
                }
                let error = (got.unwrap() as f64 * unit - exact).abs();
                assert!(
                    error <= bound + 1e-9,
                    "{by:?} {triangle:?} {w:?} {u:?}: {error} > {bound}"
                );
                closest[n] = closest[n].max(error / bound);
                seen += 1;
            }
        }
    }
    assert!(seen > 2000 && closest[1..4].iter().all(|part| *part > 0.2), "{seen} {closest:?}");
}

/// Clauses I-1 and I-5: what is exact where w is constant, or constant along rows.
#[test]
fn constant_w_is_exact_where_w_is_constant() {
    // w depends on y alone: the vertices of one row share it.
    let triangle = Triangle { xy: [[0, 0], [800, 0], [300, 600]], z: None };
    let (u, floor, level) = ([100, 60_000, 9000], [2, 2, 9], [7, 7, 7]);
    let error = |by, w: [i128; 3]| {
        let made = Interpolator::new(config(by, 24), &triangle, GRID, u, w).unwrap();
        let mut worst = 0.0f64;
        for y in 0..30u32 {
            for x in y / 2 + 2..30 {
                let at = GRID.position(x.into(), y.into());
                let exact = real(&perspective_at(triangle.xy, u, w, at).unwrap());
                let got = made.at(x, y, [0, 40]).unwrap() as f64 / f64::from(1 << 24);
                worst = worst.max((got - exact).abs());
            }
        }
        worst
    };
    assert!(error(Interpolation::ConstantW, floor) < 0.3);
    assert!(error(Interpolation::Affine, floor) > 500.0);
    assert!(error(Interpolation::Affine, level) < 0.001);
    assert!(error(Interpolation::ConstantW, [2, 9, 2]) > 500.0, "it is wrong on a wall");
}

/// Clause I-6: the quotient rule is the limit of differences, and a quad's difference is one of them.
#[test]
fn derivatives_are_the_limit_of_differences() {
    let triangle = Triangle { xy: [[0, 0], [900, 40], [100, 700]], z: None };
    let (u, w) = ([10, 60_000, 30_000], [1, 4, 2]);
    let made = Interpolator::new(config(Interpolation::Divide, 24), &triangle, GRID, u, w).unwrap();
    for (x, y) in [(4, 4), (11, 9), (20, 3), (9, 16)] {
        let ([dx, dy], whole) = made.derivatives(x, y).unwrap();
        let (dx, dy) = (dx as f64 / whole as f64, dy as f64 / whole as f64);
        // Exact differences over a thousandth of a pixel, from the definition.
        let value = |sx: i128, sy: i128| {
            let at = GRID.position(x.into(), y.into()).map(integer);
            let step = |n: i128| ratio(n, 1000).unwrap() * integer(16);
            let [px, py] = at;
            let point = Point { x: px + step(sx), y: py + step(sy) };
            perspective_at(triangle.xy, u, w, point).unwrap()
        };
        let across = real(&(value(1, 0) - value(-1, 0))) * 500.0;
        let down = real(&(value(0, 1) - value(0, -1))) * 500.0;
        assert!((dx - across).abs() < 0.05 + across.abs() * 1e-4, "{dx} {across}");
        assert!((dy - down).abs() < 0.05 + down.abs() * 1e-4, "{dy} {down}");
        let quad = made.quad_differences(x, y).unwrap();
        let at = |x, y| made.at(x, y, [x, x]).unwrap();
        assert_eq!(quad, [at(x | 1, y) - at(x & !1, y), at(x, y | 1) - at(x, y & !1)]);
    }
    let flat =
        Interpolator::new(config(Interpolation::Affine, 24), &triangle, GRID, u, [5; 3]).unwrap();
    let ([dx, _], whole) = flat.derivatives(3, 3).unwrap();
    assert_eq!(flat.quad_differences(3, 3).unwrap()[0] << 24, dx * (1 << 48) / whole);
}

/// Clause I-7: extrapolated to the centre an attribute leaves the range of its vertices; at the centroid
/// it never does.
#[test]
fn centroids_stay_in_range_and_centres_do_not() {
    let four = MultisampleConfig::standard(4, DepthAt::Centre);
    let grids = four.grids(4);
    let (mut outside, mut pixels) = (0, 0);
    for index in 0..800 {
        let mut words = Words::new(32, 4, index);
        let mut at = || [words.between(0, 64), words.between(0, 64)];
        let triangle = [at(), at(), at()];
        let u = [(); 3].map(|()| words.between(0, 1000));
        let range = (integer(*u.iter().min().unwrap()), integer(*u.iter().max().unwrap()));
        for (x, y) in (0..4).flat_map(|x| (0..4).map(move |y| (x, y))) {
            let covers = |grid: &SampleGrid| {
                guardbit::exact::covers(
                    triangle,
                    grid.position(x, y),
                    guardbit::exact::Rule::TopLeft,
                )
            };
            let mask = (0u32..)
                .zip(&grids)
                .filter(|(_, grid)| covers(grid))
                .fold(0, |m, (n, _)| m | 1 << n);
            if mask == 0 {
                continue;
            }
            pixels += 1;
            let centre = plane_at(triangle, u, [x * 16 + 8, y * 16 + 8]).unwrap();
            outside += u32::from(centre < range.0 || centre > range.1);
            // The mean place of the covered samples.
            let covered: Vec<usize> = (0..4).filter(|n| mask >> n & 1 == 1).collect();
            let mean = |axis: usize, pixel: i128| {
                let sum: i128 = covered.iter().map(|n| grids[*n].offset[axis]).sum();
                ratio(sum, covered.len() as i128).unwrap() + integer(pixel * 16)
            };
            let centroid = Point { x: mean(0, x), y: mean(1, y) };
            let value = plane_at(triangle, u, centroid).unwrap();
            assert!(value >= range.0 && value <= range.1, "{triangle:?} {x} {y} {mask}");
        }
    }
    assert!(pixels > 1000 && outside > 50, "{pixels} {outside}");
}

/// Clause I-8: w at and through zero, attributes and words out of range: refused by name, and nothing
/// panics at the horizon or at the largest ratios.
#[test]
fn what_has_no_value_is_refused_by_name() {
    let triangle = Triangle { xy: [[0, 0], [800, 0], [0, 600]], z: None };
    let make = |u, w| Interpolator::new(config(Interpolation::Divide, 20), &triangle, GRID, u, w);
    for w in [0, -1, i128::MIN, 65_537] {
        let error = make([0, 1, 2], [1, w, 1]).unwrap_err();
        assert_eq!(error, InterpolationError::W { vertex: 1, w });
        assert!(error.to_string().contains("clip the triangle"));
    }
    assert!(matches!(make([0, 65_536, 0], [1; 3]), Err(InterpolationError::U { vertex: 1, .. })));
    let flat = Triangle { xy: [[0, 0], [5, 5], [10, 10]], z: None };
    let made = Interpolator::new(config(Interpolation::Divide, 20), &flat, GRID, [0; 3], [1; 3]);
    assert_eq!(made.unwrap_err(), InterpolationError::Area);
    let wide = Triangle { xy: [[0, 0], [1 << 30, 0], [0, 1 << 30]], z: None };
    let made = Interpolator::new(config(Interpolation::Divide, 20), &wide, GRID, [0; 3], [1; 3]);
    assert!(matches!(made, Err(InterpolationError::Field(_))));
    for by in WAYS {
        let made =
            Interpolator::new(config(by, 24), &triangle, GRID, [0, 65_535, 9], [1, 65_536, 3]);
        let made = made.unwrap();
        let mut none = 0;
        for (x, y) in [(0, 0), (49, 0), (60_000, 3), (9, 60_000), (65_535, 65_535)] {
            none += u32::from(made.at(x, y, [0, x]).is_none());
            let _ = (made.derivatives(x, y), made.quad_differences(x, y));
        }
        assert!(by == Interpolation::Affine || none > 0, "{by:?}: beyond the horizon is no value");
    }
}
