//! The Z/w depth plane: guard, integer and interpolation bits, a start and two slopes.

use super::depth_bias::{DepthBias, DepthBiasError};
use super::depth_format::{DepthFormat, DepthFormatError};
use crate::bits::{Place, Rounding, SpanEvents, bounded};
use crate::cover::SampleGrid;
use crate::dda::{Line, Processor, Walker, row_values};
use crate::format::{Clamp, Decode, ReadOut, ReadOutError, Unreduced};
use crate::setup::{Division, DivisionError, Gradient, Plane, Triangle, VertexConfig};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is added to the start of the plane, so that the floor of the read-out rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StartBias {
    /// Nothing: the read-out truncates.
    #[default]
    None,
    /// One half of a result unit: the read-out rounds to nearest.
    Half,
}

/// A depth plane budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct DepthConfig {
    /// Guard bits above the integer bits.
    pub guard: u32,
    /// Depth bits.
    pub integer: u32,
    /// Interpolation bits below them.
    pub interpolation: u32,
    /// Rounding of the start and of each slope.
    pub rounding: Rounding,
    /// How slopes are divided.
    pub division: Division,
    /// What the read-out does outside the depth range.
    pub clamp: Clamp,
    /// What the start gains.
    #[serde(default)]
    pub start_bias: StartBias,
    /// What is stored in place of the integer part of Z/w, converted after interpolation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<DepthFormat>,
    /// What a draw call adds to depth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bias: Option<DepthBias>,
}

/// A depth plane that cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DepthError {
    /// The read-out is malformed.
    #[error(transparent)]
    ReadOut(#[from] ReadOutError),
    /// The division is malformed.
    #[error(transparent)]
    Division(#[from] DivisionError),
    /// The stored format is malformed.
    #[error(transparent)]
    Format(#[from] DepthFormatError),
    /// The depth bias is malformed.
    #[error(transparent)]
    Bias(DepthBiasError),
    /// The exact numerators outgrow 128-bit arithmetic (clause `P-5`).
    #[error(
        "integer + 2 * vertex difference bits + 4 + interpolation + reciprocal bits = \
         {integer} + 2 * {difference} + 4 + {interpolation} + {reciprocal} = {sum} > 126: \
         set-up does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
    )]
    Growth {
        /// Depth bits.
        integer: u32,
        /// Bits of a vertex difference.
        difference: u32,
        /// Interpolation bits.
        interpolation: u32,
        /// Bits of the reciprocal, or 0.
        reciprocal: u32,
        /// Their sum.
        sum: u32,
    },
}

impl DepthConfig {
    /// Checks the budget and its growth, and returns the accumulator's format.
    ///
    /// # Errors
    /// [`DepthError`] names the violated inequality.
    pub fn validate(&self, vertex: &VertexConfig) -> Result<ReadOut, DepthError> {
        let Self { guard, integer, interpolation, clamp, division, .. } = *self;
        let read = ReadOut::new(guard, integer, interpolation, clamp)?;
        division.validate()?;
        if let Some(format) = self.format {
            format.validate(integer, interpolation)?;
        }
        let (difference, reciprocal) = (vertex.difference_bits(), division.growth());
        let sum = integer + 2 * difference + 4 + interpolation + reciprocal;
        if sum > 126 {
            return Err(DepthError::Growth { integer, difference, interpolation, reciprocal, sum });
        }
        if let Some(bias) = self.bias {
            bias.validate(self, vertex)?;
        }
        Ok(read)
    }

    /// What the start gains, in accumulator units.
    pub const fn start_gain(&self) -> i128 {
        match (self.start_bias, self.interpolation) {
            (StartBias::Half, 1..) => 1 << (self.interpolation - 1),
            _ => 0,
        }
    }
}

/// A depth evaluator, prepared for a lane.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    config: DepthConfig,
    read: ReadOut,
    narrow: Option<Decode<i64>>,
    wide: Option<Decode<i128>>,
    processor: Processor,
    /// Whether a pixel's depth is that of its nearest corner.
    nearest: bool,
}

impl Depth {
    /// Prepares the evaluator of a profile.
    ///
    /// # Errors
    /// [`DepthError`] names the violated inequality.
    pub fn new(
        config: DepthConfig,
        vertex: &VertexConfig,
        processor: Processor,
    ) -> Result<Self, DepthError> {
        let read = config.validate(vertex)?;
        Ok(Self {
            config,
            read,
            narrow: read.decode(),
            wide: read.decode(),
            processor,
            nearest: false,
        })
    }

    /// The same at the corner of each pixel where the plane is least. Spec clause `CR-6`.
    #[must_use]
    pub fn at_nearest_corner(self) -> Self {
        Self { nearest: true, ..self }
    }

    /// The place in a pixel at which a plane is evaluated.
    #[inline]
    pub(crate) fn place(&self, gradient: &Gradient, grid: &SampleGrid) -> SampleGrid {
        if !self.nearest {
            return *grid;
        }
        // From the middle of the pixel to the side that the plane falls towards.
        let half_side = 1i128 << grid.sub_pixel >> 1;
        let [x, y] = grid.offset;
        let corner = [x - gradient.x.signum() * half_side, y - gradient.y.signum() * half_side];
        SampleGrid::at(corner, grid.sub_pixel)
    }

    /// The accumulator's format.
    pub fn read_out(&self) -> ReadOut {
        self.read
    }

    /// The rounded plane of a normalised triangle, unreduced.
    #[inline]
    pub fn plane(&self, triangle: &Triangle, z: [i128; 3], grid: &SampleGrid) -> Plane {
        let DepthConfig { rounding, division, interpolation, .. } = self.config;
        let gradient = Gradient::new(triangle, z);
        let grid = self.place(&gradient, grid);
        self.biased(grid.plane(&gradient, interpolation, rounding, division), z)
    }

    /// The rounded plane of a value given by its numerators at pixel (0, 0) and its slopes per
    /// sub-pixel, over `whole > 0`: for homogeneous set-up, unreduced. No vertex need have a depth, so a bias
    /// in the steps of a float is refused before.
    pub fn plane_over(&self, numerators: [i128; 3], whole: i128, grid: &SampleGrid) -> Plane {
        let DepthConfig { rounding, division, interpolation, .. } = self.config;
        let plane =
            Plane::over(numerators, whole, grid.sub_pixel, interpolation, rounding, division);
        self.biased(plane, [0; 3])
    }

    #[inline]
    fn biased(&self, plane: Plane, z: [i128; 3]) -> Plane {
        let bias = Unreduced::new(self.gained(&plane, z), self.config.interpolation);
        plane.raised(bias).unwrap_or_else(|error| unreachable!("a plane of this budget: {error}"))
    }

    /// What the start of a rounded plane gains: start bias and depth bias.
    #[inline]
    fn gained(&self, plane: &Plane, z: [i128; 3]) -> i128 {
        let DepthConfig { bias, rounding, .. } = &self.config;
        let bias =
            bias.map_or(0, |bias| bias.of(plane, self.config.resolvable(z), *rounding).raw());
        self.start_bias() + bias
    }

    /// What a normalised triangle's depth gains, in accumulator units: the start bias, and the depth bias of
    /// its plane.
    pub fn gain(&self, triangle: &Triangle, z: [i128; 3], grid: &SampleGrid) -> i128 {
        if self.config.bias.is_none() {
            return self.start_bias();
        }
        let DepthConfig { rounding, division, interpolation, .. } = self.config;
        let gradient = Gradient::new(triangle, z);
        self.gained(&grid.plane(&gradient, interpolation, rounding, division), z)
    }

    /// The same without a depth bias: what evaluates a value that is no depth.
    #[must_use]
    pub fn unbiased(&self) -> Self {
        Self { config: DepthConfig { bias: None, ..self.config }, nearest: false, ..*self }
    }

    /// The configuration.
    pub fn config(&self) -> &DepthConfig {
        &self.config
    }

    /// What the start gains by `start-bias`, in accumulator units.
    pub fn start_bias(&self) -> i128 {
        self.config.start_gain()
    }

    /// The code that is stored for a held accumulator.
    #[inline]
    pub fn code(&self, held: i128) -> u64 {
        match self.config.format {
            None => bounded(held >> self.read.fraction()),
            Some(format) => {
                let (integer, interpolation) = (self.config.integer, self.config.interpolation);
                // Nearest for what is made anew; the accumulator's own fraction is in it.
                format.convert(held, integer, interpolation, Rounding::NearestEven)
            }
        }
    }

    /// Bits of a stored code.
    pub fn code_bits(&self) -> u32 {
        self.config.format.map_or(self.config.integer, |format| format.bits())
    }

    /// Whether a larger code is nearer.
    pub fn is_reversed(&self) -> bool {
        self.config.format.is_some_and(|format| format.is_reversed())
    }

    /// Reads the run of `out.len()` samples from pixel (x, y) rightward.
    #[inline]
    pub fn span(&self, plane: &Plane, y: u32, x: u32, out: &mut [u64]) {
        if self.config.format.is_some() {
            for (slot, x) in out.iter_mut().zip(x..) {
                *slot = self.code(self.held(plane, x, y));
            }
            return;
        }
        let start = plane.at(i128::from(x), i128::from(y)).raw();
        let dx = plane.dx().raw();
        match (self.narrow, self.wide) {
            (Some(decode), _) => {
                row_values(self.processor, decode, decode.load(start), decode.slope(dx), out);
            }
            (None, Some(decode)) => {
                row_values(self.processor, decode, decode.load(start), decode.slope(dx), out);
            }
            (None, None) => self.sticky_span(plane, y, x, out),
        }
    }

    /// A sticky accumulator has a path: down column 0 from the window's corner, then right.
    fn sticky_span(&self, plane: &Plane, y: u32, x: u32, out: &mut [u64]) {
        for (slot, x) in out.iter_mut().zip(x..) {
            *slot = self.read.read(self.held(plane, x, y));
        }
    }

    /// The accumulator at pixel (x, y) as the read-out sees it before the fraction is dropped:
    /// wrapped, clamped, and for a sticky one by its path. In `[0, 2^(i+F))`.
    #[inline]
    pub fn held(&self, plane: &Plane, x: u32, y: u32) -> i128 {
        let (x, y) = (i128::from(x), i128::from(y));
        if self.read.clamp() == Clamp::Saturate {
            let [start, dx, dy] = plane.raw();
            return Walker::new(self.read, start, dx, dy).path(x, y);
        }
        self.read.reduce(plane.at(x, y).raw()).clamp(0, self.read.top() - 1)
    }

    /// The accumulator at pixel (x, y) before any read-out: unwrapped, and for a sticky one what its
    /// path leaves.
    pub fn accumulator(&self, plane: &Plane, x: u32, y: u32) -> i128 {
        if self.read.clamp() == Clamp::Saturate {
            self.held(plane, x, y)
        } else {
            plane.at(i128::from(x), i128::from(y)).raw()
        }
    }

    /// The events of the run of `count` samples from pixel (x, y) rightward, in closed form.
    pub fn events(&self, plane: &Plane, y: u32, x: u32, count: u32) -> SpanEvents {
        let start = plane.at(i128::from(x), i128::from(y)).raw();
        let line = Line { start, slope: plane.dx().raw(), count: u64::from(count) };
        line.events(self.read, Place { y: i64::from(y), x: i64::from(x) })
    }
}
