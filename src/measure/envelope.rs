//! What every rasterizer that the text of an API allows agrees on, pixel by pixel. Spec clauses `EN-1` to
//! `EN-7`.
//!
//! A [`Family`] is the list of [`Way`]s to snap a vertex that an API allows. [`Envelope::of`] draws a scene in all of
//! them, with every consistent rule for samples on edges, and says of each pixel whether all, none or some of them
//! cover it.

mod alone;
mod api;
mod check;
mod error;
mod family;
mod raster;
mod robust;
mod rule;
mod shape;
mod snap;
mod window;

pub use alone::{Alone, counts};
pub use api::Api;
pub use check::{Verdict, Wrong, check};
pub use error::EnvelopeError;
pub use family::{Family, Rasterizer, Way};
pub use robust::{Margin, Move, STEPS, STEPS_OF_THREE, Search, margin, search};
pub use rule::Rule;
pub use shape::{LATTICE_BITS, REACH, shapes};
pub use snap::Snap;
pub use window::{Envelope, witness};

/// A triangle by its window coordinates in pixels, y down; each is a binary32 number.
pub type Shape = [[f64; 2]; 3];

/// What the rasterizers of a family say of a pixel. Spec clause `EN-1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Each of them covers it.
    Must,
    /// Some cover it, and some do not.
    May,
    /// None covers it.
    MustNot,
}

impl Class {
    const fn of(covers: bool, misses: bool) -> Self {
        match (covers, misses) {
            (true, true) => Self::May,
            (true, false) => Self::Must,
            (false, _) => Self::MustNot,
        }
    }
}
