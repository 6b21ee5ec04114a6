//! Lists of 32-bit words and the bit fields in them: how registers reach a machine, and how what it
//! draws is written. Spec clauses `RG-1` to `RG-3`.

use crate::bits::hex_digits;
use std::fmt::Write as _;

/// Bits of a word of a list.
pub const WORD: u32 = 32;

/// A list of words by the fields in each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    words: Vec<WordFields>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct WordFields {
    fields: Vec<Field>,
    style: Style,
}

/// Part of a word, and the part of a named value that it holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// The value; a name that begins with `-` says what the hardware does not look at.
    pub name: String,
    /// Lowest bit of the value that lies here.
    pub piece: u32,
    /// Bits.
    pub width: u32,
    /// Lowest bit of the word that it takes.
    pub at: u32,
}

/// How a word is written as text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Style {
    /// Hexadecimal of at least so many digits.
    Hexadecimal(usize),
    /// Hexadecimal without leading zeros.
    #[default]
    Short,
    /// Signed decimal.
    Decimal,
}

/// A word list that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LayoutError {
    /// A field that cannot be read.
    #[error(
        "word {word}: {text:?} is not a field; a field is NAME, NAME:BITS, NAME:BITS@LOWEST or \
         NAME[FROM]:BITS@LOWEST, and a style is %d or %1x to %8x"
    )]
    Field {
        /// Which word, from 0.
        word: usize,
        /// The field.
        text: String,
    },
    /// A field beyond its word.
    #[error(
        "word {word}: {name} has {width} bits from bit {at} up; a field has at least 1 bit and must lie in \
         bits 0 to 31"
    )]
    Beyond {
        /// Which word, from 0.
        word: usize,
        /// The field.
        name: String,
        /// Its lowest bit.
        at: u32,
        /// Its bits.
        width: u32,
    },
    /// Two fields on one bit.
    #[error("word {word}: {name} overlaps another field")]
    Overlap {
        /// Which word, from 0.
        word: usize,
        /// The field.
        name: String,
    },
    /// A piece of a value that is longer than 64 bits.
    #[error("word {word}: the pieces of {name} have more than 64 bits together")]
    Long {
        /// Which word, from 0.
        word: usize,
        /// The field.
        name: String,
    },
    /// No words at all.
    #[error("the list of words is empty; it needs at least one word")]
    Empty,
}

impl Layout {
    /// Reads a list of words, each a text of fields separated by blanks.
    ///
    /// ```
    /// use guardbit::format::Layout;
    /// let input = Layout::parse(&["x:11", "-mode:4@28 rows:11@16 count:11"])?;
    /// let rows = input.find("rows").ok_or("no rows")?;
    /// assert_eq!(rows.unsigned(&[0x7ff, 0x8005_0003]), 5);
    /// assert_eq!(input.find("x").ok_or("no x")?.signed(&[0x7ff, 0]), -1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`LayoutError`] names word and field.
    pub fn parse<S: AsRef<str>>(words: &[S]) -> Result<Self, LayoutError> {
        if words.is_empty() {
            return Err(LayoutError::Empty);
        }
        let words = words.iter().enumerate();
        let words = words.map(|(word, text)| WordFields::parse(word, text.as_ref()));
        Ok(Self { words: words.collect::<Result<_, _>>()? })
    }

    /// How many words.
    pub fn len(&self) -> usize {
        self.words.len()
    }

    /// Whether there are none; a parsed list has some.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The fields of a word, from its lowest bit up.
    pub fn fields(&self, word: usize) -> &[Field] {
        self.words.get(word).map_or(&[], |word| &word.fields)
    }

    /// The names in it, those of what nobody looks at left out.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let fields = self.words.iter().flat_map(|word| &word.fields);
        fields.map(|field| field.name.as_str()).filter(|name| !name.starts_with('-'))
    }

    /// Where a value lies, if it is in the list.
    pub fn find(&self, name: &str) -> Option<Gather> {
        let mut pieces = Vec::new();
        for (word, fields) in self.words.iter().enumerate() {
            pieces.extend(
                fields.fields.iter().filter(|field| field.name == name).map(|field| Piece {
                    word,
                    from: field.piece,
                    width: field.width,
                    at: field.at,
                }),
            );
        }
        (!pieces.is_empty()).then_some(Gather { pieces })
    }

    /// Names of the words that say more than their fields hold: bits that are neither 0 nor copies of
    /// the uppermost field's sign. The hardware has no wires for them.
    pub fn dropped(&self, words: &[u32]) -> Vec<String> {
        let kept = |fields: &WordFields, word: u32| {
            let (mut mask, mut top) = (0u32, 0);
            for field in &fields.fields {
                mask |= ones(field.width) << field.at;
                top = top.max(field.at + field.width);
            }
            let above = if top >= WORD { 0 } else { u32::MAX << top };
            let signed = top > 0 && word >> (top - 1) & 1 == 1 && word & !mask == above;
            word & !mask == 0 || signed
        };
        let all = self.words.iter().zip(words).enumerate();
        all.filter(|(_, (fields, word))| !kept(fields, **word))
            .map(|(n, (fields, _))| fields.name(n))
            .collect()
    }

    /// A name for each word: its fields, joined.
    pub fn word_names(&self) -> Vec<String> {
        self.words.iter().enumerate().map(|(n, word)| word.name(n)).collect()
    }

    /// A list ready to be filled from values in the order of `names`.
    ///
    /// # Errors
    /// The field that is no name.
    pub fn packer(&self, names: &[String]) -> Result<Packer, String> {
        let mut words = Vec::new();
        for word in &self.words {
            let mut parts = Vec::new();
            for field in word.fields.iter().filter(|field| !field.name.starts_with('-')) {
                let from = names.iter().position(|name| *name == field.name);
                let from = from.ok_or_else(|| field.name.clone())?;
                parts.push((from, field.piece, ones(field.width), field.at));
            }
            words.push(parts);
        }
        Ok(Packer { words })
    }

    /// Writes a word as text.
    pub fn push_text(&self, index: usize, word: u32, out: &mut String) {
        let digits = match self.words.get(index).map(|word| word.style).unwrap_or_default() {
            Style::Hexadecimal(digits) => digits.max(significant(word)),
            Style::Short => significant(word),
            Style::Decimal => {
                // Writing to a String cannot fail.
                let _ = write!(out, "{}", word.cast_signed());
                return;
            }
        };
        let text = hex_digits(u64::from(word));
        // Digits are ASCII.
        out.push_str(std::str::from_utf8(&text[16 - digits..]).unwrap_or_default());
    }
}

/// Hexadecimal digits of a word without leading zeros, one at least.
const fn significant(word: u32) -> usize {
    let digits = (WORD - word.leading_zeros()).div_ceil(4) as usize;
    if digits == 0 { 1 } else { digits }
}

const fn ones(width: u32) -> u32 {
    if width >= WORD { u32::MAX } else { (1 << width) - 1 }
}

impl WordFields {
    fn parse(word: usize, text: &str) -> Result<Self, LayoutError> {
        let mut found = Self { fields: Vec::new(), style: Style::default() };
        let mut taken = 0u32;
        for part in text.split_whitespace() {
            let fault = || LayoutError::Field { word, text: part.to_owned() };
            if let Some(style) = part.strip_prefix('%') {
                found.style = if style == "d" {
                    Style::Decimal
                } else {
                    let digits = style.strip_suffix('x').and_then(|n| n.parse().ok());
                    let digits = digits.filter(|digits| (1..=8).contains(digits));
                    Style::Hexadecimal(digits.ok_or_else(fault)?)
                };
                continue;
            }
            let field = Field::parse(part).ok_or_else(fault)?;
            let name = field.name.clone();
            if field.width == 0 || field.at >= WORD || field.width > WORD - field.at {
                let Field { at, width, .. } = field;
                return Err(LayoutError::Beyond { word, name, at, width });
            }
            if field.piece > 64 - field.width {
                return Err(LayoutError::Long { word, name });
            }
            let mask = ones(field.width) << field.at;
            if taken & mask != 0 {
                return Err(LayoutError::Overlap { word, name });
            }
            taken |= mask;
            found.fields.push(field);
        }
        found.fields.sort_by_key(|field| field.at);
        Ok(found)
    }

    fn name(&self, index: usize) -> String {
        let mut names: Vec<String> = Vec::new();
        for field in self.fields.iter().rev() {
            let name = field.name.trim_start_matches('-');
            let name =
                if field.piece > 0 { format!("{name}_{}", field.piece) } else { name.into() };
            if !name.is_empty() {
                names.push(name);
            }
        }
        if names.is_empty() { format!("unused{index}") } else { names.join("_") }
    }
}

impl Field {
    /// `NAME`, `NAME:BITS`, `NAME:BITS@LOWEST`, each with `[FROM]` after the name.
    fn parse(text: &str) -> Option<Self> {
        let (head, at) =
            text.split_once('@').map_or((text, Some(0)), |(head, at)| (head, at.parse().ok()));
        let (head, width) = head
            .split_once(':')
            .map_or((head, Some(WORD)), |(head, width)| (head, width.parse().ok()));
        let (name, piece) = match head.strip_suffix(']') {
            Some(head) => {
                let (name, piece) = head.split_once('[')?;
                (name, piece.parse().ok().filter(|piece| *piece < 64))
            }
            None => (head, Some(0)),
        };
        let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        let plain = name.strip_prefix('-').unwrap_or(name);
        let good = plain.chars().all(legal)
            && plain.chars().next().map_or(name == "-", |first| first.is_ascii_lowercase());
        good.then_some(Self { name: name.to_owned(), piece: piece?, width: width?, at: at? })
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Piece {
    word: usize,
    from: u32,
    width: u32,
    at: u32,
}

/// Where the bits of a value lie in a list of words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gather {
    pieces: Vec<Piece>,
}

impl Gather {
    /// Bits of the value.
    pub fn bits(&self) -> u32 {
        self.pieces.iter().map(|piece| piece.from + piece.width).max().unwrap_or(0)
    }

    /// The lowest bit of the value that is in the list.
    pub fn lowest(&self) -> u32 {
        self.pieces.iter().map(|piece| piece.from).min().unwrap_or(0)
    }

    /// The value, zeros above its bits.
    pub fn unsigned(&self, words: &[u32]) -> u64 {
        self.pieces.iter().fold(0, |value, piece| {
            let word = words.get(piece.word).copied().unwrap_or(0);
            value | u64::from(word >> piece.at & ones(piece.width)) << piece.from
        })
    }

    /// The value, two's complement.
    pub fn signed(&self, words: &[u32]) -> i64 {
        let above = 64 - self.bits();
        (self.unsigned(words) << above).cast_signed() >> above
    }

    /// Puts the low bits of a value where they lie.
    pub fn scatter(&self, value: i128, words: &mut [u32]) {
        for piece in &self.pieces {
            if let Some(word) = words.get_mut(piece.word) {
                let bits = low(value.cast_unsigned() >> piece.from) & ones(piece.width);
                *word = *word & !(ones(piece.width) << piece.at) | bits << piece.at;
            }
        }
    }
}

/// A list of words, ready to be filled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packer {
    /// A word: which value, from which bit, which bits of it, and to where.
    words: Vec<Vec<(usize, u32, u32, u32)>>,
}

impl Packer {
    /// The words of these values.
    pub fn words<'a>(&'a self, values: &'a [i64]) -> impl Iterator<Item = u32> + 'a {
        self.words.iter().map(|parts| {
            parts.iter().fold(0, |word, &(from, piece, mask, at)| {
                let value = values.get(from).copied().unwrap_or(0).cast_unsigned();
                word | (low(value >> piece) & mask) << at
            })
        })
    }
}

/// The low 32 bits.
fn low(value: impl Into<u128>) -> u32 {
    let [a, b, c, d, ..] = value.into().to_le_bytes();
    u32::from_le_bytes([a, b, c, d])
}
