//! Exact conversion from and to the `fixed` crate's numbers. Spec clause `F-2`.
//!
//! The only file that knows the `fixed` crate; its trait is re-exported as [`Fixed`].

use super::q::{QFormat, QFormatError};
use crate::bits::{Width, Word, rescale};
use num_traits::AsPrimitive;

/// Any number type of the `fixed` crate, signed or unsigned, 8 to 128 bits.
pub use fixed::traits::Fixed;

impl QFormat {
    /// The format that holds every value of `T`: an unsigned type needs one more bit for the sign.
    ///
    /// # Errors
    /// [`QFormatError`] for a 128-bit unsigned type, or one whose point lies outside its word.
    pub fn of<T: Fixed>() -> Result<Self, QFormatError> {
        let sign = u32::from(!T::IS_SIGNED);
        let integer = T::INT_NBITS;
        let fraction = T::FRAC_NBITS;
        Self::new(integer.saturating_add(sign), fraction)
    }
}

impl<F: Width> Word<F> {
    /// A `fixed` number in this format, or `None` if it does not fit or would be rounded.
    ///
    /// ```
    /// use fixed::types::I22F10;
    /// use guardbit::{bits::Word, format::Q};
    /// let x = Word::from_fixed(Q::<13, 10>, I22F10::from_num(4095.5)).ok_or("does not fit")?;
    /// assert_eq!(x.to_bits(), 4095 << 10 | 512);
    /// assert_eq!(x.to_fixed::<I22F10>(), Some(I22F10::from_num(4095.5)));
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_fixed<T: Fixed>(format: F, value: T) -> Option<Self>
    where
        T::Bits: TryInto<i128>,
    {
        let from = T::FRAC_NBITS;
        let bits = rescale(value.to_bits().try_into().ok()?, from, format.fraction())?;
        Self::checked(format, bits)
    }

    /// This value as a `fixed` number, or `None` if it does not fit or would be rounded.
    pub fn to_fixed<T: Fixed>(self) -> Option<T>
    where
        T::Bits: 'static + Copy + AsPrimitive<i128>,
        i128: TryInto<T::Bits>,
    {
        let to = T::FRAC_NBITS;
        let bits = rescale(self.to_i128(), self.width().fraction(), to)?;
        Some(T::from_bits(bits.try_into().ok()?))
    }
}
