//! The reference model of an interpolator.

use super::{Device, guard, signed};
use crate::dda::Walker;
use crate::value::InterpolatorUnit;
use crate::vector::bench::{Coverage, Single, WalkTest};
use crate::vector::table::Table;

/// Walks a component, or 1/w. Spec clauses `CH-2` and `D-4`.
pub(in crate::vector) struct Interpolates(pub(in crate::vector) InterpolatorUnit);

impl Device<WalkTest> for Interpolates {
    fn answer(&mut self, test: &WalkTest, rows: &mut Single<Table>, met: &mut Coverage) {
        let Self(unit) = self;
        let (read, walk) = (unit.read, &test.walk);
        let [dx, dy] = [walk.dx, walk.dy].map(|word| signed(word, read.width()));
        let octant = Coverage::octant(dx, dy);
        let mut walker = Walker::new(read, walk.init, dx, dy);
        for n in 0..test.rows {
            let op = walk.op(n);
            walker.clock(op);
            let acc = walker.accumulator();
            let seen = unit.seen(acc);
            let pattern = seen.cast_unsigned() & (u128::MAX >> (128 - read.width()));
            met.note(octant, read.zone(seen), Coverage::remainder(pattern, read.fraction()));
            met.note_guard(octant, guard(read, pattern));
            rows.exp.push(&[op as i128, acc, unit.out(acc)]);
        }
    }
}
