//! A word of 1 to 128 bits whose width is a type or a value. Spec clauses `W-1`, `W-2` and `F-1`.

use super::lane::Lane;
use super::round::Rounding;
use super::status::{Event, Status};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// The format of a word: its width, and where its binary point stands. One body serves a zero-sized
/// type and a run-time record.
pub trait Width: Copy + Eq + fmt::Debug + fmt::Display {
    /// Bits, 1 to 128.
    fn bits(self) -> u32;

    /// Bits below the binary point; an integer has none.
    fn fraction(self) -> u32 {
        0
    }

    /// Bits above the binary point, the sign included; none where the fraction takes all bits.
    fn integer(self) -> u32 {
        self.bits().saturating_sub(self.fraction())
    }
}

/// A width that is a type: two words of it always have the same format, which the compiler sees.
pub trait StaticWidth: Width + Default {}

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

impl<const N: u32> StaticWidth for Bits<N> {}

impl<const N: u32> fmt::Display for Bits<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{N} bits")
    }
}

/// A width chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunTime(u32);

/// A width outside 1 to 128.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0} bits: a word has 1 to 128 bits")]
pub struct WidthError(pub u32);

/// Words of two formats in one operation. Only formats chosen at run time can differ; where they are
/// types, such an operation does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the operands have different formats, {left} and {right}; convert one operand to the format of the other"
)]
pub struct Mismatch<W: Width> {
    /// Format of the left operand.
    pub left: W,
    /// Format of the right operand.
    pub right: W,
}

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

impl fmt::Display for RunTime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bits", self.0)
    }
}

/// A two's complement word of [`Width`] bits, kept left-justified.
///
/// Formats: N bits, of which [`Width::fraction`] lie below the binary point. Range: -2^(N-1) to
/// 2^(N-1)-1 units of 2^-F. Overflow: the operators wrap, as registers do; elsewhere the method's name
/// says it (`wrapping_`, `saturating_`, `checked_`, `overflowing_`).
///
/// Words whose format is a type never mix with others. Words of a format chosen at run time have no
/// operators: [`Word::try_add`] and [`Word::try_sub`] refuse two formats.
///
/// ```
/// use guardbit::bits::{Bits, Event, RunTime, Word};
/// let a = Word::wrapping(Bits::<5>, 12);
/// let (sum, status) = a.overflowing_add(Word::wrapping(Bits::<5>, 9));
/// assert_eq!(sum.to_bits(), 0b10101); // 21 reads as -11
/// assert!(status.has(Event::Wrap));
/// assert_eq!(a + Word::wrapping(Bits::<5>, 9), sum);
/// let [five, eight] = [RunTime::new(5)?, RunTime::new(8)?];
/// let refused = Word::wrapping(eight, 100).try_add(Word::wrapping(five, 3)).unwrap_err();
/// assert!(refused.to_string().contains("different formats, 8 bits and 5 bits"));
/// # Ok::<(), guardbit::bits::WidthError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
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

    /// Product with an integer mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_mul(self, factor: i128) -> Self {
        Self { lane: self.lane.wrapping_mul(factor), width: self.width }
    }

    /// Sum mod 2^N of words of one format.
    ///
    /// # Errors
    /// [`Mismatch`] if the formats differ.
    #[inline]
    pub fn try_add(self, other: Self) -> Result<Self, Mismatch<W>> {
        self.matches(other)?;
        Ok(self.sum(other))
    }

    /// Difference mod 2^N of words of one format.
    ///
    /// # Errors
    /// [`Mismatch`] if the formats differ.
    #[inline]
    pub fn try_sub(self, other: Self) -> Result<Self, Mismatch<W>> {
        self.matches(other)?;
        Ok(self.difference(other))
    }

    /// Refuses a word of another format.
    #[inline]
    pub(crate) fn matches(self, other: Self) -> Result<(), Mismatch<W>> {
        let (left, right) = (self.width, other.width);
        if left == right { Ok(()) } else { Err(Mismatch { left, right }) }
    }

    /// Sum mod 2^N, for callers that know both to have one format.
    #[inline]
    pub(crate) fn sum(self, other: Self) -> Self {
        debug_assert_eq!(self.width, other.width, "the caller's words have one format");
        Self { lane: self.lane.wrapping_add(other.lane), width: self.width }
    }

    /// Difference mod 2^N, for callers that know both to have one format.
    #[inline]
    pub(crate) fn difference(self, other: Self) -> Self {
        debug_assert_eq!(self.width, other.width, "the caller's words have one format");
        Self { lane: self.lane.wrapping_sub(other.lane), width: self.width }
    }

    /// The same with the event of the signed sum, for callers that know both to have one format.
    #[inline]
    pub(crate) fn sum_with_status(self, other: Self) -> (Self, Status) {
        let (_, wrapped) = self.lane.overflowing_add(other.lane);
        (self.sum(other), Status::when(Event::Wrap, wrapped))
    }

    /// The same, held at the end of the range that it passed.
    #[inline]
    pub(crate) fn saturated_sum(self, other: Self) -> Self {
        debug_assert_eq!(self.width, other.width, "the caller's words have one format");
        // The lane saturates to all ones; what lies below the word is zero by definition.
        let below = 128 - self.width.bits();
        Self { lane: self.lane.saturating_add(other.lane) >> below << below, width: self.width }
    }

    /// The same value in another format, or `None` if it does not fit or would be rounded.
    ///
    /// ```
    /// use guardbit::{bits::Word, format::Q};
    /// let half = Word::wrapping(Q::<4, 4>, 8);
    /// assert_eq!(half.checked_convert(Q::<2, 1>).map(|w| w.to_bits()), Some(1));
    /// assert_eq!(half.checked_convert(Q::<2, 0>), None); // one half has no integer
    /// ```
    pub fn checked_convert<V: Width>(self, format: V) -> Option<Word<V>> {
        let bits = rescale(self.to_i128(), self.width.fraction(), format.fraction())?;
        Word::checked(format, bits)
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

/// Words of one format by the type: nothing to refuse.
impl<W: StaticWidth> Word<W> {
    /// Sum mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_add(self, other: Self) -> Self {
        self.sum(other)
    }

    /// Difference mod 2^N.
    #[inline]
    #[must_use]
    pub fn wrapping_sub(self, other: Self) -> Self {
        self.difference(other)
    }

    /// Sum mod 2^N, and whether the signed N-bit sum overflowed.
    #[inline]
    pub fn overflowing_add(self, other: Self) -> (Self, Status) {
        self.sum_with_status(other)
    }

    /// Sum, or the end of the range that it passed.
    #[inline]
    #[must_use]
    pub fn saturating_add(self, other: Self) -> Self {
        self.saturated_sum(other)
    }

    /// Sum, or `None` when it does not fit.
    #[inline]
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let (sum, status) = self.sum_with_status(other);
        status.is_none().then_some(sum)
    }
}

/// The operators wrap mod 2^N.
impl<W: StaticWidth> Add for Word<W> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.sum(other)
    }
}

impl<W: StaticWidth> Sub for Word<W> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.difference(other)
    }
}

impl<W: StaticWidth> AddAssign for Word<W> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = self.sum(other);
    }
}

impl<W: StaticWidth> SubAssign for Word<W> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = self.difference(other);
    }
}

/// Wraps mod 2^N: the lowest value is its own negative.
impl<W: Width> Neg for Word<W> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { lane: self.lane.wrapping_neg(), width: self.width }
    }
}

/// Wraps mod 2^N.
impl<W: Width> Mul<i128> for Word<W> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: i128) -> Self {
        self.wrapping_mul(factor)
    }
}

/// By value; words of two formats have no order.
impl<W: Width> PartialOrd for Word<W> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        (self.width == other.width).then(|| self.lane.cmp(&other.lane))
    }
}

impl<W: StaticWidth> Ord for Word<W> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.lane.cmp(&other.lane)
    }
}

impl<W: Width> fmt::Debug for Word<W> {
    /// The value in units of the last place, and the format.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.to_i128(), self.width)
    }
}

impl<W: Width> fmt::Display for Word<W> {
    /// The exact value in decimal.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&decimal(self.to_i128(), self.width.fraction()))
    }
}

impl<W: Width> fmt::LowerHex for Word<W> {
    /// The pattern in hexadecimal, zero-padded to whole nibbles.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&super::text::hex(self.to_bits(), self.width.bits()))
    }
}

impl<W: Width> fmt::Binary for Word<W> {
    /// The pattern in binary, exactly as many digits as the width.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:0width$b}", self.to_bits(), width = self.width.bits() as usize)
    }
}

/// `bits / 2^from` as a multiple of `2^-to`, if it is one and fits.
pub(crate) fn rescale(bits: i128, from: u32, to: u32) -> Option<i128> {
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

/// `value / 2^fraction` in decimal, exactly: a binary fraction of F bits has at most F decimals.
pub(crate) fn decimal(value: i128, fraction: u32) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let magnitude = value.unsigned_abs();
    if fraction > 124 {
        // Ten times the rest would outgrow 128 bits.
        return format!("{sign}{magnitude}/2^{fraction}");
    }
    let mut rest = magnitude & ((1 << fraction) - 1);
    let mut text = format!("{sign}{}", magnitude >> fraction);
    if rest != 0 {
        text.push('.');
    }
    while rest != 0 {
        rest *= 10;
        let digit = (rest >> fraction).to_le_bytes()[0];
        text.push(char::from(b'0' + digit));
        rest &= (1 << fraction) - 1;
    }
    text
}
