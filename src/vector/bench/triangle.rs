//! The `triangle` bench: set-up words in; spans, depths and counts out.

use super::rig::NoFiles;
use super::triangles::{Given, Random, Triangles};
use super::word::{answer_files, bounds, place_columns, ready, setup_columns};
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Source, TestAt, TestBench,
    TriangleAnswers,
};
use crate::case::engine::{Drawn, Engine};
use crate::format::{Clamp, Role};
use crate::model::Model;
use crate::setup::{Division, Triangle};
use crate::value::{Depth, StartBias};
use crate::vector::device::{Drawer, Stimulus, setup_words};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// The largest bounding box, in samples, that the bench draws.
const LARGEST: u64 = 1024;

/// What an engine is given.
#[derive(Clone, Debug)]
pub struct TriangleTest {
    /// Number of the test, the key of every row.
    pub test: u64,
    /// The vertices behind the words, for a device that sets up itself; `None` for words of their own
    /// (clause `X-5`).
    pub triangle: Option<Triangle>,
    /// Set-up words, unreduced, and the flag of no area.
    pub setup: Vec<i128>,
    /// The bounding box in the window: x0 y0 x1 y1, half-open.
    pub bounds: [u32; 4],
}

impl TriangleTest {
    /// Samples of the box.
    pub fn samples(&self) -> u64 {
        let [x0, y0, x1, y1] = self.bounds;
        u64::from(x1.saturating_sub(x0)) * u64::from(y1.saturating_sub(y0))
    }
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
            u64::from(x1 - x0) * u64::from(y1 - y0)
        };
        let words = word_engine(&model).map(|engine| engine.directed(source.count / 4));
        let words = words.unwrap_or_default();
        let mut columns = place_columns(&[]);
        columns.extend(setup_columns(&model));
        let sides = [Role::BOX_Y_BEGIN, Role::BOX_Y_END, Role::BOX_X_BEGIN, Role::BOX_X_END];
        columns.extend(sides.map(|role| role.column(Role::PIXEL_WORD)));
        Self {
            setup: Arc::new(ready(&source.profile, false)),
            triangles: Triangles::new(
                source,
                random,
                (words, None),
                |triangle| samples(triangle) <= LARGEST,
                |given| match given {
                    // Half of a box is what most triangles cover.
                    Given::Triangle(triangle) => samples(triangle) / 2 + 1,
                    Given::Words(drawn) => drawn.samples() + 1,
                },
            ),
            cfg: FileSpec::ordered("triangle.cfg", columns),
            answers: answer_files(&model),
            model,
        }
    }

    /// The vertices of a test, if it has any.
    pub fn triangle_at(&self, at: TestAt) -> Option<Triangle> {
        match self.triangles.at(at) {
            Given::Triangle(triangle) => Some(triangle),
            Given::Words(_) => None,
        }
    }

    /// The cells of the shape that the error of a plane keeps its values out of, where vertices alone
    /// drive the bench and what is covered lies in the triangle.
    fn beyond_the_plane(&self) -> Vec<Goal> {
        let profile = self.model.profile();
        let plain = |depth: &&Depth| {
            let config = depth.config();
            config.division == Division::Quotient
                && config.start_bias == StartBias::None
                && config.bias.is_none()
        };
        let Some(depth) = self.model.depth().filter(plain) else { return Vec::new() };
        if word_engine(&self.model).is_some()
            || !profile.covers_exactly()
            || self.model.ports().mask.is_some()
        {
            return Vec::new();
        }
        let roundings = i128::from(profile.window.width) + i128::from(profile.window.height) - 1;
        // In halves of a unit of the accumulator.
        let each = if depth.config().rounding.is_nearest() { 1 } else { 2 };
        let (error, unit) = (each * roundings, 1i128 << depth.read_out().fraction());
        let bound = |limit: &str| {
            format!(
                "{roundings} roundings err by at most {error}/2 < {limit} units of 2^-{}",
                depth.read_out().fraction()
            )
        };
        let mut goals = Vec::new();
        if error < 2 * unit {
            let all = ["zero", "below-half", "tie", "above-half"];
            let cells = Coverage::zone_cells("above", &all);
            goals.extend(cells.map(|cell| Goal::never(cell, "B-5", bound(&unit.to_string()))));
        }
        if error < unit {
            let cells = Coverage::zone_cells("below", &["zero", "below-half", "tie"]);
            goals.extend(cells.map(|cell| Goal::never(cell, "B-5", bound(&format!("{unit}/2")))));
        }
        goals
    }

    /// The reference model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }
}

/// The engine that set-up words alone can drive: edge functions over a box, one sample a pixel, and a
/// read-out that forgets the way. `None` where none draws the profile.
pub(in crate::vector) fn word_engine(model: &Model) -> Option<Engine> {
    let edge = model.profile().plain_edges()?.width;
    let read = model.depth().map(Depth::read_out);
    // A sticky accumulator depends on the way, and a refused triangle has no rows.
    let told = read.is_none_or(|r| !matches!(r.clamp(), Clamp::Saturate | Clamp::Error));
    let window = model.profile().window;
    told.then_some(Engine { edge, read, window: [window.width, window.height] })
}

fn beyond(high: i128, side: u32, pixel: i128) -> String {
    format!("vertices end at {high} <= {side} x {pixel} sub-pixels")
}

impl TestBench for TriangleBench {
    type Test = TriangleTest;

    fn test(&self, at: TestAt, _: u64) -> TriangleTest {
        let test = at.test;
        match self.triangles.at(at) {
            Given::Triangle(triangle) => TriangleTest {
                test,
                setup: setup_words(&self.setup, &triangle),
                bounds: bounds(&self.model, &triangle),
                triangle: Some(triangle),
            },
            Given::Words(Drawn { edges, depth, zero_area, bounds }) => {
                let mut setup: Vec<i128> = edges.concat();
                setup.extend(depth.into_iter().flatten());
                setup.push(zero_area.into());
                TriangleTest { test, triangle: None, setup, bounds }
            }
        }
    }

    fn words(&self, test: &TriangleTest) -> Vec<i128> {
        let mut words = vec![i128::from(test.test)];
        words.extend(&test.setup);
        let [x0, y0, x1, y1] = test.bounds;
        words.extend([y0, y1, x0, x1].map(i128::from));
        words
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

    fn work(&self, at: TestAt) -> u64 {
        self.test(at, u64::MAX).samples()
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        Box::new(Rig::new(self, Box::new(Drawer::new(Arc::clone(&self.model))), format))
    }

    fn shape(&self) -> Shape {
        // Depths of several samples a pixel are not counted.
        let depth = self.model.depth().filter(|_| self.model.ports().mask.is_none());
        depth.map_or(Shape::NONE, |depth| {
            let read = depth.read_out();
            Shape::of_bits([true, read.clamps(), read.clamps()], read.fraction())
        })
    }

    fn goals(&self) -> Vec<Goal> {
        let mut goals = super::rig::RECORDS.map(Goal::new).to_vec();
        goals.push(Goal::new("zero-area"));
        let window = self.model.profile().window;
        let (low, high) = self.model.profile().vertex.range();
        let pixel = 1i128 << self.model.profile().vertex.sub_pixel;
        let ends = [
            ("beyond.left", low < 0, format!("vertices begin at {low} >= 0 sub-pixels")),
            ("beyond.top", low < 0, format!("vertices begin at {low} >= 0 sub-pixels")),
            (
                "beyond.right",
                high > i128::from(window.width) * pixel,
                beyond(high, window.width, pixel),
            ),
            (
                "beyond.bottom",
                high > i128::from(window.height) * pixel,
                beyond(high, window.height, pixel),
            ),
        ];
        goals.extend(ends.map(|(cell, reached, bound)| {
            if reached { Goal::new(cell) } else { Goal::never(cell, "T-1", bound) }
        }));
        goals.extend(self.beyond_the_plane());
        if let Some(engine) = word_engine(&self.model) {
            goals.extend(
                engine.read.into_iter().flat_map(|read| Coverage::guard_goals(read.guard())),
            );
            goals.extend(
                ["cut.left", "cut.right", "cut.top", "cut.bottom", "box.empty", "row.several-runs"]
                    .map(Goal::new),
            );
            for edge in 0..3 {
                goals.extend(["zero", "minus-one"].map(|at| Goal::new(format!("edge{edge}.{at}"))));
            }
            for (axis, side) in [("x", window.width), ("y", window.height)] {
                let powers = (0..u32::BITS - side.leading_zeros()).map(|power| 1u32 << power);
                let besides =
                    powers.clone().filter(|two| *two <= 256 && *two < side).map(|two| two + 1);
                goals.extend(
                    powers.chain(besides).map(|length| Goal::new(format!("run.{axis}.{length}"))),
                );
            }
        }
        goals
    }

    fn describe(&self, at: TestAt) -> String {
        self.triangles.at(at).describe()
    }

    fn behind(&self, at: TestAt, file: &FileSpec, row: &[u128]) -> Option<String> {
        let engine = word_engine(&self.model)?;
        let place = |role: Role| file.columns.iter().position(|c| c.name == role.pattern);
        let [x, y] = [row[place(Role::X)?], row[place(Role::Y)?]].map(u128::cast_signed);
        let setup = self.test(at, u64::MAX).setup;
        let word = |first: usize, width: u32| {
            let [init, dx, dy] = [0, 1, 2].map(|k| setup[first + k]);
            let word = init.wrapping_add(x.wrapping_mul(dx)).wrapping_add(y.wrapping_mul(dy));
            word.cast_unsigned() & (u128::MAX >> (128 - width))
        };
        let edges = [0, 3, 6].map(|first| crate::bits::hex(word(first, engine.edge), engine.edge));
        let edges = format!("edge words {}", edges.join(" "));
        Some(match engine.read {
            Some(read) => {
                let fields = super::accumulator_fields(read);
                format!("accumulator {}; {edges}", super::in_fields(&fields, word(9, read.width())))
            }
            None => edges,
        })
    }

    fn fields(&self, _: &str) -> Vec<(String, u32)> {
        Vec::new()
    }
}
