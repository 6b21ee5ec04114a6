//! Mismatches in words, and their cause.

use super::compare::{Answer, ByTest, by_test};
use super::observe::Observed;
use super::read::Dump;
use super::{Placed, Subject};
use crate::format::{Column, Role};
use crate::vector::bench::TestAt;
use crate::vector::table::unpack;
use std::fmt::Write as _;

/// The columns that disagree, in hexadecimal, in fields and as a distance.
pub(super) fn mismatch_text(
    subject: &Subject,
    at: TestAt,
    n: usize,
    expected: &[u8],
    (dump, row): (&Dump, usize),
) -> String {
    let expected = unpack(expected, &subject.spec.columns);
    let [words, unknown, ignored] = dump.words(row);
    let mut text = String::new();
    for (k, column) in subject.spec.columns.iter().enumerate() {
        let looked_at = !ignored[k];
        let unknown = unknown[k] & looked_at;
        if (expected[k] ^ words[k]) & looked_at == 0 && unknown == 0 {
            continue;
        }
        let wanted = crate::bits::hex(expected[k], column.width);
        // Writing to a String cannot fail.
        if unknown != 0 {
            let _ = writeln!(text, "{}: expected {wanted}, got unknown bits (X or Z)", column.name);
            continue;
        }
        let got = crate::bits::hex(words[k], column.width);
        let distance = value(column, words[k]).wrapping_sub(value(column, expected[k]));
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
            let _ = writeln!(text, "  got      {}", in_fields(&fields, words[k]));
        }
    }
    let _ = write!(text, "  {}, row {n} of the test", subject.bench.describe(at));
    text
}

pub(super) fn value(column: &Column, word: u128) -> i128 {
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

/// What may be behind a dump.
pub(super) struct Causes {
    /// Single changes that make the whole dump agree, with their module and part.
    pub(super) named: Vec<(String, Option<(&'static str, &'static str)>)>,
    /// How many were tried.
    pub(super) tried: usize,
    /// Whether nothing is wrong but that rows are missing.
    pub(super) lost: bool,
}

/// Looks for the cause among the suspects of the bench.
pub(super) fn causes(subject: &Subject, dump: &Dump, short: bool) -> Causes {
    let keyed = (subject.key() > 0).then(|| by_test(subject, dump));
    let suspects = subject.bench.suspects();
    let tried = suspects.len();
    let mut named: Vec<(String, _)> = Vec::new();
    for suspect in suspects {
        let answer = Answer::new(subject, suspect.run);
        let explained = match &keyed {
            Some(map) => agrees_keyed(subject, answer, (dump, map), true),
            None => agrees_ordered(subject, answer, dump, (suspect.unsettled, short)),
        };
        // A change can be tried in more than one guise.
        if explained && named.iter().all(|(change, _)| *change != suspect.change) {
            named.push((suspect.change, suspect.place));
        }
    }
    let lost = named.is_empty() && is_part(subject, dump, keyed.as_ref());
    Causes { named, tried, lost }
}

/// Where the defect is: modules, likeliest first, and the columns that show it.
pub(super) fn place(subject: &Subject, observed: &Observed, causes: &Causes) -> Placed {
    let mut columns: Vec<String> =
        observed.differ.iter().map(|differs| differs.column.clone()).collect();
    if observed.missing + observed.extra > 0 {
        columns.extend(subject.spec.columns[..subject.key()].iter().map(|c| c.name.clone()));
    }
    let mut modules: Vec<&str> = Vec::new();
    for (_, place) in &causes.named {
        let module = place.map(|(module, _)| module);
        modules.extend(module.filter(|module| !modules.contains(module)));
    }
    let plane = |name: &String| {
        [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY].iter().any(|role| role.pattern == name)
    };
    if modules.is_empty() {
        modules = match subject.bench.name() {
            "dda" => vec!["dda"],
            "edge" => vec!["edge_stepper"],
            // The quotients are all that the divider makes, and it makes all three.
            "setup" if columns.iter().all(plane) && columns.len() == 3 => vec!["setup_divider"],
            "setup" => vec!["triangle_setup"],
            // Runs and counts are right here where depths are not missing.
            "triangle"
                if subject.spec.stem == "depth.exp" && observed.missing + observed.extra == 0 =>
            {
                vec!["depth_evaluator", "dda"]
            }
            "triangle" if subject.spec.stem == "triangle.exp" => vec!["triangle_engine"],
            "triangle" => vec!["triangle_engine", "edge_evaluator"],
            other => vec![other],
        };
    }
    Placed { modules: modules.into_iter().map(str::to_owned).collect(), columns }
}

/// Whether the dump is the expectation with rows left out.
fn is_part(subject: &Subject, dump: &Dump, keyed: Option<&ByTest>) -> bool {
    let mut expected = Answer::expected(subject);
    if let Some(map) = keyed {
        return agrees_keyed(subject, expected, (dump, map), false);
    }
    let mut next = 0;
    for (at, limit) in subject.tests() {
        for words in expected.rows(at, limit) {
            next += usize::from(next < dump.rows() && dump.agrees(next, words));
        }
    }
    next == dump.rows()
}

/// Whether the dump is, row by row, what a device answers; its first `open` rows may be anything, and
/// one that is `short` is explained as far as it goes.
fn agrees_ordered(
    subject: &Subject,
    mut answer: Answer<'_>,
    dump: &Dump,
    (open, short): (u64, bool),
) -> bool {
    let mut next = 0;
    for (at, limit) in subject.tests() {
        for words in answer.rows(at, limit) {
            if next == dump.rows() {
                return short;
            }
            if (next as u64) >= open && !dump.agrees(next, words) {
                return false;
            }
            next += 1;
        }
    }
    next == dump.rows()
}

/// Whether each row of the dump is one of a device's, none twice; `whole`: and each of those is there.
fn agrees_keyed(
    subject: &Subject,
    mut answer: Answer<'_>,
    (dump, map): (&Dump, &ByTest),
    whole: bool,
) -> bool {
    let mut seen = 0;
    for (at, limit) in subject.tests() {
        let theirs = map.get(&u128::from(at.test)).map_or(&[][..], Vec::as_slice);
        seen += usize::from(!theirs.is_empty());
        let mut found = 0;
        for words in answer.rows(at, limit) {
            let here = theirs.iter().filter(|row| dump.agrees(**row, words)).count();
            if here > 1 || here == 0 && whole {
                return false;
            }
            found += here;
        }
        if found != theirs.len() {
            return false;
        }
    }
    seen == map.len()
}
