//! What can be said of a dump without any cause: which columns differ and in which rows, by what
//! relation, under what condition. Clause `N-14`.

use super::Subject;
use super::compare::{Answer, by_test};
use super::read::Dump;
use crate::format::{Column, Role};
use crate::vector::bench::TestAt;
use crate::vector::table::unpack;
use std::collections::BTreeMap;

/// What was seen of one column.
#[derive(Clone, Debug)]
pub struct Differs {
    /// The column.
    pub column: String,
    /// Rows in which it differs.
    pub rows: u64,
    /// What holds in all of them.
    pub facts: Vec<String>,
}

/// What was seen of a dump.
#[derive(Clone, Debug, Default)]
pub struct Observed {
    /// Rows that have a counterpart.
    pub rows: u64,
    /// The columns that differ.
    pub differ: Vec<Differs>,
    /// Columns that never do, beside those that say where a row belongs.
    pub agree: Vec<String>,
    /// Rows of the set without a counterpart, and the other way round.
    pub missing: u64,
    /// Rows too many.
    pub extra: u64,
    /// Rows that differ by class of test.
    pub classes: BTreeMap<String, u64>,
    /// Whether what differs is the same in every row, as far as the device answers at all.
    pub trivial: bool,
}

/// Relations of what came to what was expected, that all differing rows of a column may have.
#[derive(Clone, Debug)]
struct Relations {
    /// Bits that differ somewhere, and bits that differ everywhere.
    any: u128,
    all: u128,
    /// The one difference, if there is one.
    offset: Option<i128>,
    constant: Option<u128>,
    negated: bool,
    complement: bool,
    doubled: bool,
    halved: bool,
    last_row: bool,
    last_test: bool,
    others: Vec<usize>,
    unknown: bool,
    first: bool,
}

/// Conditions that may tell rows that differ from rows that agree.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    /// Rows that have it.
    rows: u64,
    /// Rows that have it and differ.
    differ: u64,
}

impl Relations {
    fn new(columns: usize) -> Self {
        Self {
            any: 0,
            all: u128::MAX,
            offset: None,
            constant: None,
            negated: true,
            complement: true,
            doubled: true,
            halved: true,
            last_row: true,
            last_test: true,
            others: (0..columns).collect(),
            unknown: false,
            first: true,
        }
    }

    fn note(&mut self, column: &Column, k: usize, row: &Row<'_>) {
        let (want, got) = (row.want[k], row.got[k]);
        let mask = u128::MAX >> (128 - column.width);
        self.any |= want ^ got;
        self.all &= want ^ got;
        // The nearer way round.
        let signed = Column { signed: true, ..column.clone() };
        let offset = super::explain::value(&signed, got.wrapping_sub(want) & mask);
        if self.first {
            (self.offset, self.constant) = (Some(offset), Some(got));
        }
        self.first = false;
        self.offset = self.offset.filter(|seen| *seen == offset);
        self.constant = self.constant.filter(|seen| *seen == got);
        self.negated &= got == want.wrapping_neg() & mask;
        self.complement &= got == !want & mask;
        self.doubled &= got == want << 1 & mask;
        self.halved &= got == want >> 1 || got == (want >> 1 | want & (1 << (column.width - 1)));
        self.last_row &= row.last_row.is_some_and(|last| last[k] == got);
        self.last_test &= row.last_test.is_some_and(|last| last[k] == got);
        self.others.retain(|other| *other != k && row.want[*other] == got);
        self.unknown |= row.unknown[k] != 0;
    }

    /// In words.
    fn facts(&self, column: &Column, rows: u64, columns: &[Column]) -> Vec<String> {
        if self.unknown {
            return vec!["has unknown bits (X or Z)".to_owned()];
        }
        let mut facts = Vec::new();
        if column.width > 1 {
            if let Some(offset) = self.offset {
                let unit = if column.fraction > 0 {
                    format!(" of 2^-{}", column.fraction)
                } else {
                    String::new()
                };
                facts.push(format!("always off by {offset:+}{unit}"));
            }
            if let Some(constant) = self.constant.filter(|_| rows > 1) {
                facts.push(format!("always {}", crate::bits::hex(constant, column.width)));
            }
            let named = [
                (self.negated, "always with the sign turned"),
                (self.complement, "always with every bit inverted"),
                (self.doubled, "always twice what it should be"),
                (self.halved, "always half of what it should be"),
            ];
            facts.extend(
                named.iter().filter(|(holds, _)| *holds).map(|(_, text)| (*text).to_owned()),
            );
            if self.last_row && rows > 1 {
                facts.push("always what the row before should have".to_owned());
            } else if self.last_test && rows > 1 {
                facts.push("always what the record before should have".to_owned());
            }
            let others = self.others.iter().filter(|_| rows > 1).map(|other| &columns[*other]);
            facts.extend(
                others
                    .filter(|other| other.width > 1)
                    .map(|other| format!("always what {} should be", other.name)),
            );
            let (low, high) = (self.any.trailing_zeros(), 127 - self.any.leading_zeros());
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

/// A row and what is around it.
struct Row<'a> {
    want: &'a [u128],
    got: &'a [u128],
    unknown: &'a [u128],
    last_row: Option<&'a [u128]>,
    last_test: Option<&'a [u128]>,
}

/// Looks at every row of a dump.
pub(super) fn observe(subject: &Subject, dump: &Dump) -> Observed {
    let columns = &subject.spec.columns;
    let mut seen = Seen::new(subject);
    let mut expected = Answer::expected(subject);
    let mut map = (subject.key() > 0).then(|| by_test(subject, dump));
    let key = subject.key_bytes();
    let mut next = 0;
    let (mut last_row, mut last_test): (Option<Vec<u128>>, Option<Vec<u128>>) = (None, None);
    for (at, limit) in subject.tests() {
        let mut theirs = match &mut map {
            Some(map) => map.remove(&u128::from(at.test)).unwrap_or_default(),
            None => Vec::new(),
        };
        let rows: Vec<Vec<u8>> = expected.rows(at, limit).map(<[u8]>::to_vec).collect();
        let stimulus = expected.stimulus();
        let first_of_test = last_row.take();
        let mut last = first_of_test;
        for (n, row) in rows.iter().enumerate() {
            let found = if map.is_some() {
                let found = theirs.iter().position(|there| dump.row(*there)[..key] == row[..key]);
                found.map(|found| theirs.remove(found))
            } else {
                next += 1;
                (next <= dump.rows()).then(|| next - 1)
            };
            let Some(there) = found else {
                seen.observed.missing += 1;
                *seen.observed.classes.entry(seen.class(subject, at)).or_default() += 1;
                continue;
            };
            let want = unpack(row, columns);
            let [got, unknown, ignored] = dump.words(there);
            let got: Vec<u128> = got
                .iter()
                .zip(&want)
                .zip(&ignored)
                .map(|((got, want), ignored)| got & !ignored | want & ignored)
                .collect();
            let unknown: Vec<u128> =
                unknown.iter().zip(&ignored).map(|(unknown, ignored)| unknown & !ignored).collect();
            let around = Row {
                want: &want,
                got: &got,
                unknown: &unknown,
                last_row: last.as_deref(),
                last_test: last_test.as_deref(),
            };
            seen.row(subject, at, n, &around, &stimulus);
            last = Some(want);
        }
        seen.observed.extra += theirs.len() as u64;
        if !theirs.is_empty() {
            *seen.observed.classes.entry(seen.class(subject, at)).or_default() +=
                theirs.len() as u64;
        }
        last_test = last.clone().or(last_test);
        last_row = last;
    }
    seen.observed.extra += map.map_or_else(
        || dump.rows().saturating_sub(next) as u64,
        |left| left.values().map(|rows| rows.len() as u64).sum(),
    );
    seen.finish(columns)
}

/// What is counted on the way.
struct Seen {
    observed: Observed,
    key: usize,
    relations: Vec<Relations>,
    rows: Vec<u64>,
    /// For each column, conditions by name.
    conditions: Vec<BTreeMap<String, Count>>,
    /// The word of each column, if it is the same in every row.
    constant: Vec<Option<u128>>,
}

impl Seen {
    fn new(subject: &Subject) -> Self {
        let columns = subject.spec.columns.len();
        Self {
            observed: Observed::default(),
            key: subject.key(),
            relations: vec![Relations::new(columns); columns],
            rows: vec![0; columns],
            conditions: vec![BTreeMap::new(); columns],
            constant: Vec::new(),
        }
    }

    fn class(&self, subject: &Subject, at: TestAt) -> String {
        subject.bench.groups()[at.group].class.tag.to_owned()
    }

    fn row(
        &mut self,
        subject: &Subject,
        at: TestAt,
        n: usize,
        row: &Row<'_>,
        stimulus: &[(String, u128, u32)],
    ) {
        let columns = &subject.spec.columns;
        self.observed.rows += 1;
        if self.constant.is_empty() {
            self.constant = row.got.iter().map(|word| Some(*word)).collect();
        }
        for (constant, word) in self.constant.iter_mut().zip(row.got) {
            *constant = constant.filter(|seen| seen == word);
        }
        let differs: Vec<bool> =
            (0..columns.len()).map(|k| row.want[k] != row.got[k] || row.unknown[k] != 0).collect();
        if differs.contains(&true) {
            *self.observed.classes.entry(self.class(subject, at)).or_default() += 1;
        }
        let names = conditions(columns, n, row, stimulus);
        for (k, column) in columns.iter().enumerate() {
            if differs[k] {
                self.rows[k] += 1;
                self.relations[k].note(column, k, row);
            }
            for name in &names {
                if !self.conditions[k].contains_key(name.as_str()) {
                    self.conditions[k].insert(name.clone(), Count::default());
                }
                if let Some(count) = self.conditions[k].get_mut(name.as_str()) {
                    count.rows += 1;
                    count.differ += u64::from(differs[k]);
                }
            }
        }
    }

    fn finish(mut self, columns: &[Column]) -> Observed {
        let mut differing = (0..columns.len()).filter(|k| self.rows[*k] > 0).peekable();
        let moved = self.observed.missing + self.observed.extra > 0;
        self.observed.trivial = !moved
            && self.observed.rows > 1
            && differing.peek().is_some()
            && differing.all(|k| self.constant[k].is_some());
        // Nothing came at all.
        self.observed.trivial |= self.key > 0 && self.observed.rows + self.observed.extra == 0;
        for (k, column) in columns.iter().enumerate() {
            if self.rows[k] == 0 {
                if k >= self.key {
                    self.observed.agree.push(column.name.clone());
                }
                continue;
            }
            let mut facts = self.relations[k].facts(column, self.rows[k], columns);
            let (all, differ) = (self.observed.rows, self.rows[k]);
            // The rarest condition that all rows have which differ.
            let told = self.conditions[k].iter().filter(|(_, count)| {
                count.differ == differ && differ > 2 && count.rows * 4 < all * 3
            });
            if let Some((name, count)) = told.min_by_key(|(_, count)| count.rows) {
                let how = if count.rows == differ { "exactly" } else { "only" };
                facts.push(format!("{how} {name}"));
            } else if differ == all && all > 2 {
                facts.push("in every row".to_owned());
            }
            self.observed.differ.push(Differs { column: column.name.clone(), rows: differ, facts });
        }
        self.observed
    }
}

/// The conditions of a row, by name.
fn conditions(
    columns: &[Column],
    n: usize,
    row: &Row<'_>,
    stimulus: &[(String, u128, u32)],
) -> Vec<String> {
    let mut names = Vec::new();
    for (column, word) in columns.iter().zip(row.want) {
        if column.name == Role::OP.pattern {
            let op = ["on a load", "on a step right", "on a step down", "on a hold"];
            names.extend(op.get(usize::try_from(*word).unwrap_or(9)).map(|op| (*op).to_owned()));
        } else if column.width == 1 {
            names.push(format!("where {} is {word}", column.name));
        } else if column.signed && word >> (column.width - 1) & 1 == 1 {
            names.push(format!("where {} is negative", column.name));
        } else if *word == 0 {
            names.push(format!("where {} is zero", column.name));
        }
    }
    names.extend((n == 0).then(|| "in the first row of a test".to_owned()));
    names.extend((n > 0).then(|| "after the first row of a test".to_owned()));
    for (name, word, width) in stimulus {
        if *width > 1 && word >> (width - 1) & 1 == 1 {
            names.push(format!("where the test's {name} has its top bit set"));
        }
    }
    names
}
