//! What a part of a measurement proves: figures that only grow as more is measured.

use super::group::{Coverage, Group};
use crate::explore::field::Level;
use crate::explore::tolerance::{Tolerance, exceeded};
use crate::measure::accuracy::{Moments, Tally, ValueTally, Values};

/// Tolerances, and what a part of the values is a part of.
pub(super) struct Partly<'a> {
    tolerances: &'a [Tolerance],
    group: &'a Group,
    coverage: &'a Coverage,
    /// The largest errors so far, depth and attribute in both units.
    worst: [f64; 4],
}

impl<'a> Partly<'a> {
    pub(super) fn new(
        tolerances: &'a [Tolerance],
        group: &'a Group,
        coverage: &'a Coverage,
    ) -> Self {
        Self { tolerances, group, coverage, worst: [0.0; 4] }
    }

    /// Whether another look is worth it after a face: it has the worst error so far, or something
    /// left the range, or squares have added up for a while.
    pub(super) fn is_due(&mut self, own: &Values, face: usize) -> bool {
        let figures = [own.depth.ulp, own.depth.world, own.attribute.ulp, own.attribute.world];
        let mut due = face % 256 == 255 || own.wraps > 0 || own.clamps > 0;
        for (worst, own) in self.worst.iter_mut().zip(figures) {
            due |= own.worst > *worst;
            *worst = worst.max(own.worst);
        }
        due
    }

    /// Whether these values alone exceed a tolerance, whatever the rest is.
    pub(super) fn fails(&self, values: &Values) -> bool {
        // The rest can only raise a worst error, a sum of squares, a count; the mean and the order
        // of surfaces say nothing yet.
        let at_least = |moments: Moments| Moments {
            count: self.coverage.samples.max(moments.count),
            sum: 0.0,
            // Sums of squares are formed in another order in the end.
            squares: moments.squares * (1.0 - 1e-12),
            ..moments
        };
        let both = |value: ValueTally| ValueTally {
            ulp: at_least(value.ulp),
            world: at_least(value.world),
        };
        let tally = Tally {
            depth: both(values.depth),
            attribute: both(values.attribute),
            wraps: values.wraps,
            clamps: values.clamps,
            ..self.coverage.tally
        };
        exceeded(self.tolerances, &self.group.report(&tally), Level::Value).is_some()
    }
}
