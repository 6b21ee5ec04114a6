//! Benches of primitives that are no triangles: lines, points, quadrilaterals and homogeneous triangles.
//! Vertices in, runs of pixels and depths out.

mod stimulus;

use super::{Bench, Coverage, FileSpec, Group, Shape, Source, TestAt, cut};
use crate::bits::Rounding;
use crate::case::Class;
use crate::case::triangle::RANDOM;
use crate::cover::{LineConfig, LineRule, PointConfig, PointRule, Start, Tie};
use crate::format::Column;
use crate::machine::Polygons;
use crate::model::{Drawing, Model};
use crate::profile::{Profile, neighbours};
use crate::setup::{ClipTriangle, Polygon};
use crate::vector::table::Table;
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

/// Tests of one kind.
#[derive(Clone, Debug)]
pub struct ShapeBench {
    kind: ShapeKind,
    has_depth: bool,
    model: Arc<Model>,
    /// Classes and their tests, each the words of its vertices.
    directed: Arc<Vec<(Class, Vec<Vec<i128>>)>>,
    seed: u64,
    files: Vec<FileSpec>,
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
        let files = files(kind, &model, has_depth);
        Some(Self { kind, has_depth, model, directed, seed: source.seed, files, groups })
    }

    fn words(&self, at: TestAt) -> Vec<i128> {
        match self.directed.get(at.group) {
            Some((_, list)) => list[usize::try_from(at.index).unwrap_or(0)].clone(),
            None => stimulus::random(
                self.kind,
                self.model.profile(),
                self.has_depth,
                self.seed,
                at.index,
            ),
        }
    }

    fn drawn(&self, words: &[i128]) -> Drawing {
        let mut drawing = Drawing::default();
        let stride = words.len() / self.vertices();
        let vertices: Vec<&[i128]> = words.chunks(stride).collect();
        let at = |n: usize| [vertices[n][0], vertices[n][1]];
        let model = &self.model;
        // What a machine refuses has no rows.
        let _ = match self.kind {
            ShapeKind::Line => {
                model.place([at(0), at(1)]).map(|line| model.draw_own(&line, &mut drawing))
            }
            ShapeKind::Point => {
                model.place(at(0)).map(|point| model.draw_own(&point, &mut drawing))
            }
            ShapeKind::Quad => {
                let z = self.has_depth.then(|| vertices.iter().map(|v| v[2]).collect());
                let polygon = Polygon { xy: (0..4).map(at).collect(), z };
                model.place(polygon).map(|polygon| model.draw_own(&polygon, &mut drawing))
            }
            ShapeKind::Clip => {
                let xyw = [0, 1, 2].map(|n: usize| [at(n)[0], at(n)[1], vertices[n][stride - 1]]);
                let z = self.has_depth.then(|| [0, 1, 2].map(|n: usize| vertices[n][2]));
                Ok(model.draw_own(&ClipTriangle { xyw, z }, &mut drawing))
            }
        };
        drawing
    }

    const fn vertices(&self) -> usize {
        match self.kind {
            ShapeKind::Line => 2,
            ShapeKind::Point => 1,
            ShapeKind::Quad => 4,
            ShapeKind::Clip => 3,
        }
    }

    /// Profiles with another line or point rule, and what that is.
    fn other_rules(&self) -> Vec<(String, Profile)> {
        let profile = self.model.profile();
        let mut changed = Vec::new();
        match self.kind {
            ShapeKind::Point => {
                let rules = [("pixel", PointRule::Pixel), ("pixel-d3d", PointRule::PixelD3d)];
                changed.extend(rules.map(|(name, rule)| {
                    let point = Some(PointConfig { rule });
                    (format!("point.rule is {name}"), Profile { point, ..profile.clone() })
                }));
            }
            ShapeKind::Line => {
                let rules = [
                    ("diamond-d3d", LineRule::DiamondD3d),
                    ("diamond-vulkan", LineRule::DiamondVulkan),
                    ("bresenham", LineRule::Bresenham),
                    ("midpoint with ties north-east", LineRule::Midpoint { tie: Tie::NorthEast }),
                    (
                        "integer-incremental from zero",
                        LineRule::IntegerIncremental { start: Start::Zero },
                    ),
                    ("naive, floored", LineRule::Naive { rounding: Rounding::Floor }),
                ];
                let stipple = profile.line.and_then(|line| line.stipple);
                changed.extend(rules.map(|(name, rule)| {
                    let line = Some(LineConfig { rule, stipple });
                    (format!("line.rule is {name}"), Profile { line, ..profile.clone() })
                }));
            }
            ShapeKind::Quad | ShapeKind::Clip => {
                changed.extend(neighbours(profile).into_iter().map(|n| (n.change, n.profile)));
            }
        }
        changed.retain(|(_, changed)| changed != profile);
        changed
    }
}

fn files(kind: ShapeKind, model: &Model, has_depth: bool) -> Vec<FileSpec> {
    let test = || Column::new("test", 32, false, 0, "Number of the test, from 0.");
    let pixel = |name, meaning| Column::new(name, 17, false, 0, meaning);
    let name = kind.name();
    let mut cfg = vec![test()];
    cfg.extend(stimulus::columns(kind, model, has_depth));
    let exp = vec![
        test(),
        pixel("y", "Row."),
        pixel("x0", "First column."),
        pixel("x1", "One past the last column."),
    ];
    let mut files = vec![
        FileSpec { stem: format!("{name}.cfg"), columns: cfg },
        FileSpec { stem: format!("{name}.exp"), columns: exp },
    ];
    if let Some(z) = model.ports().depth.as_ref().filter(|_| has_depth) {
        let columns = vec![test(), pixel("x", "Column."), pixel("y", "Row."), z.clone()];
        files.push(FileSpec { stem: format!("{name}-depth.exp"), columns });
    }
    files
}

impl Bench for ShapeBench {
    fn name(&self) -> &'static str {
        self.kind.name()
    }

    fn files(&self) -> &[FileSpec] {
        &self.files
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        None
    }

    fn emit(&self, at: TestAt, _: u64, tables: &mut [Table], _: &mut Coverage) {
        let [cfg, exp, depths @ ..] = tables else { return };
        let words = self.words(at);
        let test = i128::from(at.test);
        cfg.push(&std::iter::once(test).chain(words.iter().copied()).collect::<Vec<_>>());
        let drawing = self.drawn(&words);
        let mut values = drawing.depth.iter();
        for span in &drawing.spans {
            exp.push(&[test, i128::from(span.y), i128::from(span.x0), i128::from(span.x1)]);
            let [depths] = &mut *depths else { continue };
            for (x, z) in (span.x0..span.x1).zip(&mut values) {
                depths.push(&[test, i128::from(x), i128::from(span.y), i128::from(*z)]);
            }
        }
    }

    fn shape(&self) -> Shape {
        Shape { zones: [false; 3], remainders: [false; 4] }
    }

    fn describe(&self, at: TestAt) -> String {
        let words = self.words(at);
        let stride = words.len() / self.vertices();
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

    fn variants(&self) -> Vec<(String, Box<dyn Bench>)> {
        let bench = |(name, profile): (String, Profile)| {
            let model = Arc::new(Model::new(&profile).ok()?);
            let bench: Box<dyn Bench> = Box::new(Self { model, ..self.clone() });
            Some((name, bench))
        };
        self.other_rules().into_iter().filter_map(bench).collect()
    }
}
