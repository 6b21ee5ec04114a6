//! How many bits 1/w needs, and what a reciprocal unit for it gives. Spec clauses `CH-4`, `CH-5` and
//! `CH-9` to `CH-12`.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::exact::{integer, ratio, round};
use crate::format::Clamp;
use crate::setup::{Division, Endless, Gradient, Plane, Source, Triangle, VertexConfig, edges};
use crate::value::{
    AttributeConfig, Correction, Corrector, EvaluatedAt, InverseWConfig, ReciprocalConfig, Refine,
    StartBias,
};

pub(super) fn statements() -> Vec<Statement> {
    let mut list = units();
    list.extend(bits());
    list
}

fn units() -> Vec<Statement> {
    vec![
        Statement::exact(
            "inverse-w.table",
            "lecture A, recover w by a reciprocal: a table of 2^k entries, each the reciprocal of the \
             middle of its interval, errs by 1 / (2^(k+1) + 1) at most; one over the largest relative \
             error of every 17-bit operand, 31-bit entries, for k = 3, 4, 6, 8",
            "17, 33, 129, 513",
            || [3, 4, 6, 8].map(|k| accuracy(k, Refine::None)).join(", "),
        ),
        Statement::exact(
            "inverse-w.newton",
            "the same after one Newton step to 40 bits: the square, (2^(k+1) + 1)^2",
            "289, 1089, 16641, 263169",
            || [3, 4, 6, 8].map(|k| accuracy(k, Refine::Newton { bits: vec![40] })).join(", "),
        ),
        Statement::exact(
            "inverse-w.newton-twice",
            "the same after two Newton steps to 40 bits: the fourth power, for k = 2, 3",
            "6561, 83521",
            || [2, 3].map(|k| accuracy(k, Refine::Newton { bits: vec![40, 40] })).join(", "),
        ),
        Statement::exact(
            "inverse-w.linear",
            "the same with straight lines between 2^k + 1 entries, k = 3, 4, 6: 4 2^k (2^k + 1), one less than a \
             Newton step from 2^k entries gives",
            "288, 1088, 16640",
            || [3, 4, 6].map(|k| accuracy(k, Refine::Linear)).join(", "),
        ),
    ]
}

/// One over the largest relative error, to the nearest integer.
fn accuracy(index: u32, refine: Refine) -> String {
    let config = ReciprocalConfig { operand: 17, index, entry: 31, refine, table: None };
    let inverse = config.unit().ok().and_then(|unit| {
        let worst = unit.worst();
        ratio(1 << worst.scale, worst.error.abs())
    });
    inverse.map_or("none".to_owned(), |inverse| round(&inverse, Rounding::NearestEven).to_string())
}

fn bits() -> Vec<Statement> {
    vec![
        Statement::exact(
            "inverse-w.vertex-bits",
            "fewest bits B of a code of 1/w (`CH-4`) with u (1 - u) W 2^i / (2 (2^B - 1)) < 1/2, W = 8, u (1 - u) \
             <= 1/4, and how many values of an edge its rounding then moves by half a code; for colours of 8 bits \
             and texture coordinates of 10, every w ratio from 1 to 8 by 1/16, every 1/64 of the edge",
            "8: 10 bits, 0; 10: 12 bits, 0",
            || [8, 10].map(vertex_bits).join("; "),
        ),
        Statement::exact(
            "inverse-w.fraction-bits",
            "fewest bits below the point of the word of 1/w (`CH-5`) with which the bound of `CH-14` is below 1, \
             and how many codes are then off by 1 or more: triangle (0,0) (15,2) (3,13), 1/w = 1/2 or 1/16 \
             and the least or the largest code at each vertex, 24 bits below the point of u/w; codes of 8 and \
             of 10 bits",
            "8: 17 bits, 0; 10: 19 bits, 0",
            || [8, 10].map(fraction_bits).join("; "),
        ),
        Statement::exact(
            "inverse-w.walk",
            "u/w walked n steps by a slope rounded to nearest: largest error in units of the last place \
             over every slope a/1025, n 512/1025, just below n/2; at w = 8 the quotient makes 8 times \
             that of it; for n = 16, 256, 4096",
            "8192/1025, 131072/1025, 2097152/1025",
            || [16, 256, 4096].map(walked).join(", "),
        ),
    ]
}

/// The largest error of a word of 4 fraction bits after `n` steps, in its last place.
fn walked(n: i128) -> String {
    let whole = 1025;
    let error = |slope: i128| {
        let parts = [0, slope, 0];
        let plane =
            Plane::over(parts, whole, 0, 4, Rounding::NearestEven, Division::Quotient).at(n, 0);
        let error = integer(plane.raw()) - ratio((slope * n) << 4, whole)?;
        Some(if error < integer(0) { -error } else { error })
    };
    (0..whole).filter_map(error).max().map_or("none".to_owned(), |error| error.to_string())
}

fn vertex_bits(integer_bits: u32) -> String {
    let top = (1 << integer_bits) - 1;
    let certain = |bits: &u32| 8 << integer_bits < 4 * ((1i128 << bits) - 1);
    let Some(bits) = (1..20).find(certain) else { return "none".to_owned() };
    let near = (1i128 << bits) - 1;
    let moved = |w: i128| {
        let far = Rounding::NearestEven.divide(near * 16, w).map_or(0, |(code, _)| code);
        let moves = |t: &i128| {
            // t / w over (64 - t) / 16 + t / w, against the same with codes.
            let (exact, whole) = (16 * t, (64 - t) * w + 16 * t);
            let (got, codes) = (far * t, near * (64 - t) + far * t);
            2 * top * (exact * codes - got * whole).abs() >= whole * codes
        };
        (0..=64).filter(moves).count()
    };
    let moved: usize = (16..=128).map(moved).sum();
    format!("{integer_bits}: {bits} bits, {moved}")
}

const B: u32 = 4;
const F: u32 = 24;

fn corrector(integer: u32, fraction: u32) -> Option<Corrector> {
    let rounding = Rounding::NearestEven;
    let vertex = VertexConfig {
        integer: 4,
        sub_pixel: 0,
        signed: false,
        closed: true,
        snap: rounding,
        source: Source::F64,
        endless: Endless::Refuse,
        lattice: None,
    };
    let w = InverseWConfig {
        guard: 2,
        integer: B,
        interpolation: fraction,
        rounding,
        clamp: Clamp::Guard,
    };
    let channel = AttributeConfig {
        name: "u".to_owned(),
        components: vec!["u".to_owned()],
        guard: 2,
        integer,
        interpolation: F,
        signed: false,
        rounding,
        division: Division::Quotient,
        clamp: Clamp::Guard,
        start_bias: StartBias::None,
        at: EvaluatedAt::Sample,
        correction: Correction::Quotient { rounding },
        unit: None,
        detail: None,
        source: None,
    };
    Corrector::new(&channel, Some(&w), &vertex).ok()
}

/// A plane of words for values at the vertices, over `2^down`.
fn plane(triangle: &Triangle, values: [i128; 3], down: u32, fraction: u32) -> Plane {
    let gradient = Gradient::new(triangle, values);
    let numerators = [gradient.numerator([0, 0]), gradient.x, gradient.y];
    let whole = gradient.area2 << down;
    Plane::over(numerators, whole, 0, fraction, Rounding::NearestEven, Division::Quotient)
}

fn fraction_bits(integer: u32) -> String {
    let triangle = Triangle { xy: [[0, 0], [15, 2], [3, 13]], z: None };
    let edges = edges(&triangle);
    let points: Vec<[i128; 2]> = (0..256)
        .map(|n| [n % 16, n / 16])
        .filter(|at| edges.iter().all(|edge| edge.at(at[0], at[1]) >= 0))
        .collect();
    let choose = |n: usize, [low, high]: [i128; 2]| {
        [0, 1, 2].map(|k| if n >> k & 1 == 0 { low } else { high })
    };
    // The farthest sample is (15, 2): 18 roundings of half a unit in each plane; 1/w >= 1/16.
    let bound = |n: &u32| {
        let e = 9i128 << (F - n);
        2 * (9 + ((1 << integer) - 1) * e) < (1 << (F - 4)) - e
    };
    let Some(bits) = (B..F).find(bound) else { return "none".to_owned() };
    let Some(corrector) = corrector(integer, bits - B) else { return "none".to_owned() };
    let off = |n: usize| {
        let (q, u) = (choose(n, [1, 8]), choose(n >> 3, [0, (1 << integer) - 1]));
        let weighed = [0, 1, 2].map(|k| u[k] * q[k]);
        let over = plane(&triangle, weighed, B, F);
        let inverse = plane(&triangle, q, 0, bits - B);
        let exact = [weighed, q].map(|values| Gradient::new(&triangle, values));
        let is_off = |[x, y]: &&[i128; 2]| {
            let code = corrector.divided(over.at(*x, *y).raw(), inverse.at(*x, *y).raw());
            let [above, below] = exact.map(|gradient| gradient.numerator([*x, *y]));
            (i128::from(code) * below - above).abs() >= below
        };
        points.iter().filter(is_off).count()
    };
    let off: usize = (0..64).map(off).sum();
    format!("{integer}: {bits} bits, {off}")
}
