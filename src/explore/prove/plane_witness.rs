//! A triangle whose roundings all lean one way, so that its far corner is off by too much.
//!
//! Two legs at the window's far corner set the two slopes apart from one another: a leg of odd
//! length l and a depth change q give a slope of q 2^(s+F) / l units, whose residue is any r / l
//! wanted, by the choice of q mod l. Where the depth range is too small for that, seeded draws.

use super::Witness;
use super::domain::Question;
use super::plane::Goal;
use super::text::{decimal, mixed};
use super::trial::{depth_error, scaled, shoot};
use crate::case::Words;
use crate::exact::{self, Rational, integer};
use crate::profile::Profile;
use crate::setup::{Division, Gradient, Plane, Triangle, edges};
use crate::value::{DepthConfig, StartBias};
use num_traits::Signed;

const SEED: u64 = 10;

/// Where a candidate is measured.
struct Search<'a> {
    question: &'a Question,
    depth: DepthConfig,
    fraction: u32,
    goal: Goal,
    /// The farthest pixel whose sample lies within reach of a vertex.
    pixel: [i128; 2],
    /// The vertex beyond it.
    corner: [i128; 2],
}

type Found = (Witness, Vec<(&'static str, Rational)>);

/// A witness with `fraction` interpolation bits, and its roundings in units of the last one.
pub(super) fn find(question: &Question, fraction: u32, goal: Goal) -> Option<Found> {
    let depth = question.profile.depth?;
    if depth.division != Division::Quotient {
        return None;
    }
    let (size, high) = (question.size(), question.vertices[1]);
    let s = question.sub_pixel();
    let origin = question.origin;
    let pixel: [i128; 2] = std::array::from_fn(|axis| {
        let offset = question.sample([0, 0])[axis];
        (origin[axis] + size[axis] - 1).min((high[axis] - offset) >> s)
    });
    let corner = std::array::from_fn(|axis| high[axis].min((pixel[axis] + 1) << s));
    let search = Search { question, depth, fraction, goal, pixel, corner };
    search.leaning().or_else(|| search.drawn_legs()).or_else(|| search.drawn_triangles())
}

/// Depth changes along a leg of odd length `leg` whose slope has a residue near the worst.
fn leaning(leg: i128, shift: u32, nearest: bool) -> Vec<i128> {
    // Powers of one half modulo the odd length undo the scaling by 2^shift.
    let half = i128::midpoint(leg, 1);
    let undo = (0..shift).fold(1 % leg, |power, _| power * half % leg);
    let residues = if nearest { [(leg - 1) / 2, i128::midpoint(leg, 1)] } else { [leg - 1, 1] };
    residues.into_iter().map(|r| r * undo % leg).flat_map(|q| [q, q - leg]).collect()
}

impl Search<'_> {
    fn most(&self) -> i128 {
        (1 << self.depth.integer) - 1
    }

    fn spans(&self) -> [i128; 2] {
        std::array::from_fn(|axis| self.corner[axis] - self.question.vertices[0][axis])
    }

    /// A right triangle at the far corner; `rise` is the change of depth toward it along each leg.
    fn right(
        &self,
        legs: [i128; 2],
        rise: [i128; 2],
        lowest: bool,
    ) -> Option<(Triangle, [i128; 2])> {
        let most = self.most();
        let (low, high) =
            (0.max(rise[0]).max(rise[1]), most.min(most + rise[0]).min(most + rise[1]));
        if low > high {
            return None;
        }
        let (z, [x, y]) = (if lowest { low } else { high }, self.corner);
        let xy = [[x, y], [x, y - legs[1]], [x - legs[0], y]];
        Some((Triangle { xy, z: Some([z, z - rise[1], z - rise[0]]) }, self.pixel))
    }

    fn leaning(&self) -> Option<Found> {
        let s = self.question.sub_pixel();
        let nearest = self.depth.rounding.is_nearest();
        // The longest odd lengths along which the depth range allows any residue.
        let legs = self.spans().map(|span| {
            let longest = (span.min(self.most()) - 1) | 1;
            (0..4)
                .map(move |n| longest - 2 * n)
                .filter(|leg| *leg > 0)
                .map(move |leg| (leg, leaning(leg, s + self.fraction, nearest)))
        });
        let [along_x, along_y] = legs;
        let along_y: Vec<_> = along_y.collect();
        along_x.into_iter().find_map(|(x, rises_x)| {
            along_y.iter().find_map(|(y, rises_y)| {
                let pairs = rises_x.iter().flat_map(|p| rises_y.iter().map(move |q| [*p, *q]));
                pairs.into_iter().find_map(|rise| {
                    let try_at = |lowest| self.judge(self.right([x, *y], rise, lowest)?);
                    [true, false].into_iter().find_map(try_at)
                })
            })
        })
    }

    fn drawn_legs(&self) -> Option<Found> {
        let spans = self.spans().map(|span| i64::try_from(span).unwrap_or(i64::MAX));
        let most = i64::try_from(self.most()).unwrap_or(i64::MAX);
        (0..4096).find_map(|index| {
            let mut words = Words::new(SEED, 1, index);
            let legs = spans.map(|span| words.between(1, span));
            let rise = [0, 1].map(|_| words.between(-most, most));
            self.judge(self.right(legs, rise, index % 2 == 0)?)
        })
    }

    fn drawn_triangles(&self) -> Option<Found> {
        let [low, high] = self.question.vertices;
        let most = i64::try_from(self.most()).unwrap_or(i64::MAX);
        let size = self.question.size();
        (0..20_000).find_map(|index| {
            let mut words = Words::new(SEED, 2, index);
            let mut within = |low: i128, high: i128| {
                let count = i64::try_from(high - low).unwrap_or(i64::MAX);
                low + words.between(0, count)
            };
            let mut point = || [within(low[0], high[0]), within(low[1], high[1])];
            let xy = [point(), point(), point()];
            let at = [0, 1].map(|axis| self.question.origin[axis] + within(0, size[axis] - 1));
            let z = [0, 1, 2].map(|_| words.between(0, most));
            self.judge((Triangle { xy, z: Some(z) }, at))
        })
    }

    /// Measures a candidate in plain integers first, then by the model against the exact plane.
    fn judge(&self, (triangle, pixel): (Triangle, [i128; 2])) -> Option<Found> {
        let triangle = triangle.normalised();
        if triangle.area2() <= 0
            || !self.inside(&triangle, pixel)
            || !self.looks_bad(&triangle, pixel)
        {
            return None;
        }
        let with = |fraction| Profile {
            depth: Some(DepthConfig { interpolation: fraction, ..self.depth }),
            ..self.question.profile.clone()
        };
        let shot_of = |fraction| shoot(self.question, &with(fraction), &triangle, pixel);
        let error_of = |fraction| {
            let shot = shot_of(fraction).filter(|shot| shot.covered)?;
            depth_error(self.question, &shot, &triangle, pixel, fraction)
        };
        let (few, enough) = (error_of(self.fraction)?, error_of(self.fraction + 1)?);
        if few.abs() < self.goal.ulp() || enough.abs() >= self.goal.ulp() {
            return None;
        }
        let sample = self.question.sample(pixel);
        let truth = exact::plane_at(triangle.xy, triangle.z?, sample)?;
        let shot = shot_of(self.fraction)?;
        let witness = Witness {
            pixel: Some(pixel),
            sample: Some(sample),
            ..Witness::drawn(
                self.fraction,
                &triangle,
                format!("depth {} = {} ULP", mixed(&truth), decimal(&truth)),
                format!(
                    "{} ULP, an error of {} ULP; with {} bits the error is {} ULP",
                    decimal(&(&truth + &few)),
                    decimal(&few),
                    self.fraction + 1,
                    decimal(&enough)
                ),
            )
        };
        Some((witness, self.residues(&shot.setup, &triangle, pixel)?))
    }

    fn inside(&self, triangle: &Triangle, pixel: [i128; 2]) -> bool {
        let [x, y] = self.question.sample(pixel);
        let rule = self.question.rule();
        edges(triangle).iter().all(|edge| {
            let e = edge.at(x, y);
            e > 0 || (e == 0 && rule.owns(edge.direction()))
        })
    }

    /// Whether the accumulated error reaches the goal, by set-up's own arithmetic.
    fn looks_bad(&self, triangle: &Triangle, pixel: [i128; 2]) -> bool {
        let Some(z) = triangle.z else { return false };
        let xy = triangle.xy.map(|vertex| self.question.to_model(vertex));
        let gradient = Gradient::new(&Triangle { xy, z: Some(z) }, z);
        let (s, grid) = (self.question.sub_pixel(), self.question.sample([0, 0]));
        let DepthConfig { rounding, division, .. } = self.depth;
        let plane = Plane::round(&gradient, grid, s, self.fraction, rounding, division);
        let [x, y] = [0, 1].map(|axis| pixel[axis] - self.question.origin[axis]);
        let at = self.question.to_model(self.question.sample(pixel));
        let ([x0, y0], z0) = gradient.anchor;
        let exact = z0 * gradient.area2 + gradient.x * (at[0] - x0) + gradient.y * (at[1] - y0);
        let error = plane.at(x, y).raw() * gradient.area2 - (exact << self.fraction);
        let whole = gradient.area2 << self.fraction;
        if self.goal == Goal::Half { 2 * error.abs() >= whole } else { error.abs() >= whole }
    }

    /// The three roundings as set-up made them, in units of the last fraction bit, and the walk.
    fn residues(
        &self,
        setup: &[i128],
        triangle: &Triangle,
        pixel: [i128; 2],
    ) -> Option<Vec<(&'static str, Rational)>> {
        let [.., start, dx, dy] = *setup else { return None };
        let z = triangle.z?;
        let bias = start_bias(&self.depth, self.fraction);
        let exact_start =
            exact::plane_at(triangle.xy, z, self.question.sample(self.question.origin))?;
        let slopes = exact::plane_slopes(triangle.xy, z)?;
        let (unit, s) = (scaled(1, self.fraction), self.question.sub_pixel());
        let [x, y] = [0, 1].map(|axis| integer(pixel[axis] - self.question.origin[axis]));
        let per_pixel = scaled(1, s) * &unit;
        Some(vec![
            ("e0", integer(start - bias) - exact_start * &unit),
            ("ex", integer(dx) - &slopes[0] * &per_pixel),
            ("ey", integer(dy) - &slopes[1] * &per_pixel),
            ("x", x),
            ("y", y),
        ])
    }
}

/// The start bias of a depth plane with `fraction` fraction bits, in its units.
pub(super) fn start_bias(depth: &DepthConfig, fraction: u32) -> i128 {
    match (depth.start_bias, fraction) {
        (StartBias::Half, 1..) => 1 << (fraction - 1),
        _ => 0,
    }
}
