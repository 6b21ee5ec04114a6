//! Set-up: snapping, exact edge coefficients, plane gradients and the division behind them.
//! Machines call these functions; set-up is not a stage of its own before the machines. Spec clauses `S-*`.

mod clip;
mod cull;
mod decision;
mod divide;
mod edge;
mod plane;
mod polygon;
mod quad;
mod snap;
mod snapped;
mod triangle;
mod viewport;

pub use clip::{ClipSetup, ClipTriangle, Linear, linear_at};
pub use cull::{CullConfig, LargestEdge, Winding};
pub(crate) use decision::{rounding, roundings};
pub use divide::{Divider, Division, DivisionError};
pub use edge::{EdgeCoefficients, edges};
pub use plane::{Gradient, Plane};
pub use polygon::Polygon;
pub use quad::Diagonal;
pub use snap::{Coordinate, Endless, Source, VertexConfig, VertexError, snap_f64, snap_fixed};
pub use snapped::{Shape, Snapped, VertexField};
pub use triangle::Triangle;
pub use viewport::{
    Binary32, ClipDepth, DepthClamp, Destination, DivisionByW, PositionError, Transform,
    VerticalAxis, Viewport, ViewportConfig, ViewportError,
};
