//! The library: arithmetic, machines, measures, committed sets. One binary, so that the library is linked
//! once and both cores have work.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../support/gltf.rs"]
mod gltf;
#[path = "../oracle/cover.rs"]
mod oracle;
#[path = "../support/run.rs"]
mod run;
#[path = "../support/set.rs"]
mod set;

mod accuracy;
mod channels;
mod conservative;
mod depth_bias;
mod depth_format;
mod envelope;
mod exact;
mod exhaustive;
mod extremes;
mod fuzz;
mod golden;
mod identify;
mod interpolation;
mod limits;
mod lines;
mod machine_vectors;
mod machines;
mod meshes;
mod multisample;
mod polygons;
mod property;
mod proved_depth;
mod rasterizers;
mod require;
mod samples;
mod snapshot;
mod toy;
mod viewport;
mod walk_range;
