//! The error of walked planes, run by run in closed form. Spec clause `M-3`.
//!
//! A plane rounded at its start and slopes differs from the exact one by a plane. So along a run
//! the error changes in equal steps and its two ends tell everything, unless a value leaves the
//! range and is wrapped, clamped or held: such runs are read sample by sample. The naive twin is
//! [`crate::measure::error::triangle_error`].

use super::reference::real;
use super::stage::{Face, Stage, Surface};
use super::tally::ValueTally;
use super::world::World;
use crate::bits::Event;
use crate::format::{Clamp, ReadOut};
use crate::model::Span;
use crate::setup::Plane;
use crate::value::Depth;

/// What the values of a face, or of many, came to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Values {
    /// Depth.
    pub depth: ValueTally,
    /// The attribute.
    pub attribute: ValueTally,
    /// Samples whose depth left the range that guard bits tell apart.
    pub wraps: u64,
    /// Samples whose depth was held at an end of its range.
    pub clamps: u64,
    /// Smallest and largest depth accumulator at any sample, unwrapped.
    pub depth_extent: Reach,
    /// The same of the attribute.
    pub attribute_extent: Reach,
}

/// Smallest and largest accumulator seen, unwrapped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reach(pub Option<(i128, i128)>);

impl Reach {
    /// Takes in further values.
    #[inline]
    pub fn widen(&mut self, other: Self) {
        if let Some((low, high)) = other.0 {
            let (lowest, highest) = self.0.unwrap_or((low, high));
            self.0 = Some((lowest.min(low), highest.max(high)));
        }
    }

    /// Whether all of it lies in a half-open range.
    pub fn within(&self, (lowest, limit): (i128, i128)) -> bool {
        self.0.is_none_or(|(low, high)| lowest <= low && high < limit)
    }
}

/// One value of one face as it is walked, beside what it should be.
pub(super) struct Walk<'a> {
    depth: &'a Depth,
    plane: Plane,
    /// What its start gained, which is no error.
    gain: i128,
    surface: &'a Surface,
    /// The error at the surface's base pixel and its changes, over `whole`.
    error: [i128; 3],
    narrow: Option<Narrow>,
    whole: f64,
}

/// Error and accumulator at the base pixel and their changes, where every sum over a window fits
/// 64 bits: nearly always.
struct Narrow {
    error: [i64; 3],
    value: [i64; 3],
    /// The accumulators that are read as they are, half-open.
    low: i64,
    high: i64,
}

impl Narrow {
    fn new(error: [i128; 3], value: [i128; 3], read: ReadOut) -> Option<Self> {
        // A window has 2^16 pixels on a side: the sum of three stays below 2^62.
        let fits = |[start, dx, dy]: [i128; 3]| {
            let fit =
                |value: i128| i64::try_from(value).ok().filter(|v| v.unsigned_abs() < 1 << 45);
            Some([fit(start)?, fit(dx)?, fit(dy)?])
        };
        let (low, high) = inside(read);
        let ends = [low, high].map(|end| i64::try_from(end).ok());
        let [Some(low), Some(high)] = ends else { return None };
        Some(Self { error: fits(error)?, value: fits(value)?, low, high })
    }
}

/// The half-open range of accumulators that are read without a wrap, a clamp or a hold; empty
/// under a sticky clamp.
fn inside(read: ReadOut) -> (i128, i128) {
    let (lowest, limit) = read.range();
    if read.clamp() == Clamp::Saturate { (0, 0) } else { (lowest.max(0), limit.min(read.top())) }
}

/// The first column of a run at which a condition that stays true is true, or its end.
fn first_column(run: &Span, holds: impl Fn(u32) -> bool) -> u32 {
    let (mut from, mut to) = (run.x0, run.x1);
    while from < to {
        let middle = from + (to - from) / 2;
        if holds(middle) { to = middle } else { from = middle + 1 }
    }
    from
}

#[inline]
fn at([start, dx, dy]: &[i64; 3], [right, down]: [i64; 2]) -> i64 {
    start + dx * right + dy * down
}

impl Values {
    /// Adds what another has.
    pub fn merge(&mut self, other: &Self) {
        self.depth.merge(&other.depth);
        self.attribute.merge(&other.attribute);
        self.wraps += other.wraps;
        self.clamps += other.clamps;
        self.depth_extent.widen(other.depth_extent);
        self.attribute_extent.widen(other.attribute_extent);
    }

    /// Whether any value was wrapped.
    pub fn wrapped(&self) -> bool {
        self.wraps > 0
    }
}

/// Measures the values of a face over runs of samples.
pub fn face_values(stage: &Stage, depth: &Depth, face: &Face, runs: &[Span], values: &mut Values) {
    if let Some(attribute) = &face.attribute {
        let depth = depth.unbiased();
        let (walk, world) = (Walk::new(stage, &depth, face, attribute), stage.world.flat());
        for run in runs {
            let plain = walk.reach(run, &mut values.attribute_extent);
            walk.errors(stage, &world, run, plain, &mut values.attribute);
        }
        values.attribute.settle(&world);
    }
    let Some(surface) = &face.depth else { return };
    let walk = Walk::new(stage, depth, face, surface);
    for run in runs {
        let plain = walk.reach(run, &mut values.depth_extent);
        walk.errors(stage, &stage.world, run, plain, &mut values.depth);
        if !plain {
            let events = depth.events(&walk.plane, run.y, run.x0, run.x1 - run.x0);
            values.wraps += events.count(Event::Wrap);
            values.clamps += events.count(Event::ClampAbove) + events.count(Event::ClampBelow);
        }
    }
    values.depth.settle(&stage.world);
}

impl<'a> Walk<'a> {
    pub(super) fn new(stage: &Stage, depth: &'a Depth, face: &Face, surface: &'a Surface) -> Self {
        let plane = depth.plane(&face.triangle, surface.vertex, &stage.grid);
        let (fraction, exact) = (depth.read_out().fraction(), &surface.exact);
        let gain = depth.gain(&face.triangle, surface.vertex, &stage.grid);
        let per_pixel = fraction + stage.grid.sub_pixel;
        let ([x, y], [_, dx, dy]) = (surface.code.base().map(i128::from), plane.raw());
        let error = [
            (plane.at(x, y).raw() - gain) * exact.whole
                - (exact.at(stage.grid.position(x, y)) << fraction),
            dx * exact.whole - (exact.slope[0] << per_pixel),
            dy * exact.whole - (exact.slope[1] << per_pixel),
        ];
        let narrow = Narrow::new(error, [plane.at(x, y).raw(), dx, dy], depth.read_out());
        let whole = real(exact.whole) * real(1 << fraction);
        Self { depth, plane, gain, surface, error, narrow, whole }
    }

    /// Steps from the base pixel.
    #[inline]
    fn steps(&self, x: u32, y: u32) -> [i64; 2] {
        let [base_x, base_y] = self.surface.code.base();
        [i64::from(x) - i64::from(base_x), i64::from(y) - i64::from(base_y)]
    }

    /// Widens a reach by a run; whether all of it lies inside the range, on a plane that is added
    /// up without a hold.
    #[inline]
    fn reach(&self, run: &Span, reach: &mut Reach) -> bool {
        let (first, last) = (self.steps(run.x0, run.y), self.steps(run.x1 - 1, run.y));
        if let Some(Narrow { value, low, high, .. }) = &self.narrow {
            let (one, other) = (at(value, first), at(value, last));
            let (least, most) = (one.min(other), one.max(other));
            reach.widen(Reach(Some((least.into(), most.into()))));
            return *low <= least && most < *high;
        }
        let (x0, x1, y) = (i128::from(run.x0), i128::from(run.x1 - 1), i128::from(run.y));
        let (one, other) = (self.plane.at(x0, y).raw(), self.plane.at(x1, y).raw());
        let (least, most) = (one.min(other), one.max(other));
        reach.widen(Reach(Some((least, most))));
        let (low, high) = inside(self.depth.read_out());
        low <= least && most < high
    }

    /// The error at a pixel, in ULP: an exact numerator, divided once.
    #[inline]
    fn ulp(&self, x: u32, y: u32) -> f64 {
        let steps = self.steps(x, y);
        #[allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]
        let above = if let Some(narrow) = &self.narrow {
            at(&narrow.error, steps) as f64
        } else {
            let [start, dx, dy] = self.error;
            real(start + dx * i128::from(steps[0]) + dy * i128::from(steps[1]))
        };
        above / self.whole
    }

    /// Adds the errors of a run; `plain` if all of it lies inside the range.
    #[inline]
    fn errors(&self, stage: &Stage, world: &World, run: &Span, plain: bool, into: &mut ValueTally) {
        if plain {
            return self.plain_errors(world, run, into);
        }
        let inner = self.inner(run);
        let part = |x| self.surface.code.at(x, run.y) / world.top;
        for x in (run.x0..inner.x0).chain(inner.x1..run.x1) {
            into.note(world, self.held_ulp(stage, x, run.y), part(x));
        }
        if inner.x0 < inner.x1 {
            self.plain_errors(world, &inner, into);
        }
    }

    #[inline]
    fn plain_errors(&self, world: &World, run: &Span, into: &mut ValueTally) {
        let part = |x| self.surface.code.at(x, run.y) / world.top;
        let (first, last) = (run.x0, run.x1 - 1);
        if first == last {
            return into.note(world, self.ulp(first, run.y), part(first));
        }
        let ulp = [self.ulp(first, run.y), self.ulp(last, run.y)];
        into.run(world, ulp, [part(first), part(last)], run.x1 - run.x0);
    }

    /// The part of a run that lies inside the range, perhaps empty: values only rise or only fall.
    fn inner(&self, run: &Span) -> Span {
        let (low, high) = inside(self.depth.read_out());
        let value = |x: u32| self.plane.at(x.into(), run.y.into()).raw();
        let rises = self.plane.dx().raw() >= 0;
        let enters = first_column(run, |x| if rises { value(x) >= low } else { value(x) < high });
        let leaves = first_column(run, |x| if rises { value(x) >= high } else { value(x) < low });
        Span { x0: enters.min(leaves), x1: leaves, ..*run }
    }

    /// The error at a pixel as read: wrapped, clamped or held.
    pub(super) fn held_ulp(&self, stage: &Stage, x: u32, y: u32) -> f64 {
        let (fraction, exact) = (self.depth.read_out().fraction(), &self.surface.exact);
        let held = self.depth.held(&self.plane, x, y) - self.gain;
        let at = stage.grid.position(x.into(), y.into());
        real(held * exact.whole - (exact.at(at) << fraction)) / self.whole
    }
}
