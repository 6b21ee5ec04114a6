//! A channel's codes along a run of samples whose accumulators lie on straight lines: the quick twin of
//! what [`Corrector`] says of one sample. Spec clauses `CH-3` to `CH-5`.

use super::quotient::{Reciprocals, is_exact};
use super::{Correction, Corrector};
use crate::bits::bounded;
use crate::dda::{Processor, row_values};
use crate::format::ReadOut;

/// Accumulators on a straight line, unwrapped: that of the first sample, and the step to the next.
pub type Line = [i128; 2];

/// The accumulators of 1/w along a run, and what all components take from them.
#[derive(Debug, Default)]
pub struct InverseRun {
    line: Line,
    /// 1 / (the accumulator as its read-out sees it).
    reciprocals: Reciprocals,
    /// Whether those are of this run: no value wraps or comes to 0, and floating point holds each.
    straight: bool,
    /// Mantissa and exponent of the same by a reciprocal unit.
    mantissas: Vec<(i64, u32)>,
    /// Samples that floating point cannot be sure of.
    unsure: Vec<usize>,
}

fn at([start, step]: Line, n: usize) -> i128 {
    start + step * bounded::<_, i128>(n)
}

/// Whether no accumulator of a run wraps.
fn is_inside(read: ReadOut, offset: i128, line: Line, length: usize) -> bool {
    let (low, end) = read.range();
    let inside = |value: i128| (low..end).contains(&(value + offset));
    inside(line[0]) && inside(at(line, length.saturating_sub(1)))
}

impl InverseRun {
    /// Takes the accumulators of another run.
    pub fn begin(&mut self, processor: Processor, read: ReadOut, line: Line, length: usize) {
        self.line = line;
        let last = at(line, length.saturating_sub(1));
        let positive = line[0] > 0 && last > 0;
        self.straight = positive && is_exact(line, length) && is_inside(read, 0, line, length);
        if self.straight {
            self.reciprocals.fill(processor, line, read.top(), length);
        }
    }
}

impl Corrector {
    /// Affine codes: [`Corrector::affine`] at each sample.
    pub fn affine_run(&self, processor: Processor, line: Line, out: &mut [i64]) {
        let offset = self.config.offset();
        let start = line[0] + (offset << self.read.fraction());
        match self.decode {
            (Some(decode), _) => {
                let (start, slope) = (decode.load(start), decode.slope(line[1]));
                row_values(processor, decode, start, slope, out);
            }
            (None, Some(decode)) => {
                let (start, slope) = (decode.load(start), decode.slope(line[1]));
                row_values(processor, decode, start, slope, out);
            }
            (None, None) => {
                out.iter_mut().enumerate().for_each(|(n, slot)| *slot = self.affine(at(line, n)));
                return;
            }
        }
        if offset != 0 {
            let offset: i64 = bounded(offset);
            for slot in out.iter_mut() {
                *slot -= offset;
            }
        }
    }

    /// Codes in perspective: [`Corrector::divided`] at each sample, for a line of each component.
    pub fn divided_run(
        &self,
        processor: Processor,
        lines: &[Line],
        inverse: &mut InverseRun,
        out: &mut [Vec<i64>],
    ) {
        let offset = self.config.offset() << self.read.fraction();
        let InverseRun { line: w, reciprocals, straight, mantissas, unsure } = inverse;
        let mut looked_up = false;
        for (over, out) in lines.iter().zip(out) {
            let length = out.len();
            let straight =
                *straight && is_exact(*over, length) && is_inside(self.read, offset, *over, length);
            match (&self.proposal, &self.unit) {
                (Some(proposal), None) if straight => {
                    proposal.run(processor, *over, reciprocals, out, unsure);
                    for n in unsure.iter() {
                        out[*n] = self.divided(at(*over, *n), at(*w, *n));
                    }
                }
                (_, Some(_)) if straight && self.narrow_product => {
                    if !looked_up {
                        self.look_up(*w, length, mantissas);
                        looked_up = true;
                    }
                    self.product_run(*over, mantissas, out);
                }
                _ => out.iter_mut().enumerate().for_each(|(n, slot)| {
                    *slot = self.divided(at(*over, n), at(*w, n));
                }),
            }
        }
    }

    /// The reciprocals of a line that neither wraps nor comes to 0.
    fn look_up(&self, line: Line, length: usize, out: &mut Vec<(i64, u32)>) {
        let (Some(unit), Some(w)) = (&self.unit, self.w) else { return };
        let [mut value, step] = line.map(bounded::<_, i64>);
        let most: i64 = bounded(w.top() - 1);
        out.clear();
        out.extend((0..length).map(|_| {
            let reciprocal = unit.of_narrow(value.min(most).cast_unsigned());
            value += step;
            reciprocal
        }));
    }

    /// Products of a line that does not wrap.
    fn product_run(&self, line: Line, reciprocals: &[(i64, u32)], out: &mut [i64]) {
        let (Correction::Reciprocal { rounding, .. }, Some(w)) = (&self.config.correction, self.w)
        else {
            return;
        };
        let lowest = -(self.config.offset() << self.read.fraction());
        let [low, high]: [i64; 2] = [lowest, lowest + self.read.top() - 1].map(bounded);
        let codes = self.config.range();
        let [smallest, largest]: [i64; 2] = [codes.0, codes.1].map(bounded);
        let (below, fraction) = (w.integer() + w.fraction(), self.read.fraction());
        let [mut value, step] = line.map(bounded::<_, i64>);
        for (slot, (mantissa, exponent)) in out.iter_mut().zip(reciprocals) {
            let product = value.clamp(low, high) * mantissa;
            let places = fraction + exponent;
            let wide = match (places.checked_sub(below), i128::from(product)) {
                (Some(places @ ..=62), _) => {
                    let exact = rounding.shift_right_narrow(product, places);
                    *slot = exact.clamp(smallest, largest);
                    value += step;
                    continue;
                }
                (Some(places), product) => rounding.shift_right(product, places).0,
                (None, product) => product << (below - places),
            };
            *slot = bounded(wide.clamp(smallest.into(), largest.into()));
            value += step;
        }
    }
}
