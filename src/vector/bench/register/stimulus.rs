//! The words that a machine is tested with: a host's, and others.

use super::RegisterTest;
use super::field::{Field, bare, fields, low, set};
use crate::case::triangle::{self, Stimulus as Cases};
use crate::case::{Class, Directed, Words, place};
use crate::format::{Gather, WORD};
use crate::machine::Registers;
use crate::model::{Model, Records};
use crate::setup::Triangle;
use crate::vector::bench::{Group, Source, TestAt, cut};
use crate::vector::device::records;
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

/// A host's words with single fields at what was drawn: ends of a clip rectangle among them.
const WINDOW: Class = Class {
    tag: "register-window",
    catches: "pixels that a clip rectangle leaves out and that count, an end of it one pixel off",
};
/// Words that no host writes, and a small clip rectangle.
const WORDS: Class = Class {
    tag: "register-words",
    catches: "values that wrap along a row, a rectangle inside a triangle, a bound that only a host keeps",
};
/// A field that another one's value and a distance give.
const PAIRS: Class = Class {
    tag: "register-pairs",
    catches: "a difference of registers one bit short, a limit of it that is one off",
};
/// One bit of a field alone.
const BITS: Class = Class {
    tag: "register-bits",
    catches: "a bit of a register that is not wired, or that is wired to another place",
};
/// Values that a field is given in turn.
const VALUES: u64 = 6;
/// Distances that a field has from others in turn: once from any, three times from one of its initial.
const DISTANCES: u64 = 4 * VALUES;
/// Places that a field is set to in turn: x and y in pixels, in sub-pixels, and there at the sample.
const PLACES: u64 = 6;

/// Names that ends of a clip rectangle have: left, top, right, bottom.
const RECTANGLES: [[&str; 4]; 4] = [
    ["left", "top", "right", "bottom"],
    ["clip_left", "clip_top", "clip_right", "clip_bottom"],
    ["scissor_xh", "scissor_yh", "scissor_xl", "scissor_yl"],
    ["x_min", "y_min", "x_max", "y_max"],
];

/// Where the words of tests come from.
#[derive(Clone, Debug)]
pub(super) struct RegisterStimulus {
    model: Arc<Model>,
    registers: Registers,
    directed: Arc<Vec<Directed<Triangle>>>,
    scene: Arc<Vec<Triangle>>,
    fields: Arc<Vec<Field>>,
    rectangle: Option<[Gather; 4]>,
    /// The words that draw least of all that a host writes; and the same with all fields at zero that
    /// move no pixel.
    least: Arc<[Vec<u32>; 2]>,
    /// The sample in its pixel, in sub-pixels.
    sample: [i64; 2],
    cases: Cases,
    seed: u64,
}

impl RegisterStimulus {
    /// The words' source, and the classes of its tests.
    pub(super) fn new(
        source: &Source,
        model: Arc<Model>,
        registers: &Registers,
    ) -> (Self, Vec<Group>) {
        let cases = Cases::new(&source.profile);
        let small = |triangle: &Triangle| {
            let words = model.host(triangle);
            words
                .first()
                .is_some_and(|words| records(&model, words, RegisterTest::LARGEST).is_whole())
        };
        let mut directed = cases.directed();
        for class in &mut directed {
            class.tests.retain(&small);
        }
        directed.retain(|class| !class.tests.is_empty());
        let rows = |triangle: &Triangle| {
            let words = model.host(triangle);
            words.first().map_or(1, |w| records(&model, w, RegisterTest::LARGEST).total + 1)
        };
        let input = &registers.input;
        let mut fields = fields(input);
        let all = directed.iter().flat_map(|class| &class.tests);
        let all = all.filter_map(|triangle| model.host(triangle).into_iter().next());
        let drawn = |words: &Vec<u32>| records(&model, words, RegisterTest::LARGEST).total;
        let smallest = all.filter(|words| drawn(words) > 0).min_by_key(drawn);
        let smallest = smallest.unwrap_or_else(|| vec![0; registers.input.len()]);
        let least = Arc::new([smallest.clone(), bare(&model, registers, &mut fields, smallest)]);
        directed.insert(0, Directed::core(&directed, rows));
        let scene: Vec<Triangle> = source.scene.iter().copied().filter(small).collect();
        let groups = groups(&directed, scene.len() as u64, &fields, source.count);
        let rectangle = RECTANGLES.iter().find_map(|names| {
            let ends: Vec<Gather> = names.iter().filter_map(|name| input.find(name)).collect();
            <[Gather; 4]>::try_from(ends).ok()
        });
        let sample = source.profile.grid().map_or([0; 2], |grid| grid.offset);
        let stimulus = Self {
            registers: registers.clone(),
            directed: Arc::new(directed),
            scene: Arc::new(scene),
            fields: Arc::new(fields),
            rectangle,
            least,
            sample: sample.map(|at| i64::try_from(at).unwrap_or(0)),
            cases,
            seed: source.seed,
            model,
        };
        (stimulus, groups)
    }

    fn records(&self, words: &[u32]) -> Records {
        records(&self.model, words, RegisterTest::LARGEST)
    }

    /// Whether words draw anything.
    fn draws(&self, words: &[u32]) -> bool {
        self.records(words).total > 0
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
            self.host(&self.cases.random(key, Some(REACH)))
        };
        (0..TRIES).map(host).find(|words| self.draws(words)).unwrap_or_else(|| host(0))
    }

    /// A host's words that draw: those of a random triangle, or of one with a purpose.
    fn drawing(&self, index: u64) -> Vec<u32> {
        let tests: usize = self.directed.iter().map(|class| class.tests.len()).sum();
        let mut draw = Words::new(self.seed, STREAM + 2, index);
        if draw.below(2) == 0 || tests == 0 {
            return self.random(index);
        }
        let mut all = self.directed.iter().flat_map(|class| &class.tests);
        let triangle = all.nth(place(draw.below(tests as u64)));
        let words = triangle.map(|triangle| self.host(triangle));
        words.filter(|words| self.draws(words)).unwrap_or_else(|| self.random(index))
    }

    /// A pixel that words draw, or the first one.
    fn pixel(&self, words: &[u32], draw: &mut Words) -> [i64; 2] {
        let kept = self.records(words).kept;
        let pixels: Vec<[i64; 2]> = kept
            .iter()
            .flat_map(|(kind, values)| self.registers.records[*kind].pixels(values))
            .collect();
        if pixels.is_empty() { [0; 2] } else { pixels[place(draw.below(pixels.len() as u64))] }
    }

    /// The words with one field set to a value.
    fn with(&self, mut words: Vec<u32>, field: usize, value: u32) -> Vec<u32> {
        set(&mut words, self.fields[field], value);
        words
    }

    /// The words of a test.
    pub(super) fn words(&self, at: TestAt) -> Vec<u32> {
        let index = place(at.index);
        if let Some(class) = self.directed.get(at.group) {
            return self.host(&class.tests[index]);
        }
        let key = |stream: u64| Words::new(self.seed, STREAM + stream, at.index);
        let bits = |draw: &mut Words| low(draw.below(1 << 32));
        match at.group - self.directed.len() {
            0 => self.host(&self.scene[index % self.scene.len()]),
            1 => {
                let (field, value) = (index / place(VALUES), at.index % VALUES);
                let words = self.drawing(at.index / VALUES);
                let width = self.fields[field].width;
                let (all, top) = (u32::MAX >> (WORD - width), 1 << (width - 1));
                let one = 1 << key(3).below(width.into());
                let end = [0, all, top, all ^ top, one, all ^ one][place(value)];
                self.bounded(self.with(words.clone(), field, end), words)
            }
            2 => {
                let (field, to) = (index / place(PLACES), place(at.index % PLACES));
                let words = self.drawing(at.index / 2);
                let pixel = self.pixel(&words, &mut key(4))[to % 2];
                let shift = if to < 2 { 0 } else { self.model.profile().vertex.sub_pixel };
                let pixel = (pixel << shift) + if to < 4 { 0 } else { self.sample[to % 2] };
                self.bounded(
                    self.with(words.clone(), field, low(pixel.cast_unsigned()) << shift),
                    words,
                )
            }
            3 => {
                let (field, apart) = (index / place(DISTANCES), place(at.index % VALUES));
                let words = self.drawing(at.index / VALUES);
                let Field { width, initial, .. } = self.fields[field];
                let alike = |akin: bool| {
                    self.fields.iter().enumerate().filter(move |&(n, other)| {
                        n != field && other.width == width && (!akin || other.initial == initial)
                    })
                };
                let mut others = alike(at.index % DISTANCES >= VALUES);
                let count = others.clone().count() as u64;
                let Some((_, other)) = others.nth(place(key(5).below(count.max(1)))) else {
                    return words;
                };
                let half = 1u32 << (width - 1);
                let distance =
                    [0, 1, u32::MAX, half, half.wrapping_sub(1), 1u32.wrapping_sub(half)];
                let from = words[other.word] >> other.lowest;
                let mut changed =
                    self.with(words.clone(), field, from.wrapping_add(distance[apart]));
                // What is left of their kind lies between the two, on either side of zero.
                let middle = match at.index % DISTANCES / VALUES {
                    0 | 1 => None,
                    2 => Some(from.wrapping_add(distance[apart] >> 1)),
                    _ => Some(from.wrapping_sub(distance[apart] >> 1)),
                };
                if let Some(middle) = middle {
                    for (_, third) in alike(true).filter(|(_, third)| third.word != other.word) {
                        set(&mut changed, *third, middle);
                    }
                }
                self.bounded(changed, words)
            }
            4 => {
                let mut bit = u32::try_from(at.index / 2).unwrap_or(0);
                let field = self.fields.iter().position(|field| {
                    let here = bit < field.width;
                    bit -= if here { 0 } else { field.width };
                    here
                });
                let words = self.least[place(at.index % 2)].clone();
                self.bounded(self.with(words.clone(), field.unwrap_or(0), 1 << bit), words)
            }
            5 => self.no_host(at.index),
            _ => {
                // A few registers of a host's at random, so that nothing holds by construction.
                let words = self.drawing(at.index);
                let mut changed = words.clone();
                let mut draw = key(1);
                for _ in 0..draw.below(4) {
                    let register = place(draw.below(words.len() as u64));
                    changed[register] = match draw.below(4) {
                        0 => 1 << draw.below(32),
                        1 => low(self.pixel(&words, &mut draw)[register % 2].cast_unsigned()),
                        _ => bits(&mut draw) >> draw.below(32),
                    };
                }
                self.bounded(changed, words)
            }
        }
    }

    /// Words at random, and a small clip rectangle, so that they draw something and not too much. In every
    /// second test the pixels stay, and only what is drawn in them is at random.
    fn no_host(&self, index: u64) -> Vec<u32> {
        let made = (0..TRIES).map(|attempt| {
            let mut draw = Words::new(self.seed, STREAM + 6, index * TRIES + attempt);
            let mut words = self.drawing(index);
            for field in 0..self.fields.len() {
                let Field { width, clips, moves, .. } = self.fields[field];
                if clips {
                    // Without its clip rectangle a machine draws too much.
                    words = self.with(words, field, 1);
                } else if draw.below(2) == 0 && (index.is_multiple_of(2) || !moves) {
                    let value = low(draw.below(1 << 32)) >> draw.below(width.into());
                    words = self.with(words, field, value);
                }
            }
            let vertex = &self.model.profile().vertex;
            // In pixels or in sub-pixels, as the machine has it.
            let below = if draw.below(2) == 0 { 0 } else { vertex.sub_pixel };
            let pixel = self.pixel(&words, &mut draw);
            for axis in 0..2 {
                let Some(ends) = &self.rectangle else { continue };
                let (first, size) = if index.is_multiple_of(2) {
                    let bits = ends[axis].bits().min(vertex.integer + below);
                    (draw.below(1 << bits), draw.below(32 << below))
                } else {
                    // At a pixel that is drawn; an empty rectangle among others.
                    let first = (pixel[axis].cast_unsigned() << below).wrapping_sub(draw.below(4));
                    (first, draw.below(8))
                };
                ends[axis].scatter(first.into(), &mut words);
                ends[axis + 2].scatter(first.wrapping_add(size).into(), &mut words);
            }
            words
        });
        let mut fits = made.filter(|words| {
            let records = self.records(words);
            records.is_whole() && (records.total > 0 || !index.is_multiple_of(2))
        });
        fits.next().unwrap_or_else(|| self.drawing(index))
    }

    /// The words, unless they draw too much.
    fn bounded(&self, changed: Vec<u32>, otherwise: Vec<u32>) -> Vec<u32> {
        if self.records(&changed).is_whole() { changed } else { otherwise }
    }
}

fn groups(directed: &[Directed<Triangle>], scene: u64, fields: &[Field], count: u64) -> Vec<Group> {
    let share = count / ROWS_PER_TEST;
    let mut groups: Vec<Group> = directed
        .iter()
        .map(|class| Group { class: class.class, tests: class.tests.len() as u64 })
        .collect();
    groups.push(Group { class: triangle::SCENE, tests: share.min(scene) });
    groups.push(Group { class: ENDS, tests: VALUES * fields.len() as u64 });
    groups.push(Group { class: WINDOW, tests: PLACES * fields.len() as u64 });
    groups.push(Group { class: PAIRS, tests: DISTANCES * fields.len() as u64 });
    groups.push(Group {
        class: BITS,
        tests: fields.iter().map(|field| 2 * u64::from(field.width)).sum(),
    });
    groups.push(Group { class: WORDS, tests: 2 * share });
    groups.push(Group { class: triangle::RANDOM, tests: share });
    cut(&mut groups, count);
    groups
}
