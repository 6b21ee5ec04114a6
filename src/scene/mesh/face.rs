//! Faces of more than three corners as triangles.

use super::Point;
use crate::scene::camera::{add, cross, sub};
use earcut::Earcut;

/// Sides that cross: the first corner of each, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crossing(pub(super) [usize; 2]);

/// The triangles of a face, as numbers of its corners: a fan from the first corner where the face is convex,
/// otherwise ears cut off one by one. A face is looked at along its normal's largest axis.
///
/// # Errors
/// [`Crossing`] for a face that crosses itself.
pub(super) fn triangles(corners: &[Point]) -> Result<Vec<[usize; 3]>, Crossing> {
    let fan = || (2..corners.len()).map(|n| [0, n - 1, n]).collect();
    if corners.len() <= 3 {
        return Ok(fan());
    }
    let Some(flat) = flat(corners) else { return Ok(fan()) };
    if let Some(crossing) = crossing(&flat) {
        return Err(crossing);
    }
    let at = |n: usize| flat[n % flat.len()];
    let turns = (0..flat.len()).map(|n| turn(at(n), at(n + 1), at(n + 2)));
    let (mut left, mut right) = (false, false);
    for turn in turns {
        left |= turn > 0.0;
        right |= turn < 0.0;
    }
    if !(left && right) {
        return Ok(fan());
    }
    let (mut places, none): (Vec<usize>, [usize; 0]) = (Vec::new(), []);
    Earcut::new().earcut(flat.iter().copied(), &none, &mut places);
    Ok(places.chunks_exact(3).map(|ear| [ear[0], ear[1], ear[2]]).collect())
}

/// The corners without the axis that the face is turned to most; nothing for a face without area.
fn flat(corners: &[Point]) -> Option<Vec<[f64; 2]>> {
    let normal = corners.windows(2).fold([0.0; 3], |sum, pair| {
        add(sum, cross(sub(pair[0], corners[0]), sub(pair[1], corners[0])))
    });
    let size = normal.map(f64::abs);
    let largest = size.into_iter().fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // The axis that is dropped, and those that stay.
    let axes = if size[2] >= largest {
        [0, 1]
    } else if size[1] >= largest {
        [0, 2]
    } else {
        [1, 2]
    };
    Some(corners.iter().map(|corner| axes.map(|axis| corner[axis])).collect())
}

/// Above 0 where the way from a over b to c turns left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
}

/// Two sides that cross each other at a point inside both.
fn crossing(flat: &[[f64; 2]]) -> Option<Crossing> {
    let count = flat.len();
    let side = |n: usize| (flat[n], flat[(n + 1) % count]);
    let apart = |(a, b): ([f64; 2], [f64; 2]), (c, d)| {
        let (one, two) = (turn(a, b, c), turn(a, b, d));
        (one > 0.0 && two < 0.0) || (one < 0.0 && two > 0.0)
    };
    for one in 0..count {
        for two in one + 2..count {
            if apart(side(one), side(two)) && apart(side(two), side(one)) {
                return Some(Crossing([one, two]));
            }
        }
    }
    None
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;

    fn flat_face(xy: &[[f64; 2]]) -> Vec<Point> {
        xy.iter().map(|[x, y]| [*x, *y, 0.0]).collect()
    }

    /// Twice the area of each triangle, with its sign.
    fn areas(corners: &[Point], triangles: &[[usize; 3]]) -> Vec<f64> {
        let at = |n: usize| [corners[n][0], corners[n][1]];
        triangles.iter().map(|[a, b, c]| turn(at(*a), at(*b), at(*c))).collect()
    }

    #[test]
    fn a_concave_face_is_covered_once() {
        let arrow = flat_face(&[[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [20.0, 10.0], [0.0, 40.0]]);
        let found = triangles(&arrow).unwrap();
        let areas = areas(&arrow, &found);
        assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
        // The square less the notch.
        assert!((areas.iter().sum::<f64>() - 2.0 * (1600.0 - 600.0)).abs() < 1e-9);
        assert_eq!(found.len(), 3);
    }

    #[test]
    fn a_convex_face_is_a_fan_from_any_side() {
        let square = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!(triangles(&square).unwrap(), [[0, 1, 2], [0, 2, 3]]);
        let line = [[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [0.0; 3]];
        assert_eq!(triangles(&line).unwrap().len(), 2);
        let twice = flat_face(&[[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        assert_eq!(triangles(&twice).unwrap().len(), 3);
    }

    #[test]
    fn a_face_that_crosses_itself_is_refused() {
        let bow = flat_face(&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0], [-9.0, 2.0]]);
        assert_eq!(triangles(&bow).unwrap_err(), Crossing([0, 2]));
    }
}
