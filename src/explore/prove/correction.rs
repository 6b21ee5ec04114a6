//! How far a correction for perspective is off, from the errors of u/w and 1/w and of what it does with them.
//! Spec clause `CH-22`.

use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use crate::value::{Correction, ReciprocalUnit};
use num_traits::{One, Signed, Zero};

/// A unit is tried with every operand of so many bits at most.
pub(super) const TRIED: u32 = 24;

/// A division at a sample: P / Q, or P times the reciprocal of Q.
pub(super) struct Stages {
    /// The largest size of a code.
    pub(super) top: Rational,
    /// B, the bits of a code of 1/w.
    pub(super) bits: u32,
    /// The smallest code of 1/w.
    pub(super) least: i128,
    /// The last rounding.
    pub(super) rounding: Rounding,
    pub(super) unit: Option<UnitError>,
}

/// The relative error of a reciprocal unit.
pub(super) struct UnitError {
    pub(super) operand: u32,
    /// Over all normalised operands.
    normalised: Rational,
}

impl UnitError {
    /// `None` for an operand with too many bits to try them all.
    pub(super) fn of(unit: &ReciprocalUnit) -> Option<Self> {
        let operand = unit.config().operand;
        (operand <= TRIED).then(|| {
            let worst = unit.worst();
            Self { operand, normalised: dyadic(worst.error.abs(), worst.scale) }
        })
    }

    /// For a Q of so many bits: what `CH-9` cuts makes a longer one larger by less than 2^-(p-1) of itself.
    pub(super) fn at(&self, bits: u32) -> Rational {
        if bits <= self.operand {
            return self.normalised.clone();
        }
        let cut = dyadic(1, self.operand - 1);
        &self.normalised + (Rational::one() + &self.normalised) * cut
    }
}

/// The errors that come into a division: of u/w in ULP, of 1/w in its codes, and of the unit.
pub(super) struct Incoming {
    pub(super) p: Rational,
    pub(super) q: Rational,
    pub(super) unit: Rational,
}

impl Stages {
    /// What the unit adds for a 1/w of `fraction` bits below the point.
    pub(super) fn unit_error(&self, fraction: u32) -> Rational {
        self.unit.as_ref().map_or_else(Rational::zero, |unit| unit.at(self.bits + fraction))
    }

    /// The room that 1/w has above 0.
    pub(super) fn room(&self, q: &Rational) -> Rational {
        integer(self.least) - q
    }

    /// The largest error before the last rounding, in ULP; none where 1/w can come to 0.
    pub(super) fn value_error(&self, errors: &Incoming) -> Option<Rational> {
        let room = self.room(&errors.q);
        if !room.is_positive() {
            return None;
        }
        let scale = integer(1 << self.bits);
        let spread = (&errors.p * scale + &self.top * &errors.q) / room;
        Some(spread * (Rational::one() + &errors.unit) + &self.top * &errors.unit)
    }

    /// The largest error of the last rounding.
    pub(super) fn last(&self) -> Rational {
        dyadic(1, u32::from(self.rounding.is_nearest()))
    }

    /// The inequality up to its value.
    pub(super) fn text(&self, errors: &Incoming) -> String {
        let Incoming { p, q, unit } = errors;
        let Self { top, bits, least, .. } = self;
        let spread = format!("({p} x 2^{bits} + {top} x {q}) / ({least} - {q})");
        if unit.is_zero() { spread } else { format!("{spread} x (1 + {unit}) + {top} x {unit}") }
    }
}

/// The last rounding of a correction that divides at each sample.
pub(super) fn last_rounding(correction: &Correction) -> Option<Rounding> {
    match correction {
        Correction::Quotient { rounding }
        | Correction::Reciprocal { rounding, .. }
        | Correction::ConstantW { rounding } => Some(*rounding),
        _ => None,
    }
}
