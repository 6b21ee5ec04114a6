//! What the lectures warn of, as tables.

use super::{Request, number};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::Output;
use guardbit::measure::experiment::{Experiments, experiments};

pub(super) fn show(request: &Request<'_>) -> Result<Outcome, Failure> {
    let made = experiments();
    let mut output = Output::new();
    if request.arguments.json {
        output.json(&made)?;
        return Ok(Outcome::Good);
    }
    let Experiments { t_vertices, acute, offset_grid, outlines } = &made;
    output.line("T-vertices: the middle of an edge, rounded to the vertex grid")?;
    output.line("sub-pixel bits      edges      holes   double hits")?;
    for row in t_vertices {
        output.line(format!(
            "{:<14} {:>10} {:>10} {:>13}",
            row.sub_pixel, row.edges, row.holes, row.double_hits
        ))?;
    }
    output.line("")?;
    output.line(
        "acute triangles: thin triangles, exact coverage against an edge walk with 12 fraction bits",
    )?;
    output.line("width, pixels     samples   misplaced   percent   depth slope, ranges a pixel")?;
    for row in acute {
        #[allow(clippy::cast_precision_loss, reason = "small numbers")]
        let (width, part) =
            (row.width as f64 / 1024.0, 100.0 * row.misplaced as f64 / row.samples.max(1) as f64);
        output.line(format!(
            "{:<13} {:>11} {:>11} {:>9} {:>29}",
            number(width),
            row.samples,
            row.misplaced,
            number(part),
            number(row.slope)
        ))?;
    }
    output.line("")?;
    output.line("samples                        on vertices     on edges")?;
    for row in offset_grid {
        output.line(format!("{:<28} {:>13} {:>12}", row.samples, row.on_vertices, row.on_edges))?;
    }
    output.line("")?;
    output.line("outlines: depth from                                    pixels     hidden")?;
    for row in outlines {
        output.line(format!("{:<50} {:>12} {:>10}", row.depth, row.pixels, row.hidden))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
