//! guardbit
pub mod format;
