//! Values over a triangle: the depth plane and its read-out, what a depth buffer stores, its test, and
//! attributes in perspective. Spec clauses `P-*`, `G-*`, `Z-*` and `I-*`.

mod channel;
mod depth;
mod depth_bias;
mod depth_buffer;
mod depth_codec;
mod depth_decision;
mod depth_format;
mod interpolate;

pub use channel::{Channel, ChannelConfig, ChannelError, Extension};
pub use depth::{Depth, DepthConfig, DepthError, StartBias};
pub use depth_bias::DepthBias;
pub use depth_buffer::{Compare, DepthBuffer};
pub use depth_codec::{leading_ones, slope_code, w_float};
pub use depth_format::{DepthFormat, DepthFormatError};
pub use interpolate::{Interpolation, InterpolationConfig, InterpolationError, Interpolator};
