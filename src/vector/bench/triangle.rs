//! The `triangle` bench: set-up words in; spans, depths and counts out.

use super::rig::NoFiles;
use super::triangles::{Random, Triangles};
use super::word::{answer_files, bounds, place_columns, ready, setup_columns};
use super::{
    Bench, Coverage, FileSpec, Group, Rig, Run, Shape, Source, TestAt, TestBench, TriangleAnswers,
};
use crate::format::Role;
use crate::model::Model;
use crate::setup::Triangle;
use crate::vector::device::{Drawer, Stimulus, setup_words};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// The largest bounding box, in samples, that the bench draws.
const LARGEST: i128 = 1024;

/// What an engine is given.
#[derive(Clone, Debug)]
pub struct TriangleTest {
    /// Number of the test, the key of every row.
    pub test: u64,
    /// The vertices behind the words, for a device that sets up itself.
    pub triangle: Triangle,
    /// Set-up words, unreduced, and the flag of no area.
    pub setup: Vec<i128>,
    /// The bounding box in the window: x0 y0 x1 y1, half-open.
    pub bounds: [u32; 4],
}

impl Stimulus for TriangleTest {
    type Rows = TriangleAnswers<Table>;
}

/// Tests of a triangle engine.
#[derive(Clone, Debug)]
pub struct TriangleBench {
    /// What makes the words that go in.
    setup: Arc<Model>,
    /// What draws them.
    model: Arc<Model>,
    triangles: Triangles,
    cfg: FileSpec,
    answers: TriangleAnswers<FileSpec>,
}

impl TriangleBench {
    /// The bench of a profile.
    pub fn new(source: &Source) -> Self {
        let random = Random { rows_per_test: 512, class: 4, reach: Some(16) };
        let model = Arc::new(ready(&source.profile, true));
        let samples = |triangle: &Triangle| {
            let [x0, y0, x1, y1] = bounds(&model, triangle);
            i128::from(x1 - x0) * i128::from(y1 - y0)
        };
        let mut columns = place_columns(&[]);
        columns.extend(setup_columns(&model));
        let sides = [Role::BOX_Y_BEGIN, Role::BOX_Y_END, Role::BOX_X_BEGIN, Role::BOX_X_END];
        columns.extend(sides.map(|role| role.column(Role::PIXEL_WORD)));
        Self {
            setup: Arc::new(ready(&source.profile, false)),
            triangles: Triangles::new(source, random, |triangle| samples(triangle) <= LARGEST),
            cfg: FileSpec::ordered("triangle.cfg", columns),
            answers: answer_files(&model),
            model,
        }
    }

    /// The vertices of a test.
    pub fn triangle_at(&self, at: TestAt) -> Triangle {
        self.triangles.at(at)
    }

    /// The reference model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }
}

impl TestBench for TriangleBench {
    type Test = TriangleTest;

    fn test(&self, at: TestAt, _: u64) -> TriangleTest {
        let triangle = self.triangles.at(at);
        TriangleTest {
            test: at.test,
            setup: setup_words(&self.setup, &triangle),
            bounds: bounds(&self.model, &triangle),
            triangle,
        }
    }

    fn configure(&self, test: &TriangleTest, cfg: &mut Table) {
        let mut words = vec![i128::from(test.test)];
        words.extend(&test.setup);
        let [x0, y0, x1, y1] = test.bounds;
        words.extend([y0, y1, x0, x1].map(i128::from));
        cfg.push(&words);
    }

    fn tables(&self, format: RowFormat) -> (Table, TriangleAnswers<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.answers.map(table))
    }
}

impl Bench for TriangleBench {
    fn name(&self) -> &'static str {
        "triangle"
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.answers.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        self.triangles.groups()
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        None
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        Box::new(Rig::new(self, Box::new(Drawer::new(Arc::clone(&self.model))), format))
    }

    fn shape(&self) -> Shape {
        self.model.depth().map_or(Shape::NONE, |depth| {
            let read = depth.read_out();
            Shape::of_bits([true, read.clamps(), read.clamps()], read.fraction())
        })
    }

    fn describe(&self, at: TestAt) -> String {
        self.triangles.describe(at)
    }

    fn fields(&self, _: &str) -> Vec<(String, u32)> {
        Vec::new()
    }
}
