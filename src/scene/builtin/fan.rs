//! `fan`: a rectangle tiled without gap or overlap, by a fan above and a strip below.
//!
//! Every coordinate is a multiple of 1/4 pixel, so a profile with two sub-pixel bits or more snaps
//! exactly and each sample of the rectangle must be hit once. The outline lies on pixel centres,
//! where the fill rule decides; the fan's vertex never does.

use crate::scene::mesh::Point;
use crate::scene::{Triangle, Viewport};

/// Edges along each side of the fan's rectangle, and cells of the strip.
const PARTS: u16 = 16;

/// The corners of the tiling in quarters of pixels: all integers, exact in a double.
struct Outline {
    left: f64,
    right: f64,
    top: f64,
    /// Between fan and strip.
    seam: f64,
    bottom: f64,
}

/// First and last quarter of a side: on pixel centres, about a 16th from the border.
fn inset(side: f64) -> [f64; 2] {
    if side < 2.0 {
        return [0.0, 4.0 * side];
    }
    let first = (side / 16.0).floor() * 4.0 + 2.0;
    [first, 4.0 * side - first]
}

/// `part / whole` of the way in whole quarters. A product of 16 and 2^18 is exact.
fn between(from: f64, to: f64, part: u16, whole: u16) -> f64 {
    from + ((to - from) * f64::from(part) / f64::from(whole)).floor()
}

/// 64 triangles around one vertex, then 32 of the strip that shares the fan's lower side.
///
/// In a window of a few pixels neighbours fall together and triangles have no area; they still tile.
pub(super) fn triangles(viewport: &Viewport) -> Vec<Triangle> {
    let [width, height] = viewport.size();
    let ([left, right], [top, bottom]) = (inset(width), inset(height));
    let outline = Outline { left, right, top, seam: between(top, bottom, 3, 4), bottom };
    let rim: Vec<Point> = (0..4 * PARTS).map(|k| outline.rim(k, viewport)).collect();
    let hub = [
        odd(f64::midpoint(left, right)),
        odd(f64::midpoint(top, outline.seam)),
        viewport.depth(1, 2),
    ];
    let next = rim.iter().cycle().skip(1);
    let fan = rim.iter().zip(next).map(|(&from, &to)| [hub, from, to]);
    let strip = (0..PARTS).flat_map(|k| {
        let [upper, upper_next] = [k, k + 1].map(|k| outline.seam(k, viewport));
        let [lower, lower_next] = [k, k + 1].map(|k| outline.foot(k, viewport));
        super::quad([upper, upper_next, lower_next, lower])
    });
    fan.chain(strip).map(|v| Triangle::real(v.map(pixels))).collect()
}

/// The odd integer at or above the floor: never a pixel centre, which is 2 mod 4.
fn odd(quarters: f64) -> f64 {
    (quarters / 2.0).floor() * 2.0 + 1.0
}

fn pixels([x, y, z]: Point) -> Point {
    [x / 4.0, y / 4.0, z]
}

impl Outline {
    /// The fan's rim, clockwise in the window from the top left corner.
    fn rim(&self, k: u16, viewport: &Viewport) -> Point {
        let part = k % PARTS;
        match k / PARTS {
            0 => {
                let x = between(self.left, self.right, part, PARTS);
                [x, self.top, viewport.depth(part, PARTS)]
            }
            1 => {
                let y = between(self.top, self.seam, part, PARTS);
                [self.right, y, viewport.depth(PARTS - part, PARTS)]
            }
            // Leftwards, over the very points that the strip begins with.
            2 => self.seam(PARTS - part, viewport),
            _ => {
                let y = between(self.top, self.seam, PARTS - part, PARTS);
                [self.left, y, 0.0]
            }
        }
    }

    /// The line between fan and strip, from the left.
    fn seam(&self, k: u16, viewport: &Viewport) -> Point {
        // Up from 0 and down again, as the rim's ends on both sides have it.
        let z = viewport.depth(k.min(PARTS - k), PARTS);
        [between(self.left, self.right, k, PARTS), self.seam, z]
    }

    /// The lower side of the strip, from the left: half a cell off at first, so that cells lean.
    fn foot(&self, k: u16, viewport: &Viewport) -> Point {
        let lean = if k == 0 || k == PARTS { 2 * k } else { 2 * k - 1 };
        let x = between(self.left, self.right, lean, 2 * PARTS);
        [x, self.bottom, viewport.depth(k, PARTS)]
    }
}
