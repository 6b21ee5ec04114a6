//! One row a way to interpolate an attribute.

use super::{Request, compared, number};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::Output;
use guardbit::measure::interpolation::{InterpolationRow, interpolations};

/// Fraction bits of the planes compared.
const FRACTION: u32 = 24;

/// The report.
#[derive(serde::Serialize)]
struct Report<'a> {
    scene: &'a str,
    interpolation: &'a [InterpolationRow],
}

pub(super) fn show(request: Request<'_>) -> Result<Outcome, Failure> {
    let timed = request.timed();
    let Request { profile, scene, arguments } = request;
    let (name, lens) = (scene.name.clone(), scene.lens);
    let mut made = compared(scene, &profile)?;
    let (_, stage) = made.stage("edge-function").map_err(Failure::input)?;
    let rows = interpolations(stage, lens, FRACTION, timed);
    let mut output = Output::new();
    if arguments.json {
        output.json(&Report { scene: &name, interpolation: &rows })?;
        return Ok(Outcome::Good);
    }
    let fragments = rows.first().map_or(0, |row| row.fragments);
    let w = if lens.is_some() { "w from depth" } else { "w = 1" };
    output.line(format!(
        "{name}: a 16-bit attribute over each triangle, {w}, {fragments} fragments, {FRACTION} \
         fraction bits"
    ))?;
    output.line("")?;
    output.line(
        "                 error, ULP              per triangle        per fragment       ns",
    )?;
    output
        .line("by                worst      mean    add  mul  div    add  mul  div   fragment")?;
    for row in &rows {
        let (t, f) = (row.triangle, row.fragment);
        output.line(format!(
            "{:<14} {:>8} {:>9} {:>6} {:>4} {:>4} {:>6} {:>4} {:>4} {:>10}",
            row.name,
            number(row.worst_ulp),
            number(row.mean_ulp),
            t.add,
            t.multiply,
            t.divide,
            f.add,
            f.multiply,
            f.divide,
            row.ns_per_fragment.map_or("-".to_owned(), number)
        ))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
