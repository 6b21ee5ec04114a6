//! `knot`: a tube along a trefoil, which is the (2, 3) curve on a torus.

use crate::scene::camera::{add, cross, times, unit};
use crate::scene::mesh::Point;
use crate::scene::sine::circle;

use super::quad;

/// Stations along the curve, and corners around the tube.
const ALONG: u16 = 125;
const AROUND: u16 = 12;

/// Radii of the torus the curve lies on, and of the tube.
const MAJOR: f64 = 2.0;
const MINOR: f64 = 1.0;
const TUBE: f64 = 0.4;

/// 2 * 125 * 12 = 3000 triangles, closed: each edge belongs to two.
pub(super) fn mesh() -> Vec<[Point; 3]> {
    (0..ALONG)
        .flat_map(|i| (0..AROUND).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            quad([surface(i, j), surface(i + 1, j), surface(i + 1, j + 1), surface(i, j + 1)])
        })
        .collect()
}

/// A point of the tube. `circle` reduces whole turns in integers, so the seams close exactly.
fn surface(i: u16, j: u16) -> Point {
    let [cos2, sin2] = circle(2 * i, ALONG);
    let [cos3, sin3] = circle(3 * i, ALONG);
    let [cos, sin] = circle(j, AROUND);
    let reach = MAJOR + MINOR * cos3;
    // The torus's normal is square to the curve; with the tangent it gives a frame without twist.
    let normal = [cos3 * cos2, cos3 * sin2, sin3];
    let meridian = [-sin3 * cos2, -sin3 * sin2, cos3];
    let tangent = unit(add(times(3.0 * MINOR, meridian), times(2.0 * reach, [-sin2, cos2, 0.0])));
    let binormal = cross(tangent, normal);
    let centre = [reach * cos2, reach * sin2, MINOR * sin3];
    add(centre, times(TUBE, add(times(cos, normal), times(sin, binormal))))
}
