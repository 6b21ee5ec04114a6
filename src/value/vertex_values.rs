//! What the vertices of a triangle bring for the channels of a profile, checked. Spec clauses `CH-2` and `CH-4`.

use super::attribute::{AttributeConfig, InverseWConfig};

/// Codes of the vertices of one triangle, in the order in which vertices are given.
///
/// Only [`VertexValues::check`] makes one. A model draws it if it goes with the model's own channels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexValues {
    inverse_w: Option<[i128; 3]>,
    components: Vec<[i128; 3]>,
}

/// Values that do not go with the channels of a profile.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ValueError {
    /// A channel without values.
    #[error("the vertices have no values for the channel {0:?}; give them under \"channels\"")]
    Missing(String),
    /// Values of no channel.
    #[error("channel {name:?} is unknown; the channels of the profile are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The channels there are.
        known: String,
    },
    /// Another number of components.
    #[error("channel {name:?}: {got} components are given, but the profile has {need}")]
    Components {
        /// The channel.
        name: String,
        /// Components of the profile.
        need: usize,
        /// Components given.
        got: usize,
    },
    /// A code outside its word.
    #[error(
        "channel {name:?}, vertex {vertex}: {component} = {value}: {low} <= {component} <= {high} is needed"
    )]
    Code {
        /// The channel.
        name: String,
        /// The component.
        component: String,
        /// Which vertex.
        vertex: usize,
        /// The code.
        value: i128,
        /// The smallest code.
        low: i128,
        /// The largest code.
        high: i128,
    },
    /// No 1/w for channels that need it.
    #[error(
        "the channel {0:?} is corrected for perspective, so each vertex needs its 1/w: give \"q\" with `v`, or \"w\" with `f`"
    )]
    NoW(String),
    /// A scene without these values.
    #[error(
        "the scene has no {from:?}, which the channel {channel:?} takes; it has {known}; set `source` of the channel"
    )]
    NoSet {
        /// The channel.
        channel: String,
        /// The name of its values in a scene.
        from: String,
        /// What the scene has.
        known: String,
    },
    /// A scene with too few numbers at each vertex.
    #[error("channel {channel:?}: {need} components, but the scene has {got} for each vertex")]
    Narrow {
        /// The channel.
        channel: String,
        /// Components of the profile.
        need: usize,
        /// Numbers of the scene.
        got: usize,
    },
    /// A triangle whose vertices do not all have values.
    #[error("channel {channel:?}: {what}; give every vertex of the scene a value")]
    Absent {
        /// The channel.
        channel: String,
        /// What has none.
        what: String,
    },
    /// A real that has no code.
    #[error("channel {channel:?}, vertex {vertex}: {value} is not finite; give a number")]
    Real {
        /// The channel.
        channel: String,
        /// Which vertex.
        vertex: usize,
        /// The value.
        value: String,
    },
    /// A vertex at or behind the eye.
    #[error(
        "vertex {vertex}: w = {w}: 0 < w < 2^1024 is needed; clip the triangle in front of the eye first"
    )]
    W {
        /// Which vertex.
        vertex: usize,
        /// Its distance.
        w: String,
    },
    /// A code of 1/w outside its word.
    #[error("vertex {vertex}: q = {value}: 1 <= q <= {high} is needed, the code of 1/w")]
    InverseW {
        /// Which vertex.
        vertex: usize,
        /// The code.
        value: i128,
        /// The largest code.
        high: i128,
    },
}

impl VertexValues {
    /// Values by the name of their channel, three vertices for each component, and codes of 1/w.
    ///
    /// # Errors
    /// [`ValueError`] names the channel, the vertex and the inequality.
    pub fn check(
        channels: &[AttributeConfig],
        w: Option<&InverseWConfig>,
        given: &[(String, Vec<[i128; 3]>)],
        inverse_w: Option<[i128; 3]>,
    ) -> Result<Self, ValueError> {
        if let Some((name, _)) =
            given.iter().find(|(name, _)| channels.iter().all(|channel| channel.name != *name))
        {
            let known: Vec<_> = channels.iter().map(|channel| channel.name.as_str()).collect();
            return Err(ValueError::Unknown { name: name.clone(), known: known.join(", ") });
        }
        let mut components = Vec::new();
        for channel in channels {
            let name = channel.name.clone();
            let Some((_, values)) = given.iter().find(|(given, _)| *given == name) else {
                return Err(ValueError::Missing(name));
            };
            let (need, got) = (channel.components.len(), values.len());
            if need != got {
                return Err(ValueError::Components { name, need, got });
            }
            if channel.correction.needs_w() && inverse_w.is_none() {
                return Err(ValueError::NoW(name));
            }
            let (low, high) = channel.range();
            for (component, vertices) in channel.components.iter().zip(values) {
                for (vertex, value) in vertices.iter().enumerate() {
                    if !(low..=high).contains(value) {
                        let (component, value) = (component.clone(), *value);
                        return Err(ValueError::Code { name, component, vertex, value, low, high });
                    }
                }
                components.push(*vertices);
            }
        }
        let high = w.map_or(1, |w| (1i128 << w.integer) - 1);
        let inverse_w = inverse_w.filter(|_| w.is_some());
        for (vertex, value) in inverse_w.iter().flatten().enumerate() {
            if !(1..=high).contains(value) {
                return Err(ValueError::InverseW { vertex, value: *value, high });
            }
        }
        Ok(Self { inverse_w, components })
    }

    /// Codes of 1/w.
    pub fn inverse_w(&self) -> Option<[i128; 3]> {
        self.inverse_w
    }

    /// Codes of all components, channel by channel.
    pub fn components(&self) -> &[[i128; 3]] {
        &self.components
    }
}
