//! Fixed-point formats.
mod column;
pub use column::Column;
