//! What can be wrong with a glTF file.

/// Why a glTF file cannot be read. Places are paths of its JSON; everything counts from 0.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// A binary file that ends too early.
    #[error("the binary glTF file needs {need} bytes, but has {got}; it is cut short")]
    Short {
        /// Bytes by its header.
        need: u64,
        /// Bytes of the file.
        got: usize,
    },
    /// A binary file without its first chunk.
    #[error("the binary glTF file has no JSON chunk; export it again")]
    NoJson,
    /// JSON that is none, or has other fields than glTF.
    #[error("the JSON of the glTF file: {message}")]
    Json {
        /// What is wrong, with line and column.
        message: String,
    },
    /// Another version.
    #[error("glTF {version}: version 2.0 is read; export the file as glTF 2.0")]
    Version {
        /// The version.
        version: String,
    },
    /// An extension that is not known.
    #[error("the file requires the extension {name}, which is not read; export it without")]
    Extension {
        /// Its name.
        name: String,
    },
    /// An index of nothing.
    #[error("{place} is {index}: there are {count} {what}, 0 <= index < {count} is needed")]
    Index {
        /// Where the index stands.
        place: String,
        /// What it names.
        what: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// No scene at all.
    #[error("the file has no scene; export it with one")]
    NoScene,
    /// A node that is reached twice.
    #[error(
        "nodes[{node}] has two parents, or is below itself; a node has one parent, or none and stands in the scene"
    )]
    Twice {
        /// The node.
        node: usize,
    },
    /// A transform that is none of space.
    #[error(
        "nodes[{node}]: the transform is not finite, or not affine: the last row of `matrix` is 0 0 0 1, and \
         `rotation` is not 0 0 0 0"
    )]
    Transform {
        /// The node.
        node: usize,
    },
    /// A mesh that moves with bones.
    #[error(
        "nodes[{node}] has a skin, which is not read; export the mesh in its pose, without bones"
    )]
    Skin {
        /// The node.
        node: usize,
    },
    /// A mesh that is drawn between shapes.
    #[error(
        "nodes[{node}]: meshes[{mesh}] has morph targets with weights other than 0, which are not read; export the \
         mesh in its shape"
    )]
    Morph {
        /// The node.
        node: usize,
        /// Its mesh.
        mesh: usize,
    },
    /// A camera that sees nothing.
    #[error("cameras[{camera}]: {need} is needed")]
    Camera {
        /// The camera.
        camera: usize,
        /// The inequality.
        need: &'static str,
    },
    /// A camera without a direction.
    #[error("nodes[{node}]: the camera has no direction; its scale must not be 0")]
    Direction {
        /// The node.
        node: usize,
    },
    /// A buffer whose bytes are nowhere to be had.
    #[error("buffers[{buffer}]: {why}")]
    Source {
        /// The buffer.
        buffer: usize,
        /// What is wrong.
        why: &'static str,
    },
    /// A file of a buffer that cannot be read.
    #[error("buffers[{buffer}]: the file {path} cannot be read: {source}")]
    Io {
        /// The buffer.
        buffer: usize,
        /// Its path.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// A buffer of fewer bytes than it says.
    #[error(
        "buffers[{buffer}]: byteLength = {need}, but there are {got} bytes; the data is cut short"
    )]
    Cut {
        /// The buffer.
        buffer: usize,
        /// Its length.
        need: u64,
        /// Bytes that there are.
        got: u64,
    },
    /// A view that reaches beyond its buffer.
    #[error(
        "bufferViews[{view}]: byteOffset + byteLength = {end}, but buffers[{buffer}] has {length} bytes"
    )]
    View {
        /// The view.
        view: usize,
        /// Where it ends.
        end: u128,
        /// The buffer.
        buffer: usize,
        /// Bytes of the buffer.
        length: usize,
    },
    /// An accessor that reaches beyond its view.
    #[error(
        "accessors[{accessor}]: its {count} elements end at byte {end}, but bufferViews[{view}] has {length} bytes"
    )]
    Accessor {
        /// The accessor.
        accessor: usize,
        /// Its elements.
        count: u64,
        /// Where they end.
        end: u128,
        /// The view.
        view: usize,
        /// Bytes of the view.
        length: usize,
    },
    /// An accessor that is not read.
    #[error("accessors[{accessor}]: {why}")]
    Unread {
        /// The accessor.
        accessor: usize,
        /// Why not.
        why: &'static str,
    },
    /// An accessor of another shape.
    #[error("{place}: accessors[{accessor}] is {got}; {need} is needed")]
    Shape {
        /// Where it is used.
        place: String,
        /// The accessor.
        accessor: usize,
        /// What it is.
        got: String,
        /// What it should be.
        need: &'static str,
    },
    /// A number that is not finite.
    #[error(
        "{place}: element {element} of accessors[{accessor}] is {value}: a finite number is needed; export the mesh \
         again"
    )]
    NotFinite {
        /// Where it is used.
        place: String,
        /// The accessor.
        accessor: usize,
        /// The element.
        element: usize,
        /// The value.
        value: f64,
    },
    /// A point that a transform takes out of the doubles.
    #[error(
        "{place}: vertex {vertex} is not finite in world space; the scale of its nodes is too large"
    )]
    World {
        /// The primitive.
        place: String,
        /// The vertex.
        vertex: usize,
    },
    /// A primitive without positions.
    #[error("{place} has no POSITION")]
    NoPosition {
        /// The primitive.
        place: String,
    },
    /// Attributes of different lengths.
    #[error("{place}: {name} has {got} elements, but POSITION has {need}")]
    Length {
        /// The primitive.
        place: String,
        /// The attribute.
        name: &'static str,
        /// Its elements.
        got: usize,
        /// Vertices of the primitive.
        need: usize,
    },
    /// An index of no vertex.
    #[error("{place}: index {at} is vertex {vertex}: 0 <= vertex < {count} is needed")]
    OutOfRange {
        /// The primitive.
        place: String,
        /// Which index.
        at: usize,
        /// The vertex.
        vertex: f64,
        /// How many there are.
        count: usize,
    },
    /// A number of indices that makes no triangles.
    #[error("{place}: {got} vertices in a row; {need} is needed")]
    Corners {
        /// The primitive.
        place: String,
        /// How many there are.
        got: usize,
        /// How many make triangles.
        need: &'static str,
    },
    /// More than is drawn.
    #[error(
        "{place}: with this primitive the scene has {got} vertices or more; {most} at most are drawn; export a part \
         of it"
    )]
    Many {
        /// The primitive.
        place: String,
        /// How many there are.
        got: u64,
        /// How many may be.
        most: u64,
    },
    /// Nothing to draw.
    #[error(
        "no triangles: the default scene has no node with a mesh of triangles; export it with one"
    )]
    NoTriangles,
}
