//! OBJ meshes: faces, and the positions, texture coordinates, normals and colours of their corners.
//! Everything else is passed over.
//!
//! Read by hand rather than with the `obj` crate: that reads positions as binary32, turns an index
//! out of range into a huge one without an error, counts lines from 0, and forgets on which line a
//! face stood.

mod error;

pub use error::ObjError;

use super::face::{Crossing, triangles};
use super::{Mesh, Place, Point};
use crate::scene::AttributeSet;

/// The kinds of values that a corner refers to, in the order in which it does.
const REFERRED: [(&str, &str); 3] =
    [("v", "vertex"), ("vt", "texture coordinate"), ("vn", "normal")];

/// Reads an OBJ mesh; a face of more than three corners becomes triangles that cover it once.
///
/// # Errors
/// [`ObjError`], with line and field.
pub fn parse(text: &str) -> Result<Mesh, ObjError> {
    let mut listed = Listed::default();
    let mut faces = Vec::new();
    for (line, statement) in statements(text) {
        let mut words = statement.split_whitespace();
        match words.next() {
            Some("v") => listed.vertex(line, words)?,
            Some("vt") => {
                let [u, v] = numbers(line, "vt", ["u", "v"], ("2: u v", words))?;
                listed.textures.push([u, v]);
            }
            Some("vn") => {
                let normal = numbers(line, "vn", ["x", "y", "z"], ("3: x y z", words))?;
                listed.normals.push(normal);
            }
            Some("f") => faces.push((line, face(line, words, listed.counts())?)),
            _ => {}
        }
    }
    if faces.is_empty() {
        return Err(ObjError::NoFaces { vertices: listed.points.len() });
    }
    let mut mesh = Mesh { sets: listed.sets(), ..Mesh::default() };
    for (line, corners) in faces {
        listed.check(line, &corners)?;
        let points: Vec<Point> =
            corners.iter().map(|corner| listed.points[corner.places[0]]).collect();
        let found = triangles(&points).map_err(|Crossing([one, two])| ObjError::Crosses {
            line,
            one: one + 1,
            two: two + 1,
        })?;
        for triangle in found {
            mesh.triangles.push(triangle.map(|n| points[n]));
            mesh.places.push(Place::Line(line));
            for n in triangle {
                listed.carry(&mut mesh.sets, n + 1, &corners[n]);
            }
        }
    }
    Ok(mesh)
}

/// What the statements above list.
#[derive(Default)]
struct Listed {
    points: Vec<Point>,
    colours: Vec<Option<[f64; 3]>>,
    textures: Vec<[f64; 2]>,
    normals: Vec<Point>,
}

/// A corner of a face: what it refers to, as places in the lists, and as it is written.
struct Corner {
    places: [usize; 3],
    written: [Option<i64>; 3],
}

impl Listed {
    fn counts(&self) -> [usize; 3] {
        [self.points.len(), self.textures.len(), self.normals.len()]
    }

    /// `x y z`, and a weight, a colour, or both: a weight is passed over, as no flat face needs it.
    fn vertex<'a>(
        &mut self,
        line: usize,
        words: impl Iterator<Item = &'a str>,
    ) -> Result<(), ObjError> {
        let words: Vec<_> = words.collect();
        let all = words.iter().copied();
        self.points.push(numbers(line, "v", ["x", "y", "z"], ("3: x y z", all.clone()))?);
        let colour = match words.len() {
            6 => Some(all.skip(3)),
            7 => Some(all.skip(4)),
            _ => None,
        };
        let read = |words| numbers(line, "v", ["r", "g", "b"], ("3 after x y z: r g b", words));
        self.colours.push(colour.map(read).transpose()?);
        Ok(())
    }

    /// The sets that the file has any values for.
    fn sets(&self) -> Vec<AttributeSet> {
        let kinds = [
            ("texcoord", 2, !self.textures.is_empty()),
            ("normal", 3, !self.normals.is_empty()),
            ("color", 3, self.colours.iter().any(Option::is_some)),
        ];
        let set = |(name, components, _)| AttributeSet::new(name, components);
        kinds.into_iter().filter(|(.., given)| *given).map(set).collect()
    }

    /// Refuses a corner that refers to what the whole file does not have.
    fn check(&self, line: usize, corners: &[Corner]) -> Result<(), ObjError> {
        for (n, corner) in corners.iter().enumerate() {
            for (kind, count) in self.counts().into_iter().enumerate() {
                if let Some(index) = corner.written[kind].filter(|_| corner.places[kind] >= count) {
                    let what = REFERRED[kind].1;
                    return Err(ObjError::OutOfRange { what, line, corner: n + 1, index, count });
                }
            }
        }
        Ok(())
    }

    /// Adds what a corner carries to every set.
    fn carry(&self, sets: &mut [AttributeSet], n: usize, corner: &Corner) {
        for set in sets {
            let place = |kind: usize| corner.written[kind].map(|_| corner.places[kind]);
            let (found, what): (Option<&[f64]>, &str) = match set.name {
                "texcoord" => (place(1).map(|at| &self.textures[at][..]), "texture coordinate"),
                "normal" => (place(2).map(|at| &self.normals[at][..]), "normal"),
                _ => (self.colours[corner.places[0]].as_ref().map(|c| &c[..]), "colour"),
            };
            if found.is_none() && set.missing.is_none() {
                set.missing = Some(format!("corner {n} of `f` has no {what}"));
            }
            set.values.extend(found.unwrap_or(&[f64::NAN; 3][..set.components]));
        }
    }
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

/// The first numbers of a statement; more may follow.
fn numbers<'a, const N: usize>(
    line: usize,
    statement: &'static str,
    fields: [&'static str; N],
    (need, words): (&'static str, impl Iterator<Item = &'a str>),
) -> Result<[f64; N], ObjError> {
    let words: Vec<_> = words.take(N).collect();
    let mut read = [0.0; N];
    if words.len() < N {
        return Err(ObjError::Short { line, statement, need, got: words.len() });
    }
    for ((slot, field), text) in read.iter_mut().zip(fields).zip(words) {
        let owned = || text.to_owned();
        *slot = match text.parse::<f64>() {
            Ok(value) if value.is_finite() => value,
            Ok(_) => return Err(ObjError::NotFinite { line, statement, field, text: owned() }),
            Err(_) => return Err(ObjError::NotNumber { line, statement, field, text: owned() }),
        };
    }
    Ok(read)
}

/// The corners of a face: `5`, `5/1`, `5//2` or `5/1/2`.
fn face<'a>(
    line: usize,
    words: impl Iterator<Item = &'a str>,
    counts: [usize; 3],
) -> Result<Vec<Corner>, ObjError> {
    let corners = words.enumerate().map(|(place, text)| {
        let corner = place + 1;
        let wrong = || ObjError::NotIndex { line, corner, text: text.to_owned() };
        let mut read = Corner { places: [0; 3], written: [None; 3] };
        for (kind, part) in text.split('/').enumerate() {
            if kind > 2 || (part.is_empty() && (kind == 0 || text.ends_with('/'))) {
                return Err(wrong());
            }
            if part.is_empty() {
                continue;
            }
            let (index, count): (i64, usize) = (part.parse().map_err(|_| wrong())?, counts[kind]);
            let magnitude = usize::try_from(index.unsigned_abs()).unwrap_or(usize::MAX);
            let position = if index > 0 {
                // May name one further down; checked when all are read.
                Some(magnitude - 1)
            } else {
                count.checked_sub(magnitude).filter(|_| index < 0)
            };
            let what = REFERRED[kind].1;
            read.written[kind] = Some(index);
            read.places[kind] =
                position.ok_or(ObjError::OutOfRange { what, line, corner, index, count })?;
        }
        Ok(read)
    });
    let corners = corners.collect::<Result<Vec<_>, _>>()?;
    if corners.len() < 3 {
        return Err(ObjError::Corners { line, got: corners.len() });
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

    fn faces(tail: &str) -> Result<Vec<[Point; 3]>, ObjError> {
        Ok(parse(&format!("{FOUR}{tail}"))?.triangles)
    }

    #[test]
    fn a_polygon_is_a_fan() {
        assert_eq!(faces("f 1 2 3 4").unwrap(), [[A, B, C], [A, C, D]]);
        assert_eq!(faces("f -4 -3 -2 -1").unwrap(), [[A, B, C], [A, C, D]]);
    }

    #[test]
    fn other_statements_comments_and_continuations_are_passed_over() {
        let tail =
            "mtllib none.mtl\r\ng a\r\nusemtl b\r\ns off\r\nf 1 2 \\\r\n 3 # c \\\r\n\r\nf 2 3 4\\";
        assert_eq!(faces(tail).unwrap(), [[A, B, C], [B, C, D]]);
    }

    #[test]
    fn a_face_may_stand_above_its_vertices() {
        assert_eq!(parse(&format!("f 1 2 3\n{FOUR}")).unwrap().triangles, [[A, B, C]]);
    }

    #[test]
    fn binary64_is_kept() {
        let mesh = parse("v 0.1 1e300 0\nv 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3").unwrap().triangles;
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
                ObjError::OutOfRange {
                    what: "vertex",
                    line: 6,
                    corner: 3,
                    index: written,
                    count: 4
                }
            );
            let text = error.to_string();
            assert!(
                text.contains("line 6") && text.contains("corner 3") && text.contains("<= 4"),
                "{text}"
            );
        }
        // Counting back reaches only the vertices above.
        let error = parse(&format!("v 0 0 0\nf -1 -1 -2\n{FOUR}")).unwrap_err();
        let what = "vertex";
        let (line, corner, index, count) = (2, 3, -2, 1);
        assert_eq!(error, ObjError::OutOfRange { what, line, corner, index, count });
    }

    #[test]
    fn errors_name_line_and_field() {
        for (tail, want) in [
            ("v 1 2\n", "line 5: `v` has 2 numbers, but needs 3: x y z"),
            ("vt 1\n", "line 5: `vt` has 1 numbers, but needs 2: u v"),
            ("vn 1 2 x\n", "line 5: field `z` of `vn`: `x`"),
            ("v 1 2 3 4 5 x\n", "line 5: field `b` of `v`: `x`"),
            ("f 1/1 2 3\n", "line 5: corner 1 of `f`: there is no texture coordinate with index 1"),
            ("f 1//-1 2 3\n", "line 5: corner 1 of `f`: there is no normal with index -1"),
            ("f 1/ 2 3\n", "line 5: corner 1 of `f`: `1/`"),
            ("f 1/1/1/1 2 3\n", "line 5: corner 1"),
            ("v 2 -1 0\nf 1 3 2 5 4\n", "line 6: `f` crosses itself"),
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

    #[test]
    fn corners_carry_what_they_refer_to() {
        let text = "v 0 0 0 1 0 0\nv 1 0 0 .5 0 1 0\nv 1 1 .5\nvt 0 0\nvt 1 0 9\nvt .5 1\nvn 0 0 1\n\
                    f 1/1/1 2/2/-1 3/3\nf 1/3//1 2 3\n";
        assert!(parse(text).unwrap_err().to_string().contains("line 9: corner 1"));
        let mesh = parse(&text.replace("1/3//1", "1//1")).unwrap();
        let names: Vec<_> = mesh.sets.iter().map(|set| (set.name, set.components)).collect();
        assert_eq!(names, [("texcoord", 2), ("normal", 3), ("color", 3)]);
        assert_eq!(mesh.places, [8, 9].map(Place::Line));
        let [texture, normal, colour] = &mesh.sets[..] else { unreachable!("three sets") };
        assert_eq!([texture.at(0, 0), texture.at(0, 1)], [[0.0, 1.0, 0.5], [0.0, 0.0, 1.0]]);
        assert!(texture.at(1, 0).iter().all(|u| u.is_nan()));
        assert_eq!(texture.missing.as_deref(), Some("corner 1 of `f` has no texture coordinate"));
        assert_eq!(normal.at(0, 2)[..2], [1.0, 1.0]);
        assert_eq!(normal.missing.as_deref(), Some("corner 3 of `f` has no normal"));
        assert_eq!([colour.at(0, 0)[0], colour.at(0, 1)[1]], [1.0, 1.0]);
        assert_eq!(colour.at(1, 1)[1], 1.0);
        assert_eq!(colour.missing.as_deref(), Some("corner 3 of `f` has no colour"));
    }
}
