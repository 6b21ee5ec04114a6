//! What a set tests: one bench a piece of hardware, each with its files, classes of tests, and the
//! stimulus of any test alone. A bench knows no defect: what a device should answer is what the
//! reference model answers, and what it may answer instead is `vector::suspect`. Spec clauses `N-2`
//! to `N-4`.

mod channel;
mod coverage;
mod files;
mod interpolator;
mod register;
mod rig;
mod setup;
mod shape;
mod triangle;
mod triangles;
mod unit;
mod walk;
mod word;

pub use channel::{ChannelBench, ChannelTest};
pub use coverage::{Cell, Cells, Coverage, Goal, Reason, Shape, Unreachable};
pub use files::{Answers, ChannelAnswers, RegisterAnswers, ShapeAnswers, Single, TriangleAnswers};
pub use interpolator::InterpolatorBench;
pub use register::{RegisterBench, RegisterTest};
pub use rig::{Rig, Run, TestBench};
pub use setup::{SetupBench, SetupTest};
pub use shape::{ShapeBench, ShapeKind, ShapeTest};
pub(in crate::vector) use triangle::word_engine;
pub use triangle::{TriangleBench, TriangleTest};
pub(in crate::vector) use unit::UnitKind;
pub use unit::{UnitBench, UnitTest};
pub(in crate::vector) use walk::read_out;
pub use walk::{WalkBench, WalkKind, WalkTest};
pub(in crate::vector) use word::{bounds, bounds_within, ready};

use super::suspect::Suspects;
use super::table::RowFormat;
use crate::case::Class;
use crate::format::{Column, ReadOut};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::value::VertexValues;

/// A file of a bench, before it has rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileSpec {
    /// Name without extension, such as `dda.exp`.
    pub stem: String,
    /// Its columns.
    pub columns: Vec<Column>,
    /// How many of the first columns say where a row belongs, so that rows may come in any order; 0
    /// where only the order says it.
    pub key: usize,
}

impl FileSpec {
    /// A file whose rows are told by their order.
    pub fn ordered(stem: impl Into<String>, columns: Vec<Column>) -> Self {
        Self { stem: stem.into(), columns, key: 0 }
    }

    /// A file whose rows are told by their first columns.
    pub fn keyed(stem: impl Into<String>, key: Vec<Column>, rest: Vec<Column>) -> Self {
        let count = key.len();
        Self { stem: stem.into(), columns: [key, rest].concat(), key: count }
    }
}

/// Tests of one class in one bench, in file order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// What the tests are.
    pub class: Class,
    /// How many.
    pub tests: u64,
}

/// Stimulus and expectation for one piece of hardware.
pub trait Bench: Suspects + Send + Sync {
    /// Short name: `dda`, `edge`, `setup`, `triangle`, `reciprocal-NAME`.
    fn name(&self) -> &str;

    /// Its files: configuration first, then expectations.
    fn files(&self) -> Vec<FileSpec>;

    /// Its groups of tests, in file order.
    fn groups(&self) -> &[Group];

    /// The reference model at this bench: what it answers is what every device is expected to. Its
    /// tables are those of [`Bench::files`], or the one of [`Bench::operand_file`] in the form
    /// `testfloat`, and none if the bench has no such form.
    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_>;

    /// Rows of the first expectation file that a test gives, if that is known beforehand.
    fn rows(&self, at: TestAt) -> Option<u64>;

    /// How much there is to do in a test, in clocks, set-ups or samples.
    fn work(&self, at: TestAt) -> u64 {
        self.rows(at).unwrap_or(1)
    }

    /// The single file of the operand form, if the bench has one.
    fn operand_file(&self) -> Option<FileSpec> {
        None
    }

    /// Which coverage cells the bench can meet.
    fn shape(&self) -> Shape;

    /// What it should meet beside the cells of its shape, and which of all these nothing can meet.
    fn goals(&self) -> Vec<Goal>;

    /// The stimulus of a test in words, for a person.
    fn describe(&self, at: TestAt) -> String;

    /// What stood behind a row of an expectation file, in words for a person: the accumulator and the edge
    /// words at a sample, if the bench has them.
    fn behind(&self, _at: TestAt, _file: &FileSpec, _row: &[u128]) -> Option<String> {
        None
    }

    /// How to take apart the words of a column: name and bits of its fields, most significant
    /// first; empty for a plain number.
    fn fields(&self, column: &str) -> Vec<(String, u32)>;
}

/// A word by its fields, in binary.
pub fn in_fields(fields: &[(String, u32)], word: u128) -> String {
    let mut left: u32 = fields.iter().map(|(_, bits)| bits).sum();
    let mut parts = Vec::new();
    for (name, bits) in fields.iter().filter(|(_, bits)| *bits > 0) {
        left -= bits;
        let field = word >> left & (u128::MAX >> (128 - bits));
        parts.push(format!("{name} {field:0width$b}", width = *bits as usize));
    }
    parts.join(" | ")
}

/// The fields of an accumulator, most significant first.
fn accumulator_fields(read: ReadOut) -> Vec<(String, u32)> {
    let fields =
        [("guard", read.guard()), ("integer", read.integer()), ("fraction", read.fraction())];
    fields.map(|(name, bits)| (name.to_owned(), bits)).to_vec()
}

/// Which test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TestAt {
    /// Group, in the order of [`Bench::groups`].
    pub group: usize,
    /// Index in the group.
    pub index: u64,
    /// Index in the whole bench.
    pub test: u64,
}

/// What every bench of a set is made from.
#[derive(Clone, Debug)]
pub struct Source {
    /// The profile.
    pub profile: Profile,
    /// Triangles of the scene, on the profile's grid.
    pub scene: std::sync::Arc<Vec<Triangle>>,
    /// What they bring for channels, parallel to them; empty where the scene brings nothing.
    pub values: std::sync::Arc<Vec<VertexValues>>,
    /// Seed of the random classes.
    pub seed: u64,
    /// Rows asked for in each walk file.
    pub count: u64,
}

impl Source {
    /// The benches that this profile has, in file order.
    pub fn benches(&self) -> Vec<Box<dyn Bench>> {
        let mut benches: Vec<Box<dyn Bench>> = Vec::new();
        if let Some(bench) = RegisterBench::new(self) {
            benches.push(Box::new(bench));
            return benches;
        }
        for kind in [WalkKind::Depth, WalkKind::Edge] {
            if let Some(bench) = WalkBench::new(kind, self) {
                benches.push(Box::new(bench));
            }
        }
        benches.push(Box::new(SetupBench::new(self)));
        benches.push(Box::new(TriangleBench::new(self)));
        if let Some(bench) = ChannelBench::new(self) {
            benches.push(Box::new(bench));
        }
        for bench in InterpolatorBench::all(self) {
            benches.push(Box::new(bench));
        }
        for bench in UnitBench::all(self) {
            benches.push(Box::new(bench));
        }
        for bench in ShapeKind::ALL.into_iter().filter_map(|kind| ShapeBench::new(kind, self)) {
            benches.push(Box::new(bench));
        }
        benches
    }
}

/// Cuts a small set to its size: never more tests than rows were asked for.
fn cut(groups: &mut [Group], rows: u64) {
    let mut left = rows;
    for group in groups {
        group.tests = group.tests.min(left);
        left -= group.tests;
    }
}

/// Looks up test number `test`.
pub fn locate(groups: &[Group], test: u64) -> Option<TestAt> {
    let mut first = 0;
    for (group, entry) in groups.iter().enumerate() {
        if test < first + entry.tests {
            return Some(TestAt { group, index: test - first, test });
        }
        first += entry.tests;
    }
    None
}

/// Tests of a bench.
pub fn tests(groups: &[Group]) -> u64 {
    groups.iter().map(|group| group.tests).sum()
}
