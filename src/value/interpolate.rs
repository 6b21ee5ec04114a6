//! Attributes over a triangle: affine, and in perspective by several means. Spec clauses `I-1` to
//! `I-7`.

use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::setup::{Division, Gradient, Plane, Triangle};

/// How an attribute is interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// A plane of the attribute: wrong where w changes.
    Affine,
    /// Planes of u/w and 1/w, divided at each fragment.
    Divide,
    /// The same with a reciprocal of 1/w and a multiplication.
    Reciprocal {
        /// Bits of the reciprocal, 2 to 40.
        bits: u32,
    },
    /// Barycentric coordinates with the products of w, divided at each fragment.
    Barycentric,
    /// 1/w taken once a row, at the middle of the span: exact where w is constant along rows.
    ConstantW,
}

/// Bits of an interpolated attribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InterpolationConfig {
    /// By which means.
    pub by: Interpolation,
    /// Fraction bits of planes, coordinates and results, 1 to 24.
    pub fraction: u32,
    /// Rounding of everything that is rounded.
    pub rounding: Rounding,
}

/// Why an attribute cannot be interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InterpolationError {
    /// A vertex at or behind the eye: the triangle has to be clipped or drawn from homogeneous
    /// vertices.
    #[error(
        "w of vertex {vertex} is {w}: perspective needs 0 < w <= 65536; clip the triangle first"
    )]
    W {
        /// Which vertex.
        vertex: usize,
        /// Its w.
        w: i128,
    },
    /// An attribute outside its words.
    #[error("u of vertex {vertex} is {u}: 0 <= u < 65536 is needed for an attribute")]
    U {
        /// Which vertex.
        vertex: usize,
        /// Its attribute.
        u: i128,
    },
    /// No area.
    #[error("the triangle has no area, so an attribute has no plane")]
    Area,
    /// Bits outside the arithmetic.
    #[error(
        "fraction = {fraction}, reciprocal bits = {bits}: 1 <= fraction <= 24 and 2 <= reciprocal bits <= 40 are needed"
    )]
    Bits {
        /// Fraction bits.
        fraction: u32,
        /// Bits of the reciprocal, or 2.
        bits: u32,
    },
    /// A vertex field too wide for exact set-up.
    #[error("vertex difference bits = {0}: the set-up of attributes needs <= 26")]
    Field(u32),
}

/// An attribute over one triangle, set up.
#[derive(Clone, Copy, Debug)]
pub struct Interpolator {
    config: InterpolationConfig,
    grid: SampleGrid,
    /// u, or u/w times the scale.
    over: Plane,
    /// 1/w times the scale; 1 for affine.
    inverse: Plane,
    /// Edge functions opposite v0, v1, v2, and what each is worth: the product of the other two w.
    shares: [[i128; 3]; 3],
    u: [i128; 3],
}

impl Interpolator {
    /// Sets up values `u` and eye distances `w` at the vertices of a triangle.
    ///
    /// The scale of 1/w is the power of two that keeps it below 1 at all vertices: a product of two w
    /// below 2^S is kept over 2^S.
    ///
    /// # Errors
    /// [`InterpolationError`] names the violated inequality; nothing panics at or behind the eye.
    pub fn new(
        config: InterpolationConfig,
        triangle: &Triangle,
        grid: SampleGrid,
        u: [i128; 3],
        w: [i128; 3],
    ) -> Result<Self, InterpolationError> {
        let InterpolationConfig { by, fraction, rounding } = config;
        let bits = if let Interpolation::Reciprocal { bits } = by { bits } else { 2 };
        if !(1..=24).contains(&fraction) || !(2..=40).contains(&bits) {
            return Err(InterpolationError::Bits { fraction, bits });
        }
        for vertex in 0..3 {
            if !(1..=1 << 16).contains(&w[vertex]) {
                return Err(InterpolationError::W { vertex, w: w[vertex] });
            }
            if !(0..1 << 16).contains(&u[vertex]) {
                return Err(InterpolationError::U { vertex, u: u[vertex] });
            }
        }
        let extent = |axis| {
            let (low, high) = triangle.extent(axis);
            low.unsigned_abs().max(high.unsigned_abs())
        };
        let difference = 1 + u128::BITS - extent(0).max(extent(1)).leading_zeros();
        if difference > 26 {
            return Err(InterpolationError::Field(difference));
        }
        // Vertices change places together with what they carry.
        let turned = triangle.area2() < 0;
        let swap = |v: [i128; 3]| if turned { [v[0], v[2], v[1]] } else { v };
        let (triangle, u, w) = (triangle.normalised(), swap(u), swap(w));
        if triangle.area2() == 0 {
            return Err(InterpolationError::Area);
        }
        let q = [w[1] * w[2], w[2] * w[0], w[0] * w[1]];
        let scale = i128::BITS - q.iter().fold(0, |all, q| all | q).leading_zeros();
        let plane = |values: [i128; 3], scale: u32| {
            let gradient = Gradient::new(&triangle, values);
            let ([x0, y0], z0) = gradient.anchor;
            let [ox, oy] = grid.offset;
            let start = z0 * gradient.area2 + gradient.x * (ox - x0) + gradient.y * (oy - y0);
            let numerators = [start, gradient.x, gradient.y];
            let whole = gradient.area2 << scale;
            Plane::over(numerators, whole, grid.sub_pixel, fraction, rounding, Division::Quotient)
        };
        let over = if by == Interpolation::Affine {
            plane(u, 0)
        } else {
            plane([u[0] * q[0], u[1] * q[1], u[2] * q[2]], scale)
        };
        let inverse = plane(q, scale);
        let edges = crate::setup::edges(&triangle);
        // Opposite v0 lies the edge from v1 to v2.
        let shares = [1, 2, 0].map(|k: usize| [edges[k].a, edges[k].b, edges[k].c]);
        let shares = std::array::from_fn(|k| shares[k].map(|part| part * q[k]));
        Ok(Self { config, grid, over, inverse, shares, u })
    }

    /// The attribute at pixel (x, y) in units of 2^-fraction; `span` is the first and last pixel of its
    /// row, for a constant w. `None` where 1/w has been rounded to zero or below: beyond the horizon.
    pub fn at(&self, x: u32, y: u32, span: [u32; 2]) -> Option<i128> {
        let InterpolationConfig { by, fraction, rounding } = self.config;
        let (px, py) = (i128::from(x), i128::from(y));
        let over = self.over.at(px, py).raw();
        match by {
            Interpolation::Affine => Some(over),
            Interpolation::Divide => self.divided(over, self.inverse.at(px, py).raw()),
            Interpolation::ConstantW => {
                let middle = i128::from(span[0]) + i128::from(span[1] - span[0]) / 2;
                self.divided(over, self.inverse.at(middle, py).raw())
            }
            Interpolation::Reciprocal { bits } => {
                let inverse = self.inverse.at(px, py).raw();
                (inverse > 0).then(|| {
                    Division::Reciprocal { bits }.by(inverse).apply(over, fraction, rounding).0
                })
            }
            Interpolation::Barycentric => {
                let [sx, sy] = self.grid.position(px, py);
                let part = self.shares.map(|[a, b, c]| a * sx + b * sy + c);
                let whole = part[0] + part[1] + part[2];
                let share = |k: usize| rounding.divide(part[k] << fraction, whole);
                let (b1, b2) = (share(1)?.0, share(2)?.0);
                let [u0, u1, u2] = self.u;
                (whole > 0).then(|| (u0 << fraction) + b1 * (u1 - u0) + b2 * (u2 - u0))
            }
        }
    }

    fn divided(&self, over: i128, inverse: i128) -> Option<i128> {
        let InterpolationConfig { fraction, rounding, .. } = self.config;
        if inverse <= 0 {
            return None;
        }
        Some(rounding.divide(over << fraction, inverse)?.0)
    }

    /// du/dx and du/dy at pixel (x, y) by the quotient rule, as numerators over one denominator:
    /// (over' inverse - over inverse') / inverse^2, in attribute units a pixel. `None` at the horizon.
    pub fn derivatives(&self, x: u32, y: u32) -> Option<([i128; 2], i128)> {
        let (px, py) = (i128::from(x), i128::from(y));
        let ([_, over_dx, over_dy], [_, dx, dy]) = (self.over.raw(), self.inverse.raw());
        if self.config.by == Interpolation::Affine {
            return Some(([over_dx, over_dy], 1 << self.config.fraction));
        }
        let (over, inverse) = (self.over.at(px, py).raw(), self.inverse.at(px, py).raw());
        let slope = |d: i128, e: i128| d * inverse - over * e;
        let slopes = [slope(over_dx, dx), slope(over_dy, dy)];
        (inverse > 0).then_some((slopes, inverse * inverse))
    }

    /// The differences that the 2x2 quad of pixel (x, y) makes along x and y, in units of
    /// 2^-fraction; `None` at the horizon.
    pub fn quad_differences(&self, x: u32, y: u32) -> Option<[i128; 2]> {
        let (x0, y0) = (x & !1, y & !1);
        let span = [x0, x0 + 1];
        let across = self.at(x0 + 1, y, span)? - self.at(x0, y, span)?;
        let down = self.at(x, y0 + 1, span)? - self.at(x, y0, span)?;
        Some([across, down])
    }
}
