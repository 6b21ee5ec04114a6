//! guardbit
pub mod bits;
pub mod case;
pub mod cover;
pub mod dda;
pub mod exact;
pub mod explore;
pub mod format;
pub mod machine;
pub mod measure;
pub mod model;
pub mod profile;
pub mod scene;
pub mod setup;
pub mod value;
pub mod vector;
