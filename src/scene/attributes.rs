//! What the vertices of a scene carry beside their place.

/// Values of every vertex of a scene, parallel to its triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// Distance from the eye of the three vertices of each triangle, in any one unit; empty where
    /// the scene has no camera.
    pub w: Vec<[f64; 3]>,
    /// The named values.
    pub sets: Vec<AttributeSet>,
}

/// Values of one name.
#[derive(Debug, Clone, PartialEq)]
pub struct AttributeSet {
    /// `texcoord`, `normal` or `color`.
    pub name: &'static str,
    /// Numbers of a vertex.
    pub components: usize,
    /// 3 x components numbers for each triangle, vertex by vertex; NaN where a vertex has none.
    pub values: Vec<f64>,
    /// The first place where a vertex has none.
    pub missing: Option<String>,
}

impl AttributeSet {
    /// A component at the three vertices of a triangle.
    pub fn at(&self, triangle: usize, component: usize) -> [f64; 3] {
        let first = 3 * self.components * triangle + component;
        [0, 1, 2].map(|vertex| self.values[first + vertex * self.components])
    }

    /// The same for these triangles alone.
    pub(super) fn of(&self, triangles: &[usize]) -> Self {
        let each = 3 * self.components;
        let values = triangles.iter().flat_map(|n| &self.values[each * n..][..each]);
        Self { values: values.copied().collect(), ..self.clone() }
    }
}
