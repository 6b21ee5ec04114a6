//! Edge functions as stored words: bias, shift, reduction. Spec clauses `C-4` and `C-5`.

use super::rule::FillRule;
use super::sample::SampleGrid;
use crate::bits::Lane;
use crate::dda::Edges;
use crate::format::{Clamp, ReadOut};
use crate::setup::{EdgeCoefficients, Triangle, VertexConfig, edges};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How an edge value is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EdgeStorage {
    /// E plus the rule's bias, in sub-pixels squared.
    Full,
    /// The same shifted right by the sub-pixel bits: samples lie on the pixel grid, so the low
    /// bits never change along a walk.
    Shifted,
}

/// The edge words of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct EdgeWordConfig {
    /// Who owns samples on an edge.
    pub rule: FillRule,
    /// How edge values are kept.
    pub storage: EdgeStorage,
    /// Bits of an edge word; a scene that needs more wraps.
    pub width: u32,
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
            let value = self.stored(edge.at(px, py) + self.bias(&edge), grid);
            let magnitude = if value < 0 { !value } else { value };
            bits = bits.max(1 + i128::BITS - magnitude.leading_zeros());
        }
        bits
    }

    /// An owner covers E >= 0, any other E > 0: with integers, E - 1 >= 0.
    fn bias(self, edge: &EdgeCoefficients) -> i128 {
        if self.rule.owns(edge.direction()) { 0 } else { -1 }
    }

    fn stored(self, biased: i128, grid: &SampleGrid) -> i128 {
        match self.storage {
            EdgeStorage::Full => biased,
            EdgeStorage::Shifted => biased >> grid.sub_pixel,
        }
    }

    /// The three edge words of a normalised triangle at pixel (0, 0), and their steps, unreduced.
    pub fn words(&self, triangle: &Triangle, grid: &SampleGrid) -> EdgeWords {
        let scale = match self.storage {
            EdgeStorage::Full => grid.sub_pixel,
            EdgeStorage::Shifted => 0,
        };
        let mut words = EdgeWords { value: [0; 3], step_x: [0; 3], step_y: [0; 3] };
        for (k, edge) in edges(triangle).iter().enumerate() {
            let e = edge.at(grid.offset[0], grid.offset[1]);
            words.value[k] = self.stored(e + self.bias(edge), grid);
            words.step_x[k] = edge.a << scale;
            words.step_y[k] = edge.b << scale;
        }
        words
    }
}

/// Unreduced edge values at pixel (0, 0) and their steps per pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeWords {
    /// Biased and stored values.
    pub value: [i128; 3],
    /// Steps per pixel to the right.
    pub step_x: [i128; 3],
    /// Steps per row downward.
    pub step_y: [i128; 3],
}

impl EdgeWords {
    /// The words at pixel (x, y), left-justified in a lane: reduced mod 2^width.
    pub fn lanes<L: Lane>(&self, width: u32, x: u32, y: u32) -> Edges<L> {
        let at = |k: usize| {
            self.value[k] + self.step_x[k] * i128::from(x) + self.step_y[k] * i128::from(y)
        };
        Edges {
            value: std::array::from_fn(|k| L::justify(at(k), width)),
            step_x: self.step_x.map(|step| L::justify(step, width)),
            step_y: self.step_y.map(|step| L::justify(step, width)),
        }
    }
}
