//! `extremes`: the triangles at which words overflow and rules are settled.

use crate::scene::mesh::Point;
use crate::scene::{Triangle, Viewport};

/// Half the window, then the other half; corners; one pixel; no area; steepest slopes.
pub(super) fn triangles(viewport: &Viewport) -> Vec<Triangle> {
    let [w, h] = viewport.size();
    let far = viewport.depth_max_real();
    // The top left corner of the pixel in the middle.
    let [cx, cy] = [w, h].map(|side| ((side - 1.0) / 2.0).floor());
    // x, y beside depths of 0 or 1 of the range.
    let flat = |xy: [[f64; 2]; 3], z: [f64; 3]| -> [Point; 3] {
        let [[a, b], [c, d], [e, f]] = xy;
        [[a, b, z[0] * far], [c, d, z[1] * far], [e, f, z[2] * far]]
    };
    let pixel = [[cx, cy], [cx + 1.0, cy], [cx, cy + 1.0]];
    let (near, deep) = ([0.0; 3], [1.0; 3]);
    [
        // The window in two halves, once in each winding: largest areas and edge values.
        flat([[0.0, 0.0], [w, 0.0], [0.0, h]], near),
        flat([[w, h], [w, 0.0], [0.0, h]], deep),
        // The whole depth range across the whole window, in x, in y and askew.
        flat([[0.0, 0.0], [w, 0.0], [0.0, h]], [0.0, 1.0, 0.0]),
        flat([[0.0, 0.0], [w, h], [0.0, h]], [0.0, 1.0, 1.0]),
        flat([[w, 0.0], [0.0, h / 2.0], [w, h]], [1.0, 0.0, 1.0]),
        // One pixel in each corner of the window.
        flat([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], near),
        flat([[w, 0.0], [w - 1.0, 0.0], [w, 1.0]], deep),
        flat([[0.0, h], [1.0, h], [0.0, h - 1.0]], deep),
        flat([[w, h], [w - 1.0, h], [w, h - 1.0]], near),
        // One pixel in the middle: the steepest slopes, falling and rising, in x, in y, in both.
        flat(pixel, [0.0, 1.0, 0.0]),
        flat(pixel, [1.0, 0.0, 1.0]),
        flat(pixel, [0.0, 0.0, 1.0]),
        flat(pixel, [1.0, 1.0, 0.0]),
        flat(pixel, [1.0, 0.0, 0.0]),
        flat(pixel, [0.0, 1.0, 1.0]),
        // A quarter of a pixel around its centre, and one beside the centre that covers nothing.
        flat(
            [[cx + 0.25, cy + 0.25], [cx + 0.75, cy + 0.5], [cx + 0.25, cy + 0.75]],
            [0.0, 1.0, 1.0],
        ),
        flat([[cx, cy], [cx + 0.25, cy], [cx, cy + 0.25]], [0.0, 1.0, 1.0]),
        // One row high across the window, one column wide down it: steepest across the thin side.
        flat([[0.0, cy], [w, cy], [w, cy + 1.0]], [0.0, 0.0, 1.0]),
        flat([[cx, 0.0], [cx + 1.0, h], [cx, h]], [0.0, 1.0, 0.0]),
        // From corner to corner, a pixel wide at one end.
        flat([[0.0, 0.0], [w, h], [w - 1.0, h]], [0.0, 1.0, 0.0]),
        // No area: a point, a doubled vertex, three points of a line, askew and level.
        flat([[cx, cy]; 3], deep),
        flat([[0.0, 0.0], [w, h], [w, h]], [0.0, 1.0, 0.0]),
        flat([[0.0, 0.0], [w / 2.0, h / 2.0], [w, h]], [0.0, 1.0, 1.0]),
        flat([[0.0, cy + 0.5], [w, cy + 0.5], [w / 2.0, cy + 0.5]], [1.0, 0.0, 1.0]),
    ]
    .into_iter()
    .map(Triangle::real)
    .collect()
}
