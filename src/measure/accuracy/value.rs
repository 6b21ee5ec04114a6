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
use crate::format::Clamp;
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
    surface: &'a Surface,
    /// The error at the surface's base pixel and its changes, over `whole`.
    error: [i128; 3],
    /// The same where every sum over the window fits: nearly always.
    narrow: Option<[i64; 3]>,
    whole: f64,
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
        let (walk, world) = (Walk::new(stage, depth, face, attribute), stage.world.flat());
        for run in runs {
            let plain = walk.reach(run, &mut values.attribute_extent);
            walk.errors(stage, &world, run, plain, &mut values.attribute);
        }
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
}

impl<'a> Walk<'a> {
    pub(super) fn new(stage: &Stage, depth: &'a Depth, face: &Face, surface: &'a Surface) -> Self {
        let plane = depth.plane(&face.triangle, surface.vertex, &stage.grid);
        let (fraction, exact) = (depth.read_out().fraction(), &surface.exact);
        let per_pixel = fraction + stage.grid.sub_pixel;
        let [x, y] = surface.code.base().map(i128::from);
        let error = [
            (plane.at(x, y) - depth.start_bias()) * exact.whole
                - (exact.at(stage.grid.position(x, y)) << fraction),
            plane.dx * exact.whole - (exact.slope[0] << per_pixel),
            plane.dy * exact.whole - (exact.slope[1] << per_pixel),
        ];
        // A window has 2^16 pixels on a side: the sum of three stays below 2^62.
        let fits = |value: i128| i64::try_from(value).ok().filter(|v| v.unsigned_abs() < 1 << 45);
        let narrow = match error.map(fits) {
            [Some(start), Some(dx), Some(dy)] => Some([start, dx, dy]),
            _ => None,
        };
        let whole = real(exact.whole) * real(1 << fraction);
        Self { depth, plane, surface, error, narrow, whole }
    }

    /// Widens a reach by a run; whether all of it lies inside the range, on a plane that is added
    /// up without a hold.
    #[inline]
    fn reach(&self, run: &Span, reach: &mut Reach) -> bool {
        let y = i128::from(run.y);
        let ends = [run.x0, run.x1 - 1].map(|x| self.plane.at(x.into(), y));
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        reach.widen(Reach(Some((low, high))));
        let read = self.depth.read_out();
        let (lowest, limit) = read.range();
        low >= lowest.max(0) && high < limit.min(read.top()) && read.clamp() != Clamp::Saturate
    }

    /// The error at a pixel, in ULP: an exact numerator, divided once.
    #[inline]
    fn ulp(&self, x: u32, y: u32) -> f64 {
        let [base_x, base_y] = self.surface.code.base();
        let right = i64::from(x) - i64::from(base_x);
        let down = i64::from(y) - i64::from(base_y);
        #[allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]
        let above = match self.narrow {
            Some([start, dx, dy]) => (start + dx * right + dy * down) as f64,
            None => {
                let [start, dx, dy] = self.error;
                real(start + dx * i128::from(right) + dy * i128::from(down))
            }
        };
        above / self.whole
    }

    /// Adds the errors of a run; `plain` if all of it lies inside the range.
    #[inline]
    fn errors(&self, stage: &Stage, world: &World, run: &Span, plain: bool, into: &mut ValueTally) {
        let part = |x| self.surface.code.at(x, run.y) / world.top;
        if plain {
            let ends = [run.x0, run.x1 - 1];
            let ulp = ends.map(|x| self.ulp(x, run.y));
            into.run(world, ulp, ends.map(part), run.x1 - run.x0);
            return;
        }
        for x in run.x0..run.x1 {
            into.note(world, self.held_ulp(stage, x, run.y), part(x));
        }
    }

    /// The error at a pixel as read: wrapped, clamped or held.
    pub(super) fn held_ulp(&self, stage: &Stage, x: u32, y: u32) -> f64 {
        let (fraction, exact) = (self.depth.read_out().fraction(), &self.surface.exact);
        let held = self.depth.held(&self.plane, x, y) - self.depth.start_bias();
        let at = stage.grid.position(x.into(), y.into());
        real(held * exact.whole - (exact.at(at) << fraction)) / self.whole
    }
}
