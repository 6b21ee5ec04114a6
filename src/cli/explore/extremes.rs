//! `guardbit explore --extremes`.

use super::table::figure;
use super::{Failure, Outcome, Output, SpaceArguments};
use crate::cli::progress;
use guardbit::explore::extremes::{Extreme, extremes};
use guardbit::explore::field::Value;
use guardbit::explore::witness::Witness;
use guardbit::profile::{self, WindowConfig};
use serde::Serialize;
use std::sync::atomic::Ordering;

/// An extreme as JSON.
#[derive(Serialize)]
struct Row {
    quantity: &'static str,
    pushed: String,
    field: &'static str,
    own: Option<Value>,
    metric: &'static str,
    limit: f64,
    holds: Option<Value>,
    breaks: Option<Break>,
}

#[derive(Serialize)]
struct Break {
    value: Value,
    figure: f64,
    finding: String,
    vertices: Option<[[i128; 2]; 3]>,
    depths: Option<[i128; 3]>,
    pixel: Option<[u32; 2]>,
}

pub(super) fn run(arguments: &SpaceArguments, json: bool) -> Result<Outcome, Failure> {
    if !arguments.axes.is_empty() {
        let message = "--extremes chooses its fields and values itself: leave out --vary";
        return Err(Failure::input(message));
    }
    let mut profile = profile::load(&arguments.profile)?;
    crate::cli::takes_primitives(&profile)?;
    if let Some((width, height)) = arguments.window {
        profile.window = WindowConfig { width, height };
        profile.validate().map_err(Failure::input)?;
    }
    let monitor = progress::monitor();
    let found = progress::watch("measuring", &monitor, || {
        extremes(&profile, &|| !monitor.cancel.load(Ordering::Relaxed)).map_err(Failure::input)
    })?;
    if monitor.cancel.load(Ordering::Relaxed) {
        return Err(Failure::interrupted(
            "interrupted: not all extremes were measured, so nothing is printed",
        ));
    }
    let mut output = Output::new();
    if json {
        let rows: Vec<Row> = found.into_iter().map(row).collect();
        output.json(&rows)?;
        return Ok(Outcome::Good);
    }
    let window = profile.window;
    output.line(format!("{}, {} x {}", profile.name, window.width, window.height))?;
    for extreme in &found {
        print(&mut output, extreme)?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}

fn row(extreme: Extreme) -> Row {
    let Extreme { name, pushed, field, own, tolerance, holds, breaks, .. } = extreme;
    Row {
        quantity: name,
        pushed,
        field,
        own,
        metric: tolerance.metric.name,
        limit: tolerance.limit,
        holds: holds.map(|(value, _)| value),
        breaks: breaks.map(|witness| {
            let Witness { value, figure, finding, vertices, depths, place, .. } = *witness;
            let pixel = place.map(|place| [place.x, place.y]);
            Break { value, figure, finding, vertices, depths, pixel }
        }),
    }
}

fn print(output: &mut Output, extreme: &Extreme) -> Result<(), Failure> {
    let Extreme { name, pushed, field, own, tolerance, holds, breaks, last } = extreme;
    let metric = tolerance.metric.name;
    let limit = figure(tolerance.limit);
    output.line("")?;
    output.line(format!("{name}: {pushed}"))?;
    let own = own.as_ref().map_or(String::new(), |own| format!(", the profile has {own}"));
    match holds {
        Some((value, reached)) => output.line(format!(
            "  holds   {field}={value}: {metric} {} <= {limit}{own}",
            figure(*reached)
        ))?,
        None => output.line(format!("  holds   at no value of {field}{own}"))?,
    }
    let Some(witness) = breaks else {
        let last = last.as_ref().map_or(String::new(), |last| format!(", down to {field}={last}"));
        return output.line(format!("  breaks  never{last}"));
    };
    let Witness { value, figure: got, finding, vertices, depths, place, .. } = &**witness;
    output.line(format!(
        "  breaks  {field}={value}: {metric} {} > {limit}: {finding}",
        figure(*got)
    ))?;
    if let (Some(place), Some(vertices)) = (place, vertices) {
        let [a, b, c] = vertices.map(|[x, y]| format!("({x}, {y})"));
        let depths = depths.map_or(String::new(), |[a, b, c]| format!(", depths {a} {b} {c}"));
        output.line(format!(
            "          triangle {a} {b} {c} in sub-pixels{depths}, pixel ({}, {})",
            place.x, place.y
        ))?;
    }
    Ok(())
}
