//! The reference model of a machine that begins at registers.

use super::Device;
use crate::machine::{DrawError, Registers};
use crate::model::{Model, Records};
use crate::vector::bench::{Coverage, RegisterAnswers, RegisterTest};
use crate::vector::table::Table;
use std::sync::Arc;

/// Draws words, and writes the records in the layout of a set.
pub(in crate::vector) struct Recorder {
    pub(in crate::vector) model: Arc<Model>,
    /// What the set's words and records look like.
    pub(in crate::vector) registers: Registers,
}

/// What words draw, `most` records of it. Words that take too many steps count as more than `most` records.
pub(in crate::vector) fn records(model: &Model, words: &[u32], most: u64) -> Records {
    let mut records = Records::up_to(most);
    match model.draw(words, &mut records) {
        Ok(()) => {}
        Err(DrawError::Work { .. }) => records.total = u64::MAX,
        Err(error) => unreachable!("the number of words is the profile's own: {error}"),
    }
    records
}

impl Device<RegisterTest> for Recorder {
    fn answer(&mut self, test: &RegisterTest, rows: &mut RegisterAnswers<Table>, _: &mut Coverage) {
        for (kind, values) in records(&self.model, &test.words, RegisterTest::LARGEST).kept {
            let words = self.registers.records[kind].words(&values).map(i128::from);
            let row: Vec<i128> = std::iter::once(i128::from(test.test)).chain(words).collect();
            rows.records[kind].push(&row);
        }
    }
}
