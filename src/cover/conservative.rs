//! Conservative coverage: a pixel is a square instead of a sample. Spec clauses `CR-1` to `CR-5`.

use super::sample::SampleGrid;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which pixels a triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ConservativeMode {
    /// Those whose square it touches.
    Outer,
    /// Those whose square lies in it.
    Inner,
}

/// What becomes of a triangle without area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Degenerate {
    /// It draws nothing.
    #[default]
    Cull,
    /// It covers the pixels that its segment or point touches, with the values of vertex 0.
    Draw,
}

/// Where the depth of a pixel is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ConservativeDepth {
    /// At the centre of the pixel, which the triangle need not cover.
    #[default]
    Centre,
    /// At the corner of the pixel where the plane is least.
    Nearest,
}

/// Conservative rasterization.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ConservativeConfig {
    /// Which pixels are covered.
    pub mode: ConservativeMode,
    /// How far each side of a pixel's square is moved outward, in halves of a sub-pixel.
    #[serde(default)]
    pub grow: u32,
    /// What becomes of a triangle without area.
    #[serde(default)]
    pub degenerate: Degenerate,
    /// Where depth is evaluated.
    #[serde(default)]
    pub depth: ConservativeDepth,
}

/// Conservative rasterization that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConservativeError {
    /// More than a pixel.
    #[error(
        "grow = {grow}: grow counts halves of a sub-pixel and is at most one pixel, \
         grow <= 2^(sub-pixel + 1) = {}",
        2u64 << .sub_pixel
    )]
    Grow {
        /// What was asked for.
        grow: u32,
        /// Sub-pixel bits of the vertex field.
        sub_pixel: u32,
    },
    /// A grid without the middle of the square.
    #[error(
        "conservative coverage needs sub-pixel >= 1, but sub-pixel is 0: the middle of a pixel is not on the \
         grid of vertices; use a sub-pixel bit, or leave the table out"
    )]
    NoMiddle,
    /// A sample that is not the middle of the square.
    #[error(
        "conservative coverage is decided for the square of a pixel, whose middle is ({centre}, {centre}) \
         sub-pixels, but [sample] is ({x}, {y}); leave [sample] out"
    )]
    Sample {
        /// The sample's column in its pixel.
        x: i128,
        /// The sample's row in its pixel.
        y: i128,
        /// Where the middle is.
        centre: i128,
    },
    /// Several samples a pixel.
    #[error(
        "conservative coverage is one answer for a whole pixel, and [multisample] asks for one for each \
         sample; leave one of them out"
    )]
    Multisample,
    /// A segment has no inside.
    #[error(
        "degenerate = \"draw\" needs mode = \"outer\": no square lies in a triangle without area; write \
         degenerate = \"cull\""
    )]
    Degenerate,
}

impl ConservativeError {
    /// The key at fault in the table; `None` for the table itself.
    pub const fn key(self) -> Option<&'static str> {
        match self {
            Self::Grow { .. } => Some("grow"),
            Self::Degenerate => Some("degenerate"),
            Self::NoMiddle | Self::Sample { .. } | Self::Multisample => None,
        }
    }
}

impl ConservativeConfig {
    /// Checks the table for samples at this place of a pixel.
    ///
    /// # Errors
    /// [`ConservativeError`] names the violated inequality.
    pub fn validate(self, grid: &SampleGrid) -> Result<(), ConservativeError> {
        let SampleGrid { offset: [x, y], sub_pixel, .. } = *grid;
        if u64::from(self.grow) > 2 << sub_pixel {
            return Err(ConservativeError::Grow { grow: self.grow, sub_pixel });
        }
        if sub_pixel == 0 {
            return Err(ConservativeError::NoMiddle);
        }
        let centre = 1 << sub_pixel >> 1;
        if [x, y] != [centre; 2] {
            return Err(ConservativeError::Sample { x, y, centre });
        }
        if self.mode == ConservativeMode::Inner && self.degenerate == Degenerate::Draw {
            return Err(ConservativeError::Degenerate);
        }
        Ok(())
    }

    /// How far the square reaches from its middle on each axis, in halves of a sub-pixel: positive where it has
    /// to be met, negative where it has to be held.
    ///
    /// ```
    /// use guardbit::cover::{ConservativeConfig, ConservativeMode, Degenerate, ConservativeDepth};
    /// let config = |mode| ConservativeConfig {
    ///     mode, grow: 1, degenerate: Degenerate::Cull, depth: ConservativeDepth::Centre,
    /// };
    /// // Half a pixel of 2^8 sub-pixels is 256 halves of a sub-pixel.
    /// assert_eq!(config(ConservativeMode::Outer).reach(8), 257);
    /// assert_eq!(config(ConservativeMode::Inner).reach(8), -257);
    /// ```
    pub fn reach(self, sub_pixel: u32) -> i128 {
        let half_side = (1 << sub_pixel) + i128::from(self.grow);
        match self.mode {
            ConservativeMode::Outer => half_side,
            ConservativeMode::Inner => -half_side,
        }
    }
}
