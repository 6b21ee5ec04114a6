//! The header of a PLY file: its encoding, and the elements in their order.

use super::PlyError;
use super::values::{Encoding, Values};

/// Things of one name, such as vertices.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// A number, or a list of them.
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
    /// The kind of the length, of a list.
    pub(super) list: Option<Kind>,
}

/// The kind of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// Kinds by the two names that each has.
const KINDS: [(Kind, [&str; 2]); 8] = [
    (Kind::I8, ["char", "int8"]),
    (Kind::U8, ["uchar", "uint8"]),
    (Kind::I16, ["short", "int16"]),
    (Kind::U16, ["ushort", "uint16"]),
    (Kind::I32, ["int", "int32"]),
    (Kind::U32, ["uint", "uint32"]),
    (Kind::F32, ["float", "float32"]),
    (Kind::F64, ["double", "float64"]),
];

impl Kind {
    fn named(name: &str) -> Option<Self> {
        KINDS.iter().find(|(_, names)| names.contains(&name)).map(|(kind, _)| *kind)
    }

    /// Bytes in a binary file.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_real(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }

    /// The number of this kind that a colour has for 1.
    pub(super) fn unit(self) -> f64 {
        match self {
            Self::U8 => 255.0,
            Self::U16 => 65_535.0,
            Self::U32 => 4_294_967_295.0,
            Self::I8 | Self::I16 | Self::I32 | Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// Reads the header; what follows it is to be read.
pub(super) fn read(bytes: &[u8]) -> Result<(Vec<Element>, Values<'_>), PlyError> {
    let (mut at, mut line) = (0, 0);
    let mut next = || {
        let rest = &bytes[at..];
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let end = end.ok_or(PlyError::Open { line: line + 1 })?;
        // A line may end in \r\n: one end, not two.
        let two = rest[end] == b'\r' && rest.get(end + 1) == Some(&b'\n');
        at += end + 1 + usize::from(two);
        line += 1;
        Ok((line, String::from_utf8_lossy(&rest[..end]).into_owned(), at))
    };
    if !bytes.starts_with(b"ply") || next()?.1.trim_end() != "ply" {
        return Err(PlyError::NotPly);
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let (line, text, end) = next()?;
        let words: Vec<&str> = text.split_whitespace().collect();
        let wrong = |need| PlyError::Header { line, got: text.chars().take(60).collect(), need };
        match words[..] {
            ["comment" | "obj_info", ..] => {}
            ["format", name, "1.0"] => {
                let found = Encoding::named(name);
                encoding = Some(found.ok_or_else(|| wrong(FORMAT))?);
            }
            ["format", ..] => return Err(wrong(FORMAT)),
            ["element", name, count] => {
                let count = count.parse().map_err(|_| wrong("write `element NAME COUNT`"))?;
                if elements.iter().any(|known| known.name == name) {
                    return Err(PlyError::Twice { line, name: name.to_owned() });
                }
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
            }
            ["property", ..] => {
                let property = property(&words).ok_or_else(|| wrong(PROPERTY))?;
                let element = elements.last_mut().ok_or_else(|| wrong("an element comes first"))?;
                if element.properties.iter().any(|known| known.name == property.name) {
                    return Err(PlyError::Twice { line, name: property.name });
                }
                element.properties.push(property);
            }
            ["end_header"] => {
                let encoding = encoding.ok_or_else(|| wrong("a line `format` comes before"))?;
                return Ok((elements, Values::new(encoding, &bytes[end..], line)));
            }
            _ => return Err(wrong("write format, comment, element, property or end_header")),
        }
    }
}

const FORMAT: &str =
    "write `format ascii 1.0`, `format binary_little_endian 1.0` or `format binary_big_endian 1.0`";
const PROPERTY: &str = "write `property KIND NAME` or `property list KIND KIND NAME`; the kinds are char, uchar, \
                        short, ushort, int, uint, float and double";

fn property(words: &[&str]) -> Option<Property> {
    let (kind, list, name) = match words {
        [_, "list", length, kind, name] => {
            (kind, Some(Kind::named(length).filter(|kind| !kind.is_real())?), name)
        }
        [_, kind, name] => (kind, None, name),
        _ => return None,
    };
    Some(Property { name: (*name).to_owned(), kind: Kind::named(kind)?, list })
}

/// The first name of a kind.
impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(KINDS[*self as usize].1[0])
    }
}
