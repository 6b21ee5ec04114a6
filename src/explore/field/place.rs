//! Reading a field from a profile, and writing it there. Spec clause `Q-1`.

use super::{Field, FieldError, Owner, Value};
use crate::cover::{SampleConfig, TraversalConfig};
use crate::format::Refused;
use crate::profile::Profile;

impl Field {
    /// What a profile has here; `None` where it has no such field.
    pub fn read(self, profile: &Profile) -> Option<Value> {
        let name = self.name();
        match self.owner {
            Owner::Vertex => profile.vertex.decision(name),
            Owner::Depth => profile.depth?.decision(name),
            Owner::Form => Some(Value::Name(profile.form.name())),
            Owner::Traversal if !profile.form.visits_the_box() => None,
            Owner::Traversal => TraversalConfig::decision(profile.traversal.as_ref(), name),
            Owner::Machine => profile.form.decision(name),
            Owner::Channel(channel) => {
                let mut own = profile.channel.iter().filter(|own| own.name == channel);
                own.next()?.decision(self.part())
            }
            Owner::InverseW => profile.w?.decision(self.part()),
        }
    }

    /// Sets the field. Validating the changed profile is for
    /// [`Profile::validate`] to say.
    ///
    /// # Errors
    /// [`FieldError`] for a field that the profile does not have, or a value it does not take.
    pub fn write(self, profile: &mut Profile, value: &Value) -> Result<(), FieldError> {
        let name = self.name();
        let done = match self.owner {
            Owner::Vertex => {
                if let Some(bits) = value.bits().filter(|_| self == Self::SUB_PIXEL) {
                    self.move_sample(profile, bits)?;
                }
                profile.vertex.decide(name, value)
            }
            Owner::Depth => match &mut profile.depth {
                Some(depth) => depth.decide(name, value),
                None => Err(Refused::Absent),
            },
            Owner::Form => match value {
                Value::Name(name) => {
                    Refused::unless(profile.with_machine(name)).map(|changed| *profile = changed)
                }
                Value::Bits(_) | Value::Number(_) => Err(Refused::Unfit),
            },
            Owner::Traversal if !profile.form.visits_the_box() => Err(Refused::Absent),
            Owner::Traversal => TraversalConfig::decide(&mut profile.traversal, name, value),
            Owner::Channel(channel) => {
                let own = profile.channel.iter_mut().find(|own| own.name == channel);
                own.ok_or(Refused::Absent).and_then(|own| own.decide(self.part(), value))
            }
            Owner::InverseW => match &mut profile.w {
                Some(w) => w.decide(self.part(), value),
                None => Err(Refused::Absent),
            },
            Owner::Machine => {
                let state = profile.state();
                profile.form.decide(name, value, &state)
            }
        };
        done.map_err(|refused| match refused {
            Refused::Absent => FieldError::Absent(name),
            Refused::Unfit => self.unfit(value),
        })
    }

    /// To another grid: a sample that a profile places stays where it is in its pixel.
    fn move_sample(self, profile: &mut Profile, to: u32) -> Result<(), FieldError> {
        let from = profile.vertex.sub_pixel;
        // A place in parts of a pixel of its own is the same on any grid.
        let Some(SampleConfig { x, y, of: None }) = profile.sample else { return Ok(()) };
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
        profile.sample = Some(SampleConfig::sub_pixels(x, y));
        Ok(())
    }
}
