//! The least that each figure comes to: the nearest that is possible, where a tolerance is not.

use super::Request;
use super::candidate::by_stage;
use super::judge::{Judge, Verdict};
use crate::explore::field::Value;
use crate::explore::metric::Metric;
use crate::explore::space::{Point, describe};
use crate::explore::tolerance::Tolerance;
use crate::profile::InvalidProfile;

/// The least of a figure over a space.
#[derive(Clone, Debug)]
pub struct Least {
    /// The figure.
    pub metric: Metric,
    /// The most it was to be.
    pub limit: f64,
    /// The least it is.
    pub value: f64,
    /// The number of the budget where it is that.
    pub index: u64,
    /// That budget's fields and words, by name.
    pub budget: Vec<(&'static str, Value)>,
}

pub(super) fn least(request: &Request<'_>) -> Result<Vec<Least>, InvalidProfile> {
    let groups = by_stage(request)?;
    let mut found = Vec::new();
    for tolerance in &request.tolerances {
        let mut best: Option<Least> = None;
        let mut judge = Judge::new(request.sweep, &[]);
        // Budgets with many bits are likely to have the least error: the dear ones first.
        for candidate in groups.iter().rev().flat_map(|group| group.iter().rev()) {
            let Point::Budget(profile) = candidate.point(request.sweep) else { continue };
            // Whatever is not better than the best so far may stop early.
            let limit = best.as_ref().map_or(f64::MAX, |best| best.value.next_down());
            if limit < 0.0 {
                break;
            }
            judge.tolerances = vec![Tolerance { limit, ..*tolerance }];
            let Verdict::Meets(accuracy) = judge.judge(&profile)? else { continue };
            let Some(value) = tolerance.metric.of_accuracy(&accuracy) else { continue };
            best = Some(Least {
                metric: tolerance.metric,
                limit: tolerance.limit,
                value,
                index: candidate.index,
                budget: describe(&profile),
            });
        }
        found.extend(best);
    }
    Ok(found)
}
