//! What can be wrong with an OBJ mesh.

/// Why an OBJ mesh cannot be read. Lines count from 1; a continued line has the number of its start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ObjError {
    /// A vertex with too few coordinates.
    #[error("line {line}: `{statement}` has {got} numbers, but needs {need}")]
    Short {
        /// `v`, `vt` or `vn`.
        statement: &'static str,
        /// How many are needed.
        need: &'static str,
        /// Line number.
        line: usize,
        /// How many there are.
        got: usize,
    },
    /// A coordinate that is no number.
    #[error("line {line}: field `{field}` of `{statement}`: `{text}` is not a number")]
    NotNumber {
        /// `v`, `vt` or `vn`.
        statement: &'static str,
        /// Line number.
        line: usize,
        /// Which number of it.
        field: &'static str,
        /// What stands there.
        text: String,
    },
    /// A coordinate that is infinite, no number by intent, or too large for a double.
    #[error(
        "line {line}: field `{field}` of `{statement}`: `{text}` is not finite, |{field}| < 2^1024 is needed; \
         remove the vertex and its faces, or export the mesh again"
    )]
    NotFinite {
        /// `v`, `vt` or `vn`.
        statement: &'static str,
        /// Line number.
        line: usize,
        /// Which number of it.
        field: &'static str,
        /// What stands there.
        text: String,
    },
    /// A face of fewer than three corners.
    #[error("line {line}: `f` has {got} corners, at least 3 are needed")]
    Corners {
        /// Line number.
        line: usize,
        /// How many there are.
        got: usize,
    },
    /// A face that crosses itself.
    #[error(
        "line {line}: `f` crosses itself: the side from corner {one} and the side from corner {two} cut each \
         other; export the mesh as triangles, or give the corners in their order around the face"
    )]
    Crosses {
        /// Line number.
        line: usize,
        /// The first corner of one side, from 1.
        one: usize,
        /// The first corner of the other.
        two: usize,
    },
    /// A corner that is no index.
    #[error(
        "line {line}: corner {corner} of `f`: `{text}` is no index; write 5, 5/1, 5//2 or 5/1/2"
    )]
    NotIndex {
        /// Line number.
        line: usize,
        /// Which corner, from 1.
        corner: usize,
        /// What stands there.
        text: String,
    },
    /// An index without a vertex.
    #[error(
        "line {line}: corner {corner} of `f`: there is no {what} with index {index}; 1 <= index <= \
         {count} is needed, or -{count} <= index <= -1 to count back from the last {what}"
    )]
    OutOfRange {
        /// `vertex`, `texture coordinate` or `normal`.
        what: &'static str,
        /// Line number.
        line: usize,
        /// Which corner, from 1.
        corner: usize,
        /// The index as it is written.
        index: i64,
        /// How many it may name: all of the file, or those above when it counts back.
        count: usize,
    },
    /// Nothing to draw.
    #[error(
        "no faces: the mesh has {vertices} vertices but no `f` line; export the mesh with its faces"
    )]
    NoFaces {
        /// How many vertices there are.
        vertices: usize,
    },
}
