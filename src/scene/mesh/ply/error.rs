//! What can be wrong with a PLY mesh.

/// Why a PLY mesh cannot be read. Lines count from 1, vertices, faces and corners from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlyError {
    /// Another first line.
    #[error("line 1: the file does not begin with `ply`; export the mesh again")]
    NotPly,
    /// A line that no header has.
    #[error("line {line}: `{got}` is no line of a PLY header; {need}")]
    Header {
        /// Line number.
        line: usize,
        /// What stands there.
        got: String,
        /// What may stand there.
        need: &'static str,
    },
    /// A header without its last line.
    #[error("line {line}: the header ends here, without `end_header`; the file is cut short")]
    Open {
        /// Number of the last line.
        line: usize,
    },
    /// An element or a property of a name that there was.
    #[error("line {line}: `{name}` is given twice")]
    Twice {
        /// Line number.
        line: usize,
        /// The name.
        name: String,
    },
    /// More elements than the file can hold.
    #[error(
        "element `{element}`: the header counts {count}, which need {need} bytes or more, but {left} bytes are \
         left; the file is cut short, or the count is wrong"
    )]
    Count {
        /// The element.
        element: String,
        /// How many the header says.
        count: usize,
        /// Bytes that they need at least.
        need: u128,
        /// Bytes that are left.
        left: usize,
    },
    /// Elements that have nothing.
    #[error(
        "element `{element}`: the header counts {count} without a property; export the mesh again"
    )]
    NoProperties {
        /// The element.
        element: String,
        /// How many the header says.
        count: usize,
    },
    /// A file that ends in the middle.
    #[error("{place}: the file ends in `{property}`; it is cut short")]
    End {
        /// Where.
        place: String,
        /// The property.
        property: String,
    },
    /// A word that is no number of its kind.
    #[error("{place}: `{property}` is `{text}`: one `{kind}` is needed")]
    NotNumber {
        /// Where.
        place: String,
        /// The property.
        property: String,
        /// What stands there.
        text: String,
        /// The kind by its name.
        kind: String,
    },
    /// A number that is not finite.
    #[error(
        "{place}: `{property}` is {value}: a finite number is needed; remove the vertex and its faces, or export \
         the mesh again"
    )]
    NotFinite {
        /// Where.
        place: String,
        /// The property.
        property: String,
        /// Its value.
        value: f64,
    },
    /// A list of fewer than no values.
    #[error("{place}: `{property}` is a list of {length} values; 0 or more are needed")]
    Length {
        /// Where.
        place: String,
        /// The property.
        property: String,
        /// How many the file says.
        length: f64,
    },
    /// No vertices.
    #[error("the header has no `element vertex`; export the mesh again")]
    NoElement,
    /// Vertices without a coordinate.
    #[error("element `vertex` has no property `{property}`; x, y and z are needed")]
    NoAxis {
        /// The coordinate.
        property: &'static str,
    },
    /// A list where one number is needed.
    #[error("element `vertex`: `{property}` is a list, one number is needed")]
    List {
        /// The property.
        property: String,
    },
    /// Faces without corners.
    #[error(
        "element `face` has no list `vertex_indices` or `vertex_index`; export the mesh with its faces"
    )]
    NoCorners,
    /// Corners that are no list of whole numbers.
    #[error(
        "element `face`: `{property}` is needed as a list of whole numbers, such as `list uchar int`"
    )]
    NoList {
        /// The property.
        property: String,
    },
    /// A face of fewer than three corners.
    #[error("{place}: {got} corners, at least 3 are needed")]
    Corners {
        /// Where.
        place: String,
        /// How many there are.
        got: usize,
    },
    /// A corner without a vertex.
    #[error("{place}: corner {corner} is vertex {index}: 0 <= vertex <= {count} - 1 is needed")]
    OutOfRange {
        /// Where.
        place: String,
        /// Which corner.
        corner: usize,
        /// The vertex as it is written.
        index: f64,
        /// How many vertices there are.
        count: usize,
    },
    /// A face that crosses itself.
    #[error(
        "{place}: the face crosses itself: the side from corner {one} and the side from corner {two} cut each \
         other; export the mesh as triangles"
    )]
    Crosses {
        /// Where.
        place: String,
        /// The first corner of one side.
        one: usize,
        /// The first corner of the other.
        two: usize,
    },
    /// Nothing to draw.
    #[error(
        "no faces: the mesh has {vertices} vertices but no face; export the mesh with its faces"
    )]
    NoFaces {
        /// How many vertices there are.
        vertices: usize,
    },
}
