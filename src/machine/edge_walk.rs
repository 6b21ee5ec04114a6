//! The slope-form edge walk: an x DDA down each edge. Measurably inexact, and kept for that.
//! Spec clauses `K-1` to `K-5`.

mod form;

pub(super) use form::KIND;

use super::carry::Planes;
use super::painter::{Painter, drawable, report};
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::bits::{Event, Place, Rounding, SpanEvents, Status, bounded};
use crate::cover::SampleGrid;
use crate::format::{Clamp, Column, ReadOut, ReadOutError, Role, Unreduced, WordFormat};
use crate::setup::VertexConfig;
use crate::value::Depth;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The x word of a walked edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct EdgeWalkConfig {
    /// Guard bits above the integer bits of x.
    pub guard: u32,
    /// Integer bits of x.
    pub integer: u32,
    /// Fraction bits of x below the pixel: sub-pixel and interpolation bits together.
    pub fraction: u32,
    /// Rounding of the start and of the slope.
    pub rounding: Rounding,
    /// What a word stands for: `guard`, `sign` (two's complement), `wrap` (no sign), or `error`.
    #[serde(default = "guard", skip_serializing_if = "is_guard")]
    pub clamp: Clamp,
}

const fn guard() -> Clamp {
    Clamp::Guard
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "what serde calls")]
fn is_guard(clamp: &Clamp) -> bool {
    *clamp == Clamp::Guard
}

/// An edge word that cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EdgeWalkError {
    /// The word is malformed.
    #[error(transparent)]
    Word(#[from] ReadOutError),
    /// An x is not written back.
    #[error(
        "clamp = \"saturate\": x of an edge is never written back; write guard, sign (two's complement), wrap or \
         error"
    )]
    Sticky,
    /// Comparing x with a sample outgrows 128-bit arithmetic.
    #[error(
        "guard + integer + fraction + sub-pixel = {guard} + {integer} + {fraction} + {sub_pixel} > 126: \
         comparing x with a sample does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
    )]
    Compare {
        /// Guard bits.
        guard: u32,
        /// Integer bits.
        integer: u32,
        /// Fraction bits of x.
        fraction: u32,
        /// Sub-pixel bits of the vertex field.
        sub_pixel: u32,
    },
    /// Depth along a span outgrows 128-bit arithmetic.
    #[error(
        "depth integer + interpolation + fraction + sub-pixel + 2 = {integer} + {interpolation} + \
         {fraction} + {sub_pixel} + 2 > 126: depth along a span does not fit exact 128-bit \
         arithmetic; use fewer bits in one of these fields"
    )]
    Values {
        /// Depth bits.
        integer: u32,
        /// Interpolation bits of depth.
        interpolation: u32,
        /// Fraction bits of x.
        fraction: u32,
        /// Sub-pixel bits of the vertex field.
        sub_pixel: u32,
    },
    /// The exact numerators outgrow 128-bit arithmetic.
    #[error(
        "2 * vertex difference bits + 2 + fraction = 2 * {difference} + 2 + {fraction} > 126: \
         set-up does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
    )]
    Growth {
        /// Bits of a vertex difference.
        difference: u32,
        /// Fraction bits of x.
        fraction: u32,
    },
}

/// One edge as walked: x at the first row, the change per row, and the rows, unreduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WalkedEdge {
    /// x at the first row, in 2^-fraction pixels.
    pub start: i128,
    /// Change of x per row.
    pub slope: i128,
    /// First row whose sample is at or below the upper end.
    pub first_row: i128,
    /// One past the last row whose sample is above the lower end.
    pub end_row: i128,
    /// Whether the edge bounds the triangle on its left.
    pub left: bool,
}

impl WalkedEdge {
    /// Start, slope and rows, as set-up words.
    pub const fn words(&self) -> [i128; 4] {
        [self.start, self.slope, self.first_row, self.end_row]
    }
}

impl EdgeWalkConfig {
    /// The set-up values of an edge, zeros for an edge that crosses no row: x at its first row and its
    /// change a row in pixels, the first row and the row past the last.
    pub fn values(&self, edge: Option<&WalkedEdge>) -> [Unreduced; 4] {
        let [start, slope, first, end] = edge.map_or([0; 4], WalkedEdge::words);
        let x = |raw| Unreduced::new(raw, self.fraction);
        [x(start), x(slope), Unreduced::new(first, 0), Unreduced::new(end, 0)]
    }

    /// Checks the word and its growth.
    ///
    /// # Errors
    /// [`EdgeWalkError`] names the violated inequality.
    pub fn validate(&self, vertex: &VertexConfig) -> Result<ReadOut, EdgeWalkError> {
        let (difference, fraction) = (vertex.difference_bits(), self.fraction);
        let read = ReadOut::new(self.guard, self.integer, fraction, self.clamp)?;
        if self.clamp == Clamp::Saturate {
            return Err(EdgeWalkError::Sticky);
        }
        let (guard, integer, sub_pixel) = (self.guard, self.integer, vertex.sub_pixel);
        if read.width() + sub_pixel > 126 {
            return Err(EdgeWalkError::Compare { guard, integer, fraction, sub_pixel });
        }
        if 2 * difference + 2 + fraction > 126 {
            return Err(EdgeWalkError::Growth { difference, fraction });
        }
        Ok(read)
    }

    /// Checks the growth of depth walked between walked edges, for a depth accumulator of this
    /// format.
    ///
    /// # Errors
    /// [`EdgeWalkError::Values`] with the violated inequality.
    pub fn validate_values(
        &self,
        vertex: &VertexConfig,
        depth: Option<ReadOut>,
    ) -> Result<(), EdgeWalkError> {
        let Some(read) = depth else { return Ok(()) };
        let (integer, interpolation) = (read.integer(), read.fraction());
        let (fraction, sub_pixel) = (self.fraction, vertex.sub_pixel);
        if integer + interpolation + fraction + sub_pixel + 2 > 126 {
            return Err(EdgeWalkError::Values { integer, interpolation, fraction, sub_pixel });
        }
        Ok(())
    }

    /// Set-up of the edge from `from` to `to` of a normalised triangle: the exact x at its first
    /// row, rounded once, and the slope, rounded once. `None` for an edge that crosses no row.
    pub fn edge(&self, from: [i128; 2], to: [i128; 2], grid: &SampleGrid) -> Option<WalkedEdge> {
        // Edges run top to bottom; upward ones bound the triangle on the left.
        let left = to[1] < from[1];
        let (top, bottom) = if left { (to, from) } else { (from, to) };
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        // Half-open in y: a sample on the upper end belongs to the edge, on the lower end not.
        let (first_row, end_row) = grid.pixels(1, (top[1], bottom[1] - 1));
        if first_row >= end_row {
            return None;
        }
        let below_top = grid.position(0, first_row)[1] - top[1];
        let divide = |numerator, denominator| {
            self.rounding
                .divide(numerator, denominator)
                .unwrap_or_else(|| unreachable!("an edge that crosses a row has a height"))
                .0
        };
        let start = divide((top[0] * dy + below_top * dx) << self.fraction, dy << grid.sub_pixel);
        let slope = divide(dx << self.fraction, dy);
        Some(WalkedEdge { start, slope, first_row, end_row, left })
    }

    /// The set-up columns of edge `k`, in the order of [`WalkedEdge::words`].
    pub(super) fn columns(&self, word: ReadOut, k: usize) -> [Column; 4] {
        let x = WordFormat::signed(word.width()).fraction(self.fraction);
        let row = WordFormat::signed(34);
        [
            Role::EDGE_X_INIT.of(k, x),
            Role::EDGE_X_DY.of(k, x),
            Role::EDGE_Y_BEGIN.of(k, row),
            Role::EDGE_Y_END.of(k, row),
        ]
    }

    /// The first pixel whose sample is not left of `x` (in 2^-fraction pixels): `ceil(x - 1/2)`
    /// for samples at pixel centres.
    pub fn pixel(&self, x: i128, grid: &SampleGrid) -> i128 {
        // Both offsets over a common denominator of 2^(fraction + s).
        let scaled = (x << grid.sub_pixel) - (grid.offset[0] << self.fraction);
        -(-scaled >> (self.fraction + grid.sub_pixel))
    }
}

/// The machine of `[form.edge-walk]`.
#[derive(Clone, Debug)]
pub struct EdgeWalk {
    config: EdgeWalkConfig,
    word: ReadOut,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

impl EdgeWalk {
    /// A machine of validated parts; `word` is what [`EdgeWalkConfig::validate`] returned.
    pub fn new(
        config: EdgeWalkConfig,
        word: ReadOut,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let setup = (0..3).flat_map(|k| config.columns(word, k)).collect();
        let ports = Ports::triangle(vertex, setup, depth);
        Self { config, word, depth, target, ports }
    }
}

/// Reports the ends of a row whose x leaves its word: each is a wrap. Spec clauses `K-3` and `V-2`.
pub(super) fn beyond(
    word: ReadOut,
    y: u32,
    ends: &[i128],
    out: &mut dyn Sink,
) -> Result<(), DrawError> {
    let (lowest, limit) = word.range();
    if ends.iter().all(|x| (lowest..limit).contains(x)) {
        return Ok(());
    }
    let mut events = SpanEvents::default();
    for x in ends {
        let wraps = Status::when(Event::Wrap, !(lowest..limit).contains(x));
        let place = Place { y: i64::from(y), x: bounded(x >> word.fraction()) };
        events.note(place, wraps, *x);
    }
    report(word, events, out)
}

impl Machine for EdgeWalk {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(input.triangle()?, out) else { return Ok(()) };
        let Target { grid, clip, .. } = self.target;
        let v = triangle.xy;
        let edges: [Option<WalkedEdge>; 3] =
            std::array::from_fn(|k| self.config.edge(v[k], v[(k + 1) % 3], &grid));
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        let values = || edges.iter().flat_map(|edge| self.config.values(edge.as_ref())).collect();
        painter.announce(values, out);
        let (y0, y1) = clip.clip(1, grid.pixels(1, triangle.extent(1)));
        let mut visits = 0;
        for y in y0..y1 {
            let row = i128::from(y);
            let side = |left| {
                let edge = edges.iter().flatten().find(|edge| {
                    edge.left == left && (edge.first_row..edge.end_row).contains(&row)
                })?;
                Some(edge.start + edge.slope * (row - edge.first_row))
            };
            let (Some(left), Some(right)) = (side(true), side(false)) else { continue };
            beyond(self.word, y, &[left, right], out)?;
            let [left, right] =
                [left, right].map(|x| self.config.pixel(self.word.reduce(x), &grid));
            let (x0, x1) = clip.clip(0, (left, right));
            if x0 < x1 {
                visits += u64::from(x1 - x0);
                painter.span(y, x0, x1, out)?;
            }
        }
        out.work(&Work { rows: u64::from(y1 - y0), visits, steps: visits, tiles: 0 });
        Ok(())
    }
}
