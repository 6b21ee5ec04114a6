//! Depth: of a machine that walks a plane, and of one that makes it by its own means. Spec clauses `B-5` to `B-8`.

use super::Proof;
use super::carried::CarriedValue;
use super::domain::Question;
use super::plane::{self, Goal, Subject};
use super::{guard, slope};
use crate::format::Clamp;
use std::fmt::Write as _;

/// The claims on depth, for a profile that has it.
pub(super) fn proofs(question: &Question) -> Vec<Proof> {
    if !question.profile.form.walks_a_plane() {
        return of_own_means(question);
    }
    let subject = Subject::depth();
    let mut proofs = plane::proofs(question, &subject);
    proofs.extend(guard::proof(question, &subject));
    proofs.extend(slope::proof(question));
    proofs
}

/// By the bound that the machine states. There is no plane, so there is no slope of one.
fn of_own_means(question: &Question) -> Vec<Proof> {
    let Some(depth) = question.profile.depth else { return Vec::new() };
    let form = &question.profile.form;
    let value = CarriedValue::depth(question, &depth);
    let sticky = "The error of a sticky accumulator depends on its path.";
    let refusal = (depth.clamp == Clamp::Saturate).then_some(sticky);
    let goals: &[Goal] =
        if depth.rounding.is_nearest() { &[Goal::Half] } else { &[Goal::Half, Goal::One] };
    let interpolation = goals.iter().map(|goal| {
        let mut proof = value.interpolation_proof("the depth", *goal, refusal);
        if proof.bits.is_none() && refusal.is_none() && value.own_error().is_some() {
            let _ = write!(
                proof.statement,
                " The rest of the error comes from the machine's other words (clause {}): give these more bits.",
                form.kind().clause
            );
        }
        proof
    });
    let mut proofs: Vec<Proof> = interpolation.chain(value.guard_proof(true)).collect();
    if !form.covers_exactly(&question.profile.state()) {
        for proof in &mut proofs {
            proof.statement += " Taken for granted: the exact triangle covers the sample, which this machine does not \
                                promise for each sample that it draws.";
        }
    }
    proofs
}
