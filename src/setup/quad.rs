//! Quadrilaterals as two triangles. Spec clause `Y-3`.

/// Which two corners of a quadrilateral A B C D are connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diagonal {
    /// A and C.
    Ac,
    /// B and D.
    Bd,
}

impl Diagonal {
    /// The pair of opposite corners whose normals have the greater dot product, A and C on a tie:
    /// normals that agree lie on one surface, and the edge between them does not cross its crease.
    ///
    /// The normals are those given with the object, of any length shared by all four, and are not
    /// transformed: a quadrilateral split by turned ones would change its diagonal from frame to frame.
    ///
    /// Growth: components below 2^62 in size.
    pub fn of(normals: [[i128; 3]; 4]) -> Self {
        let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let [a, b, c, d] = normals;
        if dot(b, d) > dot(a, c) { Self::Bd } else { Self::Ac }
    }

    /// The two triangles of a quadrilateral, both in its own winding.
    pub fn split<V: Copy>(self, [a, b, c, d]: [V; 4]) -> [[V; 3]; 2] {
        match self {
            Self::Ac => [[a, b, c], [a, c, d]],
            Self::Bd => [[a, b, d], [b, c, d]],
        }
    }
}
