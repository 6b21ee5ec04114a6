//! Quotients along a run: floating point proposes a code, and says where integers have to decide.
//! Spec clause `CH-5`.
#![allow(
    clippy::needless_range_loop,
    reason = "parallel arrays by index are what the vectoriser sees through"
)]

use super::run::Line;
use crate::bits::Rounding;
use crate::dda::Processor;
use crate::format::ReadOut;
use fearless_simd::dispatch;

/// Samples per block: enough independent operations to fill the widest vector unit twice.
const BLOCK: usize = 16;

/// Added to a number below 2^51, this leaves no room below its binary point: the sum is rounded to an
/// integer, whose bits are the low bits of the sum.
const SHIFTER: f64 = 6_755_399_441_055_744.0; // 3 x 2^51

/// The largest integer that a step or a value may reach, so that all sums of a run are exact.
const EXACT: i128 = 1 << 52;

/// Whether every value of a run is an exact integer in floating point.
pub(super) fn is_exact([start, step]: Line, length: usize) -> bool {
    let steps = i128::try_from(length).unwrap_or(EXACT);
    start.abs() < EXACT && step.abs() < EXACT && (start + step * steps).abs() < EXACT
}

#[expect(clippy::cast_precision_loss, reason = "integers below 2^53")]
const fn real(value: i128) -> f64 {
    value as f64
}

/// Multiples of a step.
const MULTIPLES: [f64; BLOCK] = {
    let mut multiples = [0.0; BLOCK];
    let mut n = 0;
    while n < BLOCK {
        multiples[n] = real(n as i128);
        n += 1;
    }
    multiples
};

/// The reciprocals of a run of positive integers.
#[derive(Debug, Default)]
pub(super) struct Reciprocals(Vec<f64>);

impl Reciprocals {
    /// Those of the integers of a line, held below `top`.
    pub(super) fn fill(&mut self, processor: Processor, line: Line, top: i128, length: usize) {
        self.0.resize(length, 0.0);
        dispatch!(processor.level(), _simd => reciprocals_body(line, top, &mut self.0));
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn reciprocals_body(line: Line, top: i128, out: &mut [f64]) {
    let [mut base, step] = line.map(real);
    let (most, stride) = (real(top - 1), step * real(BLOCK as i128));
    let offsets = MULTIPLES.map(|n| n * step);
    let of = |value: f64| 1.0 / if value > most { most } else { value };
    let (blocks, rest) = out.as_chunks_mut::<BLOCK>();
    for block in blocks {
        for n in 0..BLOCK {
            block[n] = of(base + offsets[n]);
        }
        base += stride;
    }
    rest.iter_mut().zip(&offsets).for_each(|(slot, offset)| *slot = of(base + offset));
}

/// A quotient of the accumulators of u/w and 1/w as floating point proposes it.
///
/// The proposal `over * scale * (1 / inverse) + offset` is rounded three times, each time by at most 2^-53
/// of a number below 2^(i + 2), before it goes to the nearest integer. So that is the code, unless the
/// proposal lies about half way between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Proposal {
    /// Places between the two binary points.
    scale: f64,
    /// The held accumulator's ends, scaled.
    held: [f64; 2],
    /// What all proposals beyond the smallest and the largest code become.
    code: [f64; 2],
    /// Added before a rounding to nearest: always, and times the sign.
    offset: [f64; 2],
    /// Whether that is nothing.
    nearest: bool,
    /// The farthest that a sure proposal lies from its code.
    sure: f64,
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn hold(value: f64, [low, high]: [f64; 2]) -> f64 {
    let value = if value < low { low } else { value };
    if value > high { high } else { value }
}

impl Proposal {
    /// `None` for a rounding that goes by parity, and for words of more bits than floating point holds.
    pub(super) fn new(
        read: ReadOut,
        offset: i128,
        places: i32,
        rounding: Rounding,
        (low, high): (i128, i128),
    ) -> Option<Self> {
        let offsets = match rounding {
            Rounding::Odd => return None,
            Rounding::Floor => [-0.5, 0.0],
            Rounding::Ceiling => [0.5, 0.0],
            Rounding::TowardZero => [0.0, -0.5],
            Rounding::AwayFromZero => [0.0, 0.5],
            _ => [0.0; 2],
        };
        let lowest = -(offset << read.fraction());
        let highest = read.top() - 1 + lowest;
        if read.top() > EXACT {
            return None;
        }
        let (bits, scale) = (i32::try_from(read.integer()).ok()?, power(places));
        Some(Self {
            scale,
            held: [lowest, highest].map(|end| real(end) * scale),
            // Nearer to the last code than any place where the rounding changes.
            code: [real(low) - 0.25, real(high) + 0.25],
            offset: offsets,
            nearest: rounding.is_nearest(),
            sure: 0.5 - power(bits + 4 - 52),
        })
    }

    /// Writes codes of the accumulators of a line, and which of them floating point cannot be sure of.
    pub(super) fn run(
        &self,
        processor: Processor,
        line: Line,
        reciprocals: &Reciprocals,
        out: &mut [i64],
        unsure: &mut Vec<usize>,
    ) {
        unsure.clear();
        let reciprocals = &reciprocals.0;
        let inside = [line[0], line[0] + line[1] * out.len() as i128]
            .iter()
            .all(|value| (self.held[0]..=self.held[1]).contains(&(real(*value) * self.scale)));
        if inside && self.nearest {
            // The usual case: nothing to clamp, and a rounding to nearest.
            dispatch!(processor.level(), _simd => self.body::<true>(line, reciprocals, out, unsure));
        } else {
            dispatch!(processor.level(), _simd => self.body::<false>(line, reciprocals, out, unsure));
        }
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
    fn body<const PLAIN: bool>(
        self,
        line: Line,
        reciprocals: &[f64],
        out: &mut [i64],
        unsure: &mut Vec<usize>,
    ) {
        let [mut base, step] = line.map(|value| real(value) * self.scale);
        let (offsets, stride) = (MULTIPLES.map(|n| n * step), step * real(BLOCK as i128));
        let (blocks, rest) = out.as_chunks_mut::<BLOCK>();
        let (inverses, inverse) = reciprocals.as_chunks::<BLOCK>();
        let doubts = |number: usize, base: f64, inverses: &[f64], unsure: &mut Vec<usize>| {
            for (n, (offset, inverse)) in offsets.iter().zip(inverses).enumerate() {
                if self.code::<PLAIN>(base + offset, *inverse).1 > self.sure {
                    unsure.push(number * BLOCK + n);
                }
            }
        };
        let number = blocks.len();
        for (number, (block, inverses)) in blocks.iter_mut().zip(inverses).enumerate() {
            let mut any = 0;
            for n in 0..BLOCK {
                let (code, far) = self.code::<PLAIN>(base + offsets[n], inverses[n]);
                block[n] = code;
                any |= u64::from(far > self.sure);
            }
            if any != 0 {
                doubts(number, base, inverses, unsure);
            }
            base += stride;
        }
        for ((slot, offset), inverse) in rest.iter_mut().zip(&offsets).zip(inverse) {
            *slot = self.code::<PLAIN>(base + offset, *inverse).0;
        }
        doubts(number, base, inverse, unsure);
    }

    /// A code, and how far from it the proposal lies.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
    fn code<const PLAIN: bool>(self, over: f64, inverse: f64) -> (i64, f64) {
        let moved = if PLAIN {
            over * inverse
        } else {
            let quotient = hold(over, self.held) * inverse;
            let [up, away] = self.offset;
            quotient + up + away * 1f64.copysign(quotient)
        };
        let moved = hold(moved, self.code);
        let sum = moved + SHIFTER;
        let code = sum.to_bits().wrapping_sub(SHIFTER.to_bits()).cast_signed();
        (code, (moved - (sum - SHIFTER)).abs())
    }
}

/// 2^exponent, for an exponent in [-1022, 1023].
fn power(exponent: i32) -> f64 {
    let biased = u64::from(exponent.saturating_add(1023).clamp(1, 2046).cast_unsigned());
    f64::from_bits(biased << 52)
}
