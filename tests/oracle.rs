//! The profiles of real rasterizers against samples of independent implementations, in every bit. The
//! samples lie beside the project and not in it: where they are absent, the trials say so and are counted
//! as ignored; `tests/model/rasterizers.rs` holds the same behaviour without them.

use flate2::read::GzDecoder;
use guardbit::machine::Sink;
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::load;
use guardbit::scene::Triangle;
use libtest_mimic::{Arguments, Failed, Trial};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Sample file, and the profile that it is for.
const REGISTERS: [(&str, &str); 14] = [
    ("psx_gpu", "ps1"),
    ("vortex", "vortex"),
    ("psp_ge", "psp"),
    ("voodoo", "voodoo"),
    ("s3_virge", "virge"),
    ("n64_rdp", "n64"),
    ("rasterix", "rasterix"),
    ("picogs", "picogs"),
    ("graphite", "graphite"),
    ("projf_line", "projf-line"),
    ("projf_fill", "projf-fill"),
    ("saturn_line", "saturn-line"),
    ("saturn_quad", "saturn-quad"),
    ("gplgpu", "gplgpu"),
];
/// Profiles whose samples hold each pixel once, by y and then x.
const AS_A_SET: [&str; 1] = ["projf-fill"];
const VULKAN: [(&str, &str); 2] =
    [("vulkan_lavapipe", "vulkan-8bit"), ("vulkan_swiftshader", "vulkan-4bit")];

fn main() {
    let arguments = Arguments::from_args();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/oracle");
    let mut trials = Vec::new();
    let mut add = |name: &str, file: String, run: fn(&str, &str) -> Result<(), Failed>, profile| {
        let path: PathBuf = folder.join(file);
        let is_there = path.is_file();
        let hint = if is_there { "" } else { " (its samples are not here)" };
        let trial = Trial::test(format!("{name}{hint}"), move || run(profile, &text(&path)?));
        trials.push(trial.with_ignored_flag(!is_there));
    };
    for (file, profile) in REGISTERS {
        add(profile, format!("{file}.txt.gz"), registers, profile);
    }
    for (file, profile) in VULKAN {
        add(profile, format!("{file}.jsonl.gz"), vulkan, profile);
    }
    libtest_mimic::run(&arguments, trials).exit();
}

fn text(path: &Path) -> Result<String, Failed> {
    let mut text = String::new();
    GzDecoder::new(std::fs::File::open(path)?).read_to_string(&mut text)?;
    Ok(text)
}

/// Records as the lines of a sample file.
struct Lines<'a>(&'a Model, Vec<String>);

impl Sink for Lines<'_> {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn record(&mut self, kind: usize, values: &[i64]) {
        let registers = self.0.registers().expect("a register machine");
        let mut line = String::new();
        registers.push_record(kind, values, " ", &mut line);
        self.1.push(line);
    }
}

/// A record's line as words of 32 bits: samples of picogs have the colour as one number of 64.
fn split(profile: &str, line: &str) -> String {
    let mut fields: Vec<String> = line.split(' ').map(str::to_owned).collect();
    if profile == "picogs"
        && let Some(colour) = fields.get_mut(3)
        && let Ok(value) = u64::from_str_radix(colour, 16)
    {
        *colour = format!("{:x} {:x}", value >> 32, value & 0xffff_ffff);
    }
    fields.join(" ")
}

/// `T` opens a case, lines of records follow, `D` closes it.
fn registers(profile: &str, text: &str) -> Result<(), Failed> {
    let model = Model::new(&load(profile)?)?;
    let registers = model.registers().ok_or("no registers")?;
    let (mut cases, mut words, mut expected) = (0, Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("T ") {
            let texts: Vec<&str> = rest.split(' ').skip(1).collect();
            words = registers.parse(&texts)?;
            expected.clear();
        } else if line.starts_with("D ") {
            let mut got = Lines(&model, Vec::new());
            model.draw(words.as_slice(), &mut got)?;
            if AS_A_SET.contains(&profile) {
                got.1.sort_by_cached_key(|line| row_then_column(line));
                got.1.dedup();
            }
            if let Some(n) = (0..got.1.len().max(expected.len()))
                .find(|&n| got.1.get(n).map(String::as_str) != expected.get(n).map(String::as_str))
            {
                let (got, expected) = (got.1.get(n), expected.get(n));
                return Err(format!("{line}: record {n} is {got:?}, expected {expected:?}").into());
            }
            cases += 1;
        } else {
            expected.push(split(profile, line));
        }
    }
    if cases < 80 { Err(format!("{cases} cases").into()) } else { Ok(()) }
}

/// y and x of a decimal record.
fn row_then_column(line: &str) -> Option<(i64, i64)> {
    let (x, y) = line.strip_prefix("P ")?.split_once(' ')?;
    Some((y.parse().ok()?, x.parse().ok()?))
}

/// A triangle a line: `v`, and the covered runs `c`.
fn vulkan(profile: &str, text: &str) -> Result<(), Failed> {
    let view = View { window: Some((64, 64)), ..View::default() };
    let model = Model::with_view(&load(profile)?, view)?;
    let mut cases = 0;
    for line in text.lines() {
        let case: serde_json::Value = serde_json::from_str(line)?;
        let v: Vec<i128> = case["v"]
            .as_array()
            .ok_or("no v")?
            .iter()
            .map(|v| v.as_i64().map(i128::from).ok_or("no integer"))
            .collect::<Result<_, _>>()?;
        let xy = [[v[0], v[1]], [v[3], v[4]], [v[6], v[7]]];
        let triangle = model.snap(&Triangle::Lattice { xy, z: Some([v[2], v[5], v[8]]) })?;
        let mut drawing = Drawing::default();
        model.draw(&triangle, &mut drawing)?;
        let got: Vec<[i64; 3]> =
            drawing.spans.iter().map(|span| [span.y, span.x0, span.x1].map(i64::from)).collect();
        let expected = runs(case["c"].as_str().ok_or("no c")?)?;
        if got != expected {
            return Err(format!("{line}: {got:?} instead of {expected:?}").into());
        }
        cases += 1;
    }
    if cases < 100 { Err(format!("{cases} cases").into()) } else { Ok(()) }
}

/// First row, its run, then for each further row the change of both ends; an empty field is an empty row.
fn runs(text: &str) -> Result<Vec<[i64; 3]>, Failed> {
    let mut found: Vec<[i64; 3]> = Vec::new();
    let mut fields = text.split(';');
    let Some(Ok(first)) = fields.next().map(str::parse::<i64>) else { return Ok(found) };
    let mut ends = [0, 0];
    for (y, field) in (first..).zip(fields) {
        let Some((a, b)) = field.split_once(',') else { continue };
        ends = [ends[0] + a.parse::<i64>()?, ends[1] + b.parse::<i64>()?];
        found.push([y, ends[0], ends[1]]);
    }
    Ok(found)
}
