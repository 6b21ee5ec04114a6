//! Wrapping edge functions over quads of 2 x 2 pixels: coefficients as they are given, or made of
//! vertices. Spec clauses `RG-5` to `RG-7`.

mod engine;
mod form;
mod host;

use super::Built;
use super::input::{Inputs, RegisterError};
use crate::format::Gather;
use crate::machine::Target;
use crate::setup::VertexConfig;
use crate::value::Channel;
use engine::Quads;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where edge functions come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum QuadEdges {
    /// Registers hold a, b and c of each, in pixels from the tile's origin.
    Given {
        /// Fraction bits of a, b and c; a host divides them by the larger of |a| and |b|.
        fraction: u32,
    },
    /// Registers hold vertices in sub-pixels.
    Vertices,
}

/// Who owns what lies on an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum QuadRule {
    /// Both sides: E >= 0.
    Both,
    /// Not a right edge and not a flat bottom; which side an edge is on is found by a truncating
    /// division.
    TruncatedSide,
}

/// What a record holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Emit {
    /// Each covered pixel.
    Pixels,
    /// Each quad with a covered pixel, and its mask.
    Quads,
}

/// Tiles that are halved until a block is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Descent {
    /// Pixels on a side of a tile, a power of two.
    pub tile: u32,
    /// Pixels on a side of a block, a power of two.
    pub block: u32,
}

/// The engine of `[form.registers.engine.quads]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct QuadConfig {
    /// Where edge functions come from.
    pub edges: QuadEdges,
    /// Bits of an edge word; everything wraps in them.
    pub width: u32,
    /// Who owns what lies on an edge.
    pub rule: QuadRule,
    /// What a record holds.
    pub emit: Emit,
    /// Halving of tiles; without it, every quad of the range is tried.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub descent: Option<Descent>,
}

const NAME: &str = "quads";

/// Where the registers lie.
#[derive(Clone, Debug)]
pub(super) enum Source {
    Given { tile: [Gather; 2], range: [Gather; 4], edges: [[Gather; 3]; 3], fraction: u32 },
    Vertices { vertices: [[Gather; 2]; 3], range: [Gather; 4], signed: bool },
}

impl QuadConfig {
    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        if !(2..=32).contains(&self.width) {
            return Err(fault(format!("width = {}: an edge word has 2 to 32 bits", self.width)));
        }
        if let Some(channel) = channels.first() {
            return Err(fault(format!(
                "channel {:?}: quads have edge values and no channels",
                channel.name
            )));
        }
        let all = |names| inputs.all(NAME, names);
        let source = match self.edges {
            QuadEdges::Given { fraction } => {
                if self.rule == QuadRule::TruncatedSide {
                    return Err(fault(
                        "rule = \"truncated-side\" looks at vertices, and edges are given"
                            .to_owned(),
                    ));
                }
                if fraction > self.width - 2 {
                    let most = self.width - 2;
                    return Err(fault(format!(
                        "fraction = {fraction} <= width - 2 = {most} is needed"
                    )));
                }
                Source::Given {
                    tile: all2(inputs, ["tile_x", "tile_y"])?,
                    range: all(["x_min", "x_max", "y_min", "y_max"])?,
                    edges: [
                        inputs.all(NAME, ["a0", "b0", "c0"])?,
                        inputs.all(NAME, ["a1", "b1", "c1"])?,
                        inputs.all(NAME, ["a2", "b2", "c2"])?,
                    ],
                    fraction,
                }
            }
            QuadEdges::Vertices => {
                if vertex.sub_pixel > 15 {
                    return Err(fault(format!("sub-pixel = {} <= 15 is needed", vertex.sub_pixel)));
                }
                Source::Vertices {
                    vertices: [
                        all2(inputs, ["x0", "y0"])?,
                        all2(inputs, ["x1", "y1"])?,
                        all2(inputs, ["x2", "y2"])?,
                    ],
                    range: all(["left", "top", "right", "bottom"])?,
                    signed: vertex.signed,
                }
            }
        };
        if let Some(Descent { tile, block }) = self.descent {
            let power = |side: u32| side.is_power_of_two() && side >= 2;
            if !power(tile) || !power(block) || block > tile || tile > 1024 {
                return Err(fault(format!(
                    "descent tile = {tile}, block = {block}: powers of two, 2 <= block <= tile <= 1024"
                )));
            }
        } else if matches!(self.edges, QuadEdges::Given { .. }) {
            return Err(fault(
                "given edges count from a tile's origin: they need a [..descent] with its size"
                    .to_owned(),
            ));
        }
        let mut names = vec!["x".to_owned(), "y".to_owned()];
        let places = match self.emit {
            Emit::Pixels => 1,
            Emit::Quads => 4,
        };
        if self.emit == Emit::Quads {
            names.push("mask".to_owned());
        }
        for edge in 0..3 {
            names.extend((0..places).map(|place| match self.emit {
                Emit::Pixels => format!("e{edge}"),
                Emit::Quads => format!("e{edge}_{place}"),
            }));
        }
        Ok((Box::new(Quads { config: *self, source, target }), vec![names]))
    }
}

fn all2(inputs: &Inputs<'_>, names: [&str; 2]) -> Result<[Gather; 2], RegisterError> {
    inputs.all(NAME, names)
}
