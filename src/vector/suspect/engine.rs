//! A plain triangle engine as hardware has it, over a [`Path`]: words held in registers, steppers down
//! the box's left side and along its rows, a walk over the box, and counters. Clauses `C-5`, `P-2`,
//! `G-1` and `J-2`.

mod plane;

use super::fault::{Operator, Path, Relation, sign_extend};
use super::stepper::{self, Stepper};
use crate::case::engine::Engine as Widths;
use crate::format::ReadOut;
use crate::model::Span;
pub(super) use plane::remembers;
use plane::{DEPTH, EDGE, Plane};

/// A plain engine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Engine {
    pub(super) widths: Widths,
}

/// What it answers.
#[derive(Debug, Default)]
pub(super) struct Answer {
    pub(super) spans: Vec<Span>,
    /// x, y, depth.
    pub(super) depths: Vec<(u32, u32, u64)>,
    pub(super) span_count: u64,
    pub(super) sample_count: u64,
    pub(super) zero_area: bool,
}

/// What an engine keeps from one record to the next.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Kept {
    spans: i128,
    samples: i128,
    /// Words of the steppers down the side and along a row: of three edges and of depth.
    planes: [[i128; 2]; 4],
}

/// Bits of a pixel coordinate.
const PIXEL: u32 = 17;

/// Steps beyond twice the box after which a walk counts as endless. A box with a wrong side can have
/// 2^34 samples, and no simulation goes there.
const PATIENCE: i128 = 1 << 15;

const HELD: [&str; 12] = [
    "the held edge0_init",
    "the held edge0_dx",
    "the held edge0_dy",
    "the held edge1_init",
    "the held edge1_dx",
    "the held edge1_dy",
    "the held edge2_init",
    "the held edge2_dx",
    "the held edge2_dy",
    "the held depth_init",
    "the held depth_dx",
    "the held depth_dy",
];

/// What the counters begin a record with.
pub(super) const COUNTERS: [&str; 2] = ["spans at a new record", "samples at a new record"];

/// The sign tests, each alone.
const SIGNS: [&str; 3] =
    ["the sign test of edge 0", "the sign test of edge 1", "the sign test of edge 2"];

/// Held words, each perhaps in the place of another.
fn exchanged(path: &Path, held: &[i128]) -> Vec<i128> {
    let named: [(&'static str, i128); 9] = std::array::from_fn(|k| (HELD[k], held[k]));
    let mut words: Vec<i128> =
        (0..9).map(|k| path.choose("which edge word is held", k, named)).collect();
    if let [init, dx, dy] = held[9..] {
        let named = [("depth_init", init), ("depth_dx", dx), ("depth_dy", dy)];
        words.extend((0..3).map(|k| path.choose("which depth word is held", k, named)));
    }
    words
}

impl Engine {
    /// Draws set-up words, with the flag of no area, over a box; `None` if it never ends.
    pub(super) fn draw(
        &self,
        path: &Path,
        kept: &mut Kept,
        words: &[i128],
        bounds: [u32; 4],
    ) -> Option<Answer> {
        path.next_record();
        path.within("triangle_engine", || {
            let mut answer = Answer::default();
            let edge = Stepper::edge(self.widths.edge);
            let read = self.widths.read;
            let held: Vec<i128> = HELD
                .iter()
                .zip(&words[..words.len() - 1])
                .enumerate()
                .map(|(k, (name, word))| {
                    let width = if k < 9 { edge.width } else { read.map_or(1, ReadOut::width) };
                    path.word(name, *word, width)
                })
                .collect();
            let held = exchanged(path, &held);
            let flag = *words.last().unwrap_or(&0);
            let nothing = path.when("the flag of no area stops the engine", flag != 0);
            answer.zero_area = path.when("the flag of no area is handed on", flag != 0);
            let [x0, y0, x1, y1] = bounds.map(i128::from);
            let sides = [("left", x0), ("right", x1), ("top", y0), ("bottom", y1)];
            let side = |pick| path.choose("which side of the box is held", pick, sides);
            let left = path.word("the held left side", side(0), PIXEL);
            let right = path.word("the held right side", side(1), PIXEL);
            let top = path.word("the held top", side(2), PIXEL);
            let bottom = path.word("the held bottom", side(3), PIXEL);
            let counter = |name, so_far| {
                path.only(name, ("zero", 0), [("the count so far", so_far), ("one", 1)])
            };
            let [spans, samples] = COUNTERS;
            kept.spans = counter(spans, kept.spans);
            kept.samples = counter(samples, kept.samples);
            let narrow =
                path.compare("an empty box: left and right", left, Relation::GreaterOrEqual, right);
            let flat =
                path.compare("an empty box: top and bottom", top, Relation::GreaterOrEqual, bottom);
            let done = path.when("nothing to draw", nothing || narrow || flat);
            let triple = |k: usize| [held[3 * k], held[3 * k + 1], held[3 * k + 2]];
            let plane = |k: usize, (stepper, parts)| {
                Plane::new(path, (stepper, parts), triple(k), [left, top], kept.planes[k])
            };
            let mut edges = [0, 1, 2].map(|k| plane(k, (edge, &EDGE)));
            let mut plane = read.map(|read| plane(3, (Stepper::depth(read), &DEPTH)));
            if !done {
                let patience = PATIENCE + 2 * (x1 - x0).max(0) * (y1 - y0).max(0);
                self.walk(
                    path,
                    kept,
                    (&mut edges, plane.as_mut()),
                    ([left, right, top, bottom], patience),
                    &mut answer,
                )?;
            }
            for (kept, plane) in kept.planes.iter_mut().zip(edges.iter().chain(&plane)) {
                *kept = [plane.side, plane.run];
            }
            answer.span_count =
                u64::try_from(path.word("the count of spans", kept.spans, 32)).ok()?;
            answer.sample_count =
                u64::try_from(path.word("the count of samples", kept.samples, 32)).ok()?;
            Some(answer)
        })
    }

    fn walk(
        &self,
        path: &Path,
        kept: &mut Kept,
        (edges, mut plane): (&mut [Plane<'_>; 3], Option<&mut Plane<'_>>),
        ([left, right, top, bottom], patience): ([i128; 4], i128),
        answer: &mut Answer,
    ) -> Option<()> {
        let pixel = |value: i128| u32::try_from(value & ((1 << PIXEL) - 1)).unwrap_or_default();
        let (mut x, mut y) = (left, top);
        let (mut in_run, mut first) = (false, 0);
        let most = ((right - left + 3) * (bottom - top + 3) * 2 + 64).min(patience);
        for _ in 0..most {
            let at_end =
                path.compare("end of a row: x and the right side", x, Relation::Equal, right);
            let inside = [0, 1, 2].map(|k| {
                let together = stepper::inside(path, self.widths.edge, edges[k].run);
                // One of three may be tested otherwise than its fellows.
                let word = sign_extend(edges[k].run, self.widths.edge);
                let alone = path.compare(SIGNS[k], word, Relation::GreaterOrEqual, 0);
                if alone == (word >= 0) { together } else { alone }
            });
            let inside = path.all("inside all three edges", inside);
            let covered = path.when(
                "a sample is covered",
                inside && !path.when("no sample beyond the right side", at_end),
            );
            let closes = path.when("a run ends", in_run && !covered);
            if path.when("a sample is counted", covered) {
                kept.samples =
                    path.sum("the counter of samples", Operator::Add, [kept.samples, 1], 32);
            }
            if covered {
                if path.when("a run begins", !in_run) {
                    first = x;
                }
                if let (Some(plane), Some(read)) = (&plane, self.widths.read) {
                    let value = stepper::read(path, read, plane.run);
                    let x = path.number("columns of samples and runs", x);
                    let y = path.number("rows of samples and runs", y);
                    let sample_x = path.word("x of a sample", x, PIXEL);
                    let sample_y = path.word("y of a sample", y, PIXEL);
                    answer.depths.push((
                        pixel(sample_x),
                        pixel(sample_y),
                        u64::try_from(value).unwrap_or_default(),
                    ));
                }
            }
            if path.when("a run is counted", closes) {
                kept.spans = path.sum("the counter of spans", Operator::Add, [kept.spans, 1], 32);
            }
            if closes {
                let [first, x] = [first, x].map(|x| path.number("columns of samples and runs", x));
                let y = path.number("rows of samples and runs", y);
                let begin = path.word("the left end of a run", first, PIXEL);
                let end = path.word("the right end of a run", x, PIXEL);
                let row = path.word("y of a run", y, PIXEL);
                answer.spans.push(Span { y: pixel(row), x0: pixel(begin), x1: pixel(end) });
            }
            in_run = path.when("samples so far are a run", covered);
            if !at_end {
                x = path.sum("x of the next sample", Operator::Add, [x, 1], PIXEL)
                    & ((1 << PIXEL) - 1);
                for edge in edges.iter_mut() {
                    edge.right(y);
                }
                if let Some(plane) = plane.as_deref_mut() {
                    plane.right(y);
                }
                continue;
            }
            let next = path.sum("the next row's y", Operator::Add, [y, 1], PIXEL);
            let last = path.compare(
                "the last row: the next y and the bottom",
                next,
                Relation::GreaterOrEqual,
                bottom,
            );
            if last {
                return Some(());
            }
            let near = [("zero", 0), ("where the row above ended", x)];
            x = path.only("x at the beginning of a row", ("the left side", left), near);
            for edge in edges.iter_mut() {
                edge.down(y);
            }
            if let Some(plane) = plane.as_deref_mut() {
                plane.down(y);
            }
            y = next;
        }
        None
    }
}
