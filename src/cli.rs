//! The command: arguments, exit statuses, and the only place that prints errors. It uses only public items
//! of the library.

mod budget;
mod claims;
mod compare;
mod diff;
mod envelope;
mod equivalence;
mod eval;
mod explore;
mod export;
mod failure;
mod fit;
mod heat;
mod identify;
mod output;
mod pixels;
mod plot;
mod profile;
mod progress;
mod prove;
mod render;
mod report;
mod sets;
mod speed;
mod trace;
mod vectors;
mod verify;
mod wave;

use clap::{Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;

/// Bit-exact fixed-point reference model for triangle rasterization hardware.
///
/// Exit status: 0 success, 1 a mismatch or a claim that does not hold, 2 wrong usage or bad input,
/// 3 input or output failed, 130 interrupted.
#[derive(Debug, Parser)]
#[command(name = "guardbit", version, max_term_width = 100, color = clap::ColorChoice::Auto)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Budget(budget::Arguments),
    Claims(claims::Arguments),
    Compare(compare::Arguments),
    Diff(diff::Arguments),
    Envelope(envelope::Arguments),
    Eval(eval::Arguments),
    Explore(explore::Arguments),
    Export(export::Arguments),
    Fit(fit::Arguments),
    Identify(identify::Arguments),
    Profile(profile::Arguments),
    Prove(prove::Arguments),
    Render(render::Arguments),
    Speed(speed::Arguments),
    Trace(trace::Arguments),
    Vectors(vectors::Arguments),
    Verify(verify::Arguments),
}

/// What a command found when it ran to its end.
enum Outcome {
    Good,
    /// A mismatch or an unmet claim: exit status 1.
    Mismatch,
    /// Bad input that was reported as it came: exit status 2.
    BadInput,
}

/// The command: parses the process's arguments, runs, reports.
///
/// `machines` are your own rasterizers. The command draws, compares and explores them, and writes sets for
/// them, like the built-in machines. If a name is already in use, the exit status is 2.
///
/// ```no_run
/// fn main() -> std::process::ExitCode {
///     guardbit::cli::main(&[])
/// }
/// ```
pub fn main(machines: &[guardbit::machine::Own]) -> ExitCode {
    if let Err(error) = guardbit::machine::add(machines) {
        return failure::Failure::input(error).report();
    }
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help on a full disk is a failure; a closed pipe is not worth a word.
            let printed = error.print().and_then(|()| std::io::stdout().flush());
            return match printed {
                _ if error.use_stderr() => ExitCode::from(2),
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => failure::Failure::io("standard output", &error).report(),
            };
        }
    };
    let result = match arguments.command {
        Command::Budget(arguments) => budget::run(&arguments),
        Command::Claims(arguments) => claims::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Diff(arguments) => diff::run(&arguments),
        Command::Envelope(arguments) => envelope::run(&arguments),
        Command::Eval(arguments) => eval::run(&arguments),
        Command::Explore(arguments) => explore::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Fit(arguments) => fit::run(&arguments),
        Command::Identify(arguments) => identify::run(&arguments),
        Command::Profile(arguments) => profile::run(&arguments),
        Command::Prove(arguments) => prove::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Speed(arguments) => speed::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Vectors(arguments) => vectors::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
    };
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Mismatch) => ExitCode::from(1),
        Ok(Outcome::BadInput) => ExitCode::from(2),
        Err(failure) => failure.report(),
    }
}

/// Refuses a profile that begins at registers where budgets are varied.
fn takes_primitives(profile: &guardbit::profile::Profile) -> Result<(), failure::Failure> {
    if profile.form.kind().intake == guardbit::machine::Intake::Triangles {
        return Ok(());
    }
    let name = &profile.name;
    let message = format!(
        "{name} is a register-level machine: its widths are fixed by the hardware and cannot be varied"
    );
    let hint = "`guardbit compare --profiles` compares such machines; spec/23-describe.md explains how to \
                change one";
    Err(failure::Failure::input(message).hint(hint))
}

/// `WIDTHxHEIGHT`.
fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(['x', 'X']).and_then(|(width, height)| {
        Some((width.trim().parse().ok()?, height.trim().parse().ok()?))
    });
    parts.ok_or_else(|| "a size is WIDTHxHEIGHT, for example 1024x768".to_owned())
}

/// `X0,Y0,X1,Y1`, half-open.
fn parse_rect(text: &str) -> Result<guardbit::cover::Rect, String> {
    let parts: Vec<u32> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    match parts[..] {
        [x0, y0, x1, y1] if x0 <= x1 && y0 <= y1 && text.split(',').count() == 4 => {
            Ok(guardbit::cover::Rect { x0, y0, x1, y1 })
        }
        _ => Err("a rectangle is X0,Y0,X1,Y1 with X0 <= X1 and Y0 <= Y1, for example 0,0,640,480"
            .to_owned()),
    }
}
