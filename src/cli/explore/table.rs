//! Budgets as a table and as comma-separated values.

use super::{Failure, Field, Metric, Outcome, Output, Record, Sweep};
use guardbit::explore::field::Takes;
use guardbit::explore::metric;
use guardbit::measure::cost::Synthesis;

/// Figures of a synthesis tool, which only some sweeps have, and their units.
const SYNTHESISED: [(&str, &str); 3] =
    [("luts", "LUT4"), ("flip-flops", ""), ("longest-path", "nodes")];

fn synthesised(record: &Record) -> Vec<String> {
    let figures = |s: &Synthesis| [s.luts, s.flip_flops, s.longest_path].map(|n| n.to_string());
    record.synthesis.as_ref().map(figures).map_or_else(Vec::new, Vec::from)
}

/// The names or units of the figures, where any record has them.
fn synthesis_heads<'a>(
    records: &[Record],
    part: fn(&(&'a str, &'a str)) -> &'a str,
) -> Vec<&'a str> {
    let any = records.iter().any(|record| record.synthesis.is_some());
    if any { SYNTHESISED.iter().map(part).collect() } else { Vec::new() }
}

/// Figures that a table has beside the varied fields and the objectives.
pub(crate) const FIGURES: [&str; 9] = [
    "area",
    "delay-prefix",
    "snap-misclassified",
    "snap-depth-rms-world",
    "misclassified",
    "depth-worst",
    "depth-rms-world",
    "inversions",
    "ns",
];

/// Prints the Pareto front, or everything.
pub(super) fn print(
    output: &mut Output,
    sweep: &Sweep,
    records: &[Record],
    objectives: &[Metric],
    all: bool,
) -> Result<(), Failure> {
    let mut figures: Vec<Metric> = FIGURES.into_iter().filter_map(Metric::find).collect();
    for objective in objectives {
        if !figures.contains(objective) {
            figures.push(*objective);
        }
    }
    // Refused triangles make every other figure look better than it is; as a rule there are none.
    let seen = |metric: &Metric, record: &Record| match metric.of(record) {
        Some(count) => count > 0.0 || metric.name != "snap-refused",
        None => false,
    };
    figures.retain(|metric| records.iter().any(|record| seen(metric, record)));
    let varied: Vec<&str> = sweep.space.axes().iter().map(|axis| axis.field.name()).collect();
    let named = varied.iter().copied().chain(["edge-bits", "depth-bits"]);
    let mut rows: Vec<Vec<String>> = vec![
        named
            .clone()
            .chain(figures.iter().map(|m| m.name))
            .chain(synthesis_heads(records, |head| head.0))
            .chain([""])
            .map(str::to_owned)
            .collect(),
        named
            .clone()
            .map(|_| "")
            .chain(figures.iter().map(|m| m.unit))
            .chain(synthesis_heads(records, |head| head.1))
            .chain([""])
            .map(str::to_owned)
            .collect(),
    ];
    let front = records.iter().filter(|record| record.pareto).count();
    let counted = synthesis_heads(records, |head| head.0).len();
    for record in records.iter().filter(|record| all || record.pareto) {
        let fields = named.clone().map(|name| field(record, name));
        let numbers = figures.iter().map(|metric| metric.of(record).map_or("-".to_owned(), figure));
        let cells = padded(synthesised(record), counted, "-");
        let mark = if record.pareto { "*" } else { "" };
        rows.push(fields.chain(numbers).chain(cells).chain([mark.to_owned()]).collect());
    }
    for line in columns(&rows) {
        output.line(line)?;
    }
    let names: Vec<&str> = objectives.iter().map(|metric| metric.name).collect();
    output.line("")?;
    output.line(format!(
        "{} budgets, {front} on the Pareto front of {}; depth as a distance is in {}s",
        records.len(),
        names.join(", "),
        records.first().map_or("", |record| &record.accuracy.world)
    ))
}

/// Cells, filled up where there are fewer than columns.
fn padded(mut cells: Vec<String>, columns: usize, blank: &str) -> Vec<String> {
    cells.resize(columns, blank.to_owned());
    cells
}

fn field(record: &Record, name: &str) -> String {
    let found = record.budget.iter().find(|(known, _)| *known == name);
    found.map_or("-".to_owned(), |(_, value)| value.to_string())
}

/// Right-justified columns.
pub(crate) fn columns(rows: &[Vec<String>]) -> Vec<String> {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width =
        |n: usize| rows.iter().filter_map(|row| row.get(n)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..count).map(|n| width(n).unwrap_or(0)).collect();
    rows.iter()
        .map(|row| {
            let cells: Vec<String> =
                row.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}")).collect();
            cells.join("  ").trim_end().to_owned()
        })
        .collect()
}

/// Four significant digits, an integer as it is.
pub(crate) fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        whole if whole.fract() == 0.0 && whole < 1e15 => format!("{value:.0}"),
        small if small < 1e-3 => format!("{value:.3e}"),
        small if small < 10.0 => format!("{value:.4}"),
        middle if middle < 1e5 => format!("{value:.1}"),
        _ => format!("{value:.3e}"),
    }
}

/// Every metric of every budget.
pub(super) fn csv(output: &mut Output, records: &[Record]) -> Result<(), Failure> {
    let fields: Vec<&str> = {
        let mut names: Vec<&str> = Field::all().iter().map(|field| field.name()).collect();
        names.extend(["edge-bits", "depth-bits"]);
        names.retain(|name| records.iter().any(|record| field(record, name) != "-"));
        names
    };
    let metrics: Vec<Metric> = metric::all().collect();
    let names = fields.iter().copied().chain(metrics.iter().map(|metric| metric.name));
    let counted = synthesis_heads(records, |head| head.0);
    let header: Vec<&str> =
        ["index"].into_iter().chain(names).chain(counted.clone()).chain(["pareto"]).collect();
    output.line(header.join(","))?;
    for record in records {
        let cells = fields.iter().map(|name| field(record, name));
        let numbers =
            metrics.iter().map(|metric| metric.of(record).map_or(String::new(), |v| v.to_string()));
        let row: Vec<String> = [record.index.to_string()]
            .into_iter()
            .chain(cells)
            .chain(numbers)
            .chain(padded(synthesised(record), counted.len(), ""))
            .chain([record.pareto.to_string()])
            .collect();
        output.line(row.join(","))?;
    }
    Ok(())
}

/// Lists fields and metrics.
pub(crate) fn help() -> Result<Outcome, Failure> {
    let mut output = Output::new();
    output.line("fields to vary (--vary FIELD=VALUES; VALUES is a range such as 6..13, or a list with commas):")?;
    for field in Field::all() {
        let takes = match field.takes() {
            Takes::Bits { least, most, word } => {
                let word = word.map(|word| format!(", or {word}")).unwrap_or_default();
                format!("bits, {least} to {most}{word}")
            }
            Takes::Number { .. } => "a whole number with its sign".to_owned(),
            Takes::Words(words) => words().join(", "),
        };
        output.line(format!("  {:<16} {takes}", field.name()))?;
    }
    for (name, takes) in [
        (
            "CHANNEL.FIELD",
            "integer, interpolation, guard, rounding, clamp, operand, index, entry, step or coordinate of a channel of the profile",
        ),
        ("w.FIELD", "integer, interpolation, guard, rounding or clamp of 1/w"),
    ] {
        output.line(format!("  {name:<16} {takes}"))?;
    }
    output.line("metrics (for --objective of explore, and --cost and --within of fit):")?;
    for metric in metric::all() {
        output.line(format!("  {:<28} {} ({})", metric.name, metric.about, metric.unit))?;
    }
    for (name, about) in [
        ("CHANNEL-worst, -mean, -rms", "error of the codes of a channel of the profile (ULP)"),
        ("CHANNEL-worst-world ...", "the same, as a part of the real number 1 (of 1)"),
        ("CHANNEL-worst@1024 ...", "the same, in texels of a texture of that size (texels)"),
    ] {
        output.line(format!("  {name:<28} {about}"))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
