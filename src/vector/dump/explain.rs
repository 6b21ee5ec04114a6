//! Mismatches in words, and their cause.

use super::compare::{Answer, ByTest, by_test};
use super::read::Dump;
use super::{Judged, Subject, value};
use crate::vector::bench::{Run, TestAt, in_fields};
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
    if let Some(behind) = subject.bench.behind(at, &subject.spec, &expected) {
        let _ = writeln!(text, "  {behind}");
    }
    let _ = write!(text, "  {}, row {n} of the test", subject.bench.describe(at));
    text
}

/// What may be behind the dumps of a bench.
pub(super) struct Causes {
    /// Single changes that make the dumps agree, simplest first, with their module and part.
    pub(super) named: Vec<(String, Option<(&'static str, &'static str)>)>,
    /// Whether the first of them is said with confidence.
    pub(super) sure: bool,
    /// How many were tried.
    pub(super) tried: usize,
    /// Whether nothing is wrong but that rows are missing.
    pub(super) lost: bool,
}

/// How much less simple a fault is in a copy of a module than in the module.
const COPY: u8 = 16;

/// Most changes of one module that count as one thing said in several ways: no row of the set tells
/// them apart.
const RIVALS: usize = 6;

/// Looks for the cause among the suspects of the bench: what explains every row of every dump.
/// Modules in `sound` have been found right by a bench of their own, those in `broken` wrong.
pub(super) fn causes(group: &[&Judged], sound: &[&str], broken: &[&str]) -> Causes {
    let subject = &group[0].subject;
    let maps: Vec<Option<ByTest>> = group
        .iter()
        .map(|judged| judged.subject.names_tests().then(|| by_test(&judged.subject, &judged.dump)))
        .collect();
    let suspects = subject.bench.suspects();
    let tried = suspects.len();
    let probes = Probe::all(group);
    let mut named: Vec<(u8, String, _)> = Vec::new();
    for mut suspect in suspects {
        // A module that its own bench finds right can still be wrong in a copy of the engine's own.
        let copy = suspect.place.map(|(module, _)| module).filter(|module| sound.contains(module));
        if let Some(module) = copy {
            suspect.rank += COPY;
            suspect.change =
                format!("in a copy of {module} of the engine's own, {}", suspect.change);
        }
        // Most do not even explain the quickest tests that differ.
        let mut explains_probe = |probe: &Probe| probe.explains(group, &maps, &mut *suspect.run);
        if suspect.forgets && !probes.iter().all(&mut explains_probe) {
            continue;
        }
        let explained = explains(group, &maps, suspect.run, suspect.unsettled);
        // A change can be tried in more than one guise.
        if explained && named.iter().all(|(_, change, _)| *change != suspect.change) {
            named.push((suspect.rank, suspect.change, suspect.place));
        }
    }
    let lost = named.is_empty()
        && group.iter().zip(&maps).all(|(judged, map)| is_part(judged, map.as_ref()));
    named.sort_by_key(|(rank, ..)| *rank);
    // Copies are looked at where nothing else explains the dumps.
    if named.iter().any(|(rank, ..)| *rank < COPY) {
        named.retain(|(rank, ..)| *rank < COPY);
    }
    let module = |place: Option<(&'static str, &'static str)>| place.map(|(module, _)| module);
    // What a bench of its own finds wrong explains the rest; a decision of the profile has no module.
    let is_broken = |place| module(place).is_some_and(|module| broken.contains(&module));
    if named.iter().any(|(.., place)| is_broken(*place)) {
        named.retain(|(.., place)| place.is_none() || is_broken(*place));
    }
    let together = named.iter().all(|(.., place)| module(*place) == module(named[0].2));
    let sure = named.len() == 1 || together && (1..=RIVALS).contains(&named.len());
    let named = named.into_iter().map(|(_, change, place)| (change, place)).collect();
    Causes { named, sure, tried, lost }
}

/// A test in which a dump differs, and that is quickly run.
struct Probe {
    at: TestAt,
    limit: u64,
    /// The row of each ordered dump that the test begins with.
    rows: Vec<usize>,
}

/// How many tests are looked at for a quick one.
const LOOKED_AT: usize = 1000;

/// The work of all probes together, beyond the first.
const WORK: u64 = 1000;

impl Probe {
    /// The probes of dumps, quickest first.
    fn all(group: &[&Judged]) -> Vec<Self> {
        let bench = &*group[0].subject.bench;
        let tests = group.iter().flat_map(|judged| judged.differing.iter().take(LOOKED_AT));
        let mut quickest: Vec<(u64, u64)> = tests.map(|at| (bench.work(*at), at.test)).collect();
        quickest.sort_unstable();
        quickest.dedup();
        let mut sum = 0;
        let few = quickest.iter().take_while(|(work, _)| {
            sum += work;
            sum <= WORK
        });
        let few = few.take(3).count().max(1);
        quickest.truncate(few);
        let mut probes = Vec::new();
        let mut rows = vec![0; group.len()];
        for (at, limit) in group[0].subject.tests() {
            if let Some((work, _)) = quickest.iter().find(|(_, test)| *test == at.test) {
                probes.push((*work, Self { at, limit, rows: rows.clone() }));
                if probes.len() == quickest.len() {
                    break;
                }
            }
            for (row, _) in
                rows.iter_mut().zip(group).filter(|(_, judged)| !judged.subject.names_tests())
            {
                let given = bench.rows(at).and_then(|given| usize::try_from(given.min(limit)).ok());
                let Some(given) = given else { return Vec::new() };
                *row += given;
            }
        }
        probes.sort_by_key(|(work, _)| *work);
        probes.into_iter().map(|(_, probe)| probe).collect()
    }

    fn explains(&self, group: &[&Judged], maps: &[Option<ByTest>], run: &mut dyn Run) -> bool {
        run.run(self.at, self.limit);
        let mut agrees = true;
        for (file, table) in run.tables().into_iter().enumerate() {
            for (n, Judged { subject, dump, .. }) in group.iter().enumerate() {
                if subject.file != file {
                    continue;
                }
                let mut rows = table.buffer.chunks_exact(subject.stride());
                agrees &= if let Some(map) = &maps[n] {
                    let theirs = map.get(&u128::from(self.at.test)).map_or(&[][..], Vec::as_slice);
                    agree(subject, rows, theirs, dump, true)
                } else {
                    let first = self.rows[n];
                    // The beginning of a file can be unsettled, and its end can be missing.
                    first < 2
                        || (first..)
                            .zip(&mut rows)
                            .all(|(row, words)| row >= dump.rows() || dump.agrees(row, words))
                };
            }
            table.buffer.clear();
        }
        agrees
    }
}

/// Whether a device answers every row of every dump.
fn explains(
    group: &[&Judged],
    maps: &[Option<ByTest>],
    mut run: Box<dyn Run + '_>,
    unsettled: u64,
) -> bool {
    let subject = &group[0].subject;
    let mut buffers: Vec<Vec<u8>> = vec![Vec::new(); group.len()];
    let mut next = vec![0; group.len()];
    let mut seen = vec![0; group.len()];
    for (at, limit) in subject.tests() {
        run.run(at, limit);
        for (file, table) in run.tables().into_iter().enumerate() {
            for (judged, buffer) in group.iter().zip(&mut buffers) {
                if judged.subject.file == file {
                    std::mem::swap(buffer, &mut table.buffer);
                }
            }
            table.buffer.clear();
        }
        for (n, Judged { subject, dump, report, .. }) in group.iter().enumerate() {
            let rows = buffers[n].chunks_exact(subject.stride());
            if let Some(map) = &maps[n] {
                let theirs = map.get(&u128::from(at.test)).map_or(&[][..], Vec::as_slice);
                seen[n] += usize::from(!theirs.is_empty());
                if !agree(subject, rows, theirs, dump, true) {
                    return false;
                }
                continue;
            }
            for words in rows {
                if next[n] == dump.rows() {
                    if report.short {
                        break;
                    }
                    return false;
                }
                if (next[n] as u64) >= unsettled && !dump.agrees(next[n], words) {
                    return false;
                }
                next[n] += 1;
            }
        }
        if group.iter().zip(&next).all(|(judged, next)| {
            !judged.subject.names_tests() && judged.report.short && *next == judged.dump.rows()
        }) {
            return true;
        }
    }
    (0..group.len()).all(|n| match &maps[n] {
        Some(map) => seen[n] == map.len(),
        None => next[n] == group[n].dump.rows(),
    })
}

/// Whether each row of a test in a dump is one of a device's, none twice, and in its order where a file has no key;
/// `whole`: and each of those is there.
fn agree<'r>(
    subject: &Subject,
    rows: impl Iterator<Item = &'r [u8]>,
    theirs: &[usize],
    dump: &Dump,
    whole: bool,
) -> bool {
    if subject.key() == 0 {
        let mut next = theirs.iter().peekable();
        for words in rows {
            if next.next_if(|row| dump.agrees(**row, words)).is_none() && whole {
                return false;
            }
        }
        return next.peek().is_none();
    }
    let mut found = 0;
    for words in rows {
        let here = theirs.iter().filter(|row| dump.agrees(**row, words)).count();
        if here > 1 || here == 0 && whole {
            return false;
        }
        found += here;
    }
    found == theirs.len()
}

/// Whether a dump is the expectation with rows left out.
fn is_part(Judged { subject, dump, .. }: &Judged, keyed: Option<&ByTest>) -> bool {
    let mut expected = Answer::expected(subject);
    let mut next = 0;
    let mut seen = 0;
    for (at, limit) in subject.tests() {
        let rows = expected.rows(at, limit);
        if let Some(map) = keyed {
            let theirs = map.get(&u128::from(at.test)).map_or(&[][..], Vec::as_slice);
            seen += usize::from(!theirs.is_empty());
            if !agree(subject, rows, theirs, dump, false) {
                return false;
            }
            continue;
        }
        for words in rows {
            next += usize::from(next < dump.rows() && dump.agrees(next, words));
        }
    }
    keyed.map_or(next == dump.rows(), |map| seen == map.len())
}
