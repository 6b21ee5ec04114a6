//! Questions asked of the model: which known facts hold.

pub mod claims;
