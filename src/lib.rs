//! guardbit
pub mod bits;
pub mod dda;
pub mod format;
pub mod measure;
pub mod setup;
