//! What a channel's accumulators come to at a sample: the read-out, or the correction for perspective.
//! Spec clauses `CH-2` to `CH-6`.

mod quotient;
mod run;

pub use run::{InverseRun, Line};

use super::attribute::{AttributeConfig, AttributeError, Correction, InverseWConfig};
use super::reciprocal::{Reciprocal, ReciprocalUnit};
use crate::bits::{Rounding, bounded};
use crate::format::{Decode, ReadOut};
use crate::setup::VertexConfig;
use quotient::Proposal;

/// A channel, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Corrector {
    config: AttributeConfig,
    read: ReadOut,
    /// The accumulator of 1/w, of a correction that takes it.
    w: Option<ReadOut>,
    unit: Option<ReciprocalUnit>,
    /// The read-out in 32-bit and in 64-bit lanes.
    decode: (Option<Decode<i32>>, Option<Decode<i64>>),
    /// The quotient in floating point, where that can propose one.
    proposal: Option<Proposal>,
    /// Whether every product by a reciprocal fits 64 bits.
    narrow_product: bool,
}

/// The words of a division at a sample. Spec clause `CH-5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divided {
    /// u/w as its read-out sees it, with its fraction.
    pub p: i128,
    /// 1/w, the same.
    pub q: i128,
    /// The reciprocal of Q > 0, of a correction that has a unit.
    pub reciprocal: Option<Reciprocal>,
    /// What is rounded, before the clamp; 0 where Q is 0.
    pub value: i128,
    /// The code.
    pub code: i64,
}

impl Corrector {
    /// The channel of a profile.
    ///
    /// # Errors
    /// [`AttributeError`] names the violated inequality.
    pub fn new(
        config: &AttributeConfig,
        w: Option<&InverseWConfig>,
        vertex: &VertexConfig,
    ) -> Result<Self, AttributeError> {
        let read = config.validate(vertex, w)?;
        let w = w.filter(|_| config.correction.needs_w());
        let w = w.map(|w| w.validate(vertex)).transpose()?;
        let unit = match &config.correction {
            Correction::Reciprocal { unit, .. } => Some(unit.unit()),
            _ => None,
        };
        let unit = unit
            .transpose()
            .map_err(|error| AttributeError::Reciprocal(config.name.clone(), error))?;
        let proposal = match config.correction {
            Correction::Quotient { rounding } | Correction::ConstantW { rounding } => {
                w.and_then(|w| {
                    let places = i32::try_from(w.integer() + w.fraction()).ok()?
                        - i32::try_from(read.fraction()).ok()?;
                    Proposal::new(read, config.offset(), places, rounding, config.range())
                })
            }
            _ => None,
        };
        let narrow_product =
            unit.as_ref().is_some_and(|unit| read.integer() + read.fraction() + unit.bits() <= 62);
        let decode = (read.decode(), read.decode());
        Ok(Self { config: config.clone(), read, w, unit, decode, proposal, narrow_product })
    }

    /// The channel.
    pub fn config(&self) -> &AttributeConfig {
        &self.config
    }

    /// The accumulator's format.
    pub fn read_out(&self) -> ReadOut {
        self.read
    }

    /// The accumulator's format of 1/w, of a correction that takes it.
    pub fn w_read_out(&self) -> Option<ReadOut> {
        self.w
    }

    /// The reciprocal unit, of a correction that has one.
    pub fn unit(&self) -> Option<&ReciprocalUnit> {
        self.unit.as_ref()
    }

    /// The accumulator as the read-out sees it, with its fraction: wrapped, then clamped. Clause `CH-2`.
    #[inline]
    pub fn held(&self, accumulator: i128) -> i128 {
        let offset = self.config.offset() << self.read.fraction();
        self.read.reduce(accumulator + offset).clamp(0, self.read.top() - 1) - offset
    }

    /// The code of an affine channel. Clause `CH-3`.
    #[inline]
    pub fn affine(&self, accumulator: i128) -> i64 {
        bounded(self.held(accumulator) >> self.read.fraction())
    }

    /// 1/w as its read-out sees it, with its fraction.
    #[inline]
    fn held_w(&self, accumulator: i128) -> (i128, ReadOut) {
        let w = self.w.unwrap_or_else(|| unreachable!("a correction that takes 1/w"));
        (w.reduce(accumulator).clamp(0, w.top() - 1), w)
    }

    /// The code for the accumulators of u/w and 1/w. Clause `CH-5`.
    #[inline]
    pub fn divided(&self, over: i128, inverse: i128) -> i64 {
        let over = self.held(over);
        let (inverse, w) = self.held_w(inverse);
        if inverse == 0 {
            return self.beyond(over);
        }
        self.clamped(self.unclamped(over, inverse, w))
    }

    /// The same with every word on the way. Clause `CH-5`.
    pub fn division(&self, over: i128, inverse: i128) -> Divided {
        let p = self.held(over);
        let (q, w) = self.held_w(inverse);
        let reciprocal = self.unit.as_ref().filter(|_| q > 0).map(|unit| unit.of(q));
        let value = if q == 0 { 0 } else { self.unclamped(p, q, w) };
        Divided { p, q, reciprocal, value, code: self.divided(over, inverse) }
    }

    /// P over Q > 0, rounded.
    #[inline]
    fn unclamped(&self, over: i128, inverse: i128, w: ReadOut) -> i128 {
        // Bits below the binary point of 1/w, then of u/w.
        let (below, fraction) = (w.integer() + w.fraction(), self.read.fraction());
        match (&self.config.correction, &self.unit) {
            (Correction::Reciprocal { rounding, .. }, Some(unit)) => {
                let reciprocal = unit.of(inverse);
                let product = over * reciprocal.mantissa;
                let places = fraction + reciprocal.exponent;
                if places >= below {
                    rounding.shift_right(product, places - below).0
                } else {
                    product << (below - places)
                }
            }
            (Correction::Quotient { rounding } | Correction::ConstantW { rounding }, _) => {
                rounding.divide(over << below, inverse << fraction).map_or(0, |(value, _)| value)
            }
            _ => over >> fraction,
        }
    }

    /// The coordinates of vertices 1 and 2 for the weights of the three at a sample; `None` where 1/w has
    /// come to zero. Clause `CH-6`.
    pub fn coordinates(&self, weights: [i128; 3]) -> Option<[i128; 2]> {
        let Correction::Barycentric { bits, rounding } = self.config.correction else {
            unreachable!("weights of a channel of coordinates")
        };
        let whole: i128 = weights.iter().sum();
        let share = |k: usize| coordinate(rounding, weights[k] << bits, whole);
        (whole > 0).then(|| [share(1), share(2)])
    }

    /// The code for such coordinates. Clause `CH-6`.
    pub fn weighed(&self, coordinates: Option<[i128; 2]>, values: [i128; 3]) -> i64 {
        let Correction::Barycentric { bits, .. } = self.config.correction else {
            unreachable!("coordinates of a channel of coordinates")
        };
        let [u0, u1, u2] = values;
        match coordinates {
            Some([b1, b2]) => {
                self.clamped(((u0 << bits) + b1 * (u1 - u0) + b2 * (u2 - u0)) >> bits)
            }
            None => self.beyond(u0),
        }
    }

    /// Where 1/w has come to zero: the code farthest from 0 on the value's side.
    fn beyond(&self, value: i128) -> i64 {
        let (low, high) = self.config.range();
        bounded(if value < 0 { low } else { high })
    }

    fn clamped(&self, value: i128) -> i64 {
        let (low, high) = self.config.range();
        bounded(value.clamp(low, high))
    }
}

fn coordinate(rounding: Rounding, numerator: i128, whole: i128) -> i128 {
    rounding.divide(numerator, whole).map_or(0, |(value, _)| value)
}
