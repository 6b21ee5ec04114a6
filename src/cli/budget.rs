//! `guardbit budget`: the words of a profile.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use guardbit::measure::budget;
use guardbit::profile;

/// The words of a profile: fields, range, resolution, and how many steps stay below half an ULP.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// A built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let profile = profile::load(&arguments.profile)?;
    let report = budget::report(&profile).map_err(Failure::input)?;
    let mut output = Output::new();
    if arguments.json {
        output.json(&report)?;
        return Ok(Outcome::Good);
    }
    output.line(format!("{}: {}", report.profile, report.about))?;
    for word in &report.words {
        output.line("")?;
        let fields: Vec<String> =
            word.fields.iter().map(|field| format!("{} {}", field.bits, field.name)).collect();
        output.line(format!("{}: {} = {} bits", word.name, fields.join(" + "), word.width))?;
        for fact in &word.facts {
            output.line(format!("  {:<22} {}", fact.name, fact.value))?;
        }
    }
    output.flush()?;
    Ok(Outcome::Good)
}
