//! What a sum does that its word cannot hold. Spec clause `W-2`.

use super::status::{Event, Status};
use super::word::{Width, Word};

/// An overflow policy as a value; the methods of [`Word`] carry the same policies in their names.
///
/// The guard clamp is not one of them: it decodes on read-out and leaves the accumulator alone
/// (see [`crate::format::Clamp`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Overflow {
    /// Keep the low bits.
    Wrap,
    /// Hold the nearer end of the range.
    Saturate,
    /// Refuse.
    Error,
}

/// A sum that does not fit its word, under [`Overflow::Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{left} + {right} does not fit a signed word of {width} bits")]
pub struct OverflowError {
    /// Left operand.
    pub left: i128,
    /// Right operand.
    pub right: i128,
    /// Width of the word.
    pub width: u32,
}

impl<W: Width> Word<W> {
    /// The sum under a policy chosen at run time, and what happened.
    ///
    /// ```
    /// use guardbit::bits::{Bits, Event, Overflow, Word};
    /// let word = |value| Word::wrapping(Bits::<5>, value);
    /// let (sum, status) = word(12).add(word(9), Overflow::Saturate)?;
    /// assert_eq!((sum.to_bits(), status.has(Event::ClampAbove)), (15, true));
    /// assert!(word(-12).add(word(-9), Overflow::Error).is_err());
    /// # Ok::<(), guardbit::bits::OverflowError>(())
    /// ```
    ///
    /// # Errors
    /// [`OverflowError`] when the sum does not fit and the policy is [`Overflow::Error`].
    pub fn add(self, other: Self, overflow: Overflow) -> Result<(Self, Status), OverflowError> {
        let (wrapped, status) = self.overflowing_add(other);
        if !status.has(Event::Wrap) {
            return Ok((wrapped, status));
        }
        match overflow {
            Overflow::Wrap => Ok((wrapped, status)),
            Overflow::Saturate => {
                // Two words of one sign overflow on the side of that sign.
                let below = self.to_i128() < 0;
                let event = if below { Event::ClampBelow } else { Event::ClampAbove };
                Ok((self.saturating_add(other), Status::when(event, true)))
            }
            Overflow::Error => Err(OverflowError {
                left: self.to_i128(),
                right: other.to_i128(),
                width: self.width().bits(),
            }),
        }
    }
}
