//! What a profile says beside its machine.

use super::Target;
use crate::cover::{EdgeWordConfig, MultisampleConfig, SampleConfig, SampleGrid, TraversalConfig};
use crate::cover::{Rect, RectError, SampleError};
use crate::dda::Processor;
use crate::format::ReadOut;
use crate::setup::VertexConfig;
use crate::value::{Depth, DepthConfig};

/// The parts of a profile that every machine shares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RasterState {
    /// Columns and rows of the window.
    pub window: (u32, u32),
    /// The vertex field.
    pub vertex: VertexConfig,
    /// Sample position; pixel centres when absent.
    pub sample: Option<SampleConfig>,
    /// Several samples a pixel; one when absent.
    pub multisample: Option<MultisampleConfig>,
    /// The order in which samples are visited, where the profile states one.
    pub traversal: Option<TraversalConfig>,
    /// The depth plane; no depth when absent.
    pub depth: Option<DepthConfig>,
}

/// Where a machine is built: for one sample of the pixel, with depth or without.
#[derive(Clone, Copy, Debug)]
pub struct Site {
    /// The depth evaluator; none without depth, and none where another stage finds depth.
    pub depth: Option<Depth>,
    /// The sample grid and the pixels drawn to.
    pub target: Target,
    /// Processor level.
    pub processor: Processor,
}

impl RasterState {
    /// The sample grid.
    ///
    /// # Errors
    /// [`SampleError`] if the position is off the grid.
    pub fn grid(&self) -> Result<SampleGrid, SampleError> {
        SampleGrid::new(self.sample, self.vertex.sub_pixel)
    }

    /// The window.
    ///
    /// # Errors
    /// [`RectError`] if a side is 0 or above 65536.
    pub fn clip(&self) -> Result<Rect, RectError> {
        Rect::window(self.window.0, self.window.1)
    }

    /// The depth accumulator's format; `None` without depth, or where depth is malformed.
    pub fn depth_read_out(&self) -> Option<ReadOut> {
        self.depth?.validate(&self.vertex).ok()
    }

    /// The width that holds every edge value of the vertex field over the window, rounded up to whole
    /// tiles of so many pixels on a side; `None` where vertex field or sample are malformed. Spec clause
    /// `E-5`.
    pub fn exact_edge_width(&self, edges: &EdgeWordConfig, tile: u32) -> Option<u32> {
        self.vertex.validate().ok()?;
        let whole = |side: u32| side.div_ceil(tile).saturating_mul(tile);
        let size = (whole(self.window.0), whole(self.window.1));
        Some(edges.exact_width(&self.vertex, &self.grid().ok()?, size))
    }
}
