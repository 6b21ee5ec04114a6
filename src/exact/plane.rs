//! The plane through three vertex values, from the areas opposite the vertices.
//! The oracle of spec clauses `P-*`.

use super::edge::edge_value;
use super::number::{Point, Rational, integer};
use super::round::round;
use crate::bits::Rounding;
use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};

/// The value at `sample` of the plane with values `z` at the vertices; `None` without area.
pub fn plane_at(
    triangle: [[i128; 2]; 3],
    z: [i128; 3],
    sample: impl Into<Point>,
) -> Option<Rational> {
    let sample = sample.into();
    let [a, b, c] = triangle;
    let whole = edge_value(a, b, c);
    if whole.is_zero() {
        return None;
    }
    let weighted: Rational = [(b, c, z[0]), (c, a, z[1]), (a, b, z[2])]
        .into_iter()
        .map(|(from, to, value)| edge_value(from, to, sample.clone()) * integer(value))
        .sum();
    Some(weighted / whole)
}

/// The change of the plane's value per sub-pixel rightward and downward; `None` without area.
pub fn plane_slopes(triangle: [[i128; 2]; 3], z: [i128; 3]) -> Option<[Rational; 2]> {
    let origin = plane_at(triangle, z, [0, 0])?;
    Some([plane_at(triangle, z, [1, 0])? - &origin, plane_at(triangle, z, [0, 1])? - &origin])
}

/// The plane's value in units of `2^-fraction`, rounded once; `None` without area, or where it
/// does not fit.
///
/// ```
/// use guardbit::{bits::Rounding, exact::plane_word};
/// // z rises by 1/3 a sub-pixel: one third in units of 1/8 is 8/3.
/// let word = plane_word([[0, 0], [3, 0], [0, 3]], [0, 1, 0], [1, 0], 3, Rounding::NearestEven);
/// assert_eq!(word, Some(3));
/// ```
pub fn plane_word(
    triangle: [[i128; 2]; 3],
    z: [i128; 3],
    sample: impl Into<Point>,
    fraction: u32,
    rounding: Rounding,
) -> Option<i128> {
    let scale = Rational::from_integer(BigInt::from(1) << fraction);
    round(&(plane_at(triangle, z, sample)? * scale), rounding).to_i128()
}

/// The plane over a triangle as integers over one denominator: the value at sub-pixel (x, y) is
/// `(origin + slope[0] x + slope[1] y) / whole`, from the areas opposite the vertices.
///
/// Growth: 2m + 4 bits for coordinates of m bits, plus the bits of a vertex value.
///
/// ```
/// use guardbit::exact::PlaneNumerator;
/// let plane = PlaneNumerator::new([[0, 0], [4, 0], [0, 4]], [0, 10, 3]).ok_or("no area")?;
/// assert_eq!((plane.at([1, 1]), plane.whole), (52, 16)); // 13/4
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlaneNumerator {
    /// Twice the area, positive for either winding.
    pub whole: i128,
    /// Value at sub-pixel (0, 0), times `whole`.
    pub origin: i128,
    /// Change per sub-pixel rightward and downward, times `whole`.
    pub slope: [i128; 2],
}

impl PlaneNumerator {
    /// The plane with values `z` at the vertices; `None` without area, or beyond 128 bits.
    pub fn new(triangle: [[i128; 2]; 3], z: [i128; 3]) -> Option<Self> {
        let mut sum = [0i128; 4];
        for k in 0..3 {
            let ([bx, by], [cx, cy]) = (triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
            // Twice the area of sample, b, c is this constant and these changes.
            let constant = bx.checked_mul(cy)?.checked_sub(by.checked_mul(cx)?)?;
            let terms = [constant, by.checked_sub(cy)?, cx.checked_sub(bx)?];
            sum[0] = sum[0].checked_add(constant)?;
            for (total, term) in sum[1..].iter_mut().zip(terms) {
                *total = total.checked_add(term.checked_mul(z[k])?)?;
            }
        }
        let [whole, origin, dx, dy] = sum.map(|value| value * sum[0].signum());
        (whole != 0).then_some(Self { whole, origin, slope: [dx, dy] })
    }

    /// The value at a point in sub-pixels, times `whole`.
    #[inline]
    pub fn at(&self, [x, y]: [i128; 2]) -> i128 {
        self.origin + self.slope[0] * x + self.slope[1] * y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Point, dyadic, ratio};

    #[test]
    fn numerators_are_the_rational_plane() {
        for n in 0..200_i128 {
            let v = |k: i128| [(n * 7 + k * 5) % 11 - 3, (n * 3 + k * k * 4) % 9 - 2];
            let (triangle, z) = ([v(0), v(1), v(2)], [n % 5, n % 7 - 3, n % 13]);
            let wanted = plane_at(triangle, z, [n, 3 - n]);
            let got = PlaneNumerator::new(triangle, z);
            assert_eq!(got.and_then(|p| ratio(p.at([n, 3 - n]), p.whole)), wanted);
            assert!(got.is_none_or(|plane| plane.whole > 0));
        }
        assert_eq!(PlaneNumerator::new([[0, 0], [i128::MAX, 0], [0, 2]], [1, 1, 1]), None);
    }

    #[test]
    fn vertices_keep_their_values_and_midpoints_their_means() {
        let (triangle, z) = ([[1, 7], [12, -3], [5, 20]], [10, -4, 3]);
        for k in 0..3 {
            assert_eq!(plane_at(triangle, z, triangle[k]), Some(integer(z[k])));
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            let middle = Point::dyadic([a[0] + b[0], a[1] + b[1]], 1);
            assert_eq!(plane_at(triangle, z, middle), Some(dyadic(z[k] + z[(k + 1) % 3], 1)));
        }
    }

    #[test]
    fn slopes_do_not_depend_on_winding() {
        let slopes = plane_slopes([[0, 0], [3, 0], [0, 5]], [0, 1, 2]);
        assert_eq!(slopes, Some([ratio(1, 3).unwrap(), ratio(2, 5).unwrap()]));
        assert_eq!(plane_slopes([[0, 0], [0, 5], [3, 0]], [0, 2, 1]), slopes);
        assert_eq!(plane_slopes([[0, 0], [1, 1], [2, 2]], [0, 2, 1]), None);
    }
}
