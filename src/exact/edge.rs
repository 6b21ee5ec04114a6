//! One edge: its x on a row, the first pixel right of it, and its edge function by areas.

use super::number::{Point, Rational, dyadic, integer};
use super::round::round;
use crate::bits::Rounding;
use num_bigint::BigInt;
use num_traits::ToPrimitive;

/// A row, in sub-pixels: an integer or a rational.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row(Rational);

impl From<i128> for Row {
    fn from(y: i128) -> Self {
        Self(integer(y))
    }
}

impl From<Rational> for Row {
    fn from(y: Rational) -> Self {
        Self(y)
    }
}

/// The x at which the line through two points crosses the row `y`; `None` for a horizontal line.
pub fn edge_x(from: [i128; 2], to: [i128; 2], y: impl Into<Row>) -> Option<Rational> {
    let Row(y) = y.into();
    if from[1] == to[1] {
        return None;
    }
    let [p, q] = [from, to].map(Point::from);
    let along = (y - &p.y) / (q.y - &p.y);
    Some(&p.x + along * (q.x - &p.x))
}

/// The first pixel whose centre is at or right of the edge on the centre of row `row`:
/// `ceil(x - 1/2)`, x in pixels, with `sub_pixel` bits below the pixel.
/// `None` for a horizontal edge.
pub fn first_pixel(from: [i128; 2], to: [i128; 2], row: i128, sub_pixel: u32) -> Option<i128> {
    let pixel = Rational::from_integer(BigInt::from(1) << sub_pixel);
    let centre = (integer(row) + dyadic(1, 1)) * &pixel;
    let x = edge_x(from, to, centre)? / pixel;
    round(&(x - dyadic(1, 1)), Rounding::Ceiling).to_i128()
}

/// Twice the signed area of `from`, `to` and `point`, in sub-pixels squared: the edge function.
///
/// By the shoelace sum over the three corners rather than by coefficients.
pub fn edge_value(from: [i128; 2], to: [i128; 2], point: impl Into<Point>) -> Rational {
    let corners = [from.into(), to.into(), point.into()];
    (0..3)
        .map(|k| {
            let (p, q): (&Point, &Point) = (&corners[k], &corners[(k + 1) % 3]);
            &p.x * &q.y - &q.x * &p.y
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Point, ratio};

    #[test]
    fn an_edge_crosses_its_ends_and_its_middle() {
        assert_eq!(edge_x([3, 1], [8, 11], 1), Some(integer(3)));
        assert_eq!(edge_x([3, 1], [8, 11], 11), Some(integer(8)));
        assert_eq!(edge_x([8, 11], [3, 1], 6), Some(dyadic(11, 1)));
        assert_eq!(edge_x([0, 0], [1, 3], 1), ratio(1, 3));
        assert_eq!(edge_x([0, 2], [9, 2], 2), None);
    }

    #[test]
    fn a_tie_belongs_to_the_pixel_right_of_it() {
        // (0, 1/2) to (1, 6 1/2) with one sub-pixel bit; row 3 is crossed at x = 1/2 exactly.
        assert_eq!(first_pixel([0, 1], [2, 13], 3, 1), Some(0));
        assert_eq!(first_pixel([0, 1], [2, 13], 4, 1), Some(1));
    }

    #[test]
    fn the_edge_function_is_twice_an_area() {
        // A 3 by 4 right triangle, both ways round, and a half-lattice point.
        assert_eq!(edge_value([0, 0], [3, 0], [0, 4]), integer(12));
        assert_eq!(edge_value([3, 0], [0, 0], [0, 4]), integer(-12));
        assert_eq!(edge_value([0, 0], [3, 0], Point::dyadic([1, 1], 1)), dyadic(3, 1));
    }
}
