//! Coverage row by row in plain integers: the truth for whole scenes, where a rational a row would
//! take too long. The same idea as [`super::covered_row`], held against it by a property test.

use super::Rule;

/// A side of a triangle, upper end first.
#[derive(Clone, Copy, Debug)]
struct Side {
    top: [i128; 2],
    width: i128,
    height: i128,
}

/// A triangle's outline, ready to be cut by rows of samples.
///
/// Growth: with coordinates below 2^m in size a cut forms products below 2^(2m+3); m is at most 60.
///
/// ```
/// use guardbit::exact::{Outline, Rule};
/// // Samples at 1, 3, 5, ... on both axes: pixel centres with one sub-pixel bit.
/// let outline = Outline::new([[0, 0], [8, 0], [0, 8]]);
/// assert_eq!(outline.row(1, (1, 2), Rule::TopLeft), Some((0, 3)));
/// assert_eq!(outline.row(9, (1, 2), Rule::TopLeft), None);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Outline([Side; 3]);

impl Outline {
    /// The outline of a triangle, of either winding.
    pub fn new(triangle: [[i128; 2]; 3]) -> Self {
        let [a, b, c] = triangle;
        Self([[a, b], [b, c], [c, a]].map(|[from, to]| {
            let (top, bottom) = if from[1] <= to[1] { (from, to) } else { (to, from) };
            Side { top, width: bottom[0] - top[0], height: bottom[1] - top[1] }
        }))
    }

    /// The samples `first + n * pitch` of the row `y` that the triangle covers, as a half-open
    /// range of n; `None` where the row misses the triangle. The range may be empty.
    pub fn row(&self, y: i128, (first, pitch): (i128, i128), rule: Rule) -> Option<(i128, i128)> {
        let mut cuts = self.0.iter().filter_map(|side| {
            // Half-open downward: a row meets the outline of a triangle twice or not at all.
            let below = y - side.top[1];
            if below < 0 || below >= side.height {
                return None;
            }
            let over = (side.top[0] - first) * side.height + below * side.width;
            Some(match rule {
                // The first sample at or right of the cut, or the first one beyond it.
                Rule::TopLeft => -floor(-over, side.height * pitch),
                Rule::Shadow => floor(over, side.height * pitch) + 1,
            })
        });
        let (one, other) = (cuts.next()?, cuts.next()?);
        Some((one.min(other), one.max(other)))
    }
}

/// `floor(numerator / denominator)` for a positive denominator.
fn floor(numerator: i128, denominator: i128) -> i128 {
    match (i64::try_from(numerator), i64::try_from(denominator)) {
        // A 64-bit divide is several times quicker.
        (Ok(numerator), Ok(denominator)) => i128::from(numerator.div_euclid(denominator)),
        _ => numerator.div_euclid(denominator),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Words;
    use crate::exact::covered_row;

    #[test]
    fn it_is_the_rational_row() {
        // Toy coordinates meet every tie; large ones every growth.
        for (class, high, pitch) in [(1, 9, 2), (2, 40, 8), (3, 1 << 45, 1 << 32)] {
            for index in 0..2000 {
                let mut words = Words::new(11, class, index);
                let mut point = || [(); 2].map(|()| words.between(-high, high));
                let triangle = [point(), point(), point()];
                let outline = Outline::new(triangle);
                for rule in Rule::ALL {
                    for row in 0..4 {
                        let y = triangle[0][1] + row * pitch / 2;
                        let (got, wanted) = (
                            outline.row(y, (pitch / 2, pitch), rule),
                            covered_row(triangle, (pitch / 2, y), pitch, rule),
                        );
                        assert_eq!(got, wanted, "{triangle:?} row {y} {rule:?}");
                    }
                }
            }
        }
    }
}
