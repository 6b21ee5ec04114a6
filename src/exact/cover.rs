//! Exact coverage from where a triangle's outline crosses a row. The oracle of spec clauses `C-*`.

use super::edge::{edge_value, edge_x};
use super::number::{Point, Rational, integer};
use num_traits::{ToPrimitive, Zero};

/// Where a point lies in a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Position {
    /// Strictly inside.
    Inside,
    /// On an edge or a vertex.
    OnEdge,
    /// Outside; everything is, for a triangle without area.
    Outside,
}

/// Which samples on an edge belong to the triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Left edges own their samples, right ones do not; among horizontal edges the top one does.
    TopLeft,
    /// Right edges own their samples, left ones do not; among horizontal edges the top one does.
    Shadow,
}

impl Rule {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::TopLeft, Self::Shadow];
}

/// Whether `triangle` covers `sample`, for either winding.
///
/// Both rules are one idea: the triangle covers the sample that lies an infinitesimal step away,
/// downward by less than any step to the side. Downward makes each edge half-open from its upper
/// end, so a row crosses the outline twice or not at all; the step to the side decides a sample
/// that lies on a crossing.
pub fn covers(triangle: [[i128; 2]; 3], sample: impl Into<Point>, rule: Rule) -> bool {
    let sample = sample.into();
    let Some([left, right]) = crossings(triangle, &sample.y) else {
        return false;
    };
    match rule {
        Rule::TopLeft => left <= sample.x && sample.x < right,
        Rule::Shadow => left < sample.x && sample.x <= right,
    }
}

/// The samples `x + n * pitch` of row `y` that `triangle` covers, as a half-open range of n.
pub fn covered_row(
    triangle: [[i128; 2]; 3],
    (x, y): (i128, i128),
    pitch: i128,
    rule: Rule,
) -> Option<(i128, i128)> {
    let steps = crossings(triangle, &integer(y))?.map(|at| (at - integer(x)) / integer(pitch));
    let first = steps.map(|at| match rule {
        // The first sample at or right of a crossing, or the first one beyond it.
        Rule::TopLeft => at.ceil(),
        Rule::Shadow => at.floor() + integer(1),
    });
    Some((first[0].to_integer().to_i128()?, first[1].to_integer().to_i128()?))
}

/// Whether `point` is inside `triangle`, on its outline, or outside.
pub fn classify(triangle: [[i128; 2]; 3], point: impl Into<Point>) -> Position {
    let point = point.into();
    let [a, b, c] = triangle;
    if edge_value(a, b, c).is_zero() {
        Position::Outside
    } else if on_outline(triangle, &point) {
        Position::OnEdge
    } else if covers(triangle, point, Rule::TopLeft) {
        // Off the outline both rules agree.
        Position::Inside
    } else {
        Position::Outside
    }
}

/// The two x at which the row just below `y` leaves the outside, the smaller one first.
fn crossings(triangle: [[i128; 2]; 3], y: &Rational) -> Option<[Rational; 2]> {
    let [a, b, c] = triangle;
    let mut crossed = [[a, b], [b, c], [c, a]].into_iter().filter_map(|[from, to]| {
        let (top, bottom) = if from[1] <= to[1] { (from, to) } else { (to, from) };
        let reached = Point::from(top).y <= *y && *y < Point::from(bottom).y;
        if reached { edge_x(top, bottom, y.clone()) } else { None }
    });
    let (first, second) = (crossed.next()?, crossed.next()?);
    Some(if first <= second { [first, second] } else { [second, first] })
}

fn on_outline(triangle: [[i128; 2]; 3], point: &Point) -> bool {
    let [a, b, c] = triangle;
    [[a, b], [b, c], [c, a]].into_iter().any(|[from, to]| {
        let [p, q] = [from, to].map(Point::from);
        let between = |low: &Rational, value: &Rational, high: &Rational| {
            (low <= value && value <= high) || (high <= value && value <= low)
        };
        between(&p.y, &point.y, &q.y)
            && between(&p.x, &point.x, &q.x)
            && edge_x(from, to, point.y.clone()).is_none_or(|x| x == point.x)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_the_samples_it_covers() {
        let triangle = [[1, 0], [17, 5], [3, 13]];
        for rule in Rule::ALL {
            for y in -1..15 {
                let (first, end) = covered_row(triangle, (1, y), 2, rule).unwrap_or((0, 0));
                for n in -3..12 {
                    let inside = first <= n && n < end;
                    assert_eq!(inside, covers(triangle, [1 + 2 * n, y], rule), "{rule:?} {y} {n}");
                }
            }
        }
    }

    /// A square's two halves, both windings.
    const HALVES: [[[i128; 2]; 3]; 4] = [
        [[0, 0], [4, 0], [0, 4]],
        [[4, 0], [4, 4], [0, 4]],
        [[0, 4], [4, 0], [0, 0]],
        [[0, 4], [4, 4], [4, 0]],
    ];

    #[test]
    fn the_outline_belongs_to_top_and_left() {
        let upper = HALVES[0];
        for triangle in [upper, HALVES[2]] {
            assert!(covers(triangle, [0, 0], Rule::TopLeft));
            assert!(covers(triangle, [0, 2], Rule::TopLeft), "left edge");
            assert!(covers(triangle, [2, 0], Rule::TopLeft), "top edge");
            assert!(!covers(triangle, [2, 2], Rule::TopLeft), "right edge");
            assert!(covers(triangle, [2, 2], Rule::Shadow), "right edge");
            assert!(!covers(triangle, [0, 2], Rule::Shadow), "left edge");
            assert!(covers(triangle, [2, 0], Rule::Shadow), "top edge");
        }
        assert!(!covers(HALVES[1], [2, 4], Rule::TopLeft), "bottom edge");
        assert!(!covers(HALVES[1], [2, 4], Rule::Shadow), "bottom edge");
    }

    #[test]
    fn halves_of_a_square_share_out_its_samples() {
        for rule in Rule::ALL {
            for y in 0..4 {
                for x in 0..=4 {
                    let hits = (0..2).filter(|k| covers(HALVES[*k], [x, y], rule)).count();
                    let owned = if rule == Rule::TopLeft { x < 4 } else { x > 0 };
                    assert_eq!(hits, usize::from(owned), "({x}, {y}) {rule:?}");
                }
            }
        }
    }

    #[test]
    fn no_area_covers_nothing() {
        for line in [[[0, 0], [2, 2], [4, 4]], [[0, 0], [4, 0], [1, 0]], [[3, 3]; 3]] {
            for p in [[0, 0], [1, 0], [2, 2], [3, 3]] {
                assert!(Rule::ALL.iter().all(|rule| !covers(line, p, *rule)));
                assert_eq!(classify(line, p), Position::Outside);
            }
        }
    }

    #[test]
    fn classification_is_orientation_by_three_signs() {
        // The textbook test, on every triangle of a 4 x 4 lattice and every half-lattice point.
        let cross = |a: [i128; 2], b: [i128; 2], p: [i128; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        let lattice: Vec<[i128; 2]> = (0..9).map(|n| [2 * (n % 3), 2 * (n / 3)]).collect();
        for a in &lattice {
            for b in &lattice {
                for c in &lattice {
                    for y in 0..=4 {
                        for x in 0..=4 {
                            let signs = [cross(*a, *b, [x, y]), cross(*b, *c, [x, y])]
                                .into_iter()
                                .chain([cross(*c, *a, [x, y])])
                                .map(|e| e.signum() * cross(*a, *b, *c).signum())
                                .min();
                            let expected = match signs {
                                Some(1) => Position::Inside,
                                Some(0) if cross(*a, *b, *c) != 0 => Position::OnEdge,
                                _ => Position::Outside,
                            };
                            let halved = [a, b, c].map(|v| v.map(|n| n / 2));
                            assert_eq!(classify(halved, Point::dyadic([x, y], 1)), expected);
                        }
                    }
                }
            }
        }
    }
}
