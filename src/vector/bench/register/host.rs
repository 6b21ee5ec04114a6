//! What a host writes, and what words draw.

use super::RegisterTest;
use super::field::Field;
use crate::machine::Registers;
use crate::model::{Model, Records};
use crate::setup::Triangle;
use crate::vector::device::records;
use std::sync::Arc;

/// A machine and its registers.
#[derive(Clone, Debug)]
pub(super) struct Host {
    pub(super) model: Arc<Model>,
    pub(super) registers: Registers,
}

impl Host {
    /// What is written for a triangle, the first list of it; `None` where nothing is.
    pub(super) fn writes(&self, triangle: &Triangle) -> Option<Vec<u32>> {
        self.model.host(triangle).into_iter().next()
    }

    /// The same, zeros where nothing is written.
    pub(super) fn words(&self, triangle: &Triangle) -> Vec<u32> {
        self.writes(triangle).unwrap_or_else(|| vec![0; self.registers.input.len()])
    }

    /// Whether a driver may write the words.
    pub(super) fn is_legal(&self, words: &[u32]) -> bool {
        self.registers.illegal(words).next().is_none()
    }

    /// What words draw.
    pub(super) fn records(&self, words: &[u32]) -> Records {
        records(&self.model, words, RegisterTest::LARGEST)
    }

    /// The pixels that words draw.
    pub(super) fn pixels(&self, words: &[u32]) -> Vec<[i64; 2]> {
        let kept = self.records(words).kept;
        let pixels = |(kind, values): &(usize, Vec<i64>)| {
            self.registers.records[*kind].pixels(values).collect::<Vec<_>>()
        };
        kept.iter().flat_map(pixels).collect()
    }

    /// The words with all fields at zero that move no pixel; it marks the fields that do.
    pub(super) fn bare(&self, fields: &mut [Field], mut words: Vec<u32>) -> Vec<u32> {
        let drawn = self.pixels(&words);
        for field in fields {
            let [zero, ones] = [0, u32::MAX].map(|value| field.set(&words, value));
            let stay = self.pixels(&zero) == drawn;
            field.moves = !stay || self.pixels(&ones) != drawn;
            if stay {
                words = zero;
            }
        }
        words
    }
}
