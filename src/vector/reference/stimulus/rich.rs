//! Random cases of eight kinds, for machines with tiles, walked edges, several samples or no depth.

use super::{Digest, Random, Stimulus, clock, pattern};
use crate::cover::{Rect, SampleGrid};
use crate::dda::{Op, Walker};
use crate::format::ReadOut;
use crate::model::{Drawing, Model, View};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::bench::ready;
use crate::vector::device::{draw, grid, setup_words};
use crate::vector::reference::shape::{Coverage, Shape};

/// Cases of a profile.
pub(in crate::vector::reference) struct Cases<'a> {
    given: Stimulus<'a>,
    /// Bits of depth.
    integer: Option<u32>,
    /// The last triangle of kind 2: each of its edges has small triangles near.
    last: Triangle,
}

impl<'a> Cases<'a> {
    /// Cases of triangles with so many bits of depth.
    pub(super) fn new(given: Stimulus<'a>, integer: Option<u32>) -> Self {
        let last = Triangle { xy: [[0; 2]; 3], z: integer.map(|_| [0; 3]) };
        Self { given, integer, last }
    }

    /// Where numbers come from.
    pub(super) const fn random(&mut self) -> &mut Random {
        &mut self.given.random
    }

    /// A number with a sign, of any size below 2^61.
    pub(super) fn scaled(&mut self) -> i128 {
        let number = self.given.random.below(1 << 62) - (1 << 61);
        number >> self.given.random.below(62)
    }

    /// Whose cases they are.
    pub(super) const fn profile(&self) -> &'a Profile {
        self.given.profile
    }

    /// The window.
    pub(super) const fn size(&self) -> [i128; 2] {
        self.given.size
    }

    /// At or near an end of the range, or anywhere.
    fn end(&mut self) -> i128 {
        let (low, high) = self.given.profile.vertex.range();
        let random = &mut self.given.random;
        let (place, by) = (random.below(4), random.below(high - low + 1));
        match place {
            0 => low,
            1 => high,
            2 => high - (by & 3),
            _ => low + by,
        }
    }

    /// Vertex `k`, after those before it.
    fn vertex(&mut self, kind: u64, k: usize, before: &Triangle) -> ([i128; 2], i128) {
        let (low, high) = self.given.profile.vertex.range();
        let z = |triangle: &Triangle, k: usize| triangle.z.map_or(0, |z| z[k]);
        let v = before.xy;
        let xy = match (kind, k) {
            (4, 0 | 1) => return (self.last.xy[1 - k], z(&self.last, 1 - k)),
            // Thin: within a sub-pixel of the vertex before.
            (5, 2) => v[1].map(|at| (at + self.given.random.below(3) - 1).clamp(low, high)),
            // On a line with the two before.
            (6, 2) => [0, 1].map(|axis| (2 * v[0][axis] - v[1][axis]).clamp(low, high)),
            (7, _) => [self.end(), self.end()],
            _ => {
                let kind = if kind < 4 { kind } else { 1 };
                let [width, height] = self.given.size;
                let [x, y] = v[0].map(|near| (k > 0).then_some(near));
                [self.given.coordinate(kind, width, x), self.given.coordinate(kind, height, y)]
            }
        };
        let Some(integer) = self.integer else { return (xy, 0) };
        let drawn = self.given.random.word(integer);
        let end = if drawn & 1 == 1 { (1 << integer) - 1 } else { 0 };
        (xy, if kind & 3 == 3 { end } else { drawn })
    }

    pub(super) fn triangle(&mut self, kind: u64) -> Triangle {
        let mut triangle = Triangle { xy: [[0; 2]; 3], z: self.integer.map(|_| [0; 3]) };
        for k in 0..3 {
            let (xy, value) = self.vertex(kind, k, &triangle);
            triangle.xy[k] = xy;
            if let Some(z) = &mut triangle.z {
                z[k] = value;
            }
        }
        if kind == 2 {
            self.last = triangle;
        }
        triangle
    }

    /// A pixel of the window: anywhere, or at the first edge.
    pub(super) fn pixel(&mut self, k: usize, triangle: &Triangle) -> [u32; 2] {
        let [a, b, _] = triangle.xy;
        let fraction = 6 + self.given.profile.vertex.sub_pixel;
        let random = &mut self.given.random;
        let at = [0, 1].map(|axis| {
            let size = self.given.size[axis];
            if k < 2 {
                return random.below(size);
            }
            let part = random.below(65);
            ((a[axis] * (64 - part) + b[axis] * part) >> fraction).clamp(0, size - 1)
        });
        at.map(|at| u32::try_from(at).unwrap_or(0))
    }
}

/// What a model draws of a triangle in a rectangle.
fn drawn(profile: &Profile, clip: Rect, triangle: &Triangle) -> Drawing {
    let view = View { scissor: Some(clip), ..View::default() };
    let model = Model::with_view(profile, view)
        .unwrap_or_else(|error| unreachable!("a valid profile: {error}"));
    let mut drawing = Drawing::default();
    draw(&model, triangle, &mut drawing);
    drawing
}

/// A pixel that is drawn: its row and column, its mask, its depths.
type Pixel = (u32, u32, u32, Vec<u64>);

/// The pixels of a drawing, row by row; one sample is a mask of 1.
fn pixels(drawing: &Drawing, shape: &Shape) -> Vec<Pixel> {
    let mut depths = drawing.depth.iter().copied();
    let mut masks = drawing.masks.iter().copied();
    let mut list = Vec::new();
    for span in &drawing.spans {
        for x in span.x0..span.x1 {
            let mask = masks.next().unwrap_or(1);
            let count = match (shape.depth, shape.centre) {
                (None, _) => 0,
                (Some(_), Some(_)) => 1,
                (Some(_), None) => mask.count_ones() as usize,
            };
            list.push((span.y, x, mask, depths.by_ref().take(count).collect()));
        }
    }
    // A machine may visit samples in an order of its own.
    list.sort_unstable();
    list
}

/// The digests of the units, in the order of [`Shape::units`].
struct Digests {
    dda: Option<Digest>,
    step: Digest,
    words: Digest,
    samples: Digest,
}

impl Digests {
    fn new(depth: bool) -> Self {
        let digest = || Digest(0xcbf2_9ce4_8422_2325);
        let dda = depth.then(digest);
        Self { dda, step: digest(), words: digest(), samples: digest() }
    }

    fn list(self) -> Vec<u64> {
        let rest = [self.step, self.words, self.samples];
        self.dda.into_iter().chain(rest).map(|digest| digest.0).collect()
    }

    /// Set-up words in the order of the texts: sample by sample, each with its depth and its box.
    fn set_up(&mut self, words: &[i128], shape: &Shape, model: &Model, triangle: &Triangle) {
        let (flag, words) = words.split_last().unwrap_or_else(|| unreachable!("there is a flag"));
        let width = shape.step_read().width();
        let count = shape.samples.len();
        let of_edges = match shape.coverage {
            Coverage::Edges(..) => 9,
            Coverage::Walk(_) => 12,
        };
        let (edges, plane) = words.split_at(of_edges * count);
        let digest = &mut self.words;
        let depth = |digest: &mut Digest, start: usize| {
            let Some(read) = shape.depth_read() else { return };
            let slopes = &plane[plane.len() - 2..];
            for word in [plane[start], slopes[0], slopes[1]] {
                digest.fold(pattern(word, read.width()), read.width());
            }
        };
        for (n, own) in edges.chunks_exact(of_edges).enumerate() {
            for (k, word) in own.iter().enumerate() {
                // A walked edge has its rows behind x and its step.
                let bits = if of_edges == 12 && k % 4 > 1 { 64 } else { width };
                digest.fold(pattern(*word, bits), bits);
            }
            if shape.centre.is_none() {
                depth(digest, n);
            }
            digest.number(*flag);
            for side in bounds(model, shape.samples[n], triangle) {
                digest.number(side);
            }
        }
        if shape.centre.is_some() {
            depth(digest, 0);
        }
    }
}

/// The box of a triangle on the grid of a sample: x0 y0 x1 y1, half-open.
fn bounds(model: &Model, offset: [i128; 2], triangle: &Triangle) -> [u32; 4] {
    let grid = SampleGrid { offset, ..grid(model) };
    let clip = |axis| model.clip().clip(axis, grid.pixels(axis, triangle.extent(axis)));
    let [x, y] = [clip(0), clip(1)];
    [x.0, y.0, x.1, y.1]
}

/// An edge word or a walked x after a clock, and what is made of it.
fn step(
    digest: &mut Digest,
    (walker, op): (&mut Walker, u64),
    shape: &Shape,
    grid: &SampleGrid,
    random: &mut Random,
) {
    let read = shape.step_read();
    match shape.coverage {
        Coverage::Edges(..) => {
            clock(walker, Op::from_code(op), read.width(), random);
            digest.fold(walker.pattern(), read.width());
            digest.number(u8::from(walker.pattern() >> (read.width() - 1) == 0));
        }
        Coverage::Walk(walk) => {
            let [init, dy] = [(); 2].map(|()| random.word(read.width()));
            walker.rewire(init, 0, dy);
            walker.clock(if op == 0 { Op::Load } else { Op::StepY });
            digest.fold(walker.pattern(), read.width());
            let x = read.reduce(walker.pattern().cast_signed());
            digest.number(walk.pixel(x, grid));
        }
    }
}

/// Digests of the units.
pub(super) fn digests(profile: &Profile, shape: &Shape, seed: u64, cases: u64) -> Vec<u64> {
    let (model, set_up) = (ready(profile, true), ready(profile, false));
    let grid = grid(&model);
    let read = shape.depth_read();
    let mut given = Cases::new(Stimulus::new(profile, seed), read.map(ReadOut::integer));
    let mut acc = read.map(|read| Walker::new(read, 0, 0, 0));
    let mut word = Walker::new(shape.step_read(), 0, 0, 0);
    let mut digests = Digests::new(read.is_some());
    for n in 0..cases {
        let kind = n & 7;
        let op = read.map(|_| given.given.random.next() & 3);
        let edge_op = given.given.random.next() & 3;
        if let (Some(acc), Some(read), Some(digest)) = (&mut acc, read, &mut digests.dda) {
            let op = Op::from_code(op.unwrap_or_default());
            clock(acc, op, read.width(), &mut given.given.random);
            digest.fold(acc.pattern(), read.width());
            digest.number(acc.out());
        }
        step(&mut digests.step, (&mut word, edge_op), shape, &grid, &mut given.given.random);
        let triangle = given.triangle(kind);
        digests.set_up(&setup_words(&set_up, &triangle), shape, &model, &triangle);
        let samples = &mut digests.samples;
        for k in 0..4 {
            let [x, y] = given.pixel(k, &triangle);
            let clip = Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 };
            let found = pixels(&drawn(profile, clip, &triangle), shape).pop();
            let (_, _, mask, depths) = found.unwrap_or((y, x, 0, Vec::new()));
            if shape.several {
                samples.number(x);
                samples.number(y);
            }
            samples.number(mask);
            for z in depths {
                samples.number(z);
            }
        }
        if matches!(kind, 0 | 3 | 7) {
            continue;
        }
        let mut drawing = Drawing::default();
        draw(&model, &triangle, &mut drawing);
        let list = pixels(&drawing, shape);
        let [_, y0, _, y1] = bounds(&model, shape.samples[0], &triangle);
        if shape.several {
            for (y, x, mask, depths) in list {
                for number in [x, y, mask] {
                    samples.number(number);
                }
                for z in depths {
                    samples.number(z);
                }
            }
            continue;
        }
        for y in y0..y1 {
            let row: Vec<_> = list.iter().filter(|pixel| pixel.0 == y).collect();
            samples.number(row.len() as i128);
            for (_, x, _, depths) in row {
                samples.number(*x);
                for z in depths {
                    samples.number(*z);
                }
            }
        }
    }
    digests.list()
}
