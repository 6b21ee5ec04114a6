//! A word over a box: the evaluators of an edge and of depth.

use super::PIXEL;
use crate::dda::Op;
use crate::vector::suspect::fault::{Operator, Path};
use crate::vector::suspect::stepper::Stepper;

/// A word over a box: a stepper down its left side, and one along a row.
pub(super) struct Plane<'p> {
    path: &'p Path,
    stepper: Stepper,
    parts: &'static Parts,
    words: [i128; 3],
    /// Left side of the box.
    x: i128,
    pub(super) side: i128,
    pub(super) run: i128,
}

/// What the parts of an evaluator are called.
pub(super) struct Parts {
    module: &'static str,
    across: &'static str,
    down: &'static str,
    x: &'static str,
    y: &'static str,
    across_by: &'static str,
    down_by: &'static str,
    across_word: &'static str,
    down_word: &'static str,
    across_sum: &'static str,
    down_sum: &'static str,
    row: &'static str,
    row_from: &'static str,
    loaded: &'static str,
    side_moves: &'static str,
    run_moves: &'static str,
    run_steps: &'static str,
    side_steps: &'static str,
}

pub(super) const EDGE: Parts = Parts {
    module: "edge_evaluator",
    across: "edge dx times the box's x",
    down: "edge dy times the box's y",
    x: "x in edge dx times x",
    y: "y in edge dy times y",
    across_by: "what edge dx is multiplied by",
    down_by: "what edge dy is multiplied by",
    across_word: "edge dx times the box's x, low bits",
    down_word: "edge dy times the box's y, low bits",
    across_sum: "the edge word at the corner, across",
    down_sum: "the edge word at the corner, down",
    row: "the edge word of the next row",
    row_from: "what an edge's row begins from",
    loaded: "what an edge's row is loaded with",
    side_moves: "operation of an edge's left side",
    run_moves: "operation along an edge's row",
    run_steps: "what an edge steps by along a row",
    side_steps: "what an edge steps by down the side",
};

pub(super) const DEPTH: Parts = Parts {
    module: "depth_evaluator",
    across: "depth dx times the box's x",
    down: "depth dy times the box's y",
    x: "x in depth dx times x",
    y: "y in depth dy times y",
    across_by: "what depth dx is multiplied by",
    down_by: "what depth dy is multiplied by",
    across_word: "depth dx times the box's x, low bits",
    down_word: "depth dy times the box's y, low bits",
    across_sum: "the depth at the corner, across",
    down_sum: "the depth at the corner, down",
    row: "the depth of the next row",
    row_from: "what a depth row begins from",
    loaded: "what a depth row is loaded with",
    side_moves: "operation of the depth's left side",
    run_moves: "operation along a depth row",
    run_steps: "what depth steps by along a row",
    side_steps: "what depth steps by down the side",
};

impl<'p> Plane<'p> {
    /// At the corner of the box; the steppers hold what the record before has left in them.
    pub(super) fn new(
        path: &'p Path,
        (stepper, parts): (Stepper, &'static Parts),
        words: [i128; 3],
        [x, y]: [i128; 2],
        [side, run]: [i128; 2],
    ) -> Self {
        let mut plane = Self { path, stepper, parts, words, x, side, run };
        path.within(parts.module, || plane.moves(CORNER, y));
        plane
    }

    /// The word at the left end of a row.
    fn corner(&self, y: i128) -> i128 {
        let Self { path, stepper, parts, words: [init, dx, dy], x, .. } = *self;
        let (x_name, y_name) = (("the box's x", x), ("the box's y", y));
        let near = [y_name, ("zero", 0), ("the box's x and one", x + 1)];
        let x = path.only(parts.across_by, x_name, near);
        let near = [x_name, ("zero", 0), ("the box's y and one", y + 1)];
        let y = path.only(parts.down_by, y_name, near);
        let (x, y) = (path.word(parts.x, x, PIXEL), path.word(parts.y, y, PIXEL));
        let across = path.word(parts.across_word, path.product(parts.across, dx, x), stepper.width);
        let down = path.word(parts.down_word, path.product(parts.down, dy, y), stepper.width);
        let corner = path.sum(parts.across_sum, Operator::Add, [init, across], stepper.width);
        path.sum(parts.down_sum, Operator::Add, [corner, down], stepper.width)
    }

    fn clock(&self, word: i128, op: Op, init: i128, side: bool) -> i128 {
        let [_, dx, dy] = self.words;
        let steps = if side { self.parts.side_steps } else { self.parts.run_steps };
        let (own, other) = if side { (("dy", dy), ("dx", dx)) } else { (("dx", dx), ("dy", dy)) };
        let step = self.path.only(steps, own, [other]);
        let (dx, dy) = if side { (dx, step) } else { (step, dy) };
        self.stepper.clock(self.path, word, op, [init, dx, dy])
    }

    /// To the next row, from row `y`.
    pub(super) fn down(&mut self, y: i128) {
        let path = self.path;
        path.within(self.parts.module, || self.moves(ROW, y));
    }

    /// To the next sample of row `y`.
    pub(super) fn right(&mut self, y: i128) {
        let path = self.path;
        path.within(self.parts.module, || self.moves(SAMPLE, y));
    }

    /// A clock with a code of the engine: both registers take what they see before it.
    fn moves(&mut self, code: usize, y: i128) {
        let Self { path, parts, words: [.., dy], .. } = *self;
        let codes = ["at the corner", "after a sample", "at the end of a row"];
        let names = ["a load", "a step right", "a step down", "a hold"];
        let operation = |name, right: [Op; 3]| {
            let right = right.map(|op| op as usize);
            Op::from_code(path.decoded(name, code, right, (codes, names)) as u64)
        };
        let side = operation(parts.side_moves, [Op::Load, Op::Hold, Op::StepY]);
        let run = operation(parts.run_moves, [Op::Load, Op::StepX, Op::Load]);
        let pick = usize::from(code != CORNER);
        let sources = [("the word at the corner", true), ("the left side and dy", false)];
        let of_corner = run == Op::Load && path.choose(parts.loaded, pick, sources);
        let corner = if side == Op::Load || of_corner { self.corner(y) } else { 0 };
        let left = if of_corner {
            corner
        } else if run == Op::Load {
            let near = [("the end of the row above", self.run)];
            let from = path.only(parts.row_from, ("the left side", self.side), near);
            path.sum(parts.row, Operator::Add, [from, dy], self.stepper.width)
        } else {
            0
        };
        if side != Op::Hold {
            self.side = self.clock(self.side, side, corner, true);
        }
        self.run = self.clock(self.run, run, left, false);
    }
}

/// Codes of the engine.
const CORNER: usize = 0;
const SAMPLE: usize = 1;
const ROW: usize = 2;

/// Where a fault can leave what the record before has left: it then has to be followed from the first record on.
pub(in crate::vector::suspect) fn remembers(site: &str) -> bool {
    [&EDGE, &DEPTH]
        .iter()
        .any(|parts| [parts.loaded, parts.side_moves, parts.run_moves].contains(&site))
}
