//! The plane through three vertex values. Spec clauses `P-1` to `P-5`.

use super::divide::Division;
use super::triangle::Triangle;
use crate::bits::{Rounding, Width as _, Word};
use crate::dda::Planar;
use crate::format::{FractionMismatch, QFormat, Unreduced, same_fraction};

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
    /// The gradient of `z` over a normalised triangle. Over one without area, the value of vertex 0 is that of
    /// every point (clause `CR-4`).
    pub fn new(triangle: &Triangle, z: [i128; 3]) -> Self {
        let (anchor, area2) = ((triangle.xy[0], z[0]), triangle.area2());
        if area2 == 0 {
            return Self { x: 0, y: 0, area2: 1, anchor };
        }
        let [[x0, y0], [x1, y1], [x2, y2]] = triangle.xy;
        let (z1, z2) = (z[1] - z[0], z[2] - z[0]);
        Self {
            x: z1 * (y2 - y0) - z2 * (y1 - y0),
            y: (x1 - x0) * z2 - (x2 - x0) * z1,
            area2,
            anchor,
        }
    }

    /// The value at a point in sub-pixels, times `area2`.
    #[inline]
    pub const fn numerator(&self, at: [i128; 2]) -> i128 {
        let ([x0, y0], z0) = self.anchor;
        z0 * self.area2 + self.x * (at[0] - x0) + self.y * (at[1] - y0)
    }
}

/// A plane before it is cut to words: its value at the sample of pixel (0, 0) and its two slopes per
/// pixel, all in units of 2^-fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plane {
    fraction: u32,
    start: i128,
    dx: i128,
    dy: i128,
}

impl Plane {
    /// A plane of these values.
    ///
    /// # Errors
    /// [`FractionMismatch`] if they do not count the same units.
    pub fn new(start: Unreduced, dx: Unreduced, dy: Unreduced) -> Result<Self, FractionMismatch> {
        let fraction = start.fraction();
        same_fraction(fraction, dx.fraction())?;
        same_fraction(fraction, dy.fraction())?;
        Ok(Self { fraction, start: start.raw(), dx: dx.raw(), dy: dy.raw() })
    }

    /// Zero everywhere.
    pub const fn zero(fraction: u32) -> Self {
        Self { fraction, start: 0, dx: 0, dy: 0 }
    }

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
        Self { fraction, start, dx: slope(gradient.x), dy: slope(gradient.y) }
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
        let start = divider.apply(start, fraction, rounding).0;
        Self { fraction, start, dx: slope(x), dy: slope(y) }
    }

    /// The plane whose values are all higher by `bias`.
    ///
    /// # Errors
    /// [`FractionMismatch`] if the bias counts other units.
    #[inline]
    pub fn raised(self, bias: Unreduced) -> Result<Self, FractionMismatch> {
        same_fraction(self.fraction, bias.fraction())?;
        Ok(Self { start: self.start + bias.raw(), ..self })
    }

    /// Start, dx and dy in units of `2^-fraction`.
    #[inline]
    pub const fn raw(&self) -> [i128; 3] {
        [self.start, self.dx, self.dy]
    }

    /// Start, dx and dy.
    #[inline]
    pub fn values(&self) -> [Unreduced; 3] {
        self.raw().map(|raw| Unreduced::new(raw, self.fraction))
    }

    /// Value at the sample of pixel (0, 0) of the window.
    #[inline]
    pub const fn start(&self) -> Unreduced {
        Unreduced::new(self.start, self.fraction)
    }

    /// Change per pixel to the right.
    #[inline]
    pub const fn dx(&self) -> Unreduced {
        Unreduced::new(self.dx, self.fraction)
    }

    /// Change per row downward.
    #[inline]
    pub const fn dy(&self) -> Unreduced {
        Unreduced::new(self.dy, self.fraction)
    }

    /// The unwrapped value at pixel (x, y).
    #[inline]
    pub const fn at(&self, x: i128, y: i128) -> Unreduced {
        Unreduced::new(self.start + self.dx * x + self.dy * y, self.fraction)
    }

    /// The plane as a register walks it: each value mod 2^N.
    ///
    /// # Errors
    /// [`FractionMismatch`] if the word counts other units.
    pub fn words(&self, format: QFormat) -> Result<Planar<QFormat>, FractionMismatch> {
        same_fraction(self.fraction, format.fraction())?;
        let word = |value: i128| Word::wrapping(format, value);
        let (start, dx, dy) = (word(self.start), word(self.dx), word(self.dy));
        Ok(Planar::try_new(start, dx, dy).unwrap_or_else(|error| unreachable!("{error}")))
    }
}
