//! `guardbit vectors`: writes golden test vectors.

use super::Outcome;
use super::failure::Failure;
use super::output::Output;
use super::{progress, sets};
use clap::ValueEnum;
use guardbit::case::triangle::SCENE;
use guardbit::profile::{self, Profile};
use guardbit::vector::bench::{Bench, ChannelBench, Source};
use guardbit::vector::emit;
use guardbit::vector::manifest::GroupEntry;
use guardbit::vector::plan::{Shard, find_test};
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{self, Options, SetRequest};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

/// Write golden test vectors with packages, testbenches and a manifest.
///
/// Every argument has a default. Without PROFILE, the command writes one set for the default profile
/// and one for each of its variants with 1 to 4 guard bits; each set has its own folder in DIR. With
/// PROFILE, it writes the set of this profile into DIR itself.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    profile: Option<String>,
    /// The scene: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of triangles.
    #[arg(long, default_value = "knot")]
    scene: String,
    /// Folder of the set; `-` writes one file to standard output (see --file).
    #[arg(long, value_name = "DIR", default_value = "guardbit-vectors")]
    out: PathBuf,
    /// Number of rows of each walk file (dda.exp, edge.exp). The other files grow in proportion.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,
    /// Size of the set if there is no --count.
    #[arg(long, value_enum, default_value_t = Size::Regress)]
    size: Size,
    /// Seed of the random tests.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Also write sets for the variants of PROFILE with 1 to 4 guard bits.
    #[arg(long)]
    variants: bool,
    /// Window as WIDTHxHEIGHT; replaces the window of the profile.
    #[arg(long, value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Write part I of N parts, as I/N; I starts at 0. All parts together are equal to the whole set.
    #[arg(long, value_name = "I/N", value_parser = parse_shard)]
    shard: Option<Shard>,
    /// Format of the rows.
    #[arg(long, value_enum, default_value_t = Format::Tv)]
    format: Format,
    /// Compress the vector files with zstd.
    #[arg(long)]
    zstd: bool,
    /// Print only the rows of this test, for example dda/guard-boundary/17; write no set.
    #[arg(long, value_name = "ID")]
    only: Option<String>,
    /// The file that `--out -` writes to standard output.
    #[arg(long, value_name = "NAME", default_value = "dda.exp")]
    file: String,
    /// Number of worker threads; the output does not depend on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Replace the set in an existing DIR, if every file there is as the set was written.
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Size {
    /// 20 thousand rows: about 1 second in GHDL.
    Smoke,
    /// 100 thousand rows: about 1 second in Icarus Verilog.
    Regress,
    /// 50 million rows: about 1 minute in Verilator.
    Soak,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// Hexadecimal columns with `_` between them: the standard format.
    Tv,
    /// Binary, big-endian, each column padded to whole bytes.
    Bin,
    /// Hexadecimal columns with commas between them, and one header line.
    Csv,
    /// One JSON object for each row, words as hexadecimal strings.
    Jsonl,
    /// Operands, results and flags, with spaces between them.
    Testfloat,
    /// The format tv, compressed: the same as --zstd.
    Zstd,
}

impl Size {
    /// Rows of a walk file.
    const fn rows(self) -> u64 {
        match self {
            Self::Smoke => 20_000,
            Self::Regress => 100_000,
            Self::Soak => 50_000_000,
        }
    }
}

impl From<Format> for RowFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Tv | Format::Zstd => Self::Tv,
            Format::Bin => Self::Bin,
            Format::Csv => Self::Csv,
            Format::Jsonl => Self::Jsonl,
            Format::Testfloat => Self::TestFloat,
        }
    }
}

pub(crate) fn parse_shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(index, parts)| {
        Some(Shard { index: index.parse().ok()?, parts: parts.parse().ok()? })
    });
    match parts {
        Some(shard) if shard.index < shard.parts => Ok(shard),
        _ => Err("a shard is I/N with 0 <= I < N, for example 0/4".to_owned()),
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut profile = profile::load(arguments.profile.as_deref().unwrap_or("sgi-4k"))?;
    if let Some((width, height)) = arguments.window {
        profile.window = profile::WindowConfig { width, height };
        profile.validate().map_err(Failure::input)?;
    }
    let options = Options {
        count: arguments.count.unwrap_or(arguments.size.rows()),
        seed: arguments.seed,
        shard: arguments.shard.unwrap_or(Shard::WHOLE),
        format: arguments.format.into(),
        zstd: arguments.zstd || matches!(arguments.format, Format::Zstd),
        threads: threads(arguments.threads),
        force: arguments.force,
    };
    if let Some(id) = &arguments.only {
        return print_test(&request(profile, &arguments.scene)?, &options, id);
    }
    if arguments.out.as_os_str() == "-" {
        return stream(&request(profile, &arguments.scene)?, &options, &arguments.file);
    }
    let nested = arguments.profile.is_none() || arguments.variants;
    let mut requests = vec![request(profile.clone(), &arguments.scene)?];
    if nested && let Some(depth) = profile.depth {
        for guard in (1..=4).filter(|guard| *guard != depth.guard) {
            let mut variant = profile.clone();
            variant.name = format!("{}-g{guard}", profile.name);
            variant.depth.iter_mut().for_each(|depth| depth.guard = guard);
            variant.validate().map_err(Failure::input)?;
            // Guard bits do not move a vertex: the scene on the grid is shared.
            let first = &requests[0];
            let name = variant.name.clone();
            requests.push(SetRequest { name, profile: variant, ..first.clone() });
        }
    }
    let monitor = progress::monitor();
    let written = progress::watch("writing", &monitor, || {
        write::write(&requests, &arguments.out, nested, &options, &monitor)
    });
    for note in monitor.notes.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        eprintln!("note: {note}");
    }
    let manifests = written.map_err(|error| write_failure(&arguments.out, &error))?;
    let mut output = Output::new();
    for (manifest, request) in manifests.iter().zip(&requests) {
        let drawn = |group: &GroupEntry| group.bench == "channel" && group.tag == SCENE.tag;
        if !request.values.is_empty() && !manifest.groups.iter().any(drawn) {
            eprintln!(
                "note: {}: no triangle is small enough for the bench `channel`, which draws bounding boxes of at \
                 most {} pixels; a finer mesh or a smaller window has some",
                arguments.scene,
                ChannelBench::LARGEST
            );
        }
        let folder = if nested { arguments.out.join(&manifest.set) } else { arguments.out.clone() };
        let tests: u64 = manifest.groups.iter().map(|group| group.tests).sum();
        let rows: u64 = manifest
            .files
            .iter()
            .filter(|file| !file.columns.is_empty())
            .map(|file| file.rows)
            .sum();
        let open: usize = manifest.coverage.iter().map(|entry| entry.open.len()).sum();
        output.line(format!(
            "{}: {tests} tests, {rows} rows, {} files, {open} coverage cells open (listed in {})",
            folder.display(),
            manifest.files.len() + 1,
            guardbit::vector::manifest::NAME
        ))?;
    }
    output.flush()?;
    Ok(Outcome::Good)
}

pub(crate) fn threads(asked: Option<u16>) -> usize {
    asked.map_or_else(
        || std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get),
        usize::from,
    )
}

fn request(profile: Profile, scene: &str) -> Result<SetRequest, Failure> {
    let snapped = sets::snap_scene(&profile, scene)?;
    Ok(SetRequest {
        name: profile.name.clone(),
        scene: Arc::new(snapped.shapes()),
        values: Arc::new(snapped.values_of_set(&profile)?),
        profile,
        scene_name: snapped.name,
        refused: snapped.refused,
    })
}

fn write_failure(out: &Path, error: &std::io::Error) -> Failure {
    match error.kind() {
        ErrorKind::AlreadyExists => {
            Failure::input(format!("{} exists and is not empty", out.display()))
                .hint("choose another folder with --out, or replace the set with --force")
        }
        ErrorKind::DirectoryNotEmpty => {
            Failure::input(format!("{error}; --force replaces only a set as it was written"))
                .hint("move these files away, or choose another folder with --out")
        }
        ErrorKind::NotADirectory => {
            Failure::input(format!("{}: this is a file, a folder is needed", out.display()))
                .hint("choose another folder with --out")
        }
        ErrorKind::Interrupted => Failure::interrupted("interrupted: nothing was left behind"),
        _ => Failure::io(&out.display().to_string(), error),
    }
}

fn benches(request: &SetRequest, options: &Options) -> Vec<Box<dyn Bench>> {
    Source {
        profile: request.profile.clone(),
        scene: Arc::clone(&request.scene),
        values: Arc::clone(&request.values),
        seed: options.seed,
        count: options.count,
    }
    .benches()
}

/// Prints the rows of one test, each after the name of its file.
fn print_test(request: &SetRequest, options: &Options, id: &str) -> Result<Outcome, Failure> {
    let benches = benches(request, options);
    let found = benches.iter().find_map(|bench| Some((bench, find_test(&**bench, id)?)));
    let Some((bench, at)) = found else {
        let known: Vec<String> = benches
            .iter()
            .flat_map(|bench| {
                bench
                    .groups()
                    .iter()
                    .map(|group| format!("{}/{}/0..{}", bench.name(), group.class.tag, group.tests))
            })
            .collect();
        let message = format!("no test {id:?}: the id of a test is BENCH/CLASS/INDEX");
        return Err(Failure::input(message).hint(&format!("the tests are {}", known.join(" "))));
    };
    let specs = emit::files(&**bench, options.format);
    if specs.is_empty() || options.format == RowFormat::Bin {
        let format = options.format.extension();
        return Err(Failure::input(format!(
            "--format {format}: this format has no text lines to print for {id}"
        ))
        .hint("choose a text format, for example --format tv"));
    }
    let mut output = Output::new();
    for (spec, lines) in emit::test_lines(&**bench, at, options.format) {
        let name = write::file_name(&spec.stem, options.format, false);
        for line in lines.lines() {
            output.line(format!("{name}: {line}"))?;
        }
    }
    output.flush()?;
    Ok(Outcome::Good)
}

/// Streams one file to standard output.
fn stream(request: &SetRequest, options: &Options, file: &str) -> Result<Outcome, Failure> {
    let benches = benches(request, options);
    // The name may be that of the file in a set, endings and all.
    let end = write::file_name("", options.format, options.zstd);
    let stem = file.strip_suffix(&end).unwrap_or(file);
    let mut known = Vec::new();
    for bench in &benches {
        for (wanted, spec) in emit::files(&**bench, options.format).iter().enumerate() {
            if spec.stem == stem {
                let output = std::io::stdout().lock();
                let mut sink = StreamOutput { wanted, zstd: options.zstd, output };
                emit::emit(&**bench, options.shard, options.count, options.format, &mut sink)
                    .and_then(|_| sink.output.flush())
                    .map_err(|error| Failure::io("standard output", &error))?;
                return Ok(Outcome::Good);
            }
            known.push(spec.stem.clone());
        }
    }
    let message = format!("--file {file}: the set of this profile has no file of this name");
    Err(Failure::input(message).hint(&format!("the files are {}", known.join(", "))))
}

struct StreamOutput {
    wanted: usize,
    zstd: bool,
    output: std::io::StdoutLock<'static>,
}

impl emit::Output for StreamOutput {
    fn bytes(&mut self, file: usize, bytes: &[u8]) -> std::io::Result<bool> {
        if file == self.wanted && self.zstd {
            self.output.write_all(&write::compress(bytes))?;
        } else if file == self.wanted {
            self.output.write_all(bytes)?;
        }
        Ok(true)
    }
}
