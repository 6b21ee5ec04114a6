//! Whether a module of a user's RTL is the unit of a profile, for all inputs and for all time: by free tools,
//! against the reference of [`super::reference`]. Spec clause `J-9`.

mod clauses;
mod division;
mod engine;
mod map;
mod miter;
mod netlist;
mod polynomial;
mod setup;
mod simulate;
mod stepper;
mod tool;
mod unit;
mod words;
mod work;

pub use division::WrongDivision;
pub use map::{Map, MapError, Reset, Steps};
pub use unit::{Block, Signal};

use super::reference::{ReferenceError, devices};
use super::write::Devices;
use crate::profile::Profile;
use crate::setup::Triangle;
use map::Wiring;
use num_bigint::BigInt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use unit::Unit;
use work::{Device, Work};

/// What was asked.
#[derive(Clone, Debug)]
pub struct Question<'a> {
    /// The profile.
    pub profile: &'a Profile,
    /// Its unit.
    pub block: Block,
    /// The files of the module.
    pub rtl: &'a [PathBuf],
    /// How the module's ports are the unit's signals; `None`: as the devices of `hdl` call them.
    pub map: Option<&'a Map>,
    /// A folder for all texts and for what the tools print. It must not be there yet.
    pub folder: &'a Path,
    /// How long each tool may run.
    pub limit: Duration,
}

/// What became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No input ever makes a difference.
    Proved {
        /// What proved it.
        engine: &'static str,
        /// Its own words.
        words: String,
    },
    /// Some inputs do.
    Refuted(Refutation),
    /// Nobody knows.
    Undecided {
        /// What the tools said.
        words: String,
    },
}

/// What shows a difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refutation {
    /// Inputs from reset on: a waveform in the folder.
    Wave(&'static str),
    /// A triangle.
    Triangle(Counterexample),
    /// A division.
    Division(WrongDivision),
}

/// A triangle, and words of it that differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counterexample {
    /// The triangle, in sub-pixels and depth codes.
    pub triangle: Triangle,
    /// The words.
    pub words: Vec<Differing>,
}

/// A word that differs, as patterns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Differing {
    /// The signal.
    pub name: &'static str,
    /// The module's.
    pub got: BigInt,
    /// The model's.
    pub want: BigInt,
}

/// A question whose map fits: what each way of proving begins with. Each gives its verdict, and what it takes for
/// granted.
struct Asked<'a> {
    profile: &'a Profile,
    devices: &'a Devices,
    unit: &'a Unit,
    map: &'a Map,
    wiring: &'a Wiring,
    /// The module, as yosys sees it.
    module: &'a Device,
}

impl Asked<'_> {
    fn design(&self, what: String) -> EquivalenceError {
        EquivalenceError::Design { module: self.map.module.clone(), what }
    }
}

/// A verdict, and what it rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// What was taken for granted.
    pub assumed: Vec<String>,
    /// The unit's signals.
    pub signals: Vec<Signal>,
    /// How long it took.
    pub seconds: f64,
}

/// Why a question has no answer.
#[derive(Debug, thiserror::Error)]
pub enum EquivalenceError {
    /// The profile has no reference.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// The map does not fit.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The module is none that can be proved.
    #[error("{module}: {what}")]
    Design {
        /// The module.
        module: String,
        /// What is wrong with it and what to do.
        what: String,
    },
    /// A tool is missing.
    #[error("{tool} is not on the search path: apt-get install yosys z3, and ghdl for VHDL")]
    Missing {
        /// The tool.
        tool: &'static str,
    },
    /// A tool failed.
    #[error("{tool} stopped: {words}; its output is in {log}")]
    Tool {
        /// The tool.
        tool: &'static str,
        /// The line that says why.
        words: String,
        /// The file of all it printed.
        log: String,
    },
    /// A file or folder.
    #[error("{path}: {source}")]
    Io {
        /// Which.
        path: String,
        /// Why.
        source: std::io::Error,
    },
}

impl EquivalenceError {
    /// Whether a tool did not find a parameter in a module: in the words of yosys, or of GHDL.
    fn lacks_a_parameter(&self) -> bool {
        let says = |words: &str| words.contains("defparam") || words.contains("no generic");
        matches!(self, Self::Tool { words, .. } if says(words))
    }
}

fn io(path: &Path) -> impl FnOnce(std::io::Error) -> EquivalenceError {
    let path = path.display().to_string();
    |source| EquivalenceError::Io { path, source }
}

/// A map to begin with: of the module of the unit's name, or else of the one that no other has in it.
///
/// # Errors
/// [`EquivalenceError`] if the profile has no reference, or yosys is missing or does not read the files.
pub fn template(
    profile: &Profile,
    block: Block,
    rtl: &[PathBuf],
    folder: &Path,
    limit: Duration,
) -> Result<String, EquivalenceError> {
    let unit = Unit::new(block, (profile, &devices(profile)?));
    let work = Work { folder, limit };
    let (read, _) = work.sources(rtl, None, &[])?;
    let named = work.ports(&read, Some(block.module()), &[]);
    let (module, ports) = named.or_else(|_| work.ports(&read, None, &[]))?;
    Ok(Map::template(&unit, &module, &ports))
}

/// Asks the tools.
///
/// # Errors
/// [`EquivalenceError`] if the profile has no reference, the map does not fit, the module holds what no proof
/// here takes, a tool is missing, or a file cannot be written.
pub fn prove(question: &Question<'_>) -> Result<Answer, EquivalenceError> {
    let begun = Instant::now();
    let Question { profile, block, rtl, folder, limit, .. } = *question;
    let devices = devices(profile)?;
    let unit = Unit::new(block, (profile, &devices));
    let mut own = Map::of_devices(&unit);
    question.map.map_or(Ok(()), Map::is_spelt)?;
    std::fs::create_dir(folder).map_err(io(folder))?;
    let work = Work { folder, limit };
    let found = match work.device(rtl, question.map.unwrap_or(&own)) {
        // A module of this profile alone, with the ports of the devices.
        Err(error) if question.map.is_none() && error.lacks_a_parameter() => {
            own.parameters.clear();
            work.device(rtl, &own)?
        }
        found => found?,
    };
    let map = question.map.unwrap_or(&own);
    let wiring = map.fits(&unit, &found.ports)?;
    let asked =
        Asked { profile, devices: &devices, unit: &unit, map, wiring: &wiring, module: &found };
    let (verdict, mut assumed) = match block {
        Block::SetUp => setup::prove(&asked, &work)?,
        Block::Divider => division::prove(&asked, &work)?,
        Block::Engine => engine::prove(&asked, &work)?,
        Block::ReadOut
        | Block::Dda
        | Block::EdgeStepper
        | Block::EdgeEvaluator
        | Block::DepthEvaluator => stepper::prove(&asked, &work)?,
    };
    work.digests(rtl)?;
    if !map.parameters.is_empty() {
        let list = map.parameters.iter().map(|(name, value)| format!("{name} = {value}"));
        assumed
            .push(format!("the module has the parameters {}", list.collect::<Vec<_>>().join(", ")));
    }
    let seconds = begun.elapsed().as_secs_f64();
    Ok(Answer { verdict, assumed, signals: unit.signals, seconds })
}
