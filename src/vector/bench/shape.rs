//! Benches of primitives that are no triangles: lines, points, quadrilaterals and homogeneous triangles.
//! Vertices in, runs of pixels and depths out.

mod stimulus;

use super::rig::NoFiles;
use super::word::{PIXEL, RUN, place_columns};
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, ShapeAnswers, Source, TestAt,
    TestBench, cut,
};
use crate::case::triangle::RANDOM;
use crate::case::{Class, place};
use crate::machine::Polygons;
use crate::model::Model;
use crate::profile::Profile;
use crate::vector::device::{ShapeDrawer, Stimulus};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// Rows asked for in a walk file per random test.
const ROWS_PER_TEST: u64 = 256;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    /// A line, by the rule that a profile states.
    Line,
    /// A point, by the rule that a profile states.
    Point,
    /// Four vertices, on machines that draw polygons; with depth on those that walk it.
    Quad,
    /// Three homogeneous vertices, on machines that take them.
    Clip,
}

impl ShapeKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::Line, Self::Point, Self::Quad, Self::Clip];

    const fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Point => "point",
            Self::Quad => "quad",
            Self::Clip => "clip",
        }
    }

    /// How many vertices it has.
    pub(in crate::vector) const fn vertices(self) -> usize {
        match self {
            Self::Line => 2,
            Self::Point => 1,
            Self::Quad => 4,
            Self::Clip => 3,
        }
    }

    /// Whether a profile has it.
    fn is_of(self, profile: &Profile) -> bool {
        match self {
            Self::Line => profile.line.is_some(),
            Self::Point => profile.point.is_some(),
            Self::Quad => {
                let polygons = profile.form.kind().polygons;
                profile.multisample.is_none() && polygons != Polygons::Refused
            }
            Self::Clip => profile.multisample.is_none() && profile.form.w_bits().is_some(),
        }
    }

    /// Whether its vertices have depth.
    fn has_depth(self, profile: &Profile) -> bool {
        profile.depth.is_some()
            && match self {
                Self::Line | Self::Point => false,
                Self::Quad => profile.form.kind().polygons == Polygons::Depth,
                Self::Clip => true,
            }
    }
}

/// What a device of one kind is given.
#[derive(Clone, Debug)]
pub struct ShapeTest {
    /// Number of the test, the key of every row.
    pub test: u64,
    /// The words of the vertices, as the columns of the configuration have them.
    pub words: Vec<i128>,
}

impl Stimulus for ShapeTest {
    type Rows = ShapeAnswers<Table>;
}

/// Tests of one kind.
#[derive(Clone, Debug)]
pub struct ShapeBench {
    kind: ShapeKind,
    has_depth: bool,
    model: Arc<Model>,
    /// Classes and their tests, each the words of its vertices.
    directed: Arc<Vec<(Class, Vec<Vec<i128>>)>>,
    seed: u64,
    cfg: FileSpec,
    answers: ShapeAnswers<FileSpec>,
    groups: Vec<Group>,
}

impl ShapeBench {
    /// The bench of a kind, if the profile has it.
    pub fn new(kind: ShapeKind, source: &Source) -> Option<Self> {
        if !kind.is_of(&source.profile) {
            return None;
        }
        let mut profile = source.profile.clone();
        if let Some(depth) = profile.depth.as_mut() {
            // A device cannot refuse; outside the guard range it decodes as the guard does.
            if depth.clamp == crate::format::Clamp::Error {
                depth.clamp = crate::format::Clamp::Guard;
            }
        }
        let model = Arc::new(Model::new(&profile).ok()?);
        let has_depth = kind.has_depth(&profile);
        let directed = Arc::new(stimulus::directed(kind, &profile, has_depth));
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|(class, list)| Group { class: *class, tests: list.len() as u64 })
            .collect();
        groups.push(Group { class: RANDOM, tests: source.count / ROWS_PER_TEST });
        cut(&mut groups, source.count);
        let (cfg, answers) = files(kind, &model, has_depth);
        Some(Self { kind, has_depth, model, directed, seed: source.seed, cfg, answers, groups })
    }

    /// The reference at this bench, or a device that differs from it in its model alone.
    pub(in crate::vector) fn drawer(&self, model: Arc<Model>) -> ShapeDrawer {
        ShapeDrawer { kind: self.kind, has_depth: self.has_depth, model }
    }

    /// What is drawn.
    pub fn kind(&self) -> ShapeKind {
        self.kind
    }

    /// The profile of the set.
    pub fn profile(&self) -> &Profile {
        self.model.profile()
    }

    fn words(&self, at: TestAt) -> Vec<i128> {
        match self.directed.get(at.group) {
            Some((_, list)) => list[place(at.index)].clone(),
            None => stimulus::random(
                self.kind,
                self.model.profile(),
                self.has_depth,
                self.seed,
                at.index,
            ),
        }
    }
}

fn files(kind: ShapeKind, model: &Model, has_depth: bool) -> (FileSpec, ShapeAnswers<FileSpec>) {
    let name = kind.name();
    let mut cfg = place_columns(&[]);
    cfg.extend(stimulus::columns(kind, model, has_depth));
    let depths = model.ports().depth.as_ref().filter(|_| has_depth).map(|depth| {
        let stem = format!("{name}-depth.exp");
        FileSpec::keyed(stem, place_columns(PIXEL), vec![depth.clone()])
    });
    let spans = FileSpec::keyed(format!("{name}.exp"), place_columns(RUN), Vec::new());
    (FileSpec::ordered(format!("{name}.cfg"), cfg), ShapeAnswers { spans, depths })
}

impl TestBench for ShapeBench {
    type Test = ShapeTest;

    fn test(&self, at: TestAt, _: u64) -> ShapeTest {
        ShapeTest { test: at.test, words: self.words(at) }
    }

    fn words(&self, test: &ShapeTest) -> Vec<i128> {
        std::iter::once(i128::from(test.test)).chain(test.words.iter().copied()).collect()
    }

    fn tables(&self, format: RowFormat) -> (Table, ShapeAnswers<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.answers.map(table))
    }
}

impl Bench for ShapeBench {
    fn name(&self) -> &str {
        self.kind.name()
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.answers.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        None
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        Box::new(Rig::new(self, Box::new(self.drawer(Arc::clone(&self.model))), format))
    }

    fn shape(&self) -> Shape {
        Shape::NONE
    }

    fn goals(&self) -> Vec<Goal> {
        super::rig::RECORDS.map(Goal::new).to_vec()
    }

    fn describe(&self, at: TestAt) -> String {
        let words = self.words(at);
        let stride = words.len() / self.kind.vertices();
        let vertices = words.chunks(stride).map(|vertex| {
            let parts: Vec<String> = vertex.iter().map(ToString::to_string).collect();
            format!(" ({})", parts.join(", "))
        });
        let unit = if self.kind == ShapeKind::Clip { "homogeneous, over W" } else { "plain" };
        format!(
            "{}{} in sub-pixels, {unit}",
            self.kind.name(),
            vertices.collect::<Vec<_>>().concat()
        )
    }

    fn fields(&self, _: &str) -> Vec<(String, u32)> {
        Vec::new()
    }
}
