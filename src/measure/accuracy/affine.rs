//! A plane as real numbers, from a sample that lies on it.
//!
//! Its constant is taken at a sample of the triangle and not at the window's corner: however steep
//! a sliver's plane is, over the triangle it stays within the values of its vertices, and so does
//! every sum formed here. Errors are then some 2^-50 of the range.

use super::reference::{RealFace, real, reference_grid};
use crate::cover::SampleGrid;
use crate::exact::PlaneNumerator;

/// Value at a base pixel, and change per pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    base: [u32; 2],
    value: f64,
    dx: f64,
    dy: f64,
}

impl Affine {
    /// An exact plane in real numbers, from the sample of pixel `base`.
    pub(super) fn exact(plane: &PlaneNumerator, grid: &SampleGrid, base: [u32; 2]) -> Self {
        let (whole, pixel) = (real(plane.whole), real(1 << grid.sub_pixel));
        let at = grid.position(base[0].into(), base[1].into());
        let [dx, dy] = plane.slope.map(|slope| real(slope) * pixel / whole);
        Self { base, value: real(plane.at(at)) / whole, dx, dy }
    }

    /// The plane of a triangle before it was snapped, with these values at its vertices; `None`
    /// without area.
    pub(super) fn before(
        face: &RealFace,
        vertex: [f64; 3],
        grid: &SampleGrid,
        base: [u32; 2],
    ) -> Option<Self> {
        let fine = reference_grid(grid);
        let at = fine.position(base[0].into(), base[1].into());
        let pixel = 1 << fine.sub_pixel;
        let value = |weights: [f64; 3]| {
            weights[0] * vertex[0] + weights[1] * vertex[1] + weights[2] * vertex[2]
        };
        let [right, down] = face.slopes(pixel);
        let plane =
            Self { base, value: value(face.weights(at)), dx: value(right), dy: value(down) };
        (plane.value.is_finite() && plane.dx.is_finite() && plane.dy.is_finite()).then_some(plane)
    }

    /// The pixel whose sample the plane is taken from.
    #[inline]
    pub const fn base(&self) -> [u32; 2] {
        self.base
    }

    /// The value at the sample of a pixel.
    #[inline]
    pub fn at(&self, x: u32, y: u32) -> f64 {
        let [right, down] = [(x, self.base[0]), (y, self.base[1])]
            .map(|(to, from)| f64::from(to) - f64::from(from));
        self.value + self.dx * right + self.dy * down
    }

    /// Every value times a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let Self { base, value, dx, dy } = self;
        Self { base, value: value * factor, dx: dx * factor, dy: dy * factor }
    }

    /// The difference of two planes with the same base.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        debug_assert_eq!(self.base, other.base, "one base");
        Self {
            base: self.base,
            value: self.value - other.value,
            dx: self.dx - other.dx,
            dy: self.dy - other.dy,
        }
    }
}
