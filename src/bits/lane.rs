//! The machine integers that carry left-justified words. Spec clause `W-3`.

use num_traits::{AsPrimitive, PrimInt, Signed, WrappingAdd, WrappingMul, WrappingSub};

/// A two's complement machine integer holding an N-bit word in its top N bits, zeros below.
///
/// Then the lane's own wrapping addition *is* the N-bit wrap, the sign is the lane's sign, and a
/// width chosen at run time costs nothing.
///
/// ```
/// use guardbit::bits::Lane;
/// // 5-bit words in a 32-bit lane: 15 + 1 wraps to -16.
/// let sum = i32::justify(15, 5).wrapping_add(i32::justify(1, 5));
/// assert_eq!(sum.value(5), -16);
/// ```
pub trait Lane:
    PrimInt
    + Signed
    + WrappingAdd
    + WrappingSub
    + WrappingMul
    + AsPrimitive<i128>
    + AsPrimitive<u64>
    + Send
    + Sync
    + std::fmt::Debug
    + 'static
{
    /// Bits of the lane.
    const BITS: u32;

    /// The low bits of `value`; what does not fit is cut off.
    fn truncate(value: i128) -> Self;

    /// `value` mod 2^width, left-justified. Range: `1 <= width <= Self::BITS`.
    #[inline]
    fn justify(value: i128, width: u32) -> Self {
        debug_assert!((1..=Self::BITS).contains(&width), "1 <= {width} <= {}", Self::BITS);
        Self::truncate(value).unsigned_shl(Self::BITS - width)
    }

    /// The signed value of a left-justified word of `width` bits.
    #[inline]
    fn value(self, width: u32) -> i128 {
        let value: i128 = self.as_();
        value >> (Self::BITS - width)
    }
}

macro_rules! lanes {
    ($($lane:ty),*) => {$(
        impl Lane for $lane {
            const BITS: u32 = <$lane>::BITS;
            #[inline]
            #[allow(clippy::cast_possible_truncation, reason = "dropping the high bits is the N-bit wrap")]
            fn truncate(value: i128) -> Self {
                value as Self
            }
        }
    )*};
}

lanes!(i32, i64, i128);
