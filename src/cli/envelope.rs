//! `guardbit envelope`: what every rasterizer that an API allows agrees on.

mod picture;
mod report;

use super::Outcome;
use super::failure::Failure;
use super::output::{Output, check_place};
use guardbit::measure::envelope::{
    Api, Envelope, EnvelopeError, Family, STEPS, Shape, check, counts, shapes,
};
use guardbit::scene::{self, Scene, Viewport};
use std::path::PathBuf;

/// Say which pixels every rasterizer that an API allows covers (MUST), which none does (MUST NOT), and which
/// depend on the rasterizer (MAY).
///
/// The family of an API has every number of sub-pixel bits, every rounding of vertices to the sub-pixel grid,
/// and every consistent rule for samples on edges that its text allows; spec/26-envelope.md names the text. Held
/// are vulkan, d3d11, webgpu and opengl. For each MAY pixel the command names two rasterizers that differ.
///
/// Samples are pixel centres. Several samples in a pixel, lines, points and clipping are not part of it.
///
/// With --check the exit status is 1 if the picture is not legal, or if no single rasterizer draws it.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The API: vulkan, d3d11, webgpu or opengl.
    #[arg(long, value_name = "API")]
    api: Api,
    /// The scene: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of triangles. Integer
    /// coordinates ("v") count 1/256 pixel.
    #[arg(long, value_name = "FILE")]
    scene: String,
    /// Window as WIDTHxHEIGHT.
    #[arg(long, value_parser = super::parse_size, default_value = "64x64")]
    window: (u32, u32),
    /// Sub-pixel bits as LOW..HIGH, or one number: of your device, or of those that you test. By default from the
    /// fewest that the API allows to 12.
    #[arg(long, value_name = "LOW..HIGH", value_parser = parse_bits)]
    bits: Option<(u32, u32)>,
    /// Only these roundings of vertices: floor, nearest-even and so on, by the names of spec/01-words.md; for d3d11
    /// nearest-even, up-within-0.6 and down-within-0.6.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    snap: Vec<String>,
    /// For each triangle that is listed, search the smallest move of its vertices after which all rasterizers
    /// cover the same pixels: those of the triangle as it is given.
    #[arg(long)]
    robust: bool,
    /// How far --robust moves vertices at most, in pixels: a multiple of 1/16.
    #[arg(long, value_name = "PIXELS", default_value = "1", value_parser = parse_within)]
    within: u32,
    /// Check a picture of the window: the answers of `eval` as JSON Lines, or a PNG with one pixel for each of the
    /// window (`render` needs --zoom 1), where black and the background of `render` are not covered.
    #[arg(long, value_name = "PICTURE")]
    check: Option<PathBuf>,
    /// Write the window as PNG: MUST is green, MAY is yellow, MUST NOT is dark.
    #[arg(long, value_name = "FILE")]
    png: Option<PathBuf>,
    /// How many triangles with MAY pixels are listed.
    #[arg(long, default_value_t = 20)]
    rows: usize,
    /// Print the report as JSON, with the counts of every triangle.
    #[arg(long)]
    json: bool,
}

fn parse_bits(text: &str) -> Result<(u32, u32), String> {
    let number = |text: &str| text.trim().parse().ok();
    let range = match text.split_once("..") {
        Some((low, high)) => number(low).zip(number(high)),
        None => number(text).map(|bits| (bits, bits)),
    };
    range.ok_or_else(|| "bits are LOW..HIGH or one number, for example 4..12 or 8".to_owned())
}

/// Pixels as steps of 1/16.
fn parse_within(text: &str) -> Result<u32, String> {
    let steps = text.trim().parse::<f64>().ok().map(|pixels| pixels * f64::from(STEPS));
    let fits = |steps: &f64| steps.fract() == 0.0 && (1.0..=256.0).contains(steps);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 1 to 256"
    )]
    steps
        .filter(fits)
        .map(|steps| steps as u32)
        .ok_or_else(|| "a multiple of 1/16 pixel from 0.0625 to 16 is needed".to_owned())
}

impl From<EnvelopeError> for Failure {
    fn from(error: EnvelopeError) -> Self {
        Self::input(error)
    }
}

/// A scene and the family that draws it.
struct Question<'a> {
    arguments: &'a Arguments,
    family: Family,
    scene: Scene,
    shapes: Vec<Shape>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let window = arguments.window;
    let family = Family::new(arguments.api, arguments.bits, &arguments.snap)?;
    // A depth for scenes that come through a camera; coverage does not depend on it.
    let viewport = Viewport { width: window.0, height: window.1, depth_max: (1 << 24) - 1 };
    if let Some(path) = &arguments.png {
        check_place(path)?;
    }
    let scene = scene::load(&arguments.scene, &viewport)?;
    if let Some(first) = &scene.first_dropped {
        let (name, dropped) = (&scene.name, scene.dropped);
        eprintln!("note: {name}: {dropped} triangles are left out; the first reason: {first}");
    }
    let shapes = shapes(&scene)?;
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get);
    let envelope = Envelope::of(&family, &shapes, window, threads)?;
    let verdict = match &arguments.check {
        Some(path) => {
            let covered = picture::read(path, window)?;
            Some(check(&family, &shapes, &envelope, (&covered.pixels, covered.size))?)
        }
        None => None,
    };
    let alone = counts(&family, &shapes, window, threads);
    let question = Question { arguments, family, scene, shapes };
    let report = report::Report::new(&question, &envelope, &alone, verdict.as_ref());
    let mut output = Output::new();
    if arguments.json {
        output.json(&report)?;
    } else {
        output.text(report.text(&question))?;
    }
    if let Some(path) = &arguments.png {
        let zoom = picture::write(path, &envelope)?;
        if !arguments.json {
            let (width, height) = (window.0 * zoom, window.1 * zoom);
            let path = path.display();
            output.line(format!(
                "{path}: {width} x {height}; green: MUST, yellow: MAY, dark: MUST NOT"
            ))?;
        }
    }
    output.flush()?;
    let legal = verdict.is_none_or(|verdict| verdict.drawn_by.is_some());
    Ok(if legal { Outcome::Good } else { Outcome::Mismatch })
}
