//! `guardbit fit`: the cheapest budget that meets tolerances on these scenes.

mod merge;
mod print;
mod report;

use super::Outcome;
use super::explore::{
    PATIENCE, SpaceArguments, check_channels, columns_help, in_words, parse_metric,
};
use super::failure::Failure;
use super::output::{Output, write_text};
use super::progress;
use super::vectors::{parse_shard, threads};
use guardbit::explore::field::{Field, Value};
use guardbit::explore::fit::{Best, FitError, Least, Request, exhaustive, fit, least};
use guardbit::explore::metric::Metric;
use guardbit::explore::space::{Axis, Point};
use guardbit::explore::sweep::Sweep;
use guardbit::explore::tolerance::Tolerance;
use guardbit::profile::Profile;
use guardbit::vector::plan::Shard;
use report::Report;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Find the cheapest budget of a search space that meets tolerances on scenes.
///
/// The command proves that no cheaper budget of the space meets the tolerances. For each field, it prints a
/// counterexample: a triangle that fails with one bit fewer.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    space: SpaceArguments,
    /// A metric and its largest allowed value, for example depth-worst=0.5; repeat the option for more
    /// tolerances. misclassified=0, wraps=0 and snap-refused=0 always apply, unless you give other
    /// limits for them. Without --within, depth-worst=0.5 applies, too.
    #[arg(long = "within", value_name = "METRIC=LIMIT", value_parser = parse_tolerance)]
    tolerances: Vec<Tolerance>,
    /// The cost metric to minimise.
    #[arg(long, value_name = "METRIC", default_value = "area", value_parser = parse_metric)]
    cost: Metric,
    /// Accept a budget only if every larger budget of the space also meets the tolerances.
    #[arg(long)]
    robust: bool,
    /// Measure every budget and leave none out: slower, with the same result.
    #[arg(long, conflicts_with_all = ["robust", "merge"])]
    exhaustive: bool,
    /// Write the profile with the found budget to FILE, as TOML.
    #[arg(long, value_name = "FILE")]
    profile_out: Option<PathBuf>,
    /// Search part I of N parts of the space, as I/N; I starts at 0. Join the parts with --merge.
    #[arg(long, value_name = "I/N", value_parser = parse_shard)]
    shard: Option<Shard>,
    /// Write the result to FILE as JSON, for --merge.
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Join the results of all parts, which --save wrote for the same request.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "shard")]
    merge: Vec<PathBuf>,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

/// What is said when the search is stopped.
const INTERRUPTED: &str = "interrupted: the search had no result yet";

/// `METRIC=LIMIT`.
fn parse_tolerance(text: &str) -> Result<Tolerance, String> {
    let (name, limit) =
        text.split_once('=').ok_or("a tolerance is METRIC=LIMIT, for example depth-worst=0.5")?;
    let metric = parse_metric(name.trim())?;
    if !metric.is_accuracy() {
        return Err(format!(
            "{name} is not an accuracy metric; --within needs an accuracy metric, and --cost takes a cost metric"
        ));
    }
    match limit.trim().parse::<f64>() {
        Ok(limit) if limit >= 0.0 && limit.is_finite() => Ok(Tolerance { metric, limit }),
        _ => Err(format!(
            "{limit:?}: a limit is a finite number >= 0, because errors are absolute values"
        )),
    }
}

/// What a bare `fit` searches: the bits of the edge word and of the depth accumulator.
fn default_axes(base: &Profile) -> Vec<Axis> {
    let bits = |from: u32, to| (from..=to).map(Value::Bits).collect();
    let mut axes = Vec::new();
    if let Some(width) = base.exact_edge_width() {
        let values = bits(2, width);
        axes.push(Axis { field: Field::EDGE_WIDTH, values });
    }
    if let Some(depth) = base.depth {
        let most = depth.interpolation;
        axes.push(Axis { field: Field::INTERPOLATION, values: bits(0, most) });
        axes.push(Axis { field: Field::GUARD, values: bits(0, depth.guard.max(1)) });
    }
    axes
}

/// What is asked for, and what nobody would give up without saying so: a budget that draws wrong
/// samples, or nothing, is cheap.
fn with_defaults(mut tolerances: Vec<Tolerance>) -> Vec<Tolerance> {
    let mut defaults = vec![("misclassified", 0.0), ("wraps", 0.0), ("snap-refused", 0.0)];
    if tolerances.is_empty() {
        defaults.push(("depth-worst", 0.5));
    }
    for (name, limit) in defaults {
        let named = tolerances.iter().any(|tolerance| tolerance.metric.name == name);
        if let (false, Some(metric)) = (named, Metric::find(name)) {
            tolerances.push(Tolerance { metric, limit });
        }
    }
    tolerances
}

/// Refuses an answer about nothing, and says which tolerance has no figure to hold.
fn look_for_nothing(best: &Best, tolerances: &[Tolerance]) -> Result<(), Failure> {
    if best.accuracy.samples == 0 {
        let message =
            "the scenes cover no sample of the window, so every budget meets the tolerances";
        return Err(Failure::input(message).hint("choose another --scene or --window"));
    }
    for Tolerance { metric, limit } in tolerances {
        if metric.of_accuracy(&best.accuracy).is_none() {
            let name = metric.name;
            eprintln!(
                "note: {name} <= {limit} is not checked, because nothing in the scenes has depth"
            );
        }
    }
    Ok(())
}

/// An error of the search, with what to do.
fn failed(error: FitError) -> Failure {
    let own = matches!(error, FitError::OwnDepth(_));
    let failure = Failure::input(error);
    if own {
        failure.hint("use `guardbit explore`: it measures every machine, budget by budget")
    } else {
        failure
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.space.axes.iter().any(|axis| axis == "help") {
        return columns_help();
    }
    if !arguments.cost.is_cost() {
        let message = format!(
            "--cost {}: this metric is not a cost that follows from the bit widths alone",
            arguments.cost.name
        );
        return Err(Failure::input(message).hint("the costs are area, area-prefix, delay, delay-prefix, adder-bits, register-bits, setup-bits, setup-area, setup-cycles and triangle-ns"));
    }
    let sweep = arguments.space.sweep(default_axes)?;
    let tolerances = with_defaults(arguments.tolerances.clone());
    let metrics: Vec<Metric> = tolerances.iter().map(|tolerance| tolerance.metric).collect();
    check_channels(&sweep, &arguments.space.scenes, &metrics)?;
    let (first, end) = arguments.shard.unwrap_or(Shard::WHOLE).range(sweep.space.len());
    let request = Request {
        sweep: &sweep,
        tolerances,
        cost: arguments.cost,
        robust: arguments.robust,
        numbers: first..end,
    };
    let report = if arguments.exhaustive {
        return run_exhaustive(arguments, &request);
    } else if arguments.merge.is_empty() {
        announce(&sweep)?;
        let monitor = progress::monitor();
        let found = progress::watch("searching", &monitor, || {
            progress::at_once(INTERRUPTED, || {
                fit(&request, &|| !monitor.cancel.load(Ordering::Relaxed)).map_err(failed)
            })
        })?;
        let Some(found) = found else {
            return Err(Failure::interrupted(INTERRUPTED));
        };
        if let Some(best) = &found.best {
            look_for_nothing(best, &request.tolerances)?;
        }
        Report::new(&request, &arguments.space.scenes, arguments.shard, &found)
    } else {
        merge::merge(&request, &arguments.merge)?
    };
    if let Some(path) = &arguments.save {
        let text = serde_json::to_string_pretty(&report).map_err(Failure::input)?;
        write_text(path, &(text + "\n"))?;
    }
    if report.budget.is_none() && arguments.shard.is_none() {
        return Err(impossible(&least(&request).map_err(failed)?));
    }
    if let (Some(path), Some(index)) = (&arguments.profile_out, report.index)
        && let Ok(Point::Budget(profile)) = sweep.space.point(index)
    {
        let text = Profile { name: format!("{}-fit", profile.name), ..*profile }.to_toml();
        write_text(path, &text)?;
    }
    let mut output = Output::new();
    if arguments.json {
        output.json(&report)?;
        return Ok(Outcome::Good);
    }
    report.print(&mut output, &sweep)?;
    output.flush()?;
    Ok(Outcome::Good)
}

/// Below this many budgets a search is not worth measuring first.
const MANY: u64 = 1 << 13;

/// Says how long a long search can take at the worst: with nothing left out, on one thread.
fn announce(sweep: &Sweep) -> Result<(), Failure> {
    if sweep.space.len() < MANY {
        return Ok(());
    }
    let all = sweep.expected(1).map_err(Failure::input)?;
    if all > PATIENCE {
        let (budgets, time) = (sweep.space.len(), in_words(all));
        eprintln!(
            "note: measuring all {budgets} budgets would take about {time}; the search usually measures only a few"
        );
    }
    Ok(())
}

/// Says which tolerance is out of reach, and the nearest that is not.
fn impossible(least: &[Least]) -> Failure {
    let named = |budget: &[(&'static str, Value)]| {
        let parts = budget.iter().map(|(name, value)| format!("{name}={value}"));
        parts.collect::<Vec<_>>().join(" ")
    };
    let out_of_reach: Vec<&Least> = least.iter().filter(|l| l.value > l.limit).collect();
    let Some(first) = out_of_reach.first() else {
        let message = "no budget of this space meets all tolerances together; each tolerance can be met alone";
        let each: Vec<String> = least
            .iter()
            .map(|l| format!("{} {} at {}", l.metric.name, l.value, named(&l.budget)))
            .collect();
        return Failure::input(message).hint(&format!(
            "the smallest value of each: {}; search a larger space with --vary",
            each.join("; ")
        ));
    };
    let all: Vec<String> = out_of_reach
        .iter()
        .map(|l| {
            format!(
                "{} <= {}: the smallest value in the space is {}",
                l.metric.name, l.limit, l.value
            )
        })
        .collect();
    Failure::input(format!("no budget of this space meets {}", all.join("; "))).hint(&format!(
        "the smallest {} is at {}; raise the limit, or search a larger space with --vary",
        first.metric.name,
        named(&first.budget)
    ))
}

fn run_exhaustive(arguments: &Arguments, request: &Request<'_>) -> Result<Outcome, Failure> {
    let found = exhaustive(request, threads(arguments.space.threads)).map_err(Failure::input)?;
    let Some(index) = found else {
        return Err(Failure::input("no budget of this space meets all tolerances"));
    };
    let Ok(Point::Budget(profile)) = request.sweep.space.point(index) else {
        return Err(Failure::input("no budget"));
    };
    let budget = guardbit::explore::space::describe(&profile);
    let parts: Vec<String> = budget.iter().map(|(name, value)| format!("{name}={value}")).collect();
    let mut output = Output::new();
    if arguments.json {
        let value = serde_json::json!({ "index": index, "budget": report::as_map(&budget) });
        output.json(&value)?;
    } else {
        output.line(format!("number {index}: {}", parts.join(" ")))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
