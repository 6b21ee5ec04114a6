//! Golden vector sets: writing them, checking them, comparing a device's dump with them, and
//! saying what is wrong. Spec clauses `N-*`.

pub mod bench;
pub mod check;
pub mod device;
pub mod diff;
pub mod dump;
pub mod emit;
pub mod manifest;
pub mod package;
pub mod plan;
pub mod suspect;
pub mod table;
pub mod write;
