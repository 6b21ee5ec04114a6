//! `slivers`: long thin triangles in all directions.

use crate::scene::sine::circle;
use crate::scene::{Triangle, Viewport};

/// Pairs of directions: a multiple of 4, so that axes and diagonals are among the 96 directions.
const DIRECTIONS: u16 = 48;

/// Two a pair: one with its tip at the rim and, half a step on, one with its tip in the middle.
///
/// Widths go from 2 pixels down to 1/64 by halves; at most a 16th of the window's shorter side, so
/// that the base, whose middle is 15/16 of the way to the border, stays inside.
pub(super) fn triangles(viewport: &Viewport) -> Vec<Triangle> {
    let half = viewport.size().map(|side| side / 2.0);
    let widest = (half[0].min(half[1]) / 8.0).min(2.0);
    (0..DIRECTIONS)
        .flat_map(|direction| {
            let width = widest / f64::from(1_u32 << (direction % 8));
            [
                sliver(viewport, half, direction, width, true),
                sliver(viewport, half, direction, width, false),
            ]
        })
        .collect()
}

fn sliver(
    viewport: &Viewport,
    half: [f64; 2],
    direction: u16,
    width: f64,
    tip_inside: bool,
) -> Triangle {
    let turn = 2 * direction + u16::from(tip_inside);
    let [cos, sin] = circle(turn, 2 * DIRECTIONS);
    let [x, y] = [half[0] * cos, half[1] * sin];
    let length = (x * x + y * y).sqrt();
    let aside = [-y / length * width / 2.0, x / length * width / 2.0];
    let at = |reach: f64, side: f64, z| {
        [half[0] + reach * x + side * aside[0], half[1] + reach * y + side * aside[1], z]
    };
    let near = viewport.depth(direction, DIRECTIONS);
    let far = viewport.depth_max_real();
    let (tip, base) =
        if tip_inside { (1.0 / 16.0, 15.0 / 16.0) } else { (15.0 / 16.0, 1.0 / 16.0) };
    Triangle::real([at(tip, 0.0, far), at(base, -1.0, near), at(base, 1.0, 0.0)])
}
