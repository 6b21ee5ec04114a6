//! The bench of a machine that begins at registers: words in, records out. Spec clause `N-2`.

use super::{Bench, Coverage, FileSpec, Group, Shape, Source, TestAt, cut};
use crate::case::triangle::{self, Directed, Stimulus};
use crate::case::{Class, Words};
use crate::format::Column;
use crate::machine::{Registers, columns};
use crate::model::{Model, Records};
use crate::profile::neighbours;
use crate::setup::Triangle;
use crate::vector::table::Table;
use std::sync::Arc;

/// Rows asked for in a walk file per random or scene test.
const ROWS_PER_TEST: u64 = 256;
/// The most records of a test: one with more is left out, or falls back on what a host would write.
const LARGEST: u64 = 1024;
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

/// Tests of registers.
#[derive(Clone, Debug)]
pub struct RegisterBench {
    model: Arc<Model>,
    /// What the host's words are made by: a device that differs still gets the profile's.
    host: Arc<Model>,
    registers: Registers,
    directed: Arc<Vec<Directed>>,
    scene: Arc<Vec<Triangle>>,
    /// Word, lowest bit and bits of each field.
    fields: Arc<Vec<(usize, u32, u32)>>,
    stimulus: Stimulus,
    seed: u64,
    files: Vec<FileSpec>,
    groups: Vec<Group>,
}

impl RegisterBench {
    /// The bench, if the profile begins at registers.
    pub fn new(source: &Source) -> Option<Self> {
        let model = Arc::new(Model::new(&source.profile).ok()?);
        let registers = model.registers()?.clone();
        let stimulus = Stimulus::new(&source.profile);
        let small = |triangle: &Triangle| {
            let words = model.host(triangle);
            words.first().is_some_and(|words| records(&model, words).is_whole())
        };
        let mut directed = stimulus.directed();
        for class in &mut directed {
            class.triangles.retain(&small);
        }
        directed.retain(|class| !class.triangles.is_empty());
        let scene: Vec<Triangle> = source.scene.iter().copied().filter(small).collect();
        let share = source.count / ROWS_PER_TEST;
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.triangles.len() as u64 })
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
        let files = files(&registers);
        let (directed, scene) = (Arc::new(directed), Arc::new(scene));
        let (host, fields) = (Arc::clone(&model), Arc::new(fields));
        let seed = source.seed;
        Some(Self {
            model,
            host,
            registers,
            directed,
            scene,
            fields,
            stimulus,
            seed,
            files,
            groups,
        })
    }

    /// The words of a test.
    fn words(&self, at: TestAt) -> Vec<u32> {
        let index = usize::try_from(at.index).unwrap_or(0);
        let host = |triangle: &Triangle| {
            let mut lists = self.host.host(triangle);
            let none = || vec![0; self.registers.input.len()];
            if lists.is_empty() { none() } else { lists.swap_remove(0) }
        };
        if let Some(class) = self.directed.get(at.group) {
            return host(&class.triangles[index]);
        }
        // The first of a few triangles that draws at all: an empty one shows nothing of a register.
        let random = |index: u64| {
            let mut lists = (0..TRIES).map(|n| {
                let key = Words::new(self.seed, STREAM, index * TRIES + n);
                host(&self.stimulus.random(key, Some(REACH)))
            });
            let first = lists.next().unwrap_or_default();
            if !records(&self.host, &first).kept.is_empty() {
                return first;
            }
            lists.find(|words| !records(&self.host, words).kept.is_empty()).unwrap_or(first)
        };
        match at.group - self.directed.len() {
            0 => host(&self.scene[index % self.scene.len().max(1)]),
            1 => {
                let words = random(at.index / 4);
                let mut changed = words.clone();
                let (place, lowest, width) = self.fields[index / 4 % self.fields.len()];
                let (all, top) = (u32::MAX >> (32 - width), 1 << (width - 1));
                let end = [0, all, top, all ^ top][index % 4];
                changed[place] = changed[place] & !(all << lowest) | end << lowest;
                self.bounded(changed, words)
            }
            _ => {
                // A few registers of a host's at random, so that nothing holds by construction.
                let words = random(at.index);
                let mut changed = words.clone();
                let mut draw = Words::new(self.seed, STREAM + 1, at.index);
                for _ in 0..draw.below(4) {
                    let place = usize::try_from(draw.below(words.len() as u64)).unwrap_or(0);
                    let bits = u32::try_from(draw.below(1 << 32)).unwrap_or(0);
                    changed[place] = bits >> draw.below(32);
                }
                self.bounded(changed, words)
            }
        }
    }

    /// The words, unless they draw too much.
    fn bounded(&self, changed: Vec<u32>, otherwise: Vec<u32>) -> Vec<u32> {
        if records(&self.host, &changed).is_whole() { changed } else { otherwise }
    }
}

/// What words draw.
fn records(model: &Model, words: &[u32]) -> Records {
    let mut records = Records::up_to(LARGEST);
    // The number of words is the profile's own.
    let _ = model.draw(words, &mut records);
    records
}

fn files(registers: &Registers) -> Vec<FileSpec> {
    let test = || Column::new("test", 32, false, 0, "Number of the test, from 0.");
    let spec = |stem: String, columns: Vec<Column>| {
        let columns = std::iter::once(test()).chain(columns).collect();
        FileSpec { stem, columns }
    };
    let mut files = vec![spec("words.cfg".to_owned(), columns(&registers.input))];
    files.extend(registers.records.iter().map(|record| {
        let stem = format!("words-{}.exp", record.letter.to_ascii_lowercase());
        spec(stem, columns(&record.layout))
    }));
    files
}

impl Bench for RegisterBench {
    fn name(&self) -> &'static str {
        "words"
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
        let [cfg, exps @ ..] = tables else { return };
        let words = self.words(at);
        let row = |words: &mut dyn Iterator<Item = u32>| -> Vec<i128> {
            std::iter::once(i128::from(at.test)).chain(words.map(i128::from)).collect()
        };
        cfg.push(&row(&mut words.iter().copied()));
        for (kind, values) in records(&self.model, &words).kept {
            let record = &self.registers.records[kind];
            exps[kind].push(&row(&mut record.words(&values)));
        }
    }

    fn shape(&self) -> Shape {
        Shape { zones: [false; 3], remainders: [false; 4] }
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

    fn variants(&self) -> Vec<(String, Box<dyn Bench>)> {
        let bench = |neighbour: crate::profile::Neighbour| {
            let model = Arc::new(Model::new(&neighbour.profile).ok()?);
            let bench: Box<dyn Bench> = Box::new(Self { model, ..self.clone() });
            Some((neighbour.change, bench))
        };
        neighbours(self.model.profile()).into_iter().filter_map(bench).collect()
    }
}
