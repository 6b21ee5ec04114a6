//! A plain triangle engine with a slip: steppers down the box's left side and along its rows.

use super::slip::{ReadSlip, Register, SignSlip, Slip};
use crate::dda::Op;
use crate::format::ReadOut;
use crate::model::Span;

/// A defect of an engine that takes set-up words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EngineSlip {
    /// In the depth accumulators.
    Depth(Slip),
    /// In the edge accumulators.
    Edge(Slip),
    /// In the depth read-out.
    Read(ReadSlip),
    /// In the edges' sign test.
    Sign(SignSlip),
    LeftEndLate,
    ColumnsLate,
    LastRow,
    LastColumn,
    EdgeUnseen(usize),
    AnyEdge,
    CornerSwapped,
    CornerFlat,
    DepthRowAbove,
    EdgeRowAbove,
    DepthStepsDown,
    DepthToTheRight,
    CountLarge,
    CountKept,
}

impl EngineSlip {
    /// Those that an engine of these words can have.
    pub(super) fn all(edge_width: u32, read: Option<ReadOut>) -> Vec<(Self, String)> {
        let of = |slips: &[(Self, &str)]| -> Vec<(Self, String)> {
            slips.iter().map(|(slip, name)| (*slip, (*name).to_owned())).collect()
        };
        let mut list = of(&[
            (
                Self::LeftEndLate,
                "spans leave out the pixel at their left end (off by one); spans of one pixel are empty",
            ),
            (Self::ColumnsLate, "columns are numbered one too high (off by one)"),
            (Self::LastRow, "the last row of the box is left out"),
            (Self::LastColumn, "the last column of the box is left out"),
            (Self::EdgeUnseen(0), "edge 0 is not tested"),
            (Self::EdgeUnseen(1), "edge 1 is not tested"),
            (Self::EdgeUnseen(2), "edge 2 is not tested"),
            (Self::AnyEdge, "a sample inside any one edge counts as covered"),
            (Self::CornerFlat, "the start at the corner of the box leaves out the steps down"),
            (Self::EdgeRowAbove, "the edge words of a row start from the row above"),
            (Self::CountLarge, "the count of samples is one too large"),
            (Self::CountKept, "the count of samples is not reset between triangles"),
        ]);
        // What a stall or an earlier triangle leaves behind cannot be told from the words.
        let told = |slip: &Slip| {
            slip.forgets() && !matches!(slip, Slip::HoldClears | Slip::HoldSteps | Slip::Held)
        };
        let named = |slip: Slip, what: &str| format!("{} ({what})", slip.text());
        list.extend(
            Slip::all(edge_width).filter(told).map(|s| (Self::Edge(s), named(s, "edge words"))),
        );
        list.extend(SignSlip::ALL.map(|(slip, name)| (Self::Sign(slip), name.to_owned())));
        let Some(read) = read else { return list };
        list.extend(of(&[
            (Self::CornerSwapped, "the start at the corner of the box uses x instead of y"),
            (Self::DepthRowAbove, "the depth of a row starts from the row above"),
            (Self::DepthStepsDown, "depth steps by dz/dy along a row"),
            (Self::DepthToTheRight, "depths are those of the sample to the right"),
        ]));
        list.extend(
            Slip::all(read.width()).filter(told).map(|s| (Self::Depth(s), named(s, "depth"))),
        );
        list.extend(ReadSlip::all(read).into_iter().map(|s| (Self::Read(s), s.text().to_owned())));
        list
    }
}

/// An engine with a slip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Engine {
    pub(super) slip: EngineSlip,
    pub(super) edge_width: u32,
    pub(super) read: Option<ReadOut>,
}

/// What it answers.
#[derive(Default)]
pub(super) struct Answer {
    pub(super) spans: Vec<Span>,
    /// x, y, depth.
    pub(super) depths: Vec<(u32, u32, u64)>,
    pub(super) samples: u64,
}

/// A word over a box.
struct Plane {
    words: [i128; 3],
    side: Register,
    run: Register,
}

impl Plane {
    fn new(slip: Option<Slip>, width: u32, words: [i128; 3], corner: i128, run: [i128; 2]) -> Self {
        let [_, dx, dy] = words;
        let (mut side, fresh) = (Register::new(slip, width), Register::new(slip, width));
        side.clock(Op::Load, [corner, dx, dy]);
        let mut plane = Self { words: [corner, run[0], run[1]], side, run: fresh };
        plane.run.clock(Op::Load, plane.words);
        plane.words = [dy, run[0], run[1]];
        plane
    }

    /// To the row below; a row that starts from the row above forgets to add.
    fn down(&mut self, above: bool) {
        let [dy, dx, run_dy] = self.words;
        let left = self.side.pattern.cast_signed() + if above { 0 } else { dy };
        self.side.clock(Op::StepY, [0, 0, dy]);
        self.run.clock(Op::Load, [left, dx, run_dy]);
    }

    fn right(&mut self) {
        let [_, dx, run_dy] = self.words;
        self.run.clock(Op::StepX, [0, dx, run_dy]);
    }
}

impl Engine {
    /// Draws set-up words over a box.
    pub(super) fn draw(&self, words: &[i128], [x0, y0, x1, y1]: [u32; 4]) -> Answer {
        let mut answer = Answer::default();
        if x0 >= x1 || y0 >= y1 {
            return answer;
        }
        let corner = |[value, dx, dy]: [i128; 3], depth: bool| {
            let (x, y) = (i128::from(x0), i128::from(y0));
            let (across, down) = match self.slip {
                EngineSlip::CornerSwapped if depth => (y, x),
                EngineSlip::CornerFlat if !depth => (x, 0),
                EngineSlip::DepthToTheRight if depth => (x + 1, y),
                _ => (x, y),
            };
            value.wrapping_add(dx.wrapping_mul(across)).wrapping_add(dy.wrapping_mul(down))
        };
        let edge_slip = if let EngineSlip::Edge(slip) = self.slip { Some(slip) } else { None };
        let depth_slip = if let EngineSlip::Depth(slip) = self.slip { Some(slip) } else { None };
        let triple = |k: usize| [words[k], words[k + 1], words[k + 2]];
        let mut edges = [0, 3, 6].map(|k| {
            let [e, a, b] = triple(k);
            Plane::new(edge_slip, self.edge_width, [e, a, b], corner([e, a, b], false), [a, b])
        });
        let mut plane = self.read.map(|read| {
            let [z, dx, dy] = triple(9);
            let run = if self.slip == EngineSlip::DepthStepsDown { [dy, dx] } else { [dx, dy] };
            Plane::new(depth_slip, read.width(), [z, dx, dy], corner([z, dx, dy], true), run)
        });
        let right = x1 - u32::from(self.slip == EngineSlip::LastColumn);
        let rows = if self.slip == EngineSlip::LastRow { (y1 - y0 - 1).max(1) } else { y1 - y0 };
        for y in y0..y0 + rows {
            let mut first = None;
            for x in x0..=right {
                let covered = x < right && self.covers(&edges);
                if covered {
                    first.get_or_insert(x);
                    answer.samples += 1;
                    if let (Some(plane), Some(read)) = (&plane, self.read) {
                        answer.depths.push((x, y, self.value(read, plane.run.pattern)));
                    }
                } else if let Some(first) = first.take() {
                    answer.spans.push(Span { y, x0: first, x1: x });
                }
                edges.iter_mut().chain(&mut plane).for_each(Plane::right);
            }
            for edge in &mut edges {
                edge.down(self.slip == EngineSlip::EdgeRowAbove);
            }
            if let Some(plane) = &mut plane {
                plane.down(self.slip == EngineSlip::DepthRowAbove);
            }
        }
        self.number(&mut answer);
        answer
    }

    fn covers(&self, edges: &[Plane; 3]) -> bool {
        let sign = if let EngineSlip::Sign(slip) = self.slip { Some(slip) } else { None };
        let inside = |edge: &Plane| SignSlip::inside(sign, self.edge_width, edge.run.pattern);
        match self.slip {
            EngineSlip::AnyEdge => edges.iter().any(inside),
            EngineSlip::EdgeUnseen(n) => {
                edges.iter().enumerate().all(|(k, edge)| k == n || inside(edge))
            }
            _ => edges.iter().all(inside),
        }
    }

    fn value(&self, read: ReadOut, pattern: u128) -> u64 {
        match self.slip {
            EngineSlip::Read(slip) => slip.read(read, pattern),
            _ => read.read(pattern.cast_signed()),
        }
    }

    /// Slips of numbers alone.
    fn number(&self, answer: &mut Answer) {
        match self.slip {
            EngineSlip::ColumnsLate => {
                for span in &mut answer.spans {
                    (span.x0, span.x1) = (span.x0 + 1, span.x1 + 1);
                }
                answer.depths.iter_mut().for_each(|(x, _, _)| *x += 1);
            }
            EngineSlip::LeftEndLate => answer.spans.iter_mut().for_each(|span| span.x0 += 1),
            _ => {}
        }
    }
}
