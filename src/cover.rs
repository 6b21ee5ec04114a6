//! Coverage: fill rules, sample positions, the samples a triangle may touch, and runs of covered
//! samples. Spec clauses `C-*`.

mod bitmask;
mod edge_word;
mod multisample;
mod rect;
mod rule;
mod run;
mod sample;
mod scan;
mod traversal;

pub use bitmask::Bitmask;
pub use edge_word::{EdgeStorage, EdgeWordConfig, EdgeWordError, EdgeWords};
pub use multisample::{DepthAt, MultisampleConfig, MultisampleError};
pub use rect::{Rect, RectError};
pub use rule::FillRule;
pub use run::for_each_run;
pub use sample::{SampleConfig, SampleError, SampleGrid};
pub use scan::{fits_narrow, scan};
pub use traversal::{Block, Order, Outside, Stamp, TILE, TraversalConfig, Visitor};
