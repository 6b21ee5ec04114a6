//! Questions asked of the model: which known facts hold, and how few bits are provably enough.

pub mod claims;
mod corner;
pub mod prove;
