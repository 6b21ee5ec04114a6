//! The channels of a profile that a scene does not need.

use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::scene::{Scene, Shading};

/// Name and reason of each channel that a scene has no values for, or whose values are the same at the three
/// vertices of each triangle, so that a register a triangle does for it.
pub(super) fn channels(
    scene: &Scene,
    profile: &Profile,
) -> Result<Vec<(String, String)>, InvalidProfile> {
    if profile.channel.is_empty() {
        return Ok(Vec::new());
    }
    let all = |why: &str| {
        let named = profile.channel.iter().map(|channel| (channel.name.clone(), why.to_owned()));
        Ok(named.collect())
    };
    if scene.attributes.is_empty() {
        return all("the vertices of the scene carry no values");
    }
    let model = Model::new(&Profile { multisample: None, ..profile.clone() })?;
    let mut flat = vec![true; profile.channel.len()];
    for triangle in 0..scene.triangles.len() {
        let shading = match model.scene_shading(&scene.attributes, triangle) {
            Ok(shading) => shading,
            Err(error) => return all(&format!("{}: {error}", scene.place(triangle))),
        };
        for (config, flat) in profile.channel.iter().zip(&mut flat) {
            *flat &= match &shading {
                Shading::Reals { channels, .. } => even(channels, &config.name),
                Shading::Codes { channels, .. } => even(channels, &config.name),
            };
        }
    }
    let unneeded = profile.channel.iter().zip(flat).filter(|(_, flat)| *flat);
    let why = "the scene has one value of it in each triangle";
    Ok(unneeded.map(|(channel, _)| (channel.name.clone(), why.to_owned())).collect())
}

/// Whether the components of a channel have one value each.
fn even<T: PartialEq>(channels: &[(String, Vec<[T; 3]>)], name: &str) -> bool {
    let own = channels.iter().filter(|(known, _)| known == name);
    own.flat_map(|(_, values)| values).all(|[a, b, c]| a == b && b == c)
}
