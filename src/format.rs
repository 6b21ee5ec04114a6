//! Fixed-point formats: the position of the binary point, the decoding of guard bits, and the number of
//! bits of each quantity. Spec clauses `F-*` (formats) and `G-*` (guard clamp).

mod budget;
mod column;
mod decision;
mod fixed;
mod layout;
mod q;
mod readout;
mod role;
mod unreduced;

pub use self::fixed::Fixed;
pub use budget::Budget;
pub use column::Column;
pub use decision::{Decision, Level, Refused, Takes, Value};
pub use layout::{Field, Gather, Layout, LayoutError, Packer, WORD};
pub use q::{Q, QFormat, QFormatError};
pub use readout::{Clamp, Decode, ReadOut, ReadOutError};
pub use role::{Role, RoleOf, WordFormat};
pub(crate) use unreduced::same_fraction;
pub use unreduced::{FractionMismatch, Unreduced};
