//! The edges of the engine `slopes`: divided from vertices, or given. Spec clauses `RG-11` and `RG-12`.

use super::{NAME, Plane, SlopeConfig, SlopeEdges};
use crate::format::Gather;
use crate::machine::register::input::{Inputs, RegisterError};
use crate::setup::VertexConfig;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which row comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum RowOrder {
    /// The one below.
    Down,
    /// The one above.
    Up,
}

/// What the two counts of rows count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum RowCounts {
    /// The rows of each short edge.
    #[default]
    Each,
    /// The rows of the first short edge, and all rows.
    All,
}

/// Where the registers of the edges lie.
#[derive(Clone, Debug)]
pub(super) struct EdgeInput {
    pub(super) source: Source,
    /// The register that says which way rows run, and what it says of rows to the left.
    pub(super) direction: (Gather, bool),
    pub(super) fraction: u32,
}

#[derive(Clone, Debug)]
pub(super) enum Source {
    Divided {
        vertices: [[Gather; 2]; 3],
        row_bias: i64,
    },
    Given {
        start: [Gather; 2],
        slope: Gather,
        ends: [[Gather; 3]; 2],
        rows: RowOrder,
        counts: RowCounts,
    },
}

/// The edges of a triangle, read.
pub(super) struct Walk {
    /// Whether rows run to the left.
    pub(super) leftward: bool,
    /// x where the first edge starts.
    pub(super) first_x: i32,
    /// The first vertex in sub-pixels, where there are vertices.
    pub(super) vertex: [i64; 2],
    fraction: u32,
    sub_pixel: u32,
    kind: Kind,
}

enum Kind {
    /// Vertices, slopes of AB, AC and BC, and the rows.
    Divided { v: [[i32; 2]; 3], slopes: [i32; 3], rows: [i64; 2] },
    /// x and its step; end x, its step and rows of the lower and the upper end; the first row.
    Given { x: [i32; 2], ends: [(i32, i32, u64); 2], y: i64, down: i64 },
}

impl EdgeInput {
    pub(super) fn new(
        config: &SlopeConfig,
        inputs: &Inputs<'_>,
        vertex: &VertexConfig,
    ) -> Result<Self, RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        let all = |names: [&str; 3]| inputs.all(NAME, names);
        let pair = |names: [&str; 2]| inputs.all(NAME, names);
        let (fraction, source) = match config.edges {
            SlopeEdges::Divided { fraction, row_bias } => {
                if vertex.integer + vertex.sub_pixel > 16 {
                    return Err(fault(format!(
                        "vertex integer + sub-pixel = {} <= 16 is needed for slopes of 32 bits",
                        vertex.integer + vertex.sub_pixel
                    )));
                }
                if !(vertex.sub_pixel.max(1)..=16).contains(&fraction) {
                    return Err(fault(format!(
                        "sub-pixel = {} <= fraction = {fraction} <= 16 is needed",
                        vertex.sub_pixel.max(1)
                    )));
                }
                let vertices = [pair(["xa", "ya"])?, pair(["xb", "yb"])?, pair(["xc", "yc"])?];
                (fraction, Source::Divided { vertices, row_bias: i64::from(row_bias) })
            }
            SlopeEdges::Given { fraction, rows, counts } => {
                if !(1..=24).contains(&fraction) {
                    return Err(fault(format!("1 <= fraction = {fraction} <= 24 is needed")));
                }
                let ends = [
                    all(["end01", "end01_step", "rows01"])?,
                    all(match counts {
                        RowCounts::Each => ["end12", "end12_step", "rows12"],
                        RowCounts::All => ["end12", "end12_step", "rows"],
                    })?,
                ];
                let all_rows = &ends[1][2];
                if counts == RowCounts::All && all_rows.bits() > 32 {
                    let bits = all_rows.bits();
                    return Err(fault(format!("rows has {bits} bits: at most 32 are needed")));
                }
                let start = pair(["x", "y"])?;
                let slope = inputs.need(NAME, "x_step")?;
                (fraction, Source::Given { start, slope, ends, rows, counts })
            }
        };
        if let Plane::AtEdge { fraction: part } = config.plane
            && !(1..=fraction).contains(&part)
        {
            return Err(fault(format!(
                "plane at-edge fraction = {part}: 1 to {fraction} is needed"
            )));
        }
        if config.pixel_bias >= 1 << fraction {
            let bias = config.pixel_bias;
            return Err(fault(format!(
                "pixel-bias = {bias} < 2^fraction = {} is needed",
                1 << fraction
            )));
        }
        let direction = match (inputs.may("leftward"), inputs.may("rightward")) {
            (Some(left), None) => (left, true),
            (None, Some(right)) => (right, false),
            _ => {
                return Err(fault(
                    "exactly one of `leftward` and `rightward` is needed".to_owned(),
                ));
            }
        };
        Ok(Self { source, direction, fraction })
    }

    /// The edges that the words give.
    pub(super) fn walk(&self, words: &[u32], sub_pixel: u32) -> Walk {
        let (direction, says_left) = &self.direction;
        let leftward = (direction.unsigned(words) != 0) == *says_left;
        let read = |gather: &Gather| low(gather.signed(words));
        let fraction = self.fraction;
        match &self.source {
            Source::Divided { vertices, row_bias } => {
                let v = vertices.each_ref().map(|vertex| vertex.each_ref().map(read));
                let slope = |a: [i32; 2], b: [i32; 2]| {
                    // The numerator wraps to 32 bits; a flat edge has no rows.
                    let along = b[0].wrapping_sub(a[0]) << fraction;
                    along.checked_div(b[1].wrapping_sub(a[1])).unwrap_or(0)
                };
                let row = |y: i32| (i64::from(y) + row_bias) >> sub_pixel;
                Walk {
                    leftward,
                    first_x: v[0][0] << (fraction - sub_pixel),
                    vertex: v[0].map(i64::from),
                    fraction,
                    sub_pixel,
                    kind: Kind::Divided {
                        v,
                        slopes: [slope(v[0], v[1]), slope(v[0], v[2]), slope(v[1], v[2])],
                        rows: [row(v[0][1]), row(v[2][1])],
                    },
                }
            }
            Source::Given { start, slope, ends, rows, counts } => {
                let x = [read(&start[0]), read(slope)];
                let bits = ends[1][2].bits();
                let end =
                    |[x, step, rows]: &[Gather; 3]| (read(x), read(step), rows.unsigned(words));
                let y = i64::from(read(&start[1]));
                let down = if *rows == RowOrder::Down { 1 } else { -1 };
                let mut ends = ends.each_ref().map(end);
                if *counts == RowCounts::All {
                    // No rows at all are as many as the counter has states.
                    let all = match ends[1].2 {
                        0 => 1 << bits,
                        all => all,
                    };
                    ends[0].2 = ends[0].2.min(all);
                    ends[1].2 = all - ends[0].2;
                }
                let kind = Kind::Given { x, ends, y, down };
                Walk { leftward, first_x: x[0], vertex: [0; 2], fraction, sub_pixel, kind }
            }
        }
    }
}

/// The low 32 bits.
fn low(value: i64) -> i32 {
    let [a, b, c, d, ..] = value.to_le_bytes();
    i32::from_le_bytes([a, b, c, d])
}

impl Walk {
    /// The pixel of an x: a bias, then the floor.
    pub(super) fn pixel(&self, x: i32, bias: u32) -> i64 {
        i64::from(x.wrapping_add(bias.cast_signed()) >> self.fraction)
    }

    /// How far the first pixel of a row lies from its edge, in 2^-bits pixels: the distance that the
    /// fraction of x - 1 leaves, so that an edge on a pixel is one unit and no whole pixel away.
    pub(super) fn part(&self, x: i32, bits: u32) -> i64 {
        let mask = (1i32 << self.fraction) - 1;
        let fraction = i64::from(x.wrapping_sub(1) & mask) >> (self.fraction - bits);
        if self.leftward { fraction } else { (1 << bits) - fraction }
    }

    /// How many rows there are.
    pub(super) fn count(&self) -> u64 {
        match self.kind {
            Kind::Divided { rows, .. } => (rows[1] - rows[0]).max(0).unsigned_abs(),
            Kind::Given { ends, .. } => ends[0].2.saturating_add(ends[1].2),
        }
    }

    /// Calls `row` with the number of the row from the first, y, and x of both ends.
    pub(super) fn rows(&self, mut row: impl FnMut(i64, i64, i32, i32)) {
        match self.kind {
            Kind::Divided { v: [a, b, _], slopes: [ab, ac, bc], rows } => {
                let s = self.sub_pixel;
                let at = |from: [i32; 2], slope: i32, centre: i32| {
                    let along = slope.wrapping_mul(centre.wrapping_sub(from[1])) >> s;
                    (from[0] << (self.fraction - s)).wrapping_add(along)
                };
                for y in rows[0]..rows[1] {
                    let centre = low((y << s) + (1 << s >> 1));
                    let end = if centre < b[1] { at(a, ab, centre) } else { at(b, bc, centre) };
                    row(y - rows[0], y, at(a, ac, centre), end);
                }
            }
            Kind::Given { x: [mut x, step], ends, mut y, down } => {
                let mut count = 0;
                for (mut end, end_step, rows) in ends {
                    for _ in 0..rows {
                        row(count, y, x, end);
                        x = x.wrapping_add(step);
                        end = end.wrapping_add(end_step);
                        y += down;
                        count += 1;
                    }
                }
            }
        }
    }
}
