//! The naive twin of the search: everything measured, nothing left out.

use super::Request;
use crate::explore::sweep::Found;
use crate::explore::tolerance::Tolerance;
use crate::profile::InvalidProfile;
use std::sync::Mutex;

/// The number of the cheapest budget that meets the tolerances, of equally cheap ones the lowest,
/// from a measurement of every budget.
///
/// # Errors
/// [`InvalidProfile`] as for [`super::fit`].
pub fn exhaustive(request: &Request<'_>, threads: usize) -> Result<Option<u64>, InvalidProfile> {
    let best: Mutex<Option<(f64, u64)>> = Mutex::new(None);
    let wanted = |index: u64| request.numbers.contains(&index);
    request.sweep.run(threads, &wanted, &|found| {
        if let Found::Measured(record) = found {
            let meets = request.tolerances.iter().all(|Tolerance { metric, limit }| {
                metric.of_accuracy(&record.accuracy).is_none_or(|value| value <= *limit)
            });
            let cost = request.cost.of_cost(&record.cost).unwrap_or(f64::INFINITY);
            if let (true, Ok(mut best)) = (meets, best.lock()) {
                let own = (cost, record.index);
                let better = best.is_none_or(|(cost, index)| {
                    own.0.total_cmp(&cost).then(own.1.cmp(&index)).is_lt()
                });
                if better {
                    *best = Some(own);
                }
            }
        }
        true
    })?;
    Ok(best.into_inner().ok().flatten().map(|(_, index)| index))
}
