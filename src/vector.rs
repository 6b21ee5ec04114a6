//! Golden vector sets: writing them, checking them, comparing the dump of a device with them, and
//! naming the cause of a difference. Spec clauses `N-*`.

pub mod bench;
pub mod check;
pub mod device;
pub mod diff;
pub mod dump;
pub mod emit;
pub mod equivalence;
mod formal;
pub mod manifest;
pub mod package;
pub mod plan;
pub mod reference;
pub mod suspect;
pub mod table;
mod units;
pub mod write;
