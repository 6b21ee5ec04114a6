//! Reading a field from a profile, and writing it there. Spec clause `Q-1`.

use super::{BIASES, FORMS, Field, FieldError, QUOTIENT, Value};
use crate::bits::Rounding;
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule, SampleConfig};
use crate::format::Clamp;
use crate::machine::EdgeWalkConfig;
use crate::profile::{Form, Profile};
use crate::setup::Division;
use crate::value::{DepthConfig, StartBias};

impl Field {
    /// What a profile has here; `None` where it has no such field.
    pub fn read(self, profile: &Profile) -> Option<Value> {
        let edges = match profile.form {
            Form::EdgeFunction(edges) => Some(edges),
            Form::EdgeWalk(_) => None,
        };
        let walk = match profile.form {
            Form::EdgeFunction(_) => None,
            Form::EdgeWalk(walk) => Some(walk),
        };
        let rounding = |rounding: Rounding| Value::Name(rounding.names().guardbit);
        let depth = profile.depth;
        Some(match self {
            Self::SubPixel => Value::Bits(profile.vertex.sub_pixel),
            Self::VertexInteger => Value::Bits(profile.vertex.integer),
            Self::Snap => rounding(profile.vertex.snap),
            Self::Form => Value::Name(FORMS[usize::from(walk.is_some())]),
            Self::EdgeWidth => Value::Bits(edges?.width),
            Self::WalkFraction => Value::Bits(walk?.fraction),
            Self::WalkInteger => Value::Bits(walk?.integer),
            Self::WalkGuard => Value::Bits(walk?.guard),
            Self::WalkRounding => rounding(walk?.rounding),
            Self::Integer => Value::Bits(depth?.integer),
            Self::Interpolation => Value::Bits(depth?.interpolation),
            Self::Guard => Value::Bits(depth?.guard),
            Self::Rounding => rounding(depth?.rounding),
            Self::Clamp => Value::Name(depth?.clamp.name()),
            Self::Reciprocal => match depth?.division {
                Division::Quotient => Value::Name(QUOTIENT),
                Division::Reciprocal { bits } => Value::Bits(bits),
            },
            Self::StartBias => {
                Value::Name(BIASES[usize::from(depth?.start_bias == StartBias::Half)])
            }
        })
    }

    /// Sets the field. Whether the parts of the profile still go together is for
    /// [`Profile::validate`] to say.
    ///
    /// # Errors
    /// [`FieldError`] for a field that the profile does not have, or a value it does not take.
    pub fn write(self, profile: &mut Profile, value: &Value) -> Result<(), FieldError> {
        let bits = || match value {
            Value::Bits(bits) => Ok(*bits),
            Value::Name(_) => Err(self.unfit(value)),
        };
        let rounding = || {
            let named = |rounding: &Rounding| Value::Name(rounding.names().guardbit) == *value;
            Rounding::ALL.into_iter().find(named).ok_or_else(|| self.unfit(value))
        };
        match self {
            Self::SubPixel => return self.move_grid(profile, bits()?),
            Self::VertexInteger => profile.vertex.integer = bits()?,
            Self::Snap => profile.vertex.snap = rounding()?,
            Self::Form => match value {
                Value::Name(name) if *name == FORMS[0] => to_edge_function(profile),
                Value::Name(name) if *name == FORMS[1] => to_edge_walk(profile),
                _ => return Err(self.unfit(value)),
            },
            Self::EdgeWidth => {
                let width = match value {
                    Value::Bits(bits) => *bits,
                    Value::Name(_) => exact_width(profile).ok_or(self.absent())?,
                };
                self.edges(profile)?.width = width;
            }
            Self::WalkFraction => self.walk(profile)?.fraction = bits()?,
            Self::WalkInteger => self.walk(profile)?.integer = bits()?,
            Self::WalkGuard => self.walk(profile)?.guard = bits()?,
            Self::WalkRounding => self.walk(profile)?.rounding = rounding()?,
            Self::Integer => self.depth(profile)?.integer = bits()?,
            Self::Interpolation => self.depth(profile)?.interpolation = bits()?,
            Self::Guard => self.depth(profile)?.guard = bits()?,
            Self::Rounding => self.depth(profile)?.rounding = rounding()?,
            Self::Clamp => {
                let named = |clamp: &Clamp| Value::Name(clamp.name()) == *value;
                let clamp = Clamp::ALL.into_iter().find(named);
                self.depth(profile)?.clamp = clamp.ok_or_else(|| self.unfit(value))?;
            }
            Self::Reciprocal => {
                self.depth(profile)?.division = match value {
                    Value::Bits(bits) => Division::Reciprocal { bits: *bits },
                    Value::Name(_) => Division::Quotient,
                };
            }
            Self::StartBias => {
                let half = *value == Value::Name(BIASES[1]);
                self.depth(profile)?.start_bias =
                    if half { StartBias::Half } else { StartBias::None };
            }
        }
        Ok(())
    }

    const fn absent(self) -> FieldError {
        FieldError::Absent(self.name())
    }

    fn edges(self, profile: &mut Profile) -> Result<&mut EdgeWordConfig, FieldError> {
        match &mut profile.form {
            Form::EdgeFunction(edges) => Ok(edges),
            Form::EdgeWalk(_) => Err(self.absent()),
        }
    }

    fn walk(self, profile: &mut Profile) -> Result<&mut EdgeWalkConfig, FieldError> {
        match &mut profile.form {
            Form::EdgeWalk(walk) => Ok(walk),
            Form::EdgeFunction(_) => Err(self.absent()),
        }
    }

    fn depth(self, profile: &mut Profile) -> Result<&mut DepthConfig, FieldError> {
        profile.depth.as_mut().ok_or(self.absent())
    }

    /// Another grid: a sample that a profile places stays where it is in its pixel.
    fn move_grid(self, profile: &mut Profile, to: u32) -> Result<(), FieldError> {
        let from = profile.vertex.sub_pixel;
        if let Some(SampleConfig { x, y }) = profile.sample {
            let moved = [x, y].map(|value| {
                let scaled = u64::from(value) << to.min(32);
                (scaled.trailing_zeros() >= from || value == 0).then_some(scaled >> from)
            });
            let [Some(x), Some(y)] = moved.map(|m| m.and_then(|m| u32::try_from(m).ok())) else {
                return Err(FieldError::Value {
                    field: self.name(),
                    value: to.to_string(),
                    expected: format!("the sample at ({x}, {y}) / 2^{from} is not on that grid"),
                });
            };
            profile.sample = Some(SampleConfig { x, y });
        }
        profile.vertex.sub_pixel = to;
        Ok(())
    }
}

/// The width that holds every edge value of a profile's field and window; `None` under an edge
/// walk, or where vertex field or sample are malformed.
pub fn exact_width(profile: &Profile) -> Option<u32> {
    let Form::EdgeFunction(edges) = profile.form else { return None };
    profile.vertex.validate().ok()?;
    let size = (profile.window.width, profile.window.height);
    Some(edges.exact_width(&profile.vertex, &profile.grid().ok()?, size))
}

/// The exact edge function in place of a walk.
fn to_edge_function(profile: &mut Profile) {
    if let Form::EdgeWalk(_) = profile.form {
        let (rule, storage) = (FillRule::TopLeft, EdgeStorage::Shifted);
        profile.form = Form::EdgeFunction(EdgeWordConfig { rule, storage, width: 2 });
        let width = exact_width(profile).unwrap_or(2);
        profile.form = Form::EdgeFunction(EdgeWordConfig { rule, storage, width });
    }
}

/// The walk of the same width in place of an edge function: one guard bit, the integer bits of the
/// vertex field, and all the rest as fraction.
fn to_edge_walk(profile: &mut Profile) {
    if let Form::EdgeFunction(edges) = profile.form {
        let (guard, integer) = (1, profile.vertex.integer);
        let fraction = edges.width.saturating_sub(guard + integer);
        let rounding = Rounding::NearestEven;
        profile.form = Form::EdgeWalk(EdgeWalkConfig { guard, integer, fraction, rounding });
    }
}
