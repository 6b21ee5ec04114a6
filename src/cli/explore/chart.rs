//! A sweep as one still chart.

use super::{Metric, Record, Sweep};
use crate::cli::plot::{Chart, Series};
use crate::cli::report::{counted, unit};

/// What a chart shows where nothing is named: what accuracy costs.
pub(crate) fn default_axes(records: &[Record]) -> [Metric; 2] {
    let drawn = |metric: &Metric| records.iter().any(|record| metric.of(record).is_some());
    let first = |names: &[&str]| names.iter().copied().filter_map(Metric::find).find(drawn);
    let axes = [first(&["area"]), first(&["depth-rms-world", "snap-misclassified"])];
    axes.map(|axis| axis.unwrap_or_else(|| unreachable!("every record has a cost and a coverage")))
}

/// The chart of two figures: a series a value of the first varied field.
pub(super) fn chart(
    sweep: &Sweep,
    records: &[Record],
    objectives: &[Metric],
    [x, y]: [Metric; 2],
) -> Chart {
    let field = sweep.space.axes().iter().map(|axis| axis.field.name()).next();
    let value = |record: &Record| {
        let found = record.budget.iter().find(|(name, _)| Some(*name) == field);
        found.map(|(_, value)| value.clone())
    };
    let mut values: Vec<_> = Vec::new();
    for record in records {
        let value = value(record);
        if !values.contains(&value) {
            values.push(value);
        }
    }
    let series = values.iter().map(|one| {
        let name = match (field, one) {
            (Some(field), Some(value)) => format!("{field} {value}"),
            (Some(field), None) => format!("no {field}"),
            _ => String::new(),
        };
        let mut series = Series { name, ..Series::default() };
        for record in records.iter().filter(|record| value(record) == *one) {
            if let (Some(x), Some(y)) = (x.of(record), y.of(record)) {
                series.points.push((x, y));
                series.hollow.push(!record.pareto);
            }
        }
        series
    });
    let series: Vec<Series> = series.collect();
    let points = || series.iter().flat_map(|series| &series.points);
    let (log_x, log_y) = (wide(points().map(|p| p.0)), wide(points().map(|p| p.1)));
    let world = records.first().map_or("", |record| &record.accuracy.world);
    let label = |metric: Metric| {
        let cause = match metric {
            metric if metric.name.starts_with("snap-") => "snap error: ",
            metric if metric.is_accuracy() => "arithmetic error: ",
            _ => "",
        };
        format!("{cause}{}, {}", metric.about, unit(&metric, world))
    };
    let base = sweep.space.base();
    let scenes: Vec<&str> = sweep.scenes.iter().map(|scene| &*scene.name).collect();
    let names: Vec<&str> = objectives.iter().map(|metric| metric.name).collect();
    let front = records.iter().filter(|record| record.pareto).count();
    Chart {
        title: format!("{}: {} against {}", base.name, y.name, x.name),
        x_label: label(x),
        y_label: label(y),
        log_x,
        log_y,
        line: false,
        caption: format!(
            "{} of profile {} on {}, window {} x {}. Filled: the {front} on the Pareto \
             front of {}; hollow: beaten. Lower and further left is better.",
            counted(records.len(), "budget"),
            base.name,
            scenes.join(", "),
            base.window.width,
            base.window.height,
            names.join(", ")
        ),
        series,
    }
}

/// Whether values want a logarithmic axis: all above zero, and over more than two decades.
fn wide(values: impl Iterator<Item = f64>) -> bool {
    let (low, high) =
        values.fold((f64::MAX, 0.0f64), |(low, high), value| (low.min(value), high.max(value)));
    low > 0.0 && high > 100.0 * low
}

#[cfg(test)]
mod tests {
    use super::wide;

    #[test]
    fn logarithms_are_for_wide_ranges_above_zero() {
        let wide = |values: &[f64]| wide(values.iter().copied());
        assert!(wide(&[1e-5, 1e-2]));
        assert!(!wide(&[1.0, 99.0]) && !wide(&[0.0, 1e6]) && !wide(&[-1.0, 1e6]) && !wide(&[]));
    }
}
