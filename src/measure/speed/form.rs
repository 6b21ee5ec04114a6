//! The machines by triangle size, through the public model, event log off and on.

use super::timing::{Pair, versus};
use crate::bits::{EventLog, Events, SpanEvents};
use crate::cover::EdgeStorage;
use crate::machine::Sink;
use crate::model::Model;
use crate::profile::{Profile, builtin};
use crate::setup::{Snapped, Triangle};
use serde::Serialize;
use std::hint::black_box;

/// Covered pixels of the triangles drawn: the squares of powers of two.
pub const SIZES: [u32; 8] = [1, 4, 16, 64, 256, 1024, 4096, 16384];

/// Samples a pass comes to, but for the smallest triangles.
const SAMPLES: u32 = 16384;
/// Triangles a pass draws at most.
const TRIANGLES: u32 = 512;

/// One machine on triangles of one size.
#[derive(Clone, Debug, Serialize)]
pub struct FormRow {
    /// `edge-function-full`, `edge-function-shifted` or `edge-walk`.
    pub machine: &'static str,
    /// Whether numeric events were counted.
    pub log: bool,
    /// Covered pixels of a triangle.
    pub pixels: u32,
    /// Nanoseconds a covered sample, median of the repeats.
    pub ns_per_sample: f64,
    /// Nanoseconds a triangle, set-up included, median of the repeats.
    pub ns_per_triangle: f64,
    /// Median of the repeats' ratios to `edge-function-shifted` of the same size without log.
    pub ratio: f64,
}

/// Measures every machine on every size, at the best processor level.
pub(super) fn measure(repeats: usize) -> Vec<FormRow> {
    let machines = machines();
    let (_, base) = &machines[0];
    let mut rows = Vec::new();
    for (machine, model) in &machines {
        for log in [false, true] {
            for (n, pixels) in SIZES.into_iter().enumerate() {
                let count = (SAMPLES / pixels).clamp(1, TRIANGLES);
                let triangles: Vec<_> = (0..count).map(|at| triangle(base, n, at)).collect();
                let Pair { fast_ns, ratio, .. } = versus(
                    repeats,
                    || draw(base, black_box(&triangles), false).checksum,
                    || draw(model, black_box(&triangles), log).checksum,
                );
                let ns_per_triangle = fast_ns / f64::from(count);
                let ns_per_sample = ns_per_triangle / f64::from(pixels);
                rows.push(FormRow { machine, log, pixels, ns_per_sample, ns_per_triangle, ratio });
            }
        }
    }
    rows
}

/// The machines of the 4096 x 4096 space; the first is what the others are held against.
fn machines() -> [(&'static str, Model); 3] {
    let load = |name: &str| -> Profile {
        let Some(Ok(profile)) = builtin(name) else { unreachable!("{name} is built in") };
        profile
    };
    let model =
        |profile: &Profile| Model::new(profile).unwrap_or_else(|error| unreachable!("{error}"));
    let shifted = load("sgi-4k");
    let mut full = shifted.clone();
    if let (Some(edges), Ok(grid)) = (full.form.edge_mut(), shifted.grid()) {
        edges.storage = EdgeStorage::Full;
        let size = (full.window.width, full.window.height);
        edges.width = edges.exact_width(&full.vertex, &grid, size);
    }
    [
        ("edge-function-shifted", model(&shifted)),
        ("edge-function-full", model(&full)),
        ("edge-walk", model(&load("sgi-4k-walk"))),
    ]
}

/// A triangle of `SIZES[n]` covered pixels, somewhere in the window: a right one of twice s by s
/// pixels. Row y of it covers 2 s - 2 y - 1, and those add up to s^2; no sample is on an edge.
fn triangle(model: &Model, n: usize, at: u32) -> Snapped<Triangle> {
    let side = 1i128 << n;
    // Steps that are no multiples of one another scatter the corners over the window.
    let place = |stride: u32| i128::from(16 + at.wrapping_mul(stride) % 3_700);
    let (x, y) = (place(677), place(1_201));
    let corner = |across: i128, down: i128| [(x + across) << 10, (y + down) << 10];
    let triangle = Triangle {
        xy: [corner(0, 0), corner(2 * side, 0), corner(0, side)],
        z: Some([1_000_003, 9_000_011, 5_000_011]),
    };
    model.place(triangle).unwrap_or_else(|error| unreachable!("inside the window: {error}"))
}

/// What a pass drew.
#[derive(Debug, Default)]
struct Drawn {
    log: Option<EventLog>,
    samples: u64,
    checksum: u64,
}

impl Sink for Drawn {
    fn span(&mut self, _y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.samples += u64::from(x1 - x0);
        self.checksum = depth.iter().fold(self.checksum, |sum, z| sum.wrapping_add(*z));
    }

    fn wants_events(&self) -> bool {
        self.log.is_some()
    }

    fn events(&mut self, events: &SpanEvents) {
        if let Some(log) = &mut self.log {
            log.span(events);
        }
    }
}

fn draw(model: &Model, triangles: &[Snapped<Triangle>], log: bool) -> Drawn {
    let mut drawn = Drawn { log: log.then(EventLog::default), ..Drawn::default() };
    for triangle in triangles {
        model.draw_own(triangle, &mut drawn);
    }
    drawn
}

/// Where set-up ends to matter, and what the log costs.
pub(super) fn finding(rows: &[FormRow]) -> String {
    let find = |machine: &str, log: bool, pixels: u32| {
        rows.iter().find(|row| row.machine == machine && row.log == log && row.pixels == pixels)
    };
    let ratio = |machine, log, pixels| find(machine, log, pixels).map_or(f64::NAN, |row| row.ratio);
    let last = SIZES[SIZES.len() - 1];
    let base = find("edge-function-shifted", false, 1);
    // Set-up is half of the time where a triangle takes twice what it takes at one pixel.
    let half = base.and_then(|one| {
        rows.iter().find(|row| {
            row.machine == one.machine
                && !row.log
                && row.ns_per_triangle > 2.0 * one.ns_per_triangle
        })
    });
    let half =
        half.map_or("none of these sizes".to_owned(), |row| format!("{} pixels", row.pixels));
    format!(
        "a one-pixel triangle takes {:.0} ns; the time is more than twice as long from {half} on; the edge walk takes {:.2} of the \
         time of the edge function at 1 pixel, {:.2} at {last} pixels; with the event log {:.2} and {:.2}",
        base.map_or(f64::NAN, |row| row.ns_per_triangle),
        ratio("edge-walk", false, 1),
        ratio("edge-walk", false, last),
        ratio("edge-function-shifted", true, 1),
        ratio("edge-function-shifted", true, last),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bits::Event;

    #[test]
    fn triangles_cover_what_their_size_says() {
        let machines = machines();
        for (n, pixels) in SIZES.into_iter().enumerate() {
            for at in [0, 1, 17, TRIANGLES - 1] {
                let triangle = triangle(&machines[0].1, n, at);
                let base = draw(&machines[0].1, &[triangle], false);
                assert_eq!(base.samples, u64::from(pixels));
                assert!(base.checksum > 1_000_000, "depth is drawn");
                for (machine, model) in &machines {
                    for log in [false, true] {
                        let drawn = draw(model, &[triangle], log);
                        let same = (drawn.samples, drawn.checksum) == (base.samples, base.checksum);
                        assert!(same, "{machine}, {pixels} pixels, {drawn:?} {base:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_log_counts_when_it_is_on() {
        let [(_, model), ..] = machines();
        let triangles: Vec<_> = (0..20).map(|at| triangle(&model, 5, at)).collect();
        let log = draw(&model, &triangles, true).log.unwrap();
        assert!(
            log.total.count(Event::Inexact) > 1000,
            "slopes of these triangles are no integers"
        );
        assert!(draw(&model, &triangles, false).log.is_none());
    }

    #[test]
    fn full_storage_is_the_wider_word() {
        let [shifted, full, _] =
            machines().map(|(_, model)| model.profile().form.edge().map_or(0, |edges| edges.width));
        assert_eq!((shifted, full), (35, 45));
    }
}
