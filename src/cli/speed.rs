//! `guardbit speed`: the speed side of the trade, as ratios in one run.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use guardbit::measure::speed;

/// Time the kernels against plain loops, on one thread, at every processor level of this machine.
///
/// Ratios, not times: plain and fast loops take turns, and the median of their ratios is printed.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Pairs of passes per kernel and level.
    #[arg(long, default_value_t = 31, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    repeats: u16,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let report = speed::measure(usize::from(arguments.repeats));
    let mut output = Output::new();
    if arguments.json {
        output.json(&report)?;
        return Ok(Outcome::Good);
    }
    output.line("kernel             level     ns/sample   plain   ratio   bound by")?;
    for row in &report.rows {
        output.line(format!(
            "{:<18} {:<8} {:>9.3} {:>8.3} {:>7.3}   {}",
            row.kernel,
            row.processor,
            row.ns_per_sample,
            row.plain_ns_per_sample,
            row.ratio,
            row.bound_by
        ))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
