//! Lecture A: the carry flows up, so a DDA may leave its range and come back. Toy formats, every
//! start and slope; then the accumulators for which it fails.

use super::statement::Statement;
use crate::bits::{Bits, Word};
use crate::dda::{Op, Planar, Walker};
use crate::format::{Clamp, ReadOut};

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "wrap.path",
            "number of accumulators that differ from direct evaluation after a path: every start, \
             dx and dy of 4 bits, and every path of up to 5 steps left, right, up, down",
            "0",
            paths,
        )
        .slow(),
        Statement::exact(
            "wrap.saturating",
            "4-bit saturating accumulator, one step and one step back: number of pairs of start and \
             slope from -7 to 7 that do not return to the start; a slope of +-m loses m starts, so \
             the number is 2 (1 + ... + 7)",
            "56",
            || {
                lost(|start, slope| {
                    let negative = Word::saturating(W, -slope.to_i128());
                    start.saturating_add(slope).saturating_add(negative) == start
                })
            },
        ),
        Statement::exact(
            "wrap.clamped",
            "accumulator clamped to [0, 2^2) at every step, 1 guard + 2 integer bits, start 3, \
             slope +1: value after one step out and one step back, with a sticky clamp / with a \
             clamp on read-out only",
            "2 / 3",
            || [Clamp::Saturate, Clamp::Guard].map(out_and_back).join(" / "),
        ),
        Statement::exact(
            "wrap.floating",
            "binary32 accumulator, start 2^24, one step of +1 and one step of -1: result minus \
             2^24, in floating point / in a 32-bit word",
            "-1 / 0",
            || {
                let start = 16_777_216_f32;
                let floating = f64::from(start + 1.0 - 1.0) - f64::from(start);
                let word = |value| Word::wrapping(Bits::<32>, value);
                let fixed = word(1 << 24).wrapping_add(word(1)).wrapping_add(word(-1));
                format!("{floating} / {}", fixed.to_i128() - (1 << 24))
            },
        ),
        Statement::exact(
            "wrap.floating-order",
            "binary32 accumulator, start 2^24, steps +1 and +2 in both orders: result minus 2^24",
            "2 / 4",
            || {
                let start = 16_777_216_f32;
                let [first, second] = [start + 1.0 + 2.0, start + 2.0 + 1.0];
                format!("{} / {}", first - start, second - start)
            },
        ),
    ]
}

const W: Bits<4> = Bits;

fn words() -> impl Iterator<Item = Word<Bits<4>>> {
    (-8..8).map(|value| Word::wrapping(W, value))
}

fn paths() -> u64 {
    let mut wrong = 0;
    for start in words() {
        for dx in words() {
            for dy in words() {
                let plane = Planar::new(start, dx, dy);
                wrong += follow(&plane, plane, [0, 0], 5);
            }
        }
    }
    wrong
}

/// One step of the planar DDA.
type Step = fn(&mut Planar<Bits<4>>);

/// Mismatches on every path of `left` more steps from `[x, y]`.
fn follow(origin: &Planar<Bits<4>>, here: Planar<Bits<4>>, [x, y]: [i128; 2], left: u32) -> u64 {
    let mut wrong = u64::from(here.accumulator() != origin.at(x, y));
    if left > 0 {
        let steps: [(Step, [i128; 2]); 4] = [
            (Planar::step_x, [1, 0]),
            (Planar::back_x, [-1, 0]),
            (Planar::step_y, [0, 1]),
            (Planar::back_y, [0, -1]),
        ];
        for (step, [dx, dy]) in steps {
            let mut next = here;
            step(&mut next);
            wrong += follow(origin, next, [x + dx, y + dy], left - 1);
        }
    }
    wrong
}

/// Pairs of start and slope for which a step and its undoing do not return.
fn lost(back: impl Fn(Word<Bits<4>>, Word<Bits<4>>) -> bool) -> usize {
    let slopes = || words().filter(|slope| slope.to_i128() != -8);
    words()
        .flat_map(|start| slopes().map(move |slope| (start, slope)))
        .filter(|(start, slope)| !back(*start, *slope))
        .count()
}

fn out_and_back(clamp: Clamp) -> String {
    let Ok(read) = ReadOut::new(1, 2, 0, clamp) else {
        return "no such read-out".to_owned();
    };
    let mut walker = Walker::new(read, 3, 1, -1);
    walker.clock(Op::StepX);
    walker.clock(Op::StepY);
    walker.out().to_string()
}
