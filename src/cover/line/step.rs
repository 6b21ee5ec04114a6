//! Lines between pixels, one pixel a step of the major axis. Spec clauses `L-1` to `L-3`.

use super::Start;
use crate::bits::{Rounding, bounded};
use crate::cover::rect::Rect;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where a line that passes through a midpoint goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Tie {
    /// Along the major axis.
    East,
    /// Along both.
    NorthEast,
}

/// How the minor coordinate of a step is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    Tie(Tie),
    Start(Start),
    Slope(u32, Rounding),
    Exact(Rounding),
}

/// A line turned into the octant where it runs right and less far up: `n` steps, `m` minor ones.
#[derive(Clone, Copy, Debug)]
struct Octant {
    from: [i128; 2],
    signs: [i128; 2],
    /// Whether y is the major axis.
    steep: bool,
    n: i128,
    m: i128,
}

impl Octant {
    fn new([from, to]: [[i128; 2]; 2]) -> Self {
        let d = [to[0] - from[0], to[1] - from[1]];
        let steep = d[1].abs() > d[0].abs();
        let (n, m) = if steep { (d[1].abs(), d[0].abs()) } else { (d[0].abs(), d[1].abs()) };
        Self { from, signs: d.map(|d| if d < 0 { -1 } else { 1 }), steep, n, m }
    }

    fn pixel(&self, major: i128, minor: i128) -> [i128; 2] {
        let [x, y] = if self.steep { [minor, major] } else { [major, minor] };
        [self.from[0] + self.signs[0] * x, self.from[1] + self.signs[1] * y]
    }

    /// The minor steps taken after `i` major ones, in closed form.
    fn minor(&self, rule: Rule, i: i128) -> i128 {
        let Self { n, m, .. } = *self;
        if n == 0 {
            return 0;
        }
        match rule {
            // Up once the line is at the midpoint, or above it.
            Rule::Tie(Tie::NorthEast) => (2 * m * i + n).div_euclid(2 * n),
            Rule::Tie(Tie::East) => -(n - 2 * m * i).div_euclid(2 * n),
            Rule::Start(Start::Zero) => m * i / n,
            Rule::Start(Start::Half) => (m * i + n / 2) / n,
            Rule::Slope(fraction, rounding) => {
                let slope = rounding.divide(m << fraction, n).map_or(0, |(slope, _)| slope);
                (slope * i + (1 << (fraction - 1))) >> fraction
            }
            Rule::Exact(rounding) => rounding.divide(m * i, n).map_or(0, |(y, _)| y),
        }
    }
}

/// The pixels of a line inside a window, with their number from its start: steps outside the window
/// on the major axis are passed over at once.
pub(super) fn within(
    ends: [[i128; 2]; 2],
    clip: Rect,
    rule: Rule,
    plot: &mut dyn FnMut(u64, i128, i128),
) {
    let line = Octant::new(ends);
    let axis = usize::from(line.steep);
    let (low, high) = if line.steep { (clip.y0, clip.y1) } else { (clip.x0, clip.x1) };
    let (low, last) = (i128::from(low), i128::from(high) - 1);
    let (from, sign) = (line.from[axis], line.signs[axis]);
    let (a, b) = ((low - from) * sign, (last - from) * sign);
    for i in a.min(b).max(0)..=a.max(b).min(line.n) {
        let [x, y] = line.pixel(i, line.minor(rule, i));
        plot(bounded(i), x, y);
    }
}

/// Walks a line step by step: `step` says whether the minor axis moves, too.
pub(super) fn walk(
    ends: [[i128; 2]; 2],
    mut step: impl FnMut(i128, i128) -> bool,
    plot: &mut dyn FnMut([i128; 2]),
) {
    let line = Octant::new(ends);
    let mut minor = 0;
    for i in 0..=line.n {
        plot(line.pixel(i, minor));
        if i < line.n && step(line.n, line.m) {
            minor += 1;
        }
    }
}

/// The exact y = m x at every step, rounded.
pub fn naive(ends: [[i128; 2]; 2], rounding: Rounding, plot: &mut dyn FnMut([i128; 2])) {
    let line = Octant::new(ends);
    (0..=line.n).for_each(|i| plot(line.pixel(i, line.minor(Rule::Exact(rounding), i))));
}

/// An accumulator with `fraction` bits, 1 to 60, that gains a slope rounded once a line, read to the
/// nearest pixel.
pub fn incremental(
    ends: [[i128; 2]; 2],
    fraction: u32,
    rounding: Rounding,
    plot: &mut dyn FnMut([i128; 2]),
) {
    let line = Octant::new(ends);
    let slope = rounding.divide(line.m << fraction, line.n).map_or(0, |(slope, _)| slope);
    let mut accumulator = 1i128 << fraction >> 1;
    for i in 0..=line.n {
        plot(line.pixel(i, accumulator >> fraction));
        accumulator += slope;
    }
}

/// A remainder that gains the minor difference a step and gives the major one back for a minor step.
pub fn integer_incremental(ends: [[i128; 2]; 2], start: Start, plot: &mut dyn FnMut([i128; 2])) {
    let mut rest = match start {
        Start::Zero => 0,
        Start::Half => Octant::new(ends).n / 2,
    };
    let step = |n, m| {
        rest += m;
        let up = rest >= n;
        rest -= if up { n } else { 0 };
        up
    };
    walk(ends, step, plot);
}

/// Bresenham's error: the distance of the line above the pixel, doubled; up when it exceeds a half.
pub fn bresenham(ends: [[i128; 2]; 2], plot: &mut dyn FnMut([i128; 2])) {
    let mut error = 0;
    let step = |n, m| {
        error += 2 * m;
        let up = error > n;
        error -= if up { 2 * n } else { 0 };
        up
    };
    walk(ends, step, plot);
}

/// The midpoint algorithm: d = F(next midpoint), doubled; also calls `decision` with d before each
/// step.
///
/// ```
/// use guardbit::cover::{Tie, midpoint};
/// let mut d = Vec::new();
/// midpoint([[10, 10], [20, 17]], Tie::NorthEast, &mut |value| d.push(value), &mut |_| ());
/// assert_eq!(d, [4, -2, 12, 6, 0, -6, 8, 2, -4, 10]);
/// ```
pub fn midpoint(
    ends: [[i128; 2]; 2],
    tie: Tie,
    decision: &mut dyn FnMut(i128),
    plot: &mut dyn FnMut([i128; 2]),
) {
    let Octant { n, m, .. } = Octant::new(ends);
    let mut d = 2 * m - n;
    let step = |n, m| {
        decision(d);
        let up = d > 0 || (d == 0 && tie == Tie::NorthEast);
        d += 2 * m - if up { 2 * n } else { 0 };
        up
    };
    walk(ends, step, plot);
}
