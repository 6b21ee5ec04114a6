//! The command and the texts around it: every subcommand as a process, the specification, the shape of the
//! sources. One binary, as `model`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/device.rs"]
mod device;
#[path = "../support/run.rs"]
mod run;
#[path = "../support/set.rs"]
mod set;

mod claims;
mod cli;
mod command;
mod compare;
mod coverage;
mod explore;
mod explore_page;
mod fit;
mod layering;
mod machine_list;
mod profile;
mod prove;
mod resume;
mod spec;
mod vectors;
mod verify;
