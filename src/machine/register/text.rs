//! Registers and records as text. Spec clause `RG-2`.

use super::Registers;

/// A list of words that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WordsError {
    /// Another number of words.
    #[error("{got} words are given, but this profile needs {need}: {names}")]
    Count {
        /// Words of the profile.
        need: usize,
        /// Words given.
        got: usize,
        /// Their names.
        names: String,
    },
    /// A word in another radix, or beyond 32 bits.
    #[error("words[{index}] = {text:?} ({name}) is not a word: {need}")]
    Word {
        /// Which, from 0.
        index: usize,
        /// What was given.
        text: String,
        /// Its name.
        name: String,
        /// What a word is.
        need: &'static str,
    },
}

impl Registers {
    /// Reads a list of words in the profile's radix.
    ///
    /// # Errors
    /// [`WordsError`] names the word and what is wrong with it.
    pub fn parse<S: AsRef<str>>(&self, text: &[S]) -> Result<Vec<u32>, WordsError> {
        let (need, got) = (self.input.len(), text.len());
        if need != got {
            let names = self.input.word_names().join(" ");
            return Err(WordsError::Count { need, got, names });
        }
        let word = |(index, text): (usize, &S)| {
            let text = text.as_ref();
            self.word(text).ok_or_else(|| WordsError::Word {
                index,
                text: text.chars().take(40).collect(),
                name: self.input.word_names().swap_remove(index),
                need: match self.radix {
                    10 => "a decimal number from -2147483648 to 4294967295 is needed",
                    _ => "1 to 8 hexadecimal digits without a prefix are needed",
                },
            })
        };
        text.iter().enumerate().map(word).collect()
    }

    fn word(&self, text: &str) -> Option<u32> {
        let digits = text.strip_prefix('-').filter(|_| self.radix == 10).unwrap_or(text);
        if digits.is_empty() || !digits.chars().all(|c| c.is_digit(self.radix)) {
            return None;
        }
        if self.radix == 16 {
            return u32::from_str_radix(text, 16).ok().filter(|_| text.len() <= 8);
        }
        let value: i64 = text.parse().ok()?;
        let signed = || i32::try_from(value).ok().map(i32::cast_unsigned);
        u32::try_from(value).ok().or_else(signed)
    }

    /// Appends a record as text: its letter and its words, `between` them.
    pub fn push_record(&self, kind: usize, values: &[i64], between: &str, out: &mut String) {
        let Some(record) = self.records.get(kind) else { return };
        out.push(record.letter);
        for (n, word) in record.words(values).enumerate() {
            out.push_str(between);
            record.layout.push_text(n, word, out);
        }
    }
}
