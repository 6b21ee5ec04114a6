//! `guardbit export`: a profile as a reference in one file.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use guardbit::profile;
use guardbit::vector::reference::{Language, ReferenceError, reference};

/// Print a profile as a reference in one file, exact in every bit, without any dependency.
///
/// The file has the widths of the profile, functions for the read-out, the DDA, the edge stepper, the set-up,
/// the box, coverage and depth, and a self test against this model. The same profile gives the same text. A
/// machine of which no reference can be written is refused by name.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    profile: String,
    /// The language.
    #[arg(long = "as", value_name = "LANGUAGE")]
    language: Language,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let profile = profile::load(&arguments.profile)?;
    if !profile.channel.is_empty() {
        let reason =
            "it has channels, which references do not have yet; leave [[channel]] and [w] out";
        let error = ReferenceError { profile: profile.name, reason: reason.to_owned() };
        return Err(Failure::input(error));
    }
    let text = reference(&profile, arguments.language).map_err(Failure::input)?;
    let mut output = Output::new();
    output.text(text)?;
    output.flush()?;
    Ok(Outcome::Good)
}
