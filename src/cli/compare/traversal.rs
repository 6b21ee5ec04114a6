//! One row an order of visits.

use super::{Request, compared, interruptible, number};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::Output;
use guardbit::measure::comparison::{OrderRow, orders};

/// The report.
#[derive(serde::Serialize)]
struct Report<'a> {
    scene: &'a str,
    traversal: &'a [OrderRow],
}

pub(super) fn show(request: Request<'_>) -> Result<Outcome, Failure> {
    let Request { profile, scene, arguments } = request;
    let name = scene.name.clone();
    let made = compared(scene, &profile)?;
    let rows = interruptible(|go_on| orders(made, arguments.stamp, go_on).map_err(Failure::input))?;
    let mut output = Output::new();
    if arguments.json {
        output.json(&Report { scene: &name, traversal: &rows })?;
    } else {
        output.line(format!(
            "{name} with {}, stamps of {}",
            profile.name,
            arguments.stamp.name()
        ))?;
        output.line("")?;
        output.line(
            "               samples evaluated     tiles    steps  samples that read differently from row order",
        )?;
        output.line(
            "order               per fragment   tested per stamp  coverage   wrapping     sticky   floating",
        )?;
        for row in &rows {
            output.line(format!(
                "{:<14} {:>17} {:>9} {:>8} {:>9} {:>10} {:>10} {:>10}",
                row.order,
                number(row.visits_per_fragment),
                row.tiles,
                number(row.steps_per_stamp),
                row.coverage_differs,
                row.wrapping_differs,
                row.sticky_differs,
                row.floating_differs
            ))?;
        }
        output.flush()?;
    }
    let same = |row: &OrderRow| row.coverage_differs + row.wrapping_differs == 0;
    Ok(if rows.iter().all(same) { Outcome::Good } else { Outcome::Mismatch })
}
