//! The reference model of the steppers: quick on lanes, plain for any width and clamp.

use super::Device;
use crate::bits::{Event, Lane};
use crate::case::walk::Walk;
use crate::dda::{Op, Walker};
use crate::format::{Clamp, Decode, ReadOut};
use crate::vector::bench::{Coverage, Single, WalkKind, WalkTest};
use crate::vector::table::Table;

/// The quickest device that answers as specified.
pub(in crate::vector) fn reference(kind: WalkKind, read: ReadOut) -> Box<dyn Device<WalkTest>> {
    match (kind, read.decode()) {
        (WalkKind::Edge, _) if read.width() <= 64 => Box::new(EdgeLane { width: read.width() }),
        (WalkKind::Depth, Some(decode))
            if !matches!(read.clamp(), Clamp::Wrap | Clamp::Saturate) =>
        {
            Box::new(DepthLane { read, decode })
        }
        _ => Box::new(Stepper { kind, port: read.width(), read }),
    }
}

/// A depth DDA on lane words, its clamp by thresholds.
struct DepthLane {
    read: ReadOut,
    decode: Decode<i64>,
}

impl Device<WalkTest> for DepthLane {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, met: &mut Coverage) {
        let (walk, decode, width) = (&test.walk, &self.decode, self.read.width());
        let unused = 64 - width;
        let bias = i64::justify(0, width).wrapping_sub(decode.load(0));
        let (init, dx, dy) = (decode.load(walk.init), decode.slope(walk.dx), decode.slope(walk.dy));
        let octant = Coverage::octant(dx.value(width), dy.value(width));
        let fraction = self.read.fraction();
        let half = if fraction == 0 { u64::MAX } else { 1 << (fraction - 1) };
        let fraction_mask = (1u64 << fraction) - 1;
        let (low, high) = decode.thresholds();
        let mut biased = init;
        for n in 0..test.rows {
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
            met.note(octant, zone, remainder);
            met.note_guard(octant, guard(self.read, u128::from(pattern)));
            rows.exp.push_narrow([op as u64, pattern, decode.read(biased).cast_unsigned()]);
        }
    }
}

/// An edge stepper on lane words.
struct EdgeLane {
    width: u32,
}

impl Device<WalkTest> for EdgeLane {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, met: &mut Coverage) {
        let (walk, width) = (&test.walk, self.width);
        let unused = 64 - width;
        let [init, dx, dy] = [walk.init, walk.dx, walk.dy].map(|v| i64::justify(v, width));
        let octant = Coverage::octant(dx.value(width), dy.value(width));
        let (mut word, minus_one) = (init, i64::justify(-1, width));
        for n in 0..test.rows {
            let op = walk.op(n);
            word = match op {
                Op::Load => init,
                Op::StepX => word.wrapping_add(dx),
                Op::StepY => word.wrapping_add(dy),
                Op::Hold => word,
            };
            let outside = usize::from(word < 0);
            met.note(octant, 2 * outside, 2 * usize::from(word == 0 || word == minus_one));
            let pattern = word.cast_unsigned() >> unused;
            rows.exp.push_narrow([op as u64, pattern, 1 - outside as u64]);
        }
    }
}

/// A plain stepper of any width and clamp.
#[derive(Clone, Copy, Debug)]
pub(in crate::vector) struct Stepper {
    pub(in crate::vector) kind: WalkKind,
    /// Bits of the words that come in.
    pub(in crate::vector) port: u32,
    /// The accumulator and its read-out; of an edge word only the width counts.
    pub(in crate::vector) read: ReadOut,
}

impl Stepper {
    /// The register before the load of a walk.
    pub(in crate::vector) fn walker(&self, walk: &Walk) -> Walker {
        let [init, dx, dy] = [walk.init, walk.dx, walk.dy].map(|word| signed(word, self.port));
        Walker::new(self.read, init, dx, dy)
    }

    /// What is shown of a register: its pattern and its output.
    pub(in crate::vector) fn shown(&self, walker: &Walker) -> (u128, u64) {
        let pattern = walker.pattern();
        let out = match self.kind {
            WalkKind::Depth => walker.out(),
            WalkKind::Edge => u64::from(pattern >> (self.read.width() - 1) & 1 == 0),
        };
        (pattern, out)
    }
}

impl Device<WalkTest> for Stepper {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, met: &mut Coverage) {
        let walk = &test.walk;
        let mut walker = self.walker(walk);
        let octant = Coverage::octant(signed(walk.dx, self.port), signed(walk.dy, self.port));
        for n in 0..test.rows {
            let op = walk.op(n);
            walker.clock(op);
            let (pattern, out) = self.shown(&walker);
            let acc = pattern.cast_signed();
            let (zone, remainder) = match self.kind {
                // On the edge: the word itself, or the one below it that the bias makes.
                WalkKind::Edge => (
                    2 * usize::from(out == 0),
                    2 * usize::from(matches!(signed(acc, self.port), -1 | 0)),
                ),
                WalkKind::Depth => {
                    (self.read.zone(acc), Coverage::remainder(pattern, self.read.fraction()))
                }
            };
            met.note(octant, zone, remainder);
            met.note_guard(octant, guard(self.read, pattern));
            rows.exp.push(&[op as i128, acc, i128::from(out)]);
        }
    }
}

/// The rows of a walk in operand form: before, addend, after, result, flags. Spec clause `N-7`.
#[derive(Clone, Copy, Debug)]
pub(in crate::vector) struct Operands(pub(in crate::vector) Stepper);

impl Operands {
    pub(in crate::vector) fn write(&self, test: &WalkTest, table: &mut Table) {
        let Stepper { kind, read, .. } = self.0;
        let walk = &test.walk;
        let mut walker = Walker::new(read, walk.init, walk.dx, walk.dy);
        for n in 0..test.rows {
            let op = walk.op(n);
            let (before, addend) = match op {
                Op::Load => (0, walk.init),
                Op::StepX => (walker.pattern().cast_signed(), walk.dx),
                Op::StepY => (walker.pattern().cast_signed(), walk.dy),
                Op::Hold => (walker.pattern().cast_signed(), 0),
            };
            walker.clock(op);
            let (pattern, out) = self.0.shown(&walker);
            let pattern = pattern.cast_signed();
            let flags = if kind == WalkKind::Edge {
                0
            } else {
                Event::ALL
                    .iter()
                    .filter(|event| read.status(read.reduce(pattern)).has(**event))
                    .fold(0, |flags, event| flags | 1 << *event as u32)
            };
            table.push(&[before, addend, pattern, i128::from(out), flags]);
        }
    }
}

/// What the guard bits of a pattern hold; more bits than any goal tells apart count as all ones.
#[inline]
pub(in crate::vector) fn guard(read: ReadOut, pattern: u128) -> usize {
    let bits = pattern >> (read.width() - read.guard()) & ((1 << read.guard()) - 1);
    usize::try_from(bits).unwrap_or(usize::MAX)
}

/// The signed value of the low `width` bits.
pub(in crate::vector) fn signed(value: i128, width: u32) -> i128 {
    value << (128 - width) >> (128 - width)
}
