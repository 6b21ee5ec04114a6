//! `guardbit speed`: speed as ratios within one run.

use super::Outcome;
use super::failure::Failure;
use super::output::{Output, write_text};
use super::plot::{Chart, Series, svg};
use guardbit::measure::speed::{self, Report, Section, TradeRow};
use std::path::PathBuf;

/// Measure the speed of kernels and machines on one thread, as ratios within this run.
///
/// The results are ratios, because times differ between computers. The two sides of a ratio run in
/// turns, and the command prints the median of the ratios. Sections: "ratios" compares the kernels with
/// plain loops at every processor level of this computer; "lanes" measures the depth walk for each
/// integer type and width; "forms" measures edge function and edge walk for several triangle sizes, with
/// the event log off and on; "trade" shows speed against accuracy for each number of interpolation bits;
/// "fill" writes coverage and depth to memory by the fastest exact path; "registers" measures the
/// register-level machines.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Number of measured pairs for each ratio. A larger number takes longer and gives less scatter.
    #[arg(long, default_value_t = 31, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    repeats: u16,
    /// Measure only these sections: ratios, lanes, forms, trade, fill, registers.
    #[arg(long, value_name = "SECTIONS", value_delimiter = ',', value_parser = parse_section)]
    only: Vec<Section>,
    /// Write a chart of the section "trade" to this SVG file.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

fn parse_section(text: &str) -> Result<Section, String> {
    let named = Section::ALL.into_iter().find(|section| section.name() == text);
    named.ok_or_else(|| {
        let names = Section::ALL.map(Section::name);
        format!("there is no section of this name; the sections are {}", names.join(", "))
    })
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let only = &arguments.only[..];
    let sections = if only.is_empty() { &Section::ALL[..] } else { only };
    if arguments.svg.is_some() && !sections.contains(&Section::Trade) {
        return Err(Failure::input(
            "--svg draws the section trade, but --only does not select this section",
        )
        .hint("add trade to --only"));
    }
    let report = speed::measure(usize::from(arguments.repeats), sections);
    if let Some(path) = &arguments.svg {
        let text = svg(&chart(&report.trade));
        write_text(path, &text)?;
    }
    let mut output = Output::new();
    if arguments.json {
        output.json(&report)?;
    } else {
        print(&report, &mut output)?;
    }
    Ok(Outcome::Good)
}

fn print(report: &Report, output: &mut Output) -> Result<(), Failure> {
    let mut first = true;
    for finding in &report.findings {
        if !std::mem::take(&mut first) {
            output.line("")?;
        }
        match finding.section {
            Section::Ratios => ratios(report, output)?,
            Section::Lanes => lanes(report, output)?,
            Section::Forms => forms(report, output)?,
            Section::Trade => trade(report, output)?,
            Section::Fill => fill(report, output)?,
            Section::Registers => registers(report, output)?,
        }
        output.line(&finding.text)?;
    }
    output.flush()
}

fn ratios(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("kernel             level     ns/sample   plain   ratio   bound by")?;
    for row in &report.rows {
        output.line(format!(
            "{:<18} {:<8} {:>9.3} {:>8.3} {:>7.3}   {}",
            row.kernel,
            row.processor,
            row.ns_per_sample,
            row.plain_ns_per_sample,
            row.ratio,
            row.bound_by
        ))?;
    }
    Ok(())
}

fn lanes(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("lane   width   ns/sample   plain   ratio")?;
    for row in &report.lanes {
        output.line(format!(
            "{:<5} {:>6} {:>11.3} {:>7.3} {:>7.3}",
            row.lane, row.width, row.ns_per_sample, row.plain_ns_per_sample, row.ratio
        ))?;
    }
    Ok(())
}

fn forms(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("machine                 log   pixels   ns/sample   ns/triangle   ratio")?;
    for row in &report.forms {
        output.line(format!(
            "{:<23} {:<3} {:>8} {:>11.3} {:>13.1} {:>7.3}",
            row.machine,
            if row.log { "on" } else { "off" },
            row.pixels,
            row.ns_per_sample,
            row.ns_per_triangle,
            row.ratio
        ))?;
    }
    Ok(())
}

fn trade(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("F    width   lane   ns/sample   ratio   worst ULP     rms ULP   bound ULP")?;
    for row in &report.trade {
        output.line(format!(
            "{:<3} {:>6}   {:<5} {:>10.3} {:>7.3} {:>11.3e} {:>11.3e} {:>11.3e}",
            row.interpolation,
            row.width,
            row.lane,
            row.ns_per_sample,
            row.ratio,
            row.worst_ulp,
            row.rms_ulp,
            row.bound_ulp
        ))?;
    }
    Ok(())
}

fn fill(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("writes      pixels   ns/pixel   million triangles/s   ratio")?;
    for row in &report.fill {
        output.line(format!(
            "{:<9} {:>8.1} {:>10.3} {:>21.3} {:>7.3}",
            row.writes, row.pixels, row.ns_per_pixel, row.millions_per_second, row.ratio
        ))?;
    }
    Ok(())
}

fn registers(report: &Report, output: &mut Output) -> Result<(), Failure> {
    output.line("profile     records   ns/triangle   ns/record   thousand triangles/s   ratio")?;
    for row in &report.registers {
        output.line(format!(
            "{:<11} {:>7.1} {:>13.0} {:>11.1} {:>22.1} {:>7.2}",
            row.profile,
            row.records,
            row.ns_per_triangle,
            row.ns_per_record,
            row.thousands_per_second,
            row.ratio
        ))?;
    }
    Ok(())
}

/// Time over error, a series a lane, a point a budget.
fn chart(rows: &[TradeRow]) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for row in rows {
        if series.last().is_none_or(|last| last.name != row.lane) {
            series.push(Series { name: row.lane.to_owned(), ..Series::default() });
        }
        if let Some(last) = series.last_mut() {
            last.points.push((row.worst_ulp, row.ratio));
            last.labels.push(row.interpolation.to_string());
        }
    }
    Chart {
        title: "Depth walk: time against error for each number of interpolation bits".to_owned(),
        x_label: "largest error in a 1024 x 512 window, ULP".to_owned(),
        y_label: "time per sample, as a ratio to a plain 39-bit loop".to_owned(),
        log_x: true,
        log_y: true,
        series,
        line: true,
        caption: "The number at each point is the number of interpolation bits, next to 2 guard bits and \
                  24 depth bits. The colour is the narrowest integer type that holds the word. Times \
                  are medians of interleaved pairs on one thread of this computer. Errors are \
                  measured against the exact plane. Points further down and further left are better."
            .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_series_a_lane() {
        let row = |interpolation, lane| TradeRow {
            interpolation,
            width: 26 + interpolation,
            lane,
            ns_per_sample: 1.0,
            ratio: 0.5,
            worst_ulp: 2.0,
            rms_ulp: 1.0,
            bound_ulp: 3.0,
        };
        let chart = chart(&[row(0, "i32"), row(6, "i32"), row(7, "i64")]);
        let names: Vec<_> =
            chart.series.iter().map(|s| (s.name.as_str(), s.points.len())).collect();
        assert_eq!(names, [("i32", 2), ("i64", 1)]);
        assert_eq!(chart.series[0].labels, ["0", "6"]);
    }
}
