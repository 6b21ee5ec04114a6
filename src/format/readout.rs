//! Guard bits and their decoding on read-out. Spec clauses `G-1` to `G-6`.

use super::q::QFormat;
use crate::bits::{Event, Lane, Status, bounded};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a read-out does with a value outside `[0, 2^i)`. Spec clause `G-2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Clamp {
    /// No clamp: the low integer bits are the result.
    Wrap,
    /// The guard range is split equally above and below, for any number of guard bits.
    Guard,
    /// Two's complement: negative reads zero, too large reads the maximum.
    Sign,
    /// Sticky: each step writes the clamped value back into the accumulator. Kept to show what
    /// path dependence breaks.
    Saturate,
    /// As `Guard`, but leaving the guard range refuses the primitive.
    Error,
}

impl Clamp {
    /// Every mode.
    pub const ALL: [Self; 5] = [Self::Wrap, Self::Guard, Self::Sign, Self::Saturate, Self::Error];

    /// The name profiles use.
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// Value of the devices' parameter `MODE`; `hdl/dda.sv`, `hdl/dda.vhd` and the packages of a
    /// set have constants of these names and values. A device cannot refuse a primitive, so
    /// `error` has the code of the read-out that it decodes with, `guard`. Spec clause `J-1`.
    pub const fn code(self) -> u32 {
        self.row().1
    }

    /// Name and code of a mode.
    const fn row(self) -> (&'static str, u32) {
        match self {
            Self::Wrap => ("wrap", 0),
            Self::Guard => ("guard", 1),
            Self::Sign => ("sign", 2),
            Self::Saturate => ("saturate", 3),
            Self::Error => ("error", Self::Guard.code()),
        }
    }
}

/// An accumulator of `guard + integer + fraction` bits and how it is read.
///
/// Formats: accumulator Q(g+i).F, result unsigned of i bits. Rounding: floor of the fraction,
/// then the clamp. Units: the accumulator counts 2^-F of a result unit.
///
/// ```
/// use guardbit::format::{Clamp, ReadOut};
/// // Lecture A's table: one guard bit over two integer bits, values -2 to 5.
/// let read = ReadOut::new(1, 2, 0, Clamp::Guard)?;
/// let row: Vec<u64> = (-2..=5).map(|v| read.read(v)).collect();
/// assert_eq!(row, [0, 0, 0, 1, 2, 3, 3, 3]);
/// # Ok::<(), guardbit::format::ReadOutError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadOut {
    guard: u32,
    integer: u32,
    fraction: u32,
    clamp: Clamp,
}

/// Why a read-out cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadOutError {
    /// The guard split halves the integer range, so it needs one integer bit.
    #[error("integer = {integer}: a value has 1 to 64 integer bits")]
    Integer {
        /// Integer bits asked for.
        integer: u32,
    },
    /// The accumulator is wider than exact 128-bit evaluation allows.
    #[error(
        "guard + integer + interpolation = {guard} + {integer} + {fraction} = {}: \
         an accumulator has at most 120 bits", u64::from(*guard) + u64::from(*integer) + u64::from(*fraction)
    )]
    Width {
        /// Guard bits asked for.
        guard: u32,
        /// Integer bits asked for.
        integer: u32,
        /// Fraction bits asked for.
        fraction: u32,
    },
}

impl ReadOut {
    /// A read-out of the given shape.
    ///
    /// # Errors
    /// [`ReadOutError`] unless `1 <= integer <= 64` and `guard + integer + fraction <= 120`.
    pub fn new(
        guard: u32,
        integer: u32,
        fraction: u32,
        clamp: Clamp,
    ) -> Result<Self, ReadOutError> {
        if !(1..=64).contains(&integer) {
            return Err(ReadOutError::Integer { integer });
        }
        if u64::from(guard) + u64::from(integer) + u64::from(fraction) > 120 {
            return Err(ReadOutError::Width { guard, integer, fraction });
        }
        Ok(Self { guard, integer, fraction, clamp })
    }

    /// Accumulator width in bits.
    #[inline]
    pub const fn width(self) -> u32 {
        self.guard + self.integer + self.fraction
    }

    /// Guard bits.
    pub const fn guard(self) -> u32 {
        self.guard
    }

    /// Integer bits of the result.
    pub const fn integer(self) -> u32 {
        self.integer
    }

    /// Fraction (interpolation) bits.
    #[inline]
    pub const fn fraction(self) -> u32 {
        self.fraction
    }

    /// The clamp mode.
    #[inline]
    pub const fn clamp(self) -> Clamp {
        self.clamp
    }

    /// The accumulator's format: guard and integer bits above the binary point, the fraction below.
    pub fn format(self) -> QFormat {
        // `new` has bounded the width by 120.
        QFormat::of_width(self.width(), self.fraction)
            .unwrap_or_else(|error| unreachable!("{error}"))
    }

    /// The largest result, 2^i - 1.
    pub const fn maximum(self) -> u64 {
        u64::MAX >> (64 - self.integer)
    }

    /// One past the largest accumulator value that reads without a clamp: 2^(i+F).
    #[inline]
    pub const fn top(self) -> i128 {
        1 << (self.integer + self.fraction)
    }

    /// The half-open range of unwrapped accumulator values that the read-out can tell apart;
    /// leaving it is the event `wrap`. Spec clause `G-3`.
    #[inline]
    pub const fn range(self) -> (i128, i128) {
        let half = 1 << (self.width() - 1);
        match self.clamp {
            // The signed range moved up by 2^(i-1).
            Clamp::Guard | Clamp::Error => {
                let lowest = (self.top() >> 1) - half;
                (lowest, lowest + 2 * half)
            }
            Clamp::Sign => (-half, half),
            Clamp::Wrap => (0, self.top()),
            // A sticky accumulator never leaves its range: every excess is a clamp.
            Clamp::Saturate => (i128::MIN, i128::MAX),
        }
    }

    /// The accumulator as the signed representative that the read-out sees: the value mod 2^N,
    /// moved into [`ReadOut::range`] (for `Wrap`, mod 2^(i+F)).
    #[inline]
    pub const fn reduce(self, accumulator: i128) -> i128 {
        let (lowest, _) = self.range();
        match self.clamp {
            Clamp::Saturate => accumulator,
            Clamp::Wrap => accumulator & (self.top() - 1),
            // 2^N divides 2^128: what wraps here is taken away again.
            _ => (accumulator.wrapping_sub(lowest) & ((1 << self.width()) - 1)) + lowest,
        }
    }

    /// The result: floor, then clamp. Spec clause `G-1`.
    #[inline]
    pub fn read(self, accumulator: i128) -> u64 {
        let held = self.reduce(accumulator).clamp(0, self.top() - 1);
        bounded(held >> self.fraction)
    }

    /// Where the value that the read-out sees stands: 0 inside, 1 above, 2 below.
    #[inline]
    pub const fn zone(self, accumulator: i128) -> usize {
        let seen = self.reduce(accumulator);
        if seen < 0 {
            2
        } else if seen >= self.top() {
            1
        } else {
            0
        }
    }

    /// The events of reading this unwrapped value. Spec clause `V-2`.
    #[inline]
    pub const fn status(self, unwrapped: i128) -> Status {
        let (lowest, limit) = self.range();
        let mut status = Status::when(Event::Wrap, unwrapped < lowest || unwrapped >= limit);
        status = Status::union(
            status,
            Status::when(Event::ClampAbove, self.clamps() && unwrapped >= self.top()),
        );
        status =
            Status::union(status, Status::when(Event::ClampBelow, self.clamps() && unwrapped < 0));
        Status::union(
            status,
            Status::when(Event::Inexact, unwrapped & ((1 << self.fraction) - 1) != 0),
        )
    }

    /// Whether values outside `[0, 2^i)` are held at its ends.
    #[inline]
    pub const fn clamps(self) -> bool {
        !matches!(self.clamp, Clamp::Wrap)
    }

    /// One step of a sticky accumulator: the sum, held in `[0, 2^(i+F))`. Spec clause `G-5`.
    #[inline]
    pub fn saturating_step(self, accumulator: i128, step: i128) -> i128 {
        accumulator.saturating_add(step).clamp(0, self.top() - 1)
    }

    /// The same decoding for a left-justified lane, as two thresholds. `None` if the lane is too
    /// narrow, or the mode is sticky and so has no closed form.
    pub fn decode<L: Lane>(self) -> Option<Decode<L>> {
        let (width, bias) = match self.clamp {
            Clamp::Saturate => return None,
            // Modulo 2^(i+F) the guard bits are gone and nothing is left to clamp.
            Clamp::Wrap => (self.integer + self.fraction, 0),
            Clamp::Guard | Clamp::Error => (self.width(), self.top() >> 1),
            Clamp::Sign => (self.width(), 0),
        };
        // A result of all 32 bits would widen to 64 with its top bit as a sign.
        if width > L::BITS || (self.integer >= L::BITS && L::BITS < u64::BITS) {
            return None;
        }
        let half = 1i128 << (width - 1);
        let (low, high) = match self.clamp {
            Clamp::Wrap => (-half, half - 1),
            _ => (-bias, (self.top() - 1 - bias).min(half - 1)),
        };
        // Below the word the high threshold is all zeros, as every word in a lane is.
        Some(Decode {
            width,
            bias: L::justify(bias, width),
            low: L::justify(low, width),
            high: L::justify(high, width),
            shift: L::BITS - width + self.fraction,
        })
    }
}

/// A read-out prepared for a lane: subtract the bias once, then per sample two comparisons, the
/// bias back and a shift. The mode is data, so one kernel serves all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decode<L> {
    width: u32,
    bias: L,
    low: L,
    high: L,
    shift: u32,
}

impl<L: Lane> Decode<L> {
    /// An accumulator value (mod 2^N) as the biased lane word the other methods take.
    #[inline]
    pub fn load(&self, accumulator: i128) -> L {
        L::justify(accumulator, self.width).wrapping_sub(&self.bias)
    }

    /// A slope as a lane word.
    #[inline]
    pub fn slope(&self, slope: i128) -> L {
        L::justify(slope, self.width)
    }

    /// The lowest and highest biased words that read without a clamp.
    pub fn thresholds(&self) -> (L, L) {
        (self.low, self.high)
    }

    /// The result, as a lane integer that is not negative unless all of its bits are used.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
    pub fn read(&self, biased: L) -> L {
        let held = if biased < self.low { self.low } else { biased };
        let held = if held > self.high { self.high } else { held };
        held.wrapping_add(&self.bias).unsigned_shr(self.shift)
    }
}
