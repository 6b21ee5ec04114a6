//! What the specification's bounds prove without measuring. Spec clause `Q-9`.

use crate::explore::field::Level;
use crate::explore::metric::{Interpolated, Scale, Subject};
use crate::explore::tolerance::Tolerance;
use crate::format::Clamp;
use crate::measure::accuracy::{Drawn, Stage};
use crate::profile::Profile;
use crate::setup::Division;

/// Whether every tolerance is proved to be met. The bound is for exact quotients under the guard
/// clamp with a guard bit: with n roundings of at most e on the longest walk to a sample no error
/// exceeds n e, and below one ULP no value leaves the guard range. Depth is a plane: [`super::FitError`].
pub(super) fn meets(
    stages: &[Stage],
    drawn: &[Drawn],
    profile: &Profile,
    tolerances: &[Tolerance],
) -> bool {
    let Some(depth) = profile.depth else { return false };
    let guarded = matches!(depth.clamp, Clamp::Guard | Clamp::Error) && depth.guard >= 1;
    // What a depth bias moves can leave the range of depth.
    if !guarded || depth.division != Division::Quotient || depth.bias.is_some() {
        return false;
    }
    let runs = stages.iter().flat_map(|stage| &stage.runs);
    let longest = runs.map(|run| u64::from(run.x1 - 1) + u64::from(run.y)).max().unwrap_or(0);
    let one = if depth.rounding.is_nearest() { 0.5 } else { 1.0 };
    #[allow(clippy::cast_precision_loss, reason = "at most 2^17 steps")]
    let error = (longest + 1) as f64 * one / 2f64.powi(depth.interpolation.cast_signed());
    if error >= 1.0 || !drawn.iter().all(Drawn::is_whole) {
        return false;
    }
    let world = stages.iter().map(|stage| stage.world.largest(error)).fold(0.0, f64::max);
    let range = stages.iter().map(|stage| error / stage.world.top).fold(0.0, f64::max);
    tolerances.iter().all(|Tolerance { metric, limit }| {
        if metric.is_accuracy() && metric.level() != Level::Value {
            // Looked at before: it does not depend on the values.
            return true;
        }
        let most = match metric.subject {
            // No mean square exceeds the largest square, and no mean the largest error.
            Subject::Value(_, Scale::Ulp) => error,
            Subject::Value(Interpolated::Depth, Scale::World) => world,
            Subject::Value(Interpolated::Attribute, Scale::World) => range,
            Subject::Wraps => 0.0,
            // Looked at by itself.
            Subject::Channel(_) => return true,
            Subject::Misclassified
            | Subject::Hits
            | Subject::Order(_)
            | Subject::Clamps
            | Subject::Triangles
            | Subject::Cost
            | Subject::Software => return false,
        };
        most <= *limit
    })
}
