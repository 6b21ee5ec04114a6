//! Where a pixel is sampled. Spec clause `C-1`.

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sample position in its pixel, in sub-pixels from the pixel's top left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SampleConfig {
    /// Rightward, in sub-pixels.
    pub x: u32,
    /// Downward, in sub-pixels.
    pub y: u32,
}

/// A sample position that is not on the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SampleError {
    /// Without sub-pixel bits the centre is off the lattice.
    #[error(
        "sub-pixel = 0: a vertex grid without sub-pixels has no pixel centres; place the sample with [sample] x = 0, y = 0"
    )]
    NoCentre,
    /// Outside the pixel.
    #[error("{axis} = {value}: a sample must lie in its pixel, 0 <= {axis} < 2^{sub_pixel} = {}", 1u64 << sub_pixel)]
    Outside {
        /// `x` or `y`.
        axis: char,
        /// The offset asked for.
        value: u32,
        /// Sub-pixel bits of the vertex field.
        sub_pixel: u32,
    },
}

/// The grid of samples: one a pixel, at the same offset in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleGrid {
    /// Offset in the pixel, in sub-pixels.
    pub offset: [i128; 2],
    /// Sub-pixel bits: a pixel is `2^sub_pixel` sub-pixels.
    pub sub_pixel: u32,
}

impl SampleGrid {
    /// The grid of a profile; without a configuration samples lie at pixel centres.
    ///
    /// # Errors
    /// [`SampleError`] if the position is not on the sub-pixel grid inside the pixel.
    pub fn new(config: Option<SampleConfig>, sub_pixel: u32) -> Result<Self, SampleError> {
        let Some(SampleConfig { x, y }) = config else {
            if sub_pixel == 0 {
                return Err(SampleError::NoCentre);
            }
            return Ok(Self { offset: [1 << (sub_pixel - 1); 2], sub_pixel });
        };
        for (axis, value) in [('x', x), ('y', y)] {
            if u64::from(value) >= 1 << sub_pixel {
                return Err(SampleError::Outside { axis, value, sub_pixel });
            }
        }
        Ok(Self { offset: [i128::from(x), i128::from(y)], sub_pixel })
    }

    /// The pixels whose sample lies in the closed interval `[low, high]` of sub-pixels on an axis.
    pub fn pixels(&self, axis: usize, (low, high): (i128, i128)) -> (i128, i128) {
        let offset = self.offset[axis];
        let first = -((offset - low) >> self.sub_pixel);
        (first, ((high - offset) >> self.sub_pixel) + 1)
    }

    /// The sample of pixel (x, y), in sub-pixels.
    pub fn position(&self, x: i128, y: i128) -> [i128; 2] {
        [(x << self.sub_pixel) + self.offset[0], (y << self.sub_pixel) + self.offset[1]]
    }
}
