//! Mismatches in words, and their cause.

use super::Subject;
use super::compare::{ByTest, Expected, agrees, by_test};
use super::read::{DumpError, DumpRow, RowReader};
use crate::format::Column;
use crate::vector::bench::{Bench, TestAt};
use std::fmt::Write as _;
use std::path::Path;

/// The columns that disagree, in hexadecimal, in fields and as a distance.
pub(super) fn mismatch_text(
    subject: &Subject,
    at: TestAt,
    n: usize,
    expected: &[u128],
    row: &DumpRow,
) -> String {
    let mut text = String::new();
    for (k, column) in subject.spec.columns.iter().enumerate() {
        let looked_at = !row.ignored[k];
        let unknown = row.unknown[k] & looked_at;
        if (expected[k] ^ row.words[k]) & looked_at == 0 && unknown == 0 {
            continue;
        }
        let wanted = crate::bits::hex(expected[k], column.width);
        // Writing to a String cannot fail.
        if unknown != 0 {
            let _ = writeln!(text, "{}: expected {wanted}, got unknown bits (X or Z)", column.name);
            continue;
        }
        let got = crate::bits::hex(row.words[k], column.width);
        let distance = value(column, row.words[k]).wrapping_sub(value(column, expected[k]));
        let unit = if column.fraction == 0 {
            String::new()
        } else {
            format!(" of 2^-{}", column.fraction)
        };
        let _ = writeln!(
            text,
            "{}: expected {wanted}, got {got}: off by {distance:+}{unit}",
            column.name
        );
        let fields = subject.bench.fields(&column.name);
        if !fields.is_empty() {
            let _ = writeln!(text, "  expected {}", in_fields(&fields, expected[k]));
            let _ = writeln!(text, "  got      {}", in_fields(&fields, row.words[k]));
        }
    }
    let _ = write!(text, "  {}, row {n} of the test", subject.bench.describe(at));
    text
}

fn value(column: &Column, word: u128) -> i128 {
    let unused = 128 - column.width;
    if column.signed { word.cast_signed() << unused >> unused } else { word.cast_signed() }
}

fn in_fields(fields: &[(String, u32)], word: u128) -> String {
    let mut left: u32 = fields.iter().map(|(_, bits)| bits).sum();
    let mut parts = Vec::new();
    for (name, bits) in fields.iter().filter(|(_, bits)| *bits > 0) {
        left -= bits;
        let field = word >> left & (u128::MAX >> (128 - bits));
        parts.push(format!("{name} {field:0width$b}", width = *bits as usize));
    }
    parts.join(" | ")
}

/// Looks for the cause among the single changes that the bench knows.
pub(super) fn causes(subject: &Subject, dump: &Path, short: bool) -> Result<Causes, DumpError> {
    let keyed = if subject.key() > 0 { Some(by_test(subject, dump)?.0) } else { None };
    let variants = subject.bench.variants();
    let mut causes = Vec::new();
    for (name, bench) in &variants {
        let explained = match &keyed {
            Some(map) => agrees_keyed(subject, &**bench, map, true),
            None => explains_ordered(subject, &**bench, dump, short)?,
        };
        // A change can be tried in more than one guise.
        if explained && !causes.contains(name) {
            causes.push(name.clone());
        }
    }
    let lost = causes.is_empty() && is_part(subject, dump, keyed.as_ref())?;
    Ok(Causes { named: causes, tried: variants.len(), lost })
}

/// What may be behind a dump.
pub(super) struct Causes {
    /// Single changes that make the whole dump agree.
    pub(super) named: Vec<String>,
    /// How many were tried.
    pub(super) tried: usize,
    /// Whether nothing is wrong but that rows are missing.
    pub(super) lost: bool,
}

/// Whether the dump is the expectation with rows left out.
fn is_part(subject: &Subject, dump: &Path, keyed: Option<&ByTest>) -> Result<bool, DumpError> {
    let mut expected = Expected::new(subject);
    let bench = &*subject.bench;
    if let Some(map) = keyed {
        return Ok(agrees_keyed(subject, bench, map, false));
    }
    let mut reader = RowReader::open(dump, &subject.spec.columns)?;
    let mut next = reader.next_row()?;
    for (at, limit) in subject.tests() {
        for words in expected.rows(bench, at, limit) {
            if next.as_ref().is_some_and(|row| agrees(&words, row)) {
                next = reader.next_row()?;
            }
        }
    }
    Ok(next.is_none())
}

fn explains_ordered(
    subject: &Subject,
    bench: &dyn Bench,
    dump: &Path,
    short: bool,
) -> Result<bool, DumpError> {
    let mut reader = RowReader::open(dump, &subject.spec.columns)?;
    let mut expected = Expected::new(subject);
    let mut open = bench.unsettled();
    for (at, limit) in subject.tests() {
        for words in expected.rows(bench, at, limit) {
            match reader.next_row()? {
                Some(_) if open > 0 => open -= 1,
                Some(row) if agrees(&words, &row) => {}
                Some(_) => return Ok(false),
                // A dump cut short is explained as far as it goes.
                None => return Ok(short),
            }
        }
    }
    Ok(reader.next_row()?.is_none())
}

/// Whether each row of the dump is one of the expectation's, none twice; `whole`: and each of those
/// is there.
fn agrees_keyed(subject: &Subject, bench: &dyn Bench, map: &ByTest, whole: bool) -> bool {
    let mut expected = Expected::new(subject);
    let mut seen = 0;
    let none = Vec::new();
    for (at, limit) in subject.tests() {
        let rows = expected.rows(bench, at, limit);
        let theirs = map.get(&u128::from(at.test)).unwrap_or(&none);
        seen += usize::from(!theirs.is_empty());
        let found = |words: &Vec<u128>| theirs.iter().filter(|row| agrees(words, row)).count();
        let few = |n: usize| if whole { n == 1 } else { n <= 1 };
        let counts: Vec<usize> = rows.iter().map(found).collect();
        if counts.iter().sum::<usize>() != theirs.len() || !counts.into_iter().all(few) {
            return false;
        }
    }
    seen == map.len()
}
