//! STL meshes, text and binary: facets of three vertices, and a normal for each facet.
//!
//! Read by hand rather than with the `stl_io` crate: that reads the first solid of a text alone, takes a
//! binary file whose header begins with `solid` for a text, and names no line.

use super::{Mesh, Place, Point};
use crate::scene::AttributeSet;

/// Why an STL mesh cannot be read. Lines count from 1, facets from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StlError {
    /// A text with another word than the format has there.
    #[error("line {line}: `{need}` is needed, got {got}")]
    Need {
        /// Line number.
        line: usize,
        /// What the format has there.
        need: &'static str,
        /// What stands there.
        got: String,
    },
    /// A text with a coordinate that is no finite number.
    #[error("line {line}: `{text}` is not a finite number, |value| < 2^1024 is needed")]
    NotNumber {
        /// Line number.
        line: usize,
        /// What stands there.
        text: String,
    },
    /// A text with a facet of more than three vertices.
    #[error("line {line}: a facet has 3 vertices, here is a fourth; export the mesh as triangles")]
    Fourth {
        /// Line number.
        line: usize,
    },
    /// A binary file with a coordinate that is no finite number.
    #[error(
        "facet {facet} (from 0): {value} is not a finite number; remove the facet, or export the mesh again"
    )]
    NotFinite {
        /// The facet.
        facet: usize,
        /// The value.
        value: f32,
    },
    /// A binary file of another length than its header says.
    #[error(
        "this is no STL text, as it does not begin with `solid`, and no whole binary STL file: its header counts \
         {count} facets, 84 + 50 x {count} = {need} bytes, but the file has {got}; export the mesh again"
    )]
    Length {
        /// Facets by the header.
        count: u32,
        /// Bytes that they need.
        need: u64,
        /// Bytes of the file.
        got: usize,
    },
    /// Neither a text nor long enough for a binary header.
    #[error(
        "this is no STL text, as it does not begin with `solid`, and no binary STL file, which has 84 bytes or \
         more: the file has {got}"
    )]
    Header {
        /// Bytes of the file.
        got: usize,
    },
    /// Nothing to draw.
    #[error("the mesh has no facets; export it again")]
    NoFacets,
}

/// Bytes before the first facet of a binary file, and of each facet.
const HEADER: usize = 84;
const FACET: usize = 50;

/// Reads an STL mesh; the normal of a facet is that of its three vertices.
///
/// # Errors
/// [`StlError`], with line or facet.
pub fn parse(bytes: &[u8]) -> Result<Mesh, StlError> {
    let count = bytes.get(80..HEADER).map(|count| [count[0], count[1], count[2], count[3]]);
    let count = count.map(u32::from_le_bytes);
    let need = |count| HEADER as u64 + FACET as u64 * u64::from(count);
    // The length decides: headers of binary files may begin with `solid`, too.
    let binary = count.is_some_and(|count| need(count) == bytes.len() as u64);
    let mut mesh = Mesh { sets: vec![AttributeSet::new("normal", 3)], ..Mesh::default() };
    if binary {
        for (n, facet) in bytes[HEADER..].chunks_exact(FACET).enumerate() {
            binary_facet(&mut mesh, n, facet)?;
        }
    } else if bytes.trim_ascii_start().starts_with(b"solid") {
        text(&mut mesh, &String::from_utf8_lossy(bytes))?;
    } else if let Some(count) = count {
        return Err(StlError::Length { count, need: need(count), got: bytes.len() });
    } else {
        return Err(StlError::Header { got: bytes.len() });
    }
    if mesh.triangles.is_empty() {
        return Err(StlError::NoFacets);
    }
    Ok(mesh)
}

fn add(mesh: &mut Mesh, place: Place, normal: Point, corners: [Point; 3]) {
    mesh.triangles.push(corners);
    mesh.places.push(place);
    mesh.sets[0].values.extend([normal; 3].as_flattened());
}

fn binary_facet(mesh: &mut Mesh, facet: usize, bytes: &[u8]) -> Result<(), StlError> {
    let mut points = [[0.0; 3]; 4];
    for (slot, word) in points.as_flattened_mut().iter_mut().zip(bytes.chunks_exact(4)) {
        let value = f32::from_le_bytes([word[0], word[1], word[2], word[3]]);
        if !value.is_finite() {
            return Err(StlError::NotFinite { facet, value });
        }
        *slot = f64::from(value);
    }
    let [normal, a, b, c] = points;
    add(mesh, Place::Facet(facet), normal, [a, b, c]);
    Ok(())
}

/// Solids one after another, each from `solid` to `endsolid`.
fn text(mesh: &mut Mesh, text: &str) -> Result<(), StlError> {
    let mut lines = Lines { rest: text.lines().enumerate(), line: 0, words: Vec::new() };
    while lines.next() {
        lines.expect("solid", "solid")?;
        while !(lines.next() && lines.starts("endsolid")) {
            let place = Place::Line(lines.line);
            let normal = lines.numbers("facet normal", "facet normal x y z")?;
            lines.next();
            lines.expect("outer loop", "outer loop")?;
            let mut corners = [[0.0; 3]; 3];
            for corner in &mut corners {
                lines.next();
                *corner = lines.numbers("vertex", "vertex x y z")?;
            }
            lines.next();
            if lines.starts("vertex") {
                return Err(StlError::Fourth { line: lines.line });
            }
            lines.expect("endloop", "endloop")?;
            lines.next();
            lines.expect("endfacet", "endfacet")?;
            add(mesh, place, normal, corners);
        }
    }
    Ok(())
}

/// Lines of a text that are not empty, as words.
struct Lines<'a> {
    rest: std::iter::Enumerate<std::str::Lines<'a>>,
    /// Number of the line at hand; behind the end, that of the last one.
    line: usize,
    /// Its words; none behind the end.
    words: Vec<&'a str>,
}

impl Lines<'_> {
    /// Goes on; `false` at the end.
    fn next(&mut self) -> bool {
        for (n, line) in self.rest.by_ref() {
            self.line = n + 1;
            self.words = line.split_whitespace().collect();
            if !self.words.is_empty() {
                return true;
            }
        }
        self.words.clear();
        false
    }

    /// Whether the line begins with these words, in any case.
    fn starts(&self, words: &str) -> bool {
        let mut own = self.words.iter();
        words.split(' ').all(|word| own.next().is_some_and(|own| own.eq_ignore_ascii_case(word)))
    }

    fn expect(&self, words: &str, need: &'static str) -> Result<(), StlError> {
        if self.starts(words) { Ok(()) } else { Err(self.need(need)) }
    }

    fn need(&self, need: &'static str) -> StlError {
        let got: String = self.words.join(" ").chars().take(40).collect();
        let got = if got.is_empty() { "the end of the file".into() } else { format!("`{got}`") };
        StlError::Need { line: self.line, need, got }
    }

    /// The three numbers behind these words.
    fn numbers(&self, words: &str, need: &'static str) -> Result<Point, StlError> {
        self.expect(words, need)?;
        let [x, y, z] = self.words[words.split(' ').count()..] else { return Err(self.need(need)) };
        let number = |text: &str| {
            let value = text.parse().ok().filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| StlError::NotNumber { line: self.line, text: text.to_owned() })
        };
        Ok([number(x)?, number(y)?, number(z)?])
    }
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests {
    use super::*;

    const FACET_TEXT: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 .5\nendloop\nendfacet\n";

    #[test]
    fn a_text_may_have_several_solids_and_any_case() {
        let text = format!(
            "solid\n\n{FACET_TEXT}endsolid\n SOLID two\n{}ENDSOLID two\n",
            FACET_TEXT.to_uppercase()
        );
        let mesh = parse(text.as_bytes()).unwrap();
        assert_eq!(mesh.triangles, [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]; 2]);
        assert_eq!(mesh.places, [3, 12].map(Place::Line));
        assert_eq!(mesh.sets[0].at(1, 2), [1.0; 3]);
    }

    #[test]
    fn the_length_tells_a_binary_file_from_a_text() {
        let mut file = b"solid, says the header of a binary file".to_vec();
        file.resize(80, b' ');
        file.extend(1u32.to_le_bytes());
        file.extend(
            [0f32, 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.5]
                .map(f32::to_le_bytes)
                .as_flattened(),
        );
        file.extend([0; 2]);
        let mesh = parse(&file).unwrap();
        assert_eq!(mesh.triangles, [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]]]);
        assert_eq!(mesh.sets[0].at(0, 2), [1.0; 3]);
        file[84..88].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(parse(&file).unwrap_err().to_string().contains("facet 0 (from 0): NaN"));
    }

    #[test]
    fn errors_name_line_and_count() {
        let facet = |change: [&str; 2]| {
            format!("solid a\n{}endsolid\n", FACET_TEXT.replacen(change[0], change[1], 1))
        };
        let mut long = vec![b' '; 80];
        long.extend(u32::MAX.to_le_bytes());
        for (file, want) in [
            (
                facet(["normal ", ""]).into_bytes(),
                "line 2: `facet normal x y z` is needed, got `facet 0 0 1`",
            ),
            (facet(["0 0 1", "0 0"]).into_bytes(), "line 2: `facet normal x y z` is needed"),
            (
                facet(["vertex 1 0 0\n", "vertex 1 nan 0\n"]).into_bytes(),
                "line 5: `nan` is not a finite number",
            ),
            (
                facet(["vertex 1 0 0\n", "vertex 1 x 0\n"]).into_bytes(),
                "line 5: `x` is not a finite number",
            ),
            (
                facet(["vertex 1 0 0\n", ""]).into_bytes(),
                "line 6: `vertex x y z` is needed, got `endloop`",
            ),
            (
                facet(["endloop", "vertex 1 1 1\nendloop"]).into_bytes(),
                "line 7: a facet has 3 vertices",
            ),
            (
                b"solid a\nfacet normal 0 0 1".to_vec(),
                "line 2: `outer loop` is needed, got the end of the file",
            ),
            (
                b"solid a\n".to_vec(),
                "line 1: `facet normal x y z` is needed, got the end of the file",
            ),
            (b"solid a\nendsolid\n".to_vec(), "no facets"),
            (
                long,
                "counts 4294967295 facets, 84 + 50 x 4294967295 = 214748364834 bytes, but the file has 84",
            ),
            (b"stl".to_vec(), "84 bytes or more: the file has 3"),
        ] {
            let text = parse(&file).unwrap_err().to_string();
            assert!(text.contains(want), "{want}: {text}");
        }
    }
}
