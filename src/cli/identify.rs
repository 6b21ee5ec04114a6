//! `guardbit identify`: which rasterizers are behind captures.

mod device;
mod report;

use super::Outcome;
use super::failure::Failure;
use super::output::{Output, check_place, write_text};
use super::pixels::covered;
use super::progress;
use device::Device;
use guardbit::explore::identify::{
    Answer, Capture, Case, Hypotheses, Identifier, Next, Pixels, Reading,
};
use guardbit::explore::space::Axis;
use guardbit::profile;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Find the rasterizers that agree with captures of an unknown one, exactly and all of them.
///
/// A case is one JSON line: a triangle as `eval` takes it, with "f" in pixels, and the answer. The answer is
/// "rows" and, with depth, "z", as `eval` writes them; or "png", a picture of the window in which every pixel
/// is covered that is neither black nor the background of `render`. "unknown": [[x0,y0,x1,y1], ...]
/// and "scissor": [x0,y0,x1,y1] say about which pixels nothing is known. For a register-level base, a case has
/// "words" and "out".
///
/// Sub-pixel bits, snapping, sample position, fill rule, storage and width of edge words are found, and of depth
/// the interpolation bits, rounding, start and division. Dithered and blended pictures are not understood: give
/// which pixels are covered.
///
/// Exit status 1 if nothing fits, 2 if the device fails.
#[derive(Debug, clap::Args)]
#[allow(clippy::struct_excessive_bools, reason = "each is a flag of the command")]
pub(crate) struct Arguments {
    /// The captures: a JSON Lines file.
    #[arg(long, value_name = "FILE")]
    cases: Option<PathBuf>,
    /// The profile that the hypotheses start from: it gives the machine, the vertex field, and the depth
    /// bits if there is depth.
    #[arg(long, value_name = "PROFILE", default_value = "sgi-4k")]
    base: String,
    /// Leave depth out of the search, for a machine that takes no depth.
    #[arg(long)]
    no_depth: bool,
    /// Also try machines that leave out the triangles of one winding.
    #[arg(long, conflicts_with = "near")]
    cull: bool,
    /// Window of the captures as WIDTHxHEIGHT.
    #[arg(long, value_parser = super::parse_size, default_value = "64x64")]
    window: (u32, u32),
    /// Values that a field may have, as FIELD=VALUES; repeat it for more fields. `form` tries other machines.
    #[arg(long = "vary", value_name = "FIELD=VALUES", value_parser = parse_axis)]
    axes: Vec<Axis>,
    /// Instead, try the base and every profile within N decisions of its machine. For register-level machines.
    #[arg(long, value_name = "N", conflicts_with = "axes", value_parser = clap::value_parser!(u32).range(0..=3))]
    near: Option<u32>,
    /// The integers of "v" are 2^-BITS pixels. Without it, "v" is refused.
    #[arg(long, value_name = "BITS", value_parser = clap::value_parser!(u32).range(0..=24))]
    lattice: Option<u32>,
    /// The pictures may be moved by at most N pixels on each axis, all in the same way.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=16))]
    shift: u32,
    /// The pictures may be mirrored, all in the same way.
    #[arg(long)]
    mirror: bool,
    /// At most N cases may be wrong.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=200))]
    wrong: u8,
    /// Print the triangle to draw next: the one whose answer leaves the fewest.
    #[arg(long)]
    next: bool,
    /// Ask a device until nothing more can be told apart. CMD reads triangles as `eval` takes them, and
    /// answers each line in the same form.
    #[arg(long, value_name = "CMD", conflicts_with = "next")]
    device: Option<String>,
    /// Seconds to wait for an answer of the device.
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=3600))]
    timeout: u64,
    /// The most triangles that the device is asked.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u64).range(1..=4096))]
    probes: u64,
    /// Seed of the triangles that are tried for --next and --device.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write the triangles and answers of the device to FILE, as cases.
    #[arg(long, value_name = "FILE", requires = "device")]
    save: Option<PathBuf>,
    /// Write the first profile found to FILE, as TOML.
    #[arg(long, value_name = "FILE")]
    profile_out: Option<PathBuf>,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

fn parse_axis(text: &str) -> Result<Axis, String> {
    Axis::parse(text).map_err(|error| error.to_string())
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.cases.is_none() && arguments.device.is_none() && !arguments.next {
        return Err(Failure::input("there is nothing to go by")
            .hint("give --cases FILE, or --device CMD, or ask for a first triangle by --next"));
    }
    // What is learned from a device must not be lost for want of a place.
    for path in [&arguments.save, &arguments.profile_out].into_iter().flatten() {
        check_place(path)?;
    }
    let hypotheses = hypotheses(arguments)?;
    let cases = read(arguments)?;
    let captures = Capture::all(arguments.shift, arguments.mirror);
    let with_depth =
        |case: &Case| matches!(&case.answer, Answer::Picture { depth, .. } if !depth.is_empty());
    if captures.len() > 1 && cases.iter().any(with_depth) {
        return Err(Failure::input("--shift, --mirror: pictures with depth cannot be moved")
            .hint("leave \"z\" out until the picture is known"));
    }
    let monitor = progress::monitor();
    let go_on = || !monitor.cancel.load(Ordering::Relaxed);
    let mut identifier = Identifier::new(&hypotheses, captures.clone(), arguments.wrong);
    if identifier.left() == 0 {
        return Err(Failure::input("no hypothesis is a valid profile").hint(
            "choose a --base with a vertex field of at most 32 bits, or other values in --vary",
        ));
    }
    for case in &cases {
        if !go_on() {
            return Err(Failure::interrupted("interrupted; nothing was printed"));
        }
        identifier.observe(case);
    }
    let mut all = cases;
    let mut stopped = None;
    if let Some(command) = &arguments.device {
        stopped = ask(arguments, command, (&mut identifier, &mut all), &go_on)?;
    }
    let conflict = if identifier.left() == 0 {
        Identifier::conflict(&hypotheses, (&captures, arguments.wrong), &all, &mut || go_on())
    } else {
        Vec::new()
    };
    let next = (arguments.next && identifier.left() > 0).then(|| identifier.next(arguments.seed));
    let learned = arguments.profile_out.as_ref().filter(|_| !all.is_empty());
    if let (Some(path), Some(found)) = (learned, identifier.found(1).first()) {
        write_text(path, &found.profile.to_toml())?;
    }
    let mut output = Output::new();
    // A device that fails is an error, whatever was learned before.
    let failed = stopped.as_ref().is_some_and(|stopped| stopped.starts_with("probe "));
    let report = report::Report { identifier: &identifier, cases: &all, conflict, next, stopped };
    if arguments.json {
        report.json(&mut output)?;
    } else {
        report.print(&mut output)?;
    }
    output.flush()?;
    Ok(match (identifier.left(), failed) {
        (0, _) => Outcome::Mismatch,
        (_, true) => Outcome::BadInput,
        _ => Outcome::Good,
    })
}

fn hypotheses(arguments: &Arguments) -> Result<Hypotheses, Failure> {
    let mut base = profile::load(&arguments.base)?;
    let (width, height) = arguments.window;
    if u64::from(width) * u64::from(height) > 1 << 20 {
        return Err(Failure::input(format!(
            "{width} x {height}: a window has at most 2^20 pixels"
        )));
    }
    (base.window.width, base.window.height) = (width, height);
    if arguments.no_depth {
        (base.depth, base.w) = (None, None);
        base.channel.clear();
    }
    base.validate().map_err(Failure::input)?;
    if let Some(changes) = arguments.near {
        return Ok(Hypotheses::near(base, changes));
    }
    super::takes_primitives(&base).map_err(|failure| {
        failure.hint("--near N tries the profiles within N decisions of such a machine")
    })?;
    let hypotheses = Hypotheses::of(base, arguments.axes.clone());
    let hypotheses = if arguments.cull { hypotheses.with_culling() } else { hypotheses };
    if let Some(field) = hypotheses.unfit() {
        let message = format!("--vary {}: identify takes this field from --base", field.name());
        return Err(Failure::input(message).hint(
            "it varies sub-pixel, snap, form, edge-width and other fields of coverage, and of depth \
             interpolation, rounding, start-bias and reciprocal",
        ));
    }
    Ok(hypotheses)
}

/// How the lines of this command are read.
fn reading<'a>(arguments: &Arguments, folder: &'a Path) -> Reading<'a> {
    let (window, lattice) = (arguments.window, arguments.lattice);
    Reading { window, lattice, folder, picture }
}

fn read(arguments: &Arguments) -> Result<Vec<Case>, Failure> {
    let Some(path) = &arguments.cases else { return Ok(Vec::new()) };
    let name = path.display().to_string();
    let text = guardbit::profile::read_text_at_most(path, guardbit::scene::LARGEST)
        .map_err(|error| Failure::io(&name, &error))?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let cases = reading(arguments, folder).cases(&name, &text).map_err(Failure::input)?;
    if cases.is_empty() && !arguments.next && arguments.device.is_none() {
        return Err(Failure::input(format!("{name}: the file has no case")));
    }
    Ok(cases)
}

fn picture(path: &Path) -> Result<Pixels, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    covered(std::io::BufReader::new(file))
}

/// Asks a device until nothing splits what is left; why it stopped before that.
fn ask(
    arguments: &Arguments,
    command: &str,
    (identifier, cases): (&mut Identifier, &mut Vec<Case>),
    go_on: &dyn Fn() -> bool,
) -> Result<Option<String>, Failure> {
    let mut device = Device::start(command)?;
    let reading = reading(arguments, Path::new("."));
    let mut lines = String::new();
    let mut stopped = None;
    for id in 1..=arguments.probes {
        if !go_on() {
            stopped = Some("interrupted".to_owned());
            break;
        }
        let Next::Draw(probe) = identifier.next(arguments.seed.wrapping_add(id)) else { break };
        let line = probe.line(id);
        let answer = match device.ask(&line, Duration::from_secs(arguments.timeout)) {
            Ok(answer) => answer,
            Err(why) => {
                stopped = Some(format!("probe {id}: {why}"));
                break;
            }
        };
        let joined = match join(&line, &answer) {
            Ok(joined) => joined,
            Err(why) => {
                stopped = Some(format!("probe {id}: the device answered {why}"));
                break;
            }
        };
        match reading.case(&joined, &format!("probe {id}")) {
            Ok(case) => {
                lines.push_str(&joined);
                lines.push('\n');
                identifier.observe(&case);
                cases.push(case);
            }
            Err(why) => {
                stopped = Some(format!("probe {id}: the device answered {answer:?}: {why}"));
                break;
            }
        }
        if identifier.left() == 0 {
            break;
        }
        if id == arguments.probes {
            stopped = Some(format!("{id} triangles were asked, as --probes says"));
        }
    }
    if let Some(path) = &arguments.save {
        write_text(path, &lines)?;
    }
    Ok(stopped)
}

/// Whether the vertices of a line have three numbers.
fn line_has_depth(line: &str) -> bool {
    let value: serde_json::Value = serde_json::from_str(line).unwrap_or_default();
    value["f"][0].as_array().is_some_and(|vertex| vertex.len() == 3)
}

/// A triangle and its answer as one case.
fn join(line: &str, answer: &str) -> Result<String, String> {
    let object = |text: &str| -> Result<serde_json::Map<String, serde_json::Value>, String> {
        serde_json::from_str(text).map_err(|error| format!("{text:?}: {error}"))
    };
    let (mut case, answer) = (object(line)?, object(answer)?);
    if let Some(error) = answer.get("error") {
        let hint = "; for a device that takes no depth, give --no-depth";
        let text = error.as_str().unwrap_or("an error");
        return Err(format!(
            "with an error: {text}{}",
            if line_has_depth(line) { hint } else { "" }
        ));
    }
    if answer.get("id") != case.get("id") {
        return Err("with the id of another line".to_owned());
    }
    case.extend(answer);
    Ok(serde_json::Value::from(case).to_string())
}
