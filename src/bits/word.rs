//! A word of 1 to 128 bits whose width is a type or a value. Spec clauses `W-1` and `W-2`.

use super::lane::Lane;
use super::round::Rounding;
use super::status::{Event, Status};

/// The width of a word: one body serves a zero-sized type and a run-time record.
pub trait Width: Copy + Eq + std::fmt::Debug {
    /// Bits, 1 to 128.
    fn bits(self) -> u32;
}

/// A width fixed in the type. A width outside 1 to 128 does not compile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bits<const N: u32>;

impl<const N: u32> Width for Bits<N> {
    #[inline]
    fn bits(self) -> u32 {
        const { assert!(1 <= N && N <= 128, "a word has 1 to 128 bits") };
        N
    }
}

/// A width chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunTime(u32);

/// A width outside 1 to 128.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a word has 1 to 128 bits, not {0}")]
pub struct WidthError(pub u32);

impl RunTime {
    /// A width of `bits`.
    ///
    /// # Errors
    /// [`WidthError`] unless `1 <= bits <= 128`.
    pub const fn new(bits: u32) -> Result<Self, WidthError> {
        if 1 <= bits && bits <= 128 { Ok(Self(bits)) } else { Err(WidthError(bits)) }
    }
}

impl Width for RunTime {
    #[inline]
    fn bits(self) -> u32 {
        self.0
    }
}

/// A two's complement word of [`Width`] bits, kept left-justified.
///
/// Formats: N-bit integers; a binary point is the caller's. Range: -2^(N-1) to 2^(N-1)-1.
/// Overflow: named by the method (`wrapping_`, `saturating_`, `checked_`, `overflowing_`).
///
/// ```
/// use guardbit::bits::{Bits, Event, RunTime, Word};
/// let a = Word::wrapping(Bits::<5>, 12);
/// let (sum, status) = a.overflowing_add(Word::wrapping(Bits::<5>, 9));
/// assert_eq!(sum.to_bits(), 0b10101); // 21 reads as -11
/// assert!(status.has(Event::Wrap));
/// assert_eq!(Word::wrapping(RunTime::new(5)?, 21).to_i128(), -11);
/// # Ok::<(), guardbit::bits::WidthError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word<W> {
    lane: i128,
    width: W,
}

impl<W: Width> Word<W> {
    /// `value` mod 2^N.
    #[inline]
    pub fn wrapping(width: W, value: i128) -> Self {
        Self { lane: i128::justify(value, width.bits()), width }
    }

    /// `value`, or `None` if it does not fit.
    #[inline]
    pub fn checked(width: W, value: i128) -> Option<Self> {
        let word = Self::wrapping(width, value);
        (word.to_i128() == value).then_some(word)
    }

    /// `value`, or the nearer end of the range.
    #[inline]
    pub fn saturating(width: W, value: i128) -> Self {
        let largest = i128::MAX >> (128 - width.bits());
        Self::wrapping(width, value.clamp(!largest, largest))
    }

    /// The word with this raw pattern; bits above the width are dropped.
    #[inline]
    pub fn from_bits(width: W, bits: u128) -> Self {
        Self::wrapping(width, bits.cast_signed())
    }

    /// The raw pattern, zero-extended.
    #[inline]
    pub fn to_bits(self) -> u128 {
        self.lane.cast_unsigned() >> (128 - self.width.bits())
    }

    /// The signed value.
    #[inline]
    pub fn to_i128(self) -> i128 {
        self.lane.value(self.width.bits())
    }

    /// The width.
    #[inline]
    pub fn width(self) -> W {
        self.width
    }

    /// Sum mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_add(self, other: Self) -> Self {
        Self { lane: self.lane.wrapping_add(other.lane), width: self.width }
    }

    /// Difference mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_sub(self, other: Self) -> Self {
        Self { lane: self.lane.wrapping_sub(other.lane), width: self.width }
    }

    /// Product with an integer mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_mul(self, factor: i128) -> Self {
        Self { lane: self.lane.wrapping_mul(factor), width: self.width }
    }

    /// Sum mod 2^N, and whether the signed N-bit sum overflowed.
    #[inline]
    pub fn overflowing_add(self, other: Self) -> (Self, Status) {
        let (lane, wrapped) = self.lane.overflowing_add(other.lane);
        (Self { lane, width: self.width }, Status::when(Event::Wrap, wrapped))
    }

    /// Sum, or the end of the range that it passed.
    #[inline]
    #[must_use]
    pub fn saturating_add(self, other: Self) -> Self {
        // The lane saturates to all ones; what lies below the word is zero by definition.
        let below = 128 - self.width.bits();
        Self { lane: self.lane.saturating_add(other.lane) >> below << below, width: self.width }
    }

    /// Sum, or `None` when it does not fit.
    #[inline]
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let lane = self.lane.checked_add(other.lane)?;
        Some(Self { lane, width: self.width })
    }

    /// Drops `shift` low bits with one rounding; the width stays.
    #[inline]
    pub fn shift_right(self, shift: u32, rounding: Rounding) -> (Self, Status) {
        let (value, inexact) = rounding.shift_right(self.to_i128(), shift);
        let fits = Self::wrapping(self.width, value);
        // Only a shift by nothing can keep the lowest value, and rounding up halves at least.
        debug_assert_eq!(fits.to_i128(), value, "a right shift never grows");
        (fits, Status::when(Event::Inexact, inexact))
    }
}

impl<W: Width> std::fmt::LowerHex for Word<W> {
    /// The pattern in hexadecimal, zero-padded to whole nibbles.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&super::text::hex(self.to_bits(), self.width.bits()))
    }
}

impl<W: Width> std::fmt::Binary for Word<W> {
    /// The pattern in binary, exactly as many digits as the width.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:0width$b}", self.to_bits(), width = self.width.bits() as usize)
    }
}
