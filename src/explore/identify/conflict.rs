//! Cases that contradict each other. Spec clause `ID-5`.

use super::{Capture, Case, Hypotheses, Identifier};

impl Identifier {
    /// Of cases that leave nothing, a few that leave nothing by themselves, by their place: without any one of
    /// them something is left. Empty where something is left of all of them.
    ///
    /// Each set of that kind tells of a contradiction; from several orders of leaving cases out, the smallest is
    /// taken. `go_on` is asked before each trial.
    pub fn conflict(
        hypotheses: &Hypotheses,
        (captures, wrong): (&[Capture], u8),
        cases: &[Case],
        go_on: &mut dyn FnMut() -> bool,
    ) -> Vec<usize> {
        // The first cases of an order after which nothing is left.
        let first = |order: &[usize]| {
            let mut identifier = Self::new(hypotheses, captures.to_vec(), wrong);
            let mut taken = Vec::new();
            for place in order {
                identifier.observe(&cases[*place]);
                taken.push(*place);
                if identifier.left() == 0 {
                    return Some(taken);
                }
            }
            None
        };
        let forward: Vec<usize> = (0..cases.len()).collect();
        let backward = forward.iter().rev().copied().collect();
        let mut best: Option<Vec<usize>> = None;
        for order in [forward, backward] {
            // They hold a contradiction, and the last of them is one of it.
            let Some(mut kept) = first(&order) else { return Vec::new() };
            let mut at = 0;
            while at < kept.len() && go_on() {
                let mut fewer = kept.clone();
                fewer.remove(at);
                match first(&fewer) {
                    Some(taken) => kept = taken,
                    None => at += 1,
                }
            }
            if best.as_ref().is_none_or(|best| kept.len() < best.len()) {
                best = Some(kept);
            }
        }
        let mut best = best.unwrap_or_default();
        best.sort_unstable();
        best
    }
}
