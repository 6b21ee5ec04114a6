//! Words that a driver keeps to, and those that it never writes. Spec clause `RG-26`.

use super::RegisterStimulus;
use crate::case::{Class, place};

/// Words that break what the profile calls legal.
pub(super) const ILLEGAL: Class = Class {
    tag: "register-illegal",
    catches: "words that a driver never writes: nothing here holds hardware that does not promise anything for them",
};
/// Tests of each condition.
pub(super) const BROKEN: u64 = 8;

impl RegisterStimulus {
    /// The words, or legal ones if they are not.
    pub(super) fn lawful(&self, words: Vec<u32>) -> Vec<u32> {
        if self.host.is_legal(&words) { words } else { self.legal.to_vec() }
    }

    /// A host's words with one register changed, so that a condition of legal words is broken.
    pub(super) fn illegal(&self, index: u64) -> Vec<u32> {
        let words = self.drawing(index);
        let conditions = &self.host.registers.legal;
        let broken = conditions[place(index / BROKEN) % conditions.len()].broken(&words);
        let small = |words: &&Vec<u32>| self.host.records(words).is_whole();
        let broken: Vec<&Vec<u32>> = broken.iter().filter(small).collect();
        let chosen = broken.get(place(index % BROKEN) % broken.len().max(1));
        chosen.map_or(words, |chosen| (*chosen).clone())
    }
}
