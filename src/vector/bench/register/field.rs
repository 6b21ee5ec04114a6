//! Fields of a machine's input.

use crate::format::{Layout, WORD};

/// A field of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Field {
    word: usize,
    lowest: u32,
    pub(super) width: u32,
    /// What its name begins with: fields of one initial belong together more often than others.
    initial: Option<char>,
    /// Whether pixels move or go where it is zero or full.
    pub(super) moves: bool,
}

/// The fields of a list of words.
pub(super) fn fields(input: &Layout) -> Vec<Field> {
    let fields = (0..input.len()).flat_map(|word| {
        input.fields(word).iter().map(move |field| Field {
            word,
            lowest: field.at,
            width: field.width,
            initial: field.name.chars().next(),
            moves: false,
        })
    });
    fields.collect()
}

impl Field {
    /// All of its bits.
    pub(super) const fn ones(self) -> u32 {
        u32::MAX >> (WORD - self.width)
    }

    /// The words with this field set to the low bits of a value.
    pub(super) fn set(self, words: &[u32], value: u32) -> Vec<u32> {
        let mut words = words.to_vec();
        let word = &mut words[self.word];
        *word = *word & !(self.ones() << self.lowest) | (value & self.ones()) << self.lowest;
        words
    }

    /// Its value, with what lies above it in its word.
    pub(super) fn of(self, words: &[u32]) -> u32 {
        words[self.word] >> self.lowest
    }

    /// Whether another field has its width; `akin`: and its initial.
    pub(super) fn is_like(self, other: Self, akin: bool) -> bool {
        self != other && self.width == other.width && (!akin || self.initial == other.initial)
    }
}
