//! Channels that a triangle carries beside depth, and the plane of 1/w. Spec clauses `CH-1` to `CH-8`.

mod check;
mod decision;
mod error;

pub use check::validate_channels;
pub use error::AttributeError;

use super::depth::StartBias;
use super::lod::DetailConfig;
use super::reciprocal::ReciprocalConfig;
use crate::bits::Rounding;
use crate::format::Clamp;
use crate::setup::Division;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The most components that the channels of a profile have together.
pub(super) const COMPONENTS: usize = 32;

/// A channel: components of one shape, evaluated at one place, corrected in one way.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct AttributeConfig {
    /// Its name; scenes name the values of their vertices so, and files of a set are named after it.
    pub name: String,
    /// The names of its components.
    pub components: Vec<String>,
    /// Guard bits above the integer bits of the accumulator.
    pub guard: u32,
    /// Bits of a vertex value and of the result.
    pub integer: u32,
    /// Interpolation bits below them.
    pub interpolation: u32,
    /// Whether values are two's complement.
    #[serde(default, skip_serializing_if = "is_false")]
    pub signed: bool,
    /// Rounding of what set-up makes: start and slopes.
    pub rounding: Rounding,
    /// How set-up divides.
    #[serde(default = "quotient", skip_serializing_if = "is_quotient")]
    pub division: Division,
    /// What the read-out does outside its range.
    pub clamp: Clamp,
    /// What the start gains; of a channel without division at each sample.
    #[serde(default, skip_serializing_if = "is_unbiased")]
    pub start_bias: StartBias,
    /// Where it is evaluated.
    #[serde(default, skip_serializing_if = "is_at_sample")]
    pub at: EvaluatedAt,
    /// How perspective is corrected.
    pub correction: Correction,
    /// The code of the real number 1 of a scene; the largest code when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<u32>,
    /// The level of detail of a texture of two coordinates, from the differences of the codes in a quad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<DetailConfig>,
    /// The name of the values in a scene, where it is not the channel's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
}

/// Where a channel is evaluated. Spec clause `CH-7`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum EvaluatedAt {
    /// Where coverage is sampled; at each covered sample where a pixel has several.
    #[default]
    Sample,
    /// At the pixel's centre, covered or not.
    Centre,
    /// At the pixel's upper left corner.
    Corner,
    /// At the centre where every sample is covered, otherwise at the covered sample nearest to it.
    Centroid,
}

/// How the perspective of a channel is corrected. Spec clauses `CH-3` to `CH-6`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Correction {
    /// Not at all: the value is linear in the window.
    Affine,
    /// Not interpolated: the value of one vertex.
    Flat {
        /// Which.
        provoking: Provoking,
    },
    /// u/w and 1/w are linear; their quotient, rounded once at each sample.
    Quotient {
        /// Rounding of the quotient.
        rounding: Rounding,
    },
    /// The same by the reciprocal of 1/w and a product.
    Reciprocal {
        /// The unit.
        unit: ReciprocalConfig,
        /// Rounding of the product.
        rounding: Rounding,
    },
    /// Barycentric coordinates from edge functions times 1/w, rounded at each sample.
    Barycentric {
        /// Fraction bits of a coordinate.
        bits: u32,
        /// Rounding of a coordinate.
        rounding: Rounding,
    },
    /// As `quotient`, with the 1/w of the middle of the span all along it.
    ConstantW {
        /// Rounding of the quotient.
        rounding: Rounding,
    },
}

/// The vertex that a flat channel takes its value from, in the order in which vertices are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Provoking {
    /// The first.
    First,
    /// The last.
    Last,
}

/// The words of 1/w. Spec clause `CH-4`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct InverseWConfig {
    /// Guard bits above the integer bits of the accumulator.
    pub guard: u32,
    /// Bits of a vertex's code of 1/w.
    pub integer: u32,
    /// Interpolation bits below them.
    pub interpolation: u32,
    /// Rounding of start and slopes.
    pub rounding: Rounding,
    /// What the read-out does outside its range.
    pub clamp: Clamp,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_false(value: &bool) -> bool {
    !*value
}

const fn quotient() -> Division {
    Division::Quotient
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_quotient(value: &Division) -> bool {
    matches!(value, Division::Quotient)
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_unbiased(value: &StartBias) -> bool {
    matches!(value, StartBias::None)
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_at_sample(value: &EvaluatedAt) -> bool {
    matches!(value, EvaluatedAt::Sample)
}

impl AttributeConfig {
    /// The smallest and the largest code of a vertex and of the result.
    pub const fn range(&self) -> (i128, i128) {
        let all = 1i128 << self.integer;
        if self.signed { (-(all >> 1), (all >> 1) - 1) } else { (0, all - 1) }
    }

    /// What is added before the read-out and taken away after it, so that signed codes are read, too.
    pub const fn offset(&self) -> i128 {
        if self.signed { 1 << (self.integer - 1) } else { 0 }
    }

    /// The code of the real number 1.
    pub fn unit(&self) -> i128 {
        self.unit.map_or(self.range().1, i128::from)
    }

    /// The name of its values in a scene.
    pub fn source(&self) -> &str {
        self.source.as_deref().unwrap_or(&self.name)
    }

    /// What the start gains, in units of the accumulator.
    pub const fn start_gain(&self) -> i128 {
        match (self.start_bias, self.interpolation) {
            (StartBias::Half, 1..) => 1 << (self.interpolation - 1),
            _ => 0,
        }
    }
}

impl Correction {
    /// Whether it takes 1/w.
    pub const fn needs_w(&self) -> bool {
        !matches!(self, Self::Affine | Self::Flat { .. })
    }

    /// Whether it takes the value of 1/w along the span.
    pub const fn walks_w(&self) -> bool {
        self.needs_w() && !matches!(self, Self::Barycentric { .. })
    }
}
