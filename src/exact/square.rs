//! Squares that a triangle touches or holds: the oracle of spec clauses `CR-*`. By vertices, corners and
//! crossings; nothing here measures along an axis or an edge's normal.
//!
//! Growth: coordinates below 2^m in size make products below 2^(2m+3); m is at most 60.

/// A closed square with sides along the axes, in the units of the triangle that it is held against.
///
/// ```
/// use guardbit::exact::Square;
/// let pixel = Square { middle: [4, 4], half_side: 4 };
/// // A sliver between the samples touches the pixel, and holds no pixel at all.
/// let sliver = [[0, 7], [8, 7], [8, 8]];
/// assert!(pixel.touches(sliver) && !pixel.lies_in(sliver));
/// assert!(pixel.lies_in([[0, 0], [16, 0], [0, 16]]), "its corner (8, 8) is on the outline");
/// assert!(pixel.touches([[8, 8]; 3]), "a point on a corner");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Square {
    /// The point in its middle.
    pub middle: [i128; 2],
    /// From the middle to a side.
    pub half_side: i128,
}

/// On which side of the way from `p` to `q` the point `r` lies, and whether it lies on that line: 1, -1, 0.
fn side(p: [i128; 2], q: [i128; 2], r: [i128; 2]) -> i128 {
    let [d, e] = [q, r].map(|to| [to[0] - p[0], to[1] - p[1]]);
    (d[0] * e[1] - d[1] * e[0]).signum()
}

/// Whether a point is on a segment, ends included.
fn on_segment(p: [i128; 2], q: [i128; 2], r: [i128; 2]) -> bool {
    let between = |axis: usize| p[axis].min(q[axis]) <= r[axis] && r[axis] <= p[axis].max(q[axis]);
    side(p, q, r) == 0 && between(0) && between(1)
}

/// Whether two segments have a point in common.
fn cross([p, q]: [[i128; 2]; 2], [r, s]: [[i128; 2]; 2]) -> bool {
    let apart = |a, b, c, d| side(a, b, c) * side(a, b, d) < 0;
    (apart(p, q, r, s) && apart(r, s, p, q))
        || on_segment(p, q, r)
        || on_segment(p, q, s)
        || on_segment(r, s, p)
        || on_segment(r, s, q)
}

fn sides<const N: usize>(shape: [[i128; 2]; N]) -> [[[i128; 2]; 2]; N] {
    std::array::from_fn(|k| [shape[k], shape[(k + 1) % N]])
}

/// Whether a point is in a closed triangle, of either winding or without area.
fn holds(triangle: [[i128; 2]; 3], point: [i128; 2]) -> bool {
    let signs = sides(triangle).map(|[p, q]| side(p, q, point));
    let strictly = signs.iter().all(|sign| *sign == 1) || signs.iter().all(|sign| *sign == -1);
    strictly || sides(triangle).iter().any(|[p, q]| on_segment(*p, *q, point))
}

impl Square {
    /// The four corners, around.
    fn corners(self) -> [[i128; 2]; 4] {
        let ([x, y], h) = (self.middle, self.half_side);
        [[x - h, y - h], [x + h, y - h], [x + h, y + h], [x - h, y + h]]
    }

    /// Whether square and triangle have a point in common, sides and corners included. A triangle without area
    /// is the segment or the point that it is.
    pub fn touches(self, triangle: [[i128; 2]; 3]) -> bool {
        let ([x, y], h) = (self.middle, self.half_side);
        let in_square = |[vx, vy]: [i128; 2]| (vx - x).abs() <= h && (vy - y).abs() <= h;
        triangle.into_iter().any(in_square)
            || self.corners().into_iter().any(|corner| holds(triangle, corner))
            || sides(triangle)
                .into_iter()
                .any(|edge| sides(self.corners()).into_iter().any(|side| cross(edge, side)))
    }

    /// Whether every point of the square is in the triangle, its outline included: both are convex, so the
    /// corners say it. A triangle without area holds no square.
    pub fn lies_in(self, triangle: [[i128; 2]; 3]) -> bool {
        let [a, b, c] = triangle;
        side(a, b, c) != 0 && self.corners().into_iter().all(|corner| holds(triangle, corner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_touched_at_one_of_its_points() {
        // A common part has a vertex: a vertex of one shape, or a crossing of two sides. Slopes of these shapes
        // are quotients of 0 to 4, so every crossing is a point of the lattice of twelfths.
        const FINE: i128 = 12;
        let lattice: Vec<[i128; 2]> = (0..25).map(|n| [n % 5, n / 5]).collect();
        let square = Square { middle: [2, 2], half_side: 1 };
        let large = Square { middle: [2 * FINE, 2 * FINE], half_side: FINE };
        let mut touched = 0;
        for a in &lattice {
            for b in &lattice {
                for c in lattice.iter().step_by(3) {
                    let triangle = [*a, *b, *c];
                    let fine = triangle.map(|v| v.map(|x| x * FINE));
                    let points =
                        (FINE..=3 * FINE).flat_map(|y| (FINE..=3 * FINE).map(move |x| [x, y]));
                    let held = points.clone().filter(|p| holds(fine, *p)).count();
                    assert_eq!(large.touches(fine), square.touches(triangle), "{triangle:?}");
                    assert_eq!(square.touches(triangle), held > 0, "{triangle:?}");
                    let whole = (2 * FINE as usize + 1).pow(2);
                    assert_eq!(square.lies_in(triangle), held == whole, "{triangle:?}");
                    touched += u32::from(held > 0);
                }
            }
        }
        assert!(touched > 1000 && touched < 25 * 25 * 9);
    }
}
