//! The scene of a set: as its file has it, and as the built-in scene of its name gives it.

use super::file::{is_regular, open_regular};
use super::open::first_difference;
use super::{CheckError, Finding, OpenSet, io};
use crate::model::Model;
use crate::profile::{read_at_most, read_text_at_most};
use crate::scene::{
    self,
    lines::{self, SceneLine},
};
use crate::setup::Triangle;
use crate::value::VertexValues;
use crate::vector::manifest::{self, Manifest};
use crate::vector::write::scene_text;
use std::path::Path;

/// The most bytes of a scene file that are read.
const LARGEST: u64 = scene::LARGEST;

/// The triangles of a set's scene file, and what they bring for channels.
///
/// # Errors
/// [`CheckError`] with file and line.
pub fn read_scene(set: &OpenSet) -> Result<(Vec<Triangle>, Vec<VertexValues>), CheckError> {
    let path = set.folder.join("scene.jsonl");
    if is_regular(&path)? == Some(false) {
        open_regular(&path)?;
    }
    let text = read_text_at_most(&path, LARGEST).map_err(io(&path))?;
    let bad = |line: usize, message: String| CheckError::Malformed {
        path: path.display().to_string(),
        line,
        message,
    };
    let read = lines::parse_scene(&text).map_err(|(line, error)| bad(line, error.to_string()))?;
    let model = Model::new(&set.manifest.profile).map_err(|error| bad(1, error.to_string()))?;
    let (mut triangles, mut values) = (Vec::new(), Vec::new());
    for SceneLine { line, triangle, shading } in &read {
        let triangle = model.snap(triangle).map_err(|error| bad(*line, error.to_string()))?;
        triangles.push(*triangle);
        if let Some(shading) = shading {
            let found = model.shading(shading).map_err(|error| bad(*line, error.to_string()))?;
            values.push(found);
        }
    }
    if ![0, triangles.len()].contains(&values.len()) {
        let without = read.iter().find(|line| line.shading.is_none()).map_or(1, |line| line.line);
        return Err(bad(without, "the triangle has no `channels`, but others have".to_owned()));
    }
    Ok((triangles, values))
}

/// A built-in scene on the grid of a profile.
struct Builtin {
    triangles: Vec<Triangle>,
    values: Vec<VertexValues>,
    refused: u64,
}

/// Whether a set says that its scene is a built-in one.
pub(super) fn is_builtin(manifest: &Manifest) -> bool {
    scene::builtin_names().iter().any(|(known, _)| *known == manifest.scene.name)
}

/// The built-in scene that a set says it has.
fn builtin(manifest: &Manifest) -> Option<Builtin> {
    if !is_builtin(manifest) {
        return None;
    }
    let model = Model::new(&manifest.profile).ok()?;
    let made = scene::load(&manifest.scene.name, &model.viewport()).ok()?;
    let with_values = !manifest.profile.channel.is_empty() && !made.attributes.is_empty();
    let mut scene =
        Builtin { triangles: Vec::new(), values: Vec::new(), refused: made.dropped as u64 };
    for (n, given) in made.triangles.iter().enumerate() {
        let Ok(triangle) = model.snap(given) else {
            scene.refused += 1;
            continue;
        };
        scene.triangles.push(*triangle);
        if with_values {
            scene.values.push(model.scene_values(&made.attributes, n).ok()?);
        }
    }
    Some(scene)
}

/// What the manifest says of a built-in scene and is not so.
pub(super) fn check_builtin(
    set: &OpenSet,
    (triangles, values): (&[Triangle], &[VertexValues]),
) -> Option<Finding> {
    let given = &set.manifest.scene;
    let made = builtin(&set.manifest)?;
    let same = made.triangles == triangles && made.values == values;
    let message = if !same {
        format!("scene: the built-in scene {:?} has other triangles than scene.jsonl", given.name)
    } else if made.refused != given.refused {
        let (found, refused) = (given.refused, made.refused);
        format!("scene: refused = {found}, but {refused} triangles of {:?} are refused", given.name)
    } else {
        return None;
    };
    Some(Finding { file: set.folder.join(manifest::NAME), line: None, message })
}

/// The first line of a damaged scene that is not as made, where that can be told: from the
/// built-in scene of that name, or because the line is no triangle.
pub(super) fn lines_until_odd(path: &Path, manifest: &Manifest) -> Option<u64> {
    let bytes = read_at_most(path, LARGEST).ok()?;
    if let Some(Builtin { triangles, values, .. }) = builtin(manifest) {
        let expected = scene_text(&triangles, &values, &manifest.profile);
        if manifest::sha256(expected.as_bytes()) == manifest.scene.sha256 {
            return first_difference(path, &bytes, expected.as_bytes()).line;
        }
    }
    match lines::parse_scene(&String::from_utf8_lossy(&bytes)) {
        Err((line, _)) => Some(line as u64),
        Ok(triangles) => {
            ((triangles.len() as u64) != manifest.scene.triangles).then_some(triangles.len() as u64)
        }
    }
}
