//! The `setup` bench: vertices in, set-up words out.

use super::rig::OperandRig;
use super::triangles::{Given, Random, Triangles};
use super::word::{input_words, ready, setup_columns};
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Single, Source, TestAt, TestBench,
};
use crate::case::triangle::{CLOSING, Stimulus as Cases};
use crate::case::{Directed, Words};
use crate::format::Role;
use crate::model::Model;
use crate::profile::Profile;
use crate::setup::{Division, Triangle};
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
        let more = closing(&source.profile, &model);
        Self {
            triangles: Triangles::new(source, random, (Vec::new(), more), |_| true, |_| 1),
            cfg: FileSpec::ordered("setup.cfg", model.ports().input.clone()),
            exp: Single { exp: FileSpec::ordered("setup.exp", setup_columns(&model)) },
            model,
        }
    }

    /// The vertices of a test.
    pub fn triangle_at(&self, at: TestAt) -> Triangle {
        match self.triangles.at(at) {
            Given::Triangle(triangle) => triangle,
            Given::Words(_) => unreachable!("a set-up is given vertices alone"),
        }
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

fn shape(model: &Model) -> Shape {
    if model.depth().is_some() { Shape::ALL } else { Shape::NONE }
}

fn goals(model: &Model) -> Vec<Goal> {
    let mut goals = super::rig::RECORDS.map(Goal::new).to_vec();
    goals.extend(["winding.positive", "winding.negative", "winding.zero"].map(Goal::new));
    if let Some(depth) = model.depth().filter(|d| d.config().division == Division::Quotient) {
        goals.extend(ties(model.profile(), depth.read_out().fraction()));
    }
    goals
}

/// Tries of the search that closes cells.
const TRIES: u64 = 8192;

/// Triangles for the cells that no directed class meets, as far as a short search finds them.
fn closing(profile: &Profile, model: &Arc<Model>) -> Option<Directed<Triangle>> {
    let (stimulus, device) = (Cases::new(profile), SetUp::new(Arc::clone(model)));
    let mut met = Coverage::default();
    for triangle in stimulus.directed().iter().flat_map(|class| &class.tests) {
        device.met(triangle, &mut met);
    }
    let mut open = met.report(shape(model), &goals(model)).open;
    open.retain(|cell| !super::rig::RECORDS.contains(&cell.as_str()));
    let mut tests = Vec::new();
    for index in 0..TRIES {
        if open.is_empty() {
            break;
        }
        let triangle = stimulus.closing(Words::new(0, 10, index));
        let mut met = Coverage::default();
        device.met(&triangle, &mut met);
        let before = open.len();
        open.retain(|cell| met.rows(cell) == 0);
        if open.len() < before {
            tests.push(triangle);
        }
    }
    (!tests.is_empty()).then_some(Directed { class: CLOSING, tests })
}

/// Ties of each quotient of the plane, by its sign and by the magnitude it is rounded from, mod 4; and
/// the cells of the shape that are ties of the x slope.
fn ties(profile: &Profile, fraction: u32) -> Vec<Goal> {
    let (low, high) = profile.vertex.range();
    // Twice the area is a determinant of two sides of the field.
    let most = (high - low) * (high - low);
    let sub_pixel = profile.vertex.sub_pixel;
    let quotients = [
        (Role::DEPTH_INIT, fraction),
        (Role::DEPTH_DX, sub_pixel + fraction),
        (Role::DEPTH_DY, sub_pixel + fraction),
    ];
    let mut goals = Vec::new();
    for (role, scale) in quotients {
        let least = 1i128 << (scale + 1);
        let cells = ["positive", "negative"].into_iter().flat_map(|sign| {
            (0..4).map(move |quotient| format!("tie.{}.{sign}.q{quotient}", role.pattern))
        });
        let octants = (role.pattern == Role::DEPTH_DX.pattern).then(Coverage::tie_cells);
        for cell in cells.chain(octants.into_iter().flatten()) {
            if most < least {
                // n 2^scale = (q + 1/2) d asks for a d that 2^(scale+1) divides.
                let bound = format!(
                    "2^{} divides twice the area in a tie, which is at most {most}",
                    scale + 1
                );
                goals.push(Goal::never(cell, "P-3", bound));
            } else if cell.starts_with("tie") {
                goals.push(Goal::new(cell));
            }
        }
    }
    goals
}

impl TestBench for SetupBench {
    type Test = SetupTest;

    fn test(&self, at: TestAt, _: u64) -> SetupTest {
        SetupTest { triangle: self.triangle_at(at) }
    }

    fn words(&self, test: &SetupTest) -> Vec<i128> {
        self.input_words(&test.triangle)
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
            let triangle = self.triangle_at(at);
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
        shape(&self.model)
    }

    fn goals(&self) -> Vec<Goal> {
        goals(&self.model)
    }

    fn describe(&self, at: TestAt) -> String {
        self.triangles.at(at).describe()
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        let plane = [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY];
        match self.model.depth().filter(|_| plane.iter().any(|role| role.pattern == column)) {
            Some(depth) => super::accumulator_fields(depth.read_out()),
            None => Vec::new(),
        }
    }
}
