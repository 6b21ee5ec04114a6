//! The one-dimensional DDA. Spec clauses `D-1` and `D-2`.

use crate::bits::{Mismatch, StaticWidth, Status, Width, Word};

/// An accumulator and a slope of the same format.
///
/// Formats: both words share width and binary point. Overflow: every step wraps mod 2^N, so any
/// walk that returns reads the same bits as direct evaluation. Error: none beyond that of start
/// and slope.
///
/// ```
/// use guardbit::{bits::{Bits, Word}, dda::Linear};
/// let mut dda = Linear::new(Word::wrapping(Bits::<8>, 100), Word::wrapping(Bits::<8>, 60));
/// let start = dda.accumulator();
/// dda.step(); // 160 wraps to -96
/// assert_eq!(dda.accumulator().to_bits(), 160);
/// dda.step_back();
/// assert_eq!(dda.accumulator(), start);
/// assert_eq!(dda.at(1000).to_bits(), (100 + 60_000) % 256);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Linear<W: Width> {
    accumulator: Word<W>,
    slope: Word<W>,
}

impl<W: StaticWidth> Linear<W> {
    /// Loads the accumulator.
    pub fn new(start: Word<W>, slope: Word<W>) -> Self {
        Self { accumulator: start, slope }
    }
}

impl<W: Width> Linear<W> {
    /// Loads the accumulator with words of a format chosen at run time.
    ///
    /// # Errors
    /// [`Mismatch`] if the two formats differ.
    pub fn try_new(start: Word<W>, slope: Word<W>) -> Result<Self, Mismatch<W>> {
        start.matches(slope)?;
        Ok(Self { accumulator: start, slope })
    }

    /// For callers that know both words to have one format.
    pub(super) fn of_one_format(start: Word<W>, slope: Word<W>) -> Self {
        debug_assert_eq!(start.width(), slope.width(), "the caller's words have one format");
        Self { accumulator: start, slope }
    }

    /// The present accumulator.
    pub fn accumulator(&self) -> Word<W> {
        self.accumulator
    }

    /// One step forward.
    pub fn step(&mut self) {
        self.accumulator = self.accumulator.sum(self.slope);
    }

    /// One step forward; the status says whether the signed word wrapped.
    pub fn overflowing_step(&mut self) -> Status {
        let (next, status) = self.accumulator.sum_with_status(self.slope);
        self.accumulator = next;
        status
    }

    /// One step back, undoing [`Linear::step`] exactly.
    pub fn step_back(&mut self) {
        self.accumulator = self.accumulator.difference(self.slope);
    }

    /// The accumulator after `steps` steps, in closed form.
    pub fn at(&self, steps: i128) -> Word<W> {
        self.accumulator.sum(self.slope.wrapping_mul(steps))
    }
}
