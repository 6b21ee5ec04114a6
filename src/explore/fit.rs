//! The cheapest budget of a space that meets tolerances on scenes. Spec clauses `Q-7` to `Q-9`.
//!
//! Budgets are taken in the order of their cost, which their bits give. A budget is left out
//! without a whole measurement only when a part of one proves that it fails, when its figures are
//! proved to be those of a budget already measured, or when it costs more than one that meets all.
//! Nothing is left out because a neighbour failed: measured error is not monotone in a field.

mod bound;
mod candidate;
mod channel;
mod exhaustive;
mod group;
mod judge;
mod larger;
mod least;
mod lesser;
mod partly;

pub use exhaustive::exhaustive;
pub use larger::Larger;
pub use least::Least;
pub use lesser::Lesser;

use super::field::{Field, Value};
use super::metric::Metric;
use super::space::{Point, describe};
use super::sweep::Sweep;
use super::tolerance::Tolerance;
use crate::measure::accuracy::Accuracy;
use crate::profile::{InvalidProfile, Profile};
use candidate::{Candidate, by_stage};
use judge::{Judge, Verdict};
use std::ops::Range;

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// Budgets and scenes.
    pub sweep: &'a Sweep,
    /// What a budget has to meet.
    pub tolerances: Vec<Tolerance>,
    /// What is to be small, one of cost.
    pub cost: Metric,
    /// Whether every larger budget of the space has to meet the tolerances as well.
    pub robust: bool,
    /// The numbers to look at; all of the space, as a rule.
    pub numbers: Range<u64>,
}

/// Why nothing is searched.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A machine of the space makes depth by other means than a plane: the search measures planes.
    #[error(
        "form = {0}: this machine does not walk a depth plane, but the proofs of fit are about planes"
    )]
    OwnDepth(String),
    /// A budget that validated cannot be built: never.
    #[error(transparent)]
    Profile(#[from] InvalidProfile),
}

impl Request<'_> {
    /// Refuses a space with depth that is no plane.
    fn check(&self) -> Result<(), FitError> {
        let base = self.sweep.space.base();
        let varied = self.sweep.space.axes().iter().filter(|axis| axis.field == Field::FORM);
        let names = varied.flat_map(|axis| &axis.values).map(ToString::to_string);
        let own = std::iter::once(base.form.name().to_owned()).chain(names).find(|name| {
            base.with_machine(name).is_some_and(|p| p.depth.is_some() && !p.form.walks_a_plane())
        });
        own.map_or(Ok(()), |name| Err(FitError::OwnDepth(name)))
    }
}

/// How budgets were dealt with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Effort {
    /// Budgets measured over all scenes.
    pub evaluated: u64,
    /// Refuted by what snapping alone does.
    pub by_snap: u64,
    /// Refuted by what is drawn, whatever the values.
    pub by_coverage: u64,
    /// Refuted by values that their guard bits cannot hold.
    pub by_range: u64,
    /// Refuted by a triangle that had refuted another one.
    pub by_witness: u64,
    /// Refuted before all triangles were measured.
    pub by_part: u64,
    /// Proved to have the figures of a budget already measured.
    pub by_sameness: u64,
    /// Proved to meet every tolerance by the bounds of the specification.
    pub by_bound: u64,
    /// Costlier than one that meets all tolerances.
    pub by_cost: u64,
    /// Smaller than one that fails, where every larger one has to meet the tolerances.
    pub by_larger: u64,
    /// Refuted by the codes of a channel.
    #[serde(default)]
    pub by_channel: u64,
}

impl Effort {
    /// Adds what the search of another part took.
    pub fn add(&mut self, other: &Self) {
        let counts = [
            (&mut self.evaluated, other.evaluated),
            (&mut self.by_snap, other.by_snap),
            (&mut self.by_coverage, other.by_coverage),
            (&mut self.by_range, other.by_range),
            (&mut self.by_witness, other.by_witness),
            (&mut self.by_part, other.by_part),
            (&mut self.by_sameness, other.by_sameness),
            (&mut self.by_bound, other.by_bound),
            (&mut self.by_cost, other.by_cost),
            (&mut self.by_larger, other.by_larger),
            (&mut self.by_channel, other.by_channel),
        ];
        for (to, from) in counts {
            *to += from;
        }
    }

    /// Budgets that did not take a whole measurement.
    pub const fn pruned(&self) -> u64 {
        let refuted = self.by_snap
            + self.by_coverage
            + self.by_range
            + self.by_witness
            + self.by_part
            + self.by_channel;
        refuted + self.by_sameness + self.by_bound + self.by_cost + self.by_larger
    }
}

/// The budget that was found.
#[derive(Clone, Debug)]
pub struct Best {
    /// Its number.
    pub index: u64,
    /// The profile.
    pub profile: Profile,
    /// What it costs, in the metric asked for.
    pub cost: f64,
    /// What it does on the scenes.
    pub accuracy: Accuracy,
    /// Whether every larger budget of the space meets the tolerances, too.
    pub larger: Larger,
    /// For each field that counts bits: what fails with one bit less.
    pub lesser: Vec<Lesser>,
}

impl Best {
    /// Fields and words, by name.
    pub fn budget(&self) -> Vec<(&'static str, Value)> {
        describe(&self.profile)
    }
}

/// The answer.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The cheapest budget, if any meets the tolerances.
    pub best: Option<Box<Best>>,
    /// How it was found.
    pub effort: Effort,
    /// Numbers that are budgets.
    pub budgets: u64,
}

/// Finds the cheapest budget; of equally cheap ones that with the lowest number. `go_on` is asked
/// now and then; `None` when it said no.
///
/// # Errors
/// [`FitError`] names the machine whose depth is no plane.
pub fn fit(request: &Request<'_>, go_on: &dyn Fn() -> bool) -> Result<Option<Fit>, FitError> {
    request.check()?;
    let groups = by_stage(request)?;
    let budgets = groups.iter().map(|group| group.len() as u64).sum();
    let mut judge = Judge::new(request.sweep, &request.tolerances);
    let mut found: Option<(Candidate, Accuracy)> = None;
    let mut failing: Vec<Vec<usize>> = Vec::new();
    for group in groups {
        for (n, candidate) in group.iter().enumerate() {
            if found.as_ref().is_some_and(|(best, _)| best.key() <= candidate.key()) {
                judge.effort.by_cost += (group.len() - n) as u64;
                break;
            }
            if !go_on() {
                return Ok(None);
            }
            let choices = request.sweep.space.choices(candidate.index);
            if failing.iter().any(|larger| larger::below(&request.sweep.space, &choices, larger)) {
                judge.effort.by_larger += 1;
                continue;
            }
            let Point::Budget(profile) = candidate.point(request.sweep) else { continue };
            let Verdict::Meets(accuracy) = judge.judge(&profile)? else { continue };
            if request.robust {
                let kept = judge.effort;
                let Some(larger) = larger::check(&mut judge, request.sweep, &choices, go_on)?
                else {
                    return Ok(None);
                };
                judge.effort = kept;
                if let Some(failed) = larger.failed {
                    failing.push(request.sweep.space.choices(failed.index));
                    continue;
                }
            }
            found = Some((candidate.clone(), *accuracy));
        }
    }
    let effort = judge.effort;
    let best = match found {
        None => None,
        Some((candidate, accuracy)) => {
            let Point::Budget(profile) = candidate.point(request.sweep) else { return Ok(None) };
            let choices = request.sweep.space.choices(candidate.index);
            // The robust answer's larger ones have been looked at and are quickly seen again.
            let Some(larger) = larger::check(&mut judge, request.sweep, &choices, go_on)? else {
                return Ok(None);
            };
            let lesser = lesser::lesser(&mut judge, request.sweep, &profile)?;
            let (index, cost) = (candidate.index, candidate.cost);
            Some(Box::new(Best { index, profile: *profile, cost, accuracy, larger, lesser }))
        }
    };
    Ok(Some(Fit { best, effort, budgets }))
}

/// For each tolerance the least that its figure comes to in the space, on its own.
///
/// # Errors
/// [`FitError`] as for [`fit`].
pub fn least(request: &Request<'_>) -> Result<Vec<Least>, FitError> {
    request.check()?;
    Ok(least::least(request)?)
}
