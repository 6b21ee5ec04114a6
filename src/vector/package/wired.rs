//! Devices that are wired for the words of one built-in profile.

use super::rtl::{Source, systemverilog};
use crate::machine::WiredEngine;

/// Parameters of these devices: name, constant of the packages, what it is.
pub(super) const PARAMETERS: [(&str, &str, &str); 9] = [
    ("SORTED", "ANCHOR_SORTED", "1: the anchor is looked for among the sorted vertices"),
    ("FIRST_MATCH", "SORT_FIRST_MATCH", "1: the first order in which y does not fall; 0: stable"),
    ("UPPER_FIRST", "UPPER_HALF_FIRST", "1: the upper half is always drawn first"),
    ("LARGEST_X", "LARGEST_X", "columns of the longest edge that is drawn"),
    ("LARGEST_Y", "LARGEST_Y", "rows of the longest edge that is drawn"),
    ("RESIZE", "PRODUCT_RESIZE", "1: a product keeps its sign and its low 31 bits"),
    ("SIGNED_DISTANCE", "DISTANCE_SIGNED", "1: the distance to the first pixel is signed"),
    ("LONG_SIGN", "LONG_SIGN", "1: a register holds the sign of the long side"),
    ("DROP_Z", "DROP_Z", "low bits that the slope of z along a row lacks"),
];

static ANCHORED: Source = systemverilog(
    "anchored_engine.sv",
    include_str!("../../../hdl/anchored_engine.sv"),
    &["SORTED", "FIRST_MATCH", "UPPER_FIRST", "LARGEST_X", "LARGEST_Y"],
);
static VERTEX_QUADS: Source =
    systemverilog("vertex_quad_engine.sv", include_str!("../../../hdl/vertex_quad_engine.sv"), &[]);
static GIVEN_SLOPES: Source =
    systemverilog("given_slope_engine.sv", include_str!("../../../hdl/given_slope_engine.sv"), &[]);
static DIVIDED_SLOPES: Source = systemverilog(
    "divided_slope_engine.sv",
    include_str!("../../../hdl/divided_slope_engine.sv"),
    &[],
);
static SUB_SCANLINES: Source = systemverilog(
    "sub_scanline_engine.sv",
    include_str!("../../../hdl/sub_scanline_engine.sv"),
    &["RESIZE", "SIGNED_DISTANCE", "LONG_SIGN", "DROP_Z"],
);

type Device = (&'static str, &'static [&'static Source]);

const ANCHORED_DEVICE: Device = ("anchored_engine", &[&ANCHORED]);
const VERTEX_QUADS_DEVICE: Device = ("vertex_quad_engine", &[&VERTEX_QUADS]);
const GIVEN_SLOPES_DEVICE: Device = ("given_slope_engine", &[&GIVEN_SLOPES]);
const DIVIDED_SLOPES_DEVICE: Device = ("divided_slope_engine", &[&DIVIDED_SLOPES]);
const SUB_SCANLINES_DEVICE: Device = ("sub_scanline_engine", &[&SUB_SCANLINES]);

/// All of them, for what is asked of every device.
#[cfg(test)]
pub(super) const ALL: [&Source; 5] =
    [&ANCHORED, &VERTEX_QUADS, &GIVEN_SLOPES, &DIVIDED_SLOPES, &SUB_SCANLINES];

/// The module's name, and its modules, itself last.
pub(super) fn device(engine: WiredEngine) -> Device {
    match engine {
        WiredEngine::Anchored => ANCHORED_DEVICE,
        WiredEngine::VertexQuads => VERTEX_QUADS_DEVICE,
        WiredEngine::GivenSlopes => GIVEN_SLOPES_DEVICE,
        WiredEngine::DividedSlopes => DIVIDED_SLOPES_DEVICE,
        WiredEngine::SubScanlines => SUB_SCANLINES_DEVICE,
    }
}
