//! A stepper as hardware has it: a multiplexer, an adder, a register and a read-out, over a
//! [`Path`]. Clauses `D-4`, `G-1` to `G-5` and `C-5`.

use super::fault::{Operator, Path, Relation, low_ones, sign_extend};
use crate::dda::Op;
use crate::format::{Clamp, ReadOut};

/// What the parts of a stepper are called.
#[derive(Debug)]
pub(super) struct Names {
    module: &'static str,
    operation: &'static str,
    operation_late: &'static str,
    base: &'static str,
    addend: &'static str,
    addend_late: &'static str,
    sum_late: &'static str,
    steps: &'static str,
    init: &'static str,
    dx: &'static str,
    dy: &'static str,
    adder: &'static str,
    word: &'static str,
}

/// The parts of a depth DDA.
pub(super) const DEPTH: Names = Names {
    module: "dda",
    operation: "operation of the DDA",
    operation_late: "the operation of the DDA",
    base: "first operand of the DDA's adder",
    addend: "second operand of the DDA's adder",
    addend_late: "the second operand of the DDA's adder",
    sum_late: "the sum in the DDA",
    steps: "what steps of the DDA are",
    init: "init in the DDA",
    dx: "dx in the DDA",
    dy: "dy in the DDA",
    adder: "the DDA's adder",
    word: "the accumulator",
};

/// The parts of an edge stepper.
pub(super) const EDGE: Names = Names {
    module: "edge_stepper",
    operation: "operation of the edge stepper",
    operation_late: "the operation of the edge stepper",
    base: "first operand of the edge adder",
    addend: "second operand of the edge adder",
    addend_late: "the second operand of the edge adder",
    sum_late: "the edge sum",
    steps: "what steps of the edge stepper are",
    init: "init in the edge stepper",
    dx: "dx in the edge stepper",
    dy: "dy in the edge stepper",
    adder: "the edge adder",
    word: "the edge word",
};

/// The parts of an interpolator.
const VALUE: Names = Names {
    module: "interpolator",
    operation: "operation of the interpolator",
    operation_late: "the operation of the interpolator",
    base: "first operand of the interpolator's adder",
    addend: "second operand of the interpolator's adder",
    addend_late: "the second operand of the interpolator's adder",
    sum_late: "the sum in the interpolator",
    steps: "what steps of the interpolator are",
    init: "init in the interpolator",
    dx: "dx in the interpolator",
    dy: "dy in the interpolator",
    adder: "the interpolator's adder",
    word: "the accumulator",
};

/// A stepper.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stepper {
    pub(super) names: &'static Names,
    /// Bits of its words.
    pub(super) width: u32,
    /// The integer range that a sticky accumulator is kept in: its number of bits, and whether the
    /// start has a sign.
    sticky: Option<(u32, bool)>,
}

impl Stepper {
    /// A depth DDA.
    pub(super) fn depth(read: ReadOut) -> Self {
        let range = (read.integer() + read.fraction(), read.guard() > 0);
        let sticky = (read.clamp() == Clamp::Saturate).then_some(range);
        Self { names: &DEPTH, width: read.width(), sticky }
    }

    /// An edge stepper.
    pub(super) fn edge(width: u32) -> Self {
        Self { names: &EDGE, width, sticky: None }
    }

    /// An interpolator.
    pub(super) fn value(width: u32) -> Self {
        Self { names: &VALUE, width, sticky: None }
    }

    /// The word after a clock edge.
    pub(super) fn clock(&self, path: &Path, word: i128, op: Op, words: [i128; 3]) -> i128 {
        path.within(self.names.module, || self.next(path, word, op, words))
    }

    fn next(&self, path: &Path, word: i128, op: Op, words: [i128; 3]) -> i128 {
        let names = self.names;
        let codes = ["a load", "a step right", "a step down", "a hold"];
        let late = path.clocked(names.operation_late, op as i128);
        let op = usize::try_from(late).unwrap_or_else(|_| unreachable!("a code of 0 to 3"));
        let pick = path.code(names.operation, op, codes);
        let [init, dx, dy] = words;
        let init = path.word(names.init, init, self.width);
        let dx = path.word(names.dx, dx, self.width);
        let dy = path.word(names.dy, dy, self.width);
        let near = [("dx", dx), ("dy", dy), ("init", init)];
        let base = path.choose_near(
            names.base,
            pick,
            [
                ("zero on a load", 0),
                ("the word on a step right", word),
                ("the word on a step down", word),
                ("the word on a hold", word),
            ],
            near,
        );
        let operands = [("init", init), ("dx", dx), ("dy", dy), ("zero on a hold", 0)];
        let near = [
            ("the word itself", word),
            ("minus dx", dx.wrapping_neg()),
            ("minus dy", dy.wrapping_neg()),
            ("one", 1),
            ("minus one", -1),
        ];
        let addend = path.choose_near(names.addend, pick, operands, near);
        let addend = path.clocked(names.addend_late, addend);
        let subtracted = [("subtracted", addend.wrapping_neg())];
        let is_step = pick > 0;
        let addend =
            if is_step { path.only(names.steps, ("added", addend), subtracted) } else { addend };
        let sum = path.sum(names.adder, Operator::Add, [base, addend], self.width);
        let sum = path.clocked(names.sum_late, sum);
        let next = self
            .sticky
            .map_or(sum, |range| self.kept_in_range(path, range, pick == 0, base, addend));
        path.word(names.word, next, self.width)
    }

    fn kept_in_range(
        &self,
        path: &Path,
        (bits, start_is_signed): (u32, bool),
        load: bool,
        base: i128,
        addend: i128,
    ) -> i128 {
        let unsigned = path.when("a start without a sign", load && !start_is_signed);
        let addend = if unsigned { addend } else { sign_extend(addend, self.width) };
        let sum = path.sum("the saturating adder", Operator::Add, [base, addend], self.width);
        let below = path.compare("sum below zero", sum, Relation::Less, 0);
        let above = path.compare("sum above the range", sum, Relation::GreaterOrEqual, 1 << bits);
        let pick = if below {
            0
        } else if above {
            1
        } else {
            2
        };
        path.choose(
            "what the accumulator saturates to",
            pick,
            [("zero", 0), ("the maximum", low_ones(bits)), ("the sum", sum)],
        )
    }
}

/// What a depth read-out shows of an accumulator.
pub(super) fn read(path: &Path, format: ReadOut, word: i128) -> i128 {
    path.within(DEPTH.module, || read_out(path, format, word))
}

/// What a read-out shows of an accumulator, in the module that the path is in.
pub(super) fn read_out(path: &Path, read: ReadOut, word: i128) -> i128 {
    let (guard, integer, fraction) = (read.guard(), read.integer(), read.fraction());
    let bits = guard + integer;
    let half = if fraction > 0 { 1 << (fraction - 1) } else { 0 };
    let rounded = (word + half) & low_ones(read.width());
    let word = path.only(
        "what the read-out drops",
        ("the fraction", word),
        [("the fraction, rounded to nearest,", rounded)],
    );
    let u = path.word("the guard and integer bits", word >> fraction, bits);
    let clamp = read.clamp();
    let (mut low, mut high) = (false, false);
    if matches!(clamp, Clamp::Guard | Clamp::Error | Clamp::Sign) {
        let whole = 1i128 << integer;
        let outside = path.compare("above the integer range", u, Relation::GreaterOrEqual, whole);
        let upper = if clamp == Clamp::Sign {
            path.when("the sign of the accumulator", word >> (read.width() - 1) & 1 == 1)
        } else {
            // The patterns above the integer range are split in the middle.
            let middle = (1i128 << bits >> 1) + (whole >> 1);
            let upper = path.compare(
                "in the upper half of the guard range",
                u,
                Relation::GreaterOrEqual,
                middle,
            );
            path.all("what counts as below zero (outside, upper half)", [outside, upper])
        };
        low = path.when("clamp to zero", upper);
        high = path.when("clamp to the maximum", outside && !low);
    }
    let pick = if low {
        0
    } else if high {
        1
    } else {
        2
    };
    let out = path.choose_near(
        "what is read out",
        pick,
        [("zero", 0), ("the maximum", low_ones(integer)), ("the integer bits", u)],
        [("the maximum less one", low_ones(integer) - 1), ("one", 1)],
    );
    path.word("the read-out's output", out, integer)
}

/// Whether a sign test takes an edge word for inside.
pub(super) fn inside(path: &Path, width: u32, word: i128) -> bool {
    path.within(EDGE.module, || {
        let word = path.signed("the word at the sign test", word, width);
        path.compare("the sign test of an edge word", word, Relation::GreaterOrEqual, 0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dda::Walker;

    #[test]
    fn without_a_fault_it_is_the_walker_of_every_small_format() {
        for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign, Clamp::Saturate] {
            for (guard, integer, fraction) in
                [(0, 2, 1), (1, 2, 1), (2, 2, 0), (3, 1, 1), (1, 3, 2)]
            {
                let Ok(read_out) = ReadOut::new(guard, integer, fraction, clamp) else { continue };
                let (path, width) = (Path::right(), read_out.width());
                let stepper = Stepper::depth(read_out);
                for init in 0..1i128 << width {
                    for dx in 0..1i128 << width {
                        let words = [init, dx, 1].map(|word| sign_extend(word, width));
                        let mut walker = Walker::new(read_out, words[0], words[1], words[2]);
                        let mut word = 0;
                        for op in [Op::Load, Op::StepX, Op::Hold, Op::StepX, Op::StepY] {
                            walker.clock(op);
                            word = stepper.clock(&path, word, op, words);
                            assert_eq!(
                                word.cast_unsigned(),
                                walker.pattern(),
                                "{read_out:?} {words:?} {op:?}"
                            );
                            assert_eq!(
                                read(&path, read_out, word),
                                i128::from(walker.out()),
                                "{read_out:?} {word}"
                            );
                        }
                    }
                }
            }
        }
    }
}
