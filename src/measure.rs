//! Measurement: error against the exact truth, and speed as ratios within one run.

pub mod accuracy;
pub mod budget;
pub mod error;
pub mod speed;
