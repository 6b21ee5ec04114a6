//! Values over a triangle: the depth plane and its read-out. Spec clauses `P-*` and `G-*`.

mod depth;

pub use depth::{Depth, DepthConfig, DepthError, StartBias};
