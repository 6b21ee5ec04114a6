//! Vertices: the field they must lie in, and how real numbers reach the sub-pixel grid.
//! Spec clauses `S-1` to `S-4`. The one file of the model where floating point is read.

use crate::bits::Rounding;
use crate::format::Fixed;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The floating-point type a vertex arrives in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Source {
    /// IEEE binary32: numbers are rounded to it, nearest even, before snapping.
    F32,
    /// IEEE binary64.
    F64,
}

/// What a real number without a place on any grid becomes: an infinity, a number beyond 2^126
/// sub-pixels, a NaN. A finite number outside the field is refused whatever is chosen here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Endless {
    /// The triangle is refused; so is one with a NaN.
    Refuse,
    /// The nearer end of the vertex field; a NaN becomes zero.
    Clamp,
}

/// The vertex field of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct VertexConfig {
    /// Integer bits of x and y, the sign included when signed.
    pub integer: u32,
    /// Sub-pixel bits of x and y.
    pub sub_pixel: u32,
    /// Whether x and y are two's complement.
    pub signed: bool,
    /// Whether the upper end of the field, 2^integer pixels, is itself a vertex position.
    pub closed: bool,
    /// How real coordinates are rounded to the sub-pixel grid.
    pub snap: Rounding,
    /// The type real coordinates arrive in.
    pub source: Source,
    /// Infinities and NaN.
    pub endless: Endless,
    /// Sub-pixel bits of integer coordinates, where they come on a finer lattice and are snapped as
    /// well.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lattice: Option<u32>,
}

/// A vertex or a vertex field that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VertexError {
    /// The field itself is malformed.
    #[error("integer + sub-pixel = {integer} + {sub_pixel} = {}: a vertex field has 1 to 32 bits", u64::from(*integer) + u64::from(*sub_pixel))]
    Field {
        /// Integer bits.
        integer: u32,
        /// Sub-pixel bits.
        sub_pixel: u32,
    },
    /// A signed field needs a sign bit.
    #[error(
        "integer = 0: a signed vertex field needs 1 <= integer, because the sign takes one integer bit"
    )]
    NoSign,
    /// A lattice that is no finer.
    #[error(
        "lattice = {lattice}: sub-pixel = {sub_pixel} < lattice <= 24 is needed, or no lattice"
    )]
    Lattice {
        /// Sub-pixel bits of integer coordinates.
        lattice: u32,
        /// Sub-pixel bits of the field.
        sub_pixel: u32,
    },
    /// A coordinate lies outside the field.
    #[error(
        "{coordinate} = {value} is outside the {}: {low} <= {} <= {high}",
        coordinate.range_name(), coordinate.axis_name()
    )]
    Outside {
        /// Which coordinate.
        coordinate: Coordinate,
        /// The offending value in sub-pixels or depth codes; of a real number, the snapped one.
        value: i128,
        /// Lowest allowed.
        low: i128,
        /// Highest allowed.
        high: i128,
    },
    /// A real coordinate has no place on any lattice.
    #[error("{coordinate} is {what}, but this profile refuses such coordinates")]
    NotFinite {
        /// Which coordinate.
        coordinate: Coordinate,
        /// `NaN`, `infinite` or `too large for any word`.
        what: &'static str,
    },
}

/// A coordinate of a primitive, by the key and the indices that `eval` gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Coordinate {
    /// `v`, `f`, `line`, `point` or `polygon`.
    pub key: &'static str,
    /// Which vertex, from 0; a point has none.
    pub vertex: Option<usize>,
    /// 0 for x, 1 for y, 2 for z.
    pub axis: usize,
}

impl Coordinate {
    const fn axis_name(&self) -> &'static str {
        match self.axis {
            0 => "x",
            1 => "y",
            _ => "z",
        }
    }

    const fn range_name(&self) -> &'static str {
        if self.axis == 2 { "depth range" } else { "vertex field" }
    }

    /// The value, if it lies between the two ends.
    ///
    /// # Errors
    /// [`VertexError::Outside`].
    pub(super) fn within(self, value: i128, ends: (i128, i128)) -> Result<i128, VertexError> {
        let (low, high) = ends;
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            Err(VertexError::Outside { coordinate: self, value, low, high })
        }
    }
}

impl std::fmt::Display for Coordinate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.key)?;
        if let Some(vertex) = self.vertex {
            write!(f, "[{vertex}]")?;
        }
        write!(f, "[{}]", self.axis)
    }
}

impl VertexConfig {
    /// Checks the field.
    ///
    /// # Errors
    /// [`VertexError`] unless `1 <= integer + sub_pixel <= 32` and a signed field has a sign bit.
    pub fn validate(&self) -> Result<(), VertexError> {
        let (integer, sub_pixel) = (self.integer, self.sub_pixel);
        if self.signed && integer == 0 {
            return Err(VertexError::NoSign);
        }
        if let Some(lattice) = self.lattice
            && (lattice <= sub_pixel || lattice > 24)
        {
            return Err(VertexError::Lattice { lattice, sub_pixel });
        }
        match integer.checked_add(sub_pixel) {
            Some(1..=32) => Ok(()),
            _ => Err(VertexError::Field { integer, sub_pixel }),
        }
    }

    /// Lowest and highest vertex coordinate, in sub-pixels.
    pub const fn range(&self) -> (i128, i128) {
        let bits = self.integer + self.sub_pixel;
        let (low, limit) =
            if self.signed { (-(1 << (bits - 1)), 1 << (bits - 1)) } else { (0, 1 << bits) };
        (low, if self.closed { limit } else { limit - 1 })
    }

    /// Bits of a vertex coordinate: with its sign, and the one more that a closed field takes.
    pub const fn bits(&self) -> u32 {
        let (low, high) = self.range();
        let magnitude = i128::BITS - high.leading_zeros();
        if low < 0 { magnitude + 1 } else { magnitude }
    }

    /// Bits of the difference of two vertex coordinates, sign included: the `k + s + 1` (half-open)
    /// or `k + s + 2` (closed) of edge coefficients. Spec clause `E-4`.
    pub const fn difference_bits(&self) -> u32 {
        let (low, high) = self.range();
        // The smallest n with high - low <= 2^(n-1) - 1, which also holds low - high.
        1 + (i128::BITS - (high - low).leading_zeros())
    }

    /// Bits below the pixel of the integer coordinates that a caller gives. Spec clause `S-5`.
    pub fn input_bits(&self) -> u32 {
        self.lattice.unwrap_or(self.sub_pixel)
    }

    /// Vertices of the grid as a caller gives them: what [`VertexConfig::to_grid`] brings back.
    pub fn to_input(&self, xy: [[i128; 2]; 3]) -> [[i128; 2]; 3] {
        let finer = self.input_bits() - self.sub_pixel;
        xy.map(|vertex| vertex.map(|value| value << finer))
    }

    /// An integer coordinate on the sub-pixel grid, rounded from the profile's lattice where that is
    /// finer. Spec clause `S-5`; whether it lies in the field is for [`VertexField`] to say.
    ///
    /// [`VertexField`]: super::VertexField
    pub fn to_grid(&self, value: i128) -> i128 {
        self.snap.shift_right(value, self.input_bits() - self.sub_pixel).0
    }

    /// A real coordinate as a number of `2^-fraction` units between two ends, rounded once by
    /// the profile's snap. Spec clause `S-3`.
    ///
    /// # Errors
    /// [`VertexError`] for NaN, infinities and values outside, unless the profile clamps them.
    pub fn snap(
        &self,
        coordinate: Coordinate,
        value: f64,
        fraction: u32,
        ends: (i128, i128),
    ) -> Result<i128, VertexError> {
        let value = match self.source {
            Source::F64 => value,
            #[allow(
                clippy::cast_possible_truncation,
                reason = "the rounding to binary32 is the point"
            )]
            Source::F32 => f64::from(value as f32),
        };
        let snapped = snap_f64(value, fraction, self.snap);
        match (snapped, self.endless) {
            (Some(value), _) => coordinate.within(value, ends),
            (None, Endless::Clamp) if value.is_nan() => Ok(0i128.clamp(ends.0, ends.1)),
            (None, Endless::Clamp) => Ok(if value > 0.0 { ends.1 } else { ends.0 }),
            (None, Endless::Refuse) => {
                let what = if value.is_nan() {
                    "NaN"
                } else if value.is_infinite() {
                    "infinite"
                } else {
                    "too large for any word"
                };
                Err(VertexError::NotFinite { coordinate, what })
            }
        }
    }
}

/// `value * 2^fraction` rounded once, exactly; `None` for NaN, infinities and beyond 2^126.
///
/// ```
/// use guardbit::{bits::Rounding, setup};
/// // Direct3D's tie: -8191.630859375 * 256 = -2097057.5 goes to the even neighbour.
/// let x = f64::from(f32::from_bits(0xC5FF_FD0C));
/// assert_eq!(setup::snap_f64(x, 8, Rounding::NearestEven), Some(-2_097_058));
/// ```
pub fn snap_f64(value: f64, fraction: u32, rounding: Rounding) -> Option<i128> {
    if !value.is_finite() {
        return None;
    }
    let bits = value.to_bits();
    let exponent_field = i32::try_from(bits >> 52 & 0x7ff).ok()?;
    let fraction_field = i128::from(bits & ((1 << 52) - 1));
    // A subnormal has no hidden bit and the exponent of the smallest normal.
    let magnitude = if exponent_field == 0 { fraction_field } else { fraction_field | 1 << 52 };
    let signed = if bits >> 63 == 1 { -magnitude } else { magnitude };
    let exponent = exponent_field.max(1) - 1075 + i32::try_from(fraction).ok()?;
    if exponent >= 0 {
        // 53 bits of magnitude; 2^126 keeps every later sum inside i128.
        (signed == 0 || exponent <= 73).then(|| if signed == 0 { 0 } else { signed << exponent })
    } else {
        Some(rounding.shift_right(signed, exponent.unsigned_abs()).0)
    }
}

/// A `fixed` number times `2^fraction`, rounded once; `None` when it does not fit `i128`.
pub fn snap_fixed<T: Fixed>(value: T, fraction: u32, rounding: Rounding) -> Option<i128>
where
    T::Bits: TryInto<i128>,
{
    let bits: i128 = value.to_bits().try_into().ok()?;
    let from = T::FRAC_NBITS;
    if from >= fraction {
        Some(rounding.shift_right(bits, from - fraction).0)
    } else {
        let up = fraction - from;
        if bits == 0 {
            return Some(0);
        }
        let scaled = bits.checked_shl(up)?;
        (scaled >> up == bits).then_some(scaled)
    }
}
