//! A device's dump against a set: every mismatch decoded, and the one change of the profile that
//! explains them all, if there is one. Spec clauses `N-12` to `N-14`.

mod compare;
mod explain;
mod origin;
mod read;

pub use read::{Dump, DumpError};

use super::bench::{Bench, FileSpec, TestAt, locate, tests};
use super::check::{CheckError, OpenSet, read_scene, source};
use super::plan::Shard;
use crate::format::Column;
use std::path::Path;

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
    /// Single changes that make the whole dump agree.
    pub causes: Vec<String>,
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

/// One expectation file of a set and the bench behind it.
struct Subject {
    bench: Box<dyn Bench>,
    /// Which of the bench's files.
    file: usize,
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

    /// The test that a keyed row names.
    fn test(&self, number: u64) -> Option<TestAt> {
        (number < tests(self.bench.groups())).then(|| locate(self.bench.groups(), number)).flatten()
    }

    /// Leading columns that say where a row belongs; 0 when only the order says it.
    fn key(&self) -> usize {
        self.spec.key
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
    let (subject, all) = subject(set, dump, file)?;
    // Read once, then judged: against the expectation, and where that fails against every suspect.
    let rows = Dump::read(dump, &subject.spec.columns)
        .map_err(|error| origin::of_error(error, dump, &subject, &all))?;
    let mut report = compare::against(&subject, &rows, most);
    if report.rows == 0 && report.expected_rows > 0 {
        return Err(DumpError::Empty { path: dump.display().to_string() }.into());
    }
    report.file = format!("{}.tv", subject.spec.stem);
    report.assumed = rows.assumed().to_vec();
    let answers = subject.bench.files().into_iter().filter(|spec| spec.stem.contains(".exp"));
    let others = answers.filter(|spec| spec.stem != subject.spec.stem);
    report.others = others.map(|spec| format!("{}.tv", spec.stem)).collect();
    if report.disagrees {
        report.origin = origin::of_rows(set, dump, &subject);
        let causes = explain::causes(&subject, &rows, report.short);
        (report.causes, report.tried, report.lost) = (causes.named, causes.tried, causes.lost);
    }
    Ok(report)
}

/// The file that a dump answers, and all files that one could.
fn subject(
    set: &OpenSet,
    dump: &Path,
    file: Option<&str>,
) -> Result<(Subject, Vec<FileSpec>), CompareError> {
    let (format, zstd) = super::check::format(set)?;
    if format != super::table::RowFormat::Tv || zstd {
        return Err(CompareError::Format(set.manifest.format.clone()));
    }
    let source = source(set, read_scene(set)?);
    let own_name = dump.file_name().map(|name| name.to_string_lossy().into_owned());
    let wanted = file.map(str::to_owned).or(own_name).unwrap_or_default();
    let shard = Shard { index: set.manifest.shard.index, parts: set.manifest.shard.parts };
    let (mut found, mut known) = (None, Vec::new());
    for bench in source.benches() {
        let specs = bench.files().into_iter().enumerate();
        let answers: Vec<_> = specs.filter(|(_, spec)| spec.stem.contains(".exp")).collect();
        known.extend(answers.iter().map(|(_, spec)| spec.clone()));
        let mut named = answers.into_iter().filter(|(_, spec)| wanted.starts_with(&spec.stem));
        if let (None, Some((file, spec))) = (&found, named.next()) {
            found = Some(Subject { bench, file, spec, shard, count: source.count });
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
