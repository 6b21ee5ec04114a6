//! Walks of a model's words, clock by clock, and its divisions: what simulators and Python call.

use super::Model;
use crate::bits::bounded;
use crate::dda::{Op, Walker};
use crate::format::ReadOut;
use crate::value::{Divided, InterpolatorUnit};

/// A depth accumulator or an interpolator with its read-out, or an edge word with its sign test; all zeros at
/// first.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    walker: Walker,
    inputs: [i128; 3],
    width: u32,
    shown: Shown,
}

/// What is read of a word.
#[derive(Clone, Copy, Debug)]
enum Shown {
    Depth,
    Inside,
    Component(InterpolatorUnit),
}

impl Model {
    /// A walk of the depth accumulator; `None` without depth. Spec clauses `D-1` and `G-1`.
    pub fn depth_walk(&self) -> Option<Walk> {
        let read = self.depth()?.read_out();
        Some(Walk::new(read, Shown::Depth))
    }

    /// A walk of an edge word; `None` for a machine that has none. Spec clause `C-5`.
    pub fn edge_walk(&self) -> Option<Walk> {
        let read = self.profile().form.edge()?.read_out()?;
        Some(Walk::new(read, Shown::Inside))
    }

    /// A walk of a component of channel `number`, or of the component over w; of 1/w with no number. `None`
    /// for a machine that does not add slopes from pixel to pixel, and where there is nothing to walk. Spec
    /// clause `CH-16`.
    pub fn interpolator_walk(&self, number: Option<usize>) -> Option<Walk> {
        let channels = self.channels().filter(|channels| channels.steps())?;
        let unit = match number {
            Some(number) => channels.corrector(number)?.interpolator(),
            None => InterpolatorUnit::new(channels.w_read_out()?, false, true),
        }?;
        Some(Walk::new(unit.read, Shown::Component(unit)))
    }

    /// The division of channel `number` at a sample: the words for the accumulators of u/w and 1/w, each taken
    /// mod 2^width. `None` for a channel that is not divided by 1/w. Spec clause `CH-5`.
    pub fn divide(&self, number: usize, [over, inverse]: [i128; 2]) -> Option<Divided> {
        let corrector = self.channels()?.corrector(number)?;
        let w = corrector.w_read_out().filter(|_| corrector.config().correction.walks_w())?;
        let word = |word: i128, read: ReadOut| {
            let above = i128::BITS - read.width();
            word << above >> above
        };
        Some(corrector.division(word(over, corrector.read_out()), word(inverse, w)))
    }
}

impl Walk {
    fn new(read: ReadOut, shown: Shown) -> Self {
        let walker = Walker::new(read, 0, 0, 0);
        Self { walker, inputs: [0; 3], width: read.width(), shown }
    }

    /// Bits of its words.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// One clock edge with these words at the inputs, each taken mod 2^width: the start, the slope
    /// to the right and the slope downward. Returns the word after it, zero-extended, and what is
    /// read from it: the read-out, as the bits of its word, or 1 for inside.
    pub fn clock(&mut self, op: Op, inputs: [i128; 3]) -> (u128, u64) {
        if inputs != self.inputs {
            let [init, dx, dy] = inputs;
            self.walker.rewire(init, dx, dy);
            self.inputs = inputs;
        }
        self.walker.clock(op);
        let pattern = self.walker.pattern();
        let shown = match self.shown {
            Shown::Depth => self.walker.out(),
            Shown::Inside => u64::from(pattern >> (self.width - 1) == 0),
            Shown::Component(unit) => {
                let out = unit.out(self.walker.accumulator());
                bounded(out.cast_unsigned() & ((1 << unit.read.integer()) - 1))
            }
        };
        (pattern, shown)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile;

    #[test]
    fn words_wrap_and_are_read() {
        let model = Model::new(&profile::load("tiny").expect("built in")).expect("valid");
        let mut walk = model.depth_walk().expect("tiny has depth");
        assert_eq!(walk.width(), 7);
        assert_eq!(walk.clock(Op::Load, [8, 0, 0]), (8, 1));
        assert_eq!(walk.clock(Op::StepX, [0, 56, 0]), (64, 7));
        // 1 guard bit over 3 integer bits: pattern 1100 is the first that counts as below zero.
        assert_eq!(walk.clock(Op::StepX, [0, 32, 0]), (96, 0));
        assert_eq!(walk.clock(Op::Hold, [1, 1, 1]), (96, 0));
        let mut edge = model.edge_walk().expect("tiny has edge words");
        assert_eq!(edge.clock(Op::Load, [0, 0, 0]), (0, 1));
        assert_eq!(edge.clock(Op::StepY, [0, 0, -1]), (63, 0));
        // The ends of the type are words like any other: 2^127 - 1 = -1 and -2^127 = 0 mod 2^7 and 2^6.
        assert_eq!(walk.clock(Op::Load, [i128::MAX, 0, 0]), (127, 0));
        assert_eq!(walk.clock(Op::StepX, [0, i128::MIN, 0]), (127, 0));
        assert_eq!(walk.clock(Op::StepX, [0, 2, 0]), (1, 0));
        assert_eq!(walk.clock(Op::Load, [i128::MIN, i128::MAX, 0]), (0, 0));
        assert_eq!(walk.clock(Op::StepX, [i128::MIN, i128::MAX, 0]), (127, 0));
        assert_eq!(edge.clock(Op::Load, [i128::MAX, 0, 0]), (63, 0));
        assert_eq!(edge.clock(Op::StepX, [0, 1, 0]), (0, 1));
    }
}
