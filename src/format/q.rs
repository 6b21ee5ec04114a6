//! Q-formats: a width and a binary point, as a zero-sized type or a record. Spec clause `F-1`.

use crate::bits::{RunTime, StaticWidth, Width, WidthError};

/// `I` integer bits (the sign included) and `F` fraction bits, fixed in the type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Q<const I: u32, const F: u32>;

impl<const I: u32, const F: u32> Width for Q<I, F> {
    #[inline]
    fn bits(self) -> u32 {
        const { assert!(1 <= I + F && I + F <= 128, "a word has 1 to 128 bits") };
        I + F
    }

    #[inline]
    fn fraction(self) -> u32 {
        F
    }
}

impl<const I: u32, const F: u32> StaticWidth for Q<I, F> {}

impl<const I: u32, const F: u32> std::fmt::Display for Q<I, F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Q{I}.{F}")
    }
}

/// The same, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QFormat {
    width: RunTime,
    fraction: u32,
}

/// More fraction bits than bits, or a width outside 1 to 128.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QFormatError {
    /// The width is out of range.
    #[error(transparent)]
    Width(#[from] WidthError),
    /// The sum of both fields does not fit any word.
    #[error(
        "integer bits + fraction bits = {integer} + {fraction} > 128: a word has at most 128 bits"
    )]
    Sum {
        /// Integer bits asked for.
        integer: u32,
        /// Fraction bits asked for.
        fraction: u32,
    },
}

impl QFormat {
    /// `integer` bits above the point (the sign included) and `fraction` bits below.
    ///
    /// # Errors
    /// [`QFormatError`] unless `1 <= integer + fraction <= 128`.
    pub fn new(integer: u32, fraction: u32) -> Result<Self, QFormatError> {
        let bits = integer.checked_add(fraction).ok_or(QFormatError::Sum { integer, fraction })?;
        Ok(Self { width: RunTime::new(bits)?, fraction })
    }

    /// A word of `bits` bits that counts units of `2^-fraction`. It may have fewer bits than the
    /// fraction: then it holds the lowest of them, and no integer bit.
    ///
    /// # Errors
    /// [`WidthError`] unless `1 <= bits <= 128`.
    pub fn of_width(bits: u32, fraction: u32) -> Result<Self, WidthError> {
        Ok(Self { width: RunTime::new(bits)?, fraction })
    }
}

impl Width for QFormat {
    #[inline]
    fn bits(self) -> u32 {
        self.width.bits()
    }

    #[inline]
    fn fraction(self) -> u32 {
        self.fraction
    }
}

impl std::fmt::Display for QFormat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (bits, fraction) = (self.bits(), self.fraction);
        if fraction <= bits {
            write!(f, "Q{}.{fraction}", bits - fraction)
        } else {
            write!(f, "{bits} bits of 2^-{fraction}")
        }
    }
}
