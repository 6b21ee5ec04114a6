//! Speed against accuracy: what a bit of interpolation buys, and what it costs.

use super::lane;
use super::timing::{Pair, versus};
use crate::bits::{Lane, Rounding};
use crate::cover::SampleGrid;
use crate::dda::Processor;
use crate::exact::PlaneNumerator;
use crate::format::{Clamp, Decode, ReadOut};
use crate::measure::error::above;
use crate::setup::{Division, Gradient, Plane, Triangle};
use serde::Serialize;
use std::hint::black_box;

/// The window of a pass, in pixels.
const SIZE: (u32, u32) = (1024, 512);
/// Guard and depth bits of every budget.
const GUARD: u32 = 2;
const INTEGER: u32 = 24;
/// Interpolation bits: the word outgrows i32 at 7 and i64 at 39.
const LADDER: [u32; 14] = [0, 2, 4, 6, 7, 9, 11, 13, 16, 24, 32, 38, 39, 46];
/// Sub-pixel bits of the planes' vertices.
const SUB_PIXEL: u32 = 10;
/// Every how many samples an error is looked at, on both axes; the last ones always are.
const STRIDE: u32 = 8;

/// One budget: its accuracy and its speed.
#[derive(Clone, Debug, Serialize)]
pub struct TradeRow {
    /// Interpolation bits.
    pub interpolation: u32,
    /// Bits of the word: guard, depth and interpolation.
    pub width: u32,
    /// The narrowest lane that holds the word.
    pub lane: &'static str,
    /// Nanoseconds a sample of the depth walk, median of the repeats.
    pub ns_per_sample: f64,
    /// Median of the repeats' ratios to one plain loop, that of 39 bits.
    pub ratio: f64,
    /// Largest error of the accumulator over the window against the exact plane, in ULP.
    pub worst_ulp: f64,
    /// Root of the mean squared error, in ULP.
    pub rms_ulp: f64,
    /// What start and slopes rounded to nearest can add up to: (steps + 1) 2^-(F+1).
    pub bound_ulp: f64,
}

/// Measures the ladder, at the best processor level.
pub(super) fn measure(repeats: usize) -> Vec<TradeRow> {
    LADDER.into_iter().map(|interpolation| row(repeats, interpolation)).collect()
}

fn row(repeats: usize, interpolation: u32) -> TradeRow {
    let read = format(interpolation);
    let (lane, (pair, error)) = if let Some(decode) = read.decode::<i32>() {
        ("i32", in_lane(repeats, read, decode))
    } else if let Some(decode) = read.decode::<i64>() {
        ("i64", in_lane(repeats, read, decode))
    } else if let Some(decode) = read.decode::<i128>() {
        ("i128", in_lane(repeats, read, decode))
    } else {
        unreachable!("an accumulator of 120 bits fits i128")
    };
    let samples = f64::from(SIZE.0) * f64::from(SIZE.1);
    TradeRow {
        interpolation,
        width: read.width(),
        lane,
        ns_per_sample: pair.fast_ns / samples,
        ratio: pair.ratio,
        worst_ulp: error.worst,
        rms_ulp: error.rms,
        bound_ulp: bound(interpolation),
    }
}

fn format(interpolation: u32) -> ReadOut {
    ReadOut::new(GUARD, INTEGER, interpolation, Clamp::Guard)
        .unwrap_or_else(|error| unreachable!("{error}"))
}

fn bound(interpolation: u32) -> f64 {
    let steps = f64::from(SIZE.0 - 1 + SIZE.1 - 1);
    (steps + 1.0) / f64::from(interpolation + 1).exp2()
}

fn in_lane<L: Lane>(repeats: usize, read: ReadOut, decode: Decode<L>) -> (Pair, Error) {
    let (plain, _) = lane::prepare::<i64>([GUARD, INTEGER, 13]);
    let words = lane::plane(plain, SIZE).map(i64::truncate);
    let plane = lane::plane(read, SIZE);
    let processor = Processor::best();
    let pair = versus(
        repeats,
        || lane::plain(plain, black_box(words), SIZE),
        || lane::fast(processor, decode, black_box(plane), SIZE),
    );
    (pair, error(read, decode))
}

/// The planes errors are measured on: vertices near three corners of the window in sub-pixels, and
/// depths that keep the whole window in range. Twice the areas are odd, so that slopes are rounded
/// at any number of bits.
const PLANES: [([[i128; 2]; 3], [i128; 3]); 6] = [
    ([[513, 511], [1_048_064, 1_027], [1_031, 523_778]], [100_003, 8_000_001, 6_000_007]),
    ([[2_049, 700], [1_040_006, 33], [517, 524_011]], [12_000_011, 4_500_021, 8_100_001]),
    ([[77, 1_301], [1_047_000, 519_005], [3_003, 521_112]], [5_000_011, 7_777_777, 4_999_999]),
    ([[511, 513], [1_045_556, 5_001], [524_287, 520_002]], [9_000_001, 9_000_104, 9_000_313]),
    ([[9, 10], [1_048_002, 7_773], [4_101, 523_009]], [16_000_003, 9_000_017, 7_000_027]),
    ([[1_023, 3], [1_044_488, 260_101], [2_203, 521_502]], [4_194_301, 12_582_907, 4_194_319]),
];

/// Errors of the planes over the window.
#[derive(Clone, Copy, Debug)]
struct Error {
    worst: f64,
    rms: f64,
}

/// Where errors are looked at on an axis.
fn stations(size: u32) -> impl Iterator<Item = u32> + Clone {
    (0..size - 1).step_by(STRIDE as usize).chain([size - 1])
}

/// Compares the lane's word at samples all over the window with the exact plane, as integers.
fn error<L: Lane>(read: ReadOut, decode: Decode<L>) -> Error {
    let grid = SampleGrid::at([1 << (SUB_PIXEL - 1); 2], SUB_PIXEL);
    let (mut worst, mut squares, mut count) = (0.0f64, 0.0, 0.0);
    for (xy, z) in PLANES {
        let triangle = Triangle { xy, z: Some(z) };
        let exact = triangle.z.and_then(|z| PlaneNumerator::new(triangle.xy, z));
        let Some(exact) = exact else { unreachable!("planes have an area") };
        let plane = Plane::round(
            &Gradient::new(&triangle, z),
            grid.offset,
            SUB_PIXEL,
            read.fraction(),
            Rounding::NearestEven,
            Division::Quotient,
        );
        let [start, dx, dy] = plane.raw();
        let (start, dx, dy) = (decode.load(start), decode.slope(dx), decode.slope(dy));
        // The word is kept less a bias; that of zero is the bias alone.
        let bias = decode.load(0).value(read.width());
        for y in stations(SIZE.1) {
            let row = start.wrapping_add(&dy.wrapping_mul(&L::truncate(i128::from(y))));
            for x in stations(SIZE.0) {
                let word = row.wrapping_add(&dx.wrapping_mul(&L::truncate(i128::from(x))));
                let accumulator = word.value(read.width()) - bias;
                let at = grid.position(i128::from(x), i128::from(y));
                let ulp = above(&exact, at, accumulator, read.fraction());
                worst = worst.max(ulp.abs());
                squares += ulp * ulp;
                count += 1.0;
            }
        }
    }
    Error { worst, rms: (squares / count).sqrt() }
}

/// The smallest budget that is good enough, and where the lane changes.
pub(super) fn finding(rows: &[TradeRow]) -> String {
    let enough = rows.iter().find(|row| row.bound_ulp < 0.5).map_or(String::new(), |row| {
        format!(
            "{} interpolation bits are the fewest of the measured budgets with a bound below half an ULP \
             (worst measured error {:.3}, rms {:.3})",
            row.interpolation, row.worst_ulp, row.rms_ulp
        )
    });
    let changes = rows.windows(2).filter(|pair| pair[0].lane != pair[1].lane).map(|pair| {
        format!(
            "; the lane changes from {} to {} at {} bits, and the time grows by a factor of {:.1}",
            pair[0].lane,
            pair[1].lane,
            pair[1].width,
            pair[1].ns_per_sample / pair[0].ns_per_sample
        )
    });
    enough + &changes.collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Rational, plane_at};
    use num_traits::{Signed as _, ToPrimitive as _};

    #[test]
    fn planes_stay_in_range_and_have_odd_areas() {
        for (xy, z) in PLANES {
            assert_eq!(Triangle { xy, z: None }.area2() % 2, 1, "{xy:?}: positive and odd");
            for corner in [[0, 0], [1 << 20, 0], [0, 1 << 19], [1 << 20, 1 << 19]] {
                let at = plane_at(xy, z, corner).unwrap().to_integer().to_i64().unwrap();
                assert!((0..1 << INTEGER).contains(&at), "{xy:?} at {corner:?}: {at}");
            }
        }
    }

    /// Errors in every lane lie under the bound, come near it, and halve with a bit.
    #[test]
    fn errors_match_the_bound() {
        let measured = LADDER.map(|interpolation| {
            let read = format(interpolation);
            let error = match read.width() {
                ..=32 => error(read, read.decode::<i32>().unwrap()),
                33..=64 => error(read, read.decode::<i64>().unwrap()),
                _ => error(read, read.decode::<i128>().unwrap()),
            };
            let bound = bound(interpolation);
            assert!(error.worst <= bound, "{interpolation}: {error:?} {bound}");
            assert!(error.worst > bound / 4.0, "{interpolation}: {error:?} {bound}");
            assert!(error.rms < error.worst && error.rms > error.worst / 10.0, "{error:?}");
            error.worst
        });
        for (pair, bits) in measured.windows(2).zip(LADDER.windows(2)) {
            let expected = f64::from(bits[1] - bits[0]).exp2();
            let got = pair[0] / pair[1];
            assert!((expected / 4.0..expected * 4.0).contains(&got), "{bits:?}: {got}");
        }
    }

    /// The strided integers find what rationals find in one corner, and a narrow lane what a wide
    /// one does.
    #[test]
    fn errors_agree_with_rationals() {
        let read = format(4);
        let (xy, z) = PLANES[0];
        let triangle = Triangle { xy, z: Some(z) };
        let gradient = Gradient::new(&triangle, z);
        let plane =
            Plane::round(&gradient, [512, 512], 10, 4, Rounding::NearestEven, Division::Quotient);
        let corner = plane_at(xy, z, [1023 * 1024 + 512, 511 * 1024 + 512]).unwrap();
        let drawn = Rational::new(plane.at(1023, 511).raw().into(), 16.into());
        let off = (drawn - corner).abs();
        let seen = off.numer().to_f64().unwrap() / off.denom().to_f64().unwrap();
        let narrow = error(read, read.decode::<i32>().unwrap());
        let wide = error(read, read.decode::<i128>().unwrap());
        assert!(narrow.worst >= seen && seen > 0.0, "{narrow:?} {seen}");
        assert!((narrow.worst - wide.worst).abs() < 1e-12 && (narrow.rms - wide.rms).abs() < 1e-12);
    }

    #[test]
    fn the_lane_changes_on_the_ladder() {
        let lanes: Vec<_> = measure_lanes();
        let changes = lanes.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert_eq!((changes, lanes[0], lanes[lanes.len() - 1]), (2, "i32", "i128"));
    }

    fn measure_lanes() -> Vec<&'static str> {
        LADDER.map(|interpolation| row(1, interpolation).lane).to_vec()
    }
}
