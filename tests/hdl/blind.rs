//! Mutants of the devices by classical operators, which nobody has chosen: what the default sets
//! kill of a sample, and what the diagnosis says of the killed.
//!
//! `GUARDBIT_SEED` (default: year and week), `GUARDBIT_MUTANTS` (default 3) and `GUARDBIT_ROWS`
//! (the sets' `--count`, default 20000) choose the sample and the sets; a question to yosys takes at
//! most `GUARDBIT_SECONDS` (default 5). With `GUARDBIT_BLIND=FOLDER` there is a line
//! of JSON a mutant, with its source and the dumps that differ.

// Clause J-5.
#[path = "blind/operator.rs"]
mod operator;
#[path = "blind/probe.rs"]
mod probe;
#[path = "blind/proof.rs"]
pub(crate) mod proof;
#[path = "blind/report.rs"]
mod report;
#[path = "blind/sample.rs"]
pub(crate) mod sample;
#[path = "blind/settle.rs"]
mod settle;
#[path = "blind/source.rs"]
mod source;
#[path = "blind/textbook.rs"]
pub(crate) mod textbook;
#[path = "blind/units.rs"]
pub(crate) mod units;

use crate::run::run_in;
use crate::set::{limited, run};
use operator::Mutant;
use report::{Report, Trust, trust};
use sample::{Devices, Sample};
use serde::Serialize;
use settle::{Settled, differ, same};
use std::fs::File;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;
use std::time::{Duration, SystemTime};
use tempfile::TempDir;

/// The sets of the default job, the four of them.
const SETS: [&str; 4] = ["sgi-4k", "sgi-4k-g1", "sgi-4k-g3", "sgi-4k-g4"];
/// The modules that a bench drives.
const TOPS: [&str; 4] = ["dda", "edge_stepper", "triangle_setup", "triangle_engine"];
/// Those whose answers count in every clock. What a stream shows while it is not valid is nobody's
/// business, and a comparison of outputs would not know it.
const PLAIN: [&str; 2] = ["dda", "edge_stepper"];
/// Dumps that are not kept: of a device that never stops.
const LARGE: u64 = 1 << 24;

/// What became of a mutant.
#[derive(Debug, Serialize)]
struct Fate {
    id: String,
    module: String,
    operator: &'static str,
    line: usize,
    before: String,
    after: String,
    what: String,
    /// The first set whose bench fails, and how: `FAIL`, or that it does not come to an end.
    killed: Option<(String, String)>,
    reports: Vec<Report>,
    second: Vec<Report>,
    trust: Trust,
    placed: bool,
    /// Of a survivor: whether the second sets kill it, and what yosys says.
    second_kills: bool,
    settled: Option<Settled>,
}

const ENDLESS: &str = "the simulation does not end";

/// A bench on a device: `None` if it passes, else the way it fails.
fn failure(home: &Path, set: &Path, device: &str, limit: Duration) -> Option<String> {
    for entry in std::fs::read_dir(set).unwrap().flatten() {
        let name = entry.file_name();
        if name.to_string_lossy().ends_with(".tv") {
            std::fs::hard_link(entry.path(), home.join(name)).unwrap();
        }
    }
    std::fs::write(home.join("dut.sv"), device).unwrap();
    let (built, text) = build(home, set);
    if !built {
        return Some(format!("does not build: {text}"));
    }
    // A dump leaves out stalls and resets: it is asked for where the bench fails without it.
    match limited(home, "vvp", &["-n", "sim.vvp"], limit) {
        None => {
            let _ = limited(home, "vvp", &["-n", "sim.vvp", "+dump"], limit);
            Some(ENDLESS.to_owned())
        }
        Some((true, _)) => None,
        Some((false, text)) => {
            let _ = limited(home, "vvp", &["-n", "sim.vvp", "+dump"], limit);
            let line = text.lines().find(|line| line.starts_with("FAIL"));
            Some(line.unwrap_or_else(|| panic!("no FAIL line: {text}")).to_owned())
        }
    }
}

fn build(home: &Path, set: &Path) -> (bool, String) {
    let file = |name: &str| set.join(name).display().to_string();
    run(home, "iverilog", &["-g2012", "-o", "sim.vvp", &file("pkg.sv"), "dut.sv", &file("tb.sv")])
}

/// The reports on the dumps of these files that differ from the set; other dumps go.
fn reports(home: &Path, set: &Path, files: &[String]) -> Vec<Report> {
    let mut dumps = Vec::new();
    for file in files {
        let dump = home.join(format!("{file}.exp.dut.tv"));
        if !dump.exists() {
            continue;
        }
        // A simulation that was ended leaves half a row.
        let mut text = std::fs::read_to_string(&dump).unwrap();
        text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
        std::fs::write(&dump, text).unwrap();
        dumps.push((file, dump));
    }
    if dumps.is_empty() {
        return Vec::new();
    }
    let arguments = format!("verify {} --dut {} --errors 100000", set.display(), home.display());
    let ran = run_in(home, &arguments);
    assert!(matches!(ran.status, Some(0 | 1)), "{}: {} {}", home.display(), ran.out, ran.err);
    let mut reports = Vec::new();
    for (file, dump) in dumps {
        let head = format!("{file}.exp.dut.tv\n");
        let text = format!("\n{}", ran.out);
        let mut sections = text.split("\n== ").filter_map(|section| section.split_once('\n'));
        let section = sections.find(|(name, _)| format!("{name}\n").ends_with(&head));
        let Some((_, section)) = section else { continue };
        if section.contains("PASS") {
            std::fs::remove_file(&dump).unwrap();
        } else {
            reports.push(Report::read(file, section));
        }
    }
    reports
}

/// Folders of the sets under test, and of sets with another seed and scene.
struct Sets {
    first: Vec<PathBuf>,
    second: Vec<PathBuf>,
    keep: Option<PathBuf>,
    /// For a simulation; a sound device takes a twentieth of it.
    limit: Duration,
    /// For each question to yosys.
    question: Duration,
    /// The names of the sets.
    names: Vec<String>,
    /// Stems of the files that devices answer, without `.exp`.
    files: Vec<String>,
    /// The modules that a bench drives, those whose answers count in every clock, and those that have the
    /// widths of their places.
    tops: Vec<String>,
    plain: Vec<String>,
    placed: Vec<String>,
    /// Parts that a report calls by the module around them.
    outer: Vec<(&'static str, &'static str)>,
}

fn texts(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn fate(sets: &Sets, devices: &[Devices], number: usize, mutant: &Mutant) -> Fate {
    let (before, after) = devices[0].lines(mutant);
    let mut fate = Fate {
        id: format!("{number:03}-{}-{}", mutant.module, mutant.operator),
        module: mutant.module.clone(),
        operator: mutant.operator,
        line: mutant.line,
        before,
        after,
        what: format!("in {} line {}, {}", mutant.module, mutant.line, mutant.what),
        killed: None,
        reports: Vec::new(),
        second: Vec::new(),
        trust: Trust::None,
        placed: false,
        second_kills: false,
        settled: None,
    };
    for (n, set) in sets.first.iter().enumerate() {
        let home = tempfile::tempdir().unwrap();
        let device = devices[n].with(mutant);
        let Some(how) = failure(home.path(), set, &device, sets.limit) else { continue };
        fate.reports = reports(home.path(), set, &sets.files);
        fate.killed = Some((sets.names[n].clone(), how.clone()));
        if let Some(keep) = &sets.keep {
            std::fs::write(home.path().join("set"), &sets.names[n]).unwrap();
            save(home.path(), &keep.join(&fate.id));
        }
        // A choice of causes, or none, is not confident and needs no second opinion.
        let confident = fate.reports.iter().any(|report| report.causes.len() == 1);
        if confident && how != ENDLESS {
            let again = tempfile::tempdir().unwrap();
            failure(again.path(), &sets.second[n], &device, sets.limit);
            fate.second = reports(again.path(), &sets.second[n], &sets.files);
        }
        fate.trust = trust(&fate.reports, &fate.second);
        let known = |report: &Report| {
            let outer = sets.outer.iter().filter(|(part, _)| *part == fate.module);
            report.places(&fate.module) || outer.into_iter().any(|(_, top)| report.places(top))
        };
        fate.placed = fate.reports.iter().any(known);
        return fate;
    }
    let same = devices.iter().all(|devices| is_same(devices, mutant, sets));
    fate.second_kills = !same
        && sets.second.iter().zip(devices).any(|(set, devices)| {
            let home = tempfile::tempdir().unwrap();
            failure(home.path(), set, &devices.with(mutant), sets.limit).is_some()
        });
    fate.settled = Some(if same {
        Settled::Equivalent
    } else if fate.second_kills || is_different(devices, mutant, sets) {
        Settled::Different
    } else {
        Settled::Open
    });
    if let Some(keep) = &sets.keep {
        let folder = keep.join(&fate.id);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("dut.sv"), devices[0].with(mutant)).unwrap();
    }
    fate
}

/// A folder with the sound devices and the mutant.
fn pair(devices: &Devices, mutant: &Mutant) -> TempDir {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("gold.sv"), devices.sound(mutant)).unwrap();
    std::fs::write(home.path().join("gate.sv"), devices.with(mutant)).unwrap();
    home
}

/// Whether the module is the same on its own, or in all that a bench drives.
fn is_same(devices: &Devices, mutant: &Mutant, sets: &Sets) -> bool {
    let (home, limit) = (pair(devices, mutant), sets.question);
    let alone = !sets.placed.contains(&mutant.module) && same(home.path(), &mutant.module, limit);
    let tops = devices.tops(&mutant.module, &sets.tops);
    alone || tops.iter().all(|top| same(home.path(), top, limit))
}

fn is_different(devices: &[Devices], mutant: &Mutant, sets: &Sets) -> bool {
    let home = pair(&devices[0], mutant);
    let tops = devices[0].tops(&mutant.module, &sets.plain);
    tops.iter().any(|top| differ(home.path(), top, sets.question))
}

/// The device and the dumps that differ.
fn save(home: &Path, folder: &Path) {
    std::fs::create_dir_all(folder).unwrap();
    for entry in std::fs::read_dir(home).unwrap().flatten() {
        let name = entry.file_name().into_string().unwrap();
        let dump = name.ends_with(".dut.tv") && entry.metadata().unwrap().len() < LARGE;
        if dump || name == "dut.sv" || name == "set" {
            std::fs::copy(entry.path(), folder.join(name)).unwrap();
        }
    }
}

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| {
        text.parse().unwrap_or_else(|_| panic!("{name} is {text}, which is no number"))
    })
}

pub(crate) fn sampled(_: &str) {
    let seed = number("GUARDBIT_SEED", sample::week(SystemTime::now()));
    let (count, rows) = (number("GUARDBIT_MUTANTS", 3), number("GUARDBIT_ROWS", 20_000));
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), &format!("vectors --count {rows} --out first")).ends(0);
    let other = format!("vectors --count {rows} --seed {} --scene terrain --out second", seed + 1);
    run_in(home.path(), &other).ends(0);
    let keep = std::env::var_os("GUARDBIT_BLIND").map(PathBuf::from);
    let sets = Sets {
        first: SETS.map(|set| home.path().join("first").join(set)).to_vec(),
        second: SETS.map(|set| home.path().join("second").join(set)).to_vec(),
        keep,
        limit: Duration::from_secs(10 + rows / 2000),
        question: Duration::from_secs(number("GUARDBIT_SECONDS", 5)),
        names: texts(&SETS),
        files: texts(&["dda", "edge", "setup", "span", "depth", "triangle"]),
        tops: texts(&TOPS),
        plain: texts(&PLAIN),
        placed: texts(&["setup_divider"]),
        outer: Vec::new(),
    };
    let devices: Vec<Devices> = sets.first.iter().map(|set| Devices::read(set)).collect();
    let sample = Sample::new(&devices[0], seed, |_| true);
    let fates = fates(&sets, &devices, sample, (count, seed, rows));
    judge(&fates);
}

/// What becomes of a sample.
fn fates(
    sets: &Sets,
    devices: &[Devices],
    mut sample: Sample,
    (count, seed, rows): (u64, u64, u64),
) -> Vec<Fate> {
    // A mutant that does not elaborate is none.
    let mut mutants = Vec::new();
    let bench = tempfile::tempdir().unwrap();
    while mutants.len() < usize::try_from(count).unwrap() {
        let Some(mutant) = sample.draw() else { break };
        std::fs::write(bench.path().join("dut.sv"), devices[0].with(&mutant)).unwrap();
        if build(bench.path(), &sets.first[0]).0 {
            mutants.push(mutant);
        }
    }
    // As they come: a long run that is stopped has told what it knew.
    let file = Mutex::new(sets.keep.as_ref().map(|keep| {
        std::fs::create_dir_all(keep).unwrap();
        File::create(keep.join("blind.jsonl")).unwrap()
    }));
    let queue = Mutex::new(mutants.iter().enumerate());
    let fates = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().next();
                    let Some((number, mutant)) = next else { break };
                    let fate = fate(sets, devices, number, mutant);
                    let mut fates = fates.lock().unwrap();
                    if let Some(file) = &mut *file.lock().unwrap() {
                        writeln!(file, "{}", serde_json::to_string(&fate).unwrap()).unwrap();
                    }
                    fates.push(fate);
                }
            });
        }
    });
    let mut fates = fates.into_inner().unwrap();
    fates.sort_by(|a, b| a.id.cmp(&b.id));
    eprintln!("seed {seed}, {rows} rows, {} of {} possible mutants", fates.len(), sample.possible);
    fates
}

fn judge(fates: &[Fate]) {
    let count = |holds: &dyn Fn(&Fate) -> bool| fates.iter().filter(|fate| holds(fate)).count();
    let killed = count(&|fate| fate.killed.is_some());
    let settled = |settled| move |fate: &Fate| fate.settled == Some(settled);
    let (equivalent, different, open) = (
        count(&settled(Settled::Equivalent)),
        count(&settled(Settled::Different)),
        count(&settled(Settled::Open)),
    );
    let single = count(&|fate| fate.reports.iter().any(|report| report.causes.len() == 1));
    let several = count(&|fate| fate.reports.iter().any(|report| report.causes.len() > 1));
    let [confirmed, wrong] =
        [Trust::Confirmed, Trust::Wrong].map(|trust| count(&|fate| fate.trust == trust));
    let placed = count(&|fate| fate.placed);
    let real = killed + different + open;
    eprintln!(
        "killed {killed} of {real} that are not proved equivalent; survivors: {equivalent} \
         equivalent, {different} different, {open} open"
    );
    eprintln!(
        "of those killed: a single cause for {single} ({confirmed} confirmed, {wrong} wrong), \
         several for {several}, {placed} placed"
    );
    for fate in fates {
        match (fate.settled, fate.trust) {
            (Some(Settled::Different | Settled::Open), _) => {
                eprintln!(
                    "{} {:?}: {}\n    {}\n    {}",
                    fate.id, fate.settled, fate.what, fate.before, fate.after
                );
            }
            (_, Trust::Wrong) => {
                let causes: Vec<&String> =
                    fate.reports.iter().flat_map(|report| &report.causes).collect();
                eprintln!("{} {:?}: {}: {causes:?}", fate.id, fate.trust, fate.what);
            }
            _ => {}
        }
    }
    assert_eq!(wrong, 0, "causes that a second set contradicts");
}
