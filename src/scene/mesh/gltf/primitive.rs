//! The triangles of the meshes that nodes draw.

use gltf_json::Root;
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;

use super::GltfError;
use super::accessor::{self, COLOR, INDICES, NORMAL, Numbers, POSITION, TEXCOORD, Wanted};
use super::buffer::Buffers;
use super::node::Drawn;
use crate::scene::mesh::{Mesh, Point};
use crate::scene::{AttributeSet, Place};

/// Most vertices of a scene, counted for each node that draws them: a small file may draw a mesh any number of times.
const MOST: u64 = 1 << 26;

/// What vertices may carry: the name of the set, and the attribute.
const SETS: [(&str, Semantic, Wanted); 3] = [
    ("texcoord", Semantic::TexCoords(0), TEXCOORD),
    ("normal", Semantic::Normals, NORMAL),
    ("color", Semantic::Colors(0), COLOR),
];

/// A primitive that a node draws.
struct Part<'a> {
    drawn: &'a Drawn,
    number: usize,
    primitive: &'a Primitive,
    mode: Mode,
}

impl Part<'_> {
    fn place(&self) -> String {
        format!("meshes[{}].primitives[{}]", self.drawn.mesh, self.number)
    }

    fn attribute(&self, semantic: &Semantic) -> Option<usize> {
        let found = self.primitive.attributes.iter().find_map(|(name, accessor)| match name {
            Checked::Valid(name) if name == semantic => Some(accessor),
            _ => None,
        });
        found.map(gltf_json::Index::value)
    }

    /// How many vertices it takes at least.
    fn size(&self, root: &Root) -> Result<u64, GltfError> {
        let mut most = 0;
        let position = self.attribute(&Semantic::Positions);
        let indices = self.primitive.indices.map(|indices| indices.value());
        for accessor in position.into_iter().chain(indices) {
            most = accessor::count(root, accessor, || self.place())?.max(most);
        }
        Ok(most)
    }
}

/// The triangles of all of these, in their order; lines and points are passed over.
pub(super) fn read(root: &Root, buffers: &mut Buffers, drawn: &[Drawn]) -> Result<Mesh, GltfError> {
    let mut parts = Vec::new();
    for drawn in drawn {
        for (number, primitive) in root.meshes[drawn.mesh].primitives.iter().enumerate() {
            let Checked::Valid(mode) = primitive.mode else { continue };
            if matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
                parts.push(Part { drawn, number, primitive, mode });
            }
        }
    }
    let mut total = 0u64;
    for part in &parts {
        total = total.saturating_add(part.size(root)?);
        if total > MOST {
            return Err(GltfError::Many { place: part.place(), got: total, most: MOST });
        }
    }
    let mut mesh = Mesh { sets: sets(root, &parts), ..Mesh::default() };
    for part in &parts {
        part.read(root, buffers, &mut mesh)?;
    }
    if mesh.triangles.is_empty() {
        return Err(GltfError::NoTriangles);
    }
    Ok(mesh)
}

/// The sets that any primitive has values for, as wide as the widest of them.
fn sets(root: &Root, parts: &[Part]) -> Vec<AttributeSet> {
    let width = |part: &Part, semantic: &Semantic| {
        let found = root.accessors.get(part.attribute(semantic)?)?;
        if let Checked::Valid(shape) = found.type_ { Some(shape.multiplicity()) } else { None }
    };
    let set = |(name, semantic, _): &(&'static str, Semantic, Wanted)| {
        let widest = parts.iter().filter_map(|part| width(part, semantic)).max()?;
        Some(AttributeSet::new(name, widest))
    };
    SETS.iter().filter_map(set).collect()
}

impl Part<'_> {
    fn read(&self, root: &Root, buffers: &mut Buffers, mesh: &mut Mesh) -> Result<(), GltfError> {
        let place = || self.place();
        let position = self.attribute(&Semantic::Positions);
        let position = position.ok_or_else(|| GltfError::NoPosition { place: place() })?;
        let world = &self.drawn.world;
        let positions = accessor::read(root, buffers, position, &POSITION, place)?;
        let count = positions.count();
        let mut points: Vec<Point> = Vec::new();
        for vertex in 0..count {
            let point = world.point(three(positions.element(vertex)));
            if !point.iter().all(|value| value.is_finite()) {
                return Err(GltfError::World { place: place(), vertex });
            }
            points.push(point);
        }
        let mut carried: Vec<Option<Numbers>> = Vec::new();
        for set in &mesh.sets {
            let known = SETS.iter().find(|(name, ..)| *name == set.name);
            let (_, semantic, wanted) =
                known.unwrap_or_else(|| unreachable!("a set is one of these"));
            let read = |accessor| {
                let numbers = accessor::read(root, buffers, accessor, wanted, place)?;
                let (name, got) = (wanted.name, numbers.count());
                if got != count {
                    return Err(GltfError::Length { place: place(), name, got, need: count });
                }
                Ok(numbers)
            };
            let mut numbers = self.attribute(semantic).map(read).transpose()?;
            if let (Some(numbers), Semantic::Normals) = (&mut numbers, semantic) {
                for normal in numbers.values.chunks_exact_mut(3) {
                    normal.copy_from_slice(&world.normal(three(normal)));
                }
            }
            carried.push(numbers);
        }
        let Drawn { node, mesh: of, .. } = *self.drawn;
        for (n, corners) in self.triangles(root, buffers, count)?.into_iter().enumerate() {
            mesh.triangles.push(corners.map(|corner| points[corner]));
            mesh.places.push(Place::Primitive {
                node,
                mesh: of,
                primitive: self.number,
                triangle: n,
            });
            for (set, numbers) in mesh.sets.iter_mut().zip(&carried) {
                for corner in corners {
                    carry(set, numbers.as_ref(), corner);
                }
            }
        }
        Ok(())
    }

    /// The corners of each triangle, in the order that the format gives to lists, strips and fans.
    fn triangles(
        &self,
        root: &Root,
        buffers: &mut Buffers,
        count: usize,
    ) -> Result<Vec<[usize; 3]>, GltfError> {
        let place = || self.place();
        let row: Vec<usize> = match self.primitive.indices {
            None => (0..count).collect(),
            Some(indices) => {
                let read = accessor::read(root, buffers, indices.value(), &INDICES, place)?;
                let inside = |(at, vertex): (usize, &f64)| {
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "a whole number of at most 32 bits"
                    )]
                    let index = *vertex as usize;
                    let (place, vertex) = (place(), *vertex);
                    if index < count {
                        Ok(index)
                    } else {
                        Err(GltfError::OutOfRange { place, at, vertex, count })
                    }
                };
                read.values.iter().enumerate().map(inside).collect::<Result<_, _>>()?
            }
        };
        let got = row.len();
        let corners = |need| Err(GltfError::Corners { place: place(), got, need });
        Ok(match self.mode {
            Mode::TriangleStrip | Mode::TriangleFan if got < 3 => return corners("3 or more"),
            Mode::TriangleStrip => {
                let turned = |(n, w): (usize, &[usize])| [w[0], w[1 + n % 2], w[2 - n % 2]];
                row.windows(3).enumerate().map(turned).collect()
            }
            Mode::TriangleFan => (2..got).map(|n| [row[n - 1], row[n], row[0]]).collect(),
            _ if !got.is_multiple_of(3) => return corners("a multiple of 3"),
            _ => row.chunks_exact(3).map(|w| [w[0], w[1], w[2]]).collect(),
        })
    }
}

fn three(values: &[f64]) -> Point {
    [values[0], values[1], values[2]]
}

/// Adds what a vertex carries to a set. A colour without alpha has an alpha of 1.
fn carry(set: &mut AttributeSet, numbers: Option<&Numbers>, vertex: usize) {
    let Some(numbers) = numbers else {
        let name =
            SETS.iter().find(|(name, ..)| *name == set.name).map_or("", |(.., wanted)| wanted.name);
        set.missing.get_or_insert_with(|| format!("the primitive has no {name}"));
        set.values.extend([f64::NAN; 4].iter().take(set.components));
        return;
    };
    set.values.extend(numbers.element(vertex));
    set.values.extend([1.0].iter().take(set.components - numbers.components));
}
