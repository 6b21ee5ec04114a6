//! The words of a machine, taken apart for a report.

use crate::bits::Rounding;
use serde::Serialize;

/// One word.
#[derive(Clone, Debug, Serialize)]
pub struct Word {
    /// `vertex`, `edge`, `share`, `depth`, or the channels that share it.
    pub name: String,
    /// Bits in all.
    pub width: u32,
    /// Bits by purpose, most significant first.
    pub fields: Vec<WordField>,
    /// Range, resolution and the like.
    pub facts: Vec<Fact>,
}

/// Bits of one purpose.
#[derive(Clone, Debug, Serialize)]
pub struct WordField {
    /// Purpose.
    pub name: &'static str,
    /// Bits.
    pub bits: u32,
}

/// A property of a word.
#[derive(Clone, Debug, Serialize)]
pub struct Fact {
    /// What.
    pub name: &'static str,
    /// How much, with its unit.
    pub value: String,
}

impl Word {
    /// A word that is as wide as its fields together.
    pub fn new(
        name: impl Into<String>,
        fields: impl IntoIterator<Item = (&'static str, u32)>,
        facts: impl IntoIterator<Item = (&'static str, String)>,
    ) -> Self {
        let fields: Vec<WordField> =
            fields.into_iter().map(|(name, bits)| WordField { name, bits }).collect();
        let facts = facts.into_iter().map(|(name, value)| Fact { name, value }).collect();
        let width = fields.iter().map(|field| field.bits).sum();
        Self { name: name.into(), width, fields, facts }
    }

    /// An edge word of so many bits, none of which a profile chooses.
    pub fn exact_edge(width: u32) -> Self {
        let exact = "as wide as the vertex field asks".to_owned();
        Self::new("edge", [("edge", width)], [("exact", exact)])
    }
}

/// How many steps after a rounded start keep the accumulated error below half a result unit:
/// the most n with (n + 1) e < 1/2, e the bound of one rounding.
pub fn steps_below_half(fraction: u32, rounding: Rounding) -> u128 {
    // A nearest rounding errs by at most 2^-(F+1), reached, so the sum must be strictly less; any
    // other errs by strictly less than 2^-F, so the sum of the bounds may reach one half.
    if rounding.is_nearest() {
        (1u128 << fraction).saturating_sub(2)
    } else {
        (1u128 << fraction >> 1).saturating_sub(1)
    }
}
