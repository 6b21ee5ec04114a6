//! Where a pixel is sampled. Spec clauses `C-1` and `FP-1`.

use crate::bits::Rounding;
use crate::setup::{Division, Gradient, Plane};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sample position in its pixel, from the pixel's top left corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SampleConfig {
    /// Rightward, in parts of a pixel.
    pub x: u32,
    /// Downward, in parts of a pixel.
    pub y: u32,
    /// Parts on a side of a pixel; the sub-pixels when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<u32>,
}

impl SampleConfig {
    /// A place in sub-pixels.
    pub const fn sub_pixels(x: u32, y: u32) -> Self {
        Self { x, y, of: None }
    }
}

/// The most parts on a side of a pixel.
pub(super) const MOST_PARTS: u32 = 256;

/// A sample position that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SampleError {
    /// Without sub-pixel bits the centre is off the lattice.
    #[error(
        "sub-pixel = 0: a vertex grid without sub-pixels has no pixel centres; place the sample with [sample] x = 0, y = 0"
    )]
    NoCentre,
    /// Outside the pixel.
    #[error("{axis} = {value}: a sample must lie in its pixel, 0 <= {axis} < {}{parts}", match of { Some(_) => "of = ".to_owned(), None => format!("2^{} = ", parts.ilog2()) })]
    Outside {
        /// `x` or `y`.
        axis: char,
        /// The offset asked for.
        value: u32,
        /// Parts on a side of a pixel.
        parts: u64,
        /// What the profile says of them.
        of: Option<u32>,
    },
    /// No parts, or too many.
    #[error("of = {0}: a pixel has 1 <= of <= {MOST_PARTS} parts on a side")]
    Parts(u32),
}

impl SampleError {
    /// The key at fault; `None` for the table itself.
    pub const fn key(self) -> Option<&'static str> {
        match self {
            Self::NoCentre => None,
            Self::Outside { axis: 'x', .. } => Some("x"),
            Self::Outside { .. } => Some("y"),
            Self::Parts(_) => Some("of"),
        }
    }
}

/// The grid of samples: one a pixel, at the same place in each.
///
/// A sample that lies between the sub-pixels has a remainder: its place is `offset + part / parts` sub-pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleGrid {
    /// Place in the pixel, in whole sub-pixels.
    pub offset: [i128; 2],
    /// Sub-pixel bits: a pixel is `2^sub_pixel` sub-pixels.
    pub sub_pixel: u32,
    /// What remains of the place, in parts of a sub-pixel: `0 <= part < parts`.
    pub part: [i128; 2],
    /// Parts of a sub-pixel; 1 for a sample on the sub-pixel grid.
    pub parts: i128,
}

impl SampleGrid {
    /// Samples on the sub-pixel grid, at this offset in each pixel.
    #[inline]
    pub const fn at(offset: [i128; 2], sub_pixel: u32) -> Self {
        Self { offset, sub_pixel, part: [0; 2], parts: 1 }
    }

    /// Samples at `place / of` of a pixel. Spec clause `FP-1`.
    ///
    /// ```
    /// use guardbit::cover::SampleGrid;
    /// // 7/12 of a pixel of 16 sub-pixels is 9 + 1/3 sub-pixels.
    /// let grid = SampleGrid::among([7, 6], 12, 4);
    /// assert_eq!((grid.offset, grid.part, grid.parts), ([9, 8], [1, 0], 3));
    /// assert_eq!(SampleGrid::among([6, 6], 12, 4), SampleGrid::at([8, 8], 4));
    /// ```
    pub fn among(place: [u32; 2], of: u32, sub_pixel: u32) -> Self {
        let scaled = place.map(|place| i128::from(place) << sub_pixel);
        let of = i128::from(of.max(1));
        let common = scaled.iter().fold(of, |common, value| gcd(common, value.rem_euclid(of)));
        Self {
            offset: scaled.map(|value| value.div_euclid(of)),
            sub_pixel,
            part: scaled.map(|value| value.rem_euclid(of) / common),
            parts: of / common,
        }
    }

    /// The grid of a profile; without a configuration samples lie at pixel centres.
    ///
    /// # Errors
    /// [`SampleError`] if the position is not inside the pixel.
    pub fn new(config: Option<SampleConfig>, sub_pixel: u32) -> Result<Self, SampleError> {
        let Some(SampleConfig { x, y, of }) = config else {
            if sub_pixel == 0 {
                return Err(SampleError::NoCentre);
            }
            return Ok(Self::at([1 << (sub_pixel - 1); 2], sub_pixel));
        };
        if let Some(of) = of.filter(|of| !(1..=MOST_PARTS).contains(of)) {
            return Err(SampleError::Parts(of));
        }
        let parts = of.map_or(1 << sub_pixel, u64::from);
        for (axis, value) in [('x', x), ('y', y)] {
            if u64::from(value) >= parts {
                return Err(SampleError::Outside { axis, value, parts, of });
            }
        }
        Ok(match of {
            None => Self::at([i128::from(x), i128::from(y)], sub_pixel),
            Some(of) => Self::among([x, y], of, sub_pixel),
        })
    }

    /// Parts of a sub-pixel that count the places of several grids in whole numbers.
    pub fn common_parts(grids: &[Self]) -> i128 {
        grids.iter().fold(1, |all, grid| all / gcd(all, grid.parts) * grid.parts)
    }

    /// Whether samples lie on the sub-pixel grid.
    #[inline]
    pub const fn is_on_the_grid(&self) -> bool {
        self.parts == 1
    }

    /// The pixels whose sample lies in the closed interval `[low, high]` of sub-pixels on an axis.
    pub fn pixels(&self, axis: usize, (low, high): (i128, i128)) -> (i128, i128) {
        // A remainder reaches beyond no sub-pixel above, and takes a sample at `high` out below.
        let (offset, high) = (self.offset[axis], high - i128::from(self.part[axis] > 0));
        let first = -((offset - low) >> self.sub_pixel);
        (first, ((high - offset) >> self.sub_pixel) + 1)
    }

    /// The sample of pixel (x, y), in sub-pixels; a remainder is left out.
    pub fn position(&self, x: i128, y: i128) -> [i128; 2] {
        [(x << self.sub_pixel) + self.offset[0], (y << self.sub_pixel) + self.offset[1]]
    }

    /// The rounded plane of a gradient: its value at the sample of pixel (0, 0), and its slopes. Between the
    /// sub-pixels it is the plane of the same numerators in parts of a sub-pixel. Spec clauses `P-2` and `FP-3`.
    pub fn plane(
        &self,
        gradient: &Gradient,
        fraction: u32,
        rounding: Rounding,
        division: Division,
    ) -> Plane {
        if self.is_on_the_grid() {
            return Plane::round(
                gradient,
                self.offset,
                self.sub_pixel,
                fraction,
                rounding,
                division,
            );
        }
        let (numerators, whole) = self.numerators(gradient);
        Plane::over(numerators, whole, self.sub_pixel, fraction, rounding, division)
    }

    /// The value at the sample of pixel (0, 0) and the slopes per sub-pixel, over the number that follows.
    pub fn numerators(&self, gradient: &Gradient) -> ([i128; 3], i128) {
        let Gradient { x, y, area2, .. } = *gradient;
        let beyond = x * self.part[0] + y * self.part[1];
        let start = gradient.numerator(self.offset) * self.parts + beyond;
        ([start, x * self.parts, y * self.parts], area2 * self.parts)
    }

    /// The sample of pixel (x, y), exact, in parts of a sub-pixel.
    pub fn position_in_parts(&self, x: i128, y: i128) -> [i128; 2] {
        let [x, y] = self.position(x, y);
        [x * self.parts + self.part[0], y * self.parts + self.part[1]]
    }
}

const fn gcd(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
