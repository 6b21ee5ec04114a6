//! What vertices bring for channels, made ready for a model. Spec clauses `CH-2` and `CH-4`.

use super::Model;
use super::primitive::{Kind, Primitive, PrimitiveError};
use crate::bits::Rounding;
use crate::scene::{Attributes, Shading};
use crate::setup::snap_f64;
use crate::value::{AttributeConfig, InverseWConfig, ValueError, VertexValues};

impl Model {
    /// Adds what the vertices of a triangle bring for channels; anything else has none.
    ///
    /// # Errors
    /// [`PrimitiveError`] for values that do not go with the channels of the profile.
    pub fn shade(
        &self,
        primitive: Primitive,
        shading: &Shading,
    ) -> Result<Primitive, PrimitiveError> {
        let values = self.shading(shading)?;
        Ok(Primitive(match primitive.0 {
            Kind::Triangle(triangle) => Kind::Shaded(triangle, values),
            other => other,
        }))
    }

    /// The codes of a scene's triangle, each channel from the values of its `source`.
    ///
    /// # Errors
    /// [`PrimitiveError`] for values that the scene does not have, or that do not go with the channels.
    pub fn scene_values(
        &self,
        attributes: &Attributes,
        triangle: usize,
    ) -> Result<VertexValues, PrimitiveError> {
        let mut channels = Vec::new();
        for config in &self.profile.channel {
            let (channel, from) = (config.name.clone(), config.source());
            let Some(set) = attributes.sets.iter().find(|set| set.name == from) else {
                let names: Vec<_> = attributes.sets.iter().map(|set| set.name).collect();
                let known = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                return Err(ValueError::NoSet { channel, from: from.to_owned(), known }.into());
            };
            let (need, got) = (config.components.len(), set.components);
            if need > got {
                return Err(ValueError::Narrow { channel, need, got }.into());
            }
            let values: Vec<[f64; 3]> = (0..need).map(|k| set.at(triangle, k)).collect();
            if let Some(place) = &set.missing
                && values.iter().flatten().any(|value| value.is_nan())
            {
                return Err(ValueError::Absent { channel, place: place.clone() }.into());
            }
            channels.push((channel, values));
        }
        self.shading(&Shading::Reals { channels, w: attributes.w.get(triangle).copied() })
    }

    /// The codes of what vertices bring: integers are checked, reals are multiplied by the channel's unit
    /// and rounded once to nearest even. Spec clauses `CH-2` and `CH-4`.
    ///
    /// # Errors
    /// [`PrimitiveError`] for values that do not go with the channels of the profile.
    pub fn shading(&self, shading: &Shading) -> Result<VertexValues, PrimitiveError> {
        if self.profile.channel.is_empty() {
            return Err(PrimitiveError::NoChannels);
        }
        let (channels, w) = match shading {
            Shading::Codes { channels, inverse_w } => {
                return Ok(self.values(channels, *inverse_w)?);
            }
            Shading::Reals { channels, w } => (channels, w),
        };
        let mut codes = Vec::new();
        for (name, components) in channels {
            let config = self.profile.channel.iter().find(|channel| channel.name == *name);
            let unit = config.map_or(1, AttributeConfig::unit);
            let code = |vertex: usize, value: f64| {
                real_code(value, unit).ok_or_else(|| {
                    let (channel, value) = (name.clone(), value.to_string());
                    ValueError::Real { channel, vertex, value }
                })
            };
            let component = |v: &[f64; 3]| Ok([code(0, v[0])?, code(1, v[1])?, code(2, v[2])?]);
            let values: Result<Vec<_>, ValueError> = components.iter().map(component).collect();
            codes.push((name.clone(), values?));
        }
        let inverse_w = match (w, self.profile.w) {
            (Some(w), Some(config)) => Some(inverse_w(&config, *w)?),
            _ => None,
        };
        Ok(self.values(&codes, inverse_w)?)
    }
}

/// The code of a real number: times the code of 1, to nearest even; `None` where it is not finite.
fn real_code(value: f64, unit: i128) -> Option<i128> {
    #[expect(clippy::cast_precision_loss, reason = "a unit has at most 32 bits")]
    let product = value * unit as f64;
    snap_f64(product, 0, Rounding::NearestEven)
}

/// Codes of 1/w for distances from the eye: the nearest vertex of the triangle has the largest code, and no
/// code is 0. Spec clause `CH-4`.
fn inverse_w(config: &InverseWConfig, w: [f64; 3]) -> Result<[i128; 3], ValueError> {
    if let Some(vertex) = (0..3).find(|n| !(w[*n] > 0.0 && w[*n].is_finite())) {
        return Err(ValueError::W { vertex, w: w[vertex].to_string() });
    }
    let nearest = w[0].min(w[1]).min(w[2]);
    let largest = (1i128 << config.integer) - 1;
    Ok(w.map(|w| real_code(nearest / w, largest).map_or(1, |code| code.max(1))))
}
