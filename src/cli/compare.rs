//! `guardbit compare`: compares machines on one scene.

mod depth;
mod experiment;
mod gallery;
mod interpolation;
mod machine;
mod picture;
mod size;
mod traversal;

use super::Outcome;
use super::failure::Failure;
use super::output::check_place;
use super::progress;
use clap::ValueEnum;
use guardbit::cover::Stamp;
use guardbit::measure::comparison::Compared;
use guardbit::profile::{self, Profile, triangle_machines};
use guardbit::scene::{self, Scene};
use std::path::PathBuf;
use std::sync::atomic::Ordering;

/// Compare machines (rasterization algorithms) on one scene: coverage and depth error against the exact
/// result, operations, bits, time.
///
/// Every machine draws the same scene with the vertex field, fill rule and words of the profile. Exit
/// status 1 if a machine exceeds its stated error bound, or if a machine whose coverage must be exact
/// differs from the exact picture.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// The scene: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of triangles.
    #[arg(long, default_value = "knot")]
    scene: String,
    /// Window as WIDTHxHEIGHT; by default the window of the profile, but at most 1024 x 1024, and 96 x 72
    /// with --profiles.
    #[arg(long, value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// What to compare.
    #[arg(long, value_enum, default_value_t = Show::Machines)]
    show: Show,
    /// Draw the scene with each of these profiles instead: names or files, with commas between them. Without
    /// a value, draw it with all built-in profiles of real rasterizers. PROFILE then only defines the unit of
    /// integer coordinates in the scene.
    #[arg(
        long,
        value_name = "PROFILES",
        value_delimiter = ',',
        num_args = 0..=1,
        default_missing_value = "all",
        conflicts_with_all = ["show", "machines", "stamp"]
    )]
    profiles: Option<Vec<String>>,
    /// Compare only these machines: names of `form` in a profile, with commas between them.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = parse_machine)]
    machines: Vec<&'static str>,
    /// Block of pixels that a traversal visits in one step: 1x1, 2x1 or 2x2.
    #[arg(long, value_name = "STAMP", value_parser = parse_stamp, default_value = "1x1")]
    stamp: Stamp,
    /// Do not measure time. The output is then the same on every computer.
    #[arg(long)]
    no_time: bool,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
    /// Also write an SVG picture: error maps of the machines, or a chart of cost against triangle size.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Show {
    /// All machines, one row for each.
    Machines,
    /// Cost against triangle size for each machine; the scene is not used.
    Sizes,
    /// Traversal orders: the samples that each order visits, and the accumulators that then read differently.
    Traversal,
    /// Depth formats: the step between codes over distance, and ties.
    Depth,
    /// Attributes: affine interpolation and several methods for perspective, with error and operations.
    Interpolation,
    /// T-vertices, acute triangles, a moved sample grid, outlines; the scene is not used.
    Experiments,
}

pub(crate) fn parse_machine(text: &str) -> Result<&'static str, String> {
    let known: Vec<&str> = triangle_machines().map(|kind| kind.name).collect();
    let found = known.iter().copied().find(|name| *name == text);
    found.ok_or_else(|| format!("the machines are {}", known.join(", ")))
}

fn parse_stamp(text: &str) -> Result<Stamp, String> {
    let found = Stamp::ALL.into_iter().find(|stamp| stamp.name() == text);
    found.ok_or_else(|| "a stamp is 1x1, 2x1 or 2x2".to_owned())
}

/// A scene through one profile, about to be compared.
struct Request<'a> {
    profile: Profile,
    scene: Scene,
    arguments: &'a Arguments,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if let Some(names) = &arguments.profiles {
        return gallery::show(arguments, names);
    }
    let mut profile = profile::load(&arguments.profile)?;
    let window = &mut profile.window;
    (window.width, window.height) =
        arguments.window.unwrap_or((window.width.min(1024), window.height.min(1024)));
    profile.validate().map_err(Failure::input)?;
    if let Some(path) = &arguments.svg {
        if !matches!(arguments.show, Show::Machines | Show::Sizes) {
            return Err(Failure::input("--svg: this comparison has no picture")
                .hint("--svg works with --show machines, --show sizes and --profiles"));
        }
        check_place(path)?;
    }
    let model = guardbit::model::Model::new(&profile).map_err(Failure::input)?;
    let scene = scene::load(&arguments.scene, &model.viewport())?;
    let request = Request { profile, scene, arguments };
    match arguments.show {
        Show::Machines => machine::show(request),
        Show::Sizes => size::show(request),
        Show::Traversal => traversal::show(request),
        Show::Depth => depth::show(request),
        Show::Interpolation => interpolation::show(request),
        Show::Experiments => experiment::show(&request),
    }
}

impl Request<'_> {
    /// The machines asked for; all of them by default.
    fn machines(&self) -> Vec<&'static str> {
        let all = || triangle_machines().map(|kind| kind.name).collect();
        if self.arguments.machines.is_empty() { all() } else { self.arguments.machines.clone() }
    }

    fn timed(&self) -> bool {
        !self.arguments.no_time
    }
}

fn compared(scene: Scene, profile: &Profile) -> Result<Compared, Failure> {
    Compared::new(scene, profile).map_err(Failure::input)
}

/// Runs a measurement that asks whether to go on before each part; Ctrl-C ends it.
fn interruptible<T>(
    work: impl FnOnce(&mut dyn FnMut() -> bool) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let monitor = progress::monitor();
    let result = work(&mut || !monitor.cancel.load(Ordering::Relaxed))?;
    if monitor.cancel.load(Ordering::Relaxed) {
        return Err(Failure::interrupted("interrupted; nothing was printed"));
    }
    Ok(result)
}

/// A count or a rate, with as many digits as it deserves.
fn number(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        v if v.abs() >= 1000.0 => format!("{v:.0}"),
        v if v.abs() >= 10.0 => format!("{v:.1}"),
        v if v.abs() >= 0.001 => format!("{v:.3}"),
        v => format!("{v:.1e}"),
    }
}
