//! Edge functions visited in any order: accumulators stepped from stamp to stamp.
//! Spec clauses `O-1` to `O-5`.

use super::carry::Planes;
use super::edge_function::{edge_columns, setup_words};
use super::edge_words::{drawable, draws_degenerate};
use super::painter::{Painter, accumulated_span};
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::cover::{Bitmask, Block, EdgeWordConfig, EdgeWords, Outside, Rect, TraversalConfig};
use crate::cover::{Visitor, for_each_run};
use crate::dda::{Op, Walker};
use crate::format::Clamp;
use crate::setup::{Plane, VertexConfig};
use crate::value::Depth;

/// The machine of `[form.edge-function]` with a `[traversal]`.
#[derive(Clone, Debug)]
pub struct Traversed {
    edges: EdgeWordConfig,
    traversal: TraversalConfig,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

/// The accumulators of one primitive on their way, and what they found.
struct Cursor<'a> {
    words: &'a EdgeWords,
    width: u32,
    size: [u32; 2],
    /// First pixel of the stamp that the accumulators stand at, once there is one.
    at: Option<[u32; 2]>,
    value: [i128; 3],
    depth: Option<(Depth, Plane, i128)>,
    within: Rect,
    mask: Bitmask,
    found: Vec<i128>,
    work: Work,
}

impl Cursor<'_> {
    /// The signed value of an edge word, reduced.
    fn word(&self, value: i128) -> i128 {
        value << (128 - self.width) >> (128 - self.width)
    }

    /// Steps the accumulators to another stamp: rows first, then columns.
    fn go(&mut self, x: u32, y: u32) {
        let Some([from_x, from_y]) = self.at.replace([x, y]) else {
            // Loaded at the first stamp.
            for k in 0..3 {
                self.value[k] = self.words.at(k, x.into(), y.into()).raw();
            }
            if let Some((depth, plane, value)) = &mut self.depth {
                *value = if depth.read_out().clamp() == Clamp::Saturate {
                    depth.held(plane, x, y)
                } else {
                    plane.at(i128::from(x), i128::from(y)).raw()
                };
            }
            return;
        };
        let (dx, dy) = (i128::from(x) - i128::from(from_x), i128::from(y) - i128::from(from_y));
        for k in 0..3 {
            self.value[k] += self.words.dx(k).raw() * dx + self.words.dy(k).raw() * dy;
        }
        let stamps = [(x, from_x, self.size[0]), (y, from_y, self.size[1])];
        self.work.steps +=
            stamps.map(|(to, from, size)| u64::from(to.abs_diff(from) / size)).iter().sum::<u64>();
        if let Some((depth, plane, value)) = &mut self.depth {
            *value = Self::moved(depth, plane, *value, dx, dy);
        }
    }

    /// A depth accumulator some pixels on: a sum, or for a sticky one what its steps leave.
    fn moved(depth: &Depth, plane: &Plane, value: i128, dx: i128, dy: i128) -> i128 {
        let (read, [_, slopes @ ..]) = (depth.read_out(), plane.raw());
        if read.clamp() != Clamp::Saturate {
            return value + slopes[0] * dx + slopes[1] * dy;
        }
        let mut at = value;
        for (op, steps) in [(Op::StepY, dy), (Op::StepX, dx)] {
            let sign = steps.signum();
            let mut walker = Walker::new(read, at, sign * slopes[0], sign * slopes[1]);
            walker.clock(Op::Load);
            (0..steps.unsigned_abs()).for_each(|_| walker.clock(op));
            at = walker.accumulator();
        }
        at
    }

    fn place(&self, x: u32, y: u32) -> usize {
        let within = self.within;
        ((y - within.y0) * (within.x1 - within.x0) + x - within.x0) as usize
    }
}

impl Visitor for Cursor<'_> {
    fn stamp(&mut self, x: u32, y: u32) -> Outside {
        self.go(x, y);
        let [width, height] = self.size;
        let mut outside = Outside { left: true, right: true };
        for (right, down) in (0..height).flat_map(|down| (0..width).map(move |right| (right, down)))
        {
            self.work.visits += 1;
            let value: [i128; 3] = std::array::from_fn(|k| {
                let step = self.words.dx(k).raw() * i128::from(right)
                    + self.words.dy(k).raw() * i128::from(down);
                self.word(self.value[k] + step)
            });
            let negative = |sign: i128| {
                (0..3).any(|k| value[k] < 0 && self.words.dx(k).raw().signum() * sign >= 0)
            };
            // A negative value that falls to the left stays negative there.
            outside.left &= negative(1);
            outside.right &= negative(-1);
            let (px, py) = (x + right, y + down);
            let within = self.within;
            if !(within.x0..within.x1).contains(&px) || !(within.y0..within.y1).contains(&py) {
                continue;
            }
            if value.iter().all(|value| *value >= 0) {
                self.mask.fill(py - within.y0, px - within.x0, px - within.x0 + 1);
                if let Some((depth, plane, value)) = &self.depth {
                    let moved = Self::moved(depth, plane, *value, right.into(), down.into());
                    let place = self.place(px, py);
                    self.found[place] = moved;
                }
            }
        }
        outside
    }

    fn block(&mut self, x: u32, y: u32, side: u32) -> Block {
        self.work.tiles += 1;
        let span = i128::from(side - 1);
        let mut whole = true;
        for k in 0..3 {
            let (a, b) = (self.words.dx(k).raw(), self.words.dy(k).raw());
            let first = self.words.start(k).raw() + a * i128::from(x) + b * i128::from(y);
            let ends = |up: bool| {
                let toward = |step: i128| if (step > 0) == up { step * span } else { 0 };
                self.word(first + toward(a) + toward(b))
            };
            if ends(true) < 0 {
                return Block::Outside;
            }
            whole &= ends(false) >= 0;
        }
        if whole { Block::Inside } else { Block::Partly }
    }
}

impl Traversed {
    /// A machine of validated parts.
    pub fn new(
        edges: EdgeWordConfig,
        traversal: TraversalConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let setup = edge_columns(edges, vertex);
        let ports = Ports::triangle(vertex, setup, depth);
        Self { edges, traversal, depth, target, ports }
    }
}

impl Machine for Traversed {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draws_degenerate(&self) -> bool {
        draws_degenerate(self.edges)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(self.edges, input.triangle()?, out) else { return Ok(()) };
        let grid = &self.target.grid;
        let words = self.edges.words(&triangle, grid);
        let painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        painter.announce(|| setup_words(&words), out);
        let [x0, y0, x1, y1] = self.target.bounds(&triangle);
        if x0 == x1 || y0 == y1 {
            return Ok(());
        }
        let within = Rect { x0, y0, x1, y1 };
        let size = Rect { x0: 0, y0: 0, x1: x1 - x0, y1: y1 - y0 };
        let depth = self.depth.zip(triangle.z);
        let depth = depth.map(|(depth, z)| (depth, depth.plane(&triangle, z, grid), 0));
        let samples = if depth.is_some() { size.x1 as usize * size.y1 as usize } else { 0 };
        let mut cursor = Cursor {
            words: &words,
            width: self.edges.width,
            size: self.traversal.stamp.size(),
            at: None,
            value: [0; 3],
            depth,
            within,
            mask: Bitmask::new(size),
            found: vec![0; samples],
            work: Work { rows: u64::from(y1 - y0), ..Work::default() },
        };
        self.traversal.visit([x0, y0, x1, y1], &mut cursor);
        for y in y0..y1 {
            let mut done = Ok(());
            for_each_run(cursor.mask.row(y - y0), |start, end| {
                let run = [x0 + start, x0 + end];
                if done.is_err() {
                } else if let Some((depth, ..)) = &cursor.depth {
                    let values = &cursor.found[cursor.place(run[0], y)..][..(end - start) as usize];
                    done = accumulated_span(depth, (y, run[0]), values, out);
                } else {
                    out.span(y, run[0], run[1], &[]);
                }
            });
            done?;
        }
        out.work(&cursor.work);
        Ok(())
    }
}
