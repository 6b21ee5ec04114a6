//! `guardbit claims`: the known facts, recomputed.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use guardbit::explore::claims;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Recompute the known facts about budgets, and compare them with the expected values.
///
/// A claim is one fact. Exit status 1 if a computed value differs from its expected value.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
    /// Check only the claims whose id begins with PREFIX, for example `edge.` or `depth.`.
    #[arg(long, value_name = "PREFIX", default_value = "")]
    only: String,
    /// Number of worker threads.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut statements = claims::all();
    statements.retain(|statement| statement.id.starts_with(&arguments.only));
    if statements.is_empty() {
        let message =
            format!("--only {:?}: the id of no claim begins with this text", arguments.only);
        return Err(Failure::input(message).hint("`guardbit claims --json` lists every id"));
    }
    let bar = if std::io::stderr().is_terminal() {
        indicatif::ProgressBar::new(statements.len() as u64)
    } else {
        indicatif::ProgressBar::hidden()
    };
    let (next, checked) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..super::vectors::threads(arguments.threads).min(statements.len()) {
            scope.spawn(|| {
                while let Some((n, statement)) = {
                    let n = next.fetch_add(1, Ordering::Relaxed);
                    statements.get(n).map(|statement| (n, statement))
                } {
                    let claim = statement.check();
                    bar.inc(1);
                    checked.lock().unwrap_or_else(PoisonError::into_inner).push((n, claim));
                }
            });
        }
    });
    bar.finish_and_clear();
    let mut checked = checked.into_inner().unwrap_or_else(PoisonError::into_inner);
    checked.sort_by_key(|(n, _)| *n);
    let claims: Vec<claims::Claim> = checked.into_iter().map(|(_, claim)| claim).collect();
    let unmet = claims.iter().filter(|claim| !claim.good).count();
    let mut output = Output::new();
    if arguments.json {
        output.json(&claims)?;
    } else {
        for claim in &claims {
            let verdict = if claim.good { "good" } else { "UNMET" };
            output.line(format!("{verdict:<6} {}", claim.id))?;
            output.line(format!("       {}", claim.what))?;
            output.line(format!("       expected {}", claim.expected))?;
            output.line(format!("       got      {}", claim.got))?;
        }
        output.line(format!(
            "{} claims, {} good, {unmet} unmet",
            claims.len(),
            claims.len() - unmet
        ))?;
    }
    output.flush()?;
    Ok(if unmet == 0 { Outcome::Good } else { Outcome::Mismatch })
}
