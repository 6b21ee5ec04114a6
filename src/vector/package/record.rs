//! One file's record as hardware sees it: a nibble-aligned packed word and a line of text.

use super::FileLayout;
use super::keyword::{identifier, unique};
use super::template::comment;
use crate::format::Column;

/// A column placed in its packed word.
pub(super) struct Field<'a> {
    /// Legal and unique identifier in every target language.
    pub(super) id: String,
    /// What the column is.
    pub(super) column: &'a Column,
    /// Bit of the packed word that holds the column's lowest bit, a multiple of 4.
    pub(super) lsb: u32,
}

impl Field<'_> {
    /// Bits of the packed word above the column's own, up to the next nibble: 0 to 3.
    pub(super) fn pad(&self) -> u32 {
        self.column.width.next_multiple_of(4) - self.column.width
    }

    /// Highest bit of the value in the packed word.
    pub(super) fn msb(&self) -> u32 {
        self.lsb + self.column.width - 1
    }

    /// Upper-case name for constants.
    pub(super) fn constant(&self) -> String {
        self.id.to_uppercase()
    }

    /// One line for people: name in the file, shape, meaning.
    pub(super) fn comment(&self) -> String {
        let sign = if self.column.signed { "signed" } else { "unsigned" };
        let Column { name, width, fraction, meaning, .. } = self.column;
        comment(&format!("{name}: {sign}, width {width}, fraction bits {fraction}. {meaning}"))
    }
}

/// A file placed in hardware: the first column lies at the top of the packed word.
pub(super) struct Record<'a> {
    /// Lower-case identifier, `dda_exp` for `dda.exp.tv`.
    pub(super) id: String,
    /// The file itself.
    pub(super) file: &'a FileLayout,
    /// Columns from left to right, from the top of the packed word down.
    pub(super) fields: Vec<Field<'a>>,
    /// Width of the packed word: four bits a digit.
    pub(super) bits: u32,
    /// Characters of a line, its newline included.
    pub(super) line: u32,
}

impl<'a> Record<'a> {
    /// Places every column of a file.
    pub(super) fn new(file: &'a FileLayout) -> Self {
        let stem = file.name.strip_suffix(".tv").unwrap_or(&file.name);
        let bits: u32 = file.columns.iter().map(|c| c.width.next_multiple_of(4)).sum();
        let mut taken = Vec::new();
        let mut top = bits;
        let fields = file
            .columns
            .iter()
            .map(|column| {
                top -= column.width.next_multiple_of(4);
                Field { id: unique(&column.name, &mut taken), column, lsb: top }
            })
            .collect();
        // A digit is four bits; a separator or the newline follows each column.
        let line = file.columns.iter().map(|c| c.width.div_ceil(4) + 1).sum();
        Self { id: identifier(stem), file, fields, bits, line }
    }

    /// Upper-case name for constants, `DDA_EXP`.
    pub(super) fn constant(&self) -> String {
        self.id.to_uppercase()
    }

    /// The field of that column name.
    pub(super) fn field(&self, name: &str) -> Option<&Field<'a>> {
        self.fields.iter().find(|field| field.column.name == name)
    }

    /// A line with its digits as `0`: separators and newline show where they must stand.
    pub(super) fn shape(&self) -> String {
        let words: Vec<String> =
            self.fields.iter().map(|field| "0".repeat(field.column.digits())).collect();
        words.join("_") + "\n"
    }

    /// The packed word's hexadecimal digits with every padding bit set.
    pub(super) fn pads(&self) -> String {
        let digit = |field: &Field| {
            ["0", "8", "c", "e"][field.pad() as usize].to_owned()
                + &"0".repeat(field.column.digits() - 1)
        };
        self.fields.iter().map(digit).collect()
    }
}
