//! The error of a walked depth plane over 4096 x 4096, by rounding and interpolation bits.

use super::edge_word::inside;
use super::plane::{error, exact};
use super::statement::{Statement, real};
use crate::bits::Rounding;
use crate::case::Words;
use crate::setup::{Division, Gradient, Plane, Triangle};
use std::sync::{Arc, OnceLock};

const SEED: u64 = 1;
const CLASS: u64 = 2;
const SAMPLES: u64 = 418_000;

struct Measured {
    worst: f64,
    mean: f64,
    misrounded: f64,
}

/// Rounding, F, and the worst error, mean error and share of wrong depths expected.
const ROWS: [(&str, Rounding, u32, f64, f64, f64); 4] = [
    ("nearest-13", Rounding::NearestEven, 13, 0.468, 0.0, 0.089),
    ("floor-13", Rounding::Floor, 13, 0.908, -0.244, 0.245),
    ("truncate-13", Rounding::TowardZero, 13, 0.926, 0.0, 0.174),
    ("nearest-12", Rounding::NearestEven, 12, 0.932, 0.0, 0.177),
];

pub(super) fn statements() -> Vec<Statement> {
    ROWS.into_iter()
        .flat_map(|(name, rounding, fraction, worst, mean, misrounded)| {
            let what = |figure: &str| {
                format!(
                    "24-bit depth walked over 4096 x 4096, s = 10, {rounding}, F = {fraction}: \
                     {figure}; {SAMPLES} triangles with uniform vertices and depths, one covered \
                     pixel in each, mix64 seed {SEED} class {CLASS}"
                )
            };
            let cell = Arc::new(OnceLock::new());
            let figure = move |pick: fn(&Measured) -> f64| {
                let cell = Arc::clone(&cell);
                move || pick(cell.get_or_init(|| measure(rounding, fraction)))
            };
            // 8191 roundings of at most 2^-F, half of that to nearest.
            let bound = if worst < 0.5 { 0.5 } else { 1.0 };
            [
                Statement::between(
                    format!("depth.worst-{name}"),
                    what(&format!("worst error in ULP (bound {bound})")),
                    worst,
                    [0.86 * bound, bound],
                    figure(|m| m.worst),
                ),
                Statement::within(
                    format!("depth.mean-{name}"),
                    what("mean error in ULP"),
                    mean,
                    0.01,
                    figure(|m| m.mean),
                ),
                Statement::within(
                    format!("depth.misrounded-{name}"),
                    what("share of pixels whose nearest integer differs from that of the exact plane"),
                    misrounded,
                    0.006,
                    figure(|m| m.misrounded),
                ),
            ]
            .map(Statement::slow)
        })
        .collect()
}

/// The pixel of a uniform point of the triangle, the first of 16 whose centre is covered.
pub(super) fn covered_pixel(triangle: &Triangle, words: &mut Words) -> Option<[i128; 2]> {
    let [a, b, c] = triangle.xy;
    (0..16).find_map(|_| {
        // Folding the unit square along its diagonal makes the pair uniform in a triangle.
        let (u, v) = (words.between(0, 1 << 20), words.between(0, 1 << 20));
        let (u, v) = if u + v > 1 << 20 { ((1 << 20) - u, (1 << 20) - v) } else { (u, v) };
        let pixel = [0, 1].map(|axis| {
            let offset = u * (b[axis] - a[axis]) + v * (c[axis] - a[axis]);
            (a[axis] + (offset >> 20)) >> 10
        });
        inside(triangle, pixel.map(|n| (n << 10) + 512)).then_some(pixel)
    })
}

fn measure(rounding: Rounding, fraction: u32) -> Measured {
    let (mut worst, mut sum, mut misrounded, mut count) = (0.0_f64, 0.0, 0, 0);
    for index in 0..SAMPLES {
        let mut words = Words::new(SEED, CLASS, index);
        let mut point = || [words.between(0, 4096 << 10), words.between(0, 4096 << 10)];
        let triangle = Triangle { xy: [point(), point(), point()], z: None }.normalised();
        if triangle.area2() == 0 {
            continue;
        }
        let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
        let Some(pixel) = covered_pixel(&triangle, &mut words) else {
            continue;
        };
        let gradient = Gradient::new(&triangle, z);
        let plane = Plane::round(&gradient, [512, 512], 10, fraction, rounding, Division::Quotient);
        let off =
            real(error(&gradient, &plane, pixel, 10, fraction)) / real(gradient.area2 << fraction);
        worst = worst.max(off.abs());
        sum += off;
        let walked =
            Rounding::NearestUp.shift_right(plane.at(pixel[0], pixel[1]).raw(), fraction).0;
        let right = Rounding::NearestUp.divide(exact(&gradient, pixel, 10), gradient.area2);
        misrounded += u32::from(right.is_none_or(|(right, _)| right != walked));
        count += 1;
    }
    Measured {
        worst,
        mean: sum / f64::from(count),
        misrounded: f64::from(misrounded) / f64::from(count),
    }
}
