//! The decisions of a channel and of 1/w that a search may vary. Spec clause `Q-1`.

use super::{AttributeConfig, Correction, InverseWConfig};
use crate::format::{Clamp, Decision, Level, Refused, Value};
use crate::setup::{rounding, roundings};
use crate::value::{ReciprocalConfig, Refine};

/// The clamps that a channel can have.
const CLAMPS: [Clamp; 3] = [Clamp::Wrap, Clamp::Guard, Clamp::Sign];

const fn bits(name: &'static str, clause: &'static str, range: [u32; 2]) -> Decision {
    Decision::bits(name, Level::Value, clause, range)
}

const GUARD: Decision = bits("guard", "CH-1", [0, 119]);
const INTERPOLATION: Decision = bits("interpolation", "CH-1", [0, 119]);
const ROUNDING: Decision = Decision::words("rounding", Level::Value, "CH-1", roundings);
const CLAMP: Decision =
    Decision::words("clamp", Level::Value, "CH-1", || CLAMPS.map(Clamp::name).to_vec());

/// The words that a channel and 1/w both have.
macro_rules! words {
    ($config:ty) => {
        impl $config {
            fn word(&self, name: &str) -> Option<Value> {
                Some(match name {
                    "integer" => Value::Bits(self.integer),
                    "interpolation" => Value::Bits(self.interpolation),
                    "guard" => Value::Bits(self.guard),
                    "rounding" => Value::Name(self.rounding.names().guardbit),
                    "clamp" => Value::Name(self.clamp.name()),
                    _ => return None,
                })
            }

            fn decide_word(&mut self, name: &str, value: &Value) -> Result<(), Refused> {
                let number = || Refused::unless(value.bits());
                match name {
                    "integer" => self.integer = number()?,
                    "interpolation" => self.interpolation = number()?,
                    "guard" => self.guard = number()?,
                    "rounding" => self.rounding = rounding(value)?,
                    "clamp" => self.clamp = Refused::unless(value.choose(&CLAMPS, Clamp::name))?,
                    _ => return Err(Refused::Absent),
                }
                Ok(())
            }
        }
    };
}

words!(AttributeConfig);
words!(InverseWConfig);

impl AttributeConfig {
    /// The decisions of a channel; `operand`, `index`, `entry` and `step` are those of its reciprocal unit,
    /// `step` the bits after its last Newton step, and `coordinate` the bits of its coordinates.
    pub const DECISIONS: &[Decision] = &[
        // The unit of a code: what a scene asks for depends on it.
        Decision::bits("integer", Level::Stage, "CH-1", [1, 32]),
        INTERPOLATION,
        GUARD,
        ROUNDING,
        CLAMP,
        bits("operand", "CH-9", [2, 32]),
        bits("index", "CH-10", [1, 16]),
        bits("entry", "CH-10", [2, 31]),
        bits("step", "CH-12", [2, 40]),
        bits("coordinate", "CH-6", [1, 60]),
    ];

    fn unit_config(&mut self) -> Result<&mut ReciprocalConfig, Refused> {
        match &mut self.correction {
            Correction::Reciprocal { unit, .. } => Ok(unit),
            _ => Err(Refused::Absent),
        }
    }

    /// What a decision of this name is set to; `None` where the channel has none.
    pub fn decision(&self, name: &str) -> Option<Value> {
        let number = match (name, &self.correction) {
            ("coordinate", Correction::Barycentric { bits, .. }) => *bits,
            ("operand", Correction::Reciprocal { unit, .. }) => unit.operand,
            ("index", Correction::Reciprocal { unit, .. }) => unit.index,
            ("entry", Correction::Reciprocal { unit, .. }) => unit.entry,
            ("step", Correction::Reciprocal { unit, .. }) => match &unit.refine {
                Refine::Newton { bits } => *bits.last()?,
                Refine::None | Refine::Linear => return None,
            },
            _ => return self.word(name),
        };
        Some(Value::Bits(number))
    }

    /// Sets a decision.
    ///
    /// # Errors
    /// [`Refused`] for one that the channel does not have, or a value that it does not take.
    pub fn decide(&mut self, name: &str, value: &Value) -> Result<(), Refused> {
        let number = || Refused::unless(value.bits());
        match name {
            "operand" => self.unit_config()?.operand = number()?,
            "index" => self.unit_config()?.index = number()?,
            "entry" => self.unit_config()?.entry = number()?,
            "step" => match &mut self.unit_config()?.refine {
                Refine::Newton { bits } => *bits.last_mut().ok_or(Refused::Absent)? = number()?,
                Refine::None | Refine::Linear => return Err(Refused::Absent),
            },
            "coordinate" => match &mut self.correction {
                Correction::Barycentric { bits, .. } => *bits = number()?,
                _ => return Err(Refused::Absent),
            },
            _ => return self.decide_word(name, value),
        }
        Ok(())
    }
}

impl InverseWConfig {
    /// The decisions of 1/w.
    pub const DECISIONS: &[Decision] =
        &[bits("integer", "CH-4", [1, 32]), INTERPOLATION, GUARD, ROUNDING, CLAMP];

    /// What a decision of this name is set to; `None` for another owner's.
    pub fn decision(&self, name: &str) -> Option<Value> {
        self.word(name)
    }

    /// Sets a decision.
    ///
    /// # Errors
    /// [`Refused`] for another owner's, or a value that it does not take.
    pub fn decide(&mut self, name: &str, value: &Value) -> Result<(), Refused> {
        self.decide_word(name, value)
    }
}
