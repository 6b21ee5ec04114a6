//! The decisions of a vertex field that a search may vary. Spec clause `Q-1`.

use super::VertexConfig;
use crate::bits::Rounding;
use crate::format::{Decision, Level, Refused, Value};

/// The words of a rounding.
pub(crate) fn roundings() -> Vec<&'static str> {
    Rounding::ALL.map(|rounding| rounding.names().guardbit).to_vec()
}

/// The rounding that a word stands for.
pub(crate) fn rounding(value: &Value) -> Result<Rounding, Refused> {
    Refused::unless(value.choose(&Rounding::ALL, |rounding| rounding.names().guardbit))
}

impl VertexConfig {
    /// Sub-pixel bits of the grid.
    pub const SUB_PIXEL: Decision = Decision::bits("sub-pixel", Level::Stage, "S-1", [0, 32]);
    /// Integer bits of the field.
    pub const INTEGER: Decision = Decision::bits("vertex-integer", Level::Stage, "S-1", [0, 32]);
    /// Rounding to the grid.
    pub const SNAP: Decision = Decision::words("snap", Level::Stage, "S-3", roundings);
    /// All of them.
    pub const DECISIONS: &[Decision] = &[Self::SUB_PIXEL, Self::INTEGER, Self::SNAP];

    /// What a decision of this name is set to; `None` for another owner's.
    pub fn decision(&self, name: &str) -> Option<Value> {
        Some(match name {
            "sub-pixel" => Value::Bits(self.sub_pixel),
            "vertex-integer" => Value::Bits(self.integer),
            "snap" => Value::Name(self.snap.names().guardbit),
            _ => return None,
        })
    }

    /// Sets a decision.
    ///
    /// # Errors
    /// [`Refused`] for another owner's, or a value that it does not take.
    pub fn decide(&mut self, name: &str, value: &Value) -> Result<(), Refused> {
        match name {
            "sub-pixel" => self.sub_pixel = Refused::unless(value.bits())?,
            "vertex-integer" => self.integer = Refused::unless(value.bits())?,
            "snap" => self.snap = rounding(value)?,
            _ => return Err(Refused::Absent),
        }
        Ok(())
    }
}
