//! Exact values on their way to a word. Spec clause `F-6`.

use super::q::QFormat;
use crate::bits::{Width, Word, decimal};
use std::fmt;

/// A value before it is cut to a word: `raw / 2^fraction`, of any size that 128 bits hold.
///
/// Units: those of the value it stands for. A coordinate in sub-pixels is a number of pixels with
/// `sub_pixel` fraction bits, an accumulator "times 2^F" a number of ULP with F fraction bits.
///
/// ```
/// use guardbit::{bits::Width, format::{QFormat, Unreduced}};
/// let depth = Unreduced::new(-5, 2);
/// assert_eq!(depth.to_string(), "-1.25");
/// // Mod 2^4, in quarters: 11 of 16.
/// assert_eq!(depth.reduce(QFormat::new(2, 2)?)?.to_bits(), 11);
/// // A word that counts eighths is another format.
/// assert!(depth.reduce(QFormat::new(2, 3)?).is_err());
/// assert!(depth.try_add(Unreduced::new(1, 3)).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Unreduced {
    raw: i128,
    fraction: u32,
}

/// Two values that count different units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the numbers of fraction bits differ: {left} and {right}; shift one value to the binary point of the other first"
)]
pub struct FractionMismatch {
    /// Fraction bits of the one.
    pub left: u32,
    /// Fraction bits of the other.
    pub right: u32,
}

/// Refuses two binary points.
pub(crate) const fn same_fraction(left: u32, right: u32) -> Result<(), FractionMismatch> {
    if left == right { Ok(()) } else { Err(FractionMismatch { left, right }) }
}

impl Unreduced {
    /// `raw` units of `2^-fraction`.
    #[inline]
    pub const fn new(raw: i128, fraction: u32) -> Self {
        Self { raw, fraction }
    }

    /// The value in units of `2^-fraction`.
    #[inline]
    pub const fn raw(self) -> i128 {
        self.raw
    }

    /// Bits below the binary point.
    #[inline]
    pub const fn fraction(self) -> u32 {
        self.fraction
    }

    /// The exact sum.
    ///
    /// # Errors
    /// [`FractionMismatch`] if the two count different units.
    pub fn try_add(self, other: Self) -> Result<Self, FractionMismatch> {
        same_fraction(self.fraction, other.fraction)?;
        Ok(Self { raw: self.raw + other.raw, ..self })
    }

    /// The word that holds this value mod 2^N.
    ///
    /// # Errors
    /// [`FractionMismatch`] if the word counts other units.
    pub fn reduce(self, format: QFormat) -> Result<Word<QFormat>, FractionMismatch> {
        same_fraction(self.fraction, format.fraction())?;
        Ok(Word::wrapping(format, self.raw))
    }
}

impl fmt::Debug for Unreduced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} * 2^-{}", self.raw, self.fraction)
    }
}

impl fmt::Display for Unreduced {
    /// The exact value in decimal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&decimal(self.raw, self.fraction))
    }
}
