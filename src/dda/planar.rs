//! The planar DDA: one accumulator, an x slope and a y slope. Spec clause `D-3`.

use super::linear::Linear;
use crate::bits::{Width, Word};

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
pub struct Planar<W> {
    accumulator: Word<W>,
    dx: Word<W>,
    dy: Word<W>,
}

impl<W: Width> Planar<W> {
    /// Loads the accumulator.
    pub fn new(start: Word<W>, dx: Word<W>, dy: Word<W>) -> Self {
        Self { accumulator: start, dx, dy }
    }

    /// The present accumulator.
    pub fn accumulator(&self) -> Word<W> {
        self.accumulator
    }

    /// One pixel right.
    pub fn step_x(&mut self) {
        self.accumulator = self.accumulator.wrapping_add(self.dx);
    }

    /// One pixel left.
    pub fn back_x(&mut self) {
        self.accumulator = self.accumulator.wrapping_sub(self.dx);
    }

    /// One row down.
    pub fn step_y(&mut self) {
        self.accumulator = self.accumulator.wrapping_add(self.dy);
    }

    /// One row up.
    pub fn back_y(&mut self) {
        self.accumulator = self.accumulator.wrapping_sub(self.dy);
    }

    /// The accumulator `x` pixels right and `y` rows down from here, in closed form.
    pub fn at(&self, x: i128, y: i128) -> Word<W> {
        self.row(y).at(x)
    }

    /// The horizontal DDA `y` rows down from here.
    pub fn row(&self, y: i128) -> Linear<W> {
        Linear::new(self.accumulator.wrapping_add(self.dy.wrapping_mul(y)), self.dx)
    }
}
