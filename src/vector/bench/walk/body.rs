//! The rows of one walk: quick on lanes, plain for any width, clamp and slip.

use super::quirk::Quirk;
use super::{WalkBench, WalkKind};
use crate::bits::{Event, Lane};
use crate::case::walk::Walk;
use crate::dda::{Op, Walker};
use crate::format::Decode;
use crate::vector::bench::{Coverage, locate};
use crate::vector::table::Table;

impl WalkBench {
    /// The quick body of a depth walk: lane words, clamps by threshold.
    pub(super) fn emit_depth(
        &self,
        walk: &Walk,
        rows: u32,
        decode: &Decode<i64>,
        table: &mut Table,
        coverage: &mut Coverage,
    ) {
        let unused = 64 - self.width;
        let bias = i64::justify(0, self.width).wrapping_sub(decode.load(0));
        let (init, dx, dy) = (decode.load(walk.init), decode.slope(walk.dx), decode.slope(walk.dy));
        let octant = Coverage::octant(dx.value(self.width), dy.value(self.width));
        let fraction = self.read.fraction();
        let half = if fraction == 0 { u64::MAX } else { 1 << (fraction - 1) };
        let fraction_mask = (1u64 << fraction) - 1;
        let (low, high) = decode.thresholds();
        let mut biased = init;
        for n in 0..rows {
            let op = walk.op(n);
            biased = match op {
                Op::Load => init,
                Op::StepX => biased.wrapping_add(dx),
                Op::StepY => biased.wrapping_add(dy),
                Op::Hold => biased,
            };
            let pattern = biased.wrapping_add(bias).cast_unsigned() >> unused;
            let rest = pattern & fraction_mask;
            let remainder =
                usize::from(rest != 0) + usize::from(rest >= half) + usize::from(rest > half);
            let zone = usize::from(biased > high) + 2 * usize::from(biased < low);
            coverage.note(octant, zone, remainder);
            table.push_narrow([op as u64, pattern, decode.read(biased).cast_unsigned()]);
        }
    }

    /// The quick body of an edge walk.
    pub(super) fn emit_edge(
        &self,
        walk: &Walk,
        rows: u32,
        table: &mut Table,
        coverage: &mut Coverage,
    ) {
        let unused = 64 - self.width;
        let [init, dx, dy] = [walk.init, walk.dx, walk.dy].map(|v| i64::justify(v, self.width));
        let octant = Coverage::octant(dx.value(self.width), dy.value(self.width));
        let (mut word, minus_one) = (init, i64::justify(-1, self.width));
        for n in 0..rows {
            let op = walk.op(n);
            word = match op {
                Op::Load => init,
                Op::StepX => word.wrapping_add(dx),
                Op::StepY => word.wrapping_add(dy),
                Op::Hold => word,
            };
            let outside = usize::from(word < 0);
            coverage.note(octant, 2 * outside, 2 * usize::from(word == 0 || word == minus_one));
            let pattern = word.cast_unsigned() >> unused;
            table.push_narrow([op as u64, pattern, 1 - outside as u64]);
        }
    }

    /// A device before its load. Stimulus comes in words of the set's width, whatever the device's.
    fn walker(&self, walk: &Walk) -> Walker {
        let [init, dx, dy] = [walk.init, walk.dx, walk.dy].map(|word| signed(word, self.width));
        let (dx, dy) = match self.quirk {
            Quirk::Swapped => (dy, dx),
            Quirk::Negated => (-dx, -dy),
            Quirk::OnlyX => (dx, dx),
            _ => (dx, dy),
        };
        Walker::new(self.read, init, dx, dy)
    }

    /// What a late device shows before its load: what the walk before this one left, or a reset.
    fn left_before(&self, test: u64) -> (i128, u64) {
        let late = matches!(self.quirk, Quirk::Late | Quirk::LateOut);
        let at = test.checked_sub(1).filter(|_| late).and_then(|test| locate(&self.groups, test));
        let walker = match at {
            None => Walker::new(self.read, 0, 0, 0),
            Some(at) => {
                let walk = self.walk(at);
                let mut walker = self.walker(&walk);
                (0..walk.rows).for_each(|n| walker.clock(walk.op(n)));
                walker
            }
        };
        (walker.pattern().cast_signed(), self.result(&walker))
    }

    /// The plain body: any width, any clamp, any quirk.
    pub(super) fn emit_plain(
        &self,
        walk: &Walk,
        (test, rows): (u64, u32),
        table: &mut Table,
        coverage: &mut Coverage,
    ) {
        let quirk = self.quirk;
        let mut walker = self.walker(walk);
        let octant = Coverage::octant(signed(walk.dx, self.width), signed(walk.dy, self.width));
        let mut before = self.left_before(test);
        for n in 0..rows {
            let op = walk.op(n);
            let done = if quirk == Quirk::HoldSteps && op == Op::Hold { Op::StepX } else { op };
            walker.clock(done);
            let now = (walker.pattern().cast_signed(), self.result(&walker));
            let (acc, out) = match quirk {
                Quirk::Late => before,
                Quirk::LateOut => (now.0, before.1),
                _ => now,
            };
            before = now;
            let zone = match self.kind {
                WalkKind::Edge => 2 * usize::from(out == 0),
                WalkKind::Depth => self.read.zone(walker.pattern().cast_signed()),
            };
            let remainder = match self.kind {
                WalkKind::Depth => Coverage::remainder(walker.pattern(), self.read.fraction()),
                // On the edge: the word itself, or the one below it that the bias makes.
                WalkKind::Edge => 2 * usize::from(matches!(signed(acc, self.width), -1 | 0)),
            };
            coverage.note(octant, zone, remainder);
            table.push(&[op as i128, acc, i128::from(out)]);
        }
    }

    fn result(&self, walker: &Walker) -> u64 {
        let pattern = walker.pattern();
        match (self.kind, self.quirk) {
            (WalkKind::Edge, quirk) => {
                let inside = pattern >> (self.read.width() - 1) == 0;
                match quirk {
                    Quirk::OtherTie => u64::from(inside && pattern != 0),
                    Quirk::Inverted => u64::from(!inside),
                    _ => u64::from(inside),
                }
            }
            (WalkKind::Depth, Quirk::OtherTie) if self.read.fraction() > 0 => {
                self.read.read(pattern.cast_signed() + (1 << (self.read.fraction() - 1)))
            }
            (WalkKind::Depth, Quirk::Inverted) => match self.read.zone(pattern.cast_signed()) {
                1 => 0,
                2 => self.read.maximum(),
                _ => walker.out(),
            },
            _ => walker.out(),
        }
    }

    /// The same rows in operand form: before, addend, after, result, flags. Spec clause `N-7`.
    pub(super) fn emit_operands(&self, walk: &Walk, rows: u32, table: &mut Table) {
        let mut walker = Walker::new(self.read, walk.init, walk.dx, walk.dy);
        for n in 0..rows {
            let op = walk.op(n);
            let (before, addend) = match op {
                Op::Load => (0, walk.init),
                Op::StepX => (walker.pattern().cast_signed(), walk.dx),
                Op::StepY => (walker.pattern().cast_signed(), walk.dy),
                Op::Hold => (walker.pattern().cast_signed(), 0),
            };
            walker.clock(op);
            let pattern = walker.pattern().cast_signed();
            let flags = if self.kind == WalkKind::Edge {
                0
            } else {
                Event::ALL
                    .iter()
                    .filter(|event| self.read.status(self.read.reduce(pattern)).has(**event))
                    .fold(0, |flags, event| flags | 1 << *event as u32)
            };
            table.push(&[before, addend, pattern, i128::from(self.result(&walker)), flags]);
        }
    }
}

/// The signed value of the low `width` bits.
fn signed(value: i128, width: u32) -> i128 {
    value << (128 - width) >> (128 - width)
}
