//! Quotients along a run: floating point proposes a code, and says where integers have to decide.
//! Spec clause `CH-5`.

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

/// The reciprocals of a run of positive integers; empty where there are none.
#[derive(Debug, Default)]
pub(super) struct Reciprocals(Vec<f64>);

impl Reciprocals {
    /// Those of the integers of a line, held below `top`.
    pub(super) fn fill(&mut self, processor: Processor, line: Line, top: i128, length: usize) {
        self.0.resize(length, 0.0);
        dispatch!(processor.level(), _simd => reciprocals_body(line, top, &mut self.0));
    }

    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
fn reciprocals_body(line: Line, top: i128, out: &mut [f64]) {
    let [mut base, step] = line.map(real);
    let (most, stride) = (real(top - 1), step * real(BLOCK as i128));
    for block in out.chunks_mut(BLOCK) {
        for (slot, n) in block.iter_mut().zip(&MULTIPLES) {
            let value = base + n * step;
            *slot = 1.0 / if value > most { most } else { value };
        }
        base += stride;
    }
}

/// A quotient of the accumulators of u/w and 1/w as floating point proposes it.
///
/// The proposal `over * (1 / inverse) * scale` errs by less than `edge`, as it is rounded twice and its
/// offset once, each by 2^-53 of a number below 2^(i + 2). So it is the code, unless it lies within `edge`
/// of the place where the rounding goes from one code to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Proposal {
    /// Places between the two binary points.
    scale: f64,
    /// The held accumulator's ends.
    held: [f64; 2],
    /// The smallest and the largest code.
    code: [f64; 2],
    /// Added before a rounding to nearest: for a quotient below 0, for others.
    offset: [f64; 2],
    /// The farthest that a sure proposal lies from its code.
    sure: f64,
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
            Rounding::Floor => [-0.5; 2],
            Rounding::Ceiling => [0.5; 2],
            Rounding::TowardZero => [0.5, -0.5],
            Rounding::AwayFromZero => [-0.5, 0.5],
            _ => [0.0; 2],
        };
        let lowest = -(offset << read.fraction());
        let highest = read.top() - 1 + lowest;
        if read.top() > EXACT || !(-512..=512).contains(&places) {
            return None;
        }
        let bits = i32::try_from(read.integer()).unwrap_or(i32::MAX);
        Some(Self {
            scale: power(places),
            held: [lowest, highest].map(real),
            code: [low, high].map(real),
            offset: offsets,
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
        dispatch!(processor.level(), _simd => self.body(line, &reciprocals.0, out, unsure));
    }

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
    fn body(&self, line: Line, reciprocals: &[f64], out: &mut [i64], unsure: &mut Vec<usize>) {
        let [mut base, step] = line.map(real);
        let stride = step * real(BLOCK as i128);
        let mut far = [0.0; BLOCK];
        let blocks = out.chunks_mut(BLOCK).zip(reciprocals.chunks(BLOCK));
        for (number, (block, reciprocals)) in blocks.enumerate() {
            let any = self.block(base, step, reciprocals, block, &mut far);
            base += stride;
            if any {
                let far = far.iter().take(block.len()).enumerate();
                let doubts = far.filter(|(_, far)| **far > self.sure);
                unsure.extend(doubts.map(|(n, _)| number * BLOCK + n));
            }
        }
    }

    /// Whether any is unsure.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "must inline into the dispatched kernel")]
    fn block(
        &self,
        base: f64,
        step: f64,
        reciprocals: &[f64],
        out: &mut [i64],
        far: &mut [f64; BLOCK],
    ) -> bool {
        let held = |value: f64, [low, high]: [f64; 2]| {
            let value = if value < low { low } else { value };
            if value > high { high } else { value }
        };
        // A quotient beyond the codes is held where no rounding goes from one code to the next.
        let beyond = [self.code[0] - 0.75, self.code[1] + 0.75];
        let [below, above] = self.offset;
        let mut any = 0;
        let slots = out.iter_mut().zip(far).zip(reciprocals).zip(&MULTIPLES);
        for (((slot, far), inverse), n) in slots {
            let over = held(base + n * step, self.held);
            let quotient = held(over * inverse * self.scale, beyond);
            let moved = quotient + if quotient < 0.0 { below } else { above };
            let nearest = (moved + SHIFTER) - SHIFTER;
            *far = (moved - nearest).abs();
            any |= u64::from(*far > self.sure);
            let code = held(nearest, self.code) + SHIFTER;
            *slot = code.to_bits().wrapping_sub(SHIFTER.to_bits()).cast_signed();
        }
        any != 0
    }
}

/// 2^exponent, for an exponent in [-1022, 1023].
fn power(exponent: i32) -> f64 {
    let biased = u64::from(exponent.saturating_add(1023).clamp(1, 2046).cast_unsigned());
    f64::from_bits(biased << 52)
}
