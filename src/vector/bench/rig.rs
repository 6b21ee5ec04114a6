//! A device at a bench: tests go in, rows come out.

use super::{Answers, Bench, Coverage, TestAt};
use crate::vector::device::{Device, Stimulus};
use crate::vector::table::{RowFormat, Table};

/// A bench whose devices take stimulus of one type.
pub trait TestBench: Bench + Sized {
    /// What a device is given in one test.
    type Test: Stimulus;

    /// The stimulus of a test; `limit` cuts the rows of a walk.
    fn test(&self, at: TestAt, limit: u64) -> Self::Test;

    /// The row of the configuration file that drives the test.
    fn words(&self, test: &Self::Test) -> Vec<i128>;

    /// Empty tables: of the configuration, and of the expectations.
    fn tables(&self, format: RowFormat) -> (Table, <Self::Test as Stimulus>::Rows);
}

/// Something that is taken through the tests of a bench, in their order.
pub trait Run {
    /// Runs one test; `limit` cuts the rows of a walk.
    fn run(&mut self, at: TestAt, limit: u64);

    /// The rows so far, file by file.
    fn tables(&mut self) -> Vec<&mut Table>;

    /// What the rows hit.
    fn met(&self) -> &Coverage;
}

/// A device at a bench, with the files that it fills.
pub struct Rig<'b, B: TestBench> {
    bench: &'b B,
    device: Box<dyn Device<B::Test> + 'b>,
    cfg: Table,
    rows: <B::Test as Stimulus>::Rows,
    met: Coverage,
    /// The configuration of the test before.
    last: Vec<i128>,
}

/// Goals of every bench: a first record whose words all have ones in them, and a record that differs
/// in every word from the one before it.
pub(super) const RECORDS: [&str; 2] = ["record.first-in-use", "record.differs-in-every-word"];

impl<'b, B: TestBench> Rig<'b, B> {
    /// A device after its reset.
    pub fn new(bench: &'b B, device: Box<dyn Device<B::Test> + 'b>, format: RowFormat) -> Self {
        let (cfg, rows) = bench.tables(format);
        Self { bench, device, cfg, rows, met: Coverage::default(), last: Vec::new() }
    }
}

impl<B: TestBench> Rig<'_, B> {
    /// Counts what one record is to the one before it; flags and numbers of tests may stay.
    fn note(&mut self, words: Vec<i128>) {
        let [first, differs] = RECORDS;
        let width = |n: usize| self.cfg.columns()[n].width;
        let in_use = |(n, word): (usize, &i128)| width(n) == 1 || *word != 0;
        // The number of the first test is zero.
        if self.last.is_empty()
            && words.iter().enumerate().filter(|(n, _)| width(*n) != 32).all(in_use)
        {
            self.met.meet(first);
        }
        let changed = |(n, (a, b)): (usize, (&i128, &i128))| width(n) == 1 || a != b;
        if !self.last.is_empty() && words.iter().zip(&self.last).enumerate().all(changed) {
            self.met.meet(differs);
        }
        self.last = words;
    }
}

impl<B: TestBench> Run for Rig<'_, B> {
    fn run(&mut self, at: TestAt, limit: u64) {
        let test = self.bench.test(at, limit);
        let words = self.bench.words(&test);
        self.cfg.push(&words);
        self.note(words);
        self.device.answer(&test, &mut self.rows, &mut self.met);
    }

    fn tables(&mut self) -> Vec<&mut Table> {
        std::iter::once(&mut self.cfg).chain(self.rows.tables()).collect()
    }

    fn met(&self) -> &Coverage {
        &self.met
    }
}

impl<B: TestBench> std::fmt::Debug for Rig<'_, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "a device at the bench {}", self.bench.name())
    }
}

/// A single file of operands and results, each row made from its test alone.
pub(super) struct OperandRig<F> {
    rows: Table,
    met: Coverage,
    write: F,
}

impl<F: FnMut(TestAt, u64, &mut Table)> OperandRig<F> {
    /// Rows as `write` makes them.
    pub(super) fn new(rows: Table, write: F) -> Self {
        Self { rows, met: Coverage::default(), write }
    }
}

impl<F: FnMut(TestAt, u64, &mut Table)> Run for OperandRig<F> {
    fn run(&mut self, at: TestAt, limit: u64) {
        (self.write)(at, limit, &mut self.rows);
    }

    fn tables(&mut self) -> Vec<&mut Table> {
        vec![&mut self.rows]
    }

    fn met(&self) -> &Coverage {
        &self.met
    }
}

/// What runs where a bench has no file of the form asked for.
pub(super) struct NoFiles(pub(super) Coverage);

impl Run for NoFiles {
    fn run(&mut self, _: TestAt, _: u64) {}

    fn tables(&mut self) -> Vec<&mut Table> {
        Vec::new()
    }

    fn met(&self) -> &Coverage {
        &self.0
    }
}
