//! `guardbit diff`: what changed between two sets or two profiles.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::verify::check_failure;
use guardbit::profile;
use guardbit::vector::{check, diff};
use std::path::Path;

/// List the differences between two sets or two profiles.
///
/// Exit status 1 if there is a difference.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The first input: the folder of a set, or a profile.
    left: String,
    /// The second input, of the same kind.
    right: String,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let [left, right] = [&arguments.left, &arguments.right].map(Path::new);
    let changes = match (left.is_dir(), right.is_dir()) {
        (true, true) => {
            let [a, b] = [left, right].map(check::open);
            let (a, b) = (a.map_err(check_failure)?.0, b.map_err(check_failure)?.0);
            if a.len() != b.len() {
                let message =
                    format!("the first folder has {} sets, the second has {}", a.len(), b.len());
                return Err(Failure::input(message)
                    .hint("give two sets, or two folders with the same number of sets"));
            }
            let mut changes = Vec::new();
            for (a, b) in a.iter().zip(&b) {
                let found = diff::sets(a, b)
                    .map_err(|error| Failure::io(&a.folder.display().to_string(), &error))?;
                changes.extend(found.into_iter().map(|change| diff::Change {
                    what: format!("{}: {}", a.manifest.set, change.what),
                    ..change
                }));
            }
            changes
        }
        (false, false) => {
            diff::profiles(&profile::load(&arguments.left)?, &profile::load(&arguments.right)?)
        }
        _ => {
            return Err(Failure::input(
                "one input is the folder of a set and the other is not: give two sets or two profiles",
            ));
        }
    };
    let mut output = Output::new();
    if arguments.json {
        output.json(&changes)?;
    } else if changes.is_empty() {
        output.line("no difference")?;
    } else {
        for change in &changes {
            output.line(format!("{}: {} -> {}", change.what, change.left, change.right))?;
        }
    }
    output.flush()?;
    Ok(if changes.is_empty() { Outcome::Good } else { Outcome::Mismatch })
}
