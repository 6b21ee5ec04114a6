//! guardbit
pub mod bits;
pub mod dda;
pub mod format;
pub mod measure;
pub mod scene;
pub mod setup;
