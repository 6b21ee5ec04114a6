//! Primitives as callers give them, made ready for a model. Spec clauses `S-1` to `S-5`.

use super::Model;
use crate::cover::Segment;
use crate::machine::{DrawError, Input, WordsError};
use crate::scene;
use crate::setup::{
    ClipTriangle, Coordinate, Destination, Polygon, PositionError, Shape, Snapped, Triangle,
    VertexConfig, VertexError,
};
use crate::value::{ValueError, VertexValues};

/// A primitive that a model may draw. Only [`Model::prepare`] makes one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Primitive(pub(super) Kind);

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Triangle(Snapped<Triangle>),
    Shaded(Snapped<Triangle>, VertexValues),
    Clip(ClipTriangle),
    Polygon(Snapped<Polygon>),
    Line(Snapped<Segment>),
    Point(Snapped<[i128; 2]>),
    Words(Vec<u32>),
}

impl<'a> From<&'a Primitive> for Input<'a> {
    fn from(primitive: &'a Primitive) -> Self {
        match &primitive.0 {
            Kind::Triangle(shape) => Self::Triangle(shape),
            Kind::Shaded(shape, values) => Self::Shaded(shape, values),
            Kind::Clip(shape) => Self::Clip(shape),
            Kind::Polygon(shape) => Self::Polygon(shape),
            Kind::Line(shape) => Self::Line(shape),
            Kind::Point(shape) => Self::Point(shape),
            Kind::Words(words) => Self::Words(words),
        }
    }
}

impl Primitive {
    /// A triangle with what its vertices bring for channels.
    pub fn shaded(&self) -> Option<(&Snapped<Triangle>, &VertexValues)> {
        if let Kind::Shaded(triangle, values) = &self.0 { Some((triangle, values)) } else { None }
    }

    /// The register words of a machine that begins there.
    pub fn words(&self) -> Option<&[u32]> {
        if let Kind::Words(words) = &self.0 { Some(words) } else { None }
    }
}

/// Why a primitive was not drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PrimitiveError {
    /// A vertex lies outside its field.
    #[error(transparent)]
    Vertex(#[from] VertexError),
    /// Register words that are none.
    #[error("field `words`: {0}")]
    Words(#[from] WordsError),
    /// A position without a place in the window.
    #[error(transparent)]
    Position(#[from] PositionError),
    /// Positions for a profile without a viewport.
    #[error(
        "field `position`: the profile has no [viewport], which brings positions to the window; add the table, \
         or give `v` or `f`"
    )]
    NoViewport,
    /// Registers for a machine that begins at vertices.
    #[error(
        "field `words`: the machine of this profile takes primitives, not registers; give `v`, `f` or another primitive"
    )]
    NoRegisters,
    /// Depth for a profile that has none.
    #[error("field `{0}`: the profile has no [depth], so vertices must have no z; leave z out")]
    NoDepth(&'static str),
    /// Channels that do not go with those of the profile.
    #[error("field `channels`: {0}")]
    Values(#[from] ValueError),
    /// Channels for a profile that has none.
    #[error(
        "field `channels`: the profile has no [[channel]], so vertices must bring no channels; leave them out"
    )]
    NoChannels,
    /// The machine refused it.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

impl Model {
    /// Makes a primitive ready to be drawn: integers are checked, reals are snapped, register words
    /// are read in the profile's radix.
    ///
    /// # Errors
    /// [`PrimitiveError`] for a coordinate outside its field, for depth that the profile does not
    /// have, for words that are none.
    pub fn prepare(&self, primitive: &scene::Primitive) -> Result<Primitive, PrimitiveError> {
        if primitive.has_depth() && self.depth().is_none() {
            return Err(PrimitiveError::NoDepth(primitive.key()));
        }
        let grid = |point: &[i128; 2]| point.map(|value| self.profile.vertex.to_grid(value));
        Ok(Primitive(match primitive {
            scene::Primitive::Triangle(triangle) => Kind::Triangle(self.snap(triangle)?),
            scene::Primitive::Clip(triangle) => Kind::Clip(*triangle),
            scene::Primitive::Position(positions) => Kind::Triangle(self.position(positions)?),
            scene::Primitive::Polygon(Polygon { xy, z }) => {
                let xy = xy.iter().map(grid).collect();
                Kind::Polygon(self.place(Polygon { xy, z: z.clone() })?)
            }
            scene::Primitive::Line(ends) => {
                Kind::Line(self.place([grid(&ends[0]), grid(&ends[1])])?)
            }
            scene::Primitive::Point(point) => Kind::Point(self.place(grid(point))?),
            scene::Primitive::Words(words) => {
                let registers = self.registers().ok_or(PrimitiveError::NoRegisters)?;
                Kind::Words(registers.parse(words)?)
            }
        }))
    }

    /// Brings a scene's triangle to the profile's grid: integers are checked, reals are snapped.
    /// Depth is dropped where the profile has none.
    ///
    /// # Errors
    /// [`VertexError`] for a coordinate outside the field: never a wrap.
    pub fn snap(&self, triangle: &scene::Triangle) -> Result<Snapped<Triangle>, VertexError> {
        let has_depth = self.profile.depth.is_some();
        match triangle {
            scene::Triangle::Lattice { xy, z } => {
                let xy = xy.map(|point| point.map(|value| self.profile.vertex.to_grid(value)));
                self.place(Triangle { xy, z: z.filter(|_| has_depth) })
            }
            scene::Triangle::Real { xy, z } => {
                let (vertex, field) = (&self.profile.vertex, self.field.range());
                let codes = (0, i128::from(self.field.depth_max()));
                let mut snapped = [[0; 2]; 3];
                for (n, point) in xy.iter().enumerate() {
                    for (axis, value) in point.iter().enumerate() {
                        snapped[n][axis] = real(vertex, n, axis, *value, vertex.sub_pixel, field)?;
                    }
                }
                let z = z.filter(|_| has_depth).map(|z| -> Result<_, VertexError> {
                    let code = |n: usize| real(vertex, n, 2, z[n], 0, codes);
                    Ok([code(0)?, code(1)?, code(2)?])
                });
                self.place(Triangle { xy: snapped, z: z.transpose()? })
            }
        }
    }

    /// Brings positions in clip space through the viewport to the profile's grid. Spec clauses `FP-6` to `FP-9`.
    ///
    /// # Errors
    /// [`PrimitiveError`] without a viewport, for a w that is not positive, for a coordinate outside its field.
    pub fn position(
        &self,
        positions: &scene::Positioned,
    ) -> Result<Snapped<Triangle>, PrimitiveError> {
        let viewport = self.transform.ok_or(PrimitiveError::NoViewport)?;
        let has_depth = self.profile.depth.is_some();
        let field = Destination {
            vertex: &self.profile.vertex,
            ends: self.field.range(),
            depth_max: has_depth.then(|| self.field.depth_max()),
        };
        Ok(self.place(viewport.triangle(&positions.0, field)?)?)
    }

    /// A shape in the profile's own sub-pixels and depth codes, checked against its vertex field.
    ///
    /// # Errors
    /// [`VertexError::Outside`] names the first coordinate that does not fit: never a wrap.
    pub fn place<T: Shape>(&self, shape: T) -> Result<Snapped<T>, VertexError> {
        self.field.check(shape)
    }
}

fn real(
    vertex: &VertexConfig,
    n: usize,
    axis: usize,
    value: f64,
    fraction: u32,
    ends: (i128, i128),
) -> Result<i128, VertexError> {
    vertex.snap(Coordinate { key: "f", vertex: Some(n), axis }, value, fraction, ends)
}
