//! What `explore` makes beside its output: a page, a chart, counted cells.

use super::chart::{chart, default_axes};
use super::{Failure, Metric, Record, SpaceArguments, Sweep, parse_metric, synthesis};
use crate::cli::output::{check_place, write_text};
use crate::cli::plot::svg;
use crate::cli::report::{Page, command_line, quoted};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(super) struct FileArguments {
    /// Write an HTML page with charts, table and error maps to FILE; any browser can open it.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Number of budgets of the Pareto front with an error map in the page, 0 to 16.
    #[arg(long, value_name = "N", default_value_t = 4, requires = "html",
          value_parser = clap::value_parser!(u8).range(0..=16))]
    maps: u8,
    /// Write a chart to this SVG file, with one series for each value of the first varied field.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// The metric on the x axis of the chart; by default area.
    #[arg(long, value_name = "METRIC", requires = "svg", value_parser = parse_metric)]
    x: Option<Metric>,
    /// The metric on the y axis of the chart; by default depth-rms-world.
    #[arg(long, value_name = "METRIC", requires = "svg", value_parser = parse_metric)]
    y: Option<Metric>,
    /// Synthesise the units of the Pareto front with yosys, and count their cells.
    #[arg(long)]
    synth: bool,
}

impl FileArguments {
    /// Fails now where it would fail in the end: after a sweep of hours that is too late.
    pub(super) fn check(&self) -> Result<(), Failure> {
        for path in [&self.html, &self.svg].into_iter().flatten() {
            check_place(path)?;
        }
        if self.synth { synthesis::check() } else { Ok(()) }
    }

    /// Adds counted cells to marked records.
    pub(super) fn synthesise(
        &self,
        sweep: &Sweep,
        records: &mut [Record],
        threads: usize,
    ) -> Result<(), Failure> {
        if self.synth { synthesis::add(sweep, records, threads) } else { Ok(()) }
    }

    /// Says of each file that there is nothing to draw in it.
    pub(super) fn leave(&self) {
        for path in [&self.html, &self.svg].into_iter().flatten() {
            eprintln!("note: {} is not written: this part has no results to draw", path.display());
        }
    }

    /// Writes the files that were asked for.
    pub(super) fn write(
        &self,
        space: &SpaceArguments,
        sweep: &Sweep,
        records: &[Record],
        objectives: &[Metric],
    ) -> Result<(), Failure> {
        let axes = default_axes(records);
        if let Some(path) = &self.svg {
            let named = [self.x.unwrap_or(axes[0]), self.y.unwrap_or(axes[1])];
            write_text(path, &svg(&chart(sweep, records, objectives, named)))?;
        }
        if let Some(path) = &self.html {
            let (maps, command, single) = (self.maps.into(), command_line(), single(space));
            let page = Page { sweep, records, objectives, axes, maps, command, single };
            write_text(path, &page.html()?)?;
        }
        Ok(())
    }
}

/// The command that measures one budget of a space, up to the fields of that budget.
fn single(space: &SpaceArguments) -> String {
    let mut words = vec!["guardbit".to_owned(), "explore".to_owned(), quoted(&space.profile)];
    for scene in &space.scenes {
        words.extend(["--scene".to_owned(), quoted(scene)]);
    }
    if let Some((width, height)) = space.window {
        words.extend(["--window".to_owned(), format!("{width}x{height}")]);
    }
    words.join(" ")
}
