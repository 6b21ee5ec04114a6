//! Code that `vectors`, `render` and `trace` share: a profile, and a scene snapped to its grid.

use super::failure::Failure;
use guardbit::model::{Model, PrimitiveError, View};
use guardbit::profile::Profile;
use guardbit::scene::{self, Scene};
use guardbit::setup::{Snapped, Triangle};
use guardbit::value::VertexValues;
use std::path::Path;

/// A scene on a profile's grid.
pub(crate) struct SnappedScene {
    pub(crate) name: String,
    pub(crate) triangles: Vec<Snapped<Triangle>>,
    pub(crate) refused: u64,
    /// Their numbers in the scene.
    numbers: Vec<usize>,
    /// The whole scene.
    scene: Scene,
}

impl SnappedScene {
    /// The triangles in sub-pixels, as sets keep them.
    pub(crate) fn shapes(&self) -> Vec<Triangle> {
        self.triangles.iter().map(|triangle| **triangle).collect()
    }

    /// What the triangles bring for the channels of a model.
    pub(crate) fn values(&self, model: &Model) -> Result<Vec<VertexValues>, Failure> {
        let value = |n: &usize| {
            let failed = |error| {
                // The field `channels`, which the error itself names, is one of `eval`.
                let why = match error {
                    PrimitiveError::Values(error) => error.to_string(),
                    error => error.to_string(),
                };
                Failure::input(format!("{}: {}: {why}", self.scene.name, self.scene.place(*n)))
            };
            model.scene_values(&self.scene.attributes, *n).map_err(failed)
        };
        self.numbers.iter().map(value).collect()
    }

    /// The same for a set: nothing where the profile has no channels, or the scene no values at all, so that
    /// the bench makes its own.
    pub(crate) fn values_of_set(&self, profile: &Profile) -> Result<Vec<VertexValues>, Failure> {
        if profile.channel.is_empty() {
            return Ok(Vec::new());
        }
        if self.scene.attributes.is_empty() {
            let name = &self.scene.name;
            eprintln!(
                "note: {name}: the vertices carry no values; the bench `channel` makes its own"
            );
            return Ok(Vec::new());
        }
        self.values(&Model::new(profile).map_err(Failure::input)?)
    }
}

/// Loads a scene and snaps it; triangles outside the vertex field are counted and left out.
pub(crate) fn snap_scene(profile: &Profile, source: &str) -> Result<SnappedScene, Failure> {
    let model = Model::with_view(profile, View::default()).map_err(Failure::input)?;
    let scene = scene::load(source, &model.viewport())?;
    let mut refused = scene.dropped as u64;
    let mut first = scene.first_dropped.clone();
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
                first.get_or_insert_with(|| format!("{}: {error}", scene.place(n)));
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
    let mut name = stem.unwrap_or_else(|| source.to_owned());
    // The name of a built-in scene says which triangles a set has, so no file has it.
    if name != source && scene::builtin_names().iter().any(|(known, _)| *known == name) {
        name.push_str("-file");
    }
    Ok(SnappedScene { name, triangles, refused, numbers, scene })
}
