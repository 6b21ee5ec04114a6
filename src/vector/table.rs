//! Rows of fixed-width words as text or bytes. Spec clauses `N-1` and `N-7`.

use crate::bits::{hex_digits, push_hex};
use crate::format::Column;
use std::fmt::Write as _;

/// How a file's rows are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RowFormat {
    /// Lower-case hexadecimal columns joined by `_`, one record a line: the golden form.
    #[default]
    Tv,
    /// Big-endian, each column padded to whole bytes, records back to back.
    Bin,
    /// Comma-separated hexadecimal with one header line.
    Csv,
    /// One JSON object a line, words as hexadecimal strings.
    Jsonl,
    /// Operands, expected results and flags as plain hexadecimal, separated by blanks.
    TestFloat,
}

impl RowFormat {
    /// Every form.
    pub const ALL: [Self; 5] = [Self::Tv, Self::Bin, Self::Csv, Self::Jsonl, Self::TestFloat];

    /// The file name's last part.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Tv => "tv",
            Self::Bin => "bin",
            Self::Csv => "csv",
            Self::Jsonl => "jsonl",
            Self::TestFloat => "testfloat",
        }
    }
}

/// Bytes of the longest row of narrow words.
const ROW: usize = 3 * 17;

/// A growing table of rows in one format.
#[derive(Clone, Debug)]
pub struct Table {
    format: RowFormat,
    columns: Vec<Column>,
    digits: Vec<usize>,
    masks: Vec<u128>,
    /// Encoded rows not yet taken.
    pub buffer: Vec<u8>,
    /// Rows so far.
    pub rows: u64,
}

impl Table {
    /// An empty table; a CSV begins with its header.
    pub fn new(format: RowFormat, columns: &[Column]) -> Self {
        let mut buffer = Vec::new();
        if format == RowFormat::Csv {
            let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
            buffer.extend_from_slice(names.join(",").as_bytes());
            buffer.push(b'\n');
        }
        let digits = columns.iter().map(Column::digits).collect();
        let masks = columns.iter().map(|c| u128::MAX >> (128 - c.width)).collect();
        Self { format, columns: columns.to_vec(), digits, masks, buffer, rows: 0 }
    }

    /// Its columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Appends a row of words; what lies above a column's width is dropped.
    ///
    /// # Panics
    /// If there is not one word a column.
    #[inline]
    pub fn push(&mut self, words: &[i128]) {
        assert_eq!(words.len(), self.digits.len(), "one word a column");
        self.rows += 1;
        if self.format != RowFormat::Tv {
            self.push_other(words);
            return;
        }
        for ((word, digits), mask) in words.iter().zip(&self.digits).zip(&self.masks) {
            push_hex(&mut self.buffer, word.cast_unsigned() & mask, *digits);
            self.buffer.push(b'_');
        }
        self.end_line();
    }

    /// Appends a row of words of at most 64 bits, already masked: the quick way.
    #[inline]
    pub fn push_narrow<const N: usize>(&mut self, words: [u64; N]) {
        const { assert!(17 * N <= ROW, "a row of narrow words fits its buffer") };
        if self.format != RowFormat::Tv {
            self.rows += 1;
            self.push_other(&words.map(i128::from));
            return;
        }
        self.rows += 1;
        // Whole 16-digit words at advancing places, each overwriting the last one's excess: fixed
        // copies, and one of variable length a row.
        let mut row = [0; ROW];
        let mut at = 0;
        for (word, digits) in words.iter().zip(&self.digits) {
            let text = hex_digits(word << (64 - 4 * digits));
            row[at..at + 16].copy_from_slice(&text);
            at += digits;
            row[at] = b'_';
            at += 1;
        }
        row[at - 1] = b'\n';
        self.buffer.extend_from_slice(&row[..at]);
    }

    #[inline]
    fn end_line(&mut self) {
        // The last separator becomes the line's end.
        if let Some(last) = self.buffer.last_mut() {
            *last = b'\n';
        }
    }

    fn push_other(&mut self, words: &[i128]) {
        let mut text = String::new();
        for (n, word) in words.iter().enumerate() {
            let bits = word.cast_unsigned() & self.masks[n];
            let digits = self.digits[n];
            // Writing to a String cannot fail.
            let _ = match self.format {
                RowFormat::Bin => {
                    let bytes = bits.to_be_bytes();
                    self.buffer.extend_from_slice(&bytes[16 - self.columns[n].bytes()..]);
                    continue;
                }
                RowFormat::Jsonl => {
                    let open = if n == 0 { "{" } else { ", " };
                    write!(text, "{open}\"{}\": \"{bits:0digits$x}\"", self.columns[n].name)
                }
                RowFormat::TestFloat => {
                    write!(text, "{}{bits:0digits$x}", if n == 0 { "" } else { " " })
                }
                RowFormat::Csv | RowFormat::Tv => {
                    write!(text, "{}{bits:0digits$x}", if n == 0 { "" } else { "," })
                }
            };
        }
        if self.format != RowFormat::Bin {
            text.push_str(if self.format == RowFormat::Jsonl { "}\n" } else { "\n" });
            self.buffer.extend_from_slice(text.as_bytes());
        }
    }
}

/// The words of a row of the form `bin`.
pub(super) fn unpack(bytes: &[u8], columns: &[Column]) -> Vec<u128> {
    let mut rest = bytes;
    let word = |column: &Column| {
        let (mine, later) = rest.split_at(column.bytes());
        rest = later;
        mine.iter().fold(0, |word, byte| word << 8 | u128::from(*byte))
    };
    columns.iter().map(word).collect()
}
