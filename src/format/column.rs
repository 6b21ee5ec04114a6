//! One column of a vector file, and one port of a machine.

use super::q::QFormat;
use crate::bits::{Width, WidthError};
use serde::{Deserialize, Serialize};

/// A fixed-point column: everything a bench, a package or a wave viewer has to know of one word.
///
/// Manifest, packages, testbenches, waveforms and `verify` all derive from lists of these.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Field name, a lower-case identifier in every target language.
    pub name: String,
    /// Width in bits, 1 to 128; the text form is padded to whole nibbles.
    pub width: u32,
    /// Whether the pattern is two's complement.
    pub signed: bool,
    /// Fraction bits below the binary point.
    pub fraction: u32,
    /// One sentence for people.
    pub meaning: String,
}

impl Column {
    /// A column of the given shape.
    pub fn new(name: &str, width: u32, signed: bool, fraction: u32, meaning: &str) -> Self {
        Self { name: name.to_owned(), width, signed, fraction, meaning: meaning.to_owned() }
    }

    /// A column of words of this format.
    pub fn of(name: &str, format: QFormat, signed: bool, meaning: &str) -> Self {
        Self::new(name, format.bits(), signed, format.fraction(), meaning)
    }

    /// The format of its words.
    ///
    /// # Errors
    /// [`WidthError`] unless the column has 1 to 128 bits.
    pub fn format(&self) -> Result<QFormat, WidthError> {
        QFormat::of_width(self.width, self.fraction)
    }

    /// Hexadecimal digits of one word: the width padded to whole nibbles.
    pub fn digits(&self) -> usize {
        self.width.div_ceil(4) as usize
    }

    /// Bytes of one word in packed form: the width padded to whole bytes.
    pub fn bytes(&self) -> usize {
        self.width.div_ceil(8) as usize
    }
}
