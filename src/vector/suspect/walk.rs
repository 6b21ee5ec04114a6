//! Suspects of the steppers: neighbours of the profile, registers that are late, and every single
//! fault of a stepper as hardware has it.

use super::fault::{Fault, Path};
use super::stepper::{self, Stepper};
use super::{Suspect, Suspects};
use crate::dda::Op;
use crate::format::ReadOut;
use crate::profile::neighbours;
use crate::vector::bench::{Coverage, Single, WalkBench, WalkKind, WalkTest, read_out};
use crate::vector::device::{Device, Stepper as Model};
use crate::vector::table::Table;

impl Suspects for WalkBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let (kind, read) = (self.kind(), self.read());
        let right = Model { kind, port: read.width(), read };
        let mut list = Vec::new();
        for neighbour in neighbours(self.profile()) {
            // Stimulus and columns stay; only the device changes.
            if let Some(other) = read_out(kind, &neighbour.profile).filter(|other| *other != read) {
                let stepper = Model { read: other, ..right };
                list.push(Suspect::new(self, neighbour.change, stepper));
            }
        }
        let lag = match kind {
            WalkKind::Depth => "the read-out lags the accumulator by one clock",
            WalkKind::Edge => "the sign test lags the edge word by one clock",
        };
        let late = "each row shows the state before its clock edge: registered once too often, or compared one clock early";
        for (change, also_state) in [(late, true), (lag, false)] {
            let before = right.shown(&crate::dda::Walker::new(read, 0, 0, 0));
            let device = Late { stepper: right, also_state, before };
            list.push(Suspect {
                unsettled: 1,
                forgets: false,
                ..Suspect::new(self, change, device)
            });
        }
        let faults = Path::faults(|path| {
            let unit = Unit::new(kind, read);
            for op in [Op::Load, Op::StepX, Op::StepY, Op::Hold] {
                let word = unit.stepper.clock(path, 0, op, [1, 1, 1]);
                unit.shown(path, word);
            }
        });
        let faulty = |fault| Faulty::new(Unit::new(kind, read), fault);
        list.extend(faults.iter().map(|fault| {
            let suspect = Suspect::at(self, fault, faulty(fault));
            // A load that does not load leaves what the walk before did.
            Suspect { forgets: suspect.forgets && !fault.chooses(), ..suspect }
        }));
        list
    }
}

/// A stepper with its read-out or sign test.
#[derive(Clone, Copy, Debug)]
struct Unit {
    kind: WalkKind,
    read: ReadOut,
    stepper: Stepper,
}

impl Unit {
    fn new(kind: WalkKind, read: ReadOut) -> Self {
        let stepper = match kind {
            WalkKind::Depth => Stepper::depth(read),
            WalkKind::Edge => Stepper::edge(read.width()),
        };
        Self { kind, read, stepper }
    }

    fn shown(&self, path: &Path, word: i128) -> i128 {
        match self.kind {
            WalkKind::Depth => stepper::read(path, self.read, word),
            WalkKind::Edge => i128::from(stepper::inside(path, self.stepper.width, word)),
        }
    }
}

/// A stepper with a fault.
struct Faulty {
    unit: Unit,
    path: Path,
    word: i128,
}

impl Faulty {
    fn new(unit: Unit, fault: &Fault) -> Self {
        Self { unit, path: Path::with(fault), word: 0 }
    }
}

impl Device<WalkTest> for Faulty {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        self.path.next_record();
        let words = [test.walk.init, test.walk.dx, test.walk.dy];
        for n in 0..test.rows {
            let op = test.walk.op(n);
            self.word = self.unit.stepper.clock(&self.path, self.word, op, words);
            let out = self.unit.shown(&self.path, self.word);
            rows.exp.push(&[op as i128, self.word, out]);
        }
    }
}

/// A stepper that shows what stood there before the clock edge.
struct Late {
    stepper: Model,
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
            let (acc, out) = if self.also_state { (acc, out) } else { (now.0, out) };
            rows.exp.push(&[op as i128, acc.cast_signed(), i128::from(out)]);
        }
    }
}
