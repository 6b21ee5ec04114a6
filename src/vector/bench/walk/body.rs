//! The rows of one walk: quick on lanes, plain for any width, clamp and slip.

use super::quirk::Quirk;
use super::{WalkBench, WalkKind};
use crate::bits::{Event, Lane};
use crate::case::walk::Walk;
use crate::dda::{Op, Walker};
use crate::format::Decode;
use crate::vector::bench::slip::{Register, SignSlip, Slip};
use crate::vector::bench::{Coverage, locate};
use crate::vector::table::Table;
use std::sync::PoisonError;

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
        let pattern = walker.pattern();
        (pattern.cast_signed(), self.result(pattern, walker.out()))
    }

    /// The plain body: any width, any clamp, any quirk.
    pub(super) fn emit_plain(
        &self,
        walk: &Walk,
        (test, rows): (u64, u32),
        table: &mut Table,
        coverage: &mut Coverage,
    ) {
        let hold_steps = self.quirk == Quirk::Word(Slip::HoldSteps);
        if let Quirk::Word(slip) = self.quirk
            && !hold_steps
        {
            self.emit_slipped(walk, (test, rows), slip, table);
            return;
        }
        let quirk = self.quirk;
        let mut walker = self.walker(walk);
        let octant = Coverage::octant(signed(walk.dx, self.width), signed(walk.dy, self.width));
        let mut before = self.left_before(test);
        for n in 0..rows {
            let op = walk.op(n);
            walker.clock(if hold_steps && op == Op::Hold { Op::StepX } else { op });
            let now = (walker.pattern().cast_signed(), self.result(walker.pattern(), walker.out()));
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

    /// The rows of a device whose accumulator slips; it remembers what the test before left.
    fn emit_slipped(&self, walk: &Walk, (test, rows): (u64, u32), slip: Slip, table: &mut Table) {
        let fresh = || Register::new(Some(slip), self.read.width());
        let mut memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = memory.take().filter(|(next, _)| *next == test).map(|(_, register)| register);
        let mut register = kept.unwrap_or_else(|| {
            let mut register = fresh();
            let first = if slip.forgets() { test } else { 0 };
            for at in (first..test).filter_map(|test| locate(&self.groups, test)) {
                let walk = self.walk(at);
                (0..walk.rows).for_each(|n| self.clock(&mut register, &walk, n));
            }
            register
        });
        for n in 0..rows {
            self.clock(&mut register, walk, n);
            let pattern = register.pattern;
            let out = self.result(pattern, self.read.read(pattern.cast_signed()));
            table.push(&[walk.op(n) as i128, pattern.cast_signed(), i128::from(out)]);
        }
        *memory = Some((test + 1, register));
    }

    fn clock(&self, register: &mut Register, walk: &Walk, n: u32) {
        let words = [walk.init, walk.dx, walk.dy].map(|word| signed(word, self.width));
        register.clock(walk.op(n), words);
    }

    /// What is read from an accumulator; `out` is what a read-out as specified gives.
    fn result(&self, pattern: u128, out: u64) -> u64 {
        match (self.kind, self.quirk) {
            (WalkKind::Edge, quirk) => {
                let slip = if let Quirk::Sign(slip) = quirk { Some(slip) } else { None };
                u64::from(SignSlip::inside(slip, self.read.width(), pattern))
            }
            (WalkKind::Depth, Quirk::Read(slip)) => slip.read(self.read, pattern),
            (WalkKind::Depth, _) => out,
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
            table.push(&[
                before,
                addend,
                pattern,
                i128::from(self.result(walker.pattern(), walker.out())),
                flags,
            ]);
        }
    }
}

/// The signed value of the low `width` bits.
fn signed(value: i128, width: u32) -> i128 {
    value << (128 - width) >> (128 - width)
}
