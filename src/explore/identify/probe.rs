//! What to draw next: the triangle that splits what is left best. Spec clause `ID-6`.

use super::agree::{flat, prepared};
use super::deep::Deep;
use super::narrow::Boxed;
use super::{Identifier, Left, Picture};
use crate::case::Words;
use crate::cover::{EdgeWordConfig, SampleConfig};
use crate::model::Model;
use crate::scene::{Primitive, Triangle};
use crate::value::DepthConfig;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Rasterizers that candidates are tried on; of more, an even sample.
const SAMPLE: usize = 256;
/// Candidates a round, and rounds before it is said that nothing splits what is left.
const CANDIDATES: u64 = 48;
const ROUNDS: u64 = 4;
/// Machines among which depth is asked about.
const ALIKE: usize = 16;
/// Machines times candidates of the last round.
const MANY: u64 = 16_000;
/// Pixels whose depth is looked at in a candidate, and those that are named.
const TELLING: usize = 48;
const PIXELS: usize = 8;
/// The stream of candidates among those of the case room.
const CLASS: u64 = 0x1d;

/// A triangle to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Vertices in pixels, and depth where the base has it.
    pub vertices: [[f64; 2]; 3],
    /// Depth at the vertices.
    pub depth: Option<[f64; 3]>,
    /// Answers that were told apart among the rasterizers that were tried.
    pub answers: usize,
    /// Rasterizers that were tried, of those left.
    pub tried: usize,
    /// How many of the tried ones are left on average after the answer.
    pub expected: f64,
    /// The pixels whose depth tells most, best first, of the picture of the first rasterizer left.
    pub pixels: Vec<(u32, u32)>,
}

/// What to do next.
#[derive(Clone, Debug, PartialEq)]
pub enum Next {
    /// To draw this.
    Draw(Probe),
    /// Nothing: no triangle that was tried tells what is left apart.
    Same {
        /// How many triangles were tried.
        tried: u64,
    },
}

impl Probe {
    /// As a line of a scene.
    pub fn primitive(&self) -> Primitive {
        Primitive::Triangle(Triangle::Real { xy: self.vertices, z: self.depth })
    }

    /// As `eval` takes it.
    pub fn line(&self, id: u64) -> String {
        let point = |n: usize| {
            let [x, y] = self.vertices[n];
            match self.depth {
                Some(z) => format!("[{x:?}, {y:?}, {:?}]", z[n]),
                None => format!("[{x:?}, {y:?}]"),
            }
        };
        format!("{{\"id\": {id}, \"f\": [{}, {}, {}]}}", point(0), point(1), point(2))
    }
}

/// The rasterizers that candidates are tried on.
struct Tried<'a> {
    /// Machines with their edge words.
    machines: Vec<(&'a Left, usize)>,
    /// Words of depth; none as long as many machines are left.
    depths: Vec<(&'a Left, DepthConfig)>,
}

impl Identifier {
    /// The triangle whose answer leaves least, of candidates in the window that `seed` draws. Machines outside
    /// the space are told apart, too: an answer of theirs leaves nothing.
    pub fn next(&self, seed: u64) -> Next {
        let tried = self.sample();
        let Some(model) = self.left.first().map(|left| &left.root.model) else {
            return Next::Same { tried: 0 };
        };
        let window = model.profile().window;
        let size = (window.width, window.height);
        // Where few are left, a candidate is tried quickly, and one that tells them apart is rarer.
        let few = SAMPLE / (tried.machines.len() + tried.depths.len()).max(1);
        let candidates = CANDIDATES * (few as u64).clamp(1, 16);
        let mut number = 0;
        for round in 0..=ROUNDS {
            let mut best: Option<Probe> = None;
            // The last round looks at machines with their widest words alone, and at many candidates: one bit
            // more below the pixel shows in one triangle of fifty.
            let last = (round == ROUNDS).then(|| tried.widest());
            let tried = last.as_ref().unwrap_or(&tried);
            let candidates = match &last {
                None => candidates,
                Some(tried) if tried.machines.len() < 2 => 0,
                Some(tried) => MANY / tried.machines.len() as u64,
            };
            for _ in 0..candidates {
                let mut words = Words::new(seed, CLASS, number);
                number += 1;
                let place = words.word(60) % tried.machines.len() as u64;
                let place = usize::try_from(place).unwrap_or(0);
                let mut probe = self.candidate(&mut words, tried.machines[place].0, size, round);
                tried.split(&mut probe, size);
                let better = best.as_ref().is_none_or(|best| probe.expected < best.expected);
                if probe.answers > 1 && better {
                    best = Some(probe);
                }
            }
            if let Some(mut best) = best {
                if last.is_some() {
                    self.sample().split(&mut best, size);
                }
                return Next::Draw(best);
            }
        }
        Next::Same { tried: number }
    }

    /// An even sample of what is left.
    fn sample(&self) -> Tried<'_> {
        let mut machines = Vec::new();
        let mut depths = Vec::new();
        for left in &self.left {
            let mut variants: Vec<usize> =
                left.alive(self.captures.len(), self.wrong).map(|(variant, _)| variant).collect();
            variants.dedup();
            machines.extend(variants.into_iter().map(|variant| (left, variant)));
        }
        // Depth waits until few machines are left, and then one stands for all: they differ in ties.
        if let (Some(left), true) =
            (self.inside().next(), self.asks_depth() && self.left.len() <= ALIKE)
        {
            let own = left.depths(&self.depths, self.wrong).into_iter().flatten();
            depths.extend(own.map(|depth| (left, depth)));
        }
        Tried { machines: evenly(machines), depths: evenly(depths) }
    }

    /// A triangle of some size, whose vertices and edges lie where decisions show: on ties of the grid of a
    /// rasterizer that is left, on its samples, or anywhere.
    fn candidate(
        &self,
        words: &mut Words,
        of: &Left,
        (width, height): (u32, u32),
        round: u64,
    ) -> Probe {
        let profile = of.root.model.profile();
        let bits = profile.vertex.sub_pixel;
        let unit = f64::from(2u32).powi(-i32::try_from(bits).unwrap_or(0));
        let [sx, sy] = profile.sample.map_or([0.5, 0.5], |SampleConfig { x, y, of }| {
            let part = of.map_or(unit, |of| 1.0 / f64::from(of));
            [x, y].map(|place| f64::from(place) * part)
        });
        // Large triangles tell edge words apart; small ones everything else, and are quick.
        let large = round > 0 || words.draw().is_multiple_of(4) || self.left.len() <= 2;
        let reach = |size: u32| f64::from(if large { size } else { size.min(12) });
        let (wide, high) = (reach(width), reach(height));
        let first = [real(words, f64::from(width) - wide), real(words, f64::from(height) - high)];
        let vertices = [0, 1, 2].map(|_| {
            let at = [first[0] + real(words, wide), first[1] + real(words, high)];
            let moved = match words.draw() % 4 {
                // On a sample.
                0 => [at[0].floor() + sx, at[1].floor() + sy],
                // Between two places of the grid: a tie, or just beside one.
                1 => at.map(|value| ((value / unit).floor() + 0.5) * unit),
                2 => {
                    let beside = unit / 64.0;
                    at.map(|value| {
                        ((value / unit).floor() + 0.5) * unit
                            + if words.draw().is_multiple_of(2) { beside } else { -beside }
                    })
                }
                _ => at.map(|value| (value * 65536.0).floor() / 65536.0),
            };
            // The end of the window is inside the vertex field.
            [moved[0].clamp(0.0, f64::from(width)), moved[1].clamp(0.0, f64::from(height))]
        });
        let depth = self.depths.first().filter(|_| self.asks_depth()).map(|depth| {
            // Steep planes tell slopes apart, flat ones what is added at the start.
            let bits = 1 + words.draw() % u64::from(depth.integer.min(52));
            let top = f64::from(2u32).powi(i32::try_from(bits).unwrap_or(1)) - 1.0;
            [0, 1, 2].map(|_| real(words, top).floor())
        });
        Probe { vertices, depth, answers: 0, tried: 0, expected: 0.0, pixels: Vec::new() }
    }
}

/// A real number of 53 bits below `end`.
fn real(words: &mut Words, end: f64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "53 bits")]
    let part = (words.draw() >> 11) as f64 / (1u64 << 53) as f64;
    part * end.max(0.0)
}

/// An even sample of a list.
fn evenly<T>(all: Vec<T>) -> Vec<T> {
    // A step that shares no factor with the order of the variants goes through all of them.
    let step = if all.len() > SAMPLE { (all.len() / SAMPLE) | 1 } else { 1 };
    all.into_iter().step_by(step).collect()
}

impl<'a> Tried<'a> {
    /// One of the words of each machine: the widest.
    fn widest(&self) -> Self {
        let mut machines: Vec<(&'a Left, usize)> = Vec::new();
        for (left, variant) in &self.machines {
            match machines.last_mut() {
                Some((last, widest)) if std::ptr::eq(*last, *left) => *widest = *variant,
                _ => machines.push((left, *variant)),
            }
        }
        Self { machines, depths: Vec::new() }
    }
}

/// How many of some things are left on average when one of their classes is.
fn expected(classes: impl Iterator<Item = usize>, all: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a few hundred")]
    let [sum, all] = [classes.map(|n| n * n).sum::<usize>() as f64, all.max(1) as f64];
    sum / all
}

impl Tried<'_> {
    /// Says what a probe's answers tell apart.
    fn split(&self, probe: &mut Probe, size: (u32, u32)) {
        let primitive = probe.primitive();
        let mut classes = BTreeMap::<u64, usize>::new();
        // Variants of one root stand together, and most draw what its widest words draw.
        let mut known: Option<(*const Left, u64, Option<Boxed>)> = None;
        let mut picture = Picture::empty(size);
        for (left, variant) in &self.machines {
            let own = std::ptr::from_ref(*left);
            let root = &left.root;
            let (widest, boxed) = match known {
                Some((of, hash, boxed)) if of == own => (hash, boxed),
                _ => {
                    let hash = drawn(&root.model, &primitive, &mut picture);
                    let triangle = flat(&primitive).and_then(|flat| root.model.snap(&flat).ok());
                    let boxed = triangle.and_then(|triangle| Boxed::new(&root.model, &triangle));
                    known = Some((own, hash, boxed));
                    (hash, boxed)
                }
            };
            let words = root.words.get(*variant);
            let fits = |boxed: &Boxed, words: &EdgeWordConfig| {
                boxed.needed(&root.model, *words) <= words.width
            };
            let covers = match (words, boxed) {
                (None, _) => widest,
                (Some(words), Some(boxed)) if fits(&boxed, words) => widest,
                (Some(words), boxed) => match boxed.and_then(|b| b.words(&root.model, *words)) {
                    Some(narrow) => {
                        picture.clear();
                        narrow.paint(&mut picture);
                        hashed(true, &picture)
                    }
                    None => Model::new(&root.profile(Some(*words), None))
                        .map_or(0, |model| drawn(&model, &primitive, &mut picture)),
                },
            };
            *classes.entry(covers).or_default() += 1;
        }
        let left = expected(classes.values().copied(), self.machines.len());
        (probe.answers, probe.tried) = (classes.len(), self.machines.len());
        probe.expected = left;
        if self.depths.len() > 1 {
            let (answers, left) = self.split_depth(probe, size);
            probe.answers = probe.answers.max(1) * answers;
            probe.tried *= self.depths.len();
            probe.expected *= left;
        }
    }

    /// The same of depth, at the pixels that tell most: how many answers, and how many words are left.
    fn split_depth(&self, probe: &mut Probe, size: (u32, u32)) -> (usize, f64) {
        let primitive = probe.primitive();
        let mut picture = Picture::empty(size);
        let Some((first, _)) = self.depths.first() else { return (1, 1.0) };
        let _ = drawn(&first.root.model, &primitive, &mut picture);
        let pixels = picture.pixels();
        let mut deep: Option<(*const Left, Option<Deep<'_>>)> = None;
        let answers: Vec<Vec<u64>> = self
            .depths
            .iter()
            .map(|(left, depth)| {
                let own = std::ptr::from_ref(*left);
                let of = match &mut deep {
                    Some((of, deep)) if *of == own => deep,
                    deep => &mut deep.insert((own, Deep::new(&left.root, &primitive, &[*depth]))).1,
                };
                let codes = of.as_ref().and_then(|deep| deep.codes(*depth, pixels.iter()));
                codes.map_or_else(Vec::new, Iterator::collect)
            })
            .collect();
        let at = |answer: &Vec<u64>, n: usize| answer.get(n).copied();
        let mut telling: Vec<usize> = (0..pixels.len())
            .filter(|n| answers.iter().any(|answer| at(answer, *n) != at(&answers[0], *n)))
            .collect();
        let step = telling.len().div_ceil(TELLING).max(1);
        telling = telling.into_iter().step_by(step).collect();
        let places: Vec<(u32, u32)> = pixels.iter().copied().collect();
        // One pixel after another, each the one that makes most of those before.
        let mut class = vec![0usize; answers.len()];
        let mut count = 1;
        while probe.pixels.len() < PIXELS {
            let parted = |n: usize| {
                let mut numbers = BTreeMap::new();
                let parted = answers.iter().zip(&class).map(|(answer, class)| {
                    let next = numbers.len();
                    *numbers.entry((*class, at(answer, n))).or_insert(next)
                });
                let parted: Vec<usize> = parted.collect();
                (numbers.len(), parted)
            };
            let best =
                telling.iter().map(|n| (parted(*n), *n)).max_by_key(|((count, _), _)| *count);
            let Some(((more, parted), n)) = best.filter(|((more, _), _)| *more > count) else {
                break;
            };
            (count, class) = (more, parted);
            probe.pixels.push(places[n]);
        }
        let mut sizes = vec![0usize; count];
        for class in class {
            sizes[class] += 1;
        }
        (count, expected(sizes.into_iter(), answers.len()))
    }
}

/// A hash of what a model covers.
fn drawn(model: &Model, primitive: &Primitive, picture: &mut Picture) -> u64 {
    picture.clear();
    let drawn =
        prepared(model, primitive).is_some_and(|primitive| model.draw(&primitive, picture).is_ok());
    hashed(drawn, picture)
}

fn hashed(drawn: bool, picture: &Picture) -> u64 {
    let mut hasher = DefaultHasher::new();
    (drawn, picture).hash(&mut hasher);
    hasher.finish()
}
