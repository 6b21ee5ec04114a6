//! The units of a profile through a synthesis tool: counted cells in the place of an estimate.
//!
//! yosys maps each distinct unit to four-input look-up tables without a process library. Its `ltp`
//! counts the nodes of the longest path between registers, not time, so the figures compare
//! budgets with each other and not with the picoseconds of [`super::Estimate`].

mod report;
mod verilog;

pub use verilog::{Source, sources};

use crate::profile::{InvalidProfile, Profile};
use serde::Serialize;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// The program as the search path knows it.
pub const YOSYS: &str = "yosys";

/// Carry chains stay adders of gates here: `alumacc` and the default technology map are in `synth`.
const SCRIPT: &str = "read_verilog unit.v; synth -flatten -noabc -top unit; abc -lut 4; opt_clean; \
                      stat; ltp -noff";

/// What a tool made of a profile's units.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Synthesis {
    /// Each distinct unit.
    pub units: Vec<UnitSynthesis>,
    /// Four-input look-up tables of all units, copies included.
    pub luts: u32,
    /// Flip-flops of all units, copies included.
    pub flip_flops: u32,
    /// The longest path of any unit, in nodes.
    pub longest_path: u32,
}

/// What a tool made of one unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct UnitSynthesis {
    /// `edge` or `depth`.
    pub name: &'static str,
    /// How many of them a profile has.
    pub copies: u32,
    /// Four-input look-up tables of one copy.
    pub luts: u32,
    /// Flip-flops of one copy.
    pub flip_flops: u32,
    /// Nodes on the longest path between registers or ports.
    pub longest_path: u32,
}

/// Why there are no figures.
#[derive(Debug, thiserror::Error)]
pub enum SynthesisError {
    /// The profile itself.
    #[error(transparent)]
    Profile(#[from] InvalidProfile),
    /// No such program.
    #[error(
        "{program} is not installed: install yosys (apt-get install yosys, \
         brew install yosys, or https://yosyshq.net) or give the path of the program"
    )]
    Missing {
        /// The program asked for.
        program: String,
    },
    /// A file or a process could not be used.
    #[error("{what}: {source}")]
    Io {
        /// Which.
        what: String,
        /// Why.
        source: std::io::Error,
    },
    /// The tool ran longer than allowed and was ended.
    #[error("yosys on the {unit} unit ran longer than {} s and was stopped", .limit.as_secs_f64())]
    Late {
        /// The unit.
        unit: &'static str,
        /// The limit.
        limit: Duration,
    },
    /// The tool gave up.
    #[error("yosys on the {unit} unit failed with {status}: {last}")]
    Failed {
        /// The unit.
        unit: &'static str,
        /// How it ended.
        status: ExitStatus,
        /// The last line it wrote.
        last: String,
    },
    /// The tool's report lacks a figure.
    #[error(
        "yosys wrote no {figure} for the {unit} unit: its report differs from the report of yosys 0.23"
    )]
    Report {
        /// The unit.
        unit: &'static str,
        /// The figure that was looked for.
        figure: &'static str,
    },
}

/// Synthesises each distinct unit of a profile with `yosys`, a path or a name on the search path
/// such as [`YOSYS`], within `limit` a unit. No shell is involved.
///
/// # Errors
/// [`SynthesisError`]; [`SynthesisError::Missing`] where there is no such program.
pub fn synthesise(
    profile: &Profile,
    yosys: &Path,
    limit: Duration,
) -> Result<Synthesis, SynthesisError> {
    let sources = sources(profile)?;
    let units = sources.iter().map(|source| synthesise_unit(source, yosys, limit));
    Ok(Synthesis::new(units.collect::<Result<_, _>>()?))
}

impl Synthesis {
    /// The figures of all units from those of each.
    pub fn new(units: Vec<UnitSynthesis>) -> Self {
        let sum = |figure: fn(&UnitSynthesis) -> u32| {
            units.iter().map(|unit| unit.copies * figure(unit)).sum()
        };
        Self {
            luts: sum(|unit| unit.luts),
            flip_flops: sum(|unit| unit.flip_flops),
            longest_path: units.iter().map(|unit| unit.longest_path).max().unwrap_or(0),
            units,
        }
    }
}

/// One unit of [`sources`] as in [`synthesise`]: for callers whose profiles share units.
///
/// # Errors
/// As for [`synthesise`].
pub fn synthesise_unit(
    source: &Source,
    yosys: &Path,
    limit: Duration,
) -> Result<UnitSynthesis, SynthesisError> {
    let folder = Folder::new()?;
    let path = |name: &str| folder.0.join(name);
    let io = |path: &Path| {
        let what = path.display().to_string();
        move |source| SynthesisError::Io { what, source }
    };
    std::fs::write(path("unit.v"), &source.verilog).map_err(io(&path("unit.v")))?;
    // To files: a pipe that nobody empties would stop the tool.
    let create = |name| File::create(path(name)).map_err(io(&path(name)));
    let mut child = Command::new(yosys)
        .args(["-p", SCRIPT])
        .current_dir(&folder.0)
        .stdin(Stdio::null())
        .stdout(create("out.txt")?)
        .stderr(create("err.txt")?)
        .spawn()
        .map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => {
                SynthesisError::Missing { program: yosys.display().to_string() }
            }
            _ => io(yosys)(error),
        })?;
    let status = wait(&mut child, limit).map_err(io(yosys))?;
    let Some(status) = status else {
        return Err(SynthesisError::Late { unit: source.name, limit });
    };
    let read = |name| std::fs::read(path(name)).map_err(io(&path(name)));
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    let out = text(read("out.txt")?);
    if !status.success() {
        let err = text(read("err.txt")?);
        let last = err.lines().chain(out.lines()).find(|line| line.contains("ERROR"));
        let last = last.or(out.lines().last()).unwrap_or_default().to_owned();
        return Err(SynthesisError::Failed { unit: source.name, status, last });
    }
    report::parse(&out, source)
}

/// Waits for the child to end; ends it and gives `None` when it takes longer than `limit`.
fn wait(child: &mut Child, limit: Duration) -> std::io::Result<Option<ExitStatus>> {
    let begin = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if begin.elapsed() >= limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A temporary folder, gone with this value.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Self, SynthesisError> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let next = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("guardbit-synthesis-{}-{next}", std::process::id());
        let path = std::env::temp_dir().join(name);
        // Not create_dir_all: a folder that is there already belongs to somebody else.
        std::fs::create_dir(&path)
            .map_err(|source| SynthesisError::Io { what: path.display().to_string(), source })?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::load;

    #[test]
    fn a_missing_tool_says_how_to_get_it() {
        let profile = load("tiny").unwrap();
        let program = Path::new("guardbit-has-no-such-program");
        let error = synthesise(&profile, program, Duration::from_secs(1)).unwrap_err();
        assert!(
            matches!(&error, SynthesisError::Missing { program } if program.contains("no-such"))
        );
        assert!(error.to_string().contains("install yosys"), "{error}");
    }

    #[test]
    fn a_child_over_its_limit_is_ended() {
        let mut child = Command::new("sleep").arg("600").spawn().unwrap();
        let begin = Instant::now();
        assert_eq!(wait(&mut child, Duration::from_millis(20)).unwrap(), None);
        assert!(begin.elapsed().as_secs() < 60);
        assert!(child.try_wait().unwrap().is_some(), "no process is left behind");
    }

    #[test]
    fn a_folder_goes_with_its_value() {
        let folder = Folder::new().unwrap();
        let path = folder.0.clone();
        std::fs::write(path.join("unit.v"), "").unwrap();
        drop(folder);
        assert!(!path.exists());
    }
}
