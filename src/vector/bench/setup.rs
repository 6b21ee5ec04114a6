//! The `setup` bench: vertices in, set-up words out.

use super::rig::OperandRig;
use super::triangles::{Random, Triangles};
use super::word::{input_words, ready, setup_columns};
use super::{Bench, FileSpec, Group, Rig, Run, Shape, Single, Source, TestAt, TestBench};
use crate::format::Role;
use crate::model::Model;
use crate::setup::Triangle;
use crate::vector::device::{SetUp, Stimulus, setup_words};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// What a set-up is given.
#[derive(Clone, Copy, Debug)]
pub struct SetupTest {
    /// Vertices on the sub-pixel grid.
    pub triangle: Triangle,
}

impl Stimulus for SetupTest {
    type Rows = Single<Table>;
}

/// Tests of a set-up.
#[derive(Clone, Debug)]
pub struct SetupBench {
    /// A model that draws nothing.
    model: Arc<Model>,
    triangles: Triangles,
    cfg: FileSpec,
    exp: Single<FileSpec>,
}

impl SetupBench {
    /// The bench of a profile.
    pub fn new(source: &Source) -> Self {
        let random = Random { rows_per_test: 64, class: 3, reach: None };
        let model = Arc::new(ready(&source.profile, false));
        Self {
            triangles: Triangles::new(source, random, |_| true),
            cfg: FileSpec::ordered("setup.cfg", model.ports().input.clone()),
            exp: Single { exp: FileSpec::ordered("setup.exp", setup_columns(&model)) },
            model,
        }
    }

    /// The vertices of a test.
    pub fn triangle_at(&self, at: TestAt) -> Triangle {
        self.triangles.at(at)
    }

    /// The reference model; it draws nothing.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    fn input_words(&self, triangle: &Triangle) -> Vec<i128> {
        input_words(triangle, self.model.depth().is_some())
    }

    /// The file of the operand form.
    fn operands(&self) -> FileSpec {
        let columns = self.cfg.columns.iter().chain(&self.exp.exp.columns).cloned().collect();
        FileSpec::ordered(self.name(), columns)
    }
}

impl TestBench for SetupBench {
    type Test = SetupTest;

    fn test(&self, at: TestAt, _: u64) -> SetupTest {
        SetupTest { triangle: self.triangles.at(at) }
    }

    fn configure(&self, test: &SetupTest, cfg: &mut Table) {
        cfg.push(&self.input_words(&test.triangle));
    }

    fn tables(&self, format: RowFormat) -> (Table, Single<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.exp.map(table))
    }
}

impl Bench for SetupBench {
    fn name(&self) -> &'static str {
        "setup"
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.exp.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        self.triangles.groups()
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        Some(1)
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format != RowFormat::TestFloat {
            return Box::new(Rig::new(self, Box::new(SetUp::new(Arc::clone(&self.model))), format));
        }
        let write = move |at, _, table: &mut Table| {
            let triangle = self.triangles.at(at);
            let mut words = self.input_words(&triangle);
            words.extend(setup_words(&self.model, &triangle));
            table.push(&words);
        };
        Box::new(OperandRig::new(Table::new(format, &self.operands().columns), write))
    }

    fn operand_file(&self) -> Option<FileSpec> {
        Some(self.operands())
    }

    fn shape(&self) -> Shape {
        if self.model.depth().is_some() { Shape::ALL } else { Shape::NONE }
    }

    fn describe(&self, at: TestAt) -> String {
        self.triangles.describe(at)
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        let plane = [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY];
        match self.model.depth().filter(|_| plane.iter().any(|role| role.pattern == column)) {
            Some(depth) => {
                let read = depth.read_out();
                vec![
                    ("guard".to_owned(), read.guard()),
                    ("integer".to_owned(), read.integer()),
                    ("fraction".to_owned(), read.fraction()),
                ]
            }
            None => Vec::new(),
        }
    }
}
