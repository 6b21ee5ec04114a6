//! Several samples a pixel, at the standard positions or at those of a profile. Spec clauses `U-1` to `U-4`,
//! `FP-4` and `FP-5`.

use super::sample::{MOST_PARTS, SampleGrid};
use crate::bits::bounded;
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
    /// 2, 4, 8 or 16 samples at the standard positions; 1 to 16 at positions of one's own.
    pub samples: u32,
    /// Where depth is taken.
    pub depth: DepthAt,
    /// Positions of one's own, by sample number; the standard ones when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub positions: Option<Positions>,
    /// Parts on a side of a pixel that positions count; 16 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<u32>,
    /// Samples that may be drawn, sample 0 in the lowest bit; all when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mask: Option<u32>,
}

/// The most samples in a pixel.
const MOST: usize = 16;

/// Positions of samples in a pixel: a list of at most 16 places `[x, y]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[u32; 2]>", into = "Vec<[u32; 2]>")]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[cfg_attr(feature = "verification", schemars(with = "Vec<[u32; 2]>"))]
pub struct Positions {
    at: [[u8; 2]; MOST],
    count: u8,
}

impl Positions {
    /// The places, by sample number.
    pub fn list(&self) -> &[[u8; 2]] {
        &self.at[..usize::from(self.count)]
    }
}

impl TryFrom<Vec<[u32; 2]>> for Positions {
    type Error = String;

    fn try_from(list: Vec<[u32; 2]>) -> Result<Self, String> {
        if !(1..=MOST).contains(&list.len()) {
            return Err(format!("{} positions: a pixel has 1 to {MOST} samples", list.len()));
        }
        let mut at = [[0; 2]; MOST];
        for (sample, (place, given)) in at.iter_mut().zip(&list).enumerate() {
            for (part, given) in place.iter_mut().zip(given) {
                // A side has at most 256 parts.
                *part = u8::try_from(*given).map_err(|_| {
                    format!("positions[{sample}]: {given} <= 255 is needed: a pixel has at most {MOST_PARTS} parts on a side")
                })?;
            }
        }
        Ok(Self { at, count: bounded(list.len()) })
    }
}

impl From<Positions> for Vec<[u32; 2]> {
    fn from(positions: Positions) -> Self {
        positions.list().iter().map(|place| place.map(u32::from)).collect()
    }
}

/// Samples that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MultisampleError {
    /// No standard positions for so many.
    #[error(
        "samples = {0}: standard positions exist only for 2, 4, 8 and 16 samples; give `positions` for another count"
    )]
    Count(u32),
    /// Positions for another count.
    #[error("samples = {samples}, but `positions` has {got} places: give one for each sample")]
    Places {
        /// The count asked for.
        samples: u32,
        /// Places given.
        got: usize,
    },
    /// A sample outside its pixel.
    #[error(
        "positions[{sample}] = [{}, {}]: a sample must lie in its pixel, 0 <= position < of = {of}",
        at[0], at[1]
    )]
    Outside {
        /// The sample.
        sample: usize,
        /// Its place.
        at: [u32; 2],
        /// Parts on a side of a pixel.
        of: u32,
    },
    /// No parts, or too many.
    #[error("of = {0}: a pixel has 1 <= of <= {MOST_PARTS} parts on a side")]
    Parts(u32),
    /// Parts that nothing counts.
    #[error(
        "of = {0} says what `positions` count, and there are none; give `positions`, or leave `of` out"
    )]
    Unused(u32),
    /// A mask without samples, or of more.
    #[error("mask = {mask:#b}: 1 <= mask < 2^samples = {} is needed, a bit for each sample", 1u64 << samples)]
    Mask {
        /// The mask.
        mask: u32,
        /// Samples of a pixel.
        samples: u32,
    },
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

/// Parts on a side of a pixel that the standard positions count.
const STANDARD_PARTS: u32 = 16;

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

impl MultisampleError {
    /// The key at fault in the table; `None` for the table itself.
    pub const fn key(self) -> Option<&'static str> {
        match self {
            Self::Count(_) | Self::Places { .. } => Some("samples"),
            Self::Outside { .. } => Some("positions"),
            Self::Parts(_) | Self::Unused(_) => Some("of"),
            Self::Mask { .. } => Some("mask"),
            Self::Grid { .. } | Self::Both => None,
        }
    }
}

impl MultisampleConfig {
    /// So many samples at the standard positions.
    pub const fn standard(samples: u32, depth: DepthAt) -> Self {
        Self { samples, depth, positions: None, of: None, mask: None }
    }

    /// The standard positions of so many samples, in sixteenths of a pixel; `None` for another count.
    const fn standard_positions(&self) -> Option<&'static [[u8; 2]]> {
        match self.samples {
            2 => Some(&TWO),
            4 => Some(&FOUR),
            8 => Some(&EIGHT),
            16 => Some(&SIXTEEN),
            _ => None,
        }
    }

    /// The samples that may be drawn, sample 0 in the lowest bit.
    pub fn drawn(&self) -> u32 {
        self.mask.unwrap_or(u32::MAX)
    }

    /// Checks count, positions, mask and grid; `placed` says that the profile places a single sample, too.
    ///
    /// # Errors
    /// [`MultisampleError`] names the violated inequality.
    pub fn validate(&self, sub_pixel: u32, placed: bool) -> Result<(), MultisampleError> {
        let samples = self.samples;
        match (&self.positions, self.of) {
            (Some(positions), of) => {
                let (list, of) = (positions.list(), of.unwrap_or(STANDARD_PARTS));
                if !(1..=MOST_PARTS).contains(&of) {
                    return Err(MultisampleError::Parts(of));
                }
                if list.len() != samples as usize {
                    return Err(MultisampleError::Places { samples, got: list.len() });
                }
                let outside = |at: &[u8; 2]| at.iter().any(|place| u32::from(*place) >= of);
                if let Some(sample) = list.iter().position(outside) {
                    let at = list[sample].map(u32::from);
                    return Err(MultisampleError::Outside { sample, at, of });
                }
            }
            (None, Some(of)) => return Err(MultisampleError::Unused(of)),
            (None, None) if self.standard_positions().is_none() => {
                return Err(MultisampleError::Count(samples));
            }
            // Positions of one's own may lie between the sub-pixels.
            (None, None) if sub_pixel < 4 => return Err(MultisampleError::Grid { sub_pixel }),
            (None, None) => {}
        }
        if let Some(mask) = self.mask
            && (mask == 0 || u64::from(mask) >= 1 << samples)
        {
            return Err(MultisampleError::Mask { mask, samples });
        }
        if placed { Err(MultisampleError::Both) } else { Ok(()) }
    }

    /// The grid of each sample, by number; none for a count without positions.
    pub fn grids(&self, sub_pixel: u32) -> Vec<SampleGrid> {
        let at = |place: [u32; 2], of| SampleGrid::among(place, of, sub_pixel);
        if let Some(positions) = &self.positions {
            let of = self.of.unwrap_or(STANDARD_PARTS);
            return positions.list().iter().map(|place| at(place.map(u32::from), of)).collect();
        }
        let positions = self.standard_positions().unwrap_or_default().iter();
        positions.map(|place| at(place.map(u32::from), STANDARD_PARTS)).collect()
    }
}
