//! Triangles that are neither projected nor clipped: edge functions and values straight from
//! homogeneous vertices. Spec clause `A-8`.

use super::triangle::Triangle;

/// Three homogeneous vertices. `[X, Y, W]` stands for the window position `(X / W, Y / W)` in
/// sub-pixels where W > 0; W may be zero or negative, and such a vertex lies beside or behind the
/// eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipTriangle {
    /// `[X, Y, W]` of each vertex.
    pub xyw: [[i128; 3]; 3],
    /// Z of each vertex: Z / W is its depth in ULPs of the depth format.
    pub z: Option<[i128; 3]>,
}

/// A linear function over the window: `a x + b y + c`, x and y in sub-pixels.
pub type Linear = [i128; 3];

/// The value of a linear function at a point in sub-pixels.
#[inline]
pub fn linear_at(f: &Linear, [x, y]: [i128; 2]) -> i128 {
    f[0] * x + f[1] * y + f[2]
}

fn cross(u: [i128; 3], v: [i128; 3]) -> Linear {
    // In the order of (y, x, w): with W = 1 this is the edge function from u to v, y down.
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// A homogeneous triangle of positive determinant, ready to be drawn.
///
/// With v0, v1, v2 the vertices and p = (x, y, 1) a sample, the edge function of v0v1 is the triple
/// product of v0, v1 and p. All three are positive exactly where p is a positive combination of the
/// vertices: where the sample sees the triangle in front of the eye. Nothing is divided, so a W of
/// zero is no special case.
///
/// Growth: p-bit coordinates give edge coefficients of 2p + 1 bits and a determinant of 3p + 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipSetup {
    /// Edge functions of v0v1, v1v2, v2v0.
    pub edges: [Linear; 3],
    /// The triple product of the vertices, positive.
    pub determinant: i128,
    /// Z / W over the window, times the determinant: linear, and a clip-plane distance.
    pub depth: Option<Linear>,
}

impl ClipTriangle {
    /// A projected triangle: every W is 1.
    pub fn projected(triangle: &Triangle) -> Self {
        Self { xyw: triangle.xy.map(|[x, y]| [x, y, 1]), z: triangle.z }
    }

    /// Edge functions and depth; `None` for a triangle without area, or seen from its own plane.
    pub fn setup(&self) -> Option<ClipSetup> {
        let [v0, mut v1, mut v2] = self.xyw;
        let mut z = self.z;
        let mut first = cross(v0, v1);
        let mut determinant = first[0] * v2[0] + first[1] * v2[1] + first[2] * v2[2];
        if determinant < 0 {
            (v1, v2) = (v2, v1);
            z = z.map(|[a, b, c]| [a, c, b]);
            first = cross(v0, v1);
            determinant = -determinant;
        }
        if determinant == 0 {
            return None;
        }
        let edges = [first, cross(v1, v2), cross(v2, v0)];
        let depth = z.map(|[z0, z1, z2]| {
            std::array::from_fn(|k| edges[1][k] * z0 + edges[2][k] * z1 + edges[0][k] * z2)
        });
        Some(ClipSetup { edges, determinant, depth })
    }
}
