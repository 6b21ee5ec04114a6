//! The viewport: from positions in clip space to the window. Spec clauses `FP-6` to `FP-9`. Floating point
//! decides bits here, as it does in the snap.

mod transform;

use super::snap::VertexError;
use crate::bits::Rounding;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use transform::Destination;

/// A binary32 number of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "f32", into = "f32")]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[cfg_attr(feature = "verification", schemars(with = "f32"))]
pub struct Binary32(u32);

impl From<f32> for Binary32 {
    fn from(value: f32) -> Self {
        Self(value.to_bits())
    }
}

impl From<Binary32> for f32 {
    fn from(value: Binary32) -> Self {
        Self::from_bits(value.0)
    }
}

impl std::fmt::Display for Binary32 {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f32::from(*self).fmt(f)
    }
}

/// Where y of clip space points in the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum VerticalAxis {
    /// Down, as in Vulkan.
    Down,
    /// Up, as in Direct3D and OpenGL.
    #[default]
    Up,
}

/// The depth of clip space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ClipDepth {
    /// 0 to 1 between the near and the far plane, as in Direct3D and Vulkan.
    #[default]
    ZeroToOne,
    /// -1 to 1, as in OpenGL.
    MinusOneToOne,
}

/// What is done with a vertex beyond the depth range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DepthClamp {
    /// It is refused, unless the depth format has a code for it.
    #[default]
    None,
    /// It takes the nearer end of the range.
    Vertex,
}

/// The division by w.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DivisionByW {
    /// Each coordinate is divided by w, and rounded once.
    #[default]
    Quotient,
    /// 1/w is rounded, and each coordinate is multiplied by it and rounded.
    Reciprocal,
}

/// The arithmetic of the transform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Transform {
    /// binary32: the product is rounded, then the sum.
    #[default]
    Separate,
    /// binary32: product and sum are rounded once.
    Fused,
    /// Fixed point: the divided coordinate is rounded, and the rest is exact until it reaches the vertex grid.
    Fixed {
        /// Fraction bits of the divided coordinate.
        fraction: u32,
        /// How it is rounded to them.
        rounding: Rounding,
    },
}

/// The viewport of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ViewportConfig {
    /// Left side, in pixels of the window.
    #[serde(default)]
    pub x: i32,
    /// Upper side, in pixels of the window.
    #[serde(default)]
    pub y: i32,
    /// Width in pixels; that of the window when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// Height in pixels; that of the window when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<u32>,
    /// Where y of clip space points.
    #[serde(default)]
    pub y_axis: VerticalAxis,
    /// The depth of clip space.
    #[serde(default)]
    pub depth: ClipDepth,
    /// Depth of the near plane, 0 to 1.
    #[serde(default = "zero")]
    pub near: Binary32,
    /// Depth of the far plane, 0 to 1.
    #[serde(default = "one")]
    pub far: Binary32,
    /// What is done with a vertex beyond the depth range.
    #[serde(default)]
    pub clamp: DepthClamp,
    /// The division by w.
    #[serde(default)]
    pub division: DivisionByW,
    /// The arithmetic of the transform.
    #[serde(default)]
    pub transform: Transform,
}

fn zero() -> Binary32 {
    0.0.into()
}

fn one() -> Binary32 {
    1.0.into()
}

/// The farthest a viewport reaches, in pixels.
const MOST: u32 = 65_536;

/// A viewport that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ViewportError {
    /// A side that is no window's.
    #[error("{key} = {value}: {low} <= {key} <= {MOST} is needed, in pixels")]
    Side {
        /// The key.
        key: &'static str,
        /// Its value.
        value: i64,
        /// Smallest taken.
        low: i64,
    },
    /// A depth range beyond depth.
    #[error("{key} = {value}: the depth range lies in that of depth, 0 <= {key} <= 1")]
    Range {
        /// The key.
        key: &'static str,
        /// Its value.
        value: Binary32,
    },
    /// Fraction bits beyond the arithmetic.
    #[error("transform.fixed.fraction = {0}: 1 <= fraction <= 40 is needed")]
    Fraction(u32),
}

impl ViewportError {
    /// The key at fault.
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Side { key, .. } | Self::Range { key, .. } => key,
            Self::Fraction(_) => "transform",
        }
    }
}

/// A position without a place in the window.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PositionError {
    /// A vertex at the eye, or behind it.
    #[error(
        "position[{vertex}][3] = {w}: only a vertex with w > 0 has a place in the window; clip the triangle at \
         the near plane first"
    )]
    W {
        /// The vertex.
        vertex: usize,
        /// Its w.
        w: Binary32,
    },
    /// A coordinate outside the vertex field.
    #[error(transparent)]
    Vertex(#[from] VertexError),
}

/// A viewport in its window: half of each side, and the middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Viewport {
    config: ViewportConfig,
    /// Width and height in pixels; the height is negative where y of clip space points up.
    size: [i64; 2],
    /// Twice the middle, in pixels.
    centre2: [i64; 2],
}

impl ViewportConfig {
    /// The viewport, in a window of this size.
    ///
    /// # Errors
    /// [`ViewportError`] names the violated inequality.
    pub fn viewport(&self, window: (u32, u32)) -> Result<Viewport, ViewportError> {
        let size = [self.width.unwrap_or(window.0), self.height.unwrap_or(window.1)];
        for (key, value) in [("width", size[0]), ("height", size[1])] {
            if !(1..=MOST).contains(&value) {
                return Err(ViewportError::Side { key, value: value.into(), low: 1 });
            }
        }
        for (key, value) in [("x", self.x), ("y", self.y)] {
            if value.unsigned_abs() > MOST {
                let low = -i64::from(MOST);
                return Err(ViewportError::Side { key, value: value.into(), low });
            }
        }
        for (key, value) in [("near", self.near), ("far", self.far)] {
            if !(0.0..=1.0).contains(&f32::from(value)) {
                return Err(ViewportError::Range { key, value });
            }
        }
        if let Transform::Fixed { fraction, .. } = self.transform
            && !(1..=40).contains(&fraction)
        {
            return Err(ViewportError::Fraction(fraction));
        }
        let [width, height] = size.map(i64::from);
        let turn = if self.y_axis == VerticalAxis::Up { -1 } else { 1 };
        let centre2 = [2 * i64::from(self.x) + width, 2 * i64::from(self.y) + height];
        Ok(Viewport { config: *self, size: [width, turn * height], centre2 })
    }
}
