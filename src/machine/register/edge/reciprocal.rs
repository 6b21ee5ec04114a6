//! Division by the area. Spec clause `RE-8`.

use super::value::Division;
use crate::bits::Rounding;

/// A division by one area.
#[derive(Clone, Copy, Debug)]
pub(super) enum Divider {
    /// An exact quotient.
    Quotient { rounding: Rounding, area: i128 },
    /// A product with `factor` 2^-`places`, negated for an area below zero.
    Unit { factor: i128, places: i64, negative: bool },
}

/// A number moved to the left, or to the right if the places are negative.
pub(super) const fn shifted(value: i128, left: i64) -> i128 {
    let places = if left.unsigned_abs() < 127 { left.unsigned_abs() } else { 127 };
    if left >= 0 { value << places } else { value >> places }
}

/// Entry `i` of a table of 2^index entries: 2^seed / (1 + i 2^-index), to nearest, a tie upward.
const fn entry(index: u32, seed: u32, i: u128) -> u128 {
    let divisor = (1u128 << index) + i;
    ((2u128 << (seed + index)) + divisor) / (2 * divisor)
}

impl Divider {
    /// The division by an area: `area` as a number, `magnitude` as what a reciprocal unit is given.
    pub(super) fn new(division: Division, area: i128, magnitude: u128, negative: bool) -> Self {
        match division {
            Division::Quotient(rounding) => Self::Quotient { rounding, area },
            Division::Reciprocal { numerator, drop, zero } => {
                let quotient = (1u128 << numerator).checked_div(magnitude >> drop);
                let factor = crate::bits::bounded(quotient.unwrap_or_else(|| zero.into()));
                Self::Unit { factor, places: i64::from(numerator + drop), negative }
            }
            Division::Table { index, between, seed } => {
                let Some(leading) = magnitude.checked_ilog2() else {
                    return Self::Unit { factor: 0, places: 0, negative };
                };
                let below = (magnitude << (127 - leading) << 1) >> (128 - index - between);
                let (i, f) = (below >> between, below & ((1 << between) - 1));
                let here = entry(index, seed, i);
                // The last entry has nothing after it.
                let last = i + 1 == 1 << index;
                let delta = if last { 0 } else { here - entry(index, seed, i + 1) };
                let factor = crate::bits::bounded(here - ((delta * f) >> between));
                Self::Unit { factor, places: i64::from(seed + leading), negative }
            }
        }
    }

    /// A number times 2^left, divided; `product` bits hold the product with a reciprocal.
    pub(super) fn divide(&self, number: i128, left: i64, product: u32) -> i128 {
        match *self {
            Self::Quotient { rounding, area } => {
                let (number, area) = (shifted(number, left.max(0)), shifted(area, (-left).max(0)));
                rounding.divide(number, area).map_or(0, |(quotient, _)| quotient)
            }
            Self::Unit { factor, places, negative } => {
                let above = 128 - product;
                let held = number.wrapping_mul(factor) << above >> above;
                let quotient = shifted(held, left - places);
                if negative { quotient.wrapping_neg() } else { quotient }
            }
        }
    }
}
