//! The bytes of a dump as plain ASCII, whatever the encoding: UTF-8 with or without a byte order mark, or
//! UTF-16 in either order of bytes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Bytes read at once.
const BLOCK: usize = 1 << 20;

/// How characters are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    /// A byte a character; anything beyond ASCII is no row and is refused as such.
    Bytes,
    /// Two bytes a character, and which of them is the low one.
    Utf16 { low: usize },
}

/// A file of text, read block by block.
pub(super) struct Text {
    file: File,
    encoding: Encoding,
    /// What is said of the encoding, where it is not plain.
    pub(super) assumed: Option<&'static str>,
    raw: Vec<u8>,
    /// Characters that have not been taken, from `at` on.
    held: Vec<u8>,
    at: usize,
    ended: bool,
}

impl Text {
    /// Opens a file; also its length in bytes.
    pub(super) fn open(path: &Path) -> io::Result<(Self, u64)> {
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        let (raw, held) = (Vec::new(), Vec::new());
        let mut text =
            Self { file, encoding: Encoding::Bytes, assumed: None, raw, held, at: 0, ended: false };
        text.fill_raw()?;
        text.detect();
        text.decode();
        Ok((text, length))
    }

    /// Looks at the first bytes, and takes a byte order mark away.
    fn detect(&mut self) {
        const LITTLE: &str = "the text is UTF-16, low byte first";
        const BIG: &str = "the text is UTF-16, high byte first";
        // Without a mark, a zero beside an ASCII character tells.
        let (encoding, assumed, mark) = match self.raw[..] {
            [0xef, 0xbb, 0xbf, ..] => {
                (Encoding::Bytes, Some("the text is UTF-8 with a byte order mark"), 3)
            }
            [0xff, 0xfe, ..] => (Encoding::Utf16 { low: 0 }, Some(LITTLE), 2),
            [0xfe, 0xff, ..] => (Encoding::Utf16 { low: 1 }, Some(BIG), 2),
            [low, 0, ..] if low != 0 => (Encoding::Utf16 { low: 0 }, Some(LITTLE), 0),
            [0, low, ..] if low != 0 => (Encoding::Utf16 { low: 1 }, Some(BIG), 0),
            _ => (Encoding::Bytes, None, 0),
        };
        (self.encoding, self.assumed) = (encoding, assumed);
        self.raw.drain(..mark);
    }

    fn fill_raw(&mut self) -> io::Result<()> {
        let before = self.raw.len();
        let room = u64::try_from(BLOCK).unwrap_or(u64::MAX);
        (&mut self.file).take(room).read_to_end(&mut self.raw)?;
        self.ended = self.raw.len() == before;
        Ok(())
    }

    /// Moves what has been read to the characters.
    fn decode(&mut self) {
        match self.encoding {
            Encoding::Bytes if self.held.is_empty() => {
                std::mem::swap(&mut self.held, &mut self.raw);
            }
            Encoding::Bytes => self.held.append(&mut self.raw),
            Encoding::Utf16 { low } => {
                let whole = self.raw.len() / 2 * 2;
                let pairs = self.raw.drain(..whole).collect::<Vec<u8>>();
                // Beyond ASCII, a byte that no row has.
                let character = |pair: &[u8]| if pair[1 - low] == 0 { pair[low] } else { 0xff };
                self.held.extend(pairs.chunks_exact(2).map(character));
            }
        }
    }

    /// What has been read and not taken.
    pub(super) fn held(&self) -> &[u8] {
        &self.held[self.at..]
    }

    /// Takes so many characters.
    pub(super) fn take(&mut self, count: usize) {
        self.at += count;
    }

    /// Reads more; whether there is more.
    pub(super) fn more(&mut self) -> io::Result<bool> {
        if self.ended {
            return Ok(false);
        }
        self.held.drain(..self.at);
        self.at = 0;
        self.fill_raw()?;
        self.decode();
        if self.ended && !self.raw.is_empty() {
            // Half a character at the end.
            self.raw.clear();
            self.held.push(0xff);
            return Ok(true);
        }
        Ok(!self.ended)
    }

    /// The length of the next line with its end, of at most `longest` characters; 0 at the end.
    pub(super) fn line(&mut self, longest: usize) -> io::Result<usize> {
        let mut seen = 0;
        loop {
            let held = self.held();
            if let Some(place) = held[seen..].iter().position(|byte| *byte == b'\n') {
                return Ok((seen + place + 1).min(longest));
            }
            seen = held.len();
            if seen >= longest || !self.more()? {
                return Ok(self.held().len().min(longest));
            }
        }
    }
}
