//! The `channel` bench: vertices with the codes of their channels in; set-up words, and codes at samples out.
//! Spec clause `CH-15`.

use super::rig::NoFiles;
use super::triangles::{Given, Random, Triangles};
use super::word::{PIXEL, bounds, place_columns};
use super::{
    Bench, ChannelAnswers, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Source, TestAt,
    TestBench,
};
use crate::case::Words;
use crate::format::{Clamp, Column, ReadOut, Role, WordFormat};
use crate::machine::ComponentWords;
use crate::model::Model;
use crate::setup::Triangle;
use crate::value::{Corrector, Divided, VertexValues};
use crate::vector::device::{ChannelDrawer, Stimulus};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// Class of the random words behind the codes of vertices.
const CODES: u64 = 12;

/// What a device is given.
#[derive(Clone, Debug)]
pub struct ChannelTest {
    /// Number of the test, the key of every row.
    pub test: u64,
    /// The vertices.
    pub triangle: Triangle,
    /// Codes of each component at the three vertices, channel by channel.
    pub codes: Vec<[i128; 3]>,
    /// Codes of 1/w, where the profile has them.
    pub inverse_w: Option<[i128; 3]>,
}

impl Stimulus for ChannelTest {
    type Rows = ChannelAnswers<Table>;
}

/// Tests of the channels of a profile.
#[derive(Clone, Debug)]
pub struct ChannelBench {
    model: Arc<Model>,
    triangles: Triangles,
    /// What the triangles of the scene bring.
    values: Arc<Vec<VertexValues>>,
    seed: u64,
    cfg: FileSpec,
    answers: ChannelAnswers<FileSpec>,
}

impl ChannelBench {
    /// The largest bounding box, in pixels, that the bench draws.
    pub const LARGEST: u64 = 256;

    /// The bench of a profile with channels.
    pub fn new(source: &Source) -> Option<Self> {
        if source.profile.channel.is_empty() {
            return None;
        }
        let mut profile = source.profile.clone();
        if let Some(depth) = profile.depth.as_mut().filter(|depth| depth.clamp == Clamp::Error) {
            // A device cannot refuse a triangle.
            depth.clamp = Clamp::Guard;
        }
        let model = Arc::new(Model::new(&profile).ok()?);
        let samples = |triangle: &Triangle| {
            let [x0, y0, x1, y1] = bounds(&model, triangle);
            u64::from(x1 - x0) * u64::from(y1 - y0)
        };
        let random = Random { rows_per_test: 256, class: 11, reach: Some(12) };
        let fits = |triangle: &Triangle| samples(triangle) <= Self::LARGEST;
        let rows = |given: &Given| match given {
            Given::Triangle(triangle) => samples(triangle) / 2 + 1,
            Given::Words(_) => 1,
        };
        let triangles = Triangles::new(source, random, (Vec::new(), None), fits, rows);
        let cfg = FileSpec::ordered("channel.cfg", columns(&model));
        let answers = answers(&model);
        let values = Arc::clone(&source.values);
        Some(Self { model, triangles, values, seed: source.seed, cfg, answers })
    }

    /// The reference model.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// The codes of a test: those of the scene, or drawn.
    fn codes(&self, at: TestAt) -> (Vec<[i128; 3]>, Option<[i128; 3]>) {
        match self.triangles.number(at).and_then(|n| self.values.get(n)) {
            Some(values) => (values.components().to_vec(), values.inverse_w()),
            None => self.drawn(at.test),
        }
    }

    /// Any codes, ends of the range, or close together; w near and far.
    fn drawn(&self, test: u64) -> (Vec<[i128; 3]>, Option<[i128; 3]>) {
        let profile = self.model.profile();
        let mut words = Words::new(self.seed, CODES, test);
        let kind = words.below(3);
        let mut codes = Vec::new();
        for channel in &profile.channel {
            let (low, high) = channel.range();
            let span = u64::try_from(high - low).unwrap_or(u64::MAX);
            for _ in &channel.components {
                let base = i128::from(words.below(span.saturating_add(1)));
                codes.push([0; 3].map(|_| {
                    low + match kind {
                        0 => i128::from(words.below(span.saturating_add(1))),
                        1 => i128::from(words.below(2)) * i128::from(span),
                        _ => (base + i128::from(words.below(3))).min(span.into()),
                    }
                }));
            }
        }
        let inverse_w = profile.w.map(|w| {
            let most = (1u64 << w.integer) - 1;
            // As many far ones as near ones: every number of bits alike.
            [0; 3].map(|_| {
                let bits = words.below(w.integer.into());
                i128::from(words.below(most >> bits) + 1)
            })
        });
        (codes, inverse_w)
    }

    fn given(&self, at: TestAt) -> Triangle {
        match self.triangles.at(at) {
            Given::Triangle(triangle) => triangle,
            Given::Words(_) => unreachable!("channels are given vertices alone"),
        }
    }
}

/// The vertices, each with its code of 1/w and its codes.
fn columns(model: &Model) -> Vec<Column> {
    let (profile, input) = (model.profile(), &model.ports().input);
    let mut columns = place_columns(&[]);
    for vertex in 0..3 {
        let own = [Role::VERTEX_X, Role::VERTEX_Y].map(|role| role.name(vertex));
        columns.extend(input.iter().filter(|column| own.contains(&column.name)).cloned());
        columns.extend(profile.w.map(|w| {
            let meaning = format!("Vertex {vertex}, code of 1/w.");
            WordFormat::unsigned(w.integer).column(format!("v{vertex}_q"), meaning)
        }));
        for channel in &profile.channel {
            let word = WordFormat::unsigned(channel.integer);
            let word = if channel.signed { WordFormat::signed(channel.integer) } else { word };
            columns.extend(channel.components.iter().map(|component| {
                let (channel, name) =
                    (&channel.name, format!("v{vertex}_{}_{component}", channel.name));
                word.column(name, format!("Vertex {vertex}, {component} of {channel}."))
            }));
        }
    }
    columns
}

/// The set-up words of the channels, and a file of codes for each.
fn answers(model: &Model) -> ChannelAnswers<FileSpec> {
    let ports = model.ports();
    let own = model.channels().map_or_else(Vec::new, |channels| channels.columns().to_vec());
    let codes = ports.channels.iter().map(|channel| {
        let mut key = place_columns(PIXEL);
        key.extend(channel.by_sample.then(|| Role::SAMPLE.column(WordFormat::unsigned(5))));
        FileSpec::keyed(format!("channel-{}.exp", channel.name), key, channel.components.clone())
    });
    let details = model.profile().channel.iter().filter_map(|channel| {
        let unit = channel.detail?.unit().ok()?;
        let difference = WordFormat::signed(channel.integer + 1);
        let mut columns: Vec<Column> = Vec::new();
        for (end, way) in [("dx", "to the right"), ("dy", "downward")] {
            columns.extend(channel.components.iter().map(|component| {
                let meaning = format!("{component}, difference {way} in the quad.");
                difference.column(format!("{component}_{end}"), meaning)
            }));
        }
        let level = WordFormat::unsigned(unit.width()).fraction(channel.detail?.fraction);
        columns.push(level.column("level".to_owned(), "Level of detail.".to_owned()));
        let name = format!("channel-{}-detail.exp", channel.name);
        Some(FileSpec::keyed(name, place_columns(PIXEL), columns))
    });
    ChannelAnswers {
        details: details.collect(),
        setup: FileSpec::keyed("channel-setup.exp", place_columns(&[]), own),
        codes: codes.collect(),
    }
}

impl TestBench for ChannelBench {
    type Test = ChannelTest;

    fn test(&self, at: TestAt, _: u64) -> ChannelTest {
        let (codes, inverse_w) = self.codes(at);
        ChannelTest { test: at.test, triangle: self.given(at), codes, inverse_w }
    }

    fn words(&self, test: &ChannelTest) -> Vec<i128> {
        let mut words = vec![i128::from(test.test)];
        for (n, vertex) in test.triangle.xy.iter().enumerate() {
            words.extend(vertex);
            words.extend(test.inverse_w.map(|q| q[n]));
            words.extend(test.codes.iter().map(|component| component[n]));
        }
        words
    }

    fn tables(&self, format: RowFormat) -> (Table, ChannelAnswers<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.answers.map(table))
    }
}

impl Bench for ChannelBench {
    fn name(&self) -> &'static str {
        "channel"
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.answers.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        self.triangles.groups()
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        Some(1)
    }

    fn work(&self, at: TestAt) -> u64 {
        let [x0, y0, x1, y1] = bounds(&self.model, &self.given(at));
        u64::from(x1 - x0) * u64::from(y1 - y0)
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        let device = ChannelDrawer::new(Arc::clone(&self.model));
        Box::new(Rig::new(self, Box::new(device), format))
    }

    fn shape(&self) -> Shape {
        Shape::NONE
    }

    fn goals(&self) -> Vec<Goal> {
        Vec::new()
    }

    fn describe(&self, at: TestAt) -> String {
        let (codes, inverse_w) = self.codes(at);
        let q = inverse_w.map_or_else(String::new, |q| format!(", q {q:?}"));
        format!("{}; codes {codes:?}{q}", self.triangles.at(at).describe())
    }

    fn behind(&self, at: TestAt, file: &FileSpec, row: &[u128]) -> Option<String> {
        let number = self.answers.codes.iter().position(|codes| codes.stem == file.stem)?;
        let word = |role: Role| {
            let column = file.columns.iter().position(|c| c.name == role.pattern)?;
            u32::try_from(row[column]).ok()
        };
        let sample = ([word(Role::X)?, word(Role::Y)?], word(Role::SAMPLE));
        let (codes, inverse_w) = self.codes(at);
        let values = self.model.values_in_order(&codes, inverse_w).ok()?;
        let triangle = self.model.place(self.given(at)).ok()?;
        let words = self.model.channel_words(&triangle, &values, number, sample)?;
        let corrector = self.model.channels()?.corrector(number)?;
        let text = corrector.config().components.iter().zip(words);
        let text = text.map(|(component, words)| behind_component(corrector, component, words));
        Some(text.collect::<Vec<_>>().join("; "))
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        let Some(channels) = self.model.channels().filter(|channels| channels.steps()) else {
            return Vec::new();
        };
        channels.accumulator(column).map_or_else(Vec::new, super::accumulator_fields)
    }
}

/// What stood behind a component's code.
fn behind_component(corrector: &Corrector, component: &str, words: ComponentWords) -> String {
    let fields = |read: ReadOut, word: i128| {
        let word = word.cast_unsigned() & (u128::MAX >> (128 - read.width()));
        super::in_fields(&super::accumulator_fields(read), word)
    };
    match words {
        ComponentWords::Flat => format!("{component} of the provoking vertex"),
        ComponentWords::Weighed(None) => format!("{component}: 1/w is 0"),
        ComponentWords::Weighed(Some([b1, b2])) => {
            format!("{component} at coordinates {b1} and {b2} of vertices 1 and 2")
        }
        ComponentWords::Affine(word) => {
            format!("{component} accumulator {}", fields(corrector.read_out(), word))
        }
        ComponentWords::Divided([over, inverse]) => {
            let Divided { p, q, reciprocal, value, .. } = corrector.division(over, inverse);
            let w = corrector.w_read_out().map_or_else(String::new, |read| fields(read, inverse));
            let unit = reciprocal.map_or_else(String::new, |unit| {
                format!(", reciprocal {} by 2^-{}", unit.mantissa, unit.exponent)
            });
            // Bits below the binary points of P, and of Q as a part of the largest 1/w.
            let below = corrector.read_out().fraction();
            let below_w = corrector.w_read_out().map_or(0, |read| read.integer() + read.fraction());
            format!(
                "{component}/w accumulator {}, 1/w accumulator {w}, {p} 2^-{below} over {q} 2^-{below_w}{unit}: {value}",
                fields(corrector.read_out(), over)
            )
        }
    }
}
