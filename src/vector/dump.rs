//! A device's dump against a set: every mismatch decoded, and the one change of the profile that
//! explains them all, if there is one. Spec clauses `N-12` to `N-14`.

mod align;
mod compare;
mod explain;
mod observe;
mod origin;
mod place;
mod read;

pub use observe::{Differs, Observed};
pub use read::{Dump, DumpError};

use super::bench::{Bench, FileSpec, TestAt, locate, tests};
use super::check::{CheckError, OpenSet, read_scene, source};
use super::plan::Shard;
use crate::format::Column;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Why a dump cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The set.
    #[error(transparent)]
    Set(#[from] CheckError),
    /// The dump.
    #[error(transparent)]
    Dump(#[from] DumpError),
    /// Which file of the set it answers.
    #[error(
        "{name}: the set has no exp file of this name; give the name of the exp file with --file: {known}"
    )]
    Unknown {
        /// The name that was tried.
        name: String,
        /// The files there are.
        known: String,
    },
    /// Only the golden form can be compared.
    #[error(
        "the set has the format {0}, but a dump can be compared only with a set of the format tv; write the set again with --format tv"
    )]
    Format(String),
}

/// One disagreement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// Row in the expectation file, from 1; `None` for a row that is too much.
    pub row: Option<u64>,
    /// Line in the dump; `None` for a row that is missing.
    pub line: Option<u64>,
    /// Test id.
    pub test: String,
    /// What disagrees, in a few lines.
    pub text: String,
}

/// What a comparison found.
#[derive(Clone, Debug, Default)]
pub struct DumpReport {
    /// The expectation file compared with.
    pub file: String,
    /// Rows of the dump.
    pub rows: u64,
    /// Rows the set expects.
    pub expected_rows: u64,
    /// The first mismatches.
    pub mismatches: Vec<Mismatch>,
    /// How many there are in all.
    pub total: u64,
    /// What can be said without any cause.
    pub observed: Observed,
    /// Where the defect is.
    pub placed: Placed,
    /// Single changes that make the whole dump agree, simplest first.
    pub causes: Vec<String>,
    /// The first of them, if it is the cause as far as rows can tell: the others are the same thing said
    /// otherwise.
    pub likely: Option<String>,
    /// How many single changes were tried.
    pub tried: usize,
    /// Whether every row that came agrees and no change explains those that are missing.
    pub lost: bool,
    /// Whether the dump ends before the set does.
    pub short: bool,
    /// The dump's last line, where it ends in the middle of a row: that row counts as missing.
    pub cut: Option<u64>,
    /// Whether anything disagrees beside the rows missing from the end.
    pub disagrees: bool,
    /// What was assumed to read the dump.
    pub assumed: Vec<String>,
    /// The other files that the same device answers, and that were not compared.
    pub others: Vec<String>,
    /// Whose rows these are, where they are those of another file or of another set.
    pub origin: Option<String>,
}

/// Where a defect is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Placed {
    /// Modules, as the devices of a set call them, likeliest first.
    pub modules: Vec<String>,
    /// The columns that show it.
    pub columns: Vec<String>,
}

/// One expectation file of a set and the bench behind it.
struct Subject {
    bench: Arc<dyn Bench>,
    /// Which of the bench's files.
    file: usize,
    cfg: FileSpec,
    spec: FileSpec,
    shard: Shard,
    count: u64,
}

impl Subject {
    /// Test numbers, in file order, with the rows each may give.
    fn tests(&self) -> impl Iterator<Item = (TestAt, u64)> {
        super::plan::walk_tests(&*self.bench, self.shard, self.count)
    }

    /// Bytes of a packed row.
    fn stride(&self) -> usize {
        self.spec.columns.iter().map(Column::bytes).sum()
    }

    /// Those of its key.
    fn key_bytes(&self) -> usize {
        self.spec.columns[..self.key()].iter().map(Column::bytes).sum()
    }

    /// Whether each row names its test. Rows of a file without a key have their order inside a test.
    fn names_tests(&self) -> bool {
        self.key() > 0 || self.spec.columns.first().is_some_and(|column| column.name == "test")
    }

    /// The test that a row names.
    fn test(&self, number: u64) -> Option<TestAt> {
        (number < tests(self.bench.groups())).then(|| locate(self.bench.groups(), number)).flatten()
    }

    /// Leading columns that say where a row belongs; 0 when only the order says it.
    fn key(&self) -> usize {
        self.spec.key
    }
}

/// The value of a column's word.
fn value(column: &Column, word: u128) -> i128 {
    let unused = 128 - column.width;
    if column.signed { word.cast_signed() << unused >> unused } else { word.cast_signed() }
}

/// A dump that has been compared with its file.
struct Judged {
    subject: Subject,
    dump: Dump,
    report: DumpReport,
    /// The tests in which a row differs.
    differing: Vec<TestAt>,
}

impl Judged {
    /// Whether it has no row where the set has some.
    fn is_empty(&self) -> bool {
        self.report.rows == 0 && self.report.expected_rows > 0
    }
}

/// Compares a dump with the file of the set that it answers.
///
/// `file` names it where the dump's own name does not; `most` bounds the mismatches kept.
///
/// # Errors
/// [`CompareError`] if the set or the dump cannot be read as one.
pub fn compare(
    set: &OpenSet,
    dump: &Path,
    file: Option<&str>,
    most: usize,
) -> Result<DumpReport, CompareError> {
    let mut judged = vec![judge((set, &benches(set)?), dump, file, most)?];
    if judged[0].is_empty() {
        return Err(DumpError::Empty { path: dump.display().to_string() }.into());
    }
    diagnose(&mut judged);
    Ok(judged.remove(0).report)
}

/// Compares several dumps of one device: a cause has to explain all that one bench gave, and a fault of a
/// module that a bench of its own found right is the last that is thought of. The diagnosis of a bench
/// stands in the report of its first dump that disagrees.
///
/// # Errors
/// [`CompareError`] if the set or a dump cannot be read as one.
pub fn compare_all(
    set: &OpenSet,
    dumps: &[PathBuf],
    most: usize,
) -> Result<Vec<DumpReport>, CompareError> {
    let benches = benches(set)?;
    let judged = dumps.iter().map(|dump| judge((set, &benches), dump, None, most));
    let mut judged = judged.collect::<Result<Vec<_>, _>>()?;
    diagnose(&mut judged);
    let compared: Vec<String> = judged.iter().map(|judged| judged.report.file.clone()).collect();
    let reports = judged.into_iter().map(|judged| {
        let mut report = judged.report;
        report.others.retain(|other| !compared.contains(other));
        report
    });
    Ok(reports.collect())
}

fn judge(
    (set, benches): (&OpenSet, &[Arc<dyn Bench>]),
    path: &Path,
    file: Option<&str>,
    most: usize,
) -> Result<Judged, CompareError> {
    let (subject, all) = subject((set, benches), path, file)?;
    // Read once, then judged: against the expectation, and where that fails against every suspect.
    let dump = Dump::read(path, &subject.spec.columns)
        .map_err(|error| origin::of_error(error, path, &subject, &all))?;
    let mut report = compare::against(&subject, &dump, most);
    // No row at all is an answer, beside the dumps of other files.
    report.disagrees |= report.rows == 0 && report.expected_rows > 0;
    report.file = format!("{}.tv", subject.spec.stem);
    report.assumed = dump.assumed().to_vec();
    let answers = subject.bench.files().into_iter().filter(|spec| spec.stem.contains(".exp"));
    let others = answers.filter(|spec| spec.stem != subject.spec.stem);
    report.others = others.map(|spec| format!("{}.tv", spec.stem)).collect();
    let mut differing = Vec::new();
    if report.disagrees {
        report.origin = origin::of_rows(set, path, &subject);
        (report.observed, differing) = observe::observe(&subject, &dump);
    }
    Ok(Judged { subject, dump, report, differing })
}

/// Modules that a bench drives alone.
const ALONE: [(&str, &str); 2] = [("dda", "dda"), ("edge", "edge_stepper")];

/// Looks for where and why, bench by bench.
fn diagnose(judged: &mut [Judged]) {
    let module = |judged: &Judged| {
        let name = judged.subject.bench.name();
        ALONE.iter().find(|(bench, _)| *bench == name).map(|(_, module)| *module)
    };
    let of = |wrong: bool| -> Vec<&str> {
        let told =
            judged.iter().filter(|judged| judged.report.disagrees == wrong && !judged.report.short);
        told.filter_map(module).collect()
    };
    let (sound, broken) = (of(false), of(true));
    let mut benches: Vec<&str> = Vec::new();
    let mut found = Vec::new();
    for (n, first) in judged.iter().enumerate() {
        let name = first.subject.bench.name();
        if !first.report.disagrees || benches.contains(&name) {
            continue;
        }
        benches.push(name);
        let all: Vec<&Judged> =
            judged.iter().filter(|judged| judged.subject.bench.name() == name).collect();
        let differing: Vec<&Judged> =
            all.iter().copied().filter(|judged| judged.report.disagrees).collect();
        let causes = explain::causes(&all, &sound, &broken);
        let placed = place::place((&differing, &all), &causes, &sound, &broken);
        let trivial = differing.iter().all(|judged| judged.report.observed.trivial);
        found.push((n, causes, placed, trivial));
    }
    for (n, causes, placed, trivial) in found {
        let report = &mut judged[n].report;
        (report.tried, report.lost, report.placed) = (causes.tried, causes.lost, placed);
        report.observed.trivial = trivial;
        report.causes = causes.named.into_iter().map(|(change, _)| change).collect();
        report.likely = report.causes.first().filter(|_| causes.sure && !trivial).cloned();
    }
}

/// The benches of a set, which every dump of it is held against.
fn benches(set: &OpenSet) -> Result<Vec<Arc<dyn Bench>>, CompareError> {
    let (format, zstd) = super::check::format(set)?;
    if format != super::table::RowFormat::Tv || zstd {
        return Err(CompareError::Format(set.manifest.format.clone()));
    }
    let source = source(set, read_scene(set)?);
    Ok(source.benches().into_iter().map(Arc::from).collect())
}

/// The file that a dump answers, and all files that one could.
fn subject(
    (set, benches): (&OpenSet, &[Arc<dyn Bench>]),
    dump: &Path,
    file: Option<&str>,
) -> Result<(Subject, Vec<FileSpec>), CompareError> {
    let own_name = dump.file_name().map(|name| name.to_string_lossy().into_owned());
    let wanted = file.map(str::to_owned).or(own_name).unwrap_or_default();
    let shard = Shard { index: set.manifest.shard.index, parts: set.manifest.shard.parts };
    let (mut found, mut known) = (None, Vec::new());
    for bench in benches {
        let files = bench.files();
        let cfg = files[0].clone();
        let specs = files.into_iter().enumerate();
        let answers: Vec<_> = specs.filter(|(_, spec)| spec.stem.contains(".exp")).collect();
        known.extend(answers.iter().map(|(_, spec)| spec.clone()));
        let mut named = answers.into_iter().filter(|(_, spec)| wanted.starts_with(&spec.stem));
        if let (None, Some((file, spec))) = (&found, named.next()) {
            let (bench, count) = (Arc::clone(bench), set.manifest.count);
            found = Some(Subject { bench, file, cfg, spec, shard, count });
        }
    }
    let names = |known: &[FileSpec]| {
        known.iter().map(|spec| spec.stem.as_str()).collect::<Vec<_>>().join(", ")
    };
    match found {
        Some(subject) => Ok((subject, known)),
        None => Err(CompareError::Unknown { name: wanted, known: names(&known) }),
    }
}
