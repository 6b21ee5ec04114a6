//! Diamond exit by its definition. The oracle of spec clause `L-4`.

use super::number::{Rational, dyadic, integer};
use num_traits::{One, Signed, Zero};

/// Which points of a diamond's border belong to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diamond {
    /// Both lower edges and the bottom corner; the right corner for y-major lines (Direct3D).
    LowerEdges,
    /// None, and the line is moved by -(e, e^2) with e = 2^-40 pixels (Vulkan): small enough for
    /// coordinates with up to 8 fraction bits on windows of up to 2^12 pixels.
    Perturbed,
}

/// Whether the line from `from` to `to`, in pixels, leaves the diamond of pixel (x, y): whether it has
/// a point in it, and its end is not.
///
/// ```
/// use guardbit::exact::{Diamond, dyadic, exits};
/// let at = |x, y| [dyadic(x, 1), dyadic(y, 1)];
/// // From the centre of pixel (0, 0) to that of (2, 0): two diamonds are left, not the last.
/// let hit = |x| exits(Diamond::LowerEdges, at(1, 1), at(5, 1), [x, 0]);
/// assert_eq!([0, 1, 2].map(hit), [true, true, false]);
/// ```
pub fn exits(diamond: Diamond, from: [Rational; 2], to: [Rational; 2], [x, y]: [i128; 2]) -> bool {
    let shift = match diamond {
        Diamond::LowerEdges => [Rational::zero(), Rational::zero()],
        Diamond::Perturbed => [dyadic(1, 40), dyadic(1, 80)],
    };
    let moved = |p: [Rational; 2]| {
        let [px, py] = p;
        [px - &shift[0], py - &shift[1]]
    };
    let (from, to) = (moved(from), moved(to));
    let half = dyadic(1, 1);
    let centre = [integer(x) + &half, integer(y) + &half];
    let y_major = (&to[1] - &from[1]).abs() > (&to[0] - &from[0]).abs();
    let inside = |p: &[Rational; 2]| {
        let [dx, dy] = [&p[0] - &centre[0], &p[1] - &centre[1]];
        let size = dx.abs() + dy.abs();
        if size != half || diamond == Diamond::Perturbed {
            return size < half;
        }
        // On the border: below the centre, or the right corner.
        dy.is_positive() || (y_major && dy.is_zero() && dx.is_positive())
    };
    // Membership changes only where the way meets one of the four border lines.
    let way = |t: &Rational| [0, 1].map(|k: usize| &from[k] + (&to[k] - &from[k]) * t);
    let mut parts = vec![Rational::zero(), Rational::one()];
    for (sx, sy) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let side = |p: &[Rational; 2]| {
            integer(sx) * (&p[0] - &centre[0]) + integer(sy) * (&p[1] - &centre[1]) - &half
        };
        let (a, b) = (side(&from), side(&to));
        let by = &b - &a;
        if !by.is_zero() {
            parts.push(-a / by);
        }
    }
    parts.retain(|t| !t.is_negative() && *t <= Rational::one());
    parts.sort();
    let between: Vec<Rational> = parts.windows(2).map(|w| (&w[0] + &w[1]) * &half).collect();
    parts.extend(between);
    !inside(&to) && parts.iter().any(|t| inside(&way(t)))
}
