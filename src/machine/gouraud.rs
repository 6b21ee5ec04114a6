//! The two-stage DDA of Gouraud shading: x and depth walk down the edges, depth walks along the
//! span between them. Draws quadrilaterals and other polygons, too. Spec clauses `A-2` and `A-3`.

mod carry;
mod form;

pub use form::GouraudConfig;
pub(super) use form::KIND;

use super::edge_walk::beyond;
use super::painter::{accumulated_span, drawable};
use super::{
    Carrier, DrawError, EdgeWalkConfig, Input, Machine, Ports, Sink, Target, WalkedEdge, Work,
};
use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::format::{ReadOut, Role, Unreduced, WordFormat};
use crate::setup::{Polygon, Triangle, VertexConfig};
use crate::value::Depth;

/// The machine of `[form.gouraud]`.
#[derive(Clone, Debug)]
pub struct Gouraud {
    config: EdgeWalkConfig,
    word: ReadOut,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

/// One edge as walked: x, and depth at its first row and its change a row.
#[derive(Clone, Copy, Debug)]
struct Edge {
    x: WalkedEdge,
    depth: Option<[i128; 2]>,
}

impl Gouraud {
    /// A machine of validated parts; `word` is what [`EdgeWalkConfig::validate`] returned.
    pub fn new(
        config: EdgeWalkConfig,
        word: ReadOut,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let read = depth.map(|depth| depth.read_out());
        let setup = (0..3)
            .flat_map(|k| {
                let depth = read.map(|read| {
                    let word = WordFormat::signed(read.width()).fraction(read.fraction());
                    [Role::EDGE_DEPTH_INIT, Role::EDGE_DEPTH_DY].map(|role| role.of(k, word))
                });
                config.columns(word, k).into_iter().chain(depth.into_iter().flatten())
            })
            .collect();
        Self { config, word, depth, target, ports: Ports::valued(vertex, setup, depth) }
    }

    /// An edge whose depth gains so much.
    fn edge(&self, ends: [[i128; 2]; 2], z: Option<[i128; 2]>, gain: i128) -> Option<Edge> {
        let x = self.config.edge(ends[0], ends[1], &self.target.grid)?;
        let depth = self.depth.zip(z).map(|(depth, z)| {
            let (rounding, fraction) = (depth.config().rounding, depth.read_out().fraction());
            let [start, slope] = descend(&self.target.grid, &x, ends, (z, 0), (rounding, fraction));
            [start + gain, slope]
        });
        Some(Edge { x, depth })
    }

    /// The spans of a row between its cuts, left to right, odd to even.
    fn row(
        &self,
        y: u32,
        edges: &[Edge],
        cuts: &mut Vec<(i128, i128)>,
        out: &mut dyn Sink,
    ) -> Result<u64, DrawError> {
        let row = i128::from(y);
        cuts.clear();
        let ((low, limit), mut wraps) = (self.word.range(), false);
        let crossed = edges.iter().filter(|edge| (edge.x.first_row..edge.x.end_row).contains(&row));
        cuts.extend(crossed.map(|edge| {
            let down = row - edge.x.first_row;
            let x = edge.x.start + edge.x.slope * down;
            wraps |= !(low..limit).contains(&x);
            (self.word.reduce(x), edge.depth.map_or(0, |[start, slope]| start + slope * down))
        }));
        if wraps {
            let crossed = edges.iter().filter(|e| (e.x.first_row..e.x.end_row).contains(&row));
            let ends = crossed.map(|edge| edge.x.start + edge.x.slope * (row - edge.x.first_row));
            beyond(self.word, y, &ends.collect::<Vec<_>>(), out)?;
        }
        cuts.sort_unstable();
        let has_depth = edges.iter().any(|edge| edge.depth.is_some());
        let grid = &self.target.grid;
        let mut covered = 0;
        for pair in cuts.chunks_exact(2) {
            let (left, right) = (pair[0], pair[1]);
            let ends = (self.config.pixel(left.0, grid), self.config.pixel(right.0, grid));
            let (x0, x1) = self.target.clip.clip(0, ends);
            if x0 >= x1 {
                continue;
            }
            covered += u64::from(x1 - x0);
            match self.depth.filter(|_| has_depth) {
                Some(depth) => self.span(&depth, y, [x0, x1], [left, right], out)?,
                None => out.span(y, x0, x1, &[]),
            }
        }
        Ok(covered)
    }

    /// Depth along a span: the slope from its two ends, once a span; the first sample lies a part
    /// of a pixel inside, and from there on it is one addition a pixel.
    fn span(
        &self,
        depth: &Depth,
        y: u32,
        [x0, x1]: [u32; 2],
        [left, right]: [(i128, i128); 2],
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        let [first, slope] = self.along(depth.config().rounding, x0, [left, right]);
        let values: Vec<i128> = (0..i128::from(x1 - x0)).map(|n| first + slope * n).collect();
        accumulated_span(depth, (y, x0), &values, out)
    }

    /// The value at the sample of column x0 of a span between two cuts, and its slope along the span: each
    /// rounded once.
    fn along(&self, rounding: Rounding, x0: u32, [left, right]: [(i128, i128); 2]) -> [i128; 2] {
        let (grid, fraction) = (&self.target.grid, self.config.fraction);
        // A span with a sample has a width.
        let slope = quotient(rounding, (right.1 - left.1) << fraction, right.0 - left.0);
        let sample = grid.position(i128::from(x0), 0)[0];
        let inside = (sample << fraction) - (left.0 << grid.sub_pixel);
        let (adjusted, _) = rounding.shift_right(slope * inside, fraction + grid.sub_pixel);
        [left.1 + adjusted, slope]
    }

    fn walk(
        &self,
        edges: &[Edge],
        extent: (i128, i128),
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        let (y0, y1) = self.target.clip.clip(1, self.target.grid.pixels(1, extent));
        let (mut work, mut cuts) = (Work::default(), Vec::new());
        for y in y0..y1 {
            work.visits += self.row(y, edges, &mut cuts, out)?;
        }
        work.rows = u64::from(y1 - y0);
        work.steps = work.visits;
        out.work(&work);
        Ok(())
    }

    fn triangle(&self, triangle: &Triangle, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(triangle, out) else { return Ok(()) };
        let (v, z) = (triangle.xy, triangle.z);
        let valued = self.depth.zip(z);
        let gain = valued.map_or(0, |(depth, z)| depth.gain(&triangle, z, &self.target.grid));
        let edges: [Option<Edge>; 3] = std::array::from_fn(|k| {
            let next = (k + 1) % 3;
            self.edge([v[k], v[next]], z.map(|z| [z[k], z[next]]), gain)
        });
        let words = edges.iter().flat_map(|edge| {
            let x = self.config.values(edge.as_ref().map(|edge| &edge.x));
            let z = edge.and_then(|edge| edge.depth).unwrap_or_default();
            let z = self.depth.iter().flat_map(move |depth| {
                z.map(|raw| Unreduced::new(raw, depth.read_out().fraction()))
            });
            x.into_iter().chain(z)
        });
        if out.wants_setup() {
            out.setup(&words.collect::<Vec<_>>());
        }
        let edges: Vec<Edge> = edges.into_iter().flatten().collect();
        self.walk(&edges, triangle.extent(1), out)
    }

    fn polygon(&self, polygon: &Polygon, out: &mut dyn Sink) -> Result<(), DrawError> {
        if self.depth.is_some_and(|depth| depth.config().bias.is_some()) && polygon.z.is_some() {
            return Err(DrawError::PolygonBias);
        }
        let gain = self.depth.map_or(0, |depth| depth.start_bias());
        let edges: Vec<Edge> =
            polygon.edges().filter_map(|(ends, z)| self.edge(ends, z, gain)).collect();
        self.walk(&edges, polygon.extent(1), out)
    }
}

/// A value walked down an edge: at its first row, and its change a row, each rounded once to the fraction.
/// The values of the two ends have so many bits below the binary point.
fn descend(
    grid: &SampleGrid,
    x: &WalkedEdge,
    [from, to]: [[i128; 2]; 2],
    ([z0, z1], scale): ([i128; 2], u32),
    (rounding, fraction): (Rounding, u32),
) -> [i128; 2] {
    // Upward edges are walked down from their other end.
    let (top, height, z, rise) = if x.left {
        (to[1], from[1] - to[1], z1, z0 - z1)
    } else {
        (from[1], to[1] - from[1], z0, z1 - z0)
    };
    let below = grid.position(0, x.first_row)[1] - top;
    let whole = height << scale;
    [
        quotient(rounding, (z * height + below * rise) << fraction, whole),
        quotient(rounding, rise << (fraction + grid.sub_pixel), whole),
    ]
}

/// A quotient by what an earlier clause keeps from being zero.
fn quotient(rounding: Rounding, numerator: i128, denominator: i128) -> i128 {
    rounding.divide(numerator, denominator).map_or(0, |(quotient, _)| quotient)
}

impl Machine for Gouraud {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(self)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        match input {
            Input::Polygon(polygon) => self.polygon(polygon, out),
            other => self.triangle(other.triangle()?, out),
        }
    }
}
