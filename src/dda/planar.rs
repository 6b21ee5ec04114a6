//! The planar DDA: one accumulator, an x slope and a y slope. Spec clause `D-3`.

use super::linear::Linear;
use crate::bits::{Mismatch, StaticWidth, Width, Word};

/// A plane walked in any direction; every path to a sample reads the same bits.
///
/// ```
/// use guardbit::{bits::{Bits, Word}, dda::Planar};
/// let word = |v| Word::wrapping(Bits::<6>, v);
/// let mut plane = Planar::new(word(3), word(17), word(-9));
/// plane.step_x();
/// plane.step_y();
/// assert_eq!(plane.accumulator(), plane.at(0, 0));
/// assert_eq!(plane.accumulator().to_bits(), 11);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Planar<W: Width> {
    accumulator: Word<W>,
    dx: Word<W>,
    dy: Word<W>,
}

impl<W: StaticWidth> Planar<W> {
    /// Loads the accumulator; dx is the slope to the right, dy the slope downward.
    pub fn new(start: Word<W>, dx: Word<W>, dy: Word<W>) -> Self {
        Self { accumulator: start, dx, dy }
    }
}

impl<W: Width> Planar<W> {
    /// Loads the accumulator with words of a format chosen at run time; dx is the slope to the right,
    /// dy the slope downward.
    ///
    /// # Errors
    /// [`Mismatch`] if the formats differ.
    pub fn try_new(start: Word<W>, dx: Word<W>, dy: Word<W>) -> Result<Self, Mismatch<W>> {
        start.matches(dx)?;
        start.matches(dy)?;
        Ok(Self { accumulator: start, dx, dy })
    }

    /// The present accumulator.
    pub fn accumulator(&self) -> Word<W> {
        self.accumulator
    }

    /// One pixel right.
    pub fn step_x(&mut self) {
        self.accumulator = self.accumulator.sum(self.dx);
    }

    /// One pixel left.
    pub fn back_x(&mut self) {
        self.accumulator = self.accumulator.difference(self.dx);
    }

    /// One row down.
    pub fn step_y(&mut self) {
        self.accumulator = self.accumulator.sum(self.dy);
    }

    /// One row up.
    pub fn back_y(&mut self) {
        self.accumulator = self.accumulator.difference(self.dy);
    }

    /// The accumulator `x` pixels right and `y` rows down from here, in closed form.
    pub fn at(&self, x: i128, y: i128) -> Word<W> {
        self.row(y).at(x)
    }

    /// The horizontal DDA `y` rows down from here.
    pub fn row(&self, y: i128) -> Linear<W> {
        Linear::of_one_format(self.accumulator.sum(self.dy.wrapping_mul(y)), self.dx)
    }
}
