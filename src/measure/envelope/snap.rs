//! How a coordinate comes to the sub-pixel grid. Spec clause `EN-3`.

use crate::bits::Rounding;
use crate::setup::snap_f64;
use std::fmt;

/// A function from real coordinates to the sub-pixel grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Snap {
    /// One of the roundings of a profile.
    Round(Rounding),
    /// The largest grid point within 0.6 units: Direct3D's tolerance, used upward.
    TolerantUp,
    /// The smallest grid point within 0.6 units.
    TolerantDown,
}

impl Snap {
    /// A binary32 number of pixels in units of `2^-bits` pixels; `None` beyond 2^126 units or where it is no number.
    ///
    /// A rounding is that of `VertexConfig::snap`. The tolerant snaps are floor(v + 3/5) and ceil(v - 3/5) of
    /// v = value 2^bits. 5 v is exact in binary64, since a binary32 number has 24 significant bits.
    pub fn apply(self, value: f64, bits: u32) -> Option<i128> {
        match self {
            Self::Round(rounding) => snap_f64(value, bits, rounding),
            Self::TolerantUp => {
                snap_f64(5.0 * value, bits, Rounding::Floor).map(|five| (five + 3).div_euclid(5))
            }
            Self::TolerantDown => {
                snap_f64(5.0 * value, bits, Rounding::Ceiling).map(|five| -(3 - five).div_euclid(5))
            }
        }
    }

    /// The largest distance that it moves a coordinate, in units.
    pub const fn error(self) -> f64 {
        match self {
            Self::Round(rounding) => {
                if rounding.is_nearest() {
                    0.5
                } else {
                    1.0
                }
            }
            Self::TolerantUp | Self::TolerantDown => 0.6,
        }
    }
}

impl fmt::Display for Snap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Round(rounding) => rounding.names().guardbit,
            Self::TolerantUp => "up-within-0.6",
            Self::TolerantDown => "down-within-0.6",
        })
    }
}
