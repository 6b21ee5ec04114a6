//! Rasterizers: each turns a primitive into spans, values and events by its own means.

mod edge_function;
mod edge_walk;
mod port;

pub use edge_function::EdgeFunction;
pub use edge_walk::{EdgeWalk, EdgeWalkConfig, EdgeWalkError, WalkedEdge};
pub use port::Ports;

use crate::bits::SpanEvents;
use crate::cover::{Rect, SampleGrid};
use crate::setup::Triangle;

/// One primitive, as a machine takes it.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Input<'a> {
    /// A triangle on the profile's sub-pixel grid.
    Triangle(&'a Triangle),
}

/// Why a primitive was refused. Numeric events are data; this is not one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrawError {
    /// Under the clamp mode `error`, a covered sample left the guard range.
    #[error("depth leaves the guard range at pixel ({x}, {y}); the profile's clamp is \"error\"")]
    GuardRange {
        /// Column.
        x: i64,
        /// Row.
        y: i64,
    },
}

/// Where spans, values and events of a primitive go, in the order of y then x.
pub trait Sink {
    /// The set-up words, in the order of [`Ports::setup`], unreduced.
    fn setup(&mut self, _words: &[i128]) {}

    /// The triangle has no area and draws nothing.
    fn zero_area(&mut self) {}

    /// A maximal run of covered samples `[x0, x1)` in row y; `depth` has one value a sample, or is
    /// empty when the primitive has none.
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]);

    /// Whether [`Sink::events`] is wanted.
    fn wants_events(&self) -> bool {
        false
    }

    /// The numeric events of a run, in drawing order.
    fn events(&mut self, _events: &SpanEvents) {}
}

/// Where a machine draws: the sample grid, and the pixels it may touch.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Sample positions.
    pub grid: SampleGrid,
    /// The window cut by the scissor.
    pub clip: Rect,
}

/// A rasterizer.
pub trait Machine: Send + Sync + std::fmt::Debug {
    /// The words it takes and makes.
    fn ports(&self) -> &Ports;

    /// Draws one primitive.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError>;
}
