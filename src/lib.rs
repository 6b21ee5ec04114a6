//! guardbit
pub mod format;
pub mod vector;
