//! What a scene requires of channels. Spec clause `M-8`.

use super::Requirements;
use crate::measure::accuracy::{Change, Drawn, Stage, measure_channels};
use crate::measure::cost::estimate;
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::value::{AttributeConfig, Correction};
use serde::Serialize;

/// What a scene requires of a channel.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChannelNeed {
    /// The channel.
    pub name: String,
    /// How it changes.
    pub needs: Interpolation,
    /// Where that is seen.
    pub evidence: String,
    /// Worst error of the profile's own codes, in ULP.
    pub worst_ulp: f64,
    /// Area of the profile's correction that the scene does not need, in square micrometres.
    pub saves_um2: f64,
}

/// How a channel changes over the triangles of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Not at all: one code a triangle will do.
    Constant,
    /// Linearly, to less than half of a code.
    Affine,
    /// In perspective.
    Perspective,
}

/// Adds the channels of a profile that the scene has values for.
pub(super) fn require(
    stage: &Stage,
    profile: &Profile,
    found: &mut Requirements,
) -> Result<(), InvalidProfile> {
    let Some(shades) = &stage.shades else { return Ok(()) };
    let (model, drawn) = (Model::new(profile)?, Drawn::new(stage, profile)?);
    let wanted = vec![true; profile.channel.len()];
    let measured = measure_channels(stage, &drawn, &model, &wanted);
    let costs = estimate(profile).map_or_else(|_| Vec::new(), |cost| cost.channels);
    for (n, config) in profile.channel.iter().enumerate() {
        let change = shades.change(stage, config);
        let (needs, evidence) = verdict(config, change);
        let cost = costs.iter().find(|cost| cost.name == config.name);
        let spared = cost.map_or(0.0, |cost| match needs {
            Interpolation::Perspective => 0.0,
            Interpolation::Affine => cost.correction_um2,
            // A channel that the profile holds flat has no more than its register.
            Interpolation::Constant if matches!(config.correction, Correction::Flat { .. }) => 0.0,
            Interpolation::Constant => cost.walked_um2 + cost.correction_um2,
        });
        found.channels.push(ChannelNeed {
            name: config.name.clone(),
            needs,
            evidence,
            worst_ulp: measured.as_ref().map_or(0.0, |tally| tally.moments[n].worst),
            saves_um2: spared,
        });
    }
    Ok(())
}

fn verdict(config: &AttributeConfig, change: Change) -> (Interpolation, String) {
    let (most, face) = change.over_a_face;
    let (gap, at, [x, y]) = change.from_affine;
    if most < 0.5 {
        let evidence = "no triangle changes it by half of a code".to_owned();
        return (Interpolation::Constant, evidence);
    }
    let flat = matches!(config.correction, Correction::Flat { .. });
    if gap < 0.5 {
        let evidence = format!(
            "it changes by {most:.2} over triangle {face}, and perspective moves no code by more than {gap:.2}"
        );
        return (
            Interpolation::Affine,
            evidence + if flat { "; the profile holds it flat" } else { "" },
        );
    }
    let without =
        if config.correction.needs_w() { "" } else { "; the profile does not correct it" };
    let evidence = format!("triangle {at} at ({x}, {y}): affine is {gap:.2} codes off{without}");
    (Interpolation::Perspective, evidence)
}
