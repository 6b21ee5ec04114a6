//! Depth bias, or polygon offset: state of a draw call, not of a rasterizer. Spec clause `Z-7`.

use crate::bits::Rounding;
use crate::format::Unreduced;
use crate::setup::Plane;

/// What is added to every depth of a triangle: `constant r + slope max(|dz/dx|, |dz/dy|)`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DepthBias {
    /// A number of units r.
    pub constant: i128,
    /// r in ULP: 1 in Direct3D, where a unit is one code; 1 or 2 in Vulkan, whose smallest resolvable
    /// difference is at most 2 codes of a fixed-point buffer.
    pub unit: u32,
    /// A multiple of the larger slope a pixel, in 1/256.
    pub slope: i128,
    /// The bias is no larger than this many ULP if it is positive, no smaller if it is negative; 0
    /// is no limit.
    pub clamp: i128,
}

impl DepthBias {
    /// The bias of a plane, in its units, its slope term rounded once; to be added to the start.
    ///
    /// Growth: the slope's bits plus those of the multiple.
    pub fn of(&self, plane: &Plane, rounding: Rounding) -> Unreduced {
        let ([_, dx, dy], fraction) = (plane.raw(), plane.start().fraction());
        let steepest = dx.abs().max(dy.abs());
        let (sloped, _) = rounding.shift_right(self.slope * steepest, 8);
        let bias = ((self.constant * i128::from(self.unit)) << fraction) + sloped;
        let held = match self.clamp.signum() {
            1 => bias.min(self.clamp << fraction),
            -1 => bias.max(self.clamp << fraction),
            _ => bias,
        };
        Unreduced::new(held, fraction)
    }
}
