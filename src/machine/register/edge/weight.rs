//! Weights of a pixel: its edge words over the area. Spec clause `RE-9`.

use super::linear::PRODUCT;
use super::part::Winding;
use super::reciprocal::{Divider, shifted};
use super::setup::{Corners, EdgeFunctions};
use super::value::ValueSource;

/// How edge words become weights.
#[derive(Debug)]
pub(super) struct Weights {
    divider: Divider,
    /// Whether words are negative inside.
    turned: bool,
    fraction: u32,
    product_cut: u32,
    product: u32,
}

impl EdgeFunctions {
    /// The weights of a triangle.
    pub(super) fn weights(&self, corners: &Corners) -> Weights {
        let Some(ValueSource::Weights { divide, fraction, product_cut, product }) =
            self.config.values
        else {
            unreachable!("the channels are weighted");
        };
        let below = corners.area < 0;
        let turned = match self.config.winding {
            Winding::Both | Winding::Either => below,
            Winding::One | Winding::Negate | Winding::Swap => false,
        };
        // The sign is in the word, and not in the area.
        let area = i128::from(corners.area);
        let area = if self.has_one_winding() { area } else { area.abs() };
        let divider = self.divider(divide, area);
        Weights { divider, turned, fraction, product_cut, product: product.unwrap_or(64) }
    }
}

impl Weights {
    /// The weights of a pixel with these edge words.
    pub(super) fn at(&self, words: [i64; 3]) -> [i128; 3] {
        words.map(|word| {
            let word = i128::from(word) * if self.turned { -1 } else { 1 };
            let left = i64::from(self.fraction);
            match self.divider {
                Divider::Quotient { .. } => self.divider.divide(word, left, PRODUCT),
                Divider::Unit { factor, places, .. } => {
                    let cut = word.wrapping_mul(factor) >> self.product_cut;
                    let held = cut & ((1 << self.product) - 1);
                    shifted(held, left - (places - i64::from(self.product_cut)))
                }
            }
        })
    }

    /// The sum of values by these weights, each product cut.
    pub(super) fn sum(&self, shares: [i128; 3], values: [i128; 3]) -> i128 {
        let terms = shares.into_iter().zip(values);
        let terms = terms.map(|(share, value)| (share * value) >> self.fraction);
        terms.fold(0, i128::wrapping_add)
    }
}
