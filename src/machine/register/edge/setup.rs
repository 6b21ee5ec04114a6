//! From register words to edge words, a box, and the engine at work. Spec clauses `RE-1` to `RE-4`.

use super::EdgeEngineConfig;
use super::cover::{Cover, Edge, Exact, fold};
use super::linear::Values;
use super::order::{Bounds, visit};
use super::part::{EdgeOrder, EdgeRule, EdgeSense, EdgeSource, Origin, Winding, WithoutArea};
use super::wire::{EdgeWires, Wires};
use crate::format::Gather;
use crate::machine::Target;
use crate::machine::register::Engine;
use crate::setup::Triangle;
use crate::value::Channel;

#[derive(Clone, Debug)]
pub(super) struct EdgeFunctions {
    pub(super) config: EdgeEngineConfig,
    pub(super) wires: Wires,
    pub(super) channels: Vec<Channel>,
    pub(super) target: Target,
    pub(super) signed: bool,
}

/// The vertices of a triangle as they are set up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    /// In sub-pixels.
    pub(super) xy: [[i64; 2]; 3],
    /// Which of the registers each came from.
    pub(super) from: [usize; 3],
    /// The edge word of v0 v1 at v2.
    pub(super) area: i64,
    /// 1, or -1 where words are positive inside of a negative area.
    pub(super) sign: i64,
    /// Places that an edge word is short of sub-pixels squared.
    pub(super) cut: u32,
}

/// A triangle ready to be drawn.
struct Job {
    cover: Cover,
    bounds: Bounds,
    corners: Option<Corners>,
}

impl EdgeFunctions {
    /// The edge from vertex p to vertex q. Clause `RE-1`.
    fn edge(&self, p: [i64; 2], q: [i64; 2]) -> Exact {
        let EdgeSource::Vertices { sense, product_cut, cut } = self.config.edges else {
            unreachable!("edges are of vertices");
        };
        Exact {
            from: p.map(i128::from),
            delta: [0, 1].map(|axis| i128::from(q[axis]) - i128::from(p[axis])),
            sign: if sense == EdgeSense::Positive { 1 } else { -1 },
            cuts: [product_cut, cut],
            grid: self.target.grid,
        }
    }

    /// Vertices, the other winding turned where the profile says so. Clause `RE-3`.
    fn corners(&self, words: &[u32], wires: &[[Gather; 2]; 3]) -> Option<Corners> {
        let read = |gather: &Gather| {
            if self.signed { gather.signed(words) } else { gather.unsigned(words).cast_signed() }
        };
        let given = wires.each_ref().map(|vertex| vertex.each_ref().map(read));
        let in_order = |from: [usize; 3]| {
            let xy = from.map(|n| given[n]);
            let edge = self.edge(xy[0], xy[1]);
            let area = fold(edge.at_sample(xy[2].map(i128::from)), self.config.width);
            let sign = crate::bits::bounded(edge.sign);
            Corners { xy, from, area, sign, cut: edge.cuts[0] + edge.cuts[1] }
        };
        let corners = in_order([0, 1, 2]);
        if corners.area == 0 && self.config.without_area == WithoutArea::Skip {
            return None;
        }
        let swaps = self.config.winding == Winding::Swap && corners.area < 0;
        Some(if swaps { in_order([0, 2, 1]) } else { corners })
    }

    /// Whether an edge of these changes to the right and down owns what lies on it. Clause `RE-4`.
    fn owns(&self, [right, down]: [i128; 2]) -> bool {
        match self.config.rule {
            EdgeRule::TopLeft => right > 0 || right == 0 && down > 0,
            EdgeRule::TopRight => right < 0 || right == 0 && down > 0,
            EdgeRule::BottomLeft => right > 0 || right == 0 && down < 0,
            EdgeRule::BottomRight => right < 0 || right == 0 && down < 0,
            EdgeRule::Both | EdgeRule::Strict | EdgeRule::TruncatedSide => true,
        }
    }

    /// Whether the third vertex lies above a flat edge, or left of another one by a truncating division.
    fn is_truncated_side(&self, [p, q, third]: [[i64; 2]; 3]) -> bool {
        let delta = |axis: usize| i128::from(q[axis]) - i128::from(p[axis]);
        let held = |value: i128| i128::from(fold(value, self.config.width));
        let height = held(delta(1));
        if height == 0 {
            return third[1] < p[1];
        }
        let product = held(delta(0) * (i128::from(third[1]) - i128::from(p[1])));
        i128::from(third[0]) < held(i128::from(p[0]) + product / height)
    }

    fn job(&self, words: &[u32]) -> Option<Job> {
        let (width, winding) = (self.config.width, self.config.winding);
        let corners = match &self.wires.edges {
            EdgeWires::Vertices(wires) => Some(self.corners(words, wires)?),
            EdgeWires::Given(_) => None,
        };
        let vertices = (corners.map(|it| it.xy), self.target.grid.sub_pixel, self.signed);
        let bounds = self.wires.limit.bounds(words, self.config.r#box, vertices);
        let first = [bounds[0], bounds[1]];
        let is_below = corners.is_some_and(|it| it.area < 0);
        let negated = winding == Winding::Negate && is_below;
        let edges = [0, 1, 2].map(|k| match (&self.wires.edges, &corners) {
            (EdgeWires::Vertices(_), Some(corners)) => {
                let edge = self.edge(corners.xy[(k + 1) % 3], corners.xy[(k + 2) % 3]);
                let leans = [-edge.delta[1], edge.delta[0]].map(|delta| edge.sign * delta.signum());
                let (step, exact) = match edge.steps() {
                    Some(step) => (step.map(|step| fold(step, width)), None),
                    None => ([0; 2], Some(edge)),
                };
                let value = fold(edge.at(first), width);
                Edge { origin: first, value, step, exact, leans, negated }
            }
            (EdgeWires::Given(wires), _) => {
                let [value, right, down] =
                    wires[k].each_ref().map(|gather| fold(gather.signed(words).into(), width));
                let EdgeSource::Given { at } = self.config.edges else {
                    unreachable!("edges are given");
                };
                let origin = if at == Origin::Box { first } else { [0; 2] };
                let step = [right, down];
                let leans = step.map(|step| i128::from(step.signum()));
                Edge { origin, value, step, exact: None, leans, negated }
            }
            _ => unreachable!("vertices have been read"),
        });
        let bias = [1, -1].map(|turn| {
            [0, 1, 2].map(|k| {
                let turn = if negated { -turn } else { turn };
                let side = corners.filter(|_| self.config.rule == EdgeRule::TruncatedSide);
                let is_side = side.is_some_and(|it| {
                    self.is_truncated_side([(k + 1) % 3, (k + 2) % 3, k].map(|n: usize| it.xy[n]))
                });
                i64::from(is_side || !self.owns(edges[k].leans.map(|lean| lean * turn)))
            })
        });
        let cover = Cover {
            width,
            edges,
            turned: winding == Winding::Both && is_below,
            either: winding == Winding::Either,
            strict: self.config.rule == EdgeRule::Strict,
            bias,
        };
        Some(Job { cover, bounds, corners })
    }
}

impl Engine for EdgeFunctions {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let Some(Job { cover, bounds, corners }) = self.job(words) else { return };
        let values = Values::new(self, words, [bounds[0], bounds[1]], corners.as_ref());
        let mut record = vec![0; 5 + self.channels.len()];
        visit(&cover, self.config.order, bounds, &mut |at, words| {
            record[..2].copy_from_slice(&at);
            record[2..5].copy_from_slice(&words);
            values.read(&self.channels, at, words, &mut record[5..]);
            emit(0, &record);
        });
    }

    fn work(&self, words: &[u32], _: u64) -> u128 {
        let Some(Job { bounds: [x0, y0, x1, y1], .. }) = self.job(words) else { return 0 };
        // The tiles at both ends of a side can reach beyond it.
        let beyond = match self.config.order {
            EdgeOrder::Tiles { width, height, .. } => {
                [width, height].map(|side| 2 * u128::from(side))
            }
            _ => [0; 2],
        };
        let side = |low: i64, high: i64, beyond: u128| match high.checked_sub(low) {
            Some(1..) => u128::from(high.abs_diff(low)) + beyond,
            _ => beyond,
        };
        side(x0, x1, beyond[0]) * side(y0, y1, beyond[1])
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        self.host_words(triangle, count)
    }
}
