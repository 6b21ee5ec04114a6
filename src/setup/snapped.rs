//! Shapes whose coordinates were checked against a vertex field. Nothing else can be drawn.
//! Spec clause `S-2`.

use super::polygon::Polygon;
use super::snap::{Coordinate, VertexConfig, VertexError};
use super::triangle::Triangle;
use std::ops::Deref;

/// What a coordinate may be: the sub-pixel grid, its ends, and the depth codes.
///
/// Two fields are equal if every shape of one is a shape of the other, on the same grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexField {
    low: i64,
    high: i64,
    sub_pixel: u32,
    depth_max: u64,
}

impl VertexField {
    /// The field of a vertex configuration, with depth codes `0 <= z <= depth_max`.
    ///
    /// # Errors
    /// [`VertexError`] if the configuration is malformed.
    pub fn new(vertex: &VertexConfig, depth_max: u64) -> Result<Self, VertexError> {
        vertex.validate()?;
        let (low, high) = vertex.range();
        // A valid field has at most 32 bits, and a closed one ends at 2^32.
        let end = |value: i128| {
            i64::try_from(value).map_err(|_| VertexError::Field {
                integer: vertex.integer,
                sub_pixel: vertex.sub_pixel,
            })
        };
        Ok(Self { low: end(low)?, high: end(high)?, sub_pixel: vertex.sub_pixel, depth_max })
    }

    /// Lowest and highest coordinate, in sub-pixels.
    pub fn range(&self) -> (i128, i128) {
        (self.low.into(), self.high.into())
    }

    /// Bits below the pixel.
    pub fn sub_pixel(&self) -> u32 {
        self.sub_pixel
    }

    /// The largest depth code, or 0 without depth.
    pub fn depth_max(&self) -> u64 {
        self.depth_max
    }

    /// Whether a shape of another field is one of this field, too: the same grid and ends, and the
    /// same depth codes where both have depth. Without depth, nobody looks at a depth code.
    #[inline]
    pub const fn takes(&self, other: &Self) -> bool {
        let no_depth = self.depth_max == 0 || other.depth_max == 0;
        self.low == other.low
            && self.high == other.high
            && self.sub_pixel == other.sub_pixel
            && (self.depth_max == other.depth_max || no_depth)
    }

    /// The shape, if all its coordinates lie in this field.
    ///
    /// # Errors
    /// [`VertexError::Outside`] names the first coordinate that does not: never a wrap.
    pub fn check<T: Shape>(&self, shape: T) -> Result<Snapped<T>, VertexError> {
        let (low, high) = self.range();
        for (coordinate, value) in shape.coordinates() {
            let (low, high) =
                if coordinate.axis == 2 { (0, self.depth_max.into()) } else { (low, high) };
            coordinate.within(value, (low, high))?;
        }
        Ok(Snapped { shape, field: *self })
    }
}

/// A shape with coordinates in sub-pixels of a grid.
pub trait Shape {
    /// Each coordinate with its place in a message: x and y in sub-pixels, depth in codes.
    fn coordinates(&self) -> impl Iterator<Item = (Coordinate, i128)>;
}

/// x, y and z of vertices, under the key of `eval`.
fn vertices<'a>(
    key: &'static str,
    xy: &'a [[i128; 2]],
    z: Option<&'a [i128]>,
) -> impl Iterator<Item = (Coordinate, i128)> {
    let at = move |vertex, axis| Coordinate { key, vertex: Some(vertex), axis };
    let plane = xy.iter().enumerate().flat_map(move |(n, vertex)| {
        vertex.iter().enumerate().map(move |(axis, value)| (at(n, axis), *value))
    });
    let depth = z.unwrap_or_default().iter().enumerate();
    plane.chain(depth.map(move |(n, value)| (at(n, 2), *value)))
}

impl Shape for Triangle {
    fn coordinates(&self) -> impl Iterator<Item = (Coordinate, i128)> {
        vertices("v", &self.xy, self.z.as_ref().map(<[i128; 3]>::as_slice))
    }
}

impl Shape for Polygon {
    fn coordinates(&self) -> impl Iterator<Item = (Coordinate, i128)> {
        vertices("polygon", &self.xy, self.z.as_deref())
    }
}

/// The two ends of a line.
impl Shape for [[i128; 2]; 2] {
    fn coordinates(&self) -> impl Iterator<Item = (Coordinate, i128)> {
        vertices("line", self, None)
    }
}

/// A point.
impl Shape for [i128; 2] {
    fn coordinates(&self) -> impl Iterator<Item = (Coordinate, i128)> {
        let at = |axis| Coordinate { key: "point", vertex: None, axis };
        self.iter().enumerate().map(move |(axis, value)| (at(axis), *value))
    }
}

/// A shape that lies in a vertex field. Only [`VertexField::check`] makes one, so what holds this
/// type need not check again; the shape itself can be read through it.
///
/// ```
/// use guardbit::{profile, setup::{Triangle, VertexField}};
/// let profile = profile::load("sgi-4k")?;
/// let field = VertexField::new(&profile.vertex, profile.depth_max())?;
/// let corner = |b| Triangle { xy: [[0, 0], [b, 0], [0, b]], z: None };
/// assert_eq!(field.check(corner(1 << 22))?.area2(), 1 << 44);
/// assert_eq!(
///     field.check(corner((1 << 22) + 1)).unwrap_err().to_string(),
///     "v[1][0] = 4194305 is outside the vertex field: 0 <= x <= 4194304"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snapped<T> {
    shape: T,
    field: VertexField,
}

impl<T> Snapped<T> {
    /// The field that it was checked against.
    #[inline]
    pub const fn field(&self) -> &VertexField {
        &self.field
    }
}

impl<T> Deref for Snapped<T> {
    type Target = T;

    #[inline]
    fn deref(&self) -> &T {
        &self.shape
    }
}

impl Snapped<Triangle> {
    /// The same triangle with positive area: v1 and v2 change places if it is negative.
    #[must_use]
    pub fn normalised(self) -> Self {
        Self { shape: self.shape.normalised(), ..self }
    }

    /// The same triangle with other depth codes at its vertices.
    ///
    /// # Errors
    /// [`VertexError::Outside`] for a code beyond the field's depth range.
    pub fn with_depth(self, z: [i128; 3]) -> Result<Self, VertexError> {
        self.field.check(Triangle { z: Some(z), ..self.shape })
    }

    /// The same triangle, without depth.
    #[must_use]
    pub fn without_depth(self) -> Self {
        Self { shape: Triangle { z: None, ..self.shape }, ..self }
    }
}
