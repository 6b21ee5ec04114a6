//! The reference model of a reciprocal unit and of a divider.

use super::Device;
use crate::value::{Corrector, ReciprocalUnit};
use crate::vector::bench::{Coverage, Single, UnitKind, UnitTest};
use crate::vector::table::Table;

/// A word by the name of its column.
pub(in crate::vector) type NamedWord = (&'static str, i128);

/// Names of the words of two Newton steps.
pub(in crate::vector) const STEPS: [[&str; 3]; 2] = [["r1", "t1", "y1"], ["r2", "t2", "y2"]];

/// Answers the named words of a unit; 0 for a word that it does not have.
pub(in crate::vector) struct Computes {
    pub(in crate::vector) kind: UnitKind,
    pub(in crate::vector) names: Vec<String>,
}

/// The words of a reciprocal.
fn reciprocal(unit: &ReciprocalUnit, q: i128) -> Vec<NamedWord> {
    let words = unit.words(q);
    let mut named = vec![
        ("length", words.length.into()),
        ("x", words.operand.into()),
        ("entry", words.entry.into()),
        ("mantissa", words.mantissa),
        ("exponent", words.exponent.into()),
    ];
    named.extend(
        words.line.into_iter().flat_map(|line| ["far", "part", "fall"].into_iter().zip(line)),
    );
    let steps = STEPS.into_iter().zip(words.steps);
    named.extend(steps.flat_map(|(names, words)| names.into_iter().zip(words)));
    named
}

/// The words of a division, and what it met.
fn division(corrector: &Corrector, [acc, acc_w]: [i128; 2], met: &mut Coverage) -> Vec<NamedWord> {
    let words = corrector.division(acc, acc_w);
    let (low, high) = corrector.config().range();
    let cells = [
        ("q.zero", words.q == 0),
        ("p.negative", words.p < 0),
        ("clamp.above", words.q > 0 && words.value > high),
        ("clamp.below", words.q > 0 && words.value < low),
        ("value.largest", words.q > 0 && words.value == high),
        ("value.smallest", words.q > 0 && words.value == low),
    ];
    cells.iter().filter(|(_, holds)| *holds).for_each(|(cell, _)| met.meet(cell));
    let (mantissa, exponent) =
        words.reciprocal.map_or((0, 0), |found| (found.mantissa, found.exponent.into()));
    vec![
        ("p", words.p),
        ("q", words.q),
        ("mantissa", mantissa),
        ("exponent", exponent),
        ("value", words.value),
        ("code", words.code.into()),
    ]
}

impl Device<UnitTest> for Computes {
    fn answer(&mut self, test: &UnitTest, rows: &mut Single<Table>, met: &mut Coverage) {
        let named = match &self.kind {
            UnitKind::Reciprocal(port) => reciprocal(&port.unit, test.words[0]),
            UnitKind::Divider(corrector) => division(corrector, test.words, met),
        };
        rows.exp.push(&in_order(&named, &self.names));
    }
}

/// The words in the order of the columns.
pub(in crate::vector) fn in_order(named: &[NamedWord], columns: &[String]) -> Vec<i128> {
    let find = |column: &String| named.iter().find(|(name, _)| *name == column.as_str());
    columns.iter().map(|column| find(column).map_or(0, |(_, word)| *word)).collect()
}
