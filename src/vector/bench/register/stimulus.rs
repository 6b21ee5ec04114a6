//! The words that a machine is tested with: a host's, and others. Spec clause `X-6`.

mod legal;

use super::field::{Field, fields};
use super::host::Host;
use crate::case::triangle::{self, Stimulus as Cases};
use crate::case::{Class, Directed, Words, place};
use crate::machine::{ClipRegisters, Registers};
use crate::model::Model;
use crate::setup::Triangle;
use crate::vector::bench::{Group, Source, TestAt, cut};
use legal::{BROKEN, ILLEGAL};
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

/// Makes the words of a test of a class, by its number in the class.
type Make = fn(&RegisterStimulus, u64) -> Vec<u32>;

/// The classes after those of triangles, in the order of their tests.
const CLASSES: [(Class, Make); 8] = [
    (triangle::SCENE, RegisterStimulus::of_scene),
    (ENDS, RegisterStimulus::ends),
    (WINDOW, RegisterStimulus::window),
    (PAIRS, RegisterStimulus::pairs),
    (BITS, RegisterStimulus::bits),
    (WORDS, RegisterStimulus::no_host),
    (triangle::RANDOM, RegisterStimulus::changed),
    (ILLEGAL, RegisterStimulus::illegal),
];

/// Where the words of tests come from.
#[derive(Clone, Debug)]
pub(super) struct RegisterStimulus {
    host: Host,
    directed: Arc<Vec<Directed<Triangle>>>,
    scene: Arc<Vec<Triangle>>,
    fields: Arc<Vec<Field>>,
    /// The words that draw least of all that a host writes; and the same with all fields at zero that
    /// move no pixel.
    least: Arc<[Vec<u32>; 2]>,
    /// Legal words in the place of others.
    legal: Arc<Vec<u32>>,
    /// Sub-pixel bits, and the sample in its pixel.
    sub_pixel: u32,
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
        let profile = &source.profile;
        let cases = Cases::new(profile);
        let host = Host { model, registers: registers.clone() };
        let small = |triangle: &Triangle| {
            host.writes(triangle).is_some_and(|words| host.records(&words).is_whole())
        };
        let mut directed = cases.directed();
        for class in &mut directed {
            class.tests.retain(&small);
        }
        directed.retain(|class| !class.tests.is_empty());
        let written = directed.iter().flat_map(|class| &class.tests);
        let written = written.filter_map(|triangle| host.writes(triangle));
        let drawn = |words: &Vec<u32>| host.records(words).total;
        let written: Vec<Vec<u32>> = written.filter(|words| host.is_legal(words)).collect();
        let written = written.into_iter();
        let smallest = written.filter(|words| drawn(words) > 0).min_by_key(drawn);
        let smallest = smallest.unwrap_or_else(|| vec![0; registers.input.len()]);
        let mut fields = fields(&registers.input);
        let legal = Arc::new(smallest.clone());
        let least = [smallest.clone(), host.bare(&mut fields, smallest)];
        let rows = |triangle: &Triangle| {
            host.writes(triangle).map_or(1, |words| host.records(&words).total + 1)
        };
        directed.insert(0, Directed::core(&directed, rows));
        let scene: Vec<Triangle> = source.scene.iter().copied().filter(small).collect();
        let conditions = registers.legal.len() as u64;
        let groups = groups(&directed, scene.len() as u64, (&fields, conditions), source.count);
        let sample = profile.grid().map_or([0; 2], |grid| grid.offset);
        let stimulus = Self {
            directed: Arc::new(directed),
            scene: Arc::new(scene),
            fields: Arc::new(fields),
            least: Arc::new(least),
            legal,
            sub_pixel: profile.vertex.sub_pixel,
            sample: sample.map(|at| i64::try_from(at).unwrap_or(0)),
            cases,
            seed: source.seed,
            host,
        };
        (stimulus, groups)
    }

    /// The words of a test.
    pub(super) fn words(&self, at: TestAt) -> Vec<u32> {
        if let Some(class) = self.directed.get(at.group) {
            return self.lawful(self.host.words(&class.tests[place(at.index)]));
        }
        let (class, make) = CLASSES[at.group - self.directed.len()];
        let words = make(self, at.index);
        if class == ILLEGAL { words } else { self.lawful(words) }
    }

    /// A random stream of the register benches.
    fn draw(&self, stream: u64, index: u64) -> Words {
        Words::new(self.seed, STREAM + stream, index)
    }

    /// A host's words for the first of a few triangles that draws at all, else for the first of
    /// them: an empty one shows nothing of a register.
    fn random(&self, index: u64) -> Vec<u32> {
        let host = |n: u64| {
            let key = self.draw(0, index * TRIES + n);
            self.host.words(&self.cases.random(key, Some(REACH)))
        };
        let draws = |words: &Vec<u32>| self.host.records(words).total > 0;
        (0..TRIES).map(host).find(draws).unwrap_or_else(|| host(0))
    }

    /// A host's words that draw: those of a random triangle, or of one with a purpose.
    fn drawing(&self, index: u64) -> Vec<u32> {
        let tests: usize = self.directed.iter().map(|class| class.tests.len()).sum();
        let mut draw = self.draw(2, index);
        if draw.below(2) == 0 || tests == 0 {
            return self.random(index);
        }
        let mut all = self.directed.iter().flat_map(|class| &class.tests);
        let triangle = all.nth(place(draw.below(tests as u64)));
        let words = triangle.map(|triangle| self.host.words(triangle));
        let draws = |words: &Vec<u32>| self.host.records(words).total > 0;
        words.filter(draws).unwrap_or_else(|| self.random(index))
    }

    /// A pixel that words draw, or the first one.
    fn pixel(&self, words: &[u32], draw: &mut Words) -> [i64; 2] {
        let pixels = self.host.pixels(words);
        if pixels.is_empty() { [0; 2] } else { pixels[place(draw.below(pixels.len() as u64))] }
    }

    /// The words, unless they draw too much.
    fn bounded(&self, changed: Vec<u32>, otherwise: Vec<u32>) -> Vec<u32> {
        if self.host.records(&changed).is_whole() { changed } else { otherwise }
    }

    /// A host's words of the scene.
    fn of_scene(&self, index: u64) -> Vec<u32> {
        self.host.words(&self.scene[place(index) % self.scene.len()])
    }

    /// Each field at both ends of its range, with one bit set, and with one bit clear; then the same with switches
    /// at random: a field may do nothing until another one lets it.
    fn ends(&self, index: u64) -> Vec<u32> {
        let round = index / VALUES;
        let field = self.fields[place(round / 2)];
        let mut words = self.drawing(round / 2);
        let mut draw = self.draw(3, index);
        let (all, top) = (field.ones(), 1 << (field.width - 1));
        let one = 1 << draw.below(field.width.into());
        if !round.is_multiple_of(2) {
            for switch in self.fields.iter().filter(|other| other.width == 1) {
                words = switch.set(&words, low(draw.below(2)));
            }
        }
        let end = [0, all, top, all ^ top, one, all ^ one][place(index % VALUES)];
        self.bounded(field.set(&words, end), self.drawing(round / 2))
    }

    /// Each field at a place that the words draw.
    fn window(&self, index: u64) -> Vec<u32> {
        let (field, to) = (self.fields[place(index / PLACES)], place(index % PLACES));
        let words = self.drawing(index / 2);
        let pixel = self.pixel(&words, &mut self.draw(4, index))[to % 2];
        let at = match to / 2 {
            0 => pixel,
            1 => pixel << self.sub_pixel,
            _ => (pixel << self.sub_pixel) + self.sample[to % 2],
        };
        self.bounded(field.set(&words, low(at.cast_unsigned())), words)
    }

    /// Each field at a distance from another one; in half of the tests what is left of their kind lies
    /// between the two, on either side of zero.
    fn pairs(&self, index: u64) -> Vec<u32> {
        let (field, round) = (self.fields[place(index / DISTANCES)], index % DISTANCES / VALUES);
        let words = self.drawing(index / VALUES);
        let like =
            |akin: bool| self.fields.iter().filter(move |other| field.is_like(**other, akin));
        let others: Vec<&Field> = like(round > 0).collect();
        if others.is_empty() {
            return words;
        }
        let other = *others[place(self.draw(5, index).below(others.len() as u64))];
        let half = 1u32 << (field.width - 1);
        let distances = [0, 1, u32::MAX, half, half.wrapping_sub(1), 1u32.wrapping_sub(half)];
        let (from, distance) = (other.of(&words), distances[place(index % VALUES)]);
        let middle = match round {
            0 | 1 => None,
            2 => Some(from.wrapping_add(distance >> 1)),
            _ => Some(from.wrapping_sub(distance >> 1)),
        };
        let mut changed = field.set(&words, from.wrapping_add(distance));
        if let Some(middle) = middle {
            for third in like(true).filter(|third| **third != other) {
                changed = third.set(&changed, middle);
            }
        }
        self.bounded(changed, words)
    }

    /// Each bit of each field alone, in the words that draw least.
    fn bits(&self, index: u64) -> Vec<u32> {
        let words = self.least[place(index % 2)].clone();
        let bits = |field: &Field| (0..field.width).map(|bit| (*field, bit)).collect::<Vec<_>>();
        let mut bits = self.fields.iter().flat_map(bits);
        let alone = bits.nth(place(index / 2)).map(|(field, bit)| field.set(&words, 1 << bit));
        alone.map_or_else(|| words.clone(), |alone| self.bounded(alone, words.clone()))
    }

    /// Words at random, and a small clip rectangle, so that they draw something and not too much. In every
    /// second test the pixels stay, and only what is drawn in them is at random.
    fn no_host(&self, index: u64) -> Vec<u32> {
        let stays = !index.is_multiple_of(2);
        let made = (0..TRIES).map(|attempt| {
            let mut draw = self.draw(6, index * TRIES + attempt);
            let mut words = self.drawing(index);
            for field in self.fields.iter() {
                if draw.below(2) == 0 && !(stays && field.moves) {
                    let value = low(draw.below(1 << 32)) >> draw.below(field.width.into());
                    words = field.set(&words, value);
                }
            }
            self.clip(&mut words, stays, &mut draw);
            words
        });
        let mut fits = made.filter(|words| {
            let records = self.host.records(words);
            records.is_whole() && (records.total > 0 || stays)
        });
        fits.next().unwrap_or_else(|| self.drawing(index))
    }

    /// Sets a small clip rectangle; `near` a pixel that is drawn, an empty one among others.
    fn clip(&self, words: &mut [u32], near: bool, draw: &mut Words) {
        let Some(ClipRegisters { ends, sub_pixels, on }) = &self.host.registers.clip else {
            return;
        };
        if let Some(on) = on {
            // Without its clip rectangle a machine draws too much.
            on.scatter(1, words);
        }
        let below = if *sub_pixels { self.sub_pixel } else { 0 };
        let integer = self.host.model.profile().vertex.integer;
        let pixel = self.pixel(words, draw);
        for axis in 0..2 {
            let (first, size) = if near {
                let first = (pixel[axis].cast_unsigned() << below).wrapping_sub(draw.below(4));
                (first, draw.below(8))
            } else {
                let bits = ends[axis].bits().min(integer + below);
                (draw.below(1 << bits), draw.below(32 << below))
            };
            ends[axis].scatter(first.into(), words);
            ends[axis + 2].scatter(first.wrapping_add(size).into(), words);
        }
    }

    /// A host's words with a few registers at random, so that nothing holds by construction.
    fn changed(&self, index: u64) -> Vec<u32> {
        let words = self.drawing(index);
        let mut changed = words.clone();
        let mut draw = self.draw(1, index);
        for _ in 0..draw.below(4) {
            let register = place(draw.below(words.len() as u64));
            changed[register] = match draw.below(4) {
                0 => 1 << draw.below(32),
                1 => low(self.pixel(&words, &mut draw)[register % 2].cast_unsigned()),
                _ => low(draw.below(1 << 32)) >> draw.below(32),
            };
        }
        self.bounded(changed, words)
    }
}

/// The low 32 bits.
fn low(value: u64) -> u32 {
    let [a, b, c, d, ..] = value.to_le_bytes();
    u32::from_le_bytes([a, b, c, d])
}

fn groups(
    directed: &[Directed<Triangle>],
    scene: u64,
    (fields, conditions): (&[Field], u64),
    count: u64,
) -> Vec<Group> {
    let (share, each) = (count / ROWS_PER_TEST, fields.len() as u64);
    let bits: u64 = fields.iter().map(|field| u64::from(field.width)).sum();
    let tests = [
        share.min(scene),
        2 * VALUES * each,
        PLACES * each,
        DISTANCES * each,
        2 * bits,
        2 * share,
        share,
        BROKEN * conditions,
    ];
    // Where everything is legal there is no class of the rest.
    let classes = CLASSES.into_iter().filter(|(class, _)| conditions > 0 || *class != ILLEGAL);
    let own = classes.zip(tests).map(|((class, _), tests)| Group { class, tests });
    let of_triangles =
        directed.iter().map(|class| Group { class: class.class, tests: class.tests.len() as u64 });
    let mut groups: Vec<Group> = of_triangles.chain(own).collect();
    cut(&mut groups, count);
    groups
}
