//! What cannot be asked.

use super::api::Api;
use super::shape::REACH;

/// A question without an answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnvelopeError {
    /// An API or a version that is not known here.
    #[error("`{name}` is not known; the APIs and versions are {}", known())]
    Api {
        /// The name that was asked for.
        name: String,
    },
    /// A range of bits that is empty.
    #[error(
        "--bits {low}..{high}: low <= high is needed; give the fewest bits first, for example 4..12"
    )]
    Reversed {
        /// The fewest.
        low: u32,
        /// The most.
        high: u32,
    },
    /// Bits outside what the API allows, or beyond what a vertex field holds.
    #[error(
        "--bits {low}..{high}: {api} has {least} <= sub-pixel bits <= {most} ({})",
        if *fixed { "its text says exactly this" } else { "its text has the least; a vertex field of 32 bits has the most" }
    )]
    Bits {
        /// The fewest that were asked for.
        low: u32,
        /// The most.
        high: u32,
        /// The API's name.
        api: &'static str,
        /// The fewest that are allowed.
        least: u32,
        /// The most.
        most: u32,
        /// Whether the text itself has the most.
        fixed: bool,
    },
    /// A snap that the API does not allow.
    #[error("--snap {name}: {api} allows {allowed}")]
    Snap {
        /// The name that was asked for.
        name: String,
        /// The API's name.
        api: &'static str,
        /// Those that it allows.
        allowed: String,
    },
    /// A coordinate without a place on any grid.
    #[error("{place}: vertex {vertex}, {axis} is {value}: a finite number is needed")]
    NotFinite {
        /// The triangle in words.
        place: String,
        /// Which vertex, from 0.
        vertex: usize,
        /// `x` or `y`.
        axis: char,
        /// What it is.
        value: f64,
    },
    /// A coordinate outside every vertex field.
    #[error(
        "{place}: vertex {vertex}: -{REACH} <= {axis} <= {REACH} is needed, {axis} = {value} pixels; clip the \
         triangle first"
    )]
    Outside {
        /// The triangle in words.
        place: String,
        /// Which vertex, from 0.
        vertex: usize,
        /// `x` or `y`.
        axis: char,
        /// Its value in pixels.
        value: f64,
    },
    /// A scene without a triangle.
    #[error("{name}: the scene has no triangles")]
    Empty {
        /// The scene's name.
        name: String,
    },
    /// A window that cannot be.
    #[error("window {width} x {height}: 1 <= width, height and width x height <= 2^24 are needed")]
    Window {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
    },
    /// A picture of another size.
    #[error(
        "the picture has {width} x {height} pixels, but the window has {} x {}; give --window \
         {width}x{height}, or a picture with one pixel for each of the window: `render` enlarges small windows, unless it \
         is given --zoom 1",
        window.0, window.1
    )]
    Size {
        /// The picture's width.
        width: u32,
        /// The picture's height.
        height: u32,
        /// The window's size.
        window: (u32, u32),
    },
}

fn known() -> String {
    let names = Api::ALL.map(|api| format!("{} ({})", api.name(), api.text()));
    names.join(", ")
}
