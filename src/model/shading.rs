//! What vertices bring for channels, made ready for a model. Spec clauses `CH-2` and `CH-4`.

use super::primitive::{Kind, Primitive, PrimitiveError};
use super::{Model, Span};
use crate::bits::Rounding;
use crate::machine::CodeSink;
use crate::scene::{AttributeSet, Attributes, Named, Shading};
use crate::setup::{Triangle, snap_f64};
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

    /// The codes of a scene's triangle, each channel from the values of its `source`; of JSON Lines, from those
    /// of its own name if there are any.
    ///
    /// # Errors
    /// [`PrimitiveError`] for values that the scene does not have, or that do not go with the channels.
    pub fn scene_values(
        &self,
        attributes: &Attributes,
        triangle: usize,
    ) -> Result<VertexValues, PrimitiveError> {
        self.shading(&self.scene_shading(attributes, triangle)?)
    }

    /// The same before any word decides a code: by the names of the channels.
    pub(crate) fn scene_shading(
        &self,
        attributes: &Attributes,
        triangle: usize,
    ) -> Result<Shading, PrimitiveError> {
        Ok(match attributes {
            Attributes::Mesh { w, sets } => {
                let channels = self.of_mesh(sets, triangle)?;
                Shading::Reals { channels, w: w.get(triangle).copied() }
            }
            Attributes::Lines(lines) => match lines.get(triangle).and_then(Option::as_ref) {
                Some(Shading::Codes { channels, inverse_w }) => {
                    Shading::Codes { channels: self.by_source(channels)?, inverse_w: *inverse_w }
                }
                Some(Shading::Reals { channels, w }) => {
                    Shading::Reals { channels: self.by_source(channels)?, w: *w }
                }
                None => Shading::Codes { channels: self.by_source(&[])?, inverse_w: None },
            },
        })
    }

    /// The codes along covered runs of a triangle, normalised, of the channels that are wanted and have a
    /// place a pixel, whatever machine covers it; `turned` says that two vertices have changed places.
    pub(crate) fn codes_along(
        &self,
        triangle: (&Triangle, bool),
        values: &VertexValues,
        (wanted, runs): (&[bool], &[Span]),
        out: &mut CodeSink<'_>,
    ) {
        if let (Some((channels, _)), Some(carrier)) = (&self.channels, self.machine.carrier()) {
            let runs = runs.iter().map(|run| [run.y, run.x0, run.x1]);
            channels.along(carrier, triangle, values, (wanted, runs), out);
        }
    }

    /// The values of a triangle of a mesh, by channel.
    fn of_mesh(&self, sets: &[AttributeSet], triangle: usize) -> Result<Named<f64>, ValueError> {
        let mut channels = Vec::new();
        for config in &self.profile.channel {
            let channel = config.name.clone();
            let set = sets.iter().find(|set| set.name == config.source());
            let set = set.ok_or_else(|| no_set(config, sets.iter().map(|set| set.name)))?;
            let need = wide_enough(config, set.components)?;
            let values: Vec<[f64; 3]> = (0..need).map(|k| set.at(triangle, k)).collect();
            if values.iter().flatten().any(|value| value.is_nan()) {
                let what = set.missing.clone();
                let what = what.unwrap_or_else(|| format!("a vertex has no {:?}", set.name));
                return Err(ValueError::Absent { channel, what });
            }
            channels.push((channel, values));
        }
        Ok(channels)
    }

    /// Values of a line, by channel. A line that `eval` takes has them by the names of the channels.
    fn by_source<T: Copy>(&self, given: &[(String, Vec<[T; 3]>)]) -> Result<Named<T>, ValueError> {
        let channel = |config: &AttributeConfig| {
            let named = |of: &str| given.iter().find(|(name, _)| name == of);
            let found = named(&config.name).or_else(|| named(config.source()));
            let names = given.iter().map(|(name, _)| name.as_str());
            let (_, values) = found.ok_or_else(|| no_set(config, names))?;
            let need = wide_enough(config, values.len())?;
            Ok((config.name.clone(), values[..need].to_vec()))
        };
        self.profile.channel.iter().map(channel).collect()
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

/// That a scene does not have what a channel takes.
fn no_set<'a>(config: &AttributeConfig, known: impl Iterator<Item = &'a str>) -> ValueError {
    let known = known.collect::<Vec<_>>().join(", ");
    let known = if known.is_empty() { "none".to_owned() } else { known };
    ValueError::NoSet { channel: config.name.clone(), from: config.source().to_owned(), known }
}

/// How many components a channel takes, of those that a scene has.
fn wide_enough(config: &AttributeConfig, got: usize) -> Result<usize, ValueError> {
    let need = config.components.len();
    let narrow = ValueError::Narrow { channel: config.name.clone(), need, got };
    if need > got { Err(narrow) } else { Ok(need) }
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
