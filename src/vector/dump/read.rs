//! Rows of a dump: hexadecimal columns, with the latitude that simulators need. Spec clause `N-13`.

mod golden;
mod notation;
mod text;

use crate::format::Column;
use crate::vector::table::unpack;
use golden::Shape;
use notation::Notation;
use std::collections::HashMap;
use std::path::Path;
use text::Text;

/// The longest line read.
const LONGEST: usize = 1 << 16;

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
    /// How the rows are written, once there is one.
    notation: Option<Notation>,
    /// What was assumed to read it.
    assumed: Vec<String>,
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
    /// Reads a dump of rows with these columns. What is not the golden form is told from the first line: memory
    /// images, blanks between columns, CSV; UTF-16, a byte order mark and CRLF are accepted, blank lines and
    /// `//` comments are passed over.
    ///
    /// # Errors
    /// [`DumpError`] with the line.
    pub fn read(path: &Path, columns: &[Column]) -> Result<Self, DumpError> {
        Self::read_up_to(path, columns, usize::MAX)
    }

    /// The same, stopping when there are `most` rows.
    ///
    /// # Errors
    /// [`DumpError`] with the line.
    pub(super) fn read_up_to(
        path: &Path,
        columns: &[Column],
        most: usize,
    ) -> Result<Self, DumpError> {
        let io = |source| DumpError::Io { path: path.display().to_string(), source };
        let (mut text, length) = Text::open(path).map_err(io)?;
        let mut shape = Shape::new(columns);
        let mut dump = Self::new(columns);
        dump.assumed.extend(text.assumed.map(str::to_owned));
        // Rows of the golden form take no more than their share of the file.
        let rows = usize::try_from(length).unwrap_or(0) / shape.length().max(1);
        dump.known.reserve(rows.min(most) * dump.stride);
        let mut line = 0;
        while dump.rows() < most {
            if matches!(dump.notation, None | Some(Notation::Joined)) {
                let before = dump.rows();
                let count = shape.rows(text.held(), &mut dump.known);
                if count > 0 {
                    dump.follows(before, line + 1);
                    dump.notation = Some(Notation::Joined);
                    line += count as u64;
                    text.take(count * shape.length());
                    continue;
                }
            }
            let length = text.line(LONGEST).map_err(io)?;
            if length == 0 {
                break;
            }
            line += 1;
            let taken = dump.line_of(text.held(), length, line);
            if taken.is_ok() {
                shape.set_end(&text.held()[..length]);
            }
            text.take(length);
            taken.map_err(|message| DumpError::Line {
                path: path.display().to_string(),
                line,
                message,
            })?;
        }
        dump.known.truncate(most.saturating_mul(dump.stride));
        Ok(dump)
    }

    fn new(columns: &[Column]) -> Self {
        Self {
            columns: columns.to_vec(),
            stride: columns.iter().map(Column::bytes).sum(),
            known: Vec::new(),
            odd: HashMap::new(),
            lines: Vec::new(),
            cut: None,
            notation: None,
            assumed: Vec::new(),
        }
    }

    /// Notes the line of a row that has just been read.
    fn follows(&mut self, row: usize, line: u64) {
        if row == 0 || self.line(row - 1) + 1 != line {
            self.lines.push((row, line));
        }
    }

    /// Takes the line at the beginning of a text.
    fn line_of(&mut self, held: &[u8], length: usize, line: u64) -> Result<(), String> {
        if length == LONGEST {
            return Err(format!(
                "the line is longer than {LONGEST} bytes, so this is not a dump of this exp file"
            ));
        }
        let text = std::str::from_utf8(&held[..length])
            .map_err(|_| "the line has characters that no row has".to_owned())?;
        let ends = text.ends_with('\n');
        let text = text.split_once("//").map_or(text, |(row, _)| row).trim();
        if text.is_empty() {
            return Ok(());
        }
        if let Some(address) = text.strip_prefix('@') {
            return self.address(address);
        }
        let columns = std::mem::take(&mut self.columns);
        let taken = self.take_row(text, &columns, line, ends);
        self.columns = columns;
        taken
    }

    /// Takes a row, or the header before it; `ends` says whether a line feed follows.
    fn take_row(
        &mut self,
        text: &str,
        columns: &[Column],
        line: u64,
        ends: bool,
    ) -> Result<(), String> {
        let notation = if let Some(notation) = self.notation.take() {
            notation
        } else {
            let (notation, is_header, said) = Notation::of(text, columns)?;
            self.assumed.extend(said);
            if is_header {
                self.notation = Some(notation);
                return Ok(());
            }
            notation
        };
        let row = self.rows();
        let pushed = notation.words(text, columns).and_then(|(words, mask)| {
            self.push(&words, mask, columns)?;
            self.follows(row, line);
            Ok(())
        });
        let cut = !ends && pushed.is_err() && notation.could_begin(text, columns);
        self.notation = Some(notation);
        if cut {
            self.cut = Some(line);
            return Ok(());
        }
        pushed
    }

    /// Takes the address of a memory image, which has to be that of the next row.
    fn address(&mut self, text: &str) -> Result<(), String> {
        let address = usize::from_str_radix(text.trim(), 16)
            .map_err(|_| format!("@{text}: an address is hexadecimal"))?;
        let rows = self.rows();
        if address != rows {
            return Err(format!(
                "@{text}: the memory image goes on at row {address}, but {rows} rows are before it; write \
                 every row, from 0"
            ));
        }
        Ok(())
    }

    /// What was assumed to read it: the encoding and the form, where they are not the golden ones.
    pub fn assumed(&self) -> &[String] {
        &self.assumed
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

    /// Whether the rows of this dump are the first ones of another, known to the last bit.
    pub(super) fn starts_alike(&self, other: &Self) -> bool {
        self.odd.is_empty() && self.rows() > 0 && other.known.starts_with(&self.known)
    }

    /// Appends a row.
    fn push(
        &mut self,
        words: &[notation::Word],
        mask: Option<&str>,
        columns: &[Column],
    ) -> Result<(), String> {
        let mut odd = Odd::default();
        let mut rest = mask.unwrap_or("");
        for ((_, unknown), column) in words.iter().zip(columns) {
            let from = 16 - column.bytes();
            odd.unknown.extend_from_slice(&unknown.to_be_bytes()[from..]);
            let ignored = if mask.is_some() {
                let (mine, later) =
                    rest.split_at_checked(column.digits()).ok_or("mask is not ASCII")?;
                rest = later;
                let (ignored, unknown) = notation::digits(mine, "mask")?;
                if unknown != 0 {
                    return Err(format!("the don't-care mask has unknown digits: {mine:?}"));
                }
                ignored
            } else {
                0
            };
            odd.ignored.extend_from_slice(&ignored.to_be_bytes()[from..]);
        }
        if odd.unknown.iter().chain(&odd.ignored).any(|byte| *byte != 0) {
            self.odd.insert(self.rows(), odd);
        }
        for ((word, _), column) in words.iter().zip(columns) {
            self.known.extend_from_slice(&word.to_be_bytes()[16 - column.bytes()..]);
        }
        Ok(())
    }
}
