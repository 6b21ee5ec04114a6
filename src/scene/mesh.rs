//! OBJ meshes: vertex positions and faces, everything else passed over.
//!
//! Read by hand rather than with the `obj` crate: that reads positions as binary32, turns an index
//! out of range into a huge one without an error, counts lines from 0, and forgets on which line a
//! face stood.

/// A point in the mesh's own units.
pub type Point = [f64; 3];

/// Why a mesh cannot be read. Lines count from 1; a continued line has the number of its start.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// A vertex with too few coordinates.
    #[error("line {line}: `v` has {got} coordinates, 3 are needed: x y z")]
    Short {
        /// Line number.
        line: usize,
        /// How many there are.
        got: usize,
    },
    /// A coordinate that is no number.
    #[error("line {line}: field `{field}` of `v`: `{text}` is not a number")]
    NotNumber {
        /// Line number.
        line: usize,
        /// x, y or z.
        field: &'static str,
        /// What stands there.
        text: String,
    },
    /// A coordinate that is infinite, no number by intent, or too large for a double.
    #[error(
        "line {line}: field `{field}` of `v`: `{text}` is not finite, |{field}| < 2^1024 is needed; \
         remove the vertex and its faces, or export the mesh again"
    )]
    NotFinite {
        /// Line number.
        line: usize,
        /// x, y or z.
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
    /// A corner that is no index.
    #[error(
        "line {line}: corner {corner} of `f`: `{text}` does not begin with a vertex index; \
         write 5, 5/1, 5//2 or 5/1/2"
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
        "line {line}: corner {corner} of `f`: there is no vertex with index {index}; 1 <= index <= \
         {vertices} is needed, or -{vertices} <= index <= -1 to count back from the last vertex"
    )]
    OutOfRange {
        /// Line number.
        line: usize,
        /// Which corner, from 1.
        corner: usize,
        /// The index as it is written.
        index: i64,
        /// Vertices it may name: all of the file, or those above when it counts back.
        vertices: usize,
    },
    /// Nothing to draw.
    #[error(
        "no faces: the mesh has {vertices} vertices but no `f` line; export the mesh with its faces"
    )]
    NoFaces {
        /// How many vertices there are.
        vertices: usize,
    },
    /// All corners in one place, so that no camera can frame them.
    #[error(
        "all faces lie in the same point; the mesh needs an extent > 0 to fit it to the window"
    )]
    NoExtent,
}

/// The triangles of a mesh in file order; a polygon becomes a fan from its first corner.
///
/// A fan is the polygon only where that is convex; export other meshes as triangles.
///
/// # Errors
/// [`MeshError`], with line and field.
pub fn parse(text: &str) -> Result<Vec<[Point; 3]>, MeshError> {
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for (line, statement) in statements(text) {
        let mut words = statement.split_whitespace();
        match words.next() {
            Some("v") => vertices.push(vertex(line, words)?),
            Some("f") => faces.push((line, face(line, words, vertices.len())?)),
            _ => {}
        }
    }
    if faces.is_empty() {
        return Err(MeshError::NoFaces { vertices: vertices.len() });
    }
    let mut triangles = Vec::new();
    for (line, corners) in faces {
        let found = corners
            .iter()
            .enumerate()
            .map(|(corner, &(index, written))| {
                vertices.get(index).copied().ok_or(MeshError::OutOfRange {
                    line,
                    corner: corner + 1,
                    index: written,
                    vertices: vertices.len(),
                })
            })
            .collect::<Result<Vec<Point>, _>>()?;
        if let [first, rest @ ..] = found.as_slice() {
            triangles.extend(rest.windows(2).filter_map(|pair| match pair {
                [second, third] => Some([*first, *second, *third]),
                _ => None,
            }));
        }
    }
    Ok(triangles)
}

/// Statements with the number of their first line: comments cut, lines ending in `\` joined.
fn statements(text: &str) -> impl Iterator<Item = (usize, String)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (index, line) = lines.next()?;
        let mut statement = uncommented(line).to_owned();
        while statement.ends_with('\\') {
            statement.pop();
            statement.push(' ');
            statement.push_str(lines.next().map_or("", |(_, line)| uncommented(line)));
        }
        Some((index + 1, statement))
    })
}

fn uncommented(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

fn vertex<'a>(line: usize, words: impl Iterator<Item = &'a str>) -> Result<Point, MeshError> {
    // What follows z is a weight or a colour, which no surface made of flat faces needs.
    let words: Vec<_> = words.take(3).collect();
    let [x, y, z] = words.as_slice() else {
        return Err(MeshError::Short { line, got: words.len() });
    };
    let read = |field, text: &str| match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(MeshError::NotFinite { line, field, text: text.to_owned() }),
        Err(_) => Err(MeshError::NotNumber { line, field, text: text.to_owned() }),
    };
    Ok([read("x", x)?, read("y", y)?, read("z", z)?])
}

/// Positions in the list of vertices, each beside the index as it was written.
fn face<'a>(
    line: usize,
    words: impl Iterator<Item = &'a str>,
    vertices: usize,
) -> Result<Vec<(usize, i64)>, MeshError> {
    let corners = words
        .enumerate()
        .map(|(place, text)| {
            let corner = place + 1;
            let index: i64 = text
                .split('/')
                .next()
                .and_then(|index| index.parse().ok())
                .ok_or_else(|| MeshError::NotIndex { line, corner, text: text.to_owned() })?;
            let magnitude = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
            let position = if index > 0 {
                // May name a vertex further down; checked when all are read.
                Some(magnitude - 1)
            } else {
                vertices.checked_sub(magnitude).filter(|_| index < 0)
            };
            position.map(|position| (position, index)).ok_or(MeshError::OutOfRange {
                line,
                corner,
                index,
                vertices,
            })
        })
        .collect::<Result<Vec<_>, _>>()?;
    if corners.len() < 3 {
        return Err(MeshError::Corners { line, got: corners.len() });
    }
    Ok(corners)
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests {
    use super::*;

    const A: Point = [0.0, 0.0, 0.0];
    const B: Point = [1.0, 0.0, 0.0];
    const C: Point = [1.0, 1.0, 0.5];
    const D: Point = [0.0, 1.0, 0.1];
    const FOUR: &str = "v 0 0 0\nv 1 0 0\nv 1 1 .5\nv 0 1 1e-1\n";

    fn faces(tail: &str) -> Result<Vec<[Point; 3]>, MeshError> {
        parse(&format!("{FOUR}{tail}"))
    }

    #[test]
    fn a_polygon_is_a_fan() {
        assert_eq!(faces("f 1 2 3 4").unwrap(), [[A, B, C], [A, C, D]]);
        assert_eq!(faces("f -4 -3 -2 -1").unwrap(), [[A, B, C], [A, C, D]]);
        assert_eq!(faces("f 1/9 2//9 3/9/9").unwrap(), [[A, B, C]]);
    }

    #[test]
    fn other_statements_comments_and_continuations_are_passed_over() {
        let tail = "mtllib none.mtl\r\nvn 0 0 x\r\ng a\r\nusemtl b\r\ns off\r\nf 1 2 \\\r\n 3 # c \\\r\n\r\nf 2 3 4\\";
        assert_eq!(faces(tail).unwrap(), [[A, B, C], [B, C, D]]);
    }

    #[test]
    fn a_face_may_stand_above_its_vertices() {
        assert_eq!(parse(&format!("f 1 2 3\n{FOUR}")).unwrap(), [[A, B, C]]);
    }

    #[test]
    fn binary64_is_kept() {
        let mesh = parse("v 0.1 1e300 0\nv 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3").unwrap();
        assert_eq!(mesh[0][0], [0.1, 1e300, 0.0]);
    }

    #[test]
    fn an_index_out_of_range_is_an_error() {
        for (index, written) in [
            ("5", 5),
            ("0", 0),
            ("-5", -5),
            ("9223372036854775807", i64::MAX),
            ("-9223372036854775808", i64::MIN),
        ] {
            let error = faces(&format!("\nf 1 2 {index}\n")).unwrap_err();
            assert_eq!(
                error,
                MeshError::OutOfRange { line: 6, corner: 3, index: written, vertices: 4 }
            );
            let text = error.to_string();
            assert!(
                text.contains("line 6") && text.contains("corner 3") && text.contains("<= 4"),
                "{text}"
            );
        }
        // Counting back reaches only the vertices above.
        let error = parse(&format!("v 0 0 0\nf -1 -1 -2\n{FOUR}")).unwrap_err();
        assert_eq!(error, MeshError::OutOfRange { line: 2, corner: 3, index: -2, vertices: 1 });
    }

    #[test]
    fn errors_name_line_and_field() {
        for (tail, want) in [
            ("v 1 2\n", "line 5: `v` has 2 coordinates"),
            ("v 1 2 x\n", "line 5: field `z` of `v`: `x`"),
            ("v 1 nan 2\n", "line 5: field `y` of `v`: `nan` is not finite"),
            ("v 1e999 1 2\n", "line 5: field `x` of `v`: `1e999` is not finite"),
            ("f 1 2\n", "line 5: `f` has 2 corners"),
            ("f\n", "line 5: `f` has 0 corners"),
            ("f 1 2 c\n", "line 5: corner 3 of `f`: `c`"),
            ("f 1 /2 3\n", "line 5: corner 2 of `f`: `/2`"),
            ("f 1 2 99999999999999999999\n", "line 5: corner 3"),
            ("", "no faces: the mesh has 4 vertices"),
        ] {
            let text = faces(tail).unwrap_err().to_string();
            assert!(text.contains(want), "{tail}: {text}");
        }
    }
}
