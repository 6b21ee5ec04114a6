//! Perspective by its definition: values over w weighed by areas. The oracle of spec clauses `I-1` to
//! `I-6`.

use super::edge::edge_value;
use super::number::{Point, Rational, integer};
use num_traits::Zero;

/// The value at `sample` of an attribute that is linear in space, with values `u` and eye distances
/// `w` at the projected vertices; `None` without area, for a w of zero, or at the horizon.
///
/// ```
/// use guardbit::exact::{Point, perspective_at, ratio};
/// // w = 1 and 3, attribute 0 and 1: the middle of the edge on the screen reads 1/4.
/// let at = Point::from([2, 0]);
/// let u = perspective_at([[0, 0], [4, 0], [0, 4]], [0, 1, 0], [1, 3, 1], at);
/// assert_eq!(u, ratio(1, 4));
/// ```
pub fn perspective_at(
    triangle: [[i128; 2]; 3],
    u: [i128; 3],
    w: [i128; 3],
    sample: impl Into<Point>,
) -> Option<Rational> {
    let sample = sample.into();
    let [a, b, c] = triangle;
    if edge_value(a, b, c).is_zero() || w.contains(&0) {
        return None;
    }
    let (mut above, mut below) = (Rational::zero(), Rational::zero());
    for (k, (from, to)) in [(b, c), (c, a), (a, b)].into_iter().enumerate() {
        let weight = edge_value(from, to, sample.clone()) / integer(w[k]);
        above += &weight * integer(u[k]);
        below += weight;
    }
    (!below.is_zero()).then(|| above / below)
}
