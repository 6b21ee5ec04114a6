//! Fields of a machine's input, and what tests do to them.

use super::RegisterTest;
use crate::format::{Layout, WORD};
use crate::machine::Registers;
use crate::model::Model;
use crate::vector::device::records;

/// A field of a word.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    pub(super) word: usize,
    pub(super) lowest: u32,
    pub(super) width: u32,
    /// What its name begins with: fields of one initial belong together more often than others.
    pub(super) initial: Option<char>,
    /// Whether it says that there is a clip rectangle (clause `RG-13`).
    pub(super) clips: bool,
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
            clips: field.name == "clip",
            moves: false,
        })
    });
    fields.collect()
}

/// A field set to a value.
pub(super) fn set(words: &mut [u32], field: Field, value: u32) {
    let Field { word, lowest, width, .. } = field;
    let mask = u32::MAX >> (WORD - width);
    words[word] = words[word] & !(mask << lowest) | (value & mask) << lowest;
}

/// The words with all fields at zero that move no pixel; it marks the others.
pub(super) fn bare(
    model: &Model,
    registers: &Registers,
    fields: &mut [Field],
    mut words: Vec<u32>,
) -> Vec<u32> {
    let pixels = |words: &[u32]| -> Vec<[i64; 2]> {
        let kept = records(model, words, RegisterTest::LARGEST).kept;
        kept.iter().flat_map(|(kind, values)| registers.records[*kind].pixels(values)).collect()
    };
    let drawn = pixels(&words);
    for field in fields {
        let [zero, ones] = [0, u32::MAX].map(|value| {
            let mut changed = words.clone();
            set(&mut changed, *field, value);
            changed
        });
        let stay = pixels(&zero) == drawn;
        field.moves = !stay || pixels(&ones) != drawn;
        if stay {
            words = zero;
        }
    }
    words
}

/// The low 32 bits.
pub(super) fn low(value: u64) -> u32 {
    let [a, b, c, d, ..] = value.to_le_bytes();
    u32::from_le_bytes([a, b, c, d])
}
