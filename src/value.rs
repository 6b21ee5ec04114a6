//! Values over a triangle: the depth plane and its read-out, what a depth buffer stores, its test, and
//! attributes in perspective. Spec clauses `P-*`, `G-*`, `Z-*` and `I-*`.

mod attribute;
mod channel;
mod correct;
mod depth;
mod depth_bias;
mod depth_buffer;
mod depth_codec;
mod depth_decision;
mod depth_format;
mod interpolate;
mod interpolator;
mod lod;
mod reciprocal;
mod vertex_values;

pub use attribute::{
    AttributeConfig, AttributeError, Correction, EvaluatedAt, InverseWConfig, Provoking,
    validate_channels,
};
pub use channel::{Channel, ChannelConfig, ChannelError, Extension};
pub use correct::{Corrector, Divided, InverseRun, Line};
pub use depth::{Depth, DepthConfig, DepthError, StartBias};
pub use depth_bias::{DepthBias, DepthBiasError};
pub use depth_buffer::{Compare, DepthBuffer};
pub use depth_codec::{leading_ones, slope_code, w_float};
pub use depth_format::{DepthFormat, DepthFormatError};
pub use interpolate::{Interpolation, InterpolationConfig, InterpolationError, Interpolator};
pub use interpolator::InterpolatorUnit;
pub use lod::{AxisLength, Derivatives, Detail, DetailConfig, DetailError, Quad};
pub use reciprocal::{
    Reciprocal, ReciprocalConfig, ReciprocalError, ReciprocalUnit, ReciprocalWords, Refine,
    WorstReciprocal,
};
pub use vertex_values::{ValueError, VertexValues};
