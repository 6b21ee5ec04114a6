//! What a sum does that its word cannot hold. Spec clause `W-2`.

use super::status::{Event, Status};
use super::word::{Mismatch, Width, Word};

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

/// Why there is no sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SumError<W: Width> {
    /// Two formats.
    #[error(transparent)]
    Mismatch(#[from] Mismatch<W>),
    /// A sum that does not fit its word, under [`Overflow::Error`].
    #[error("{left} + {right} does not fit a signed word of {format}")]
    Overflow {
        /// Left operand.
        left: Word<W>,
        /// Right operand.
        right: Word<W>,
        /// Format of the word.
        format: W,
    },
}

impl<W: Width> Word<W> {
    /// The sum under a policy chosen at run time, and what happened.
    ///
    /// ```
    /// use guardbit::bits::{Bits, Event, Overflow, Word};
    /// let word = |value| Word::wrapping(Bits::<5>, value);
    /// let (sum, status) = word(12).add_with(word(9), Overflow::Saturate)?;
    /// assert_eq!((sum.to_bits(), status.has(Event::ClampAbove)), (15, true));
    /// assert!(word(-12).add_with(word(-9), Overflow::Error).is_err());
    /// # Ok::<(), guardbit::bits::SumError<Bits<5>>>(())
    /// ```
    ///
    /// # Errors
    /// [`SumError`] when the formats differ, or the sum does not fit and the policy is
    /// [`Overflow::Error`].
    pub fn add_with(self, other: Self, overflow: Overflow) -> Result<(Self, Status), SumError<W>> {
        self.matches(other)?;
        let (wrapped, status) = self.sum_with_status(other);
        if !status.has(Event::Wrap) {
            return Ok((wrapped, status));
        }
        match overflow {
            Overflow::Wrap => Ok((wrapped, status)),
            Overflow::Saturate => {
                // Two words of one sign overflow on the side of that sign.
                let below = self.to_i128() < 0;
                let event = if below { Event::ClampBelow } else { Event::ClampAbove };
                Ok((self.saturated_sum(other), Status::when(event, true)))
            }
            Overflow::Error => {
                Err(SumError::Overflow { left: self, right: other, format: self.width() })
            }
        }
    }
}
