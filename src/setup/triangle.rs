//! A triangle on the sub-pixel grid, normalised to positive area. Spec clauses `T-1` to `T-3`.

/// Three vertices in sub-pixels, window origin top left, y down, and their depths if any.
///
/// After [`Triangle::normalised`] twice the signed area is positive and inside is `E > 0`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// `[x, y]` of each vertex, in sub-pixels.
    pub xy: [[i128; 2]; 3],
    /// Depth of each vertex in ULPs of the depth format.
    pub z: Option<[i128; 3]>,
}

impl Triangle {
    /// Twice the signed area, in sub-pixels squared. Growth: 2p + 1 bits for p-bit differences.
    pub fn area2(&self) -> i128 {
        let [[x0, y0], [x1, y1], [x2, y2]] = self.xy;
        (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    }

    /// The same triangle with positive area: v1 and v2 change places if it is negative.
    #[must_use]
    pub fn normalised(self) -> Self {
        if self.area2() >= 0 {
            return self;
        }
        let [a, b, c] = self.xy;
        Self { xy: [a, c, b], z: self.z.map(|[a, b, c]| [a, c, b]) }
    }

    /// Smallest and largest coordinate on an axis (0 for x, 1 for y).
    pub fn extent(&self, axis: usize) -> (i128, i128) {
        let [a, b, c] = self.xy.map(|vertex| vertex[axis]);
        (a.min(b).min(c), a.max(b).max(c))
    }
}
