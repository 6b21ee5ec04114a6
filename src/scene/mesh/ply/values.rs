//! The numbers behind the header of a PLY file.

use super::PlyError;
use super::header::{Element, Kind, Property};

/// How numbers are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Little,
    Big,
}

impl Encoding {
    pub(super) fn named(name: &str) -> Option<Self> {
        match name {
            "ascii" => Some(Self::Text),
            "binary_little_endian" => Some(Self::Little),
            "binary_big_endian" => Some(Self::Big),
            _ => None,
        }
    }
}

/// What is left to read.
pub(super) struct Values<'a> {
    encoding: Encoding,
    rest: &'a [u8],
    /// Number of the line at hand, of a text.
    line: usize,
}

/// The numbers of one element, property by property.
#[derive(Default)]
pub(super) struct Read {
    /// The line of its first number, in a text.
    pub(super) line: Option<usize>,
    /// Of a list, its length.
    pub(super) numbers: Vec<f64>,
    /// Of a single number, nothing.
    pub(super) lists: Vec<Vec<f64>>,
}

impl Read {
    /// Its place in words.
    pub(super) fn words(&self, element: &str, n: usize) -> String {
        words(element, n, self.line)
    }
}

/// The place of an element in words.
pub(super) fn words(element: &str, n: usize, line: Option<usize>) -> String {
    let line = line.map_or_else(String::new, |line| format!("line {line}: "));
    format!("{line}{element} {n} (from 0)")
}

impl<'a> Values<'a> {
    /// What follows the header, which ends in this line.
    pub(super) fn new(encoding: Encoding, rest: &'a [u8], line: usize) -> Self {
        Self { encoding, rest, line: line + 1 }
    }

    /// Refuses a count that the rest of the file cannot hold, before anything is kept for it.
    pub(super) fn check(&self, element: &Element) -> Result<(), PlyError> {
        let (name, count, left) = (element.name.clone(), element.count, self.rest.len());
        let least = |property: &Property| property.list.unwrap_or(property.kind).size();
        let each = match self.encoding {
            // A digit, and a blank or a line end behind it.
            Encoding::Text => 2 * element.properties.len(),
            _ => element.properties.iter().map(least).sum(),
        };
        if each == 0 && count > 0 {
            return Err(PlyError::NoProperties { element: name, count });
        }
        // The last line of a text may lack its end.
        let need = (count as u128 * each as u128).saturating_sub(1);
        if need > left as u128 {
            return Err(PlyError::Count { element: name, count, need, left });
        }
        Ok(())
    }

    /// The next element.
    pub(super) fn element(&mut self, element: &Element, n: usize) -> Result<Read, PlyError> {
        let mut read = Read::default();
        for property in &element.properties {
            let mut number = |kind: Kind, values: &mut Self| {
                let word = values.number(kind);
                let line = (values.encoding == Encoding::Text).then_some(values.line);
                read.line = read.line.or(line);
                let place = || words(&element.name, n, line);
                let property = || property.name.clone();
                word.map_err(|text| match text {
                    None => PlyError::End { place: place(), property: property() },
                    Some(text) => {
                        let kind = kind.to_string();
                        PlyError::NotNumber { place: place(), property: property(), text, kind }
                    }
                })
            };
            let Some(length) = property.list else {
                read.numbers.push(number(property.kind, self)?);
                read.lists.push(Vec::new());
                continue;
            };
            let length = number(length, self)?;
            let mut list = Vec::new();
            let mut left = length;
            while left >= 1.0 {
                list.push(number(property.kind, self)?);
                left -= 1.0;
            }
            if length < 0.0 {
                let (place, property) = (read.words(&element.name, n), property.name.clone());
                return Err(PlyError::Length { place, property, length });
            }
            read.numbers.push(length);
            read.lists.push(list);
        }
        Ok(read)
    }

    /// The next number; the word that is none, or nothing at the end of the file.
    fn number(&mut self, kind: Kind) -> Result<f64, Option<String>> {
        if self.encoding == Encoding::Text {
            return self.word(kind);
        }
        let (bytes, rest) = self.rest.split_at_checked(kind.size()).ok_or(None)?;
        self.rest = rest;
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        if self.encoding == Encoding::Big {
            word[..bytes.len()].reverse();
        }
        let [a, b, c, d, ..] = word;
        Ok(match kind {
            Kind::I8 => i8::from_le_bytes([a]).into(),
            Kind::U8 => a.into(),
            Kind::I16 => i16::from_le_bytes([a, b]).into(),
            Kind::U16 => u16::from_le_bytes([a, b]).into(),
            Kind::I32 => i32::from_le_bytes([a, b, c, d]).into(),
            Kind::U32 => u32::from_le_bytes([a, b, c, d]).into(),
            Kind::F32 => f32::from_le_bytes([a, b, c, d]).into(),
            Kind::F64 => f64::from_le_bytes(word),
        })
    }

    /// The next word of a text as a number: as binary32 where the header says so, so that a text and a binary
    /// file of one mesh are the same mesh.
    fn word(&mut self, kind: Kind) -> Result<f64, Option<String>> {
        let blank = self.rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let (blanks, rest) = self.rest.split_at(blank);
        self.line += blanks.split(|byte| *byte == b'\n').count() - 1;
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        if word.is_empty() {
            return Err(None);
        }
        let text = String::from_utf8_lossy(word);
        let whole = |low: i64, high: i64| {
            let value = text.parse::<i64>().ok().filter(|value| (low..=high).contains(value))?;
            #[expect(clippy::cast_precision_loss, reason = "at most 32 bits")]
            let real = value as f64;
            Some(real)
        };
        let value = match kind {
            Kind::I8 => whole(i8::MIN.into(), i8::MAX.into()),
            Kind::U8 => whole(0, u8::MAX.into()),
            Kind::I16 => whole(i16::MIN.into(), i16::MAX.into()),
            Kind::U16 => whole(0, u16::MAX.into()),
            Kind::I32 => whole(i32::MIN.into(), i32::MAX.into()),
            Kind::U32 => whole(0, u32::MAX.into()),
            Kind::F32 => text.parse::<f32>().ok().map(f64::from),
            Kind::F64 => text.parse::<f64>().ok(),
        };
        value.ok_or_else(|| Some(text.chars().take(40).collect()))
    }
}
