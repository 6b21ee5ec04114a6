//! Rows of a dump: hexadecimal columns, with the latitude that simulators need.

use crate::format::Column;
use crate::vector::table::unpack;
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

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
    #[error("{path}: the dump has no rows; check if the simulation stopped before its first row")]
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

/// The rows of a dump, read once: each packed as in the form `bin`, which takes less memory than its
/// text.
#[derive(Clone, Debug)]
pub struct Dump {
    columns: Vec<Column>,
    /// Bytes of a row.
    stride: usize,
    /// Known bits, row after row; zeros where a bit is not known.
    known: Vec<u8>,
    /// The rows that not every bit of is known and looked at.
    odd: HashMap<usize, Odd>,
    /// Rows whose line does not follow that of the row before, with their lines.
    lines: Vec<(usize, u64)>,
    /// The line that ends in the middle of a row, at the end of the dump.
    cut: Option<u64>,
}

/// Bits of a row that say nothing, packed as the row is.
#[derive(Clone, Debug, Default)]
struct Odd {
    /// Left unknown by the device: X or Z.
    unknown: Vec<u8>,
    /// Of no interest, as the dump's mask column declares.
    ignored: Vec<u8>,
}

impl Dump {
    /// Reads a dump of rows with these columns; blank lines and `//` comments are passed over, CRLF is
    /// accepted.
    ///
    /// # Errors
    /// [`DumpError`] with the line.
    pub fn read(path: &Path, columns: &[Column]) -> Result<Self, DumpError> {
        let io = |source| DumpError::Io { path: path.display().to_string(), source };
        let mut input = BufReader::with_capacity(1 << 18, File::open(path).map_err(io)?);
        let stride = columns.iter().map(Column::bytes).sum();
        let (known, odd, lines) = (Vec::new(), HashMap::new(), Vec::new());
        let mut dump = Self { columns: columns.to_vec(), stride, known, odd, lines, cut: None };
        let (mut line, mut buffer) = (0, Vec::new());
        loop {
            buffer.clear();
            let read = (&mut input).take(LONGEST).read_until(b'\n', &mut buffer).map_err(io)?;
            if read == 0 {
                return Ok(dump);
            }
            line += 1;
            let fault = |message: String| DumpError::Line {
                path: path.display().to_string(),
                line,
                message,
            };
            if read as u64 == LONGEST {
                return Err(fault(format!(
                    "the line is longer than {LONGEST} bytes, so this is not a dump of this exp file"
                )));
            }
            let text = std::str::from_utf8(&buffer)
                .map_err(|_| fault("the line is not UTF-8 text".to_owned()))?;
            let text = text.split_once("//").map_or(text, |(row, _)| row).trim();
            if text.is_empty() {
                continue;
            }
            let rows = dump.rows();
            match dump.push(text) {
                Ok(()) => {
                    let follows = rows > 0 && dump.line(rows - 1) + 1 == line;
                    dump.lines.extend((!follows).then_some((rows, line)));
                }
                Err(_) if !buffer.ends_with(b"\n") && is_beginning(text, columns) => {
                    dump.cut = Some(line);
                    return Ok(dump);
                }
                Err(message) => return Err(fault(message)),
            }
        }
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        self.known.len() / self.stride
    }

    /// The line that ends in the middle of a row, at the end of the dump: its writer was stopped there.
    pub fn cut(&self) -> Option<u64> {
        self.cut
    }

    /// The line of a row, from 1.
    pub fn line(&self, row: usize) -> u64 {
        let run = self.lines.partition_point(|(first, _)| *first <= row);
        // The first row begins the first run.
        let (first, line) = self.lines[run - 1];
        line + (row - first) as u64
    }

    /// Known bits of a row, packed.
    pub(super) fn row(&self, row: usize) -> &[u8] {
        &self.known[row * self.stride..][..self.stride]
    }

    /// Words of a row: known bits, unknown bits, and those of no interest.
    pub(super) fn words(&self, row: usize) -> [Vec<u128>; 3] {
        let none = vec![0; self.stride];
        let odd = self.odd.get(&row);
        let [unknown, ignored] =
            [odd.map(|odd| &odd.unknown), odd.map(|odd| &odd.ignored)].map(|b| b.unwrap_or(&none));
        [self.row(row), unknown, ignored].map(|bytes| unpack(bytes, &self.columns))
    }

    /// Whether a row agrees with a packed expectation, where the dump's mask looks.
    pub(super) fn agrees(&self, row: usize, expected: &[u8]) -> bool {
        let known = self.row(row);
        // Most dumps have no odd row at all.
        let odd = if self.odd.is_empty() { None } else { self.odd.get(&row) };
        let Some(Odd { unknown, ignored }) = odd else { return known == expected };
        let bytes = known.iter().zip(expected).zip(unknown.iter().zip(ignored));
        bytes
            .into_iter()
            .all(|((known, wanted), (unknown, ignored))| (known ^ wanted | unknown) & !ignored == 0)
    }

    /// Appends the row of a text.
    fn push(&mut self, text: &str) -> Result<(), String> {
        let start = self.known.len();
        let pushed = self.parse(text);
        if pushed.is_err() {
            self.known.truncate(start);
        }
        pushed
    }

    fn parse(&mut self, text: &str) -> Result<(), String> {
        let row = self.rows();
        let mut odd = Odd::default();
        let (mut fields, columns) = (text.split('_'), &self.columns);
        for column in columns {
            let field = fields.next().ok_or_else(|| {
                let found = text.split('_').count();
                format!("the row has {found} columns, but {} are needed: {text:?}", columns.len())
            })?;
            let (word, unknown) = hexadecimal(field, &column.name, column.digits())?;
            let mask = u128::MAX >> (128 - column.width);
            if word & !mask != 0 {
                let (name, width) = (&column.name, column.width);
                return Err(format!("column {name}: {field} has more than {width} bits"));
            }
            self.known.extend_from_slice(&word.to_be_bytes()[16 - column.bytes()..]);
            odd.unknown.extend_from_slice(&(unknown & mask).to_be_bytes()[16 - column.bytes()..]);
        }
        if let Some(mask) = fields.next() {
            // A don't-care mask: one digit for each digit of the row.
            let digits: usize = columns.iter().map(Column::digits).sum();
            if mask.len() != digits || fields.next().is_some() {
                return Err(format!(
                    "the row has more than {} columns, but the last column is not a don't-care mask of {digits} digits: {text:?}",
                    columns.len()
                ));
            }
            let mut rest = mask;
            for column in columns {
                let (mine, later) =
                    rest.split_at_checked(column.digits()).ok_or("mask is not ASCII")?;
                let (mask, unknown) = hexadecimal(mine, "mask", column.digits())?;
                if unknown != 0 {
                    return Err(format!("the don't-care mask has unknown digits: {mine:?}"));
                }
                odd.ignored.extend_from_slice(&mask.to_be_bytes()[16 - column.bytes()..]);
                rest = later;
            }
        } else {
            odd.ignored = vec![0; self.stride];
        }
        if odd.unknown.iter().chain(&odd.ignored).any(|byte| *byte != 0) {
            self.odd.insert(row, odd);
        }
        Ok(())
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

/// A fixed number of hexadecimal digits; X and Z are unknown.
fn hexadecimal(field: &str, column: &str, digits: usize) -> Result<(u128, u128), String> {
    if field.len() != digits {
        return Err(format!(
            "column {column}: {field:?} has {} digits, but {digits} are needed",
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
                    return Err(format!(
                        "column {column}: {character:?} is not a hexadecimal digit"
                    ));
                }
            },
        };
        word = word << 4 | digit;
        unknown = unknown << 4 | blank;
    }
    Ok((word, unknown))
}
