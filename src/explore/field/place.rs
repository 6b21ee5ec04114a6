//! Reading a field from a profile, and writing it there. Spec clause `Q-1`.

use super::{BIASES, Field, FieldError, QUOTIENT, ROWS, Value};
use crate::bits::Rounding;
use crate::cover::{EdgeWordConfig, Order, SampleConfig, Stamp, TraversalConfig};
use crate::format::Clamp;
use crate::machine::EdgeWalkConfig;
use crate::profile::{Form, Profile};
use crate::setup::Division;
use crate::value::{DepthConfig, DepthFormat, StartBias};

/// f / n of a format that a profile does not state.
const RATIO: u32 = 1000;

impl Field {
    /// What a profile has here; `None` where it has no such field.
    pub fn read(self, profile: &Profile) -> Option<Value> {
        let (edges, walk) = (profile.form.edge(), profile.form.walk());
        let visits = matches!(profile.form, Form::EdgeFunction(_));
        let rounding = |rounding: Rounding| Value::Name(rounding.names().guardbit);
        let depth = profile.depth;
        Some(match self {
            Self::SubPixel => Value::Bits(profile.vertex.sub_pixel),
            Self::VertexInteger => Value::Bits(profile.vertex.integer),
            Self::Snap => rounding(profile.vertex.snap),
            Self::Form => Value::Name(profile.form.name()),
            Self::Traversal | Self::Stamp if !visits => return None,
            Self::Traversal => {
                Value::Name(profile.traversal.map_or(ROWS, |traversal| traversal.order.name()))
            }
            Self::Stamp => {
                let stamp = profile.traversal.map_or(Stamp::One, |traversal| traversal.stamp);
                Value::Name(stamp.name())
            }
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
            Self::DepthFormat => {
                Value::Name(depth?.format.map_or(DepthFormat::NAMES[0], |format| format.name()))
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
                Value::Name(name) => {
                    *profile = profile.with_machine(name).ok_or_else(|| self.unfit(value))?;
                }
                Value::Bits(_) => return Err(self.unfit(value)),
            },
            Self::Traversal => {
                if !matches!(profile.form, Form::EdgeFunction(_)) {
                    return Err(self.absent());
                }
                let stamp = profile.traversal.map_or(Stamp::One, |traversal| traversal.stamp);
                let named = |order: &Order| Value::Name(order.name()) == *value;
                let order = Order::ALL.into_iter().find(named);
                if order.is_none() && *value != Value::Name(ROWS) {
                    return Err(self.unfit(value));
                }
                profile.traversal = order.map(|order| TraversalConfig { order, stamp });
            }
            Self::Stamp => {
                let named = |stamp: &Stamp| Value::Name(stamp.name()) == *value;
                let stamp = Stamp::ALL.into_iter().find(named).ok_or_else(|| self.unfit(value))?;
                if !matches!(profile.form, Form::EdgeFunction(_)) {
                    return Err(self.absent());
                }
                let plain = profile.traversal.is_none() && stamp == Stamp::One;
                let rows = TraversalConfig { order: Order::BoundingBox, stamp };
                if !plain {
                    profile.traversal.get_or_insert(rows).stamp = stamp;
                }
            }
            Self::EdgeWidth => {
                let width = match value {
                    Value::Bits(bits) => *bits,
                    Value::Name(_) => profile.exact_edge_width().ok_or(self.absent())?,
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
            Self::DepthFormat => {
                let Value::Name(name) = value else { return Err(self.unfit(value)) };
                let depth = self.depth(profile)?;
                let ratio = depth.format.and_then(|format| format.ratio()).unwrap_or(RATIO);
                let format = DepthFormat::named(name, depth.integer.min(32), ratio);
                let format = format.ok_or_else(|| self.unfit(value))?;
                // Z/w in as many bits as the plane has is what is stored anyway.
                let plain = matches!(format, DepthFormat::ZOverW { .. });
                depth.format = (!plain).then_some(format);
            }
        }
        Ok(())
    }

    const fn absent(self) -> FieldError {
        FieldError::Absent(self.name())
    }

    fn edges(self, profile: &mut Profile) -> Result<&mut EdgeWordConfig, FieldError> {
        profile.form.edge_mut().ok_or(self.absent())
    }

    fn walk(self, profile: &mut Profile) -> Result<&mut EdgeWalkConfig, FieldError> {
        profile.form.walk_mut().ok_or(self.absent())
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
