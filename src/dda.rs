//! Digital differential analysers: an accumulator and its slopes in one or two directions, as single
//! steps, as closed forms, and as kernels that fill slices. Spec clauses `D-*`.

mod closed;
mod kernel;
mod linear;
mod planar;
mod processor;
mod walk;

pub use closed::Line;
pub use kernel::{Edges, count_inside, row_inside, row_values, walk_checksum};
pub use linear::Linear;
pub use planar::Planar;
pub use processor::Processor;
pub use walk::{Op, Walker};

/// Plain `i128` twins of the kernels: slow, and plainly right.
pub mod twin;
