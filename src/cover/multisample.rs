//! Several samples a pixel, at the standard positions. Spec clauses `U-1` to `U-4`.

use super::sample::SampleGrid;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where depth is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DepthAt {
    /// Once a pixel, at its centre, covered or not: outside the triangle the plane goes on.
    Centre,
    /// At every covered sample.
    Sample,
}

/// Samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct MultisampleConfig {
    /// 2, 4, 8 or 16 samples at the standard positions.
    pub samples: u32,
    /// Where depth is taken.
    pub depth: DepthAt,
}

/// Samples that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MultisampleError {
    /// No standard positions for so many.
    #[error("samples = {0}: standard positions exist only for 2, 4, 8 and 16 samples")]
    Count(u32),
    /// The positions are off the sub-pixel grid.
    #[error(
        "sub-pixel = {sub_pixel} < 4: the standard positions are multiples of 1/16 pixel; give the \
         vertex field 4 sub-pixel bits or more"
    )]
    Grid {
        /// Sub-pixel bits of the vertex field.
        sub_pixel: u32,
    },
    /// A single sample is placed as well.
    #[error(
        "[sample] places one sample in a pixel and [multisample] places several: remove one of the two tables"
    )]
    Both,
}

/// The standard positions of Direct3D and Vulkan, in sixteenths of a pixel from its upper left
/// corner, by sample number.
const TWO: [[u8; 2]; 2] = [[12, 12], [4, 4]];
const FOUR: [[u8; 2]; 4] = [[6, 2], [14, 6], [2, 10], [10, 14]];
const EIGHT: [[u8; 2]; 8] = [[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]];
const SIXTEEN: [[u8; 2]; 16] = [
    [9, 9],
    [7, 5],
    [5, 10],
    [12, 7],
    [3, 6],
    [10, 13],
    [13, 11],
    [11, 3],
    [6, 14],
    [8, 1],
    [4, 2],
    [2, 12],
    [0, 8],
    [15, 4],
    [14, 15],
    [1, 0],
];

impl MultisampleConfig {
    /// Positions in sixteenths of a pixel; `None` for another count.
    pub const fn positions(&self) -> Option<&'static [[u8; 2]]> {
        match self.samples {
            2 => Some(&TWO),
            4 => Some(&FOUR),
            8 => Some(&EIGHT),
            16 => Some(&SIXTEEN),
            _ => None,
        }
    }

    /// The centroid of the samples of a mask: the sum of their positions in sixteenths of a pixel, and
    /// how many they are. A triangle that covers them all has it inside, as it is convex.
    pub fn centroid(&self, mask: u32) -> ([u32; 2], u32) {
        let positions = self.positions().unwrap_or_default().iter().enumerate();
        let covered = positions.filter(|(n, _)| mask >> n & 1 == 1);
        covered.fold(([0; 2], 0), |([x, y], count), (_, at)| {
            ([x + u32::from(at[0]), y + u32::from(at[1])], count + 1)
        })
    }

    /// Checks count and grid; `placed` says that the profile places a single sample, too.
    ///
    /// # Errors
    /// [`MultisampleError`] names the violated inequality.
    pub fn validate(&self, sub_pixel: u32, placed: bool) -> Result<(), MultisampleError> {
        if self.positions().is_none() {
            return Err(MultisampleError::Count(self.samples));
        }
        if sub_pixel < 4 {
            return Err(MultisampleError::Grid { sub_pixel });
        }
        if placed { Err(MultisampleError::Both) } else { Ok(()) }
    }

    /// The grid of each sample, by number; none for another count, or off the sub-pixel grid.
    pub fn grids(&self, sub_pixel: u32) -> Vec<SampleGrid> {
        let unit = sub_pixel.checked_sub(4).map_or(0, |up| 1i128 << up);
        let positions = self.positions().unwrap_or_default();
        positions
            .iter()
            .map(|at| SampleGrid { offset: at.map(|part| i128::from(part) * unit), sub_pixel })
            .collect()
    }
}
