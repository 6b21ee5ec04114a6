//! The bench of a machine that begins at registers: words in, records out. Spec clause `N-2`.

use super::rig::NoFiles;
use super::word::place_columns;
use super::{
    Bench, Coverage, FileSpec, Goal, Group, RegisterAnswers, Rig, Run, Shape, Source, TestAt,
    TestBench, cut,
};
use crate::case::triangle::{self, Stimulus as Cases};
use crate::case::{Class, Directed, Words, place};
use crate::format::Column;
use crate::machine::{Registers, columns};
use crate::model::Model;
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::device::{Recorder, Stimulus, records};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;

/// Rows asked for in a walk file per random or scene test.
const ROWS_PER_TEST: u64 = 256;
/// Extent of a random triangle, in pixels.
const REACH: i128 = 16;
/// Triangles looked at for one that draws.
const TRIES: u64 = 6;
/// Key of the random stream.
const STREAM: u64 = 9;

/// A host's words with single fields at the ends of their range.
const ENDS: Class = Class {
    tag: "register-ends",
    catches: "a register cut short, a sign not extended, a slope or start that wraps otherwise",
};

/// What a machine is given.
#[derive(Clone, Debug)]
pub struct RegisterTest {
    /// Number of the test, the key of every row.
    pub test: u64,
    /// Its registers.
    pub words: Vec<u32>,
}

impl RegisterTest {
    /// The most records of a test: one with more is left out, or falls back on what a host would
    /// write.
    pub const LARGEST: u64 = 1024;
}

impl Stimulus for RegisterTest {
    type Rows = RegisterAnswers<Table>;
}

/// Tests of registers.
#[derive(Clone, Debug)]
pub struct RegisterBench {
    model: Arc<Model>,
    registers: Registers,
    directed: Arc<Vec<Directed<Triangle>>>,
    scene: Arc<Vec<Triangle>>,
    /// Word, lowest bit and bits of each field.
    fields: Arc<Vec<(usize, u32, u32)>>,
    stimulus: Cases,
    seed: u64,
    cfg: FileSpec,
    answers: RegisterAnswers<FileSpec>,
    groups: Vec<Group>,
}

impl RegisterBench {
    /// The bench, if the profile begins at registers.
    pub fn new(source: &Source) -> Option<Self> {
        let model = Arc::new(Model::new(&source.profile).ok()?);
        let registers = model.registers()?.clone();
        let stimulus = Cases::new(&source.profile);
        let small = |triangle: &Triangle| {
            let words = model.host(triangle);
            words
                .first()
                .is_some_and(|words| records(&model, words, RegisterTest::LARGEST).is_whole())
        };
        let mut directed = stimulus.directed();
        for class in &mut directed {
            class.tests.retain(&small);
        }
        directed.retain(|class| !class.tests.is_empty());
        let rows = |triangle: &Triangle| {
            let words = model.host(triangle);
            words.first().map_or(1, |w| records(&model, w, RegisterTest::LARGEST).total + 1)
        };
        directed.insert(0, Directed::core(&directed, rows));
        let scene: Vec<Triangle> = source.scene.iter().copied().filter(small).collect();
        let share = source.count / ROWS_PER_TEST;
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.tests.len() as u64 })
            .collect();
        let input = &registers.input;
        let fields: Vec<_> = (0..input.len())
            .flat_map(|word| input.fields(word).iter().map(move |f| (word, f.at, f.width)))
            .collect();
        let each = 4 * fields.len() as u64;
        groups.push(Group { class: triangle::SCENE, tests: share.min(scene.len() as u64) });
        groups.push(Group { class: ENDS, tests: each });
        groups.push(Group { class: triangle::RANDOM, tests: share });
        cut(&mut groups, source.count);
        let (cfg, answers) = files(&registers);
        let (directed, scene, fields) = (Arc::new(directed), Arc::new(scene), Arc::new(fields));
        let seed = source.seed;
        Some(Self {
            model,
            registers,
            directed,
            scene,
            fields,
            stimulus,
            seed,
            cfg,
            answers,
            groups,
        })
    }

    /// The reference at this bench, or a device that differs from it in its model alone.
    pub(in crate::vector) fn recorder(&self, model: Arc<Model>) -> Recorder {
        Recorder { model, registers: self.registers.clone() }
    }

    /// The profile of the set.
    pub fn profile(&self) -> &Profile {
        self.model.profile()
    }

    /// Whether words draw anything.
    fn draws(&self, words: &[u32]) -> bool {
        records(&self.model, words, RegisterTest::LARGEST).total > 0
    }

    /// What a host writes for a triangle, the first list of it; zeros where it writes nothing.
    fn host(&self, triangle: &Triangle) -> Vec<u32> {
        let first = self.model.host(triangle).into_iter().next();
        first.unwrap_or_else(|| vec![0; self.registers.input.len()])
    }

    /// A host's words for the first of a few triangles that draws at all, else for the first of
    /// them: an empty one shows nothing of a register.
    fn random(&self, index: u64) -> Vec<u32> {
        let host = |n: u64| {
            let key = Words::new(self.seed, STREAM, index * TRIES + n);
            self.host(&self.stimulus.random(key, Some(REACH)))
        };
        (0..TRIES).map(host).find(|words| self.draws(words)).unwrap_or_else(|| host(0))
    }

    /// The words of a test.
    fn words(&self, at: TestAt) -> Vec<u32> {
        let index = place(at.index);
        if let Some(class) = self.directed.get(at.group) {
            return self.host(&class.tests[index]);
        }
        match at.group - self.directed.len() {
            0 => self.host(&self.scene[index % self.scene.len()]),
            1 => {
                let words = self.random(at.index / 4);
                let mut changed = words.clone();
                let (place, lowest, width) = self.fields[index / 4 % self.fields.len()];
                let (all, top) = (u32::MAX >> (32 - width), 1 << (width - 1));
                let end = [0, all, top, all ^ top][index % 4];
                changed[place] = changed[place] & !(all << lowest) | end << lowest;
                self.bounded(changed, words)
            }
            _ => {
                // A few registers of a host's at random, so that nothing holds by construction.
                let words = self.random(at.index);
                let mut changed = words.clone();
                let mut draw = Words::new(self.seed, STREAM + 1, at.index);
                for _ in 0..draw.below(4) {
                    let register = place(draw.below(words.len() as u64));
                    let bits = draw.below(1 << 32);
                    let bits = u32::try_from(bits)
                        .unwrap_or_else(|_| unreachable!("{bits} < 2^32: it was bounded"));
                    changed[register] = bits >> draw.below(32);
                }
                self.bounded(changed, words)
            }
        }
    }

    /// The words, unless they draw too much.
    fn bounded(&self, changed: Vec<u32>, otherwise: Vec<u32>) -> Vec<u32> {
        let drawn = records(&self.model, &changed, RegisterTest::LARGEST);
        if drawn.is_whole() { changed } else { otherwise }
    }
}

fn files(registers: &Registers) -> (FileSpec, RegisterAnswers<FileSpec>) {
    let spec = |stem: String, columns: Vec<Column>| {
        // A test writes several records of a kind: their order tells them.
        FileSpec::ordered(stem, [place_columns(&[]), columns].concat())
    };
    let records = registers.records.iter().map(|record| {
        let stem = format!("words-{}.exp", record.letter.to_ascii_lowercase());
        spec(stem, columns(&record.layout))
    });
    let answers = RegisterAnswers { records: records.collect() };
    (spec("words.cfg".to_owned(), columns(&registers.input)), answers)
}

impl TestBench for RegisterBench {
    type Test = RegisterTest;

    fn test(&self, at: TestAt, _: u64) -> RegisterTest {
        RegisterTest { test: at.test, words: self.words(at) }
    }

    fn words(&self, test: &RegisterTest) -> Vec<i128> {
        std::iter::once(i128::from(test.test))
            .chain(test.words.iter().copied().map(i128::from))
            .collect()
    }

    fn tables(&self, format: RowFormat) -> (Table, RegisterAnswers<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.answers.map(table))
    }
}

impl Bench for RegisterBench {
    fn name(&self) -> &'static str {
        "words"
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
        Box::new(Rig::new(self, Box::new(self.recorder(Arc::clone(&self.model))), format))
    }

    fn shape(&self) -> Shape {
        Shape::NONE
    }

    fn goals(&self) -> Vec<Goal> {
        super::rig::RECORDS.map(Goal::new).to_vec()
    }

    fn describe(&self, at: TestAt) -> String {
        let words = self.words(at).into_iter();
        let text: Vec<String> = words.map(|word| format!("{word:x}")).collect();
        format!("registers {}", text.join(" "))
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        let layouts = self
            .registers
            .records
            .iter()
            .map(|record| &record.layout)
            .chain([&self.registers.input]);
        for layout in layouts {
            let Some(word) = layout.word_names().iter().position(|name| name == column) else {
                continue;
            };
            let mut fields = Vec::new();
            let mut top = crate::format::WORD;
            for field in layout.fields(word).iter().rev() {
                fields.push(("-".to_owned(), top - field.at - field.width));
                fields.push((field.name.clone(), field.width));
                top = field.at;
            }
            fields.push(("-".to_owned(), top));
            fields.retain(|(_, bits)| *bits > 0);
            return if fields.len() > 1 { fields } else { Vec::new() };
        }
        Vec::new()
    }
}
