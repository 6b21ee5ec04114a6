//! What the vertices of a scene carry beside their place.

use super::Shading;

/// What every vertex of a scene carries, parallel to its triangles.
#[derive(Debug, Clone, PartialEq)]
pub enum Attributes {
    /// Reals by name, as a mesh has them.
    Mesh {
        /// Distance from the eye of the three vertices of each triangle, in any one unit; 1 where the
        /// camera has no perspective, empty where the scene has no camera.
        w: Vec<[f64; 3]>,
        /// The named values.
        sets: Vec<AttributeSet>,
    },
    /// What each triangle brings by itself, as JSON Lines give it.
    Lines(Vec<Option<Shading>>),
}

impl Default for Attributes {
    fn default() -> Self {
        Self::Mesh { w: Vec::new(), sets: Vec::new() }
    }
}

impl Attributes {
    /// What w is at the vertices of a triangle, in any one unit, where the scene says it.
    pub fn w(&self, triangle: usize) -> Option<[f64; 3]> {
        match self {
            Self::Mesh { w, .. } => w.get(triangle).copied(),
            Self::Lines(lines) => match lines.get(triangle)?.as_ref()? {
                Shading::Reals { w, .. } => *w,
                #[expect(clippy::cast_precision_loss, reason = "a code of 1/w has at most 32 bits")]
                Shading::Codes { inverse_w, .. } => inverse_w.map(|q| q.map(|q| 1.0 / q as f64)),
            },
        }
    }

    /// Whether no vertex has a value of any name.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Mesh { sets, .. } => sets.is_empty(),
            Self::Lines(lines) => lines.iter().all(Option::is_none),
        }
    }
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
    /// What the first triangle with a vertex that has none lacks, in words.
    pub missing: Option<String>,
}

impl AttributeSet {
    /// A set without values so far.
    pub(super) fn new(name: &'static str, components: usize) -> Self {
        Self { name, components, values: Vec::new(), missing: None }
    }

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
