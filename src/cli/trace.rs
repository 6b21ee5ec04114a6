//! `guardbit trace`: one test, row by row, bit by bit.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::{sets, wave};
use guardbit::format::Column;
use guardbit::profile::{self, Profile};
use guardbit::vector::bench::{Bench, Source, locate};
use guardbit::vector::emit;
use guardbit::vector::plan::{find_test, test_id};
use std::path::PathBuf;
use std::sync::Arc;

/// Show one test step by step and bit by bit: as text, and as VCD or FST for a wave viewer.
///
/// The signals have the names of the vector columns, so you can compare them with the waves of a device.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// The id of the test, as for `vectors --only`. Without it, dda/guard-boundary/0, or the first test of a
    /// profile that has no such test.
    #[arg(long, value_name = "ID")]
    test: Option<String>,
    /// The scene of the tests that draw a scene: a built-in name, a mesh, or a JSON Lines file.
    #[arg(long, default_value = "knot")]
    scene: String,
    /// Number of rows of each walk file of the set that contains the test.
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    count: u64,
    /// Seed of the random tests.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write a VCD wave file (Value Change Dump).
    #[arg(long, value_name = "FILE")]
    vcd: Option<PathBuf>,
    /// Write an FST wave file.
    #[arg(long, value_name = "FILE")]
    fst: Option<PathBuf>,
}

/// A test in which an accumulator meets its ends.
const DEFAULT: &str = "dda/guard-boundary/0";

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let profile = profile::load(&arguments.profile)?;
    let snapped = sets::snap_scene(&profile, &arguments.scene)?;
    let values = Arc::new(snapped.values_of_set(&profile)?);
    let (seed, count) = (arguments.seed, arguments.count);
    let source = Source { profile, scene: Arc::new(snapped.shapes()), values, seed, count };
    let benches = source.benches();
    let named = arguments.test.as_deref().unwrap_or(DEFAULT);
    let found = benches.iter().find_map(|bench| Some((bench, find_test(&**bench, named)?)));
    let first = || benches.iter().find_map(|bench| Some((bench, locate(bench.groups(), 0)?)));
    let found = found.or_else(|| arguments.test.is_none().then(first)?);
    let Some((bench, at)) = found else {
        let hint = format!(
            "the id of a test is BENCH/CLASS/INDEX; `guardbit vectors {} --only none` lists the classes",
            arguments.profile
        );
        return Err(Failure::input(format!("no test {named:?}")).hint(&hint));
    };
    let files = emit::test_rows(&**bench, at);
    let mut output = Output::new();
    output.line(format!("{}: {}", test_id(&**bench, at), bench.describe(at)))?;
    for (spec, rows) in &files {
        output.line("")?;
        output.line(format!("{} ({} rows)", spec.stem, rows.len()))?;
        for (n, row) in rows.iter().enumerate() {
            let words: Vec<String> = spec
                .columns
                .iter()
                .zip(row)
                .map(|(column, word)| word_text(&**bench, &source.profile, column, *word))
                .collect();
            output.line(format!("{n:>4}  {}", words.join("  ")))?;
            if let Some(behind) = bench.behind(at, spec, row) {
                output.line(format!("      {behind}"))?;
            }
        }
    }
    output.flush()?;
    let name = bench.name();
    if let Some(path) = &arguments.vcd {
        wave::vcd(path, name, &files)?;
    }
    if let Some(path) = &arguments.fst {
        wave::fst(path, name, &files)?;
    }
    Ok(Outcome::Good)
}

/// A word by name, in binary fields where it has some, and as a value.
fn word_text(bench: &dyn Bench, profile: &Profile, column: &Column, word: u128) -> String {
    let unused = 128 - column.width;
    let value = word.cast_signed() << unused >> if column.signed { unused } else { 0 };
    // Where the top bits are guard bits, the model reads another number than two's complement.
    let value = profile.read_of(&column.name).map_or(value, |read| read.reduce(value));
    let value = if column.signed { value.to_string() } else { word.to_string() };
    let fields = bench.fields(&column.name);
    if fields.is_empty() {
        return format!("{}={value}", column.name);
    }
    let mut left = column.width;
    let mut parts = Vec::new();
    for (_, bits) in fields.iter().filter(|(_, bits)| *bits > 0) {
        left = left.saturating_sub(*bits);
        let field = word >> left & (u128::MAX >> (128 - bits));
        parts.push(format!("{field:0width$b}", width = *bits as usize));
    }
    format!("{}={}", column.name, parts.join("."))
}
