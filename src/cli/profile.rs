//! `guardbit profile`: list, show, schema.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use clap::Subcommand;
use guardbit::model::Model;
use guardbit::profile::{self, BUILTIN, Profile};

/// List the built-in profiles, print a profile as TOML, or print the JSON schema of profile files.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    /// List the built-in profiles, one on each line.
    List,
    /// Print a profile as TOML: a good start for your own profile.
    Show {
        /// The profile: a built-in name or a TOML file.
        profile: String,
        #[arg(long, value_name = "NAME", value_parser = super::compare::parse_machine, help = machines())]
        machine: Option<&'static str>,
    },
    /// Print the JSON schema of profile files.
    Schema,
}

fn machines() -> String {
    let names: Vec<&str> = profile::triangle_machines().map(|kind| kind.name).collect();
    format!("Print the profile with another machine: {}", names.join(", "))
}

/// Why a profile cannot be another machine.
fn kept(profile: &Profile, machine: &str) -> Failure {
    let (name, own) = (&profile.name, profile.form.name());
    if profile.conservative().is_some() {
        let message = format!(
            "--machine {machine}: {name} covers squares (the table `conservative`), and this machine covers samples"
        );
        return Failure::input(message)
            .hint("leave the table out, or choose edge-function or tiles: clause CR-7");
    }
    Failure::input(format!(
        "--machine {machine}: no parts of {name}, a machine {own}, can be taken over"
    ))
    .hint("begin with a profile of a machine that draws triangles, such as sgi-4k")
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut output = Output::new();
    match &arguments.action {
        Action::List => {
            for (name, text) in BUILTIN {
                let profile = profile::parse(text, name)?;
                output.line(format!("{name:<14} {}", profile.about))?;
            }
        }
        Action::Show { profile, machine } => {
            let loaded = profile::load(profile)?;
            if let Some(machine) = machine {
                let mut changed =
                    loaded.with_machine(machine).ok_or_else(|| kept(&loaded, machine))?;
                changed.name = format!("{}-{machine}", loaded.name);
                // What a machine cannot carry shows when it is built.
                Model::new(&changed).map_err(Failure::input)?;
                output.text(changed.to_toml())?;
                output.flush()?;
                return Ok(Outcome::Good);
            }
            // A built-in is shown with its comments, anything else as this build understands it.
            match BUILTIN.iter().find(|(name, _)| name == profile) {
                Some((_, text)) => output.text(text)?,
                None => output.text(loaded.to_toml())?,
            }
        }
        Action::Schema => output.text(profile::schema())?,
    }
    output.flush()?;
    Ok(Outcome::Good)
}
