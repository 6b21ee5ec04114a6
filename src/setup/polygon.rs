//! A polygon on the sub-pixel grid.

/// Vertices in drawing order, closed by the edge from the last to the first; any shape, any
/// winding, repeated and collinear points allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygon {
    /// `[x, y]` of each vertex, in sub-pixels.
    pub xy: Vec<[i128; 2]>,
    /// Depth of each vertex in ULPs of the depth format; as many as vertices.
    pub z: Option<Vec<i128>>,
}

impl Polygon {
    /// The edges, each with the depths at its ends.
    pub fn edges(&self) -> impl Iterator<Item = ([[i128; 2]; 2], Option<[i128; 2]>)> {
        let count = self.xy.len();
        (0..count).map(move |k| {
            let next = (k + 1) % count;
            let z = self.z.as_ref().and_then(|z| Some([*z.get(k)?, *z.get(next)?]));
            ([self.xy[k], self.xy[next]], z)
        })
    }

    /// Smallest and largest coordinate on an axis; `(0, -1)` without vertices.
    pub fn extent(&self, axis: usize) -> (i128, i128) {
        let values = || self.xy.iter().map(|vertex| vertex[axis]);
        (values().min().unwrap_or(0), values().max().unwrap_or(-1))
    }
}
