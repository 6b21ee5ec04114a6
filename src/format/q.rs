//! Q-formats: a width and a binary point, as a zero-sized type or a record. Spec clause `F-1`.

use crate::bits::{RunTime, Width, WidthError, Word};

/// A signed fixed-point format: a [`Width`] with a binary point.
pub trait Format: Width {
    /// Bits below the binary point.
    fn fraction(self) -> u32;

    /// Bits above the binary point, the sign included.
    fn integer(self) -> u32 {
        self.bits() - self.fraction()
    }
}

/// `I` integer bits (the sign included) and `F` fraction bits, fixed in the type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Q<const I: u32, const F: u32>;

impl<const I: u32, const F: u32> Width for Q<I, F> {
    #[inline]
    fn bits(self) -> u32 {
        const { assert!(1 <= I + F && I + F <= 128, "a word has 1 to 128 bits") };
        I + F
    }
}

impl<const I: u32, const F: u32> Format for Q<I, F> {
    #[inline]
    fn fraction(self) -> u32 {
        F
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
    #[error("{integer} integer + {fraction} fraction bits are more than a word can have (128)")]
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
}

impl Width for QFormat {
    #[inline]
    fn bits(self) -> u32 {
        self.width.bits()
    }
}

impl Format for QFormat {
    #[inline]
    fn fraction(self) -> u32 {
        self.fraction
    }
}

impl<F: Format> Word<F> {
    /// The same value in another format, or `None` if it does not fit or would be rounded.
    ///
    /// ```
    /// use guardbit::{bits::Word, format::Q};
    /// let half = Word::wrapping(Q::<4, 4>, 8);
    /// assert_eq!(half.checked_convert(Q::<2, 1>).map(|w| w.to_bits()), Some(1));
    /// assert_eq!(half.checked_convert(Q::<2, 0>), None); // one half has no integer
    /// ```
    pub fn checked_convert<G: Format>(self, format: G) -> Option<Word<G>> {
        let bits = rescale(self.to_i128(), self.width().fraction(), format.fraction())?;
        Word::checked(format, bits)
    }
}

/// `bits / 2^from` as a multiple of `2^-to`, if it is one and fits.
pub(super) fn rescale(bits: i128, from: u32, to: u32) -> Option<i128> {
    if bits == 0 {
        return Some(0);
    }
    if to >= from {
        let up = to - from;
        let scaled = if up < 128 { bits << up } else { 0 };
        (up < 128 && scaled >> up == bits).then_some(scaled)
    } else {
        let down = from - to;
        let kept = bits >> down.min(127);
        (down <= bits.trailing_zeros()).then_some(kept)
    }
}
