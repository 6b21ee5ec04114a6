//! The kernels against plain loops, at every processor level.

use super::timing::{Pair, versus};
use crate::bits::{Event, EventLog, Events, Lane, Place};
use crate::dda::{Edges, Line, Processor, count_inside, walk_checksum};
use crate::format::{Clamp, ReadOut};
use serde::Serialize;
use std::hint::black_box;

/// The window each measured pass covers, in pixels.
const SIZE: (u32, u32) = (1024, 512);

/// One measured kernel at one processor level.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What was run: `depth_walk`, `depth_walk_logged`, `edges_exact`.
    pub kernel: &'static str,
    /// Processor level, as [`Processor::name`].
    pub processor: &'static str,
    /// Nanoseconds a sample, median of the repeats.
    pub ns_per_sample: f64,
    /// Nanoseconds a sample of the plain loop, median of the repeats.
    pub plain_ns_per_sample: f64,
    /// Median of the repeats' ratios to the plain loop.
    pub ratio: f64,
    /// What limits the kernel at this level, from its instruction mix.
    pub bound_by: &'static str,
}

/// The ratios at the best processor level.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ratios {
    /// 39-bit planar depth walk, guard clamp, checksum.
    pub depth_walk: f64,
    /// The same with the event log in closed form.
    pub depth_walk_logged: f64,
    /// Three exact 35-bit edges, counting covered samples.
    pub edges_exact: f64,
}

/// A plane that stays in range over most of the window and meets the guard clamp in two corners.
const PLANE: [i128; 3] = [0x3f_0000 << 13, (16_001 << 13) + 4_099, (7_907 << 13) - 1_237];

fn depth_format() -> ReadOut {
    // The lectures' depth budget is well formed by construction.
    ReadOut::new(2, 24, 13, Clamp::Guard).unwrap_or_else(|error| unreachable!("{error}"))
}

/// The plain loop: an `i64`, sign-extended after each step, decoded by the guard rule.
#[inline(never)]
fn plain_depth(read: ReadOut, plane: [i64; 3], size: (u32, u32)) -> u64 {
    let [mut start, dx, dy] = plane;
    let unused = 64 - read.width();
    let mask = (1u64 << read.width()) - 1;
    let pass = 1u64 << read.integer();
    let split = pass + ((1u64 << (read.guard() + read.integer())) - pass) / 2;
    let mut sum = 0u64;
    for _ in 0..size.1 {
        let mut accumulator = start;
        for x in 0..size.0 {
            let top = (accumulator.cast_unsigned() & mask) >> read.fraction();
            let value = if top < pass {
                top
            } else if top < split {
                pass - 1
            } else {
                0
            };
            sum = sum.wrapping_add(value ^ u64::from(x));
            accumulator = ((accumulator + dx) << unused) >> unused;
        }
        start = ((start + dy) << unused) >> unused;
    }
    sum
}

/// The plain loop for edges: three `i64`s, sign-extended after each step.
#[inline(never)]
fn plain_edges(edges: Edges<i64>, width: u32, size: (u32, u32)) -> u64 {
    let unused = 64 - width;
    let mut row = edges.value;
    let mut inside = 0;
    for _ in 0..size.1 {
        let mut value = row;
        for _ in 0..size.0 {
            inside += u64::from(value[0] >= 0 && value[1] >= 0 && value[2] >= 0);
            for (word, step) in value.iter_mut().zip(edges.step_x) {
                *word = ((*word + step) << unused) >> unused;
            }
        }
        for (word, step) in row.iter_mut().zip(edges.step_y) {
            *word = ((*word + step) << unused) >> unused;
        }
    }
    inside
}

fn fast_depth(processor: Processor, read: ReadOut, logged: bool) -> (u64, EventLog) {
    let mut log = EventLog::default();
    let Some(decode) = read.decode::<i64>() else { unreachable!("39 bits fit an i64 lane") };
    let plane = [decode.load(PLANE[0]), decode.slope(PLANE[1]), decode.slope(PLANE[2])];
    let sum = walk_checksum(processor, decode, plane, SIZE, |y| {
        if logged {
            let start = PLANE[0] + PLANE[2] * i128::from(y);
            let line = Line { start, slope: PLANE[1], count: u64::from(SIZE.0) };
            log.span(&line.events(read, Place { y: i64::from(y), x: 0 }));
        }
    });
    (sum, log)
}

/// Three edges of a triangle that covers about half of the window, 35 bits.
fn edges<L: Lane>(justify: impl Fn(i128) -> L) -> Edges<L> {
    // Vertices in sub-pixels of 1/1024, samples at pixel centres.
    let v: [[i128; 2]; 3] = [[3_000, 1_500], [1_040_000, 90_000], [400_000, 522_000]];
    let coefficients: [[i128; 3]; 3] = std::array::from_fn(|k| {
        let ([ax, ay], [bx, by]) = (v[k], v[(k + 1) % 3]);
        let value = (bx - ax) * (512 - ay) - (by - ay) * (512 - ax);
        [value >> 10, ay - by, bx - ax]
    });
    let pick = |n: usize| coefficients.map(|edge| justify(edge[n]));
    Edges { value: pick(0), step_x: pick(1), step_y: pick(2) }
}

/// What limits a kernel: the instruction mix of its loop against what the level offers.
fn bound_by(kernel: &str, processor: &str) -> &'static str {
    match (kernel.starts_with("depth"), processor) {
        (true, "avx512") => "vector ports: 8 operations for 8 samples",
        (true, "avx2") => "no 64-bit minimum and maximum: compare and blend, 4 samples",
        (true, "sse4.2") => "compare and blend, 2 samples an instruction",
        (true, _) => "64-bit compares done in scalar registers",
        (false, "avx512") => "vector ports: 7 operations for 8 samples",
        (false, "avx2") => "vector ports, 4 samples an instruction",
        (false, _) => "vector ports, 2 samples an instruction",
    }
}

/// Measures every kernel at every processor level of this machine, on one thread.
pub(super) fn measure(repeats: usize) -> (Ratios, Vec<Row>) {
    let samples = f64::from(SIZE.0) * f64::from(SIZE.1);
    let read = depth_format();
    let plain_plane = PLANE.map(i64::truncate);
    let plain_words = edges(i64::truncate);
    let lanes = edges(|value| i64::justify(value, 35));
    let mut rows = Vec::new();
    for processor in Processor::available() {
        let mut row = |kernel, Pair { fast_ns, plain_ns, ratio }: Pair| {
            let processor = processor.name();
            let bound_by = bound_by(kernel, processor);
            rows.push(Row {
                kernel,
                processor,
                ns_per_sample: fast_ns / samples,
                plain_ns_per_sample: plain_ns / samples,
                ratio,
                bound_by,
            });
            ratio
        };
        let plain = || plain_depth(read, black_box(plain_plane), SIZE);
        row("depth_walk", versus(repeats, plain, || fast_depth(processor, read, false).0));
        row(
            "depth_walk_logged",
            versus(repeats, plain, || {
                let (sum, log) = fast_depth(processor, read, true);
                sum ^ log.total.count(Event::ClampAbove)
            }),
        );
        row(
            "edges_exact",
            versus(
                repeats,
                || plain_edges(black_box(plain_words), 35, SIZE),
                || count_inside(processor, black_box(lanes), SIZE),
            ),
        );
    }
    let last =
        |kernel| rows.iter().rev().find(|row| row.kernel == kernel).map_or(f64::NAN, |r| r.ratio);
    let ratios = Ratios {
        depth_walk: last("depth_walk"),
        depth_walk_logged: last("depth_walk_logged"),
        edges_exact: last("edges_exact"),
    };
    (ratios, rows)
}

/// How far dispatch carries.
pub(super) fn finding(rows: &[Row]) -> String {
    let (Some(first), Some(last)) = (
        rows.iter().find(|row| row.kernel == "depth_walk"),
        rows.iter().rev().find(|row| row.kernel == "depth_walk"),
    ) else {
        return String::new();
    };
    format!(
        "the depth walk takes {:.2} of the time of its plain loop at {}, and {:.2} at {}",
        first.ratio, first.processor, last.ratio, last.processor
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fast_and_plain_do_the_same_work() {
        let read = depth_format();
        let expected = plain_depth(read, PLANE.map(i64::truncate), SIZE);
        for processor in Processor::available() {
            assert_eq!(fast_depth(processor, read, true).0, expected, "{}", processor.name());
            let covered = count_inside(processor, edges(|v| i64::justify(v, 35)), SIZE);
            assert_eq!(
                covered,
                plain_edges(edges(i64::truncate), 35, SIZE),
                "{}",
                processor.name()
            );
            assert!(covered > 100_000, "the triangle covers a good part of the window");
        }
        let log = fast_depth(Processor::best(), read, true).1;
        assert!(log.total.count(Event::ClampAbove) > 0, "the plane meets the clamp");
    }
}
