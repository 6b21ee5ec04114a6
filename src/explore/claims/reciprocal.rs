//! One reciprocal for both slopes, or two that differ.

use super::depth_error::covered_pixel;
use super::statement::{Statement, real};
use crate::case::Words;
use crate::exact::dyadic;
use crate::setup::{Divider, Division, Gradient, Triangle};
use std::sync::OnceLock;

const SEED: u64 = 1;
const CLASS: u64 = 3;
const TRIANGLES: u64 = 100_000;

/// Worst errors in ULP: both slopes from one reciprocal, and with the x slope's one unit larger.
struct Worst {
    shared: f64,
    apart: f64,
}

pub(super) fn statements() -> Vec<Statement> {
    let what = |figure: &str| {
        format!(
            "24-bit depth over 4096 x 4096, s = 10, slopes from a 24-bit reciprocal of the area, \
             products not rounded: {figure}; {TRIANGLES} slivers of two uniform vertices and one \
             1/16 pixel off the line between them, one covered pixel each, mix64 seed {SEED} \
             class {CLASS}"
        )
    };
    let mut list = vec![Statement::exact(
        "reciprocal.witness",
        "triangle of twice-area 2^44 - 2^20, depths 0 and 2^24 - 1, one 24-bit reciprocal: error in \
         ULP at the far vertex, (1 - 2^-24)(1 - 2^-23), which is slightly below 1",
        "140737463189505/140737488355328",
        witness,
    )];
    let drawn = [
        Statement::between(
            "reciprocal.shared",
            what("worst error in ULP with one reciprocal (bound 1)"),
            0.9,
            [0.8, 1.0],
            || worst().shared,
        ),
        Statement::within(
            "reciprocal.apart",
            what(
                "log10 of how much worse when the x slope's differs by one unit in the last \
                 place; at most 2^24 2^22 2^22 / (64 2^22) 2^-23 = 2^17 ULP, five orders",
            ),
            5.1,
            0.3,
            || (worst().apart / worst().shared).log10(),
        ),
    ];
    list.extend(drawn.map(Statement::slow));
    list
}

/// Exact error where the plane has climbed its whole range.
fn witness() -> String {
    let triangle = Triangle { xy: [[0, 0], [1 << 22, 1 << 10], [1 << 10, 1 << 22]], z: None };
    let gradient = Gradient::new(&triangle, [0, (1 << 24) - 1, 0]);
    let [x, y] = triangle.xy[1];
    let climbed = gradient.x * x + gradient.y * y;
    let error = match (Division::Reciprocal { bits: 24 }).by(gradient.area2) {
        Divider::Product { mantissa, exponent } => {
            Some(dyadic(climbed * mantissa, exponent) - dyadic((1 << 24) - 1, 0))
        }
        Divider::Quotient(_) => None,
    };
    error.map_or("none".to_owned(), |error| error.to_string())
}

fn worst() -> &'static Worst {
    static WORST: OnceLock<Worst> = OnceLock::new();
    WORST.get_or_init(measure)
}

/// Two uniform vertices, a third 1/16 pixel above or below a point between them, and the centre of
/// a covered pixel.
fn sliver(words: &mut Words) -> Option<(Triangle, [i128; 2])> {
    let mut point = || [words.between(0, 4096 << 10), words.between(0, 4096 << 10)];
    let [a, b] = [point(), point()];
    let along = words.between(0, 1 << 20);
    let off = if words.below(2) == 0 { -64 } else { 64 };
    let [x, y] = [0, 1].map(|axis| a[axis] + (((b[axis] - a[axis]) * along) >> 20));
    let triangle = Triangle { xy: [a, b, [x, y + off]], z: None }.normalised();
    let pixel = covered_pixel(&triangle, words)?;
    Some((triangle, pixel.map(|n| (n << 10) + 512)))
}

fn measure() -> Worst {
    let mut worst = Worst { shared: 0.0, apart: 0.0 };
    for index in 0..TRIANGLES {
        let mut words = Words::new(SEED, CLASS, index);
        let Some((triangle, sample)) = sliver(&mut words) else {
            continue;
        };
        let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
        let gradient = Gradient::new(&triangle, z);
        let Divider::Product { mantissa, exponent } =
            Division::Reciprocal { bits: 24 }.by(gradient.area2)
        else {
            continue;
        };
        // (gx dx + gy dy) (m / 2^e - 1 / area2), over the common denominator; the other case adds
        // gx dx / 2^e.
        let ([x0, y0], _) = gradient.anchor;
        let [along_x, along_y] = [gradient.x * (sample[0] - x0), gradient.y * (sample[1] - y0)];
        let excess = mantissa * gradient.area2 - (1 << exponent);
        let scale = real(1_i128 << exponent);
        let shared = real(along_x + along_y) * real(excess) / real(gradient.area2) / scale;
        let apart = shared + real(along_x) / scale;
        worst.shared = worst.shared.max(shared.abs());
        worst.apart = worst.apart.max(apart.abs());
    }
    worst
}
