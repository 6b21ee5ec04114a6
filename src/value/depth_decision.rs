//! The decisions of a depth plane that a search may vary. Spec clause `Q-1`.

use super::{DepthConfig, DepthFormat, StartBias};
use crate::format::{Clamp, Decision, Level, Refused, Takes, Value};
use crate::setup::{Division, rounding, roundings};

/// f / n of a format that a profile does not state.
const RATIO: u32 = 1000;
/// The word for a division without a reciprocal.
const QUOTIENT: &str = "quotient";

const fn bias_name(bias: StartBias) -> &'static str {
    match bias {
        StartBias::None => "none",
        StartBias::Half => "half",
    }
}
const BIASES: [StartBias; 2] = [StartBias::None, StartBias::Half];

impl DepthConfig {
    /// Depth bits.
    pub const INTEGER: Decision = Decision::bits("integer", Level::Stage, "F-1", [1, 64]);
    /// Interpolation bits.
    pub const INTERPOLATION: Decision =
        Decision::bits("interpolation", Level::Value, "F-1", [0, 119]);
    /// Guard bits.
    pub const GUARD: Decision = Decision::bits("guard", Level::Value, "G-1", [0, 119]);
    /// Rounding of the plane.
    pub const ROUNDING: Decision = Decision::words("rounding", Level::Value, "P-3", roundings);
    /// Clamp of the read-out.
    pub const CLAMP: Decision =
        Decision::words("clamp", Level::Value, "G-1", || Clamp::ALL.map(Clamp::name).to_vec());
    /// Bits of the reciprocal behind the plane.
    pub const RECIPROCAL: Decision = Decision {
        name: "reciprocal",
        level: Level::Value,
        clause: "P-4",
        takes: Takes::Bits { least: 2, most: 40, word: Some(QUOTIENT) },
    };
    /// What the start gains.
    pub const START_BIAS: Decision =
        Decision::words("start-bias", Level::Value, "P-2", || BIASES.map(bias_name).to_vec());
    /// What is stored of depth.
    pub const FORMAT: Decision =
        Decision::words("depth-format", Level::Value, "Z-1", || DepthFormat::NAMES.to_vec());
    /// Units of the depth bias, where the profile has one.
    pub const BIAS_CONSTANT: Decision =
        Decision::number("bias-constant", Level::Value, "Z-7", [i64::MIN, i64::MAX]);
    /// The multiple of the slope in it.
    pub const BIAS_SLOPE: Decision =
        Decision::number("bias-slope", Level::Value, "Z-7", [i64::MIN, i64::MAX]);
    /// All of them.
    pub const DECISIONS: &[Decision] = &[
        Self::INTEGER,
        Self::INTERPOLATION,
        Self::GUARD,
        Self::ROUNDING,
        Self::CLAMP,
        Self::RECIPROCAL,
        Self::START_BIAS,
        Self::FORMAT,
        Self::BIAS_CONSTANT,
        Self::BIAS_SLOPE,
    ];

    /// What a decision of this name is set to; `None` for another owner's.
    pub fn decision(&self, name: &str) -> Option<Value> {
        Some(match name {
            "integer" => Value::Bits(self.integer),
            "interpolation" => Value::Bits(self.interpolation),
            "guard" => Value::Bits(self.guard),
            "rounding" => Value::Name(self.rounding.names().guardbit),
            "clamp" => Value::Name(self.clamp.name()),
            "reciprocal" => match self.division {
                Division::Quotient => Value::Name(QUOTIENT),
                Division::Reciprocal { bits } => Value::Bits(bits),
            },
            "start-bias" => Value::Name(bias_name(self.start_bias)),
            "depth-format" => {
                Value::Name(self.format.map_or(DepthFormat::NAMES[0], |format| format.name()))
            }
            "bias-constant" => Value::Number(self.bias?.constant),
            "bias-slope" => Value::Number(self.bias?.slope),
            _ => return None,
        })
    }

    /// Sets a decision.
    ///
    /// # Errors
    /// [`Refused`] for another owner's, or a value that it does not take.
    pub fn decide(&mut self, name: &str, value: &Value) -> Result<(), Refused> {
        match name {
            "integer" => self.integer = Refused::unless(value.bits())?,
            "interpolation" => self.interpolation = Refused::unless(value.bits())?,
            "guard" => self.guard = Refused::unless(value.bits())?,
            "rounding" => self.rounding = rounding(value)?,
            "clamp" => self.clamp = Refused::unless(value.choose(&Clamp::ALL, Clamp::name))?,
            "reciprocal" => {
                self.division = match value {
                    Value::Bits(bits) => Division::Reciprocal { bits: *bits },
                    Value::Name(QUOTIENT) => Division::Quotient,
                    Value::Number(_) | Value::Name(_) => return Err(Refused::Unfit),
                };
            }
            "start-bias" => self.start_bias = Refused::unless(value.choose(&BIASES, bias_name))?,
            "depth-format" => {
                let Value::Name(name) = value else { return Err(Refused::Unfit) };
                let ratio = self.format.and_then(|format| format.ratio()).unwrap_or(RATIO);
                let format = DepthFormat::named(name, self.integer.min(32), ratio);
                let format = Refused::unless(format)?;
                // Z/w in as many bits as the plane has is what is stored anyway.
                let plain = matches!(format, DepthFormat::ZOverW { .. });
                self.format = (!plain).then_some(format);
            }
            "bias-constant" | "bias-slope" => {
                let bias = self.bias.as_mut().ok_or(Refused::Absent)?;
                let term = if name == "bias-slope" { &mut bias.slope } else { &mut bias.constant };
                *term = Refused::unless(value.number())?;
            }
            _ => return Err(Refused::Absent),
        }
        Ok(())
    }
}
