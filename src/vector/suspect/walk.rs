//! Suspects of the steppers.

use super::slip::{ReadSlip, Register, SignSlip, Slip};
use super::{Suspect, Suspects};
use crate::dda::Op;
use crate::format::Clamp;
use crate::profile::neighbours;
use crate::vector::bench::{Coverage, Single, WalkBench, WalkKind, WalkTest, read_out};
use crate::vector::device::{Device, Stepper, signed};
use crate::vector::table::Table;

impl Suspects for WalkBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let (kind, read) = (self.kind(), self.read());
        let right = Stepper { kind, port: read.width(), read };
        let mut list = Vec::new();
        for neighbour in neighbours(self.profile()) {
            // Stimulus and columns stay; only the device changes.
            if let Some(other) = read_out(kind, &neighbour.profile).filter(|other| *other != read) {
                let stepper = Stepper { read: other, ..right };
                list.push(Suspect::new(self, neighbour.change, stepper));
            }
        }
        let lag = match kind {
            WalkKind::Depth => "the read-out lags the accumulator by one clock",
            WalkKind::Edge => "the sign test lags the edge word by one clock",
        };
        let late = "an off-by-one step: each row shows the state before its clock edge";
        for (change, also_state) in [(late, true), (lag, false)] {
            let before = right.shown(&crate::dda::Walker::new(read, 0, 0, 0));
            let device = Late { stepper: right, also_state, before };
            list.push(Suspect { unsettled: 1, ..Suspect::new(self, change, device) });
        }
        let controls: [(&str, Controller); 3] = [
            ("dx and dy are swapped", |(op, [init, dx, dy])| (op, [init, dy, dx])),
            ("steps subtract instead of adding", |(op, [init, dx, dy])| (op, [init, -dx, -dy])),
            ("a step down adds dx instead of dy", |(op, [init, dx, _])| (op, [init, dx, dx])),
        ];
        for (change, control) in controls {
            list.push(Suspect::new(self, change, Control { stepper: right, control }));
        }
        for slip in Slip::all(read.width()) {
            let change = slip.text();
            if slip == Slip::HoldSteps {
                let control =
                    |(op, words): Clock| (if op == Op::Hold { Op::StepX } else { op }, words);
                list.push(Suspect::new(self, change, Control { stepper: right, control }));
            } else if read.clamp() != Clamp::Saturate {
                // A register that slips does not hold its accumulator.
                let register = Register::new(Some(slip), read.width());
                list.push(Suspect::new(self, change, Slipped { stepper: right, register }));
            }
        }
        match kind {
            WalkKind::Depth => list.extend(ReadSlip::all(read).into_iter().map(|slip| {
                let shown = move |pattern| slip.read(read, pattern);
                Suspect::new(self, slip.text(), Shown { stepper: right, shown })
            })),
            WalkKind::Edge => list.extend(SignSlip::ALL.map(|(slip, change)| {
                let shown = move |p| u64::from(SignSlip::inside(Some(slip), read.width(), p));
                Suspect::new(self, change, Shown { stepper: right, shown })
            })),
        }
        list
    }
}

/// What reaches a stepper at a clock edge: an operation, and start, dx and dy.
type Clock = (Op, [i128; 3]);

/// What a defect makes of it.
type Controller = fn(Clock) -> Clock;

/// A stepper whose inputs are not what came in.
struct Control<F> {
    stepper: Stepper,
    control: F,
}

impl<F: Fn(Clock) -> Clock + Send> Device<WalkTest> for Control<F> {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let port = self.stepper.port;
        let words = [test.walk.init, test.walk.dx, test.walk.dy].map(|word| signed(word, port));
        let (_, [init, dx, dy]) = (self.control)((Op::Load, words));
        let mut walker = crate::dda::Walker::new(self.stepper.read, init, dx, dy);
        for n in 0..test.rows {
            let op = test.walk.op(n);
            walker.clock((self.control)((op, words)).0);
            row(rows, op, self.stepper.shown(&walker));
        }
    }
}

/// A stepper that shows what stood there before the clock edge.
struct Late {
    stepper: Stepper,
    /// Whether the accumulator is late as well as its output.
    also_state: bool,
    /// Accumulator and output as the last clock left them.
    before: (u128, u64),
}

impl Device<WalkTest> for Late {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let mut walker = self.stepper.walker(&test.walk);
        for n in 0..test.rows {
            let op = test.walk.op(n);
            walker.clock(op);
            let now = self.stepper.shown(&walker);
            let (acc, out) = std::mem::replace(&mut self.before, now);
            row(rows, op, if self.also_state { (acc, out) } else { (now.0, out) });
        }
    }
}

/// A stepper whose accumulator slips.
struct Slipped {
    stepper: Stepper,
    register: Register,
}

impl Device<WalkTest> for Slipped {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let Stepper { kind, port, read } = self.stepper;
        let words = [test.walk.init, test.walk.dx, test.walk.dy].map(|word| signed(word, port));
        for n in 0..test.rows {
            let op = test.walk.op(n);
            self.register.clock(op, words);
            let pattern = self.register.pattern;
            let out = match kind {
                WalkKind::Depth => read.read(pattern.cast_signed()),
                WalkKind::Edge => u64::from(SignSlip::inside(None, read.width(), pattern)),
            };
            row(rows, op, (pattern, out));
        }
    }
}

/// A stepper whose output is made otherwise.
struct Shown<F> {
    stepper: Stepper,
    shown: F,
}

impl<F: Fn(u128) -> u64 + Send> Device<WalkTest> for Shown<F> {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let mut walker = self.stepper.walker(&test.walk);
        for n in 0..test.rows {
            let op = test.walk.op(n);
            walker.clock(op);
            row(rows, op, (walker.pattern(), (self.shown)(walker.pattern())));
        }
    }
}

fn row(rows: &mut Single<Table>, op: Op, (acc, out): (u128, u64)) {
    rows.exp.push(&[op as i128, acc.cast_signed(), i128::from(out)]);
}
