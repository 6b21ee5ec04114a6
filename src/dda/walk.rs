//! The register-transfer view of a planar DDA: one operation a clock. Spec clause `D-4`.

use crate::bits::Status;
use crate::format::{Clamp, ReadOut};

/// What the DDA does at a clock edge; the discriminants are the codes of vector files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Op {
    /// Take the start value.
    Load = 0,
    /// Add the x slope.
    StepX = 1,
    /// Add the y slope.
    StepY = 2,
    /// Keep the accumulator.
    Hold = 3,
}

impl Op {
    /// The operation with this code; only the low two bits count.
    pub const fn from_code(code: u64) -> Self {
        match code & 3 {
            0 => Self::Load,
            1 => Self::StepX,
            2 => Self::StepY,
            _ => Self::Hold,
        }
    }
}

/// A DDA register with its read-out, clocked by [`Op`]s, for any clamp mode, the sticky one
/// included. Plain `i128` arithmetic mod 2^N.
#[derive(Clone, Copy, Debug)]
pub struct Walker {
    read: ReadOut,
    start: i128,
    dx: i128,
    dy: i128,
    accumulator: i128,
}

impl Walker {
    /// A walker over words of the read-out's width; arguments are taken mod 2^N, slopes signed.
    pub fn new(read: ReadOut, start: i128, dx: i128, dy: i128) -> Self {
        let signed = |value: i128| {
            let unused = 128 - read.width();
            value << unused >> unused
        };
        let (dx, dy) = (signed(dx), signed(dy));
        let start = Self::held(read, start);
        Self { read, start, dx, dy, accumulator: start }
    }

    fn held(read: ReadOut, start: i128) -> i128 {
        if read.clamp() == Clamp::Saturate {
            let unused = 128 - read.width();
            // Without guard bits every pattern is a value of the range.
            let unsigned = start.cast_unsigned() << unused >> unused;
            let loaded =
                if read.guard() == 0 { unsigned.cast_signed() } else { start << unused >> unused };
            read.saturating_step(loaded, 0)
        } else {
            start
        }
    }

    /// Other words at the inputs; the accumulator stays as it is.
    pub fn rewire(&mut self, start: i128, dx: i128, dy: i128) {
        *self = Self { accumulator: self.accumulator, ..Self::new(self.read, start, dx, dy) };
    }

    /// One clock edge.
    #[inline]
    pub fn clock(&mut self, op: Op) {
        let step = match op {
            Op::Load => {
                self.accumulator = self.start;
                return;
            }
            Op::StepX => self.dx,
            Op::StepY => self.dy,
            Op::Hold => return,
        };
        self.accumulator = if self.read.clamp() == Clamp::Saturate {
            self.read.saturating_step(self.accumulator, step)
        } else {
            self.accumulator.wrapping_add(step)
        };
    }

    /// The accumulator after `y` steps downward and then `x` to the right, in closed form: steps of
    /// one sign held one by one end where their sum, held once, does. Spec clause `G-5`.
    #[inline]
    pub fn path(&self, x: i128, y: i128) -> i128 {
        if self.read.clamp() != Clamp::Saturate {
            return self.start + self.dy * y + self.dx * x;
        }
        // Further than the whole range is as far as the range.
        let top = self.read.top();
        let go = |from, slope: i128, steps| {
            self.read.saturating_step(from, slope.saturating_mul(steps).clamp(-top, top))
        };
        go(go(self.start, self.dy, y), self.dx, x)
    }

    /// The accumulator, unreduced; a sticky one lies in `[0, 2^(i+F))`.
    #[inline]
    pub fn accumulator(&self) -> i128 {
        self.accumulator
    }

    /// The accumulator's pattern, N bits, zero-extended.
    #[inline]
    pub fn pattern(&self) -> u128 {
        self.accumulator.cast_unsigned() & ((1 << self.read.width()) - 1)
    }

    /// The clamped read-out.
    #[inline]
    pub fn out(&self) -> u64 {
        self.read.read(self.accumulator)
    }

    /// The events of the unwrapped accumulator.
    pub fn status(&self) -> Status {
        self.read.status(self.accumulator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_its_steps() {
        for clamp in Clamp::ALL {
            for guard in 0..=1 {
                let Ok(read) = ReadOut::new(guard, 2, 1, clamp) else { continue };
                for words in 0..16 * 16 * 16 {
                    let (start, dx, dy) = (words % 16, words / 16 % 16 - 8, words / 256 - 8);
                    for (x, y) in [(0, 0), (1, 0), (0, 2), (3, 1), (2, 5)] {
                        let mut walk = Walker::new(read, start, dx, dy);
                        let path = walk.path(x, y);
                        (0..y).for_each(|_| walk.clock(Op::StepY));
                        (0..x).for_each(|_| walk.clock(Op::StepX));
                        assert_eq!(path, walk.accumulator, "{read:?} {start} {dx} {dy} {x} {y}");
                    }
                }
            }
        }
    }
}
