//! `guardbit budget`: the words of a profile.

use super::Outcome;
use super::explore::figure;
use super::failure::Failure;
use super::output::Output;
use guardbit::measure::accuracy::Reference;
use guardbit::measure::budget;
use guardbit::measure::require::{
    Bits, ChannelNeed, Evaluator, Interpolation, Range, Requirements, require,
};
use guardbit::model::Model;
use guardbit::profile;
use guardbit::scene;

/// List the words of a profile: fields, range, resolution, and how many steps keep the error below half
/// an ULP.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// Also report what this scene requires: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of
    /// triangles.
    #[arg(long, value_name = "S")]
    scene: Option<String>,
    /// Window of the scene as WIDTHxHEIGHT; by default the window of the profile.
    #[arg(long, value_parser = super::parse_size, requires = "scene")]
    window: Option<(u32, u32)>,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut profile = profile::load(&arguments.profile)?;
    if let Some((width, height)) = arguments.window {
        profile.window = profile::WindowConfig { width, height };
    }
    let report = budget::report(&profile).map_err(Failure::input)?;
    let scene = match &arguments.scene {
        Some(source) => {
            super::takes_primitives(&profile)?;
            Some(required(source, &profile)?)
        }
        None => None,
    };
    let mut output = Output::new();
    if arguments.json {
        output.json(&Report { words: &report, requires: scene })?;
        return Ok(Outcome::Good);
    }
    output.line(format!("{}: {}", report.profile, report.about))?;
    for word in &report.words {
        output.line("")?;
        let fields: Vec<String> =
            word.fields.iter().map(|field| format!("{} {}", field.bits, field.name)).collect();
        output.line(format!("{}: {} = {} bits", word.name, fields.join(" + "), word.width))?;
        for fact in &word.facts {
            output.line(format!("  {:<22} {}", fact.name, fact.value))?;
        }
    }
    if let Some(scene) = &scene {
        print(&mut output, scene)?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}

/// The words, and what a scene requires of them.
#[derive(serde::Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    words: &'a budget::Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    requires: Option<Requirements>,
}

fn required(source: &str, profile: &profile::Profile) -> Result<Requirements, Failure> {
    let model = Model::new(profile).map_err(Failure::input)?;
    let scene = scene::load(source, &model.viewport())?;
    require(&Reference::new(scene, profile), profile).map_err(Failure::input)
}

fn print(output: &mut Output, scene: &Requirements) -> Result<(), Failure> {
    output.line("")?;
    output.line(format!(
        "{} requires: {} triangles, {} samples",
        scene.scene, scene.triangles, scene.samples
    ))?;
    for Range { name, low, high, unit, evidence } in &scene.ranges {
        let range = format!("{} to {} {unit}", figure(*low), figure(*high));
        output.line(format!("  {name:<22} {range}: {evidence}"))?;
    }
    output.line("bits:")?;
    for Bits { field, needs, has, evidence } in &scene.bits {
        let verdict = if needs <= has { "" } else { ", TOO FEW" };
        output.line(format!("  {field:<22} {needs} of {has}{verdict}: {evidence}"))?;
    }
    output.line("evaluators:")?;
    for Evaluator { name, needed, evidence } in &scene.evaluators {
        let verdict = if *needed { "needed" } else { "not needed" };
        output.line(format!("  {name:<22} {verdict}: {evidence}"))?;
    }
    if !scene.channels.is_empty() {
        output.line("channels:")?;
    }
    for ChannelNeed { name, needs, evidence, worst_ulp, saves_um2 } in &scene.channels {
        let needs = match needs {
            Interpolation::Constant => "constant",
            Interpolation::Affine => "affine",
            Interpolation::Perspective => "perspective",
        };
        let saves = if *saves_um2 > 0.0 {
            format!("; leaving out what it does not need saves {} um2", figure(*saves_um2))
        } else {
            String::new()
        };
        let worst = format!("; the profile's codes are off by at most {}", figure(*worst_ulp));
        output.line(format!("  {name:<22} {needs}: {evidence}{worst}{saves}"))?;
    }
    Ok(())
}
