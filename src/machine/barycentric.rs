//! Barycentric evaluation: an approximate edge walk finds candidates, edge functions make the mask,
//! and two barycentric coordinates, walked on the sample grid, weigh the vertex values at every
//! fragment. Spec clauses `A-2` and `A-6`.

mod carry;
mod form;

pub(super) use form::KIND;

use super::edge_function::{edge_columns, setup_words};
use super::painter::{accumulated_span, drawable};
use super::{Carrier, DrawError, EdgeFunction, Input, Machine, Ports, Sink, Target, Work};
use crate::bits::Rounding;
use crate::cover::{EdgeWordConfig, EdgeWordError, SampleGrid};
use crate::dda::Processor;
use crate::format::{ReadOut, Role, Unreduced, WordFormat};
use crate::setup::{Division, Gradient, Plane, Triangle, VertexConfig};
use crate::value::Depth;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of `[form.barycentric]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct BarycentricConfig {
    /// Fraction bits below the pixel of the approximate edge walk; more leave fewer candidates.
    pub walk_fraction: u32,
    /// Fraction bits of a barycentric coordinate.
    pub coordinate: u32,
    /// Rounding of a coordinate's start and slopes.
    pub rounding: Rounding,
    /// The edge words that decide coverage.
    pub edge: EdgeWordConfig,
}

/// A barycentric machine that cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BarycentricError {
    /// The edge words.
    #[error(transparent)]
    Edge(#[from] EdgeWordError),
    /// A coordinate outgrows 128-bit arithmetic.
    #[error(
        "2 * vertex difference bits + 4 + coordinate = 2 * {difference} + 4 + {coordinate} > 126: \
         set-up does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
    )]
    Setup {
        /// Bits of a vertex difference.
        difference: u32,
        /// Fraction bits of a coordinate.
        coordinate: u32,
    },
    /// A weighted value outgrows 128-bit arithmetic.
    #[error(
        "coordinate + integer + interpolation + 4 = {coordinate} + {integer} + \
         {interpolation} + 4 > 126: the weighted sum does not fit exact 128-bit arithmetic; use \
         fewer bits in one of these fields"
    )]
    Sum {
        /// Fraction bits of a coordinate.
        coordinate: u32,
        /// Bits of a vertex value.
        integer: u32,
        /// Interpolation bits.
        interpolation: u32,
    },
    /// The walk's fraction.
    #[error("walk-fraction = {0}: the approximate walk has 0 to 40 fraction bits")]
    Walk(u32),
}

impl BarycentricError {
    /// The key that is at fault, from the machine's table.
    const fn field(&self) -> &'static [&'static str] {
        match self {
            Self::Edge(_) => &["edge", "width"],
            Self::Setup { .. } | Self::Sum { .. } => &["coordinate"],
            Self::Walk(_) => &["walk-fraction"],
        }
    }
}

impl BarycentricConfig {
    /// Checks words and growth; `depth` is the depth accumulator's format, if there is one.
    ///
    /// # Errors
    /// [`BarycentricError`] names the violated inequality.
    pub fn validate(
        &self,
        vertex: &VertexConfig,
        depth: Option<ReadOut>,
    ) -> Result<(), BarycentricError> {
        let (difference, coordinate) = (vertex.difference_bits(), self.coordinate);
        self.edge.validate()?;
        if self.walk_fraction > 40 {
            return Err(BarycentricError::Walk(self.walk_fraction));
        }
        if u64::from(2 * difference + 4) + u64::from(coordinate) > 126 {
            return Err(BarycentricError::Setup { difference, coordinate });
        }
        match depth.map(|read| (read.integer(), read.fraction())) {
            Some((integer, interpolation)) if coordinate + integer + interpolation + 4 > 126 => {
                Err(BarycentricError::Sum { coordinate, integer, interpolation })
            }
            _ => Ok(()),
        }
    }

    /// Bits of a coordinate's accumulator: a sign, the 1 that a vertex reaches, and the fraction.
    pub const fn coordinate_width(&self) -> u32 {
        self.coordinate + 2
    }

    /// A coordinate as a planar DDA: the share of vertex `n`, rounded once at its start and slopes.
    fn share(&self, triangle: &Triangle, n: usize, grid: &SampleGrid) -> Plane {
        let mut weight = [0; 3];
        weight[n] = 1;
        let gradient = Gradient::new(triangle, weight);
        let (bits, rounding) = (self.coordinate, self.rounding);
        grid.plane(&gradient, bits, rounding, Division::Quotient)
    }
}

/// Candidates by a walk, coverage by edge functions, values by barycentric coordinates.
#[derive(Clone, Debug)]
pub struct Barycentric {
    config: BarycentricConfig,
    mask: EdgeFunction,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

/// Two coordinates and the values they weigh.
#[derive(Clone, Copy, Debug)]
struct Weighted {
    shares: [Plane; 2],
    base: i128,
    rise: [i128; 2],
    /// Bits of the values below the binary point.
    scale: u32,
    /// Bits of the accumulator below it, and what it gains.
    fraction: u32,
    gain: i128,
}

impl Weighted {
    /// Values at the vertices, weighed.
    fn new(
        shares: [Plane; 2],
        [base, one, two]: [i128; 3],
        scale: u32,
        (fraction, gain): (u32, i128),
    ) -> Self {
        Self { shares, base, rise: [one - base, two - base], scale, fraction, gain }
    }

    /// The accumulator at a pixel, unwrapped: the weighted sum, its fraction cut to that of the
    /// read-out.
    fn at(&self, config: &BarycentricConfig, x: u32, y: u32) -> i128 {
        let width = config.coordinate_width();
        let mut sum = self.base << config.coordinate;
        for (share, rise) in self.shares.iter().zip(self.rise) {
            // The word of the DDA: mod 2^(C+2), signed.
            let word =
                share.at(i128::from(x), i128::from(y)).raw() << (128 - width) >> (128 - width);
            sum += word * rise;
        }
        let (below, fraction) = (config.coordinate + self.scale, self.fraction);
        let cut =
            if below >= fraction { sum >> (below - fraction) } else { sum << (fraction - below) };
        cut + self.gain
    }
}

impl Barycentric {
    /// A machine of validated parts.
    pub fn new(
        config: BarycentricConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
        processor: Processor,
    ) -> Self {
        let mut setup = edge_columns(config.edge, vertex);
        let read = depth.map(|depth| depth.read_out());
        if let Some(read) = read {
            let share = WordFormat::signed(config.coordinate_width()).fraction(config.coordinate);
            let rise = WordFormat::signed(read.integer() + 1);
            for n in 1..3 {
                let roles = [Role::SHARE_INIT, Role::SHARE_DX, Role::SHARE_DY];
                setup.extend(roles.map(|role| role.of(n, share)));
            }
            setup.push(Role::DEPTH_BASE.column(rise));
            setup.extend([1, 2].map(|n| Role::DEPTH_RISE.of(n, rise)));
        }
        let ports = Ports::valued(vertex, setup, depth);
        let mask = EdgeFunction::new(config.edge, None, vertex, target, processor);
        Self { config, mask, depth, target, ports }
    }

    fn shares(&self, triangle: &Triangle, grid: &SampleGrid) -> [Plane; 2] {
        [1, 2].map(|n| self.config.share(triangle, n, grid))
    }

    fn weighted(&self, triangle: &Triangle) -> Option<(Depth, Weighted)> {
        let (depth, z) = self.depth.zip(triangle.z)?;
        let shares = self.shares(triangle, &self.target.grid);
        let gain = depth.gain(triangle, z, &self.target.grid);
        let format = (depth.read_out().fraction(), gain);
        Some((depth, Weighted::new(shares, z, 0, format)))
    }

    fn words(&self, triangle: &Triangle, weighted: Option<Weighted>) -> Vec<Unreduced> {
        let mut words = setup_words(&self.config.edge.words(triangle, &self.target.grid));
        if self.depth.is_some() {
            let none = [Plane::zero(self.config.coordinate); 2];
            for share in weighted.map_or(none, |weighted| weighted.shares) {
                words.extend(share.values());
            }
            let codes = weighted.map_or([0; 3], |w| [w.base, w.rise[0], w.rise[1]]);
            words.extend(codes.map(|code| Unreduced::new(code, 0)));
        }
        words
    }

    /// The walk of one side: where its x lies at a row, from below and from above, in
    /// 2^-walk-fraction pixels. Both floors fall short by less than a unit a row.
    fn side(&self, from: [i128; 2], to: [i128; 2]) -> Option<Candidate> {
        let (top, bottom) = if to[1] < from[1] { (to, from) } else { (from, to) };
        let (grid, bits) = (&self.target.grid, self.config.walk_fraction);
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        let (first, end) = grid.pixels(1, (top[1], bottom[1] - 1));
        if first >= end {
            return None;
        }
        let below = grid.position(0, first)[1] - top[1];
        let start = ((top[0] * dy + below * dx) << bits).div_euclid(dy << grid.sub_pixel);
        Some(Candidate { first, end, start, slope: (dx << bits).div_euclid(dy) })
    }

    /// The pixels `[x0, x1)` of a row that may be covered.
    fn candidates(&self, sides: &[Candidate], row: i128) -> Option<(i128, i128)> {
        let (grid, bits) = (&self.target.grid, self.config.walk_fraction);
        let mut reach: Option<(i128, i128)> = None;
        for side in sides.iter().filter(|side| (side.first..side.end).contains(&row)) {
            let down = row - side.first;
            let low = side.start + side.slope * down;
            let high = low + down + 1;
            // The first pixel whose sample is not left of `low`, and one past the last whose
            // sample is not right of `high`.
            let sample = |x: i128| (x << grid.sub_pixel) - (grid.offset[0] << bits);
            let (x0, x1) = (
                -(-sample(low) >> (bits + grid.sub_pixel)),
                (sample(high) >> (bits + grid.sub_pixel)) + 1,
            );
            reach = Some(reach.map_or((x0, x1), |(a, b)| (a.min(x0), b.max(x1))));
        }
        reach
    }
}

/// An approximately walked side.
struct Candidate {
    first: i128,
    end: i128,
    start: i128,
    slope: i128,
}

impl Machine for Barycentric {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(self)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(input.triangle()?, out) else { return Ok(()) };
        let weighted = self.weighted(&triangle);
        if out.wants_setup() {
            out.setup(&self.words(&triangle, weighted.map(|(_, weighted)| weighted)));
        }
        let words = self.config.edge.words(&triangle, &self.target.grid);
        let v = triangle.xy;
        let sides: Vec<Candidate> =
            (0..3).filter_map(|k| self.side(v[k], v[(k + 1) % 3])).collect();
        let [_, y0, _, y1] = self.target.bounds(&triangle);
        let (mut work, mut values) = (Work::default(), Vec::new());
        for y in y0..y1 {
            let Some(reach) = self.candidates(&sides, i128::from(y)) else { continue };
            let (x0, x1) = self.target.clip.clip(0, reach);
            work.rows += 1;
            work.visits += u64::from(x1 - x0);
            self.mask.runs(&words, [x0, y, x1, y + 1], &mut |y, x0, x1| {
                let Some((depth, weighted)) = &weighted else {
                    out.span(y, x0, x1, &[]);
                    return Ok(());
                };
                values.clear();
                values.extend((x0..x1).map(|x| weighted.at(&self.config, x, y)));
                accumulated_span(depth, (y, x0), &values, out)
            })?;
        }
        work.steps = work.visits;
        out.work(&work);
        Ok(())
    }
}
