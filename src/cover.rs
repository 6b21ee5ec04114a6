//! Coverage: fill rules, sample positions, the samples a triangle may touch, and runs of covered
//! samples. Spec clauses `C-*`.

mod edge_word;
mod rect;
mod rule;
mod run;
mod sample;

pub use edge_word::{EdgeStorage, EdgeWordConfig, EdgeWordError, EdgeWords};
pub use rect::{Rect, RectError};
pub use rule::FillRule;
pub use run::for_each_run;
pub use sample::{SampleConfig, SampleError, SampleGrid};
