//! Row by row, in order or by key.

use super::explain::mismatch_text;
use super::read::{DumpError, DumpRow, RowReader};
use super::{DumpReport, Mismatch, Subject};
use crate::vector::bench::{Bench, Coverage, TestAt};
use crate::vector::plan::test_id;
use crate::vector::table::{RowFormat, Table};
use std::collections::HashMap;
use std::path::Path;

/// The expectations of one test in the subject's file, under any bench of the same files.
pub(super) struct Expected {
    tables: Vec<Table>,
    file: usize,
}

impl Expected {
    pub(super) fn new(subject: &Subject) -> Self {
        let files = subject.bench.files();
        let tables = files.iter().map(|spec| Table::new(RowFormat::Tv, &spec.columns)).collect();
        Self { tables, file: subject.file }
    }

    /// Rows of words.
    pub(super) fn rows(&mut self, bench: &dyn Bench, at: TestAt, limit: u64) -> Vec<Vec<u128>> {
        for table in &mut self.tables {
            table.buffer.clear();
        }
        bench.emit(at, limit, &mut self.tables, &mut Coverage::default());
        self.tables[self.file].take_words()
    }
}

/// Whether a row of a dump agrees with the expectation, where the dump's mask looks.
pub(super) fn agrees(expected: &[u128], row: &DumpRow) -> bool {
    expected.iter().enumerate().all(|(n, word)| {
        (row.unknown[n] & !row.ignored[n]) == 0 && (word ^ row.words[n]) & !row.ignored[n] == 0
    })
}

/// All rows of a keyed dump, by test.
pub(super) type ByTest = HashMap<u128, Vec<DumpRow>>;

/// Reads a keyed dump.
pub(super) fn by_test(
    subject: &Subject,
    dump: &Path,
) -> Result<(ByTest, u64, Option<u64>), DumpError> {
    let mut reader = RowReader::open(dump, &subject.spec.columns)?;
    let (mut rows, mut map) = (0, ByTest::new());
    while let Some(row) = reader.next_row()? {
        rows += 1;
        map.entry(row.words[0]).or_default().push(row);
    }
    Ok((map, rows, reader.cut()))
}

/// Compares a dump with the set's own expectations.
pub(super) fn against(
    subject: &Subject,
    dump: &Path,
    most: usize,
) -> Result<DumpReport, DumpError> {
    let mut report = DumpReport::default();
    if subject.key() > 0 {
        keyed(subject, dump, most, &mut report)?;
    } else {
        ordered(subject, dump, most, &mut report)?;
    }
    if report.rows == 0 && report.expected_rows > 0 {
        return Err(DumpError::Empty { path: dump.display().to_string() });
    }
    Ok(report)
}

fn keep(report: &mut DumpReport, most: usize, mismatch: impl FnOnce() -> Mismatch) {
    report.total += 1;
    if report.mismatches.len() < most {
        report.mismatches.push(mismatch());
    }
}

fn ordered(
    subject: &Subject,
    dump: &Path,
    most: usize,
    report: &mut DumpReport,
) -> Result<(), DumpError> {
    let mut reader = RowReader::open(dump, &subject.spec.columns)?;
    let mut expected = Expected::new(subject);
    let bench = &*subject.bench;
    for (at, limit) in subject.tests() {
        for (n, words) in expected.rows(bench, at, limit).iter().enumerate() {
            report.expected_rows += 1;
            if report.short {
                continue;
            }
            let Some(row) = reader.next_row()? else {
                report.short = true;
                keep(report, most, || Mismatch {
                    row: None,
                    line: None,
                    test: test_id(bench, at),
                    text: "the dump ends here: a simulation that stopped early?".to_owned(),
                });
                continue;
            };
            report.rows += 1;
            if !agrees(words, &row) {
                report.disagrees = true;
                let number = report.expected_rows;
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: Some(row.line),
                    test: test_id(bench, at),
                    text: mismatch_text(subject, at, n, words, &row),
                });
            }
        }
    }
    while let Some(row) = reader.next_row()? {
        report.rows += 1;
        report.disagrees = true;
        keep(report, most, || Mismatch {
            row: None,
            line: Some(row.line),
            test: "-".to_owned(),
            text: "a row too much: the set has ended".to_owned(),
        });
    }
    report.cut = reader.cut();
    beginning_too_much(report, most);
    Ok(())
}

fn keyed(
    subject: &Subject,
    dump: &Path,
    most: usize,
    report: &mut DumpReport,
) -> Result<(), DumpError> {
    let (mut map, rows, cut) = by_test(subject, dump)?;
    (report.rows, report.cut) = (rows, cut);
    let mut expected = Expected::new(subject);
    let bench = &*subject.bench;
    // Rows in file order: the number of this one, of the last one found, of the first one missing.
    let (mut number, mut last, mut gap) = (0, 0, u64::MAX);
    for (at, limit) in subject.tests() {
        let rows = expected.rows(bench, at, limit);
        let mut theirs = map.remove(&u128::from(at.test)).unwrap_or_default();
        report.expected_rows += rows.len() as u64;
        for (n, words) in rows.iter().enumerate() {
            number += 1;
            let same_key = |row: &DumpRow| row.words[..subject.key()] == words[..subject.key()];
            let Some(found) = theirs.iter().position(same_key) else {
                gap = gap.min(number);
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: None,
                    test: test_id(bench, at),
                    text: missing_text(subject, at, words),
                });
                continue;
            };
            last = number;
            let row = theirs.remove(found);
            if !agrees(words, &row) {
                report.disagrees = true;
                keep(report, most, || Mismatch {
                    row: Some(number),
                    line: Some(row.line),
                    test: test_id(bench, at),
                    text: mismatch_text(subject, at, n, words, &row),
                });
            }
        }
        for row in theirs {
            report.disagrees = true;
            keep(report, most, || Mismatch {
                row: None,
                line: Some(row.line),
                test: test_id(bench, at),
                text: extra_text(subject, at, &row),
            });
        }
    }
    report.short = gap < u64::MAX && gap > last;
    report.disagrees |= gap < last;
    let mut left: Vec<DumpRow> = map.into_values().flatten().collect();
    left.sort_by_key(|row| row.line);
    for row in left {
        report.disagrees = true;
        let known = u64::try_from(row.words[0]).ok().and_then(|number| subject.test(number));
        let text = match known {
            Some(at) => extra_text(subject, at, &row),
            None => format!("test {:x} is no test of the set", row.words[0]),
        };
        keep(report, most, || Mismatch {
            row: None,
            line: Some(row.line),
            test: "-".to_owned(),
            text,
        });
    }
    beginning_too_much(report, most);
    Ok(())
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
            text: "the beginning of a row too much: the set has ended".to_owned(),
        });
    }
}

/// Key columns by name, in decimal.
fn place(subject: &Subject, words: &[u128]) -> String {
    let columns = subject.spec.columns.iter().zip(words).take(subject.key());
    columns.map(|(column, word)| format!("{} {word}", column.name)).collect::<Vec<_>>().join(", ")
}

fn missing_text(subject: &Subject, at: TestAt, words: &[u128]) -> String {
    format!("missing: {}\n  {}", place(subject, words), subject.bench.describe(at))
}

fn extra_text(subject: &Subject, at: TestAt, row: &DumpRow) -> String {
    format!("too much: {}\n  {}", place(subject, &row.words), subject.bench.describe(at))
}
