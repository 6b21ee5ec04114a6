//! Code that `vectors`, `render` and `trace` share: a profile, and a scene snapped to its grid.

use super::failure::Failure;
use guardbit::model::{Model, View};
use guardbit::profile::Profile;
use guardbit::scene;
use guardbit::setup::{Snapped, Triangle};
use std::path::Path;

/// A scene on a profile's grid.
pub(crate) struct SnappedScene {
    pub(crate) name: String,
    pub(crate) triangles: Vec<Snapped<Triangle>>,
    /// Their numbers in the scene.
    pub(crate) numbers: Vec<usize>,
    /// What the vertices of the whole scene carry.
    pub(crate) attributes: scene::Attributes,
    pub(crate) refused: u64,
}

impl SnappedScene {
    /// The triangles in sub-pixels, as sets keep them.
    pub(crate) fn shapes(&self) -> Vec<Triangle> {
        self.triangles.iter().map(|triangle| **triangle).collect()
    }
}

/// Loads a scene and snaps it; triangles outside the vertex field are counted and left out.
pub(crate) fn snap_scene(profile: &Profile, source: &str) -> Result<SnappedScene, Failure> {
    let model = Model::with_view(profile, View::default()).map_err(Failure::input)?;
    let scene = scene::load(source, &model.viewport())?;
    let mut refused = scene.dropped as u64;
    let mut first = None;
    let mut triangles = Vec::with_capacity(scene.triangles.len());
    let mut numbers = Vec::with_capacity(scene.triangles.len());
    for (n, triangle) in scene.triangles.iter().enumerate() {
        match model.snap(triangle) {
            Ok(triangle) => {
                triangles.push(triangle);
                numbers.push(n);
            }
            Err(error) => {
                refused += 1;
                first.get_or_insert_with(|| format!("triangle {n}: {error}"));
            }
        }
    }
    if triangles.is_empty() {
        let why = first.unwrap_or_else(|| "the scene has no triangles".to_owned());
        return Err(Failure::input(format!("{source}: no triangle can be drawn: {why}")));
    }
    if let Some(first) = first {
        eprintln!("note: {source}: {refused} triangles are left out; the first reason: {first}");
    }
    let stem = Path::new(source).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = stem.unwrap_or_else(|| source.to_owned());
    Ok(SnappedScene { name, triangles, numbers, attributes: scene.attributes, refused })
}
