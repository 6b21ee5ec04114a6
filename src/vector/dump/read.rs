//! Rows of a dump: hexadecimal columns, with the latitude that simulators need.

use crate::format::Column;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// The longest line read.
const LONGEST: u64 = 1 << 16;

/// A dump that cannot be read as rows of its file.
#[derive(Debug, thiserror::Error)]
pub enum DumpError {
    /// A line that is no row.
    #[error("{path}:{line}: {message}")]
    Line {
        /// The dump.
        path: String,
        /// Line, from 1.
        line: u64,
        /// What is wrong.
        message: String,
    },
    /// No row at all.
    #[error("{path}: no rows: an empty dump, or a simulation that crashed before its first row")]
    Empty {
        /// The dump.
        path: String,
    },
    /// Reading failed.
    #[error("{path}: {source}")]
    Io {
        /// The dump.
        path: String,
        /// Why.
        source: std::io::Error,
    },
}

/// One row: known bits, and which bits are unknown (X or Z) or masked out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DumpRow {
    /// Line in the dump, from 1.
    pub line: u64,
    /// Words, one a column.
    pub words: Vec<u128>,
    /// Bits that the device left unknown.
    pub unknown: Vec<u128>,
    /// Bits that the dump's mask column declares of no interest.
    pub ignored: Vec<u128>,
}

/// Reads rows one by one.
#[derive(Debug)]
pub struct RowReader {
    path: PathBuf,
    input: BufReader<File>,
    columns: Vec<Column>,
    line: u64,
    buffer: Vec<u8>,
    cut: Option<u64>,
}

impl RowReader {
    /// Opens a dump of rows with these columns.
    ///
    /// # Errors
    /// [`DumpError::Io`].
    pub fn open(path: &Path, columns: &[Column]) -> Result<Self, DumpError> {
        let file = File::open(path)
            .map_err(|source| DumpError::Io { path: path.display().to_string(), source })?;
        let input = BufReader::with_capacity(1 << 18, file);
        let (path, columns) = (path.to_owned(), columns.to_vec());
        Ok(Self { path, input, columns, line: 0, buffer: Vec::new(), cut: None })
    }

    /// The line that ends in the middle of a row, at the end of the dump: its writer was stopped there.
    pub fn cut(&self) -> Option<u64> {
        self.cut
    }

    fn fault(&self, message: String) -> DumpError {
        DumpError::Line { path: self.path.display().to_string(), line: self.line, message }
    }

    /// The next row; blank lines and `//` comments are passed over, CRLF is accepted.
    ///
    /// # Errors
    /// [`DumpError`] with the line.
    pub fn next_row(&mut self) -> Result<Option<DumpRow>, DumpError> {
        loop {
            self.buffer.clear();
            let read =
                (&mut self.input).take(LONGEST).read_until(b'\n', &mut self.buffer).map_err(
                    |source| DumpError::Io { path: self.path.display().to_string(), source },
                )?;
            if read == 0 {
                return Ok(None);
            }
            self.line += 1;
            if read as u64 == LONGEST {
                return Err(
                    self.fault(format!("longer than {LONGEST} bytes: no dump of this file"))
                );
            }
            let Ok(text) = std::str::from_utf8(&self.buffer) else {
                return Err(self.fault("not text".to_owned()));
            };
            let text = text.split("//").next().unwrap_or_default().trim();
            if text.is_empty() {
                continue;
            }
            let row = parse(text, &self.columns, self.line);
            if row.is_err() && !self.buffer.ends_with(b"\n") && is_beginning(text, &self.columns) {
                self.cut = Some(self.line);
                return Ok(None);
            }
            return row.map(Some).map_err(|message| self.fault(message));
        }
    }
}

/// Whether a text could be the beginning of a row.
fn is_beginning(text: &str, columns: &[Column]) -> bool {
    let mut rest = text;
    for column in columns {
        let digits = column.digits().min(rest.len());
        let (mine, later) = rest.split_at_checked(digits).unwrap_or((rest, ""));
        if !mine.chars().all(|c| c.is_ascii_hexdigit() || "xXzZ".contains(c)) {
            return false;
        }
        match later.strip_prefix('_') {
            Some(later) => rest = later,
            None => return later.is_empty(),
        }
    }
    false
}

fn parse(text: &str, columns: &[Column], line: u64) -> Result<DumpRow, String> {
    let mut row = DumpRow {
        line,
        words: Vec::with_capacity(columns.len()),
        unknown: Vec::with_capacity(columns.len()),
        ignored: vec![0; columns.len()],
    };
    let mut fields = text.split('_');
    for column in columns {
        let field = fields.next().ok_or_else(|| {
            format!("{} columns where {} belong: {text:?}", text.split('_').count(), columns.len())
        })?;
        let (word, unknown) = hexadecimal(field, &column.name, column.digits())?;
        let mask = u128::MAX >> (128 - column.width);
        if word & !mask != 0 {
            return Err(format!(
                "column {}: {field} has more than {} bits",
                column.name, column.width
            ));
        }
        row.words.push(word);
        row.unknown.push(unknown & mask);
    }
    if let Some(mask) = fields.next() {
        // A don't-care mask: one digit for each digit of the row.
        let digits: usize = columns.iter().map(Column::digits).sum();
        if mask.len() != digits || fields.next().is_some() {
            return Err(format!(
                "more than {} columns, and the last is no don't-care mask of {digits} digits: {text:?}",
                columns.len()
            ));
        }
        let mut rest = mask;
        for (column, ignored) in columns.iter().zip(&mut row.ignored) {
            let (mine, later) =
                rest.split_at_checked(column.digits()).ok_or("mask is not ASCII")?;
            let (mask, unknown) = hexadecimal(mine, "mask", column.digits())?;
            if unknown != 0 {
                return Err(format!("the don't-care mask has unknown digits: {mine:?}"));
            }
            *ignored = mask;
            rest = later;
        }
    }
    Ok(row)
}

/// A fixed number of hexadecimal digits; X and Z are unknown.
fn hexadecimal(field: &str, column: &str, digits: usize) -> Result<(u128, u128), String> {
    if field.len() != digits {
        return Err(format!(
            "column {column}: {field:?} has {} digits where {digits} belong",
            field.len()
        ));
    }
    let (mut word, mut unknown) = (0, 0);
    for character in field.chars() {
        let (digit, blank) = match character {
            'x' | 'X' | 'z' | 'Z' => (0, 15),
            _ => match character.to_digit(16) {
                Some(digit) => (u128::from(digit), 0),
                None => {
                    return Err(format!("column {column}: {character:?} is no hexadecimal digit"));
                }
            },
        };
        word = word << 4 | digit;
        unknown = unknown << 4 | blank;
    }
    Ok((word, unknown))
}
