//! Devices: what answers the stimulus of a bench. The reference model is one, each suspect of a
//! diagnosis is one, and a device of one's own can be one too.

mod channel;
mod interpolator;
mod register;
mod setup;
mod shape;
mod triangle;
mod unit;
mod walk;
mod words;

pub(super) use channel::ChannelDrawer;
pub(super) use interpolator::Interpolates;
pub(super) use register::{Recorder, records};
pub(super) use setup::{SetUp, setup_words};
pub(super) use shape::ShapeDrawer;
pub(super) use triangle::{Drawer, draw, drawing, grid, summary};
pub(super) use unit::{Computes, NamedWord, STEPS, in_order};
pub(super) use walk::{Operands, Stepper, guard, reference as walker, signed};
pub(super) use words::draw_words;

use super::bench::{Answers, Coverage};

/// What a bench gives to a device in one test.
pub trait Stimulus {
    /// The expectation files, where a device writes its rows.
    type Rows: Answers;
}

/// Answers the stimulus of a bench.
pub trait Device<S: Stimulus>: Send {
    /// Writes the rows of one test. Tests come in the order of the set, after a reset before the
    /// first of them; what a test leaves in a device stays there for the next.
    ///
    /// `met` counts which cells of the bench's coverage the rows fell into, for a device that
    /// knows: the manifest lists what the reference met, and nobody looks at the others' counts.
    fn answer(&mut self, stimulus: &S, rows: &mut S::Rows, met: &mut Coverage);
}
