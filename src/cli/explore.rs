//! `guardbit explore`: the effect and the cost of each bit on given scenes.

mod chart;
mod extremes;
mod files;
mod keeper;
mod session;
mod synthesis;
mod table;

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::vectors::parse_shard;
use files::FileArguments;
use guardbit::explore::field::Field;
use guardbit::explore::metric::{self, Metric};
use guardbit::explore::pareto;
use guardbit::explore::record::Record;
use guardbit::explore::space::{Axis, Space};
use guardbit::explore::sweep::Sweep;
use guardbit::measure::accuracy::Reference;
use guardbit::model::{Model, View};
use guardbit::profile::{self, Profile};
use guardbit::scene;
use guardbit::vector::plan::Shard;
use session::Session;
pub(crate) use session::{PATIENCE, in_words};
use std::io::Write;
use std::path::PathBuf;
pub(crate) use table::{FIGURES, figure, help as columns_help};

/// Measure every budget of a search space on scenes: accuracy, hardware cost, software speed, Pareto
/// front.
///
/// A budget is one choice of values for the varied fields. The report separates two errors. The snap
/// error compares the scene with the same scene on the vertex grid; its metrics begin with `snap-`. The
/// arithmetic error compares the drawing with the exact picture of the scene on the grid.
#[derive(Debug, clap::Args)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(crate) struct Arguments {
    #[command(flatten)]
    space: SpaceArguments,
    /// A metric to minimise for the Pareto front; repeat the option for more metrics.
    #[arg(long = "objective", value_name = "METRIC", value_parser = parse_metric)]
    objectives: Vec<Metric>,
    /// Save each result to FILE, and continue from the results that FILE already has.
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Measure part I of N parts of the space, as I/N; I starts at 0. Join the parts with --merge.
    #[arg(long, value_name = "I/N", value_parser = parse_shard)]
    shard: Option<Shard>,
    /// Do not measure: join result files that --save wrote for the same request.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["save", "shard"])]
    merge: Vec<PathBuf>,
    /// Do not measure the speed of the model. The output is then the same on every computer.
    #[arg(long)]
    no_speed: bool,
    /// Do not measure a space: draw extreme cases of area, slopes, w, depth, window and walk, reduce one
    /// field of the profile at a time, and report the first value that fails.
    #[arg(long, conflicts_with_all = ["objectives", "save", "shard", "merge", "csv", "all"])]
    extremes: bool,
    /// Print a JSON array with one object for each budget.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print comma-separated values, with one column for each metric.
    #[arg(long)]
    csv: bool,
    /// Print every budget in the table, not only the Pareto front.
    #[arg(long)]
    all: bool,
    #[command(flatten)]
    files: FileArguments,
}

/// What `explore` and `fit` search, and on what.
#[derive(Debug, clap::Args)]
pub(crate) struct SpaceArguments {
    /// The profile to vary: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    pub(crate) profile: String,
    /// A scene: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of triangles; repeat the option for
    /// more scenes.
    #[arg(long = "scene", value_name = "S", default_value = "knot")]
    pub(crate) scenes: Vec<String>,
    /// A field and its values, for example interpolation=6..13 or rounding=floor,nearest-even; repeat the
    /// option for more fields. `guardbit explore --vary help` lists the fields.
    #[arg(long = "vary", value_name = "FIELD=VALUES")]
    pub(crate) axes: Vec<String>,
    /// Window as WIDTHxHEIGHT; by default the window of the profile, but at most 1024 x 1024.
    #[arg(long, value_parser = super::parse_size)]
    pub(crate) window: Option<(u32, u32)>,
    /// Number of worker threads.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

impl SpaceArguments {
    /// The profile, in the window that is searched.
    pub(crate) fn base(&self) -> Result<Profile, Failure> {
        let mut base = profile::load(&self.profile)?;
        crate::cli::takes_primitives(&base)?;
        let window = &mut base.window;
        (window.width, window.height) =
            self.window.unwrap_or((window.width.min(1024), window.height.min(1024)));
        base.validate().map_err(Failure::input)?;
        Ok(base)
    }

    /// The space and the scenes of it; `default` makes the axes where none are named.
    pub(crate) fn sweep(&self, default: fn(&Profile) -> Vec<Axis>) -> Result<Sweep, Failure> {
        let base = self.base()?;
        let axes = if self.axes.is_empty() {
            default(&base)
        } else {
            let parsed: Result<_, _> = self.axes.iter().map(|text| Axis::parse(text)).collect();
            parsed.map_err(Failure::input)?
        };
        let model = Model::with_view(&base, View::default()).map_err(Failure::input)?;
        let space = Space::new(base.clone(), axes).map_err(Failure::input)?;
        let mut scenes = Vec::new();
        for source in &self.scenes {
            let scene = scene::load(source, &model.viewport())?;
            if scene.triangles.is_empty() {
                return Err(Failure::input(format!(
                    "{source}: the scene has no triangles to measure"
                )));
            }
            scenes.push(Reference::new(scene, &base));
        }
        Ok(Sweep { space, scenes })
    }
}

/// Refuses metrics of channels that the profile does not have, or that a scene has no values for.
pub(crate) fn check_channels(
    sweep: &Sweep,
    sources: &[String],
    metrics: &[Metric],
) -> Result<(), Failure> {
    let base = sweep.space.base();
    for metric in metrics {
        let Some(name) = metric.channel() else { continue };
        let names: Vec<&str> = base.channel.iter().map(|own| own.name.as_str()).collect();
        if !names.contains(&name) {
            let known = if names.is_empty() { "no channels".to_owned() } else { names.join(", ") };
            return Err(Failure::input(format!(
                "{}: there is no metric of this name, and {} has {known}; the metrics are {}",
                metric.name,
                base.name,
                metric::names()
            )));
        }
        if base.multisample.is_some() {
            return Err(Failure::input(format!(
                "{}: channels are measured where a pixel has one sample; remove [multisample]",
                metric.name
            )));
        }
        let model = Model::new(base).map_err(Failure::input)?;
        for (scene, source) in sweep.scenes.iter().zip(sources) {
            for n in 0..scene.triangles.len() {
                let values = model.scene_values(&scene.attributes, n);
                values
                    .map_err(|error| Failure::input(format!("{source}: triangle {n}: {error}")))?;
            }
        }
    }
    Ok(())
}

/// `name=value`.
pub(crate) fn in_words_budget(name: &str, value: impl std::fmt::Display) -> String {
    format!("{name}={value}")
}

/// The metric of a name.
pub(crate) fn parse_metric(name: &str) -> Result<Metric, String> {
    Metric::find(name).ok_or_else(|| {
        format!("there is no metric of this name; the metrics are {}", metric::names())
    })
}

/// What a bare `explore` varies: bits that matter on every scene.
fn default_axes(base: &Profile) -> Vec<Axis> {
    let mut axes = vec![Axis {
        field: Field::SUB_PIXEL,
        values: [4, 6, 8, 10].map(guardbit::explore::field::Value::Bits).to_vec(),
    }];
    if let Some(depth) = base.depth {
        let bits = |from: u32, to| (from..=to).map(guardbit::explore::field::Value::Bits).collect();
        let most = depth.interpolation;
        axes.push(Axis {
            field: Field::INTERPOLATION,
            values: bits(most.saturating_sub(10), most),
        });
        axes.push(Axis { field: Field::GUARD, values: bits(0, depth.guard.max(1)) });
    }
    axes
}

/// What budgets are weighed by where nothing else is named.
fn default_objectives() -> Vec<Metric> {
    // What is refused is not drawn, and so is never wrong.
    let names =
        ["area", "misclassified", "snap-misclassified", "depth-rms-world", "wraps", "snap-refused"];
    names.into_iter().filter_map(Metric::find).collect()
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.space.axes.iter().any(|axis| axis == "help") {
        return table::help();
    }
    if arguments.extremes {
        return extremes::run(&arguments.space, arguments.json);
    }
    let sweep = arguments.space.sweep(default_axes)?;
    let objectives = if arguments.objectives.is_empty() {
        default_objectives()
    } else {
        arguments.objectives.clone()
    };
    check_channels(&sweep, &arguments.space.scenes, &objectives)?;
    arguments.files.check()?;
    let threads = super::vectors::threads(arguments.space.threads);
    let session = Session::new(&sweep, threads);
    let mut records: Vec<Record> = if arguments.merge.is_empty() {
        session.measure(arguments.save.as_deref(), arguments.shard, !arguments.no_speed)?
    } else {
        session.merge(&arguments.merge)?
    };
    let mut output = Output::new();
    if records.is_empty() {
        arguments.files.leave();
        output.text(if arguments.json { "[\n]\n" } else { "" })?;
        output.flush()?;
        return Ok(Outcome::Good);
    }
    pareto::mark(&mut records, &objectives);
    arguments.files.synthesise(&sweep, &mut records, threads)?;
    arguments.files.write(&arguments.space, &sweep, &records, &objectives)?;
    if arguments.json {
        output.line("[")?;
        for (n, record) in records.iter().enumerate() {
            let text = serde_json::to_string(record).map_err(Failure::input)?;
            output.line(format!("{text}{}", if n + 1 < records.len() { "," } else { "" }))?;
        }
        output.line("]")?;
    } else if arguments.csv {
        table::csv(&mut output, &records)?;
    } else {
        table::print(&mut output, &sweep, &records, &objectives, arguments.all)?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}
