//! What to draw next: the triangle that splits what is left best. Spec clause `ID-6`.

use super::narrow::Boxed;
use super::{Deep, Identifier, Left, Picture, flat, prepared};
use crate::case::Words;
use crate::model::Model;
use crate::scene::{Primitive, Triangle};
use crate::value::DepthConfig;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Rasterizers that candidates are tried on; of more, an even sample.
const SAMPLE: usize = 256;
/// Candidates a round, and rounds before it is said that nothing splits what is left.
const CANDIDATES: u64 = 48;
const ROUNDS: u64 = 6;
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

/// One of the rasterizers that a candidate is tried on.
struct Tried<'a> {
    left: &'a Left,
    variant: usize,
    depth: Option<DepthConfig>,
}

impl Identifier {
    /// The triangle whose answer leaves least, of candidates in the window that `seed` draws. Which capture a
    /// picture went through is found on the way.
    pub fn next(&self, seed: u64) -> Next {
        let tried = self.sample();
        let Some(model) = self.left.first().map(|left| &left.root.model) else {
            return Next::Same { tried: 0 };
        };
        let window = model.profile().window;
        let size = (window.width, window.height);
        let mut number = 0;
        for round in 0..ROUNDS {
            let mut best: Option<Probe> = None;
            for _ in 0..CANDIDATES {
                let mut words = Words::new(seed, CLASS, number);
                number += 1;
                let place = words.word(60) as usize % tried.len();
                let mut probe = self.candidate(&mut words, &tried[place], size, round);
                let classes = split(&tried, &probe, size);
                probe.answers = classes.len();
                probe.tried = tried.len();
                #[allow(clippy::cast_precision_loss, reason = "a few hundred")]
                let expected = classes.iter().map(|n| (n * n) as f64).sum::<f64>();
                #[allow(clippy::cast_precision_loss, reason = "a few hundred")]
                let all = tried.len() as f64;
                probe.expected = expected / all;
                let better = best.as_ref().is_none_or(|best| probe.expected < best.expected);
                if probe.answers > 1 && better {
                    best = Some(probe);
                }
            }
            if let Some(best) = best {
                return Next::Draw(best);
            }
        }
        Next::Same { tried: number }
    }

    /// An even sample of what is left.
    fn sample(&self) -> Vec<Tried<'_>> {
        let mut all = Vec::new();
        for left in &self.left {
            let mut variants: Vec<usize> =
                left.alive(self.captures.len(), self.wrong).map(|(variant, _)| variant).collect();
            variants.dedup();
            let depths = left.depths(&self.depths, self.wrong);
            // Depth waits until few machines are left.
            let depths = if self.left.len() > 8 { &depths[..1] } else { &depths[..] };
            for depth in depths {
                all.extend(variants.iter().map(|variant| (left, *variant, *depth)));
            }
        }
        let step = (all.len() / SAMPLE).max(1);
        // A step that shares no factor with the order of the variants goes through all of them.
        let step = if step > 1 { step | 1 } else { 1 };
        let chosen = all.into_iter().step_by(step);
        chosen.map(|(left, variant, depth)| Tried { left, variant, depth }).collect()
    }

    /// A triangle of some size, whose vertices and edges lie where decisions show: on ties of the grid of a
    /// rasterizer that is left, on its samples, or anywhere.
    fn candidate(
        &self,
        words: &mut Words,
        of: &Tried<'_>,
        (width, height): (u32, u32),
        round: u64,
    ) -> Probe {
        let profile = of.left.root.model.profile();
        let bits = profile.vertex.sub_pixel;
        let unit = f64::from(2u32).powi(-i32::try_from(bits).unwrap_or(0));
        let [sx, sy] = profile
            .sample
            .map_or([0.5, 0.5], |at| [f64::from(at.x) * unit, f64::from(at.y) * unit]);
        // Large triangles tell edge words apart; small ones everything else, and are quick.
        let large = round > 0 || words.draw() % 4 == 0 || self.left.len() <= 2;
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
                            + if words.draw() % 2 == 0 { beside } else { -beside }
                    })
                }
                _ => at.map(|value| (value * 65536.0).floor() / 65536.0),
            };
            // The end of the window is inside the vertex field.
            [moved[0].clamp(0.0, f64::from(width)), moved[1].clamp(0.0, f64::from(height))]
        });
        let depth = self.depths.first().map(|depth| {
            let top = f64::from(2u32).powi(i32::try_from(depth.integer.min(52)).unwrap_or(0)) - 1.0;
            [0, 1, 2].map(|_| real(words, top).floor())
        });
        Probe { vertices, depth, answers: 0, tried: 0, expected: 0.0 }
    }
}

/// A real number of 53 bits below `end`.
fn real(words: &mut Words, end: f64) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "53 bits")]
    let part = (words.draw() >> 11) as f64 / (1u64 << 53) as f64;
    part * end.max(0.0)
}

/// Sizes of the classes that a probe's answers make of rasterizers.
fn split(tried: &[Tried<'_>], probe: &Probe, size: (u32, u32)) -> Vec<usize> {
    let primitive = probe.primitive();
    let mut classes = BTreeMap::<u64, usize>::new();
    // Variants of one root stand together, and most draw what its widest words draw.
    let mut known: Option<(*const Left, u64, Option<Boxed>)> = None;
    let mut picture = Picture::empty(size);
    // Depth is compared at the pixels that the first one covers.
    let mut deeper: Option<(*const Left, Option<Deep<'_>>, BTreeMap<(u32, u32), ()>)> = None;
    for Tried { left, variant, depth } in tried {
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
        let covers = match (words, boxed) {
            (None, _) => widest,
            (Some(words), Some(boxed)) if boxed.needed(&root.model, words) <= words.width => widest,
            (Some(words), boxed) => match boxed.and_then(|b| b.words(&root.model, words)) {
                Some(narrow) => {
                    picture.clear();
                    narrow.paint(&mut picture);
                    hashed(true, &picture)
                }
                None => Model::new(&root.profile(Some(*words), None))
                    .map_or(0, |model| drawn(&model, &primitive, &mut picture)),
            },
        };
        let deep = depth.and_then(|depth| {
            let (of, deep, pixels) = deeper.get_or_insert_with(|| {
                (own, Deep::new(root, &primitive, &[depth]), picture.pixels())
            });
            if *of != own {
                (*of, *deep) = (own, Deep::new(root, &primitive, &[depth]));
            }
            let codes = deep.as_ref()?.codes(depth, pixels)?;
            let mut hasher = DefaultHasher::new();
            codes.for_each(|code| code.hash(&mut hasher));
            Some(hasher.finish())
        });
        *classes.entry(covers ^ deep.unwrap_or(0).rotate_left(1)).or_default() += 1;
    }
    classes.into_values().collect()
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
