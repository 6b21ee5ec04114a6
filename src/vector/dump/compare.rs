//! Row by row, in order or by key.

use super::align;
use super::explain::mismatch_text;
use super::read::Dump;
use super::{DumpReport, Mismatch, Subject};
use crate::format::Column;
use crate::vector::bench::{Run, TestAt};
use crate::vector::plan::test_id;
use crate::vector::table::{RowFormat, unpack};
use std::collections::HashMap;

/// What a device answers in the subject's file, test by test, its rows packed.
pub(super) struct Answer<'r> {
    run: Box<dyn Run + 'r>,
    file: usize,
    /// The row of the configuration file that drove the last test, packed.
    cfg: Vec<u8>,
    columns: Vec<Column>,
    stride: usize,
    rows: Vec<u8>,
}

impl<'r> Answer<'r> {
    /// The answers of a device whose tables have the form `bin`.
    pub(super) fn new(subject: &Subject, run: Box<dyn Run + 'r>) -> Self {
        let columns = subject.cfg.columns.clone();
        let (file, stride) = (subject.file, subject.stride());
        Self { run, file, cfg: Vec::new(), columns, stride, rows: Vec::new() }
    }

    /// The expectations.
    pub(super) fn expected(subject: &'r Subject) -> Self {
        Self::new(subject, subject.bench.reference(RowFormat::Bin))
    }

    /// Rows of one test.
    pub(super) fn rows(&mut self, at: TestAt, limit: u64) -> impl Iterator<Item = &[u8]> {
        self.rows_and_stimulus(at, limit).0
    }

    /// Rows of one test, and the words of the configuration that drove it.
    pub(super) fn rows_and_stimulus(
        &mut self,
        at: TestAt,
        limit: u64,
    ) -> (impl Iterator<Item = &[u8]>, Vec<u128>) {
        self.run.run(at, limit);
        for (file, table) in self.run.tables().into_iter().enumerate() {
            if file == self.file {
                std::mem::swap(&mut self.rows, &mut table.buffer);
            } else if file == 0 {
                std::mem::swap(&mut self.cfg, &mut table.buffer);
            }
            table.buffer.clear();
        }
        (self.rows.chunks_exact(self.stride), unpack(&self.cfg, &self.columns))
    }
}

/// Rows of a dump that name their test, by test.
pub(super) type ByTest = HashMap<u128, Vec<usize>>;

/// Sorts the rows of a dump by the test that they name.
pub(super) fn by_test(subject: &Subject, dump: &Dump) -> ByTest {
    let mut map = ByTest::new();
    for row in 0..dump.rows() {
        let test = unpack(dump.row(row), &subject.spec.columns[..1])[0];
        map.entry(test).or_default().push(row);
    }
    map
}

/// Compares a dump with the set's own expectations.
pub(super) fn against(subject: &Subject, dump: &Dump, most: usize) -> DumpReport {
    let rows = dump.rows() as u64;
    let mut report = DumpReport { rows, cut: dump.cut(), ..DumpReport::default() };
    if subject.names_tests() {
        by_tests(subject, dump, most, &mut report);
    } else {
        ordered(subject, dump, most, &mut report);
    }
    beginning_too_much(&mut report, most);
    report
}

fn keep(report: &mut DumpReport, most: usize, mismatch: impl FnOnce() -> Mismatch) {
    report.total += 1;
    if report.mismatches.len() < most {
        report.mismatches.push(mismatch());
    }
}

fn ordered(subject: &Subject, dump: &Dump, most: usize, report: &mut DumpReport) {
    let mut expected = Answer::expected(subject);
    let bench = &*subject.bench;
    let mut next = 0;
    for (at, limit) in subject.tests() {
        for (n, words) in expected.rows(at, limit).enumerate() {
            report.expected_rows += 1;
            if next == dump.rows() {
                if !report.short {
                    keep(report, most, || Mismatch {
                        row: None,
                        line: None,
                        test: test_id(bench, at),
                        text: "the dump ends here; check if the simulation stopped early"
                            .to_owned(),
                    });
                }
                report.short = true;
                continue;
            }
            if !dump.agrees(next, words) {
                report.disagrees = true;
                let number = report.expected_rows;
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: Some(dump.line(next)),
                    test: test_id(bench, at),
                    text: mismatch_text(subject, at, n, words, (dump, next)),
                });
            }
            next += 1;
        }
    }
    for row in next..dump.rows() {
        report.disagrees = true;
        keep(report, most, || Mismatch {
            row: None,
            line: Some(dump.line(row)),
            test: "-".to_owned(),
            text: "extra row: the set has no more rows".to_owned(),
        });
    }
}

/// Which row of a dump belongs to each row of a test, and those that are too much: by their key, or in order.
pub(super) fn matched(
    subject: &Subject,
    dump: &Dump,
    rows: &[&[u8]],
    mut theirs: Vec<usize>,
) -> (Vec<Option<usize>>, Vec<usize>) {
    let key = subject.key_bytes();
    if subject.key() == 0 {
        return align::aligned(rows.len(), &theirs, |n, row| dump.agrees(row, rows[n]));
    }
    let found = rows.iter().map(|words| {
        let same_key = |row: &usize| dump.row(*row)[..key] == words[..key];
        theirs.iter().position(same_key).map(|found| theirs.remove(found))
    });
    (found.collect(), theirs)
}

fn by_tests(subject: &Subject, dump: &Dump, most: usize, report: &mut DumpReport) {
    let mut map = by_test(subject, dump);
    let mut expected = Answer::expected(subject);
    let bench = &*subject.bench;
    // Rows in file order: the number of this one, of the last one found, of the first one missing.
    let (mut number, mut last, mut gap) = (0, 0, u64::MAX);
    for (at, limit) in subject.tests() {
        // A test may have no row.
        let theirs = map.remove(&u128::from(at.test)).unwrap_or_default();
        let rows: Vec<&[u8]> = expected.rows(at, limit).collect();
        let (found, extra) = matched(subject, dump, &rows, theirs);
        for (n, (words, found)) in rows.into_iter().zip(found).enumerate() {
            report.expected_rows += 1;
            number += 1;
            let Some(row) = found else {
                gap = gap.min(number);
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: None,
                    test: test_id(bench, at),
                    text: lone_text("missing", subject, at, words),
                });
                continue;
            };
            last = number;
            if !dump.agrees(row, words) {
                report.disagrees = true;
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: Some(dump.line(row)),
                    test: test_id(bench, at),
                    text: mismatch_text(subject, at, n, words, (dump, row)),
                });
            }
        }
        for row in extra {
            report.disagrees = true;
            keep(report, most, || Mismatch {
                row: None,
                line: Some(dump.line(row)),
                test: test_id(bench, at),
                text: lone_text("extra row", subject, at, dump.row(row)),
            });
        }
    }
    report.short = gap < u64::MAX && gap > last;
    report.disagrees |= gap < last;
    let mut left: Vec<(u128, usize)> = map
        .into_iter()
        .flat_map(|(test, rows)| rows.into_iter().map(move |row| (test, row)))
        .collect();
    left.sort_unstable_by_key(|(_, row)| *row);
    for (test, row) in left {
        report.disagrees = true;
        let known = u64::try_from(test).ok().and_then(|number| subject.test(number));
        let text = match known {
            Some(at) => lone_text("extra row", subject, at, dump.row(row)),
            None => format!("the set has no test {test:x}"),
        };
        let line = Some(dump.line(row));
        keep(report, most, || Mismatch { row: None, line, test: "-".to_owned(), text });
    }
}

/// The beginning of a row where none is missing.
fn beginning_too_much(report: &mut DumpReport, most: usize) {
    if report.cut.is_some() && !report.short {
        report.disagrees = true;
        let line = report.cut;
        keep(report, most, || Mismatch {
            row: None,
            line,
            test: "-".to_owned(),
            text: "start of an extra row: the set has no more rows".to_owned(),
        });
    }
}

/// Key columns by name, in decimal.
fn place(subject: &Subject, row: &[u8]) -> String {
    // Without a key, the whole row says what it is.
    let columns = match subject.key() {
        0 => &subject.spec.columns[..],
        key => &subject.spec.columns[..key],
    };
    let words = columns.iter().zip(unpack(row, columns));
    words.map(|(column, word)| format!("{} {word}", column.name)).collect::<Vec<_>>().join(", ")
}

/// A row that is only on one side: what is said of it, its place, and what stands behind it.
fn lone_text(what: &str, subject: &Subject, at: TestAt, row: &[u8]) -> String {
    let words = unpack(row, &subject.spec.columns);
    let behind = subject.bench.behind(at, &subject.spec, &words);
    let behind = behind.map_or_else(String::new, |behind| format!("  {behind}\n"));
    let place = place(subject, row);
    format!("{what}: {place}\n{behind}  {}", subject.bench.describe(at))
}
