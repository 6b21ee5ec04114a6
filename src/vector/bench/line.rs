//! The `line` and `point` benches: ends in, runs of pixels out.

use super::{Bench, Coverage, FileSpec, Group, Shape, Source, TestAt};
use crate::bits::Rounding;
use crate::case::triangle::RANDOM;
use crate::case::{Class, Words};
use crate::cover::{LineConfig, LineRule, PointConfig, PointRule, Segment, Start, Tie};
use crate::format::Column;
use crate::model::{Drawing, Model};
use crate::profile::Profile;
use crate::vector::table::Table;
use std::sync::Arc;

/// Rows asked for in a walk file per random line.
const ROWS_PER_LINE: u64 = 256;
/// Extent of a random line, in pixels.
const REACH: i64 = 24;

/// Tests of lines, or of points.
#[derive(Clone, Debug)]
pub struct LineBench {
    is_point: bool,
    model: Arc<Model>,
    directed: Arc<Vec<(Class, Vec<Segment>)>>,
    seed: u64,
    files: Vec<FileSpec>,
    groups: Vec<Group>,
}

impl LineBench {
    /// The bench of a profile that states a line rule.
    pub fn line(source: &Source) -> Option<Self> {
        source.profile.line?;
        Self::new(source, false)
    }

    /// The bench of a profile that states a point rule.
    pub fn point(source: &Source) -> Option<Self> {
        source.profile.point?;
        Self::new(source, true)
    }

    fn new(source: &Source, is_point: bool) -> Option<Self> {
        let model = Arc::new(Model::new(&source.profile).ok()?);
        let directed = Arc::new(directed(&source.profile, is_point));
        let share = source.count / ROWS_PER_LINE;
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|(class, list)| Group { class: *class, tests: list.len() as u64 })
            .collect();
        groups.push(Group { class: RANDOM, tests: share });
        let mut left = source.count;
        for group in &mut groups {
            group.tests = group.tests.min(left);
            left -= group.tests;
        }
        let files = files(&model, is_point);
        Some(Self { is_point, model, directed, seed: source.seed, files, groups })
    }

    fn segment(&self, at: TestAt) -> Segment {
        if let Some((_, list)) = self.directed.get(at.group) {
            return list[usize::try_from(at.index).unwrap_or(0)];
        }
        let mut words = Words::new(self.seed, if self.is_point { 6 } else { 5 }, at.index);
        let profile = self.model.profile();
        let (low, high) = profile.vertex.range();
        let pixel = 1i64 << profile.vertex.sub_pixel;
        let reach = REACH * pixel;
        let window = [profile.window.width, profile.window.height];
        let from = window.map(|side| words.between(-pixel, (i64::from(side) + 1) * pixel));
        let to = from.map(|value| value + words.between(-reach, reach));
        [from, to].map(|end| end.map(|value| value.clamp(low, high)))
    }

    fn drawn(&self, segment: &Segment) -> Drawing {
        let mut drawing = Drawing::default();
        // Lines and points are refused by no rule.
        let _ = if self.is_point {
            self.model.draw_point(&segment[0], &mut drawing)
        } else {
            self.model.draw_line(segment, &mut drawing)
        };
        drawing
    }
}

fn files(model: &Model, is_point: bool) -> Vec<FileSpec> {
    let test = Column::new("test", 32, false, 0, "Number of the test, from 0.");
    let pixel = |name, meaning| Column::new(name, 17, false, 0, meaning);
    let ends = model.line_ports().input.iter().take(if is_point { 2 } else { 4 }).cloned();
    let exp = vec![
        test.clone(),
        pixel("y", "Row."),
        pixel("x0", "First column."),
        pixel("x1", "One past the last column."),
    ];
    let name = if is_point { "point" } else { "line" };
    vec![
        FileSpec {
            stem: format!("{name}.cfg"),
            columns: std::iter::once(test).chain(ends).collect(),
        },
        FileSpec { stem: format!("{name}.exp"), columns: exp },
    ]
}

/// Lines and points around the upper left part of the window.
fn directed(profile: &Profile, is_point: bool) -> Vec<(Class, Vec<Segment>)> {
    let one = 1i128 << profile.vertex.sub_pixel;
    let middle = [profile.window.width, profile.window.height]
        .map(|side| i128::from(side.min(20) / 2) * one + one / 2);
    let moved = |x: i128, y: i128| [middle[0] + x, middle[1] + y];
    let mut list: Vec<(Class, Vec<Segment>)> = Vec::new();
    let quarters: Vec<i128> = (0..=4).map(|part| part * one / 4 - one / 2).collect();
    let places = || quarters.iter().flat_map(|x| quarters.iter().map(move |y| [*x, *y]));
    if is_point {
        let all = places().map(|[x, y]| [moved(x, y); 2]).collect();
        let catches = "a floor for a ceiling, or another end of the pixel";
        list.push((Class { tag: "borders", catches }, all));
    } else {
        let steps = [[7, 0], [7, 3], [7, 7], [3, 7], [6, 2], [8, 4], [9, 1]];
        let signs = [[1, 1], [1, -1], [-1, 1], [-1, -1]];
        let octants = steps.iter().flat_map(|[x, y]| {
            signs.iter().flat_map(move |[a, b]| [[x * a, y * b], [y * b, x * a]])
        });
        let octants: Vec<Segment> =
            octants.map(|[x, y]| [moved(0, 0), moved(x * one, y * one)]).collect();
        let catches = "an octant mirrored wrongly, a tie to the other side, a last pixel too many";
        list.push((Class { tag: "octants", catches }, octants));
        let corners = places().flat_map(|[x, y]| {
            [[one, 0], [one, one / 2], [one, one], [0, one], [-one / 2, one], [one / 4, 0]]
                .map(|[dx, dy]| [moved(x, y), moved(x + dx, y + dy)])
        });
        let catches = "a corner or an edge of the diamond that belongs to the other pixel";
        list.push((Class { tag: "diamond", catches }, corners.collect()));
        let points = places().map(|[x, y]| [moved(x, y); 2]).collect();
        let catches = "a line without length that draws";
        list.push((Class { tag: "no-length", catches }, points));
    }
    let (low, high) = profile.vertex.range();
    for (_, segments) in &mut list {
        segments.retain(|s| s.iter().flatten().all(|value| (low..=high).contains(value)));
    }
    list.retain(|(_, segments)| !segments.is_empty());
    list
}

impl Bench for LineBench {
    fn name(&self) -> &'static str {
        if self.is_point { "point" } else { "line" }
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
        let [cfg, exp] = tables else { return };
        let segment = self.segment(at);
        let test = i128::from(at.test);
        let ends = segment.as_flattened().iter().take(if self.is_point { 2 } else { 4 });
        cfg.push(&std::iter::once(test).chain(ends.copied()).collect::<Vec<_>>());
        for span in self.drawn(&segment).spans {
            exp.push(&[test, i128::from(span.y), i128::from(span.x0), i128::from(span.x1)]);
        }
    }

    fn shape(&self) -> Shape {
        Shape { zones: [false; 3], remainders: [false; 4] }
    }

    fn describe(&self, at: TestAt) -> String {
        let [[x0, y0], [x1, y1]] = self.segment(at);
        if self.is_point {
            format!("point ({x0}, {y0}) in sub-pixels")
        } else {
            format!("line from ({x0}, {y0}) to ({x1}, {y1}) in sub-pixels")
        }
    }

    fn fields(&self, _: &str) -> Vec<(&'static str, u32)> {
        Vec::new()
    }

    fn variants(&self) -> Vec<(String, Box<dyn Bench>)> {
        let profile = self.model.profile();
        let mut changed: Vec<(String, Profile)> = Vec::new();
        if self.is_point {
            for (name, rule) in [("pixel", PointRule::Pixel), ("pixel-d3d", PointRule::PixelD3d)] {
                let point = Some(PointConfig { rule });
                changed
                    .push((format!("point.rule is {name}"), Profile { point, ..profile.clone() }));
            }
        } else {
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
            for (name, rule) in rules {
                let stipple = profile.line.and_then(|line| line.stipple);
                let line = Some(LineConfig { rule, stipple });
                changed.push((format!("line.rule is {name}"), Profile { line, ..profile.clone() }));
            }
        }
        changed.retain(|(_, changed)| changed != profile);
        let bench = |(name, profile): (String, Profile)| {
            let model = Arc::new(Model::new(&profile).ok()?);
            let bench: Box<dyn Bench> = Box::new(Self { model, ..self.clone() });
            Some((name, bench))
        };
        changed.into_iter().filter_map(bench).collect()
    }
}
