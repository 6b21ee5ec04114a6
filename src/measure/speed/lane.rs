//! The planar depth walk by lane and by width.

use super::timing::{Pair, median, versus};
use crate::bits::Lane;
use crate::dda::{Processor, walk_checksum};
use crate::format::{Clamp, Decode, ReadOut};
use serde::Serialize;
use std::hint::black_box;

/// The window of a pass, in pixels.
const SIZE: (u32, u32) = (1024, 128);

/// Guard, integer and interpolation bits by lane: word widths up to that of the lane.
const NARROW: [[u32; 3]; 3] = [[2, 8, 6], [2, 12, 10], [2, 16, 14]];
const MIDDLE: [[u32; 3]; 3] = [[2, 24, 13], [2, 24, 22], [2, 32, 30]];
const WIDE: [[u32; 3]; 2] = [[2, 40, 38], [2, 64, 54]];

/// The depth walk at one width in one lane.
#[derive(Clone, Debug, Serialize)]
pub struct LaneRow {
    /// `i32`, `i64` or `i128`.
    pub lane: &'static str,
    /// Bits of the word.
    pub width: u32,
    /// Nanoseconds a sample, median of the repeats.
    pub ns_per_sample: f64,
    /// Nanoseconds a sample of the plain loop of the same width in the same machine integer,
    /// which sign-extends after each step.
    pub plain_ns_per_sample: f64,
    /// Median of the repeats' ratios to that loop.
    pub ratio: f64,
}

/// Measures every width, at the best processor level.
pub(super) fn measure(repeats: usize) -> Vec<LaneRow> {
    let mut rows = Vec::new();
    rows.extend(NARROW.map(|budget| row::<i32>(repeats, "i32", budget)));
    rows.extend(MIDDLE.map(|budget| row::<i64>(repeats, "i64", budget)));
    rows.extend(WIDE.map(|budget| row::<i128>(repeats, "i128", budget)));
    rows
}

fn row<L: Lane>(repeats: usize, lane: &'static str, budget: [u32; 3]) -> LaneRow {
    let samples = f64::from(SIZE.0) * f64::from(SIZE.1);
    let (read, decode) = prepare::<L>(budget);
    let plane = plane(read, SIZE);
    let words = plane.map(L::truncate);
    let processor = Processor::best();
    let Pair { fast_ns, plain_ns, ratio } = versus(
        repeats,
        || plain(read, black_box(words), SIZE),
        || fast(processor, decode, black_box(plane), SIZE),
    );
    LaneRow {
        lane,
        width: read.width(),
        ns_per_sample: fast_ns / samples,
        plain_ns_per_sample: plain_ns / samples,
        ratio,
    }
}

/// A format of the ladders above in its lane.
pub(super) fn prepare<L: Lane>([guard, integer, fraction]: [u32; 3]) -> (ReadOut, Decode<L>) {
    let read = ReadOut::new(guard, integer, fraction, Clamp::Guard)
        .unwrap_or_else(|error| unreachable!("{error}"));
    let Some(decode) = read.decode::<L>() else { unreachable!("the ladder names lanes that hold") };
    (read, decode)
}

/// A plane that stays in range over most of the window and meets the guard clamp in a corner.
pub(super) fn plane(read: ReadOut, size: (u32, u32)) -> [i128; 3] {
    // Shares of the range, so that slopes are odd numbers of the format's last place.
    let share = |part: i128, steps: u32| (read.top() / 256 * part / i128::from(steps)) | 1;
    [share(63, 1), share(170, size.0), share(61, size.1)]
}

/// The walk under test.
pub(super) fn fast<L: Lane>(
    processor: Processor,
    decode: Decode<L>,
    [start, dx, dy]: [i128; 3],
    size: (u32, u32),
) -> u64 {
    let plane = [decode.load(start), decode.slope(dx), decode.slope(dy)];
    walk_checksum(processor, decode, plane, size, |_| {})
}

/// The plain loop: a right-justified word, sign-extended after each step, decoded by the guard rule.
#[inline(never)]
pub(super) fn plain<L: Lane>(read: ReadOut, [mut start, dx, dy]: [L; 3], size: (u32, u32)) -> u64 {
    let unused = L::BITS - read.width();
    let step =
        |word: L, slope: L| word.wrapping_add(&slope).unsigned_shl(unused).signed_shr(unused);
    let pass = L::one().unsigned_shl(read.integer());
    let split = pass + (L::one().unsigned_shl(read.guard() + read.integer()) - pass).signed_shr(1);
    let mut sum = 0u64;
    for _ in 0..size.1 {
        let mut accumulator = start;
        for x in 0..size.0 {
            // All of these formats have fraction bits, so the pattern is not negative here.
            let top = accumulator.unsigned_shl(unused).unsigned_shr(unused + read.fraction());
            let value = if top < pass {
                top
            } else if top < split {
                pass - L::one()
            } else {
                L::zero()
            };
            let value: u64 = value.as_();
            sum = sum.wrapping_add(value ^ u64::from(x));
            accumulator = step(accumulator, dx);
        }
        start = step(start, dy);
    }
    sum
}

/// What a wider lane costs, and what a width within a lane does not.
pub(super) fn finding(rows: &[LaneRow]) -> String {
    let of = |lane: &str| {
        rows.iter().filter(|row| row.lane == lane).map(|row| row.ns_per_sample).collect()
    };
    let [narrow, middle, wide]: [Vec<f64>; 3] = ["i32", "i64", "i128"].map(of);
    let spread = [&narrow, &middle]
        .into_iter()
        .map(|times| {
            let (low, high) = times
                .iter()
                .fold((f64::MAX, 0.0f64), |(low, high), time| (low.min(*time), high.max(*time)));
            high / low - 1.0
        })
        .fold(0.0, f64::max);
    let [narrow, middle, wide] = [narrow, middle, wide].map(median);
    format!(
        "a sample takes {:.1} times as long in i64 as in i32, and {:.1} times as long in i128 as in i64; \
         the times of widths within one lane (i32 or i64) differ by at most {:.0} %",
        middle / narrow,
        wide / middle,
        spread * 100.0
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn agree<L: Lane>(budgets: &[[u32; 3]]) {
        for budget in budgets {
            let (read, decode) = prepare::<L>(*budget);
            assert!(read.width() <= L::BITS);
            let plane = plane(read, SIZE);
            // Columns that no block divides.
            let size = (SIZE.0 + 77, SIZE.1);
            let expected = naive(read, plane, size);
            assert_eq!(plain(read, plane.map(L::truncate), size), expected, "{budget:?}");
            for processor in Processor::available() {
                assert_eq!(fast(processor, decode, plane, size), expected, "{budget:?}");
            }
        }
    }

    /// Clause G-1 at every sample, without a walk.
    fn naive(read: ReadOut, [start, dx, dy]: [i128; 3], size: (u32, u32)) -> u64 {
        let mut sum = 0u64;
        let (mut passed, mut above) = (0, 0);
        for y in 0..size.1 {
            for x in 0..size.0 {
                let value = start + dx * i128::from(x) + dy * i128::from(y);
                sum = sum.wrapping_add(read.read(value) ^ u64::from(x));
                *if value < read.top() { &mut passed } else { &mut above } += 1;
            }
        }
        assert!(passed > above && above > 100, "{read:?}: {passed} in range, {above} above");
        sum
    }

    #[test]
    fn lanes_and_plain_loops_do_the_same_work() {
        agree::<i32>(&NARROW);
        agree::<i64>(&MIDDLE);
        agree::<i128>(&WIDE);
        // What fits a narrow lane gives the same in a wide one.
        agree::<i128>(&NARROW);
    }
}
