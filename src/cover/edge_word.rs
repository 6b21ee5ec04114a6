//! Edge functions as stored words: bias, shift, reduction. Spec clauses `C-4` and `C-5`.

use super::conservative::ConservativeConfig;
use super::rule::FillRule;
use super::sample::SampleGrid;
use crate::bits::Lane;
use crate::dda::Edges;
use crate::format::{Clamp, QFormat, ReadOut, Unreduced};
use crate::setup::{EdgeCoefficients, Triangle, VertexConfig, edges};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How an edge value is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum EdgeStorage {
    /// E plus the rule's bias, in sub-pixels squared.
    Full,
    /// The same shifted right by the sub-pixel bits: samples lie on the pixel grid, so the low
    /// bits never change along a walk.
    Shifted,
}

/// The edge words of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct EdgeWordConfig {
    /// Who owns samples on an edge.
    pub rule: FillRule,
    /// How edge values are kept.
    pub storage: EdgeStorage,
    /// Bits of an edge word; a scene that needs more wraps.
    pub width: u32,
    /// Squares instead of samples; samples when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conservative: Option<ConservativeConfig>,
}

/// An edge word that no lane holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("width = {0}: an edge word has 2 to 120 bits")]
pub struct EdgeWordError(pub u32);

impl EdgeWordConfig {
    /// Checks the word.
    ///
    /// # Errors
    /// [`EdgeWordError`] unless it has 2 to 120 bits.
    pub fn validate(&self) -> Result<(), EdgeWordError> {
        if (2..=120).contains(&self.width) { Ok(()) } else { Err(EdgeWordError(self.width)) }
    }

    /// The word as a read-out: no fraction, no clamp. `None` beyond what a read-out holds.
    pub fn read_out(&self) -> Option<ReadOut> {
        let integer = self.width.min(64);
        ReadOut::new(self.width - integer, integer, 0, Clamp::Wrap).ok()
    }

    /// The width that holds every edge value over a window for vertices of this field, found on
    /// the corners of the box: E is linear in each coordinate. Spec clause `E-5`.
    pub fn exact_width(&self, vertex: &VertexConfig, grid: &SampleGrid, window: (u32, u32)) -> u32 {
        let (low, high) = vertex.range();
        let corner = |bit: usize, n: usize| if n >> bit & 1 == 0 { low } else { high };
        let last = [i128::from(window.0) - 1, i128::from(window.1) - 1];
        let mut bits = 1;
        for n in 0..64usize {
            let edge = EdgeCoefficients::between(
                [corner(0, n), corner(1, n)],
                [corner(2, n), corner(3, n)],
            );
            let x = if n >> 4 & 1 == 0 { 0 } else { last[0] };
            let y = if n >> 5 & 1 == 0 { 0 } else { last[1] };
            let [px, py] = grid.position(x, y);
            // Only the rule's own bias: the other one costs a bit where a sample meets the
            // window's corner.
            let value = self.stored(edge.at(px, py) + self.bias(&edge, grid), grid);
            let magnitude = if value < 0 { !value } else { value };
            bits = bits.max(1 + i128::BITS - magnitude.leading_zeros());
        }
        bits
    }

    /// An owner covers E >= 0, any other E > 0: with integers, E - 1 >= 0. E at a sample between the sub-pixels
    /// has parts beside the integer, so the bias is one part, and the sum is floored (clause `FP-2`). For a
    /// square, what E gains on the way to the corner that decides, floored as well: E is an integer, so no sign
    /// changes (clause `CR-3`).
    fn bias(self, edge: &EdgeCoefficients, grid: &SampleGrid) -> i128 {
        if let Some(config) = self.conservative {
            return ((edge.a.abs() + edge.b.abs()) * config.reach(grid.sub_pixel)) >> 1;
        }
        let bias = if self.rule.owns(edge.direction()) { 0 } else { -1 };
        if grid.is_on_the_grid() {
            return bias;
        }
        (edge.a * grid.part[0] + edge.b * grid.part[1] + bias).div_euclid(grid.parts)
    }

    /// How far the bounding box of a triangle reaches beyond its vertices, in sub-pixels: a negative number
    /// makes it smaller. Spec clause `CR-3`.
    pub fn box_reach(&self, sub_pixel: u32) -> i128 {
        self.conservative.map_or(0, |config| config.reach(sub_pixel) >> 1)
    }

    /// The pixels of an axis that a triangle of this extent could cover. Spec clauses `C-7` and `CR-3`.
    pub fn pixels(
        &self,
        grid: &SampleGrid,
        axis: usize,
        (low, high): (i128, i128),
    ) -> (i128, i128) {
        let reach = self.box_reach(grid.sub_pixel);
        grid.pixels(axis, (low - reach, high + reach))
    }

    fn stored(self, biased: i128, grid: &SampleGrid) -> i128 {
        match self.storage {
            EdgeStorage::Full => biased,
            EdgeStorage::Shifted => biased >> grid.sub_pixel,
        }
    }

    /// Fraction bits of an edge word, in pixels squared: E has twice the sub-pixel bits, and storage
    /// may drop one half of them.
    pub const fn fraction(&self, sub_pixel: u32) -> u32 {
        match self.storage {
            EdgeStorage::Full => 2 * sub_pixel,
            EdgeStorage::Shifted => sub_pixel,
        }
    }

    /// The format of its words, in pixels squared.
    ///
    /// # Errors
    /// [`EdgeWordError`] unless it has 2 to 120 bits.
    pub fn format(&self, sub_pixel: u32) -> Result<QFormat, EdgeWordError> {
        self.validate()?;
        QFormat::of_width(self.width, self.fraction(sub_pixel))
            .map_err(|_| EdgeWordError(self.width))
    }

    /// The three edge values of a normalised triangle at pixel (0, 0), and their steps, before they
    /// are cut to words.
    pub fn words(&self, triangle: &Triangle, grid: &SampleGrid) -> EdgeWords {
        let fraction = self.fraction(grid.sub_pixel);
        let scale = match self.storage {
            EdgeStorage::Full => grid.sub_pixel,
            EdgeStorage::Shifted => 0,
        };
        let mut words =
            EdgeWords { width: self.width, fraction, start: [0; 3], dx: [0; 3], dy: [0; 3] };
        for (k, edge) in edges(triangle).iter().enumerate() {
            let e = edge.at(grid.offset[0], grid.offset[1]);
            words.start[k] = self.stored(e + self.bias(edge, grid), grid);
            words.dx[k] = edge.a << scale;
            words.dy[k] = edge.b << scale;
        }
        words
    }
}

/// Three edge values at pixel (0, 0), biased and stored, with their steps per pixel, before they are
/// cut to words; and the width of the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeWords {
    width: u32,
    fraction: u32,
    start: [i128; 3],
    dx: [i128; 3],
    dy: [i128; 3],
}

impl EdgeWords {
    /// Start, dx and dy of edge k in units of `2^-fraction`.
    #[inline]
    pub const fn raw(&self, k: usize) -> [i128; 3] {
        [self.start[k], self.dx[k], self.dy[k]]
    }

    /// Start, dx and dy of edge k.
    #[inline]
    pub fn values(&self, k: usize) -> [Unreduced; 3] {
        self.raw(k).map(|raw| Unreduced::new(raw, self.fraction))
    }

    /// Edge k at pixel (0, 0). Range: `k < 3`.
    #[inline]
    pub const fn start(&self, k: usize) -> Unreduced {
        Unreduced::new(self.start[k], self.fraction)
    }

    /// Step of edge k per pixel to the right.
    #[inline]
    pub const fn dx(&self, k: usize) -> Unreduced {
        Unreduced::new(self.dx[k], self.fraction)
    }

    /// Step of edge k per row downward.
    #[inline]
    pub const fn dy(&self, k: usize) -> Unreduced {
        Unreduced::new(self.dy[k], self.fraction)
    }

    /// Edge k at pixel (x, y).
    #[inline]
    pub const fn at(&self, k: usize, x: i128, y: i128) -> Unreduced {
        Unreduced::new(self.start[k] + self.dx[k] * x + self.dy[k] * y, self.fraction)
    }

    /// Bits that hold the three edges at every pixel of a box `[x0, y0, x1, y1]`: E is linear, so its extremes lie
    /// on the corners. 1 for an empty box.
    pub fn bits_over(&self, [x0, y0, x1, y1]: [u32; 4]) -> u32 {
        if x0 >= x1 || y0 >= y1 {
            return 1;
        }
        let [x0, y0, x1, y1] = [x0, y0, x1 - 1, y1 - 1].map(i128::from);
        let mut magnitude = 0;
        for k in 0..3 {
            for (x, y) in [(x0, y0), (x1, y0), (x0, y1), (x1, y1)] {
                let value = self.at(k, x, y).raw();
                magnitude |= value ^ (value >> 127);
            }
        }
        1 + i128::BITS - magnitude.leading_zeros()
    }

    /// The words at pixel (x, y), left-justified in a lane: reduced mod 2^width.
    pub fn lanes<L: Lane>(&self, x: u32, y: u32) -> Edges<L> {
        let word = |value: i128| L::justify(value, self.width);
        Edges {
            value: [0, 1, 2].map(|k| word(self.at(k, x.into(), y.into()).raw())),
            step_x: self.dx.map(word),
            step_y: self.dy.map(word),
        }
    }
}
