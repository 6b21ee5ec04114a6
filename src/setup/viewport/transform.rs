//! The way of a triangle through the viewport. Spec clauses `FP-6` to `FP-9`.

use super::{
    ClipDepth, DepthClamp, DivisionByW, PositionError, Transform, Viewport, ViewportConfig,
};
use crate::bits::Rounding;
use crate::setup::snap::{Coordinate, VertexConfig, VertexError, snap_f64};
use crate::setup::triangle::Triangle;

/// Where the vertices of a positioned triangle go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Destination<'a> {
    /// The vertex grid.
    pub vertex: &'a VertexConfig,
    /// Ends of the vertex field, in sub-pixels.
    pub ends: (i128, i128),
    /// The largest depth code; `None` without depth.
    pub depth_max: Option<u64>,
}

impl Viewport {
    /// The triangle of three positions `[x, y, z, w]` in clip space.
    ///
    /// # Errors
    /// [`PositionError`] for a w that is not positive, and for a coordinate outside its field.
    pub fn triangle(
        &self,
        xyzw: &[[f32; 4]; 3],
        field: Destination<'_>,
    ) -> Result<Triangle, PositionError> {
        let mut triangle = Triangle { xy: [[0; 2]; 3], z: field.depth_max.map(|_| [0; 3]) };
        for (vertex, [x, y, z, w]) in xyzw.iter().enumerate() {
            // NaN is not positive either.
            if !(*w > 0.0 && w.is_finite()) {
                return Err(PositionError::W { vertex, w: (*w).into() });
            }
            let [x, y, z] = self.divided([*x, *y, *z], *w);
            let place = |axis| Coordinate { key: "position", vertex: Some(vertex), axis };
            for (axis, value) in [x, y].into_iter().enumerate() {
                triangle.xy[vertex][axis] = self.coordinate(place(axis), axis, value, &field)?;
            }
            if let (Some(depth), Some(maximum)) = (&mut triangle.z, field.depth_max) {
                depth[vertex] = self.depth(place(2), z, maximum, field.vertex)?;
            }
        }
        Ok(triangle)
    }

    /// Clause `FP-6`.
    fn divided(&self, values: [f32; 3], w: f32) -> [f32; 3] {
        match self.config.division {
            DivisionByW::Quotient => values.map(|value| value / w),
            DivisionByW::Reciprocal => {
                let reciprocal = 1.0 / w;
                values.map(|value| value * reciprocal)
            }
        }
    }

    /// Clauses `FP-7` and `FP-8`.
    fn coordinate(
        &self,
        place: Coordinate,
        axis: usize,
        value: f32,
        field: &Destination<'_>,
    ) -> Result<i128, VertexError> {
        let (vertex, ends) = (field.vertex, field.ends);
        let Transform::Fixed { fraction, rounding } = self.config.transform else {
            // Sides of at most 2^17 halves are exact in binary32.
            #[expect(clippy::cast_precision_loss, reason = "at most 19 bits")]
            let [half, centre] =
                [self.size[axis], self.centre2[axis]].map(|twice| twice as f32 / 2.0);
            let window = self.sum(value, half, centre);
            return vertex.snap(place, window.into(), vertex.sub_pixel, ends);
        };
        let Some(divided) = snap_f64(value.into(), fraction, rounding).filter(|n| is_moderate(*n))
        else {
            return vertex.snap(place, endless(value).into(), vertex.sub_pixel, ends);
        };
        // In units of 2^-(fraction + 1) pixels.
        let window =
            (i128::from(self.centre2[axis]) << fraction) + divided * i128::from(self.size[axis]);
        let (from, to) = (fraction + 1, vertex.sub_pixel);
        let code = if from >= to {
            vertex.snap.shift_right(window, from - to).0
        } else {
            window << (to - from)
        };
        place.within(code, ends)
    }

    /// Clause `FP-9`.
    fn depth(
        &self,
        place: Coordinate,
        value: f32,
        maximum: u64,
        vertex: &VertexConfig,
    ) -> Result<i128, VertexError> {
        let code = if let Transform::Fixed { fraction, rounding } = self.config.transform {
            self.fixed_depth(value, (fraction, rounding), maximum, vertex.snap)
        } else {
            unorm(self.window_depth(value), maximum, vertex.snap)
        };
        match code {
            Some(code) => place.within(code, (0, i128::from(maximum))),
            None => vertex.snap(place, endless(value).into(), 0, (0, i128::from(maximum))),
        }
    }

    /// The code in fixed point; `None` for a number without a place on any grid.
    fn fixed_depth(
        &self,
        value: f32,
        (fraction, rounding): (u32, Rounding),
        maximum: u64,
        snap: Rounding,
    ) -> Option<i128> {
        let ViewportConfig { near, far, clamp, depth, .. } = self.config;
        let code = |end: f32| unorm(end, maximum, snap).unwrap_or_default();
        let (near, far) = (code(near.into()), code(far.into()));
        let moderate = snap_f64(value.into(), fraction, rounding).filter(|n| is_moderate(*n));
        // Under a clamp it is only beyond one of the planes.
        let beyond = clamp == DepthClamp::Vertex && !value.is_nan();
        let largest = if value > 0.0 { MODERATE } else { -MODERATE };
        let n = moderate.or(beyond.then_some(largest))?;
        let (n, fraction) = match depth {
            ClipDepth::ZeroToOne => (n, fraction),
            ClipDepth::MinusOneToOne => (n + (1 << fraction), fraction + 1),
        };
        let code = snap.shift_right((near << fraction) + n * (far - near), fraction).0;
        Some(match clamp {
            DepthClamp::None => code,
            DepthClamp::Vertex => code.clamp(near.min(far), near.max(far)),
        })
    }

    /// Depth in the window, in binary32.
    fn window_depth(&self, value: f32) -> f32 {
        let ViewportConfig { near, far, clamp, depth, .. } = self.config;
        let (near, far) = (f32::from(near), f32::from(far));
        #[expect(clippy::manual_midpoint, reason = "the clause rounds the sum")]
        let (scale, offset) = match depth {
            ClipDepth::ZeroToOne => (far - near, near),
            ClipDepth::MinusOneToOne => ((far - near) / 2.0, (far + near) / 2.0),
        };
        let window = self.sum(value, scale, offset);
        match clamp {
            // What is not a number is not between two of them.
            DepthClamp::Vertex if !window.is_nan() => window.clamp(near.min(far), near.max(far)),
            _ => window,
        }
    }

    /// Product and sum, rounded once or twice.
    fn sum(&self, value: f32, scale: f32, offset: f32) -> f32 {
        match self.config.transform {
            Transform::Fused => value.mul_add(scale, offset),
            _ => value * scale + offset,
        }
    }
}

/// The largest divided coordinate within exact 128-bit arithmetic: it leaves room for a product with a depth of 2^64.
const MODERATE: i128 = 1 << 60;

const fn is_moderate(value: i128) -> bool {
    value.unsigned_abs() <= MODERATE.unsigned_abs()
}

/// What a number without a place stands for: its infinity, or NaN.
const fn endless(value: f32) -> f32 {
    if value.is_nan() { value } else { f32::INFINITY.copysign(value) }
}

/// `value` times the largest code, rounded once; `None` without a place on any grid.
fn unorm(value: f32, maximum: u64, rounding: Rounding) -> Option<i128> {
    // 24 bits at 2^-149 and above; a value that matters is at most 2^24.
    let (bits, fraction) = (value.to_bits(), value.to_bits() & 0x7f_ffff);
    let exponent = bits >> 23 & 0xff;
    if exponent == 0xff || value.abs() > 16_777_216.0 {
        return None;
    }
    let magnitude = i128::from(if exponent == 0 { fraction } else { fraction | 0x80_0000 });
    let signed = if bits >> 31 == 1 { -magnitude } else { magnitude };
    let product = signed * i128::from(maximum);
    let shift = 150 - exponent.max(1);
    Some(if shift > 126 {
        // Every product below 2^88 is far below half a code here: only its sign counts.
        rounding.shift_right(product.signum(), 2).0
    } else {
        rounding.shift_right(product, shift).0
    })
}
