//! `guardbit verify`: a set against itself, or a device's dump against a set.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::progress;
use guardbit::profile;
use guardbit::vector::check::{self, CheckError, CheckOptions, OpenSet};
use guardbit::vector::dump::{self, CompareError, DumpError};
use guardbit::vector::write::Monitor;
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
    /// with blanks between the columns.
    #[arg(long, value_name = "FILE")]
    dut: Option<PathBuf>,
    /// The exp file to compare the dump with, if the name of the dump does not tell it.
    #[arg(long, value_name = "NAME", requires = "dut")]
    file: Option<String>,
    /// Compute every expected row again from profile, scene and seed, and compare.
    #[arg(long)]
    recompute: bool,
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

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let believed = arguments.profile.as_deref().map(profile::load).transpose()?;
    // Nothing is written, so nothing has to be tidied up: Ctrl-C may end the process at once.
    let monitor = Monitor::default();
    let options = CheckOptions {
        recompute: arguments.recompute,
        profile: believed.as_ref(),
        threads: super::vectors::threads(arguments.threads),
    };
    let report =
        progress::watch("checking", &monitor, || check::check(&arguments.dir, options, &monitor))
            .map_err(check_failure)?;
    let mut output = Output::new();
    for finding in report.findings.iter().take(arguments.errors) {
        output.line(finding.to_string())?;
    }
    if !report.findings.is_empty() {
        output.line(format!("FAIL: {} findings", report.findings.len()))?;
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
    let report = progress::watch("comparing", &Monitor::default(), || {
        dump::compare(set, dut, arguments.file.as_deref(), arguments.errors.max(1))
    })
    .map_err(compare_failure)?;
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
        output.line(format!("PASS: {} rows of {} agree", report.rows, report.file))?;
        output.flush()?;
        return Ok(Outcome::Good);
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
        output.line("every row of the dump agrees; only the rows after its end are missing")?;
        output.flush()?;
        return Ok(Outcome::Mismatch);
    }
    match &report.causes[..] {
        [] => output.line(format!(
            "cause unknown: none of {} single changes explains the whole dump",
            report.tried
        ))?,
        [cause] => output.line(format!("likely cause: {cause}"))?,
        several => {
            output.line("likely causes, each of which explains the whole dump:")?;
            for cause in several {
                output.line(format!("  {cause}"))?;
            }
        }
    }
    if report.lost {
        output.line(
            "all rows of the dump agree, but rows are lost on the way: check for a stream that ignores backpressure",
        )?;
    }
    output.flush()?;
    Ok(Outcome::Mismatch)
}

pub(crate) fn check_failure(error: CheckError) -> Failure {
    match error {
        CheckError::Io { path, source } if source.kind() == std::io::ErrorKind::Interrupted => {
            Failure::interrupted(&format!("{path}: interrupted"))
        }
        CheckError::Io { path, source } => Failure::io(&path, &source),
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
