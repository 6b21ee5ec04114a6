//! What can be said of a dump without any cause: which columns differ and in which rows, by what
//! relation, under what condition. Clause `N-14`.

mod condition;
mod relation;

use super::Subject;
use super::compare::{Answer, by_test, matched};
use super::read::Dump;
use crate::format::{Column, Role};
use crate::vector::bench::TestAt;
use crate::vector::table::unpack;
use condition::Condition;
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
    /// What holds in all of those whose test is known.
    pub extra_facts: Vec<String>,
    /// Rows that differ by class of test.
    pub classes: BTreeMap<String, u64>,
    /// Whether what differs is the same in every row, as far as the device answers at all.
    pub trivial: bool,
}

/// A row and what is around it.
struct Row<'a> {
    /// Number of the row in its test.
    n: usize,
    want: &'a [u128],
    got: &'a [u128],
    unknown: &'a [u128],
    /// Bits that the dump does not let be compared.
    ignored: &'a [u128],
    /// The row before, as it should be.
    before: Option<&'a [u128]>,
    /// The words of the configuration that drove the test.
    stimulus: &'a [u128],
}

/// Looks at every row of a dump; the tests in which one differs, too.
pub(super) fn observe(subject: &Subject, dump: &Dump) -> (Observed, Vec<TestAt>) {
    let columns = &subject.spec.columns;
    let mut seen = Seen::new(subject);
    let mut expected = Answer::expected(subject);
    let mut map = subject.names_tests().then(|| by_test(subject, dump));
    let mut next = 0;
    let mut before: Option<Vec<u128>> = None;
    let mut differing = Vec::new();
    for (at, limit) in subject.tests() {
        let so_far = seen.differ;
        let class = subject.bench.groups()[at.group].class.tag;
        let (rows, stimulus) = expected.rows_and_stimulus(at, limit);
        let rows: Vec<&[u8]> = rows.collect();
        let (found, theirs) = if let Some(map) = &mut map {
            let theirs = map.remove(&u128::from(at.test)).unwrap_or_default();
            matched(subject, dump, &rows, theirs)
        } else {
            let from = next;
            next += rows.len();
            ((from..next).map(|row| (row < dump.rows()).then_some(row)).collect(), Vec::new())
        };
        for (n, (row, found)) in rows.into_iter().zip(found).enumerate() {
            let Some(there) = found else {
                seen.observed.missing += 1;
                seen.differs_in(class, 1);
                continue;
            };
            let want = unpack(row, columns);
            let [mut got, mut unknown, ignored] = dump.words(there);
            for (k, ignored) in ignored.iter().enumerate() {
                got[k] = got[k] & !ignored | want[k] & ignored;
                unknown[k] &= !ignored;
            }
            let row = Row {
                n,
                want: &want,
                got: &got,
                unknown: &unknown,
                ignored: &ignored,
                before: before.as_deref(),
                stimulus: &stimulus,
            };
            seen.row(subject, class, &row);
            before = Some(want);
        }
        for there in &theirs {
            seen.beyond(subject, &dump.words(*there)[0], &stimulus);
        }
        seen.observed.extra += theirs.len() as u64;
        seen.differs_in(class, theirs.len() as u64);
        if seen.differ > so_far {
            differing.push(at);
        }
    }
    seen.observed.extra += map.map_or_else(
        || dump.rows().saturating_sub(next) as u64,
        |left| left.values().map(|rows| rows.len() as u64).sum(),
    );
    (seen.finish(columns), differing)
}

/// Rows that have a condition, and those of them in which each column differs.
#[derive(Clone, Debug)]
struct Count {
    condition: Condition,
    rows: u64,
    differ: Vec<u64>,
}

/// What is counted on the way.
struct Seen {
    observed: Observed,
    /// Rows that differ, are missing or too many.
    differ: u64,
    key: usize,
    relations: Vec<Relations>,
    /// Rows in which each column differs.
    rows: Vec<u64>,
    counts: Vec<Count>,
    /// Whether a column was compared in any row.
    compared: Vec<bool>,
    /// The word of each column, if it is the same in every row.
    constant: Vec<Option<u128>>,
    /// Rows too many, and those of them beside each side of the box: left, right, top, bottom.
    beside: [u64; 5],
}

/// The sides of a box, as [`Seen::beside`] has them.
const SIDES: [&str; 4] = ["left", "right", "top", "bottom"];

impl Seen {
    fn new(subject: &Subject) -> Self {
        let columns = subject.spec.columns.len();
        let count = |condition| Count { condition, rows: 0, differ: vec![0; columns] };
        Self {
            observed: Observed::default(),
            differ: 0,
            key: subject.key(),
            relations: vec![Relations::new(columns); columns],
            rows: vec![0; columns],
            counts: Condition::all(&subject.spec, &subject.cfg).into_iter().map(count).collect(),
            compared: vec![false; columns],
            constant: Vec::new(),
            beside: [0; 5],
        }
    }

    /// A row too many: whether it lies beside a side of its box.
    fn beyond(&mut self, subject: &Subject, got: &[u128], stimulus: &[u128]) {
        let word = |columns: &[Column], words: &[u128], role: Role| {
            let k = columns.iter().position(|column| column.name == role.pattern)?;
            words.get(k).copied()
        };
        let own = |role| word(&subject.spec.columns, got, role);
        let end = |role| word(&subject.cfg.columns, stimulus, role);
        // A sample has an x, a run has its two ends.
        let first = own(Role::X).or(own(Role::X_BEGIN));
        let last = own(Role::X).or(own(Role::X_END).map(|x| x.wrapping_sub(1)));
        let (y, before) = (own(Role::Y), |end: u128| end.wrapping_sub(1));
        let beside = [
            first.is_some() && first == end(Role::BOX_X_BEGIN).map(before),
            last.is_some() && last == end(Role::BOX_X_END),
            y.is_some() && y == end(Role::BOX_Y_BEGIN).map(before),
            y.is_some() && y == end(Role::BOX_Y_END),
        ];
        for (count, here) in self.beside.iter_mut().zip([true].into_iter().chain(beside)) {
            *count += u64::from(here);
        }
    }

    fn differs_in(&mut self, class: &str, rows: u64) {
        self.differ += rows;
        if rows > 0 {
            *self.observed.classes.entry(class.to_owned()).or_default() += rows;
        }
    }

    fn row(&mut self, subject: &Subject, class: &str, row: &Row<'_>) {
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
        self.differs_in(class, u64::from(differs.contains(&true)));
        for (k, column) in columns.iter().enumerate() {
            if differs[k] {
                self.rows[k] += 1;
                self.relations[k].note(column, k, row);
            }
            self.compared[k] |= row.ignored[k] != u128::MAX >> (128 - column.width);
        }
        for count in &mut self.counts {
            if count.condition.holds(columns, &subject.cfg.columns, row) {
                count.rows += 1;
                count.differ.iter_mut().zip(&differs).for_each(|(n, here)| *n += u64::from(*here));
            }
        }
    }

    fn finish(mut self, columns: &[Column]) -> Observed {
        let mut differing = (0..columns.len()).filter(|k| self.rows[*k] > 0).peekable();
        let moved = self.observed.missing + self.observed.extra > 0;
        // A device that answers something else besides tells with it what it does right. What a record itself
        // says is no answer.
        let alive = (self.key..columns.len()).any(|k| {
            let told =
                [Role::OP, Role::ZERO_AREA].iter().any(|role| columns[k].name == role.pattern);
            let answers = self.compared[k] && !told;
            answers && self.constant[k].is_none()
        });
        self.observed.trivial = !moved
            && !alive
            && self.observed.rows > 1
            && differing.peek().is_some()
            && differing.all(|k| self.constant[k].is_some());
        // Nothing came at all.
        self.observed.trivial |= self.key > 0 && self.observed.rows + self.observed.extra == 0;
        let [all, sides @ ..] = self.beside;
        let beside = SIDES.iter().zip(sides).filter(|(_, rows)| all > 2 && *rows == all);
        let beside = beside.map(|(side, _)| format!("each beside the {side} side of its box"));
        self.observed.extra_facts.extend(beside);
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
            let told = self.counts.iter().filter(|count| {
                count.differ[k] == differ && differ > 2 && count.rows * 4 < all * 3
            });
            if let Some(count) = told.min_by_key(|count| count.rows) {
                let how = if count.rows == differ { "exactly" } else { "only" };
                facts.push(format!("{how} {}", count.condition.text(columns)));
            } else if differ == all && all > 2 {
                facts.push("in every row".to_owned());
            }
            self.observed.differ.push(Differs { column: column.name.clone(), rows: differ, facts });
        }
        self.observed
    }
}
