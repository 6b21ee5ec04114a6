//! `guardbit verify`: a set against itself, or a device's dump against a set.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::progress;
use super::report::counted;
use guardbit::profile;
use guardbit::vector::check::{self, CheckError, CheckOptions, OpenSet};
use guardbit::vector::dump::{self, CompareError, Differs, DumpError, DumpReport, Placed};
use guardbit::vector::write::{self, Monitor};
use std::path::{Path, PathBuf};

/// Check that a set is complete and unchanged, or compare the dump of a device with a set.
///
/// Exit status 1 if a file of the set has changed, or if the dump differs from the set.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The folder of one set, or a folder with several sets.
    #[arg(default_value = "guardbit-vectors")]
    dir: PathBuf,
    /// The dump: the outputs of a device, in the format of an exp file of the set, as a memory image, as CSV, or
    /// with blanks between the columns. A folder stands for all of its dumps, `NAME.exp.dut.tv`: then a cause
    /// has to explain every one of them.
    #[arg(long, value_name = "FILE")]
    dut: Option<PathBuf>,
    /// The exp file to compare the dump with, if the name of the dump does not tell it.
    #[arg(long, value_name = "NAME", requires = "dut")]
    file: Option<String>,
    /// Compute every expected row again from profile, scene and seed, and compare.
    #[arg(long)]
    recompute: bool,
    /// Check that the set is the one with this digest: the last line of its manifest.json, or of sets.json.
    #[arg(long, value_name = "HEX", value_parser = parse_digest)]
    digest: Option<String>,
    /// Check that the set was made with this profile: a built-in name or a TOML file.
    #[arg(long, value_name = "PROFILE")]
    profile: Option<String>,
    /// Print at most N mismatches.
    #[arg(long, value_name = "N", default_value_t = 20)]
    errors: usize,
    /// Number of worker threads.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// 64 hexadecimal digits.
fn parse_digest(text: &str) -> Result<String, String> {
    if text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return Ok(text.to_owned());
    }
    Err("a digest has 64 hexadecimal digits, as in the last line of manifest.json".to_owned())
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let believed = arguments.profile.as_deref().map(profile::load).transpose()?;
    // Nothing is written, so nothing has to be tidied up: Ctrl-C may end the process at once.
    let monitor = Monitor::default();
    let options = CheckOptions {
        recompute: arguments.recompute,
        profile: believed.as_ref(),
        digest: arguments.digest.as_deref(),
        threads: super::vectors::threads(arguments.threads),
    };
    let report =
        progress::watch("checking", &monitor, || check::check(&arguments.dir, options, &monitor))
            .map_err(check_failure)?;
    for note in &report.notes {
        eprintln!("note: {note}");
    }
    let mut output = Output::new();
    for finding in report.findings.iter().take(arguments.errors) {
        output.line(finding.to_string())?;
    }
    if !report.findings.is_empty() {
        output.line(format!("FAIL: {}", counted(report.findings.len(), "finding")))?;
        output.flush()?;
        return Ok(Outcome::Mismatch);
    }
    if let Some(dut) = &arguments.dut {
        return compare(&report.sets, dut, arguments, &mut output);
    }
    for set in &report.sets {
        let folder = set.folder.display();
        let manifest = &set.manifest;
        output.line(format!("{folder}: {} files as made", manifest.files.len() + 1))?;
    }
    let how = if arguments.recompute { "recomputed and found" } else { "found" };
    output.line(format!("PASS: {} rows {how} as made", report.rows))?;
    output.flush()?;
    Ok(Outcome::Good)
}

fn compare(
    sets: &[OpenSet],
    dut: &Path,
    arguments: &Arguments,
    output: &mut Output,
) -> Result<Outcome, Failure> {
    let [set] = sets else {
        let names: Vec<String> = sets.iter().map(|set| set.folder.display().to_string()).collect();
        let message = format!("{} holds {} sets", arguments.dir.display(), sets.len());
        let hint = format!("name the folder of one set: {}", names.join(", "));
        return Err(Failure::input(message).hint(&hint));
    };
    let most = arguments.errors.max(1);
    let (dumps, file) = (dumps(dut)?, arguments.file.as_deref());
    let reports = progress::watch("comparing", &Monitor::default(), || match &dumps[..] {
        [one] if !dut.is_dir() => dump::compare(set, one, file, most).map(|report| vec![report]),
        several => dump::compare_all(set, several, most),
    })
    .map_err(compare_failure)?;
    for (dump, report) in dumps.iter().zip(&reports) {
        if dut.is_dir() {
            output.line(format!("== {}", dump.display()))?;
        }
        one(dump, report, arguments, output)?;
    }
    if dut.is_dir() {
        summary(&reports, output)?;
    }
    output.flush()?;
    let good = reports.iter().all(|report| report.total == 0);
    Ok(if good { Outcome::Good } else { Outcome::Mismatch })
}

/// What is to be said of all dumps of a folder: a line a bench.
fn summary(reports: &[DumpReport], output: &mut Output) -> Result<(), Failure> {
    output.line("== summary")?;
    for report in reports {
        let verdict = match report {
            DumpReport { total: 0, .. } => "agrees",
            DumpReport { short: true, disagrees: false, .. } => {
                "agrees as far as it goes; rows are missing"
            }
            _ => "differs",
        };
        let Placed { modules, .. } = &report.placed;
        let place = match modules.first() {
            Some(module) => format!("; placed: {module}"),
            None => String::new(),
        };
        let cause = match &report.likely {
            Some(cause) => format!("; likely cause: {cause}"),
            None => String::new(),
        };
        output.line(format!("{} {verdict}{place}{cause}", report.file))?;
    }
    Ok(())
}

/// The dump, or those of a folder.
fn dumps(dut: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !dut.is_dir() {
        return Ok(vec![dut.to_owned()]);
    }
    let io = |error| Failure::io(&dut.display().to_string(), &error);
    let mut dumps = Vec::new();
    for entry in std::fs::read_dir(dut).map_err(io)? {
        let path = entry.map_err(io)?.path();
        if path.to_string_lossy().ends_with(".exp.dut.tv") {
            dumps.push(path);
        }
    }
    dumps.sort();
    if dumps.is_empty() {
        let hint = "run the bench of the set with +dump; it writes NAME.exp.dut.tv";
        return Err(
            Failure::input(format!("{}: no dumps in this folder", dut.display())).hint(hint)
        );
    }
    Ok(dumps)
}

/// What is to be said of one dump.
fn one(
    dut: &Path,
    report: &DumpReport,
    arguments: &Arguments,
    output: &mut Output,
) -> Result<(), Failure> {
    for assumed in &report.assumed {
        output.line(format!("assumed: {assumed}"))?;
    }
    if report.total == 0 {
        if !report.others.is_empty() {
            output.line(format!(
                "not compared: {}, which the same device answers",
                report.others.join(", ")
            ))?;
        }
        return output.line(format!("PASS: {} rows of {} agree", report.rows, report.file));
    }
    for mismatch in report.mismatches.iter().take(arguments.errors) {
        let row = mismatch.row.map(|row| format!("{}:{row} ", report.file)).unwrap_or_default();
        let line =
            mismatch.line.map(|line| format!("{}:{line} ", dut.display())).unwrap_or_default();
        output.line(format!("{line}{row}{}", mismatch.test))?;
        for text in mismatch.text.lines() {
            output.line(format!("  {text}"))?;
        }
    }
    let (rows, expected) = (report.rows, report.expected_rows);
    output.line(format!("FAIL: {} mismatches in {rows} rows of {expected}", report.total))?;
    if report.short {
        output
            .line("the dump has fewer rows than the set: check if the simulation stopped early")?;
    }
    if let Some(line) = report.cut {
        output.line(format!(
            "line {line} of the dump ends in the middle of a row: the simulation stopped there"
        ))?;
    }
    if let Some(origin) = &report.origin {
        output.line(format!("perhaps the dump of another device: {origin}"))?;
    }
    if report.short && !report.disagrees {
        return output
            .line("every row of the dump agrees; only the rows after its end are missing");
    }
    describe(report, output)?;
    if report.lost {
        output.line(
            "all rows of the dump agree, but rows are lost on the way: check for a stream that ignores backpressure",
        )?;
    }
    Ok(())
}

/// What was seen, where the defect is, and its cause if one alone explains everything.
fn describe(report: &DumpReport, output: &mut Output) -> Result<(), Failure> {
    let observed = &report.observed;
    output.line("what differs:")?;
    for Differs { column, rows, facts } in &observed.differ {
        let facts =
            if facts.is_empty() { String::new() } else { format!(": {}", facts.join(", ")) };
        output.line(format!("  {column} in {rows} of {} rows{facts}", observed.rows))?;
    }
    if !observed.agree.is_empty() {
        output.line(format!("  never: {}", observed.agree.join(" ")))?;
    }
    if observed.missing + observed.extra > 0 {
        let facts = observed.extra_facts.iter().map(|fact| format!(", {fact}"));
        output.line(format!(
            "  {} rows missing, {} rows too many{}",
            observed.missing,
            observed.extra,
            facts.collect::<String>()
        ))?;
    }
    let classes: Vec<String> =
        observed.classes.iter().map(|(class, rows)| format!("{class} {rows}")).collect();
    output.line(format!("  rows by class of test: {}", classes.join(", ")))?;
    let Placed { modules, columns } = &report.placed;
    if columns.is_empty() {
        // Another dump of the same bench has the diagnosis.
        return Ok(());
    }
    let modules = modules.join(" or ");
    let comma = if modules.is_empty() { "" } else { ", " };
    output.line(format!("placed: {modules}{comma}columns {}", columns.join(" ")))?;
    if observed.trivial {
        return output.line("cause unknown: what differs is the same in every row, which tells nothing of its cause");
    }
    let (head, rivals) = match &report.causes[..] {
        [] => {
            return output.line(format!(
                "cause unknown: none of {} single changes explains the whole dump",
                report.tried
            ));
        }
        [cause, rivals @ ..] if report.likely.is_some() => {
            output.line(format!("likely cause: {cause}"))?;
            ("in every row of this set it is the same as:", rivals)
        }
        several => ("likely causes, each of which explains the whole dump:", several),
    };
    if rivals.is_empty() {
        return Ok(());
    }
    output.line(head)?;
    for cause in rivals.iter().take(MOST) {
        output.line(format!("  {cause}"))?;
    }
    if rivals.len() > MOST {
        output.line(format!("  and {} more", rivals.len() - MOST))?;
    }
    Ok(())
}

/// The most causes printed.
const MOST: usize = 8;

pub(crate) fn check_failure(error: CheckError) -> Failure {
    match error {
        CheckError::Io { path, source } if source.kind() == std::io::ErrorKind::Interrupted => {
            Failure::interrupted(&format!("{path}: interrupted"))
        }
        CheckError::Io { path, source } => Failure::io(&path, &source),
        CheckError::Unfinished(folder) if write::is_half_replaced(&folder) => {
            Failure::input(CheckError::Unfinished(folder)).hint(
                "a run was killed while it replaced the set; `guardbit vectors --force` with the same folder puts \
                 the old set back and then replaces it",
            )
        }
        other => Failure::input(other),
    }
}

fn compare_failure(error: CompareError) -> Failure {
    match error {
        CompareError::Set(error) => check_failure(error),
        CompareError::Dump(DumpError::Io { path, source }) => Failure::io(&path, &source),
        other => Failure::input(other),
    }
}
