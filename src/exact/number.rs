//! Rationals, and points made of them.

use num_bigint::BigInt;
use num_rational::Ratio;

/// A quotient of big integers, always in lowest terms.
pub type Rational = Ratio<BigInt>;

/// `value` as a rational.
pub fn integer(value: i128) -> Rational {
    Ratio::from_integer(value.into())
}

/// `numerator / denominator`; `None` when the denominator is zero.
pub fn ratio(numerator: i128, denominator: i128) -> Option<Rational> {
    (denominator != 0).then(|| Ratio::new(numerator.into(), denominator.into()))
}

/// `value / 2^fraction`: what a fixed-point pattern stands for.
pub fn dyadic(value: i128, fraction: u32) -> Rational {
    Ratio::new(value.into(), BigInt::from(1) << fraction)
}

/// A point in sub-pixels, y down.
///
/// ```
/// use guardbit::exact::{Point, dyadic};
/// assert_eq!(Point::from([3, 5]), Point::dyadic([6, 10], 1));
/// assert_eq!(Point::dyadic([3, 5], 1), Point::from([dyadic(3, 1), dyadic(5, 1)]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Rightward.
    pub x: Rational,
    /// Downward.
    pub y: Rational,
}

impl Point {
    /// A point finer than the sub-pixel grid: `xy / 2^fraction`.
    pub fn dyadic(xy: [i128; 2], fraction: u32) -> Self {
        Self { x: dyadic(xy[0], fraction), y: dyadic(xy[1], fraction) }
    }
}

impl From<[i128; 2]> for Point {
    fn from([x, y]: [i128; 2]) -> Self {
        Self { x: integer(x), y: integer(y) }
    }
}

impl From<[Rational; 2]> for Point {
    fn from([x, y]: [Rational; 2]) -> Self {
        Self { x, y }
    }
}
