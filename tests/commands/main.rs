//! The command and the texts around it: every subcommand as a process, the specification, the shape of the
//! sources. One binary, as `model`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/device.rs"]
mod device;
#[path = "../support/gltf.rs"]
mod gltf;
#[path = "../support/run.rs"]
mod run;
#[path = "../support/set.rs"]
mod set;

mod channel_fit;
mod channels;
mod claims;
mod cli;
mod command;
mod compare;
mod conservative;
mod coverage;
mod depth_bias;
mod dump_form;
mod ends;
mod envelope;
mod explore;
mod explore_page;
mod export;
mod fit;
mod front;
mod hostile;
mod identify;
mod layering;
mod machine_list;
mod pictures;
mod profile;
mod prove;
mod readme;
mod register_dump;
mod replace;
mod resume;
mod scenes;
mod set_check;
mod spec;
mod vectors;
mod verify;
mod waves;
