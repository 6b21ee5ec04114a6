//! PLY meshes, text and binary: vertices with texture coordinates, normals and colours, and faces.
//!
//! Read by hand rather than with the crate `ply-rs-bw`: that takes two elements of one name for one, passes over
//! a value too many in a line, refuses `.5`, and goes on for as many elements without properties as a header says.

mod error;
mod header;
mod values;

use super::face::{Crossing, triangles};
use super::{Mesh, Place, Point};
use crate::scene::AttributeSet;
pub use error::PlyError;
use header::{Element, Property};
use values::Values;

/// Names of the list of a face's corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// What vertices may carry, under any of several names; the first of a row that a file has counts.
const SETS: [(&str, &[&str]); 6] = [
    ("texcoord", &["s", "t"]),
    ("texcoord", &["u", "v"]),
    ("texcoord", &["texture_u", "texture_v"]),
    ("normal", &["nx", "ny", "nz"]),
    ("color", &["red", "green", "blue", "alpha"]),
    ("color", &["red", "green", "blue"]),
];

/// Reads a PLY mesh; a face of more than three corners becomes triangles that cover it once.
///
/// # Errors
/// [`PlyError`], with line, vertex or face.
pub fn parse(bytes: &[u8]) -> Result<Mesh, PlyError> {
    let (elements, mut values) = header::read(bytes)?;
    let (mut vertices, mut faces) = (None, Vec::new());
    for element in &elements {
        values.check(element)?;
        match element.name.as_str() {
            "vertex" => vertices = Some(Vertices::read(element, &mut values)?),
            "face" => faces = read_faces(element, &mut values)?,
            _ => (0..element.count).try_for_each(|n| values.element(element, n).map(drop))?,
        }
    }
    let vertices = vertices.ok_or(PlyError::NoElement)?;
    if faces.is_empty() {
        return Err(PlyError::NoFaces { vertices: vertices.points.len() });
    }
    let sets = vertices.sets.iter().map(|set| AttributeSet::new(set.name, set.components));
    let mut mesh = Mesh { sets: sets.collect(), ..Mesh::default() };
    for (n, face) in faces.iter().enumerate() {
        let crosses = |Crossing([one, two])| PlyError::Crosses { place: face.words(n), one, two };
        let corners = face.checked(n, vertices.points.len())?;
        let points: Vec<Point> = corners.iter().map(|at| vertices.points[*at]).collect();
        for triangle in triangles(&points).map_err(crosses)? {
            mesh.triangles.push(triangle.map(|n| points[n]));
            mesh.places.push(face.line.map_or(Place::Face(n), Place::Line));
            for (set, from) in mesh.sets.iter_mut().zip(&vertices.sets) {
                for n in triangle {
                    let each = from.components;
                    set.values.extend(&from.values[each * corners[n]..][..each]);
                }
            }
        }
    }
    Ok(mesh)
}

/// The vertices of a file.
struct Vertices {
    points: Vec<Point>,
    sets: Vec<Carried>,
}

/// What vertices carry under one name, vertex by vertex.
struct Carried {
    name: &'static str,
    components: usize,
    values: Vec<f64>,
}

impl Vertices {
    fn read(element: &Element, values: &mut Values) -> Result<Self, PlyError> {
        let find = |name: &str| element.properties.iter().position(|known| known.name == name);
        let axis = |property| find(property).ok_or(PlyError::NoAxis { property });
        let axes = [axis("x")?, axis("y")?, axis("z")?];
        let mut chosen: Vec<(Carried, Vec<usize>)> = Vec::new();
        for (name, properties) in SETS {
            let found: Option<Vec<usize>> =
                properties.iter().map(|property| find(property)).collect();
            if let Some(found) = found.filter(|_| chosen.iter().all(|(set, _)| set.name != name)) {
                let components = found.len();
                chosen.push((Carried { name, components, values: Vec::new() }, found));
            }
        }
        // A list has no one number.
        let used = chosen.iter().flat_map(|(_, found)| found).chain(&axes);
        if let Some(list) = used.map(|at| &element.properties[*at]).find(|one| one.list.is_some()) {
            return Err(PlyError::List { property: list.name.clone() });
        }
        let mut points = Vec::new();
        for n in 0..element.count {
            let read = values.element(element, n)?;
            let number = |at: usize| {
                let (value, property) = (read.numbers[at], &element.properties[at]);
                if value.is_finite() {
                    return Ok(value);
                }
                let (place, property) = (read.words("vertex", n), property.name.clone());
                Err(PlyError::NotFinite { place, property, value })
            };
            points.push([number(axes[0])?, number(axes[1])?, number(axes[2])?]);
            for (set, found) in &mut chosen {
                for at in found {
                    let kind = element.properties[*at].kind;
                    let unit = if set.name == "color" { kind.unit() } else { 1.0 };
                    set.values.push(number(*at)? / unit);
                }
            }
        }
        Ok(Self { points, sets: chosen.into_iter().map(|(set, _)| set).collect() })
    }
}

/// A face as it is written.
struct Face {
    /// The line, in a text.
    line: Option<usize>,
    corners: Vec<f64>,
}

fn read_faces(element: &Element, values: &mut Values) -> Result<Vec<Face>, PlyError> {
    let named = |property: &Property| CORNERS.contains(&property.name.as_str());
    let corners = element.properties.iter().position(named).ok_or(PlyError::NoCorners)?;
    let property = &element.properties[corners];
    if property.list.is_none() || property.kind.is_real() {
        return Err(PlyError::NoList { property: property.name.clone() });
    }
    let face = |n| {
        let mut read = values.element(element, n)?;
        Ok(Face { line: read.line, corners: std::mem::take(&mut read.lists[corners]) })
    };
    (0..element.count).map(face).collect()
}

impl Face {
    /// Its place in words.
    fn words(&self, n: usize) -> String {
        values::words("face", n, self.line)
    }

    /// The corners as numbers of vertices.
    fn checked(&self, n: usize, count: usize) -> Result<Vec<usize>, PlyError> {
        let place = || self.words(n);
        if self.corners.len() < 3 {
            return Err(PlyError::Corners { place: place(), got: self.corners.len() });
        }
        let corner = |(corner, index): (usize, &f64)| {
            #[expect(
                clippy::cast_precision_loss,
                reason = "a count of vertices in memory is below 2^53"
            )]
            let inside = (0.0..count as f64).contains(index);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a whole number, as its kind is, and inside"
            )]
            let at = *index as usize;
            let index = *index;
            inside.then_some(at).ok_or_else(|| PlyError::OutOfRange {
                place: place(),
                corner,
                index,
                count,
            })
        };
        self.corners.iter().enumerate().map(corner).collect()
    }
}
