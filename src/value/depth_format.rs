//! What a depth buffer stores: integers and small floats over Z/w, 1/w and object Z.
//! Spec clauses `Z-1` to `Z-5`.

use crate::bits::Rounding;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A stored depth, made from Z/w after interpolation. Z/w runs from 0 at the near plane n to 1 at the
/// far plane f; `ratio` is f / n.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum DepthFormat {
    /// Z/w as an unsigned normalised integer: the Z-buffer of SGI and OpenGL.
    ZOverW {
        /// Bits.
        bits: u32,
    },
    /// n/w as one, not biased: the W-buffer. Larger is nearer, and far is not 0.
    OneOverW {
        /// Bits.
        bits: u32,
        /// f / n.
        ratio: u32,
    },
    /// (w - n) / (f - n) as one: the true object-Z buffer, a division a fragment.
    ObjectZ {
        /// Bits.
        bits: u32,
        /// f / n.
        ratio: u32,
    },
    /// 1/w linear from 0 at the far plane to the maximum at the near one: larger is nearer.
    InverseZ {
        /// Bits.
        bits: u32,
    },
    /// The same as a float, far at zero (InfiniteReality).
    FloatFarZero {
        /// Exponent bits.
        exponent: u32,
        /// Fraction bits.
        mantissa: u32,
    },
    /// Object Z as a float, near at zero (Odyssey).
    FloatNearZero {
        /// Exponent bits.
        exponent: u32,
        /// Fraction bits.
        mantissa: u32,
        /// f / n.
        ratio: u32,
    },
}

/// A format that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DepthFormatError {
    /// Bits of an integer.
    #[error("format bits = {0}: a depth code has 1 to 32 bits")]
    Bits(u32),
    /// Fields of a float.
    #[error(
        "format exponent = {exponent}, mantissa = {mantissa}: a depth float has 1 to 5 exponent bits \
         and 1 to 27 fraction bits"
    )]
    Float {
        /// Exponent bits.
        exponent: u32,
        /// Fraction bits.
        mantissa: u32,
    },
    /// A ratio of planes.
    #[error("format ratio = {0}: 2 <= far / near <= 1048576 is needed")]
    Ratio(u32),
    /// The accumulator's own bits and the format's outgrow exact arithmetic.
    #[error(
        "depth integer + interpolation = {integer} + {interpolation} > 58: the conversion to a depth \
         format does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
    )]
    Growth {
        /// Depth bits.
        integer: u32,
        /// Interpolation bits.
        interpolation: u32,
    },
}

/// A number of [0, 1] as a fraction, denominator positive.
pub(super) type Part = (i128, i128);

impl DepthFormat {
    /// The names of the formats, as profiles write them.
    pub const NAMES: [&'static str; 6] =
        ["z-over-w", "one-over-w", "object-z", "inverse-z", "float-far-zero", "float-near-zero"];

    /// The format of that name with so many bits in all, four of them exponent in a float.
    pub fn named(name: &str, bits: u32, ratio: u32) -> Option<Self> {
        let (exponent, mantissa) = (4, bits.saturating_sub(4));
        Some(match name {
            "z-over-w" => Self::ZOverW { bits },
            "one-over-w" => Self::OneOverW { bits, ratio },
            "object-z" => Self::ObjectZ { bits, ratio },
            "inverse-z" => Self::InverseZ { bits },
            "float-far-zero" => Self::FloatFarZero { exponent, mantissa },
            "float-near-zero" => Self::FloatNearZero { exponent, mantissa, ratio },
            _ => return None,
        })
    }

    /// Its name.
    pub const fn name(&self) -> &'static str {
        Self::NAMES[match self {
            Self::ZOverW { .. } => 0,
            Self::OneOverW { .. } => 1,
            Self::ObjectZ { .. } => 2,
            Self::InverseZ { .. } => 3,
            Self::FloatFarZero { .. } => 4,
            Self::FloatNearZero { .. } => 5,
        }]
    }

    /// Checks the format; `integer` and `interpolation` are the bits of the depth accumulator.
    ///
    /// # Errors
    /// [`DepthFormatError`] names the violated inequality.
    pub fn validate(&self, integer: u32, interpolation: u32) -> Result<(), DepthFormatError> {
        match *self {
            Self::ZOverW { bits }
            | Self::InverseZ { bits }
            | Self::OneOverW { bits, .. }
            | Self::ObjectZ { bits, .. }
                if !(1..=32).contains(&bits) =>
            {
                return Err(DepthFormatError::Bits(bits));
            }
            Self::FloatFarZero { exponent, mantissa }
            | Self::FloatNearZero { exponent, mantissa, .. }
                if !(1..=5).contains(&exponent) || !(1..=27).contains(&mantissa) =>
            {
                return Err(DepthFormatError::Float { exponent, mantissa });
            }
            _ => {}
        }
        match self.ratio() {
            Some(ratio) if !(2..=1 << 20).contains(&ratio) => {
                return Err(DepthFormatError::Ratio(ratio));
            }
            _ => {}
        }
        if integer + interpolation > 58 {
            return Err(DepthFormatError::Growth { integer, interpolation });
        }
        Ok(())
    }

    /// f / n, where the format depends on it.
    pub const fn ratio(&self) -> Option<u32> {
        match self {
            Self::OneOverW { ratio, .. }
            | Self::ObjectZ { ratio, .. }
            | Self::FloatNearZero { ratio, .. } => Some(*ratio),
            _ => None,
        }
    }

    /// Bits of a code.
    pub const fn bits(&self) -> u32 {
        match self {
            Self::ZOverW { bits }
            | Self::OneOverW { bits, .. }
            | Self::ObjectZ { bits, .. }
            | Self::InverseZ { bits } => *bits,
            Self::FloatFarZero { exponent, mantissa }
            | Self::FloatNearZero { exponent, mantissa, .. } => *exponent + *mantissa,
        }
    }

    /// The largest code.
    pub const fn maximum(&self) -> u64 {
        u64::MAX >> (64 - self.bits())
    }

    /// Whether a larger code is nearer, so that the depth test is reversed.
    pub const fn is_reversed(&self) -> bool {
        matches!(self, Self::OneOverW { .. } | Self::InverseZ { .. } | Self::FloatFarZero { .. })
    }

    pub(super) const fn float(&self) -> Option<(u32, u32)> {
        match self {
            Self::FloatFarZero { exponent, mantissa }
            | Self::FloatNearZero { exponent, mantissa, .. } => Some((*exponent, *mantissa)),
            _ => None,
        }
    }

    /// The stored quantity of [0, 1] for a Z/w of `numerator / denominator`, exactly.
    ///
    /// Growth: the ratio's 20 bits above those of the denominator.
    pub fn part(&self, (numerator, denominator): Part) -> Part {
        let (v, whole) = (numerator.clamp(0, denominator), denominator);
        match *self {
            Self::ZOverW { .. } => (v, whole),
            Self::InverseZ { .. } | Self::FloatFarZero { .. } => (whole - v, whole),
            // n / w = 1 - v (f - n) / f.
            Self::OneOverW { ratio, .. } => {
                let r = i128::from(ratio);
                (whole * r - v * (r - 1), whole * r)
            }
            // (w - n) / (f - n) = v / (r - v (r - 1)).
            Self::ObjectZ { ratio, .. } | Self::FloatNearZero { ratio, .. } => {
                let r = i128::from(ratio);
                (v, whole * r - v * (r - 1))
            }
        }
    }

    /// The code of a stored quantity, rounded once.
    ///
    /// A float's field e of exponent bits and m of fraction bits stand for (1 + m / 2^M)
    /// 2^(e - 2^E), and for e = 0 for m / 2^M 2^(1 - 2^E): unsigned, without infinities, so that codes
    /// are ordered as integers. What rounds up to 1 is the largest code.
    ///
    /// Growth: 32 bits of exponent range and 27 of fraction above the numerator's.
    pub fn encode(&self, (numerator, denominator): Part, rounding: Rounding) -> u64 {
        let divide = |n: i128| rounding.divide(n, denominator).map_or(0, |(q, _)| q);
        let code = match self.float() {
            None => divide(numerator * i128::from(self.maximum())),
            Some((exponent, mantissa)) => {
                let range = 1u32 << exponent;
                let field = self.exponent_of((numerator, denominator));
                let scaled = divide(numerator << (range - field.max(1) + mantissa));
                let hidden = if field == 0 { 0 } else { 1 << mantissa };
                (i128::from(field) << mantissa) + scaled - hidden
            }
        };
        u64::try_from(code.max(0)).unwrap_or(u64::MAX).min(self.maximum())
    }

    /// The exponent field of a quantity of [0, 1] in a float: the largest e with 2^(e - 2^E) <= v, or 0.
    pub(super) fn exponent_of(&self, (numerator, denominator): Part) -> u32 {
        let range = self.float().map_or(0, |(exponent, _)| 1u32 << exponent);
        (1..range).rev().find(|e| numerator << (range - e) >= denominator).unwrap_or(0)
    }

    /// The quantity that a code stands for, exactly.
    pub fn decode(&self, code: u64) -> Part {
        let code = i128::from(code.min(self.maximum()));
        match self.float() {
            None => (code, i128::from(self.maximum())),
            Some((exponent, mantissa)) => {
                let field = code >> mantissa;
                let hidden = i128::from(field > 0) << mantissa;
                let significand = (code & ((1 << mantissa) - 1)) + hidden;
                let range = 1i128 << exponent;
                (significand, 1 << (i128::from(mantissa) + range - field.max(1)))
            }
        }
    }

    /// The code of a depth accumulator as the read-out holds it, `held` over the largest code of
    /// `integer` bits with `interpolation` bits of fraction below.
    pub fn convert(&self, held: i128, integer: u32, interpolation: u32, rounding: Rounding) -> u64 {
        let whole = ((1i128 << integer) - 1) << interpolation;
        self.encode(self.part((held, whole)), rounding)
    }
}
