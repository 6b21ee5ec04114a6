//! Derivatives of codes in quads of pixels, and the level of detail of a texture. Spec clauses `CH-20` and
//! `CH-21`.

use crate::bits::bounded;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The codes of a channel in a quad: two by two pixels, the upper left one with even x and y.
///
/// Pixels are numbered from left to right, then downward.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quad {
    /// Column of the left pixels.
    pub x: u32,
    /// Row of the upper pixels.
    pub y: u32,
    /// Whether each pixel is covered; the others help.
    pub covered: [bool; 4],
    /// The codes of the four pixels, for each component.
    pub codes: Vec<[i64; 4]>,
}

/// Which differences a quad makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Derivatives {
    /// Those of each row and of each column.
    Fine,
    /// Those of the upper row and of the left column, for all four pixels.
    #[default]
    Coarse,
}

impl Quad {
    /// The differences of one component at each pixel, to the right and downward. Spec clause `CH-20`.
    ///
    /// ```
    /// use guardbit::value::{Derivatives, Quad};
    /// let quad = Quad { x: 4, y: 2, covered: [true; 4], codes: vec![[10, 13, 20, 29]] };
    /// assert_eq!(quad.derivatives(0, Derivatives::Coarse), [[3, 10]; 4]);
    /// assert_eq!(quad.derivatives(0, Derivatives::Fine), [[3, 10], [3, 16], [9, 10], [9, 16]]);
    /// ```
    pub fn derivatives(&self, component: usize, which: Derivatives) -> [[i64; 2]; 4] {
        let [a, b, c, d] = self.codes[component];
        let ([upper, lower], [left, right]) = ([b - a, d - c], [c - a, d - b]);
        match which {
            Derivatives::Coarse => [[upper, left]; 4],
            Derivatives::Fine => [[upper, left], [upper, right], [lower, left], [lower, right]],
        }
    }
}

/// How the length of an axis is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum AxisLength {
    /// The larger part plus half of the smaller one.
    LargerAndHalf,
    /// The root of the sum of squares: the logarithm halves it.
    Exact,
}

/// A unit for the level of detail of a texture of two coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct DetailConfig {
    /// Texels of level 0 along the two coordinates, 1 to 65536 each.
    pub texels: [u32; 2],
    /// The code at the far side of the texture, at least 1.
    pub unit: u32,
    /// Which differences count.
    #[serde(default)]
    pub derivatives: Derivatives,
    /// How the length of an axis is found.
    pub length: AxisLength,
    /// Bits of a level below the binary point, 0 to 16.
    pub fraction: u32,
    /// The number of the smallest level, 0 to 31.
    pub levels: u32,
}

/// A unit that cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {value}: {low} <= {field} <= {high} is needed")]
pub struct DetailError {
    /// The field.
    pub field: &'static str,
    /// Its value.
    pub value: u32,
    /// The smallest allowed.
    pub low: u32,
    /// The largest allowed.
    pub high: u32,
}

/// A unit for the level of detail, ready.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Detail(DetailConfig);

impl DetailConfig {
    /// Checks the unit.
    ///
    /// # Errors
    /// [`DetailError`] names the violated inequality.
    pub fn unit(self) -> Result<Detail, DetailError> {
        let fields = [
            ("texels", self.texels[0], 1, 1 << 16),
            ("texels", self.texels[1], 1, 1 << 16),
            ("unit", self.unit, 1, u32::MAX),
            ("fraction", self.fraction, 0, 16),
            ("levels", self.levels, 0, 31),
        ];
        let wrong = fields.into_iter().find(|(_, value, low, high)| value < low || value > high);
        match wrong {
            Some((field, value, low, high)) => Err(DetailError { field, value, low, high }),
            None => Ok(Detail(self)),
        }
    }
}

impl Detail {
    /// Bits of a level.
    pub fn width(&self) -> u32 {
        let DetailConfig { fraction, levels, .. } = self.0;
        (u64::BITS - (u64::from(levels) << fraction).leading_zeros()).max(1)
    }

    /// The level, in units of `2^-fraction`, for the differences `[to the right, downward]` of the two
    /// coordinates, of at most 33 bits each. Spec clause `CH-21`.
    ///
    /// ```
    /// use guardbit::value::{AxisLength, Derivatives, DetailConfig};
    /// let length = AxisLength::LargerAndHalf;
    /// let derivatives = Derivatives::Coarse;
    /// let config =
    ///     DetailConfig { texels: [1024; 2], unit: 256, derivatives, length, fraction: 4, levels: 10 };
    /// let unit = config.unit().map_err(|error| error.to_string())?;
    /// // 3 codes are 12 texels: 3 1/2 for a logarithm of 3.58.
    /// assert_eq!(unit.level([[3, 0], [0, 1]]), 3 * 16 + 8);
    /// # Ok::<(), String>(())
    /// ```
    pub fn level(&self, differences: [[i64; 2]; 2]) -> u64 {
        let DetailConfig { texels, unit, derivatives: _, length, fraction, levels } = self.0;
        let axis = |n: usize| {
            let [u, v] = [0, 1]
                .map(|k| u128::from(differences[k][n].unsigned_abs()) * u128::from(texels[k]));
            match length {
                AxisLength::LargerAndHalf => 2 * u.max(v) + u.min(v),
                AxisLength::Exact => u * u + v * v,
            }
        };
        let longer = axis(0).max(axis(1));
        if longer == 0 {
            return 0;
        }
        let found = logarithm(longer, fraction);
        let found = match length {
            // Twice the length.
            AxisLength::LargerAndHalf => found - (1 << fraction),
            AxisLength::Exact => found >> 1,
        };
        let level = found - logarithm(unit.into(), fraction);
        bounded(level.clamp(0, i64::from(levels) << fraction))
    }
}

/// The place of the leading one, with the bits below it as the fraction, cut.
fn logarithm(value: u128, fraction: u32) -> i64 {
    let place = value.ilog2();
    let mantissa: i64 = bounded(value << fraction >> place);
    (i64::from(place) << fraction) + mantissa - (1 << fraction)
}
