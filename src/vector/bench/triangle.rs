//! The `setup` bench (vertices in, words out) and the `triangle` bench (words in; spans, depths
//! and events out).

mod device;
mod engine;
mod note;
mod quirk;
mod setup;
mod word;

use super::{Bench, Coverage, FileSpec, Group, Shape, Source, TestAt, cut};
use crate::bits::Event;
use crate::case::Words;
use crate::case::triangle::{self, Directed, Stimulus};
use crate::model::{Drawing, Model, Span};
use crate::profile::neighbours;
use crate::setup::Triangle;
use crate::value::Depth;
use crate::vector::table::Table;
use std::fmt::Write as _;
use std::sync::{Arc, Mutex};

use engine::EngineSlip;
use quirk::{QUIRKS, Quirk};
use setup::SetupSlip;
use word::{bounds, file_specs, input_words, ready, samples, scattered, setup_words};

/// Walk rows per random or scene test of the set-up bench.
const ROWS_PER_SETUP: u64 = 64;
/// Walk rows per random or scene test of the triangle bench.
const ROWS_PER_TRIANGLE: u64 = 512;
/// The largest bounding box, in samples, that the triangle bench draws.
const LARGEST: i128 = 1024;
/// Extent of a random triangle of that bench, in pixels.
const REACH: i128 = 16;

/// Tests of whole triangles.
#[derive(Clone, Debug)]
pub struct TriangleBench {
    draws: bool,
    model: Arc<Model>,
    quirk: Quirk,
    /// Samples that a device which goes on counting has counted before the test of that number.
    memory: Arc<Mutex<Option<(u64, u64)>>>,
    directed: Arc<Vec<Directed>>,
    scene: Arc<Vec<Triangle>>,
    stimulus: Stimulus,
    seed: u64,
    files: Vec<FileSpec>,
    groups: Vec<Group>,
}

impl TriangleBench {
    /// Vertices in; edge words, start and slopes out.
    pub fn setup(source: &Source) -> Self {
        Self::new(source, false)
    }

    /// Set-up in; spans, depths and events out.
    pub fn triangle(source: &Source) -> Self {
        Self::new(source, true)
    }

    fn new(source: &Source, draws: bool) -> Self {
        let model = Arc::new(ready(&source.profile, draws));
        let stimulus = Stimulus::new(&source.profile);
        let small = |triangle: &Triangle| !draws || samples(&model, triangle) <= LARGEST;
        let mut directed = stimulus.directed();
        for class in &mut directed {
            class.triangles.retain(|triangle| small(triangle));
        }
        directed.retain(|class| !class.triangles.is_empty());
        let scene: Vec<Triangle> = source.scene.iter().copied().filter(small).collect();
        let share = source.count / if draws { ROWS_PER_TRIANGLE } else { ROWS_PER_SETUP };
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.triangles.len() as u64 })
            .collect();
        groups.push(Group { class: triangle::SCENE, tests: share.min(scene.len() as u64) });
        groups.push(Group { class: triangle::RANDOM, tests: share });
        cut(&mut groups, source.count);
        let files = file_specs(&model, draws);
        let (directed, scene) = (Arc::new(directed), Arc::new(scene));
        let (quirk, seed) = (Quirk::None, source.seed);
        let memory = Arc::default();
        Self { draws, model, quirk, memory, directed, scene, stimulus, seed, files, groups }
    }

    /// The vertices of a test.
    pub fn triangle_at(&self, at: TestAt) -> Triangle {
        if let Some(class) = self.directed.get(at.group) {
            return class.triangles[usize::try_from(at.index).unwrap_or(0)];
        }
        if at.group == self.directed.len() {
            return self.scene[scattered(at.index, self.scene.len())];
        }
        let class = if self.draws { 4 } else { 3 };
        let words = Words::new(self.seed, class, at.index);
        self.stimulus.random(words, self.draws.then_some(REACH))
    }

    fn emit_setup(&self, triangle: &Triangle, tables: &mut [Table], coverage: &mut Coverage) {
        let [cfg, exp] = tables else { return };
        cfg.push(&input_words(triangle, self.model.depth().is_some()));
        let drawing = self.drawn(triangle);
        exp.push(&self.device_words(triangle, &drawing));
        self.note_setup(triangle, coverage);
    }

    fn emit_triangle(
        &self,
        triangle: &Triangle,
        test: u64,
        tables: &mut [Table],
        coverage: &mut Coverage,
    ) {
        let [cfg, exp, spans, rest @ ..] = tables else { return };
        let drawing = self.drawn(triangle);
        let test = i128::from(test);
        let mut words = vec![test];
        words.extend(setup_words(&self.model, &drawing));
        words.extend(bounds(&self.model, triangle).map(i128::from));
        cfg.push(&words);
        if let Quirk::Engine(slip) = self.quirk {
            let number = u64::try_from(test).unwrap_or(0);
            let answer = self.slipped(slip, triangle, (&drawing, number));
            exp.push(&summary(test, (answer.spans.len(), answer.samples), &drawing));
            for span in &answer.spans {
                spans.push(&[test, i128::from(span.y), i128::from(span.x0), i128::from(span.x1)]);
            }
            let [depths] = rest else { return };
            for (x, y, z) in answer.depths {
                depths.push(&[test, i128::from(x), i128::from(y), i128::from(z)]);
            }
            return;
        }
        let mut rows: Vec<Span> = Vec::with_capacity(drawing.spans.len());
        rows.extend(drawing.spans.iter().map(|span| match self.quirk {
            Quirk::RightEndIncluded => Span { x1: span.x1 + 1, ..*span },
            Quirk::LeftEndExcluded => Span { x0: span.x0 + 1, ..*span },
            Quirk::RowsLate => Span { y: span.y + 1, ..*span },
            _ => *span,
        }));
        rows.retain(|span| span.x0 < span.x1);
        let samples: u64 = rows.iter().map(|span| u64::from(span.x1 - span.x0)).sum();
        exp.push(&summary(test, (rows.len(), samples), &drawing));
        for span in &rows {
            spans.push(&[test, i128::from(span.y), i128::from(span.x0), i128::from(span.x1)]);
        }
        if self.model.ports().mask.is_some() {
            self.emit_samples(test, &drawing, rest);
            return;
        }
        let [depths] = rest else { return };
        let mut first = 0;
        for span in &rows {
            let width = (span.x1 - span.x0) as usize;
            // As drawn, unless a quirk moves the ends of spans.
            let values = match self.quirk {
                Quirk::RightEndIncluded | Quirk::LeftEndExcluded | Quirk::RowsLate => None,
                _ => drawing.depth.get(first..first + width),
            };
            let moved = if values.is_none() { self.depths(triangle, span) } else { Vec::new() };
            for (x, z) in (span.x0..span.x1).zip(values.unwrap_or(&moved)) {
                depths.push(&[test, i128::from(x), i128::from(span.y), i128::from(*z)]);
            }
            first += width;
        }
        self.note_samples(triangle, &drawing, coverage);
    }
}

/// A row of `triangle.exp`.
fn summary(test: i128, (spans, samples): (usize, u64), drawing: &Drawing) -> [i128; 8] {
    let count = |event| i128::from(drawing.events.total.count(event));
    [
        test,
        spans as i128,
        i128::from(samples),
        count(Event::Wrap),
        count(Event::ClampAbove),
        count(Event::ClampBelow),
        count(Event::Inexact),
        i128::from(drawing.zero_area),
    ]
}

impl Bench for TriangleBench {
    fn name(&self) -> &'static str {
        if self.draws { "triangle" } else { "setup" }
    }

    fn files(&self) -> &[FileSpec] {
        &self.files
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        (!self.draws).then_some(1)
    }

    fn emit(&self, at: TestAt, _: u64, tables: &mut [Table], coverage: &mut Coverage) {
        let triangle = self.triangle_at(at);
        if let [operands] = tables {
            let mut words = input_words(&triangle, self.model.depth().is_some());
            words.extend(setup_words(&self.model, &self.drawn(&triangle)));
            operands.push(&words);
        } else if self.draws {
            self.emit_triangle(&triangle, at.test, tables, coverage);
        } else {
            self.emit_setup(&triangle, tables, coverage);
        }
    }

    fn operand_file(&self) -> Option<FileSpec> {
        let [cfg, exp] = &self.files[..] else { return None };
        let columns = cfg.columns.iter().chain(&exp.columns).cloned().collect();
        Some(FileSpec { stem: self.name().to_owned(), columns })
    }

    fn shape(&self) -> Shape {
        let Some(depth) = self.model.depth() else {
            return Shape { zones: [false; 3], remainders: [false; 4] };
        };
        if self.draws {
            let read = depth.read_out();
            Shape::of_bits([true, read.clamps(), read.clamps()], read.fraction())
        } else {
            Shape::ALL
        }
    }

    fn describe(&self, at: TestAt) -> String {
        let Triangle { xy, z } = self.triangle_at(at);
        let mut text = "triangle".to_owned();
        for (n, [x, y]) in xy.iter().enumerate() {
            let z = z.map(|z| format!(", {}", z[n])).unwrap_or_default();
            let _ = write!(text, " ({x}, {y}{z})");
        }
        text + " in sub-pixels and depth codes"
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        match (column, self.model.depth()) {
            ("z" | "dzdx" | "dzdy", Some(depth)) if !self.draws => {
                let read = depth.read_out();
                vec![
                    ("guard".to_owned(), read.guard()),
                    ("integer".to_owned(), read.integer()),
                    ("fraction".to_owned(), read.fraction()),
                ]
            }
            _ => Vec::new(),
        }
    }

    fn variants(&self) -> Vec<(String, Box<dyn Bench>)> {
        let mut list: Vec<(String, Box<dyn Bench>)> = Vec::new();
        for neighbour in neighbours(self.model.profile()) {
            let model = Arc::new(ready(&neighbour.profile, self.draws));
            // Columns stay those of the set: a device is compared in the set's own widths, and
            // narrower words may come with their sign or with zeros above them.
            let (ours, theirs) = (&self.model.ports().setup, &model.ports().setup);
            if theirs.len() != ours.len() {
                continue;
            }
            if theirs.iter().zip(ours).any(|(a, b)| a.width < b.width) {
                let (model, quirk) = (Arc::clone(&model), Quirk::ZeroExtended);
                let change = neighbour.change.clone();
                list.push((change, Box::new(Self { model, quirk, ..self.clone() })));
            }
            list.push((neighbour.change, Box::new(Self { model, ..self.clone() })));
        }
        // What a slip at the end of a run does to masks is not told by the profile.
        let slips = if self.model.ports().mask.is_none() { &QUIRKS[..] } else { &[] };
        for (quirk, name) in slips {
            list.push(((*name).to_owned(), Box::new(Self { quirk: *quirk, ..self.clone() })));
        }
        let with = |quirk| Box::new(Self { quirk, memory: Arc::default(), ..self.clone() });
        if self.draws && self.engine(EngineSlip::LastRow).is_some() {
            let edge = self.model.profile().form.edge().map_or(2, |edge| edge.width);
            let read = self.model.depth().map(Depth::read_out);
            for (slip, name) in EngineSlip::all(edge, read) {
                list.push((name, with(Quirk::Engine(slip))));
            }
        }
        if !self.draws && self.unit(SetupSlip::SignLost).is_some() {
            for (slip, name) in SetupSlip::ALL {
                list.push((name.to_owned(), with(Quirk::Setup(slip))));
            }
        }
        list
    }
}
