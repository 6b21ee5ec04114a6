//! Where a triangle of a scene stands in its file.

use std::fmt;

/// Where a triangle stands in the file of its scene: what a message names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// A line, from 1.
    Line(usize),
    /// A face of a PLY mesh, from 0.
    Face(usize),
    /// A facet of a binary STL mesh, from 0.
    Facet(usize),
    /// A triangle of a primitive of a glTF file, all from 0.
    Primitive {
        /// The node that draws it.
        node: usize,
        /// The mesh of the node.
        mesh: usize,
        /// The primitive of the mesh.
        primitive: usize,
        /// The triangle of the primitive.
        triangle: usize,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Face(face) => write!(f, "face {face} (from 0)"),
            Self::Facet(facet) => write!(f, "facet {facet} (from 0)"),
            Self::Primitive { node, mesh, primitive, triangle } => {
                write!(
                    f,
                    "nodes[{node}]: meshes[{mesh}].primitives[{primitive}]: triangle {triangle} (from 0)"
                )
            }
        }
    }
}
