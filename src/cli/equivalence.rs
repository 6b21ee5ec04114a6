//! `guardbit prove --rtl`: a module of one's own against a unit of the profile.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use guardbit::profile;
use guardbit::vector::equivalence::{
    Answer, Block, Counterexample, EquivalenceError, Map, Question, Refutation, Signal, Verdict,
    WrongDivision, prove, template,
};
use guardbit::vector::write::scene_text;
use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;
use vcd::{Command, IdCode, Value};

/// The options of an equivalence proof.
#[derive(Debug, clap::Args)]
pub(crate) struct Options {
    /// Prove that a module of your own is a unit of the profile, for all inputs: its files in SystemVerilog or
    /// VHDL. The tools yosys and z3 do it, and ghdl for VHDL.
    #[arg(long, value_name = "FILE", num_args = 1.., requires = "block",
          conflicts_with_all = ["claim", "table", "window", "guard_band", "sub_pixel", "depth_bits", "w_ratio", "smt", "gappa", "check", "json"])]
    pub(crate) rtl: Vec<PathBuf>,
    /// The unit that the module is compared with.
    #[arg(long, value_name = "UNIT", requires = "rtl")]
    block: Option<Block>,
    /// A TOML file that says which port is which signal, and how late the outputs come. Without it the ports
    /// have the names of the devices of a set.
    #[arg(long, value_name = "FILE", requires = "rtl")]
    map: Option<PathBuf>,
    /// Print such a file for the module, and prove nothing.
    #[arg(long, requires = "rtl", conflicts_with = "map")]
    map_template: bool,
    /// Folder for reference, comparison, scripts, and all that the tools print. It must not be there yet.
    #[arg(long, value_name = "DIR", requires = "rtl", default_value = "guardbit-proof")]
    out: PathBuf,
}

impl From<EquivalenceError> for Failure {
    fn from(error: EquivalenceError) -> Self {
        match error {
            EquivalenceError::Io { path, source } => Self::io(&path, &source),
            other => Self::input(other),
        }
    }
}

pub(crate) fn run(profile: &str, limit: u64, arguments: &Options) -> Result<Outcome, Failure> {
    let Some(block) = arguments.block else {
        return Err(Failure::input("--rtl needs --block"));
    };
    let name = profile;
    let profile = profile::load(name)?;
    let limit = Duration::from_secs(limit);
    for file in &arguments.rtl {
        // A comment can be in any encoding.
        let text = std::fs::read(file)
            .map_err(|error| Failure::io(&file.display().to_string(), &error))?;
        if text.trim_ascii().is_empty() {
            return Err(Failure::input(format!("{} is empty", file.display())));
        }
    }
    let mut output = Output::new();
    if arguments.map_template {
        let folder =
            tempfile::tempdir().map_err(|error| Failure::io("a temporary folder", &error))?;
        output.text(template(&profile, block, &arguments.rtl, folder.path(), limit)?)?;
        output.flush()?;
        return Ok(Outcome::Good);
    }
    let map = match &arguments.map {
        None => None,
        Some(path) => {
            let name = path.display().to_string();
            let text = std::fs::read_to_string(path).map_err(|error| Failure::io(&name, &error))?;
            Some(Map::parse(&text).map_err(|error| Failure::input(format!("{name}: {error}")))?)
        }
    };
    if arguments.out.exists() {
        let name = arguments.out.display();
        return Err(Failure::input(format!("{name} is there already"))
            .hint("remove it, or give another folder with --out"));
    }
    let answer = prove(&Question {
        profile: &profile,
        block,
        rtl: &arguments.rtl,
        map: map.as_ref(),
        folder: &arguments.out,
        limit,
    })?;
    let folder = arguments.out.display();
    let seconds = answer.seconds;
    match &answer.verdict {
        Verdict::Proved { engine, words } => {
            output.line(format!("PROVED by {engine} in {seconds:.1} s: {words}"))?;
        }
        Verdict::Refuted(Refutation::Wave(wave)) => {
            output.line(format!("REFUTED in {seconds:.1} s; waves in {folder}/{wave}"))?;
            for line in rows(&arguments.out.join(wave), &answer)? {
                output.line(line)?;
            }
        }
        Verdict::Refuted(Refutation::Triangle(Counterexample { triangle, words })) => {
            let line = scene_text(&[*triangle], &[], &profile);
            let scene = arguments.out.join("counterexample.jsonl");
            let path = scene.display().to_string();
            std::fs::write(&scene, &line).map_err(|error| Failure::io(&path, &error))?;
            output
                .line(format!("REFUTED in {seconds:.1} s by the triangle {}", line.trim_end()))?;
            for word in words {
                output
                    .line(format!("{:<11} got {:x}, want {:x}", word.name, word.got, word.want))?;
            }
            output.line(format!(
                "its words: guardbit trace {name} --scene {path} --test setup/scene/0"
            ))?;
        }
        Verdict::Refuted(Refutation::Division(WrongDivision { numerator, divisor, got, want })) => {
            output.line(format!(
                "REFUTED in {seconds:.1} s by {numerator} / {divisor}: quotient got {got:x}, want {want:x}"
            ))?;
        }
        Verdict::Undecided { words } => {
            output.line(format!("UNDECIDED after {seconds:.1} s: {words}"))?;
        }
    }
    for assumed in &answer.assumed {
        output.line(format!("assumed: {assumed}"))?;
    }
    output.line(format!(
        "texts, scripts and the tools' own words: {folder}, with their digests in texts.sha256"
    ))?;
    output.flush()?;
    Ok(if matches!(answer.verdict, Verdict::Proved { .. }) {
        Outcome::Good
    } else {
        Outcome::Mismatch
    })
}

/// The clocks of a counterexample: inputs, what the module answers, and what it should.
fn rows(wave: &Path, answer: &Answer) -> Result<Vec<String>, Failure> {
    let name = wave.display().to_string();
    let bad = |error: std::io::Error| Failure::io(&name, &error);
    let file = File::open(wave).map_err(bad)?;
    let mut parser = vcd::Parser::new(BufReader::new(file));
    let header = parser.parse_header().map_err(bad)?;
    let code =
        |signal: &str| header.find_var(&["guardbit_miter", signal]).map(|variable| variable.code);
    let mut columns: Vec<(String, Option<IdCode>, u32)> =
        vec![("reset".to_owned(), code("reset"), 1)];
    let of = |signal: &Signal, prefix: &str| {
        let name = format!("{prefix}{}", signal.name);
        (name.clone(), code(&name), signal.width)
    };
    for signal in &answer.signals {
        if signal.output {
            columns.push(of(signal, "got_"));
            columns.push(of(signal, "want_"));
        } else {
            columns.push(of(signal, ""));
        }
    }
    columns.retain(|(_, code, _)| code.is_some());
    let mut now: HashMap<IdCode, u128> = HashMap::new();
    // Columns as wide as their heads and words.
    let place = |name: &str, text: &str, width: u32| {
        format!("{text:>0$}", (width.div_ceil(4) as usize).max(name.len()))
    };
    let heads = columns.iter().map(|(name, _, width)| place(name, name, *width));
    let mut lines = vec![heads.collect::<Vec<_>>().join(" ")];
    let line = |now: &HashMap<IdCode, u128>| {
        let words = columns.iter().map(|(name, code, width)| {
            let word = code.and_then(|code| now.get(&code)).copied().unwrap_or_default();
            place(name, &guardbit::bits::hex(word, *width), *width)
        });
        words.collect::<Vec<_>>().join(" ")
    };
    let mut time = None;
    for command in parser {
        match command.map_err(bad)? {
            // A step has ten units; its values stand from its beginning.
            Command::Timestamp(next) => {
                if time.is_some_and(|time: u64| time.is_multiple_of(10)) {
                    lines.push(line(&now));
                }
                time = Some(next);
            }
            Command::ChangeScalar(code, value) => {
                now.insert(code, u128::from(value == Value::V1));
            }
            Command::ChangeVector(code, value) => {
                let word =
                    value.iter().fold(0, |word, bit| word << 1 | u128::from(bit == Value::V1));
                now.insert(code, word);
            }
            _ => {}
        }
    }
    Ok(lines)
}
