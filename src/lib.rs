//! guardbit
pub mod bits;
pub mod case;
pub mod dda;
pub mod exact;
pub mod explore;
pub mod format;
pub mod measure;
pub mod scene;
pub mod setup;
