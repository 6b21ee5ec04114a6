//! Depth planes: how steep a slope can be, and how many interpolation bits the longest walk takes.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer, ratio};
use crate::format::Budget;
use crate::setup::{Division, Gradient, Plane, Triangle};

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "plane.slope-small",
            "largest |dz/dx| in ULP per pixel over every triangle and depth for (k,s,d) = (1,0,2), \
             (1,1,2), (1,1,3): (2^d - 1) W 4^s",
            "6, 24, 56",
            || [(1, 0, 2), (1, 1, 2), (1, 1, 3)].map(|(k, s, d)| steepest(k, s, d)).join(", "),
        )
        .slow(),
        Statement::exact(
            "plane.slope-sgi",
            "|dz/dx| for k = 12, s = 10, d = 24 on a triangle with the height of the window and \
             twice-area 1, written as 2^56 minus a number",
            format!("{}", 1_i64 << 32),
            || {
                let height = 1 << 22;
                let xy = [[0, 0], [1, height - 1], [1, height]];
                let triangle = Triangle { xy, z: None };
                let gradient = Gradient::new(&triangle, [0, (1 << 24) - 1, 0]);
                (1 << 56) - (gradient.x << 10) / gradient.area2
            },
        ),
        Statement::exact(
            "plane.longest-walk",
            "lecture A's depth walk over 4096 x 4096, 8190 steps and a start, each rounded to \
             nearest: fewest interpolation bits F whose error bound is below half an ULP, the bound \
             for this F, and the bound for F - 1",
            "F = 13: 8191/16384 < 1/2, 8191/8192 not",
            longest_walk,
        ),
        Statement::exact(
            "plane.budget-39",
            "lecture A's depth budget: 2 guard + 24 integer + 13 interpolation bits",
            "39",
            || Budget::DEPTH_39.width(),
        ),
        Statement::exact(
            "plane.fraction",
            "the error of (2W - 1) roundings stays below a bound for every window W = 2 to 2^16: to \
             nearest, below 1/2 with F = k+1; floor, below 1 with F = k+1 and below 1/2 with F = \
             k+2; number of windows where a bound fails, and number of windows where the same \
             bounds hold with one bit fewer",
            "0, 0",
            fraction_bounds,
        ),
        Statement::exact(
            "plane.fraction-toy",
            "the worst error over every triangle, depth and centre for (k,s,d) = (1,1,2) is below: \
             1/2 to nearest with F = 2; 1 with floor, F = 2; 1/2 with floor, F = 3",
            "below, below, below",
            || {
                [
                    (Rounding::NearestEven, 2, dyadic(1, 1)),
                    (Rounding::Floor, 2, integer(1)),
                    (Rounding::Floor, 3, dyadic(1, 1)),
                ]
                .map(|(rounding, fraction, bound)| {
                    if toy_worst(rounding, fraction).is_some_and(|worst| worst < bound) {
                        "below"
                    } else {
                        "\
                            not below"
                    }
                })
                .join(", ")
            },
        )
        .slow(),
    ]
}

/// Every triangle of positive area of the closed window.
pub(super) fn toy_triangles(k: u32, s: u32) -> impl Iterator<Item = Triangle> {
    let side = (1 << (k + s)) + 1;
    let points = move || (0..side * side).map(move |n| [n % side, n / side]);
    points().flat_map(move |a| {
        points().flat_map(move |b| {
            points()
                .map(move |c| Triangle { xy: [a, b, c], z: None })
                .filter(|triangle| triangle.area2() > 0)
        })
    })
}

/// Every triple of depths of `d` bits.
pub(super) fn depths(d: u32) -> impl Iterator<Item = [i128; 3]> {
    let count = 1 << d;
    (0..count * count * count).map(move |n| [n % count, n / count % count, n / count / count])
}

fn steepest(k: u32, s: u32, d: u32) -> String {
    let (mut top, mut bottom) = (0, 1);
    for triangle in toy_triangles(k, s) {
        for z in depths(d) {
            let gradient = Gradient::new(&triangle, z);
            if gradient.x.abs() * bottom > top * gradient.area2 {
                (top, bottom) = (gradient.x.abs(), gradient.area2);
            }
        }
    }
    ratio(top << s, bottom).map_or("none".to_owned(), |slope| slope.to_string())
}

/// `count` roundings of at most `2^-fraction` each, or half of that to nearest.
fn bound(count: i128, fraction: u32, nearest: bool) -> Rational {
    dyadic(count, fraction + u32::from(nearest))
}

fn longest_walk() -> String {
    let (steps, half) = (2 * 4095 + 1, dyadic(1, 1));
    let least = (0..30).find(|f| bound(steps, *f, true) < half);
    least.map_or("none".to_owned(), |f| {
        let [at, before] = [f, f - 1].map(|f| bound(steps, f, true));
        format!("F = {f}: {at} < 1/2, {before} not")
    })
}

fn fraction_bounds() -> String {
    let half = dyadic(1, 1);
    let holds = |k: u32, less: u32| {
        let roundings = 2 * (1 << k) - 1;
        [
            bound(roundings, k + 1 - less, true) < half,
            bound(roundings, k + 1 - less, false) < integer(1),
            bound(roundings, k + 2 - less, false) < half,
        ]
    };
    let fails = (1..=16).filter(|k| !holds(*k, 0).iter().all(|good| *good)).count();
    let spare = (1..=16).filter(|k| holds(*k, 1).iter().any(|good| *good)).count();
    format!("{fails}, {spare}")
}

/// Largest |walked - exact| in ULP over the toy (1,1,2), four centres.
fn toy_worst(rounding: Rounding, fraction: u32) -> Option<Rational> {
    let (mut top, mut bottom) = (0, 1);
    for triangle in toy_triangles(1, 1) {
        for z in depths(2) {
            let gradient = Gradient::new(&triangle, z);
            let plane = Plane::round(&gradient, [1, 1], 1, fraction, rounding, Division::Quotient);
            for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let error = error(&gradient, &plane, [x, y], 1, fraction).abs();
                if error * bottom > top * gradient.area2 {
                    (top, bottom) = (error, gradient.area2);
                }
            }
        }
    }
    Some(ratio(top, bottom)? * dyadic(1, fraction))
}

/// Walked minus exact value at the centre of a pixel, times `area2 2^fraction`.
pub(super) fn error(
    gradient: &Gradient,
    plane: &Plane,
    [x, y]: [i128; 2],
    s: u32,
    fraction: u32,
) -> i128 {
    plane.at(x, y).raw() * gradient.area2 - (exact(gradient, [x, y], s) << fraction)
}

/// The exact value at the centre of a pixel, times `area2`.
pub(super) fn exact(gradient: &Gradient, [x, y]: [i128; 2], s: u32) -> i128 {
    let ([x0, y0], z0) = gradient.anchor;
    let half = 1 << (s - 1);
    let offset = [(x << s) + half - x0, (y << s) + half - y0];
    z0 * gradient.area2 + gradient.x * offset[0] + gradient.y * offset[1]
}
