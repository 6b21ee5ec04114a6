//! The budgets of a space in the order of their cost.

use super::Request;
use super::group::StageKey;
use crate::explore::space::Point;
use crate::explore::sweep::Sweep;
use crate::measure::cost::estimate;
use crate::profile::InvalidProfile;
use std::cmp::Ordering;

/// A budget and what it costs.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) index: u64,
    pub(super) cost: f64,
}

/// Cost, then number: a total order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key(f64, u64);

impl Eq for Key {}

impl PartialOrd for Key {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Key {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

impl Candidate {
    pub(super) fn key(&self) -> Key {
        Key(self.cost, self.index)
    }

    pub(super) fn point(&self, sweep: &Sweep) -> Point {
        // A number of the list was a budget when the list was made.
        sweep.space.point(self.index).unwrap_or(Point::Again)
    }
}

/// The budgets asked for, in lists that share a scene on a grid, each by cost, the list with the
/// cheapest budget first.
pub(super) fn by_stage(request: &Request<'_>) -> Result<Vec<Vec<Candidate>>, InvalidProfile> {
    let mut groups: Vec<(_, Vec<Candidate>)> = Vec::new();
    for index in request.numbers.clone() {
        let Ok(Point::Budget(profile)) = request.sweep.space.point(index) else { continue };
        let cost = request.cost.of_cost(&estimate(&profile)?).unwrap_or(f64::INFINITY);
        let (candidate, key) = (Candidate { index, cost }, StageKey::new(&profile));
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, group)) => group.push(candidate),
            None => groups.push((key, vec![candidate])),
        }
    }
    let mut lists: Vec<Vec<Candidate>> = groups.into_iter().map(|(_, group)| group).collect();
    for list in &mut lists {
        list.sort_by_key(Candidate::key);
    }
    lists.sort_by_key(|list| list[0].key());
    Ok(lists)
}
