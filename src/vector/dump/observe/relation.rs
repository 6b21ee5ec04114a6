//! By what relation a column differs.

use super::Row;
use crate::format::Column;

/// Relations of what came to what was expected, that all differing rows of a column may have.
#[derive(Clone, Debug)]
pub(super) struct Relations {
    /// Bits that differ somewhere.
    any: u128,
    /// The one difference, if there is one.
    offset: Option<i128>,
    constant: Option<u128>,
    /// Whether each of the named relations holds in all rows so far.
    holds: [bool; 5],
    others: Vec<usize>,
    /// Rows with unknown bits.
    unknown: u64,
    first: bool,
}

/// Places in [`Relations::holds`].
const NEGATED: usize = 0;
const COMPLEMENT: usize = 1;
const DOUBLED: usize = 2;
const HALVED: usize = 3;
const STALE: usize = 4;

impl Relations {
    pub(super) fn new(columns: usize) -> Self {
        Self {
            any: 0,
            offset: None,
            constant: None,
            holds: [true; 5],
            others: (0..columns).collect(),
            unknown: 0,
            first: true,
        }
    }

    pub(super) fn note(&mut self, column: &Column, k: usize, row: &Row<'_>) {
        let (want, got) = (row.want[k], row.got[k]);
        let mask = u128::MAX >> (128 - column.width);
        self.any |= want ^ got;
        let value = |word| crate::vector::dump::value(column, word);
        let offset = value(got).wrapping_sub(value(want));
        if self.first {
            (self.offset, self.constant) = (Some(offset), Some(got));
        }
        self.first = false;
        self.offset = self.offset.filter(|seen| *seen == offset);
        self.constant = self.constant.filter(|seen| *seen == got);
        self.holds[NEGATED] &= got == want.wrapping_neg() & mask;
        self.holds[COMPLEMENT] &= got == !want & mask;
        self.holds[DOUBLED] &= want != 0 && got == want << 1;
        self.holds[HALVED] &=
            got == want >> 1 || got == (want >> 1 | want & (1 << (column.width - 1)));
        self.holds[STALE] &= row.before.is_some_and(|before| before[k] == got);
        self.others.retain(|other| *other != k && row.want[*other] == got);
        self.unknown += u64::from(row.unknown[k] != 0);
    }

    /// In words.
    pub(super) fn facts(&self, column: &Column, rows: u64, columns: &[Column]) -> Vec<String> {
        if self.unknown == rows {
            return vec!["unknown bits (X or Z) in all of them".to_owned()];
        }
        if self.unknown > 0 {
            return vec![format!("unknown bits (X or Z) in {} of them", self.unknown)];
        }
        let mut facts = Vec::new();
        if column.width > 1 {
            if let Some(constant) = self.constant.filter(|_| rows > 1) {
                return vec![format!("always {}", crate::bits::hex(constant, column.width))];
            }
            if let Some(offset) = self.offset {
                let unit = if column.fraction > 0 {
                    format!(" of 2^-{}", column.fraction)
                } else {
                    String::new()
                };
                facts.push(format!("always off by {offset:+}{unit}"));
            }
            let named = [
                (self.holds[NEGATED], "always with the sign turned"),
                (self.holds[COMPLEMENT], "always with every bit inverted"),
                (self.holds[DOUBLED], "always twice what it should be"),
                (self.holds[HALVED], "always half of what it should be"),
            ];
            facts.extend(
                named.iter().filter(|(holds, _)| *holds).map(|(_, text)| (*text).to_owned()),
            );
            if self.holds[STALE] && rows > 1 {
                facts.push("always what the row before should have".to_owned());
            }
            let others = self.others.iter().filter(|_| rows > 1).map(|other| &columns[*other]);
            facts.extend(
                others
                    .filter(|other| other.width > 1)
                    .map(|other| format!("always what {} should be", other.name)),
            );
            let (low, high) = (self.any.trailing_zeros(), self.any.ilog2());
            if facts.is_empty() {
                if low == high {
                    facts.push(format!("only bit {low} ever differs"));
                } else if high - low + 1 < column.width {
                    facts.push(format!("only bits {low} to {high} ever differ"));
                }
            }
        }
        facts
    }
}
