//! Meshes: triangles in space, and what their corners carry. Each format has a reader; what they read is one
//! [`Mesh`], and [`super::camera`] brings it to the window.

mod face;
#[cfg(feature = "verification")]
pub mod gltf;
pub mod obj;
pub mod ply;
pub mod stl;

use super::camera::Placed;
use super::{AttributeSet, Place};

/// A point in the mesh's own units.
pub type Point = [f64; 3];

/// A mesh, as any format gives it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// The triangles, in file order.
    pub triangles: Vec<[Point; 3]>,
    /// Where each of them stands in the file.
    pub places: Vec<Place>,
    /// Texture coordinates, normals and colours, where the file has any.
    pub sets: Vec<AttributeSet>,
    /// The camera of the file, where it has one.
    pub camera: Option<Placed>,
}

/// Why a mesh cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// An OBJ mesh is wrong.
    #[error(transparent)]
    Obj(#[from] obj::ObjError),
    /// An STL mesh is wrong.
    #[error(transparent)]
    Stl(#[from] stl::StlError),
    /// A PLY mesh is wrong.
    #[error(transparent)]
    Ply(#[from] ply::PlyError),
    /// A glTF file is wrong.
    #[cfg(feature = "verification")]
    #[error(transparent)]
    Gltf(#[from] gltf::GltfError),
    /// All corners in one place, so that no camera can frame them.
    #[error(
        "all faces lie in the same point; the mesh needs an extent > 0 to fit it to the window"
    )]
    NoExtent,
}
