//! The random cases of a reference's self test, answered by the model.

pub(super) mod register;
mod rich;

use super::shape::Shape;
use crate::dda::{Op, Walker};
use crate::format::ReadOut;
use crate::model::Drawing;
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::bench::{bounds, ready};
use crate::vector::device::{draw, setup_words};

/// Numbers that every language works out alike: the high bits of a linear congruence modulo 2^64.
struct Random(u64);

impl Random {
    /// 31 bits.
    fn next(&mut self) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn below(&mut self, count: i128) -> i128 {
        let high = self.next();
        i128::from(high << 31 | self.next()) % count
    }

    /// A pattern of so many bits.
    fn word(&mut self, width: u32) -> i128 {
        let word = (0..5).fold(0u128, |word, _| word << 31 | u128::from(self.next()));
        pattern(word.cast_signed(), width).cast_signed()
    }
}

/// The low bits of a value.
fn pattern(value: i128, width: u32) -> u128 {
    value.cast_unsigned() & (u128::MAX >> (128 - width))
}

struct Digest(u64);

impl Digest {
    /// FNV-1a over words of 64 bits.
    fn fold(&mut self, value: u128, width: u32) {
        let halves = if width > 64 { 2 } else { 1 };
        for chunk in value.to_le_bytes().chunks_exact(8).take(halves) {
            let word = chunk.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
            self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn number(&mut self, value: impl Into<i128>) {
        self.fold(value.into().cast_unsigned(), 64);
    }
}

struct Stimulus<'a> {
    random: Random,
    profile: &'a Profile,
    size: [i128; 2],
}

impl<'a> Stimulus<'a> {
    fn new(profile: &'a Profile, seed: u64) -> Self {
        let clip = ready(profile, true).clip();
        Self { random: Random(seed), profile, size: [clip.x1, clip.y1].map(i128::from) }
    }

    /// Anywhere, or within 4 pixels of another one, in halves of a pixel or not.
    fn coordinate(&mut self, kind: u64, size: i128, near: Option<i128>) -> i128 {
        let s = self.profile.vertex.sub_pixel;
        let (low, high) = self.profile.vertex.range();
        let step = if kind == 2 && s > 0 { 1 << (s - 1) } else { 1 };
        let reach = (4 << s) / step;
        if kind == 0 || kind == 3 {
            return low + self.random.below(high - low + 1);
        }
        let at = match near {
            None => self.random.below((size << s) / step + 1) * step,
            Some(near) => near + (self.random.below(2 * reach + 1) - reach) * step,
        };
        at.clamp(low, high)
    }

    fn triangle(&mut self, kind: u64, integer: u32) -> Triangle {
        let (mut xy, mut z) = ([[0; 2]; 3], [0; 3]);
        for k in 0..3 {
            let [x, y] = xy[0].map(|near| (k > 0).then_some(near));
            let [width, height] = self.size;
            xy[k] = [self.coordinate(kind, width, x), self.coordinate(kind, height, y)];
            z[k] = self.random.word(integer);
            if kind == 3 {
                z[k] = if z[k] & 1 == 1 { (1 << integer) - 1 } else { 0 };
            }
        }
        Triangle { xy, z: Some(z) }
    }
}

/// Triangles anywhere, near each other, on half pixels, and at the ends of depth.
pub(super) fn triangles(profile: &Profile, integer: u32, count: u64) -> Vec<Triangle> {
    let mut given = Stimulus::new(profile, 1);
    (0..count).map(|n| given.triangle(n & 3, integer)).collect()
}

/// A register that is loaded and stepped by random words.
fn clock(walker: &mut Walker, op: Op, width: u32, random: &mut Random) {
    let [init, dx, dy] = [(); 3].map(|()| random.word(width));
    walker.rewire(init, dx, dy);
    walker.clock(op);
}

/// Digests of a profile's units.
pub(super) fn digests(profile: &Profile, shape: &Shape, seed: u64, cases: u64) -> Vec<u64> {
    match shape.depth_read() {
        Some(read) if shape.is_plain() => {
            plain(profile, [read, shape.step_read()], seed, cases).to_vec()
        }
        _ => rich::digests(profile, shape, seed, cases),
    }
}

/// Digests of the DDA, the edge stepper, the set-up and the samples.
fn plain(profile: &Profile, [read, edge]: [ReadOut; 2], seed: u64, cases: u64) -> [u64; 4] {
    let (model, set_up) = (ready(profile, true), ready(profile, false));
    let mut given = Stimulus::new(profile, seed);
    let [mut acc, mut word] = [read, edge].map(|read| Walker::new(read, 0, 0, 0));
    let mut digests = [(); 4].map(|()| Digest(0xcbf2_9ce4_8422_2325));
    let [of_dda, of_edge, of_words, of_samples] = &mut digests;
    for n in 0..cases {
        let kind = n & 3;
        let [op, edge_op] = [(); 2].map(|()| Op::from_code(given.random.next() & 3));
        clock(&mut acc, op, read.width(), &mut given.random);
        of_dda.fold(acc.pattern(), read.width());
        of_dda.number(acc.out());
        clock(&mut word, edge_op, edge.width(), &mut given.random);
        of_edge.fold(word.pattern(), edge.width());
        let inside = |word: i128| pattern(word, edge.width()) >> (edge.width() - 1) == 0;
        of_edge.number(u8::from(inside(word.accumulator())));

        let triangle = given.triangle(kind, read.integer());
        let words = setup_words(&set_up, &triangle);
        let (flag, words) = words.split_last().unwrap_or_else(|| unreachable!("there is a flag"));
        for (n, word) in words.iter().enumerate() {
            let width = if n < 9 { edge.width() } else { read.width() };
            of_words.fold(pattern(*word, width), width);
        }
        of_words.number(*flag);
        let bounds = bounds(&model, &triangle);
        for side in bounds {
            of_words.number(side);
        }

        for _ in 0..4 {
            let [x, y] = given.size.map(|size| given.random.below(size));
            let at = |k: usize| words[k] + x * words[k + 1] + y * words[k + 2];
            of_samples.number(u8::from(*flag == 0 && [0, 3, 6].into_iter().all(|k| inside(at(k)))));
            of_samples.number(read.read(at(9)));
        }
        if kind == 0 || kind == 3 {
            continue;
        }
        let mut drawing = Drawing::default();
        draw(&model, &triangle, &mut drawing);
        rows(&drawing, bounds, of_samples);
    }
    digests.map(|digest| digest.0)
}

/// Each row of a box: how many samples are covered, their columns and depths.
fn rows(drawing: &Drawing, [_, y0, _, y1]: [u32; 4], digest: &mut Digest) {
    let mut depths = drawing.depth.iter();
    let mut samples: Vec<(u32, u32, u64)> = Vec::new();
    for span in &drawing.spans {
        samples.extend((span.x0..span.x1).zip(&mut depths).map(|(x, z)| (span.y, x, *z)));
    }
    // A machine may visit samples in an order of its own.
    samples.sort_unstable();
    for y in y0..y1 {
        let row = samples.iter().filter(|sample| sample.0 == y);
        digest.number(row.clone().count() as i128);
        for (_, x, z) in row {
            digest.number(*x);
            digest.number(*z);
        }
    }
}
