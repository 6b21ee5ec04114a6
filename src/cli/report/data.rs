//! What the page's charts are drawn from, as one block of JSON.

use super::Page;
use guardbit::explore::field::Value;
use guardbit::explore::metric::{self, Metric};
use guardbit::explore::record::Record;
use serde::{Serialize, Serializer};

/// The block.
#[derive(Serialize)]
struct Data<'a> {
    /// The figures that charts offer.
    metrics: Vec<Figure<'a>>,
    /// Names of the varied fields.
    varied: Vec<&'static str>,
    /// The figures on the axes of the first chart.
    axes: [&'static str; 2],
    /// Columns of the table after the fields.
    columns: Vec<&'static str>,
    /// What makes a page of one budget, once its fields are added.
    single: String,
    budgets: Vec<Budget<'a>>,
}

/// A figure's description.
#[derive(Serialize)]
pub(super) struct Figure<'a> {
    pub(super) name: &'static str,
    pub(super) unit: &'a str,
    pub(super) about: &'static str,
    /// `snap` and `arithmetic` are the two causes of error, which are never mixed.
    pub(super) group: &'static str,
}

#[derive(Serialize)]
struct Budget<'a> {
    index: u64,
    #[serde(serialize_with = "as_map")]
    fields: &'a [(&'static str, Value)],
    /// In the order of `metrics`.
    figures: Vec<Option<f64>>,
    pareto: bool,
}

fn as_map<S: Serializer>(fields: &[(&'static str, Value)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(fields.iter().map(|(name, value)| (name, value)))
}

/// Figures of the synthesis tool: no metrics, as only some budgets have them.
const SYNTHESIS: [(&str, &str, &str); 3] = [
    ("luts", "LUT4", "four-input look-up tables, synthesised"),
    ("flip-flops", "flip-flops", "flip-flops, synthesised"),
    ("longest-path", "nodes", "longest path between registers, synthesised"),
];

fn synthesised(record: &Record) -> [Option<f64>; 3] {
    let found = record.synthesis.as_ref();
    [
        found.map(|found| found.luts),
        found.map(|found| found.flip_flops),
        found.map(|found| found.longest_path),
    ]
    .map(|figure| figure.map(f64::from))
}

/// What a reader is told of a figure's unit.
pub(crate) fn unit<'a>(metric: &Metric, world: &'a str) -> &'a str {
    match metric.unit {
        "world" => match world {
            "mesh unit" => "mesh units",
            "depth range" => "of the depth range",
            mixed => mixed,
        },
        "um2" => "µm²",
        "range" => "of the range",
        unit => unit,
    }
}

/// What a figure is about.
pub(super) fn group(metric: &Metric) -> &'static str {
    match metric {
        metric if metric.is_cost() => "cost",
        metric if metric.name.starts_with("snap-") => "snap",
        metric if metric.is_accuracy() => "arithmetic",
        _ => "software",
    }
}

/// The figures that any record has, described.
pub(super) fn figures<'a>(records: &'a [Record]) -> Vec<Figure<'a>> {
    let world = records.first().map_or("", |record| &record.accuracy.world);
    let any = |metric: &Metric| records.iter().any(|record| metric.of(record).is_some());
    let mut figures: Vec<Figure<'a>> = metric::all()
        .filter(any)
        .map(|metric| Figure {
            name: metric.name,
            unit: unit(&metric, world),
            about: metric.about,
            group: group(&metric),
        })
        .collect();
    if records.iter().any(|record| record.synthesis.is_some()) {
        figures.extend(SYNTHESIS.map(|(name, unit, about)| Figure {
            name,
            unit,
            about,
            group: "synthesis",
        }));
    }
    figures
}

/// The figure of a name, metric or synthesised.
pub(super) fn read(record: &Record, name: &str) -> Option<f64> {
    match SYNTHESIS.iter().position(|(known, ..)| *known == name) {
        Some(at) => synthesised(record)[at],
        None => Metric::find(name)?.of(record),
    }
}

/// The block as text that cannot end the element it stands in.
pub(super) fn block(page: &Page) -> String {
    let metrics = figures(page.records);
    let budgets = page.records.iter().map(|record| Budget {
        index: record.index,
        fields: &record.budget,
        figures: metrics.iter().map(|m| read(record, m.name)).collect(),
        pareto: record.pareto,
    });
    let data = Data {
        budgets: budgets.collect(),
        varied: page.varied(),
        axes: page.axes.map(|metric| metric.name),
        columns: page.columns(),
        single: page.single.clone(),
        metrics,
    };
    // In JSON an opening angle bracket stands in strings alone, where it may be escaped.
    serde_json::to_string(&data).unwrap_or_default().replace('<', "\\u003c")
}
