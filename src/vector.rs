//! Golden vector sets: what a folder of vectors holds, and what reads it.

pub mod package;
