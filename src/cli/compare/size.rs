//! Cost against triangle size.

use super::{Request, interruptible, number};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::{Output, write_text};
use crate::cli::plot::{self, Chart, Series};
use guardbit::measure::comparison::{SizeRow, sizes};

/// The report.
#[derive(serde::Serialize)]
struct Report<'a> {
    scene: &'a str,
    window: [u32; 2],
    sizes: &'a [SizeRow],
}

pub(super) fn show(request: Request<'_>) -> Result<Outcome, Failure> {
    let (names, timed) = (request.machines(), request.timed());
    let Request { profile, scene, arguments } = request;
    let rows =
        interruptible(|go_on| sizes(&profile, &names, timed, go_on).map_err(Failure::input))?;
    if let Some(path) = &arguments.svg {
        write_text(path, &plot::svg(&chart(&rows)))?;
    }
    let mut output = Output::new();
    let window = [profile.window.width, profile.window.height];
    if arguments.json {
        output.json(&Report { scene: &scene.name, window, sizes: &rows })?;
        return Ok(Outcome::Good);
    }
    output.line(format!("{}: {} x {}", profile.name, window[0], window[1]))?;
    for of_size in rows.chunk_by(|a, b| a.pixels == b.pixels) {
        output.line("")?;
        output.line(format!(
            "{} pixels                operations    divisions   operations          ns       ns",
            of_size[0].pixels
        ))?;
        output.line(
            "machine            per triangle per triangle per fragment per triangle per fragment",
        )?;
        let least = |of: fn(&SizeRow) -> f64| of_size.iter().map(of).fold(f64::INFINITY, f64::min);
        let (fewest, quickest) =
            (least(|row| row.operations), least(|row| row.ns.unwrap_or(f64::INFINITY)));
        for row in of_size {
            let ns = |value: Option<f64>| value.map_or("-".to_owned(), number);
            let mut notes = Vec::new();
            if row.operations <= fewest {
                notes.push("fewest operations");
            }
            if row.ns.is_some_and(|ns| ns <= quickest) {
                notes.push("fastest here");
            }
            let line = format!(
                "{:<17} {:>13} {:>12} {:>12} {:>11} {:>12}   {}",
                row.machine,
                number(row.operations),
                number(row.divisions),
                number(row.operations / row.covered),
                ns(row.ns),
                ns(row.ns.map(|ns| ns / row.covered)),
                notes.join(", ")
            );
            output.line(line.trim_end())?;
        }
    }
    output.flush()?;
    Ok(Outcome::Good)
}

/// Operations a covered pixel over the size, a series a machine.
fn chart(rows: &[SizeRow]) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for row in rows {
        let found = series.iter().position(|known| known.name == row.machine);
        let at = found.unwrap_or_else(|| {
            series.push(Series { name: row.machine.to_owned(), ..Series::default() });
            series.len() - 1
        });
        series[at].points.push((row.covered, row.operations / row.covered));
    }
    Chart {
        title: "The cheapest machine for each triangle size: operations against triangle size"
            .to_owned(),
        x_label: "covered pixels per triangle".to_owned(),
        y_label: "operations per covered pixel, including a share of the set-up".to_owned(),
        log_x: true,
        log_y: true,
        series,
        line: true,
        caption:
            "Operations are additions, multiplications, divisions and comparisons, all with the \
                  same weight. They are counted while each machine draws random triangles of all \
                  directions. Lower is better."
                .to_owned(),
    }
}
