//! Machines that begin at registers: triangles a second, of a hundred pixels or so.

use super::timing::{Pair, versus};
use crate::case::Words;
use crate::case::triangle::Stimulus;
use crate::machine::Intake;
use crate::machine::Sink;
use crate::model::{Drawing, Model};
use crate::profile::{BUILTIN, builtin};
use crate::setup::{Snapped, Triangle};
use serde::Serialize;
use std::hint::black_box;

/// Triangles of a pass.
const TRIANGLES: u64 = 256;
/// Their extent, in pixels.
const REACH: i128 = 32;

/// One profile.
#[derive(Clone, Debug, Serialize)]
pub struct RegisterRow {
    /// The profile.
    pub profile: &'static str,
    /// Records of a triangle, on average.
    pub records: f64,
    /// Nanoseconds a triangle, median of the repeats.
    pub ns_per_triangle: f64,
    /// Nanoseconds a record.
    pub ns_per_record: f64,
    /// Thousand triangles a second.
    pub thousands_per_second: f64,
    /// Median of the repeats' ratios to plain edge functions over the same triangles.
    pub ratio: f64,
}

/// Adds up what is drawn, so that nothing of it can be left out.
#[derive(Default)]
struct Sum {
    records: u64,
    sum: i64,
}

impl Sink for Sum {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn record(&mut self, _: usize, values: &[i64]) {
        self.records += 1;
        self.sum = values.iter().fold(self.sum, |sum, value| sum.rotate_left(1) ^ value);
    }
}

fn draw(model: &Model, lists: &[Vec<u32>]) -> Sum {
    let mut sum = Sum::default();
    for words in lists {
        model.draw_own(words.as_slice(), &mut sum);
    }
    sum
}

fn plain(model: &Model, triangles: &[Snapped<Triangle>]) -> u64 {
    let mut drawing = Drawing::default();
    let mut samples = 0;
    for triangle in triangles {
        drawing.clear();
        model.draw_own(triangle, &mut drawing);
        samples += drawing.samples();
    }
    samples
}

/// Measures every built-in profile that begins at registers.
#[allow(clippy::cast_precision_loss, reason = "a few thousand records")]
pub(super) fn measure(repeats: usize) -> Vec<RegisterRow> {
    let mut rows = Vec::new();
    for (name, _) in BUILTIN {
        let Some(Ok(profile)) = builtin(name) else { continue };
        if profile.form.kind().intake != Intake::Registers {
            continue;
        }
        let Ok(model) = Model::new(&profile) else { continue };
        let Some(Ok(base)) = profile.with_machine("edge-function").map(|base| Model::new(&base))
        else {
            continue;
        };
        let stimulus = Stimulus::new(&profile);
        let random = |n| stimulus.random(Words::new(1, 9, n), Some(REACH));
        let place = |n| base.place(random(n)).unwrap_or_else(|error| unreachable!("{error}"));
        let triangles: Vec<Snapped<Triangle>> = (0..TRIANGLES).map(place).collect();
        let lists: Vec<Vec<u32>> =
            triangles.iter().flat_map(|triangle| model.host(triangle)).collect();
        let records = draw(&model, &lists).records as f64;
        let Pair { fast_ns, ratio, .. } = versus(
            repeats,
            || plain(&base, black_box(&triangles)),
            || draw(&model, black_box(&lists)).sum.cast_unsigned(),
        );
        let ns_per_triangle = fast_ns / TRIANGLES as f64;
        rows.push(RegisterRow {
            profile: name,
            records: records / TRIANGLES as f64,
            ns_per_triangle,
            ns_per_record: fast_ns / records.max(1.0),
            thousands_per_second: 1e6 / ns_per_triangle,
            ratio,
        });
    }
    rows
}

/// The slowest of them.
pub(super) fn finding(rows: &[RegisterRow]) -> String {
    let slowest =
        rows.iter().min_by(|a, b| a.thousands_per_second.total_cmp(&b.thousands_per_second));
    slowest.map_or_else(String::new, |row| {
        format!(
            "{} is the slowest: {:.0} thousand triangles per second on one thread, with {:.0} records per triangle",
            row.profile, row.thousands_per_second, row.records
        )
    })
}
