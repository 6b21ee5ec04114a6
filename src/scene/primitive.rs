//! What can be drawn, as a caller gives it: before any profile has seen it.

use super::Triangle;
use crate::setup::{ClipTriangle, Polygon};

/// A primitive in the coordinates that `eval` takes. A model makes it ready, and draws it.
#[derive(Debug, Clone, PartialEq)]
pub enum Primitive {
    /// `v` or `f`: a triangle of integers or of reals.
    Triangle(Triangle),
    /// `words`: raw set-up registers as texts, in the profile's radix.
    Words(Vec<String>),
    /// `line`: two end points, in sub-pixels of the profile's input lattice.
    Line([[i128; 2]; 2]),
    /// `point`: x, y in sub-pixels of the profile's input lattice.
    Point([i128; 2]),
    /// `polygon`: three or more vertices, in sub-pixels of the profile's input lattice.
    Polygon(Polygon),
    /// `clip`: three homogeneous vertices.
    Clip(ClipTriangle),
    /// `position`: three vertices x, y, z, w in clip space, as a vertex shader gives them.
    Position(Positioned),
}

/// Three positions `[x, y, z, w]` in clip space, in binary32.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Positioned(pub [[f32; 4]; 3]);

impl Primitive {
    /// The key it is given under.
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Triangle(Triangle::Lattice { .. }) => "v",
            Self::Triangle(Triangle::Real { .. }) => "f",
            Self::Words(_) => "words",
            Self::Line(_) => "line",
            Self::Point(_) => "point",
            Self::Polygon(_) => "polygon",
            Self::Clip(_) => "clip",
            Self::Position(_) => "position",
        }
    }

    /// Whether its vertices have depth.
    pub const fn has_depth(&self) -> bool {
        match self {
            Self::Triangle(Triangle::Lattice { z, .. }) => z.is_some(),
            Self::Triangle(Triangle::Real { z, .. }) => z.is_some(),
            Self::Polygon(polygon) => polygon.z.is_some(),
            Self::Clip(triangle) => triangle.z.is_some(),
            Self::Words(_) | Self::Line(_) | Self::Point(_) | Self::Position(_) => false,
        }
    }
}
