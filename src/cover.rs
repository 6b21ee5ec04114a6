//! Coverage: fill rules, sample positions, the samples a triangle may touch, and runs of covered
//! samples. Spec clauses `C-*`.

mod bitmask;
mod clip;
mod conservative;
mod edge_word;
mod line;
mod multisample;
mod point;
mod polygon;
mod rect;
mod rule;
mod run;
mod sample;
mod scan;
mod traversal;

pub use bitmask::Bitmask;
pub use clip::{ClipRect, GuardBand};
pub use conservative::{
    ConservativeConfig, ConservativeDepth, ConservativeError, ConservativeMode, Degenerate,
};
pub use edge_word::{EdgeStorage, EdgeWordConfig, EdgeWordError, EdgeWords};
pub use line::{
    AxisMove, ErrorState, ErrorWord, LineConfig, LineError, LineRule, Looks, Measures, OwnErrors,
    Segment, SharedError, SlopeSteps, Start, Stepper, StepperError, Stipple, Sum, SumError, Test,
    Tie, bresenham, incremental, integer_incremental, march, midpoint, naive,
};
pub use multisample::{DepthAt, MultisampleConfig, MultisampleError};
pub use point::{PointConfig, PointError, PointRule, circle};
pub use polygon::polygon;
pub use rect::{Rect, RectError};
pub use rule::FillRule;
pub use run::for_each_run;
pub use sample::{SampleConfig, SampleError, SampleGrid};
pub use scan::{fits_narrow, scan};
pub use traversal::{Block, Order, Outside, Stamp, TILE, TraversalConfig, Visitor};
