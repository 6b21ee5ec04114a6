//! Depth bias, or polygon offset: state of a draw call, which a profile states for all that it draws. Spec
//! clause `Z-7`.

use super::depth_format::{DepthFormat, Part};
use super::{DepthConfig, DepthError};
use crate::bits::Rounding;
use crate::format::Unreduced;
use crate::setup::{Plane, VertexConfig};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Bits of the bias that exact 128-bit arithmetic leaves room for.
const MOST: u32 = 120;

/// What is added to every depth of a triangle: `constant unit r + slope max(|dz/dx|, |dz/dy|)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct DepthBias {
    /// A number of units; positive is farther, in every format.
    pub constant: i64,
    /// A unit in r, the step of the stored format: 1 in Direct3D; 1 or 2 in Vulkan, whose smallest
    /// resolvable difference is at most 2 codes of a fixed-point buffer.
    pub unit: u32,
    /// A multiple of the larger slope a pixel, in 1/256.
    pub slope: i64,
    /// The bias is no larger than this many depth ULP, those of a vertex's z, if it is positive, no smaller
    /// if it is negative; 0 is no limit.
    pub clamp: i64,
}

impl Default for DepthBias {
    fn default() -> Self {
        Self { constant: 0, unit: 1, slope: 0, clamp: 0 }
    }
}

/// A bias that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DepthBiasError {
    /// No unit.
    #[error(
        "bias unit = 0: unit >= 1 is needed; write 1 (the default), or 2 where the hardware counts in two codes"
    )]
    Unit,
    /// A constant beyond the whole depth range.
    #[error(
        "bias |constant| * unit = {constant} * {unit} = {product} >= 2^{bits}: depth has {bits} bits of \
         precision, so every sample would leave its range; use a smaller constant or unit"
    )]
    Constant {
        /// Its magnitude.
        constant: u64,
        /// The unit.
        unit: u32,
        /// Their product.
        product: u128,
        /// Bits of the code, or of a float's fraction with its hidden bit.
        bits: u32,
    },
    /// A limit beyond it.
    #[error(
        "bias |clamp| = {clamp} >= 2^integer = 2^{integer}: such a limit is none; use a smaller clamp, or 0 \
         for no limit"
    )]
    Clamp {
        /// Its magnitude.
        clamp: u64,
        /// Depth bits.
        integer: u32,
    },
    /// A slope term beyond exact arithmetic.
    #[error(
        "bias slope bits + integer + vertex difference bits + sub-pixel + interpolation + 1 = {slope} + \
         {integer} + {difference} + {sub_pixel} + {interpolation} + 1 > {most}: the slope term does not fit \
         exact 128-bit arithmetic; use fewer bits in one of these fields",
        most = MOST
    )]
    Growth {
        /// Bits of the multiple's magnitude.
        slope: u32,
        /// Depth bits.
        integer: u32,
        /// Bits of a vertex difference.
        difference: u32,
        /// Sub-pixel bits.
        sub_pixel: u32,
        /// Interpolation bits.
        interpolation: u32,
    },
}

impl DepthBiasError {
    /// The key at fault.
    pub const fn field(&self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::Constant { .. } => "constant",
            Self::Clamp { .. } => "clamp",
            Self::Growth { .. } => "slope",
        }
    }
}

impl DepthBias {
    /// Checks the bias of a depth plane.
    ///
    /// # Errors
    /// [`DepthBiasError`] names the violated inequality.
    pub fn validate(
        &self,
        depth: &DepthConfig,
        vertex: &VertexConfig,
    ) -> Result<(), DepthBiasError> {
        let DepthConfig { integer, interpolation, format, .. } = *depth;
        if self.unit == 0 {
            return Err(DepthBiasError::Unit);
        }
        let (constant, unit) = (self.constant.unsigned_abs(), self.unit);
        let product = u128::from(constant) * u128::from(unit);
        let bits = format.map_or(integer, |format| format.precision());
        if product >> bits > 0 {
            return Err(DepthBiasError::Constant { constant, unit, product, bits });
        }
        let clamp = self.clamp.unsigned_abs();
        if u128::from(clamp) >> integer > 0 {
            return Err(DepthBiasError::Clamp { clamp, integer });
        }
        let (slope, difference) = (self.slope_bits(), vertex.difference_bits());
        let sub_pixel = vertex.sub_pixel;
        if slope > 0 && slope + integer + difference + sub_pixel + interpolation + 1 > MOST {
            let growth =
                DepthBiasError::Growth { slope, integer, difference, sub_pixel, interpolation };
            return Err(growth);
        }
        Ok(())
    }

    /// Bits of the slope's magnitude.
    pub const fn slope_bits(&self) -> u32 {
        u64::BITS - self.slope.unsigned_abs().leading_zeros()
    }

    /// The bias of a plane whose r is `r` of its units, each term rounded once; to be added to the start.
    ///
    /// Growth: the slope's bits plus those of the multiple.
    pub fn of(&self, plane: &Plane, (r, over): Part, rounding: Rounding) -> Unreduced {
        let ([_, dx, dy], fraction) = (plane.raw(), plane.start().fraction());
        let steepest = dx.abs().max(dy.abs());
        let (sloped, _) = rounding.shift_right(i128::from(self.slope) * steepest, 8);
        let constant = i128::from(self.constant) * i128::from(self.unit);
        let constant = rounding.divide(constant * r, over).map_or(0, |(quotient, _)| quotient);
        let (bias, limit) = (constant + sloped, i128::from(self.clamp) << fraction);
        let held = match self.clamp.signum() {
            1 => bias.min(limit),
            -1 => bias.max(limit),
            _ => bias,
        };
        Unreduced::new(held, fraction)
    }
}

impl From<DepthBiasError> for DepthError {
    fn from(error: DepthBiasError) -> Self {
        Self::Bias(error)
    }
}

impl DepthFormat {
    /// Bits that tell codes of one size apart: all of an integer, the fraction of a float with its hidden bit.
    pub(super) const fn precision(&self) -> u32 {
        match self.float() {
            None => self.bits(),
            Some((_, mantissa)) => mantissa + 1,
        }
    }

    /// One step of the code of a quantity in [0, 1]: that of an integer, 1 / (2^d - 1), or a float's last
    /// fraction bit.
    pub fn step(&self, quantity: Part) -> Part {
        match self.float() {
            None => (1, i128::from(self.maximum())),
            Some((exponent, mantissa)) => {
                let field = self.exponent_of(quantity).max(1);
                (1, 1 << (mantissa + (1 << exponent) - field))
            }
        }
    }
}

impl DepthConfig {
    /// r of a triangle with these vertex depths, in units of the accumulator. Spec clause `Z-7`.
    pub fn resolvable(&self, z: [i128; 3]) -> Part {
        let Some(format) = self.format else { return (1 << self.interpolation, 1) };
        let whole = (1i128 << self.integer) - 1;
        // Every format is monotone in Z/w.
        let [a, b, c] = z;
        let end = if format.is_reversed() { a.min(b).min(c) } else { a.max(b).max(c) };
        let (step, over) = format.step(format.part((end, whole)));
        (step * (whole << self.interpolation), over)
    }

    /// Whether a code can lie far from the integer part of Z/w: it is stored in a format, or biased.
    pub const fn moves_codes(&self) -> bool {
        self.format.is_some() || self.bias.is_some()
    }

    /// Whether r depends on the triangle.
    pub const fn is_float(&self) -> bool {
        match &self.format {
            Some(format) => format.float().is_some(),
            None => false,
        }
    }
}
