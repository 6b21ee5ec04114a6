//! Channels as a profile configures them: planes that are given, planes of vertex values, and weights. Spec
//! clauses `RE-7` to `RE-9`.

use super::part::{Origin, choice};
use crate::bits::Rounding;
use crate::machine::register::is_default;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How something is divided by the area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Division {
    /// Exactly, with one rounding.
    Quotient(Rounding),
    /// By a reciprocal that is an integer quotient.
    Reciprocal {
        /// The numerator is this power of two.
        numerator: u32,
        /// Low bits of the area that the divisor lacks.
        #[serde(default, skip_serializing_if = "is_default")]
        drop: u32,
        /// The reciprocal where the divisor is zero.
        #[serde(default, skip_serializing_if = "is_default")]
        zero: u64,
    },
    /// By a reciprocal that a table gives, and a straight line between its entries.
    Table {
        /// Bits below the leading one of the area that choose the entry.
        index: u32,
        /// Bits below these that say how far it is to the next entry.
        between: u32,
        /// Fraction bits of an entry.
        seed: u32,
    },
}

choice! {
    /// Where a plane starts.
    PlaneStart {
        /// At the first pixel of the box.
        #[default]
        Box "box",
        /// At vertex 0, for every pixel anew.
        Vertex "vertex",
    }
}

/// Where the channels come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum ValueSource {
    /// Registers hold the value at a pixel, and its change to the next one, right and down.
    Given {
        /// At which pixel.
        #[serde(default, skip_serializing_if = "is_default")]
        at: Origin,
    },
    /// Planes of the values at the vertices.
    Planes {
        /// How slopes are divided.
        divide: Division,
        /// Where a plane starts.
        #[serde(default, skip_serializing_if = "is_default")]
        start: PlaneStart,
        /// Fraction bits of start and slopes before they are cut to a channel's; those of the channel if not
        /// given.
        #[serde(default, skip_serializing_if = "is_default")]
        fraction: Option<u32>,
        /// Bits of start and slopes before that; 64 if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        width: Option<u32>,
        /// Bits of a slope's product with the reciprocal; 128 if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        product: Option<u32>,
        /// Whether half a code is added to the start.
        #[serde(default, skip_serializing_if = "is_default")]
        half: bool,
    },
    /// Sums of the values at the vertices, weighted by the edge words.
    Weights {
        /// How an edge word is divided.
        divide: Division,
        /// Fraction bits of a weight.
        fraction: u32,
        /// Places that an edge word's product with the reciprocal is cut by before it is a word.
        #[serde(default, skip_serializing_if = "is_default")]
        product_cut: u32,
        /// Bits of that word, which has no sign; 64 if not given.
        #[serde(default, skip_serializing_if = "is_default")]
        product: Option<u32>,
    },
}
