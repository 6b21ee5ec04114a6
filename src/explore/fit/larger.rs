//! The budgets of a space that have at least as many bits of everything. Spec clause `Q-8`.

use super::judge::{Judge, Verdict};
use crate::explore::field::Value;
use crate::explore::space::{Point, Space, describe};
use crate::explore::sweep::Sweep;
use crate::profile::InvalidProfile;

/// Whether every larger budget of the space meets the tolerances.
#[derive(Clone, Debug, Default)]
pub struct Larger {
    /// Larger budgets that were looked at; the effort of the search does not count them.
    pub checked: u64,
    /// The first that fails, if one does: then the answer is the cheapest that meets the
    /// tolerances, and not one that more bits always keep.
    pub failed: Option<Failed>,
}

/// A larger budget that fails.
#[derive(Clone, Debug)]
pub struct Failed {
    /// Its number.
    pub index: u64,
    /// Fields and words, by name.
    pub budget: Vec<(&'static str, Value)>,
}

/// Whether `one` has at most as many bits of each field as `other`, and the same choices. A word
/// beside numbers, an exact width or quotient, is more than any number.
pub(super) fn below(space: &Space, one: &[usize], other: &[usize]) -> bool {
    space.axes().iter().zip(one.iter().zip(other)).all(|(axis, (a, b))| {
        match (&axis.values[*a], &axis.values[*b]) {
            (Value::Bits(a), Value::Bits(b)) => a <= b,
            (Value::Bits(_), Value::Name(_)) => axis.field.is_bits(),
            (a, b) => a == b,
        }
    })
}

/// Looks at every larger budget until one fails; `None` when `go_on` said no.
pub(super) fn check(
    judge: &mut Judge<'_>,
    sweep: &Sweep,
    choices: &[usize],
    go_on: &dyn Fn() -> bool,
) -> Result<Option<Larger>, InvalidProfile> {
    let space = &sweep.space;
    let own = space.index(choices);
    let mut larger: Vec<u64> = vec![0];
    for (n, axis) in space.axes().iter().enumerate() {
        let above: Vec<usize> = (0..axis.values.len())
            .filter(|value| {
                let mut to = choices.to_vec();
                to[n] = *value;
                below(space, choices, &to)
            })
            .collect();
        let count = axis.values.len() as u64;
        larger = larger
            .into_iter()
            .flat_map(|index| above.iter().map(move |value| index * count + *value as u64))
            .collect();
    }
    // Neighbours share a grid: that of the answer first, as it is at hand.
    let mut found = Larger::default();
    judge.by_bound = true;
    for index in larger.into_iter().filter(|index| *index != own) {
        if !go_on() {
            return Ok(None);
        }
        let Ok(Point::Budget(profile)) = space.point(index) else { continue };
        found.checked += 1;
        if matches!(judge.judge(&profile)?, Verdict::Fails) {
            found.failed = Some(Failed { index, budget: describe(&profile) });
            break;
        }
    }
    judge.by_bound = false;
    Ok(Some(found))
}
