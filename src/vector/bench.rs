//! What a set tests: one bench a piece of hardware, each with its files, classes of tests, and a
//! way to emit any test alone. Spec clauses `N-2` to `N-4`.

mod coverage;
mod register;
mod shape;
mod slip;
mod triangle;
mod walk;

pub use coverage::{Cell, Coverage, Shape};
pub use register::RegisterBench;
pub use shape::{ShapeBench, ShapeKind};
pub use triangle::TriangleBench;
pub use walk::{WalkBench, WalkKind};

use super::table::Table;
use crate::case::Class;
use crate::format::Column;
use crate::profile::Profile;
use crate::setup::Triangle;

/// A file of a bench, before it has rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileSpec {
    /// Name without extension, such as `dda.exp`.
    pub stem: String,
    /// Its columns.
    pub columns: Vec<Column>,
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
pub trait Bench: Send + Sync {
    /// Short name: `dda`, `edge`, `setup`, `triangle`.
    fn name(&self) -> &'static str;

    /// Its files: configuration first, then expectations.
    fn files(&self) -> &[FileSpec];

    /// Its groups of tests, in file order.
    fn groups(&self) -> &[Group];

    /// Emits test `index` of group `group`; `test` is its number in the whole bench and `limit`
    /// cuts the rows of a walk. `tables` are in the order of [`Bench::files`].
    fn emit(&self, at: TestAt, limit: u64, tables: &mut [Table], coverage: &mut Coverage);

    /// Rows of the first expectation file that a test gives, if that is known beforehand.
    fn rows(&self, at: TestAt) -> Option<u64>;

    /// The single file of the operand form, if the bench has one; given one table of it,
    /// [`Bench::emit`] writes that form.
    fn operand_file(&self) -> Option<FileSpec> {
        None
    }

    /// Rows at the very start of a file that this device leaves open: what it shows before its
    /// first clock depends on its reset.
    fn unsettled(&self) -> u64 {
        0
    }

    /// Which coverage cells the bench can meet.
    fn shape(&self) -> Shape;

    /// The stimulus of a test in words, for a person.
    fn describe(&self, at: TestAt) -> String;

    /// How to take apart the words of a column: name and bits of its fields, most significant
    /// first; empty for a plain number.
    fn fields(&self, column: &str) -> Vec<(String, u32)>;

    /// Devices that differ from the profile in one decision, and that decision in words: the same
    /// stimulus, other expectations.
    fn variants(&self) -> Vec<(String, Box<dyn Bench>)>;
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
        benches.push(Box::new(TriangleBench::setup(self)));
        benches.push(Box::new(TriangleBench::triangle(self)));
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
