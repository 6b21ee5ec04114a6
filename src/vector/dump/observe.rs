//! What can be said of a dump without any cause: which columns differ and in which rows, by what
//! relation, under what condition. Clause `N-14`.

mod relation;

use super::Subject;
use super::compare::{Answer, by_test};
use super::read::Dump;
use crate::format::{Column, Role};
use crate::vector::bench::TestAt;
use crate::vector::table::unpack;
use relation::Relations;
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

/// Conditions that may tell rows that differ from rows that agree.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    /// Rows that have it.
    rows: u64,
    /// Rows that have it and differ.
    differ: u64,
}

/// A row and what is around it.
struct Row<'a> {
    want: &'a [u128],
    got: &'a [u128],
    unknown: &'a [u128],
    /// Whether the dump lets a column be compared at all.
    compared: &'a [bool],
    before: Option<&'a [u128]>,
    test_before: Option<&'a [u128]>,
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
                *seen.observed.classes.entry(Seen::class(subject, at)).or_default() += 1;
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
            let compared: Vec<bool> = columns
                .iter()
                .zip(&ignored)
                .map(|(column, ignored)| *ignored != u128::MAX >> (128 - column.width))
                .collect();
            let around = Row {
                compared: &compared,
                want: &want,
                got: &got,
                unknown: &unknown,
                before: last.as_deref(),
                test_before: last_test.as_deref(),
            };
            seen.row(subject, at, n, &around, &stimulus);
            last = Some(want);
        }
        seen.observed.extra += theirs.len() as u64;
        if !theirs.is_empty() {
            *seen.observed.classes.entry(Seen::class(subject, at)).or_default() +=
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
    /// Whether a column was compared in any row.
    compared: Vec<bool>,
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
            compared: vec![false; columns],
            constant: Vec::new(),
        }
    }

    fn class(subject: &Subject, at: TestAt) -> String {
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
            *self.observed.classes.entry(Self::class(subject, at)).or_default() += 1;
        }
        let names = conditions(columns, n, row, stimulus);
        for (k, column) in columns.iter().enumerate() {
            if differs[k] {
                self.rows[k] += 1;
                self.relations[k].note(column, k, row);
            }
            self.compared[k] |= row.compared[k];
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
                if k >= self.key && self.compared[k] {
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
