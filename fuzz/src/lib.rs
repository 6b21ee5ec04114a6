//! The fuzz targets. They stand among the tests of the crate, which call them on spoiled seeds.

#[path = "../../tests/support/targets.rs"]
mod targets;

pub use targets::*;
