//! Experiments with the model: which known facts hold, what the effect of each bit is, and how few bits
//! are enough.

#[cfg(feature = "laboratory")]
pub mod claims;
mod clock;
mod corner;
pub mod extremes;
pub mod field;
pub mod fit;
pub mod identify;
pub mod metric;
pub mod pareto;
pub mod prove;
pub mod record;
pub mod space;
pub mod store;
pub mod sweep;
pub mod tolerance;
pub mod witness;
