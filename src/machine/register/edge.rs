//! Edge functions with linear channels, made of parts. Spec clauses `RE-1` to `RE-10`.

mod bounds;
mod check;
mod cover;
mod form;
mod host;
mod linear;
mod order;
mod part;
mod reciprocal;
mod setup;
mod value;
mod weight;
mod wire;

pub use part::{
    BoxEnds, BoxLimit, EdgeBox, EdgeOrder, EdgeRule, EdgeSense, EdgeSource, Origin, TilePlace,
    Winding, WithoutArea,
};
pub use value::{Division, PlaneStart, ValueSource};

use super::is_default;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The engine of `[form.registers.engine.edge-functions]`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct EdgeEngineConfig {
    /// Bits of an edge word; everything wraps in them.
    pub width: u32,
    /// Where edge functions come from.
    pub edges: EdgeSource,
    /// Which windings are drawn.
    #[serde(default, skip_serializing_if = "is_default")]
    pub winding: Winding,
    /// Who owns what lies on an edge.
    #[serde(default, skip_serializing_if = "is_default")]
    pub rule: EdgeRule,
    /// What is done with a triangle without area.
    #[serde(default, skip_serializing_if = "is_default")]
    pub without_area: WithoutArea,
    /// The pixels that are looked at.
    pub r#box: EdgeBox,
    /// In which order.
    #[serde(default, skip_serializing_if = "is_default")]
    pub order: EdgeOrder,
    /// Where the channels come from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<ValueSource>,
}

const NAME: &str = "edge-functions";
