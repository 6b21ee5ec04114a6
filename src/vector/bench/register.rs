//! The bench of a machine that begins at registers: words in, records out. Spec clause `N-2`.

mod field;
mod host;
mod stimulus;

use super::rig::NoFiles;
use super::word::place_columns;
use super::{
    Bench, Coverage, FileSpec, Goal, Group, RegisterAnswers, Rig, Run, Shape, Source, TestAt,
    TestBench,
};
use crate::format::Column;
use crate::machine::{Registers, columns};
use crate::model::Model;
use crate::profile::Profile;
use crate::vector::device::{Recorder, Stimulus};
use crate::vector::table::{RowFormat, Table};
use std::sync::Arc;
use stimulus::RegisterStimulus;

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
    stimulus: RegisterStimulus,
    cfg: FileSpec,
    answers: RegisterAnswers<FileSpec>,
    groups: Vec<Group>,
}

impl RegisterBench {
    /// The bench, if the profile begins at registers.
    pub fn new(source: &Source) -> Option<Self> {
        let model = Arc::new(Model::new(&source.profile).ok()?);
        let registers = model.registers()?.clone();
        let (stimulus, groups) = RegisterStimulus::new(source, Arc::clone(&model), &registers);
        let (cfg, answers) = files(&registers);
        Some(Self { model, registers, stimulus, cfg, answers, groups })
    }

    /// The reference at this bench, or a device that differs from it in its model alone.
    pub(in crate::vector) fn recorder(&self, model: Arc<Model>) -> Recorder {
        Recorder { model, registers: self.registers.clone() }
    }

    /// The profile of the set.
    pub fn profile(&self) -> &Profile {
        self.model.profile()
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
        RegisterTest { test: at.test, words: self.stimulus.words(at) }
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
        let words = self.stimulus.words(at).into_iter();
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
