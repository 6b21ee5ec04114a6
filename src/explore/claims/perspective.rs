//! Attributes in perspective: what is linear in the window, how wrong the cheap ways are, and that the
//! exact ways agree. Spec clauses `I-1` to `I-5`.
//!
//! An edge from w = 1 to w = W has u = t / (W (1 - t) + t) at the part t of its way in the window.

use super::plane::toy_triangles;
use super::statement::Statement;
use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::exact::{Rational, dyadic, integer, perspective_at, ratio, round};
use crate::setup::{Triangle, edges};
use crate::value::{Interpolation, InterpolationConfig, Interpolator};

/// Samples on the vertices' lattice, without sub-pixels.
const GRID: SampleGrid = SampleGrid::at([0, 0], 0);
/// Sides of the toy triangles' window.
const SIDE: i128 = 3;

pub(super) fn statements() -> Vec<Statement> {
    let mut list = ways();
    list.extend(toys());
    list
}

/// Figures of single edges and rows.
fn ways() -> Vec<Statement> {
    vec![
        Statement::exact(
            "perspective.middle",
            "lecture O, linear interpolation is bad: an edge from u = 0, w = 1 to u = 1, w = W reads \
             1/(W + 1) in the middle of the window, not 1/2; for W = 1, 2, 3, 8",
            "1/2, 1/3, 1/4, 1/9",
            || [1, 2, 3, 8].map(|w| shown(edge_value(2, [1, w], 1))).join(", "),
        ),
        Statement::exact(
            "perspective.affine-worst",
            "lecture A, interpolating unprojected values: the largest error on an edge from u = 0, w \
             = 1 to u = 1, w = W is (sqrt W - 1) / (sqrt W + 1), at sqrt W / (sqrt W + 1) of its way; \
             for W = 4, 9, 49, by every 1/24 of the way",
            "1/3 at 2/3, 1/2 at 3/4, 3/4 at 7/8",
            || [4, 9, 49].map(affine_worst).join(", "),
        ),
        Statement::exact(
            "perspective.affine-colour",
            "lecture A, wrong values that are sometimes OK for colour: without correction an 8-bit \
             colour errs by half a code at the w ratio (511/509)^2 = 1.0079; largest error in codes \
             on an edge of 1020 steps",
            "1/2",
            || {
                let error = |t| {
                    let exact = edge_value(1020, [509 * 509, 511 * 511], t)?;
                    Some((ratio(t, 1020)? - exact) * integer(255))
                };
                shown((0..=1020).filter_map(error).max())
            },
        ),
        Statement::exact(
            "perspective.constant-w",
            "lecture O, constant w across a scanline: a row of u = 24 from w = 1 to w = W over 17 \
             pixels with the w of its middle pixel errs at both ends by (W - 1) / (W + 1) of u; largest \
             relative error for W = 1, 2, 3, 7",
            "0, 1/3, 1/2, 3/4",
            || [1, 2, 3, 7].map(|w| shown(runs_worst(16, w, 17, 24))).join(", "),
        ),
        Statement::exact(
            "perspective.constant-w-runs",
            "the same from w = 1 to 8 over 256 pixels, one w for each run of n pixels, n even: the last \
             pixel errs most, by 7n / (512 + 7n); for n = 2, 4, 8, 16",
            "7/263, 7/135, 7/71, 7/39",
            || [2, 4, 8, 16].map(|n| shown(runs_worst(256, 8, n, 512 + 7 * n))).join(", "),
        ),
        Statement::between(
            "perspective.noise-divide",
            "planes of u/w and 1/w with F = 16 and a divide (`I-2`), triangle (0,0) (15,2) (3,13), u = \
             0, 255, 0, w = 1, 64, 1: largest error in units of 2^-F; it grows toward the horizon, and \
             the bound at (15,2) is 2^16 (9 + 255 x 9) / (512 - 9)",
            300_187.0,
            [1.0, 300_187.0],
            || noise(Interpolation::Divide),
        ),
        Statement::between(
            "perspective.noise-barycentric",
            "the same by barycentric coordinates of F bits (`I-4`); the bound is (|u1 - u0| + |u2 - \
             u0|) / 2 = 127.5 at every sample",
            127.5,
            [1.0, 127.5],
            || noise(Interpolation::Barycentric),
        ),
    ]
}

/// Exhaustive on every triangle of a 3 x 3 lattice, w = 1 or 3 at each vertex.
fn toys() -> Vec<Statement> {
    let toy = "every triangle of a 3 x 3 lattice, w = 1 or 3 at each vertex";
    vec![
        Statement::exact(
            "perspective.ray",
            format!(
                "lecture O's blackboard: P/w over 1/w against the ray from the eye through the pixel, \
                 cut with the plane of the triangle in space; {toy}, u = 0, 1, 5: lattice points where \
                 the two disagree"
            ),
            "0",
            ray_disagreements,
        )
        .slow(),
        Statement::exact(
            "perspective.linear",
            format!(
                "lectures A and M, what is linear in the window: {toy}, w by the ray; rows and columns \
                 of three points where these bend: 1/w, u/w, Z/w (n = 1, f = 4); and those where w \
                 changes but does not bend"
            ),
            "0, 0, 0, 0",
            bends,
        )
        .slow(),
        Statement::exact(
            "perspective.products",
            format!(
                "lecture O's barycentric form, b0 = w1 w2 a0 / (w1 w2 a0 + w2 w0 a1 + w0 w1 a2), from \
                 integer edge functions against the quotient of u/w and 1/w, three vertices; {toy}: \
                 lattice points where the two disagree, in lowest terms and rounded to 12 bits"
            ),
            "0, 0",
            product_disagreements,
        )
        .slow(),
        Statement::exact(
            "perspective.constant-rows",
            format!(
                "lecture O, constant w across a scanline: {toy} with 1/w constant along rows, u = 0, \
                 1, 5, F = 12: lattice points where one divide a row reads otherwise than a divide a \
                 pixel"
            ),
            "0",
            constant_row_disagreements,
        ),
    ]
}

fn shown(value: Option<Rational>) -> String {
    value.map_or("none".to_owned(), |value| value.to_string())
}

/// u at step `t` of an edge of `n` steps, from 0 to 1.
fn edge_value(n: i128, [w0, w1]: [i128; 2], t: i128) -> Option<Rational> {
    perspective_at([[0, 0], [n, 0], [0, n]], [0, 1, 0], [w0, w1, w0], [t, 0])
}

fn interpolator(
    by: Interpolation,
    fraction: u32,
    triangle: &Triangle,
    u: [i128; 3],
    w: [i128; 3],
) -> Option<Interpolator> {
    let config = InterpolationConfig { by, fraction, rounding: Rounding::NearestEven };
    Interpolator::new(config, triangle, GRID, u, w).ok()
}

/// The largest error of an affine edge, and where.
fn affine_worst(w: i128) -> String {
    let n = 24;
    let triangle = Triangle { xy: [[0, 0], [n, 0], [0, n]], z: None };
    let worst = || {
        let affine = interpolator(Interpolation::Affine, 4, &triangle, [0, n, 0], [1, w, 1])?;
        let error = |t: u32| {
            let got = dyadic(affine.at(t, 0, [0, 24])?, 4) / integer(n);
            Some((got - edge_value(n, [1, w], t.into())?, ratio(t.into(), n)?))
        };
        (0..=24).filter_map(error).max()
    };
    worst().map_or("none".to_owned(), |(error, place)| format!("{error} at {place}"))
}

/// The largest relative error on a row of `steps` from w = 1 to `w`, cut from its far end into runs of
/// `n` pixels with one w each.
fn runs_worst(steps: i128, w: i128, n: i128, u: i128) -> Option<Rational> {
    let triangle = Triangle { xy: [[0, 0], [steps, 0], [0, steps]], z: None };
    let row = interpolator(Interpolation::ConstantW, 24, &triangle, [u; 3], [1, w, 1])?;
    let [steps, n] = [steps, n].map(|value| u32::try_from(value).unwrap_or(0));
    let error = |x: u32| {
        let last = steps - (steps - x) / n * n;
        let span = [(last + 1).saturating_sub(n), last];
        let got = dyadic(row.at(x, 0, span)?, 24) / integer(u) - integer(1);
        Some(if got < integer(0) { -got } else { got })
    };
    ((steps + 1) % n..=steps).filter_map(error).max()
}

fn noise(by: Interpolation) -> f64 {
    use num_traits::ToPrimitive;
    let (xy, u, w) = ([[0, 0], [15, 2], [3, 13]], [0, 255, 0], [1, 64, 1]);
    let triangle = Triangle { xy, z: None };
    let Some(made) = interpolator(by, 16, &triangle, u, w) else { return f64::NAN };
    let error = |(x, y): (u32, u32)| {
        let at = [i128::from(x), i128::from(y)];
        let inside = edges(&triangle).iter().all(|edge| edge.at(at[0], at[1]) >= 0);
        let exact = perspective_at(xy, u, w, at).filter(|_| inside)? * integer(1 << 16);
        let error = integer(made.at(x, y, [x, x])?) - exact;
        Some((error.numer().to_f64()? / error.denom().to_f64()?).abs())
    };
    let points = (0..16).flat_map(|y| (0..16).map(move |x| (x, y)));
    points.filter_map(error).fold(0.0, f64::max)
}

/// Every toy triangle with every w.
fn cases() -> impl Iterator<Item = (Triangle, [i128; 3])> {
    toy_triangles(1, 0).flat_map(|triangle| {
        (0..8).map(move |n| (triangle, [0, 1, 2].map(|k| 1 + 2 * (n >> k & 1))))
    })
}

fn points() -> impl Iterator<Item = [i128; 2]> {
    (0..SIDE * SIDE).map(|n| [n % SIDE, n / SIDE])
}

type Vector = [i128; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        a[next] * b[last] - a[last] * b[next]
    })
}

fn dot(a: Vector, b: Vector) -> i128 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

/// The distance w and the attribute where the ray through a point of the window, w (x, y, 1), meets the
/// plane of the triangle in space; `None` where the two are parallel.
fn ray(triangle: &Triangle, u: Vector, w: Vector, [x, y]: [i128; 2]) -> Option<[Rational; 2]> {
    let space: [Vector; 3] = std::array::from_fn(|k| {
        let [x, y] = triangle.xy[k];
        [w[k] * x, w[k] * y, w[k]]
    });
    let [along, down] = [1, 2].map(|k| minus(space[k], space[0]));
    let normal = cross(along, down);
    // The point is (above / below) (x, y, 1).
    let (above, below) = (dot(normal, space[0]), dot(normal, [x, y, 1]));
    let distance = ratio(above, below)?;
    // Areas in space, times `below`: the point less vertex 0 against the two sides.
    let point = minus([x, y, 1].map(|c| c * above), space[0].map(|c| c * below));
    let shares = [dot(cross(point, down), normal), dot(cross(along, point), normal)];
    let weighed = shares[0] * (u[1] - u[0]) + shares[1] * (u[2] - u[0]);
    Some([distance, integer(u[0]) + ratio(weighed, below * dot(normal, normal))?])
}

fn ray_disagreements() -> usize {
    let u = [0, 1, 5];
    let differs = |triangle: &Triangle, w: [i128; 3], at| {
        let value = ray(triangle, u, w, at).map(|[_, value]| value);
        value != perspective_at(triangle.xy, u, w, at)
    };
    cases().map(|(triangle, w)| points().filter(|at| differs(&triangle, w, *at)).count()).sum()
}

/// Whether three values lie on no straight line.
fn bend(values: &[Rational; 3]) -> bool {
    &values[0] + &values[2] != &values[1] * integer(2)
}

fn bends() -> String {
    let mut counts = [0; 4];
    for (triangle, w) in cases() {
        for n in 0..2 * SIDE {
            let line = [0, 1, 2].map(|m| if n < SIDE { [m, n] } else { [n - SIDE, m] });
            let met = line.map(|at| ray(&triangle, [0, 1, 5], w, at));
            let [Some([w0, u0]), Some([w1, u1]), Some([w2, u2])] = met else { continue };
            let (w, u) = ([w0, w1, w2], [u0, u1, u2]);
            // Z/w = f (w - n) / (w (f - n)) for n = 1, f = 4.
            let depth = |w: &Rational| (w - integer(1)) * integer(4) / (w * integer(3));
            counts[0] += usize::from(bend(&w.each_ref().map(Rational::recip)));
            counts[1] += usize::from(bend(&[&u[0] / &w[0], &u[1] / &w[1], &u[2] / &w[2]]));
            counts[2] += usize::from(bend(&w.each_ref().map(depth)));
            counts[3] += usize::from(w[0] != w[1] && !bend(&w));
        }
    }
    counts.map(|count| count.to_string()).join(", ")
}

fn product_disagreements() -> String {
    let mut counts = [0; 2];
    for (triangle, w) in cases() {
        let edges = edges(&triangle);
        for at in points() {
            // Opposite v0 lies the edge from v1 to v2.
            let part =
                |k: usize| edges[(k + 1) % 3].at(at[0], at[1]) * w[(k + 1) % 3] * w[(k + 2) % 3];
            let parts = [part(0), part(1), part(2)];
            let whole: i128 = parts.iter().sum();
            for k in 0..3 {
                let mut u = [0; 3];
                u[k] = 1;
                let quotient = perspective_at(triangle.xy, u, w, at);
                counts[0] += usize::from(ratio(parts[k], whole) != quotient);
                let rounded =
                    quotient.map(|share| round(&(share * integer(1 << 12)), Rounding::NearestEven));
                let code = Rounding::NearestEven.divide(parts[k] << 12, whole.max(0));
                let code = code.map(|(value, _)| value.into());
                counts[1] += usize::from(whole > 0 && code != rounded);
            }
        }
    }
    counts.map(|count| count.to_string()).join(", ")
}

fn constant_row_disagreements() -> usize {
    let mut count = 0;
    for (triangle, w) in cases() {
        // 1/w changes by this along a row, times w0 w1 w2 and the area.
        let q = [w[1] * w[2], w[2] * w[0], w[0] * w[1]];
        if crate::setup::Gradient::new(&triangle, q).x != 0 {
            continue;
        }
        let made = |by| interpolator(by, 12, &triangle, [0, 1, 5], w);
        let [row, pixel] = [Interpolation::ConstantW, Interpolation::Divide].map(made);
        let (Some(row), Some(pixel)) = (row, pixel) else { return usize::MAX };
        for (x, y) in (0..3).flat_map(|y| (0..3).map(move |x| (x, y))) {
            count += usize::from(row.at(x, y, [0, 2]) != pixel.at(x, y, [x, x]));
        }
    }
    count
}
