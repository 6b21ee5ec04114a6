//! A metric and its largest allowed value.

use super::field::Level;
use super::metric::Metric;
use crate::measure::accuracy::Accuracy;

/// A figure and the most that it may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The figure, one of accuracy.
    pub metric: Metric,
    /// The most it may be.
    pub limit: f64,
}

/// The first tolerance of a level that a figure exceeds; a figure that the scenes do not have
/// exceeds nothing.
pub(super) fn exceeded(
    tolerances: &[Tolerance],
    accuracy: &Accuracy,
    level: Level,
) -> Option<Tolerance> {
    let mut here = tolerances.iter().filter(|tolerance| tolerance.metric.level() == level);
    let over = |t: &&Tolerance| t.metric.of_accuracy(accuracy).is_some_and(|value| value > t.limit);
    here.find(over).copied()
}
