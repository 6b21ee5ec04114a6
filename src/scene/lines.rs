//! JSON Lines: the form in which `guardbit eval` is asked, and scenes are stored.
//!
//! One object a line, with an optional `id` (any JSON value) and exactly one of
//!
//! | key | value | meaning |
//! | --- | --- | --- |
//! | `v` | `[[x,y,z],[x,y,z],[x,y,z]]` | integers: sub-pixels of the profile's lattice, depth ULPs |
//! | `f` | the same | reals: pixels, depth ULPs; or `{"bits": "7fc00000"}`, 8 hex digits for binary32, 16 for binary64 |
//! | `words` | `["...", ...]` | raw set-up registers in the profile's radix |
//! | `line` | `[[x,y],[x,y]]` | integers, as for `v` |
//! | `point` | `[x,y]` | integers, as for `v` |
//! | `polygon` | `[[x,y,z],...]`, three or more | integers, as for `v`, on machines that draw polygons |
//! | `clip` | `[[X,Y,Z,W],[X,Y,Z,W],[X,Y,Z,W]]` | integers: homogeneous window coordinates, X / W in sub-pixels and Z / W in depth ULPs; on machines that take them |
//! | `position` | `[[x,y,z,w],...]`, three | reals in clip space, on profiles with a `[viewport]` |
//!
//! Beside `v` and `f` there may be channels, each by the name that the profile gives it:
//!
//! | key | value | meaning |
//! | --- | --- | --- |
//! | `channels` | `{"color": [[r,g,b],[r,g,b],[r,g,b]]}` | beside `v` codes; beside `f` reals, 1 is the channel's `unit` |
//! | `q` | `[q,q,q]` | beside `v`: codes of 1/w |
//! | `w` | `[w,w,w]` | beside `f`: distances from the eye, above 0 |
//!
//! Beside `v`, `f` and `clip` there may be the depth bias of the draw call, in place of the profile's `[depth.bias]`;
//! a scene has none:
//!
//! | key | value | meaning |
//! | --- | --- | --- |
//! | `bias` | `{"constant": 2, "slope": 256, "clamp": 9, "unit": 1}` | integers, slope in 1/256; what is left out is 0, and unit 1 |
//!
//! In a scene the names are those that `source` of the channels gives, and there may be more of them, and more
//! components, than a profile takes.
//!
//! z may be left out, for all three vertices at once. An integer is a plain JSON number or a string
//! of decimal digits, and never passes through a double.

mod bias;
mod channels;
mod number;
mod object;
mod shape;
mod write;

use serde_json::value::RawValue;

use super::{Primitive, Shading, Triangle};
use crate::value::DepthBias;
use number::{integer, list, real, triple, word};
pub use write::to_line;

/// One line, read.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The `id` as raw JSON text, just as it was written.
    pub id: Option<String>,
    /// What the line asks to draw.
    pub primitive: Primitive,
    /// What its vertices bring for channels.
    pub shading: Option<Shading>,
    /// The depth bias of the draw call, in place of the profile's.
    pub bias: Option<DepthBias>,
}

/// A line that cannot be read: where in it, and why.
///
/// The line's own number is the caller's, who alone knows it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {fault}")]
pub struct LineError {
    /// The `id` as raw JSON text, where the line was a JSON object that had one.
    pub id: Option<String>,
    /// Where: a field such as ``field `v[1][0]` ``, or a column where the line is not JSON.
    pub place: String,
    /// Why.
    pub fault: Fault,
}

/// What can be wrong with a line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// Not JSON at all.
    #[error("not JSON: {0}")]
    Syntax(String),
    /// A value of the wrong kind.
    #[error("{need} is needed, got {got}")]
    Kind {
        /// What the field takes.
        need: &'static str,
        /// The start of what it got.
        got: String,
    },
    /// A list of the wrong length.
    #[error("{need}, got {got}")]
    Count {
        /// How many there should be.
        need: &'static str,
        /// How many there are.
        got: usize,
    },
    /// A key nobody reads.
    #[error(
        "unknown key; the known keys are id, v, f, words, line, point, polygon, clip, channels, q, w, \
         bias"
    )]
    UnknownKey,
    /// A key given twice.
    #[error("the key is given twice; remove one")]
    Duplicate,
    /// Nothing to draw.
    #[error(
        "nothing to draw: exactly one of v, f, words, line, point, polygon, clip, position is needed, got none"
    )]
    Nothing,
    /// Two things to draw.
    #[error(
        "exactly one of v, f, words, line, point, polygon, clip, position is needed, but `{first}` is given, too"
    )]
    Several {
        /// The one that came before.
        first: String,
    },
    /// z for some vertices only.
    #[error("{got} coordinates, but vertex 0 has {first}; give z for all vertices or for none")]
    MixedDepth {
        /// Coordinates of this vertex.
        got: usize,
        /// Coordinates of vertex 0.
        first: usize,
    },
    /// Another number of components at another vertex.
    #[error(
        "{got} components, but vertex 0 has {first}; give the same components for all vertices"
    )]
    MixedComponents {
        /// Components of this vertex.
        got: usize,
        /// Components of vertex 0.
        first: usize,
    },
    /// w in the other form.
    #[error(
        "beside `{key}`, w is given as `{need}`: `q` has codes of 1/w, `w` has distances from the eye"
    )]
    OtherW {
        /// The key that is needed.
        need: &'static str,
        /// The key of the vertices.
        key: &'static str,
    },
    /// w without channels.
    #[error("w is given, but no `channels`; give the channels that need it, or leave it out")]
    OnlyW,
    /// A w beside positions, which have it.
    #[error("a position has its w; leave this out")]
    OwnW,
    /// Channels of what has none.
    #[error("only triangles under `v`, `f` or `position` have channels")]
    NoVertices,
    /// A depth bias of what has no depth slope.
    #[error("only triangles under `v`, `f`, `position` or `clip` have a depth bias; leave it out")]
    NoBias,
    /// A depth bias in a scene.
    #[error(
        "a triangle of a scene has no depth bias of its own; write [depth.bias] in the profile, or give the \
         lines to `guardbit eval`"
    )]
    BiasOfScene,
    /// A key of a depth bias that nobody reads.
    #[error("unknown key; the keys of a depth bias are constant, slope, clamp, unit")]
    UnknownTerm,
    /// A number with a fraction or an exponent, or no number, where an integer is needed.
    #[error(
        "{0} is not an integer; write decimal digits without point or exponent, or use `f` for real numbers"
    )]
    NotInteger(String),
    /// An integer beyond 128 bits.
    #[error("{0} is out of range, -2^127 <= value <= 2^127 - 1 is needed")]
    TooWide(String),
    /// A real beyond a double.
    #[error(
        "{0} is out of range, |value| < 2^1024 is needed; write an infinity as {{\"bits\": \"7f800000\"}}"
    )]
    Overflow(String),
    /// Not a bit pattern.
    #[error("{0} is not a bit pattern; write 8 hex digits (binary32) or 16 (binary64)")]
    Pattern(String),
    /// A request that is no triangle, in a scene.
    #[error("a scene contains only triangles: `v` or `f`")]
    NotTriangle,
}

/// A fault and its field, before the id is known: what the readers of parts return.
type Part<T> = Result<T, (String, Fault)>;

/// Reads one line.
///
/// # Errors
/// [`LineError`], with the field and, where the line was a JSON object with an `id`, the id.
pub fn parse_line(line: &str) -> Result<Request, LineError> {
    let (id, read) = object::members(line)
        .map_err(|(place, fault)| LineError { id: None, place, fault })
        .map(|members| {
            let id = members.iter().find(|(key, _)| key == "id");
            (id.map(|(_, raw)| raw.get().to_owned()), asked(&members))
        })?;
    match read {
        Ok((primitive, shading, bias)) => Ok(Request { id, primitive, shading, bias }),
        Err((field, fault)) => {
            let place = if field.is_empty() { "line".into() } else { format!("field `{field}`") };
            Err(LineError { id, place, fault })
        }
    }
}

/// A triangle of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneLine {
    /// Line number, from 1.
    pub line: usize,
    /// The triangle.
    pub triangle: Triangle,
    /// What its vertices bring for channels.
    pub shading: Option<Shading>,
}

/// Reads a scene: one triangle a line; empty lines count but say nothing.
///
/// # Errors
/// The line's number from 1, and what is wrong with it.
pub fn parse_scene(text: &str) -> Result<Vec<SceneLine>, (usize, LineError)> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut triangles = Vec::new();
    for (index, text) in text.lines().enumerate() {
        if text.trim().is_empty() {
            continue;
        }
        let line = index + 1;
        let Request { id, primitive, shading, bias } =
            parse_line(text).map_err(|error| (line, error))?;
        let place = format!("field `{}`", primitive.key());
        let Primitive::Triangle(triangle) = primitive else {
            return Err((line, LineError { id, place, fault: Fault::NotTriangle }));
        };
        if bias.is_some() {
            let place = "field `bias`".to_owned();
            return Err((line, LineError { id, place, fault: Fault::BiasOfScene }));
        }
        triangles.push(SceneLine { line, triangle, shading });
    }
    Ok(triangles)
}

/// What a line may draw, then what may stand beside it.
const KEYS: [&str; 13] = [
    "v", "f", "words", "line", "point", "polygon", "clip", "position", "id", "channels", "q", "w",
    "bias",
];

/// The keys that draw.
const DRAWN: usize = 8;

/// What to draw, what its vertices bring, and the bias of its depth.
type Asked = (Primitive, Option<Shading>, Option<DepthBias>);

fn asked(members: &[(String, &RawValue)]) -> Part<Asked> {
    let primitive = primitive(members)?;
    let mut shading = channels::shading(members, primitive.key())?;
    if let (Primitive::Position(positions), Some(Shading::Reals { w, .. })) =
        (&primitive, &mut shading)
    {
        *w = Some(positions.0.map(|[.., w]| w.into()));
    }
    let bias = bias::bias(members, primitive.key())?;
    Ok((primitive, shading, bias))
}

fn primitive(members: &[(String, &RawValue)]) -> Part<Primitive> {
    for (index, (key, _)) in members.iter().enumerate() {
        if !KEYS.contains(&key.as_str()) {
            return Err((key.clone(), Fault::UnknownKey));
        }
        if members.iter().take(index).any(|(before, _)| before == key) {
            return Err((key.clone(), Fault::Duplicate));
        }
    }
    let mut drawn = members.iter().filter(|(key, _)| KEYS[..DRAWN].contains(&key.as_str()));
    let (key, raw) = drawn.next().ok_or((String::new(), Fault::Nothing))?;
    if let Some((second, _)) = drawn.next() {
        return Err((second.clone(), Fault::Several { first: key.clone() }));
    }
    match key.as_str() {
        "v" => vertices(raw, "v", integer)
            .map(|(xy, z)| Primitive::Triangle(Triangle::Lattice { xy, z })),
        "f" => {
            vertices(raw, "f", real).map(|(xy, z)| Primitive::Triangle(Triangle::Real { xy, z }))
        }
        "words" => list(raw, "words")?
            .into_iter()
            .enumerate()
            .map(|(index, raw)| word(raw, &format!("words[{index}]")))
            .collect::<Part<_>>()
            .map(Primitive::Words),
        "line" => match list(raw, "line")?.as_slice() {
            [from, to] => Ok(Primitive::Line([point(from, "line[0]")?, point(to, "line[1]")?])),
            ends => Err(count("line", "2 end points are needed", ends.len())),
        },
        "polygon" => shape::polygon(raw).map(Primitive::Polygon),
        "clip" => shape::clip(raw).map(Primitive::Clip),
        "position" => shape::position(raw).map(Primitive::Position),
        _ => point(raw, "point").map(Primitive::Point),
    }
}

fn count(field: &str, need: &'static str, got: usize) -> (String, Fault) {
    (field.to_owned(), Fault::Count { need, got })
}

fn point(raw: &RawValue, field: &str) -> Part<[i128; 2]> {
    match list(raw, field)?.as_slice() {
        [x, y] => Ok([integer(x, &format!("{field}[0]"))?, integer(y, &format!("{field}[1]"))?]),
        other => Err(count(field, "2 coordinates x, y are needed", other.len())),
    }
}

/// x, y of three vertices, and z of all three where given.
type Vertices<T> = ([[T; 2]; 3], Option<[T; 3]>);

fn vertices<T: Copy>(
    raw: &RawValue,
    field: &str,
    number: impl Fn(&RawValue, &str) -> Part<T>,
) -> Part<Vertices<T>> {
    let corners = list(raw, field)?;
    let [first, second, third] = corners.as_slice() else {
        return Err(count(field, "3 vertices are needed", corners.len()));
    };
    let read = |raw, index| triple(raw, &format!("{field}[{index}]"), &number);
    let read = [read(first, 0)?, read(second, 1)?, read(third, 2)?];
    let xy = read.map(|(xy, _)| xy);
    match read.map(|(_, z)| z) {
        [None, None, None] => Ok((xy, None)),
        [Some(z0), Some(z1), Some(z2)] => Ok((xy, Some([z0, z1, z2]))),
        [z0, z1, _] => {
            let length = |z: Option<T>| if z.is_some() { 3 } else { 2 };
            let (odd, got) =
                if length(z1) == length(z0) { (2, 5 - length(z0)) } else { (1, length(z1)) };
            Err((format!("{field}[{odd}]"), Fault::MixedDepth { got, first: length(z0) }))
        }
    }
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests;
