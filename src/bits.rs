//! Words of 1 to 128 bits, the roundings, and the numeric events that operations report.
//!
//! This is the lowest module: all other modules use these words, and nothing here depends on triangles.
//! Spec clauses `W-*` (words), `R-*` (rounding) and `V-*` (events).

mod bounded;
mod event;
mod lane;
mod overflow;
mod round;
mod status;
mod text;
mod word;

pub(crate) use bounded::bounded;
pub use event::{EventLog, Events, Extent, Place, SpanEvents};
pub use lane::Lane;
pub use overflow::{Overflow, SumError};
pub use round::{Rounding, RoundingNames};
pub use status::{Event, Status};
pub use text::{hex, hex_digits, push_hex, push_hex_narrow};
pub use word::{Bits, Mismatch, RunTime, StaticWidth, Width, WidthError, Word};
pub(crate) use word::{decimal, rescale};
