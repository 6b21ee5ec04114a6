//! The division behind plane slopes: an exact quotient, or one shared reciprocal.
//! Spec clauses `P-3` and `P-4`.

use crate::bits::Rounding;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a plane gradient is divided by twice the area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Division {
    /// The true signed quotient, rounded once.
    Quotient,
    /// One reciprocal of twice the area, normalised to one leading bit, rounded nearest even, used
    /// for both slopes and the start; each product is rounded once.
    Reciprocal {
        /// Bits of the reciprocal, the leading one included.
        bits: u32,
    },
}

/// A reciprocal too wide or too narrow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("bits = {0}: a reciprocal has 2 to 40 bits")]
pub struct DivisionError(pub u32);

impl Division {
    /// Checks the division.
    ///
    /// # Errors
    /// [`DivisionError`] unless a reciprocal has 2 to 40 bits.
    pub fn validate(self) -> Result<(), DivisionError> {
        match self {
            Self::Reciprocal { bits } if !(2..=40).contains(&bits) => Err(DivisionError(bits)),
            _ => Ok(()),
        }
    }

    /// Bits that the widest intermediate gains over the exact numerator.
    pub const fn growth(self) -> u32 {
        match self {
            Self::Quotient => 0,
            Self::Reciprocal { bits } => bits,
        }
    }

    /// Prepares the division by `divisor > 0`.
    pub fn by(self, divisor: i128) -> Divider {
        debug_assert!(divisor > 0, "twice the area is positive after normalising");
        match self {
            Self::Quotient => Divider::Quotient(divisor),
            Self::Reciprocal { bits } => Divider::reciprocal(divisor, bits),
        }
    }
}

/// A prepared division.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Divider {
    /// Divide by this.
    Quotient(i128),
    /// Multiply by `mantissa * 2^-exponent`.
    Product {
        /// The reciprocal, `bits` bits with the leading one set.
        mantissa: i128,
        /// Its scale.
        exponent: u32,
    },
}

impl Divider {
    fn reciprocal(divisor: i128, bits: u32) -> Self {
        // 2^(length-1) <= divisor < 2^length, so 2^e / divisor lies in (2^(bits-1), 2^bits] for
        // e = length + bits - 1.
        let length = i128::BITS - divisor.leading_zeros();
        let exponent = length + bits - 1;
        let (mantissa, _) = Rounding::NearestEven
            .divide(1 << exponent, divisor)
            .unwrap_or_else(|| unreachable!("the divisor is positive"));
        if mantissa == 1 << bits {
            // A power of two, or rounded up to the next one: one leading bit, one less exponent.
            Self::Product { mantissa: 1 << (bits - 1), exponent: exponent - 1 }
        } else {
            Self::Product { mantissa, exponent }
        }
    }

    /// `numerator * 2^shift / divisor`, rounded once. A negative result of a negative `shift`
    /// never arises: profiles keep `shift >= 0`.
    ///
    /// Growth: the numerator's bits plus `shift` plus the reciprocal's bits stay below 127;
    /// profiles beyond that are refused (clause `P-5`).
    #[inline]
    pub fn apply(self, numerator: i128, shift: u32, rounding: Rounding) -> (i128, bool) {
        match self {
            Self::Quotient(divisor) => rounding
                .divide(numerator << shift, divisor)
                .unwrap_or_else(|| unreachable!("the divisor is positive")),
            Self::Product { mantissa, exponent } => {
                let product = numerator * mantissa;
                if exponent >= shift {
                    rounding.shift_right(product, exponent - shift)
                } else {
                    (product << (shift - exponent), false)
                }
            }
        }
    }
}
