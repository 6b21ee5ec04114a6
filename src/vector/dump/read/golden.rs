//! Rows of the golden form at speed: every character stands in its place, so that none is looked for.

use crate::format::Column;

/// What a character is worth; 255 for what is no digit.
const VALUE: [u8; 256] = {
    let mut value = [255; 256];
    let mut digit = 0;
    while digit < 16 {
        let at = if digit < 10 { b'0' + digit } else { b'a' + digit - 10 };
        value[at as usize] = digit;
        if digit >= 10 {
            value[(b'A' + digit - 10) as usize] = digit;
        }
        digit += 1;
    }
    value
};

/// Where the digits of a column stand in a line.
#[derive(Clone, Copy, Debug)]
struct Place {
    from: usize,
    digits: usize,
    width: u32,
    bytes: usize,
}

/// The shape of a line.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    places: Vec<Place>,
    /// Characters of a line without its end.
    line: usize,
    /// Its end.
    end: &'static [u8],
}

impl Shape {
    pub(super) fn new(columns: &[Column]) -> Self {
        let mut from = 0;
        let places = columns
            .iter()
            .map(|column| {
                let (digits, width, bytes) = (column.digits(), column.width, column.bytes());
                let place = Place { from, digits, width, bytes };
                from += digits + 1;
                place
            })
            .collect();
        Self { places, line: from.saturating_sub(1), end: b"\n" }
    }

    /// Characters of a line with its end.
    pub(super) fn length(&self) -> usize {
        self.line + self.end.len()
    }

    /// Lines end as this one does.
    pub(super) fn set_end(&mut self, line: &[u8]) {
        self.end = if line.ends_with(b"\r\n") { b"\r\n" } else { b"\n" };
    }

    /// Packs the rows that begin a text, as many as have this shape and only known digits; their number.
    pub(super) fn rows(&self, text: &[u8], known: &mut Vec<u8>) -> usize {
        let mut count = 0;
        for line in text.chunks_exact(self.length()) {
            let start = known.len();
            if line[self.line..] != *self.end || !self.row(line, known) {
                known.truncate(start);
                break;
            }
            count += 1;
        }
        count
    }

    fn row(&self, line: &[u8], known: &mut Vec<u8>) -> bool {
        for (n, place) in self.places.iter().enumerate() {
            if n > 0 && line[place.from - 1] != b'_' {
                return false;
            }
            let digits = &line[place.from..place.from + place.digits];
            // Digits of words up to 64 bits fit the machine's own words.
            if place.digits <= 16 {
                let (mut word, mut all) = (0u64, 0u8);
                for &digit in digits {
                    let value = VALUE[usize::from(digit)];
                    all |= value;
                    word = word << 4 | u64::from(value & 15);
                }
                if all > 15 || word & !(u64::MAX >> (64 - place.width)) != 0 {
                    return false;
                }
                known.extend_from_slice(&word.to_be_bytes()[8 - place.bytes..]);
            } else {
                let (mut word, mut all) = (0u128, 0u8);
                for &digit in digits {
                    let value = VALUE[usize::from(digit)];
                    all |= value;
                    word = word << 4 | u128::from(value & 15);
                }
                if all > 15 || word & !(u128::MAX >> (128 - place.width)) != 0 {
                    return false;
                }
                known.extend_from_slice(&word.to_be_bytes()[16 - place.bytes..]);
            }
        }
        true
    }
}
