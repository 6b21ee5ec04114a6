//! What depth means in the world: the distance that a depth code stands for.

/// The near and far plane of a camera, in the units of the mesh it looks at.
///
/// Depth is Z/w, linear in the window: at the part p of the depth range, 0 near and 1 far, the
/// distance from the eye is near far / (far - p (far - near)).
///
/// ```
/// use guardbit::scene::Lens;
/// let lens = Lens { near: 1.0, far: 10.0 };
/// assert_eq!((lens.distance(0.0), lens.distance(1.0)), (1.0, 10.0));
/// // Nine tenths of the codes lie nearer than 5.3.
/// assert!((lens.distance(0.9) - 10.0 / 1.9).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lens {
    /// Distance of the near plane.
    pub near: f64,
    /// Distance of the far plane; it may be infinite.
    pub far: f64,
}

impl Lens {
    /// Distance from the eye at a part of the depth range.
    pub fn distance(&self, part: f64) -> f64 {
        if self.far.is_infinite() {
            return self.near / (1.0 - part);
        }
        self.near * self.far / (self.far - part * (self.far - self.near))
    }

    /// Change of the distance per whole depth range, at a part of it: what turns a small depth
    /// error into a distance.
    pub fn steepness(&self, part: f64) -> f64 {
        let distance = self.distance(part);
        if self.far.is_infinite() {
            return distance * distance / self.near;
        }
        distance * distance * ((self.far - self.near) / (self.near * self.far))
    }

    /// The same with a far plane for what measures the whole range: 2^20 times as far as the near one where it
    /// is infinite.
    #[must_use]
    pub fn finite(self) -> Self {
        let far = if self.far.is_infinite() { self.near * 1_048_576.0 } else { self.far };
        Self { far, ..self }
    }
}
