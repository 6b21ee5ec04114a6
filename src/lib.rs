//! guardbit
pub mod format;
pub mod scene;
