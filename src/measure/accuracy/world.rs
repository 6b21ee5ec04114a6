//! What a depth error is worth in the world. Spec clause `M-6`.

use super::moment::Moments;
use crate::scene::Lens;

/// The depth range of a profile, and the camera that fills it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct World {
    /// The largest depth code.
    pub top: f64,
    lens: Option<Lens>,
}

impl World {
    /// The world behind codes up to `depth_max`.
    #[allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]
    pub fn new(depth_max: u64, lens: Option<Lens>) -> Self {
        Self { top: (depth_max as f64).max(1.0), lens }
    }

    /// The name of the unit.
    pub const fn unit(&self) -> &'static str {
        if self.lens.is_some() { "mesh unit" } else { "depth range" }
    }

    /// The world of a value whose range is everywhere worth the same.
    #[must_use]
    pub fn flat(&self) -> Self {
        Self { lens: None, ..*self }
    }

    /// A depth error of so many ULP at a part of the range, to first order.
    #[inline]
    pub fn depth(&self, ulp: f64, part: f64) -> f64 {
        ulp / self.top * self.lens.map_or(1.0, |lens| lens.steepness(part))
    }

    /// The most that an error of so many ULP can be worth anywhere: far away it is worth most.
    pub fn largest(&self, ulp: f64) -> f64 {
        self.depth(ulp, 0.0).max(self.depth(ulp, 1.0))
    }

    /// Whether an error is everywhere worth the same.
    pub const fn is_flat(&self) -> bool {
        self.lens.is_none()
    }

    /// Adds a run of errors and parts that both change in equal steps between their ends.
    #[inline]
    pub fn depth_run(&self, ulp: [f64; 2], part: [f64; 2], count: u32, into: &mut Moments) {
        let steps = f64::from(count.max(2) - 1);
        let (ulp_step, part_step) = ((ulp[1] - ulp[0]) / steps, (part[1] - part[0]) / steps);
        for n in 0..count {
            let n = f64::from(n);
            into.note(self.depth(ulp[0] + n * ulp_step, part[0] + n * part_step));
        }
    }
}
