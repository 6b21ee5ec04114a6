//! Scenes made by the program, so that every command has something to draw without a file.
//!
//! All lie inside [0, width] x [0, height] with depths inside 0..=depth_max, scale with the window
//! from 1 x 1 to 65536 x 65536, and are the same on every machine.

mod extremes;
mod fan;
mod knot;
mod slivers;
mod terrain;

use super::camera::View;
use super::mesh::{Mesh, Point};
use super::{Attributes, Scene, Triangle, Viewport, camera};

/// Name and one-line description of each.
const NAMES: [(&str, &str); 6] = [
    ("triangle", "one triangle across the window, depth from 0 to the maximum"),
    (
        "fan",
        "64 triangles around one vertex and a strip of 32: a rectangle tiled by shared edges, on quarters of pixels",
    ),
    ("slivers", "96 long thin triangles, each in its own direction, from 2 pixels wide to 1/64"),
    (
        "extremes",
        "whole window, one pixel, zero area, depth 0 and maximum, the steepest depth slopes",
    ),
    ("knot", "a trefoil tube of 3000 triangles in perspective, crossing in front of itself"),
    ("terrain", "a height field of 2048 triangles in perspective"),
];

/// Name and one-line description of each built-in scene.
pub fn builtin_names() -> &'static [(&'static str, &'static str)] {
    &NAMES
}

/// The names, for a message.
pub(super) fn name_list() -> String {
    NAMES.map(|(name, _)| name).join(", ")
}

/// The scene of that name, where there is one.
pub(super) fn make(name: &str, viewport: &Viewport) -> Option<Scene> {
    let flat = match name {
        "triangle" => vec![triangle(viewport)],
        "fan" => fan::triangles(viewport),
        "slivers" => slivers::triangles(viewport),
        "extremes" => extremes::triangles(viewport),
        "knot" => return in_perspective(name, knot::mesh(), viewport),
        "terrain" => return in_perspective(name, terrain::mesh(), viewport),
        _ => return None,
    };
    Some(Scene::new(name, flat))
}

/// No mesh here is without extent, so the camera always frames it, and drops nothing.
fn in_perspective(name: &str, triangles: Vec<[Point; 3]>, viewport: &Viewport) -> Option<Scene> {
    let mesh = Mesh { triangles, ..Mesh::default() };
    let View { triangles, w, lens, .. } = camera::view(&mesh, viewport)?;
    let attributes = Attributes::Mesh { w, sets: Vec::new() };
    Some(Scene { lens, attributes, ..Scene::new(name, triangles) })
}

fn triangle(viewport: &Viewport) -> Triangle {
    let at = |x: f64, y: f64, z| {
        let [width, height] = viewport.size();
        [x / 16.0 * width, y / 16.0 * height, viewport.depth(z, 2)]
    };
    Triangle::real([at(2.0, 3.0, 0), at(14.0, 1.0, 1), at(5.0, 15.0, 2)])
}

/// Two triangles of the quadrilateral a b c d, sharing the diagonal a c.
fn quad([a, b, c, d]: [Point; 4]) -> [[Point; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests;
