//! What walks a channel's component, or 1/w: an accumulator with its read-out, as a unit of its own.
//! Spec clause `CH-16`.

use super::correct::Corrector;
use crate::format::ReadOut;

/// A component, or 1/w, along a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InterpolatorUnit {
    /// The accumulator and what is read of it: a code, or u/w and 1/w with their fraction.
    pub read: ReadOut,
    /// Whether what is read is two's complement.
    pub signed: bool,
    /// Bits of what is read that stand below the binary point.
    pub below: u32,
}

impl InterpolatorUnit {
    /// The unit of an accumulator; `whole` has its fraction read, too.
    pub fn new(read: ReadOut, signed: bool, whole: bool) -> Option<Self> {
        let below = if whole { read.fraction() } else { 0 };
        let (integer, fraction) = (read.integer() + below, read.fraction() - below);
        // The split of the guard range is the same pattern, wherever the binary point stands.
        let read = ReadOut::new(read.guard(), integer, fraction, read.clamp()).ok()?;
        Some(Self { read, signed, below })
    }

    /// What is added before the read-out, in units of what is read, and taken away after it.
    pub fn offset(&self) -> i128 {
        if self.signed { 1 << (self.read.integer() - 1) } else { 0 }
    }

    /// Bits of the accumulator below its binary point.
    pub fn fraction(&self) -> u32 {
        self.below + self.read.fraction()
    }

    /// The accumulator that is read: moved by the offset.
    pub fn seen(&self, accumulator: i128) -> i128 {
        accumulator.wrapping_add(self.offset() << self.read.fraction())
    }

    /// What is read of an accumulator.
    pub fn out(&self, accumulator: i128) -> i128 {
        i128::from(self.read.read(self.seen(accumulator))) - self.offset()
    }
}

impl Corrector {
    /// The unit that walks a component, or the component over w; `None` for a channel that is not walked.
    pub fn interpolator(&self) -> Option<InterpolatorUnit> {
        let config = self.config();
        let whole = config.correction.walks_w();
        let walked = whole || config.correction == super::Correction::Affine;
        InterpolatorUnit::new(self.read_out(), config.signed, whole).filter(|_| walked)
    }
}
