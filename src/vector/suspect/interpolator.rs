//! Suspects of interpolators: other words, outputs that are late, and every single fault of the stepper and
//! of its read-out.

use super::fault::{Fault, Operator, Path, sign_extend};
use super::stepper::{self, Stepper};
use super::{Suspect, Suspects};
use crate::dda::Op;
use crate::format::{Clamp, ReadOut};
use crate::value::InterpolatorUnit;
use crate::vector::bench::{Coverage, InterpolatorBench, Single, WalkTest};
use crate::vector::device::{Device, Interpolates};
use crate::vector::table::Table;

const MODULE: &str = "interpolator";

impl Suspects for InterpolatorBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let unit = self.unit();
        let place = Some((MODULE, "read-out"));
        let mut list: Vec<Suspect<'_>> = neighbours(unit)
            .into_iter()
            .map(|(change, other)| Suspect {
                place,
                ..Suspect::new(self, change, Interpolates(other))
            })
            .collect();
        let late = "each row shows the state before its clock edge: registered once too often, or compared one clock early";
        let lag = "the read-out lags the accumulator by one clock";
        for (change, also_state) in [(late, true), (lag, false)] {
            let device =
                Late { faulty: Faulty::new(unit, Path::right()), also_state, before: None };
            let suspect = Suspect::new(self, change, device);
            list.push(Suspect { unsettled: 1, forgets: false, place, ..suspect });
        }
        let faults = Path::faults(|path| {
            let unit = Unit(unit);
            for op in [Op::Load, Op::StepX, Op::StepY, Op::Hold] {
                let word = unit.stepper().clock(path, 0, op, [1, 1, 1]);
                unit.shown(path, word);
            }
        });
        list.extend(faults.iter().map(|fault: &Fault| {
            let suspect = Suspect::at(self, fault, Faulty::new(unit, Path::with(fault)));
            // A load that does not load leaves what the walk before did.
            Suspect { forgets: suspect.forgets && !fault.chooses(), ..suspect }
        }));
        list
    }
}

/// Interpolators whose words differ in one thing.
fn neighbours(unit: InterpolatorUnit) -> Vec<(String, InterpolatorUnit)> {
    let read = unit.read;
    let mut list = Vec::new();
    let mut add = |what: String, [guard, integer, fraction]: [u32; 3], clamp| {
        if let Ok(read) = ReadOut::new(guard, integer, fraction, clamp) {
            list.push((what, InterpolatorUnit { read, ..unit }));
        }
    };
    let [g, i, f] = [read.guard(), read.integer(), read.fraction()];
    for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign] {
        if clamp != read.clamp() {
            add(format!("clamp is {}", clamp.name()), [g, i, f], clamp);
        }
    }
    for value in [g.checked_sub(1), Some(g + 1)].into_iter().flatten() {
        add(format!("guard is {value}"), [value, i, f], read.clamp());
    }
    for value in [f.checked_sub(1), Some(f + 1)].into_iter().flatten() {
        add(format!("the read-out drops {value} bits"), [g, i, value], read.clamp());
    }
    let sign = if unit.signed { "what is read has no sign" } else { "what is read has a sign" };
    list.push((sign.to_owned(), InterpolatorUnit { signed: !unit.signed, ..unit }));
    list
}

/// An interpolator as hardware has it.
#[derive(Clone, Copy)]
struct Unit(InterpolatorUnit);

impl Unit {
    fn stepper(self) -> Stepper {
        Stepper::value(self.0.read.width())
    }

    fn shown(self, path: &Path, word: i128) -> i128 {
        path.within(MODULE, || {
            let read = self.0.read;
            if !self.0.signed {
                return stepper::read_out(path, read, word);
            }
            let offset = self.0.offset();
            let name = "what lifts a signed value to the read-out";
            let lifted = [word, offset << read.fraction()];
            let word = path.sum(name, Operator::Add, lifted, read.width());
            let out = stepper::read_out(path, read, sign_extend(word, read.width()));
            let name = "what lowers a signed value after the read-out";
            path.sum(name, Operator::Subtract, [out, offset], read.integer())
        })
    }
}

/// An interpolator with a fault.
struct Faulty {
    unit: Unit,
    path: Path,
    word: i128,
}

impl Faulty {
    fn new(unit: InterpolatorUnit, path: Path) -> Self {
        Self { unit: Unit(unit), path, word: 0 }
    }

    fn clock(&mut self, test: &WalkTest, op: Op) -> [i128; 2] {
        let words = [test.walk.init, test.walk.dx, test.walk.dy];
        self.word = self.unit.stepper().clock(&self.path, self.word, op, words);
        [self.word, self.unit.shown(&self.path, self.word)]
    }
}

impl Device<WalkTest> for Faulty {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        self.path.next_record();
        for n in 0..test.rows {
            let op = test.walk.op(n);
            let [word, out] = self.clock(test, op);
            rows.exp.push(&[op as i128, word, out]);
        }
    }
}

/// An interpolator that shows what stood there before the clock edge.
struct Late {
    faulty: Faulty,
    /// Whether the accumulator is late as well as what is read of it.
    also_state: bool,
    before: Option<[i128; 2]>,
}

impl Device<WalkTest> for Late {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, _: &mut Coverage) {
        for n in 0..test.rows {
            let op = test.walk.op(n);
            let now = self.faulty.clock(test, op);
            let [word, out] = self.before.replace(now).unwrap_or(now);
            let word = if self.also_state { word } else { now[0] };
            rows.exp.push(&[op as i128, word, out]);
        }
    }
}
