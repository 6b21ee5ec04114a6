//! The plane through three vertex values. Spec clauses `P-1` to `P-5`.

use super::divide::Division;
use super::triangle::Triangle;
use crate::bits::Rounding;

/// The exact gradient of a value over a triangle: numerators over twice the area.
///
/// `dz/dx = x / area2` and `dz/dy = y / area2` per sub-pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gradient {
    /// Numerator of the x slope.
    pub x: i128,
    /// Numerator of the y slope.
    pub y: i128,
    /// Twice the area, positive.
    pub area2: i128,
    /// A vertex and its value.
    pub anchor: ([i128; 2], i128),
}

impl Gradient {
    /// The gradient of `z` over a normalised triangle of positive area.
    pub fn new(triangle: &Triangle, z: [i128; 3]) -> Self {
        let [[x0, y0], [x1, y1], [x2, y2]] = triangle.xy;
        let (z1, z2) = (z[1] - z[0], z[2] - z[0]);
        Self {
            x: z1 * (y2 - y0) - z2 * (y1 - y0),
            y: (x1 - x0) * z2 - (x2 - x0) * z1,
            area2: triangle.area2(),
            anchor: (triangle.xy[0], z[0]),
        }
    }
}

/// A plane in accumulator units of 2^-fraction ULP: start at pixel (0, 0) and the two slopes per
/// pixel, unreduced. The word is these mod 2^N.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane {
    /// Value at the sample of pixel (0, 0) of the window.
    pub start: i128,
    /// Change per pixel to the right.
    pub dx: i128,
    /// Change per row downward.
    pub dy: i128,
}

impl Plane {
    /// Rounds the exact plane: the start once, each slope once. `sample` is the sample's offset in
    /// its pixel and `sub_pixel` the grid, so a pixel is `2^sub_pixel` sub-pixels.
    ///
    /// Growth: the start's numerator has d + 2(k + s) + 4 bits before it is scaled by 2^F.
    pub fn round(
        gradient: &Gradient,
        sample: [i128; 2],
        sub_pixel: u32,
        fraction: u32,
        rounding: Rounding,
        division: Division,
    ) -> Self {
        let divider = division.by(gradient.area2);
        let ([x0, y0], z0) = gradient.anchor;
        let offset = gradient.x * (sample[0] - x0) + gradient.y * (sample[1] - y0);
        let start = match division {
            // The exact plane, rounded once.
            Division::Quotient => divider.apply(z0 * gradient.area2 + offset, fraction, rounding).0,
            // The same reciprocal as the slopes, or the error grows with the distance from the
            // window's corner instead of the triangle's size.
            Division::Reciprocal { .. } => {
                (z0 << fraction) + divider.apply(offset, fraction, rounding).0
            }
        };
        let slope = |numerator| divider.apply(numerator, sub_pixel + fraction, rounding).0;
        Self { start, dx: slope(gradient.x), dy: slope(gradient.y) }
    }

    /// The same for a plane given by its value at pixel (0, 0) and its slopes per sub-pixel, all
    /// over `whole > 0`: what homogeneous set-up makes, where no vertex need have a value.
    pub fn over(
        [start, x, y]: [i128; 3],
        whole: i128,
        sub_pixel: u32,
        fraction: u32,
        rounding: Rounding,
        division: Division,
    ) -> Self {
        let divider = division.by(whole);
        let slope = |numerator| divider.apply(numerator, sub_pixel + fraction, rounding).0;
        Self { start: divider.apply(start, fraction, rounding).0, dx: slope(x), dy: slope(y) }
    }

    /// The unwrapped value at pixel (x, y).
    #[inline]
    pub fn at(&self, x: i128, y: i128) -> i128 {
        self.start + self.dx * x + self.dy * y
    }
}
