//! Measurement: error against the exact result, cost in hardware, comparison of machines, and speed as
//! ratios within one run.

pub mod accuracy;
pub mod budget;
pub mod comparison;
pub mod cost;
pub mod envelope;
pub mod error;
#[cfg(feature = "laboratory")]
pub mod experiment;
pub mod gallery;
pub mod interpolation;
pub mod require;
pub mod resolution;
#[cfg(feature = "laboratory")]
pub mod speed;
