//! Why a scene cannot be loaded.

use super::builtin;
#[cfg(feature = "verification")]
use super::lines::LineError;
use super::mesh::MeshError;

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The window has no pixels.
    #[error("viewport {width} x {height}: width >= 1 and height >= 1 are needed")]
    Viewport {
        /// The width asked for.
        width: u32,
        /// The height asked for.
        height: u32,
    },
    /// Neither a built-in name nor a file.
    #[error(
        "no scene `{name}`: it is not a file and not a built-in scene; give one of the built-in scenes ({}), \
         a mesh (.obj, .gltf, .glb, .ply, .stl), or a JSON Lines file of triangles",
        builtin::name_list()
    )]
    Unknown {
        /// What was asked for.
        name: String,
    },
    /// The file could not be read.
    #[error("{path}: the file cannot be read: {source}")]
    Io {
        /// The path as it was given.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file of a format that is not read.
    #[error(
        "{path}: this is a {format} file, which is not read; export it as glTF, OBJ, PLY or STL"
    )]
    Format {
        /// The path as it was given.
        path: String,
        /// The format by its name.
        format: &'static str,
    },
    /// A mesh under another name.
    #[error(
        "{path}: this looks like {format}, which is read from files that end in {ending}: rename it"
    )]
    NamedOtherwise {
        /// The path as it was given.
        path: String,
        /// The format by its name.
        format: &'static str,
        /// How its files end.
        ending: &'static str,
    },
    /// The file is not text.
    #[error(
        "{path}: line {line}: the text is not UTF-8; a scene is a mesh (.obj, .gltf, .glb, .ply, .stl) or JSON \
         Lines; save the file as UTF-8"
    )]
    Encoding {
        /// The path as it was given.
        path: String,
        /// Line of the first byte that is not UTF-8, from 1.
        line: usize,
    },
    /// A format that this build does not read.
    #[cfg(not(feature = "verification"))]
    #[error(
        "{path}: this build reads .obj, .ply and .stl meshes; build with the feature `verification` for glTF and \
         JSON Lines"
    )]
    NoReader {
        /// The path as it was given.
        path: String,
    },
    /// A line of a JSON Lines file is wrong.
    #[cfg(feature = "verification")]
    #[error("{path}: line {line}: {source}")]
    Line {
        /// The path as it was given.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong with the line, with its field.
        source: LineError,
    },
    /// A mesh of no bytes.
    #[error("{path}: the file is empty; export the mesh again")]
    NoBytes {
        /// The path as it was given.
        path: String,
    },
    /// A JSON Lines file without a triangle.
    #[error(
        "{path}: the file has no triangles; write one triangle on each line, for example {{\"v\": [[0,0],[64,0],[0,64]]}}"
    )]
    Empty {
        /// The path as it was given.
        path: String,
    },
    /// A mesh is wrong.
    #[error("{path}: {source}")]
    Mesh {
        /// The path as it was given.
        path: String,
        /// What is wrong with it, with its place in the file.
        source: MeshError,
    },
}
