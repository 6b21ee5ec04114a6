//! Triangles that are not drawn for their winding or their size. Spec clauses `FP-10` and `FP-11`.

use super::triangle::Triangle;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A way around a triangle, from v0 over v1 to v2, as it is seen in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Winding {
    /// Positive area: y points down.
    Clockwise,
    /// Negative area.
    CounterClockwise,
}

impl Winding {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Clockwise, Self::CounterClockwise];
}

impl std::fmt::Display for Winding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Clockwise => "clockwise",
            Self::CounterClockwise => "counter-clockwise",
        })
    }
}

/// Triangles that are not drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct CullConfig {
    /// The winding that is not drawn; both are drawn when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub winding: Option<Winding>,
    /// The largest edge that is drawn; any when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest: Option<LargestEdge>,
}

/// The largest edge of a triangle that is drawn, in whole pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct LargestEdge {
    /// Most columns between the ends of an edge.
    pub x: u32,
    /// Most rows.
    pub y: u32,
}

impl CullConfig {
    /// Whether a triangle on a grid of these sub-pixel bits is left out. One without area has no winding.
    pub fn culls(&self, triangle: &Triangle, sub_pixel: u32) -> bool {
        let area = triangle.area2();
        let turned = self.winding.is_some_and(|winding| match winding {
            Winding::Clockwise => area > 0,
            Winding::CounterClockwise => area < 0,
        });
        let large = self.largest.is_some_and(|LargestEdge { x, y }| {
            [x, y].into_iter().enumerate().any(|(axis, most)| {
                let (low, high) = triangle.extent(axis);
                high - low > i128::from(most) << sub_pixel
            })
        });
        turned || large
    }
}
