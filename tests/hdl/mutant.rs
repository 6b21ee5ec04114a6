//! Defects of the devices, one at a time: each is caught by the benches of the default sets, and
//! `verify --dut` names its cause. `GUARDBIT_MUTANT=edge` looks at those with that in their id only,
//! `GUARDBIT_PART=2/6` at every sixth of them, from the second on.

// Clause J-5.
use crate::run::run_in;
use crate::set::run;
use crate::units::{CHANNELS, profile};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Mutants {
    mutant: Vec<Mutant>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Mutant {
    id: String,
    module: String,
    class: String,
    edits: Vec<[String; 2]>,
    cause: Option<String>,
    equivalent: Option<String>,
}

/// What became of a mutant.
struct Fate {
    mutant: Mutant,
    /// Whether a bench failed.
    caught: bool,
    /// The classes of tests that caught it.
    classes: BTreeSet<String>,
    /// Single causes that a dump was explained by.
    named: Vec<String>,
    /// Lists of several causes.
    listed: Vec<String>,
}

impl Fate {
    fn right(&self) -> bool {
        let Some(cause) = &self.mutant.cause else { return false };
        self.named.iter().chain(&self.listed).any(|named| named.contains(cause.as_str()))
    }

    /// A single cause, said with confidence, that is another.
    fn wrong(&self) -> bool {
        self.named.iter().any(|named| {
            self.mutant.cause.as_ref().is_none_or(|cause| !named.contains(cause.as_str()))
        })
    }
}

/// The device file with the mutant's edits in its module.
fn mutate(devices: &str, mutant: &Mutant) -> String {
    let head = format!("\nmodule {} ", mutant.module);
    let begin = devices.find(&head).expect("the module is there");
    let end = begin + devices[begin..].find("\nendmodule").unwrap();
    let mut module = devices[begin..end].to_owned();
    for [old, new] in &mutant.edits {
        assert_eq!(module.matches(old.as_str()).count(), 1, "{}: {old}", mutant.id);
        module = module.replacen(old.as_str(), new, 1);
    }
    format!("{}{module}{}", &devices[..begin], &devices[end..])
}

/// Runs a set's bench on a mutant of its devices, in a folder of its own.
fn fate(sets: &[PathBuf], mutant: &Mutant) -> Fate {
    let mut fate = Fate {
        mutant: mutant.clone(),
        caught: false,
        classes: BTreeSet::new(),
        named: Vec::new(),
        listed: Vec::new(),
    };
    for set in sets {
        let home = tempfile::tempdir().unwrap();
        for entry in std::fs::read_dir(set).unwrap().flatten() {
            let name = entry.file_name();
            if name.to_string_lossy().ends_with(".tv") {
                std::fs::hard_link(entry.path(), home.path().join(name)).unwrap();
            }
        }
        let mut devices = std::fs::read_to_string(set.join("dut.sv")).unwrap();
        if ["setup_divider", "triangle_setup"].contains(&mutant.module.as_str()) {
            // The divider of hardware, with its steps, takes twice the time.
            devices = devices.replace("parameter int SERIAL = 0", "parameter int SERIAL = 1");
            assert_eq!(devices.matches("parameter int SERIAL = 1").count(), 2);
        }
        std::fs::write(home.path().join("dut.sv"), mutate(&devices, mutant)).unwrap();
        let file = |name: &str| set.join(name).display().to_string();
        let build = ["-g2012", "-o", "sim.vvp", &file("pkg.sv"), "dut.sv", &file("tb.sv")];
        let (built, text) = run(home.path(), "iverilog", &build);
        assert!(built, "{}: {text}", mutant.id);
        let (good, text) = run(home.path(), "vvp", &["-n", "sim.vvp"]);
        if good {
            continue;
        }
        assert!(text.contains("FAIL"), "{}: {text}", mutant.id);
        // A dump leaves out stalls and resets.
        let _ = run(home.path(), "vvp", &["-n", "sim.vvp", "+dump"]);
        diagnose(set, home.path(), &mut fate);
        fate.caught = true;
        break;
    }
    fate
}

/// Asks the command about the dumps that the bench wrote.
fn diagnose(set: &Path, home: &Path, fate: &mut Fate) {
    let arguments = format!("verify {} --dut {} --errors 1000000", set.display(), home.display());
    let ran = run_in(home, &arguments);
    assert!(matches!(ran.status, Some(0 | 1)), "{}: {} {}", fate.mutant.id, ran.out, ran.err);
    // The head of a mismatch ends with the test: bench, class and index.
    let heads = ran.out.lines().filter(|line| line.contains(".dut.tv:"));
    let tests = heads.filter_map(|line| line.split(' ').next_back()?.rsplit_once('/'));
    fate.classes.extend(tests.map(|(class, _)| class.to_owned()));
    for section in ran.out.split("\n== ") {
        let list = |head: &str| -> Vec<String> {
            let list = section.split_once(head).map_or("", |(_, list)| list);
            let list = list.lines().take_while(|line| line.starts_with(' '));
            list.map(|line| line.trim().to_owned()).collect()
        };
        if let Some((_, cause)) = section.split_once("likely cause: ") {
            let said = cause.lines().take(1).map(str::to_owned);
            let same = list("in every row of this set it is the same as:\n");
            fate.named.push(said.chain(same).collect::<Vec<_>>().join(" | "));
        }
        fate.listed.extend(list("each of which explains the whole dump:\n"));
        let lost = section.lines().filter(|line| line.contains("rows are lost on the way"));
        fate.listed.extend(lost.map(str::to_owned));
    }
}

fn mutants(name: &str) -> Mutants {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/hdl/{name}.toml"));
    toml::from_str(&std::fs::read_to_string(source).unwrap()).unwrap()
}

/// The mutants of all devices but the engine: id, module, whether nothing is wrong, and the devices.
pub(crate) fn of_units(devices: &str) -> Vec<(String, String, bool, String)> {
    let all = mutants("mutants").mutant.into_iter();
    all.filter(|mutant| mutant.module != "triangle_engine")
        .map(|mutant| {
            let text = mutate(devices, &mutant);
            (mutant.id, mutant.module, mutant.equivalent.is_some(), text)
        })
        .collect()
}

pub(crate) fn caught_and_named(_: &str) {
    let home = tempfile::tempdir().unwrap();
    // The default job's sets, smaller.
    run_in(home.path(), "vectors --count 1500 --out sets").ends(0);
    let sets = ["sgi-4k", "sgi-4k-g1", "sgi-4k-g3", "sgi-4k-g4"];
    let sets = sets.map(|set| home.path().join("sets").join(set));
    look_at("mutants", "mutant -- --ignored", &sets, 60);
}

/// The same of the devices of channels.
pub(crate) fn of_channels(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let sets = ["textured", "every"].into_iter().zip(CHANNELS).map(|(name, channels)| {
        profile(home.path(), name, channels);
        run_in(home.path(), &format!("vectors {name}.toml --count 1500 --out {name}")).ends(0);
        home.path().join(name)
    });
    let sets: Vec<PathBuf> = sets.collect();
    look_at("unit_mutants", "long_defects_of_units -- --ignored", &sets, 30);
}

/// Which of how many parts of the mutants to look at.
fn part() -> [usize; 2] {
    let Ok(text) = std::env::var("GUARDBIT_PART") else { return [1, 1] };
    let numbers: Vec<usize> = text.split('/').filter_map(|number| number.parse().ok()).collect();
    match numbers[..] {
        [part, parts] if 1 <= part && part <= parts => [part, parts],
        _ => panic!("GUARDBIT_PART={text}: a part is N/M with 1 <= N <= M, such as 2/6"),
    }
}

/// Looks at the mutants of a file, which has at least so many that are defects.
fn look_at(name: &str, command: &str, sets: &[PathBuf], least: usize) {
    let only = std::env::var("GUARDBIT_MUTANT").unwrap_or_default();
    let mutants = mutants(name).mutant.into_iter();
    let [part, parts] = part();
    let mutants: Vec<Mutant> =
        mutants.filter(|mutant| mutant.id.contains(&only)).skip(part - 1).step_by(parts).collect();
    let whole = only.is_empty() && parts == 1;
    let queue = Mutex::new(mutants.iter());
    let fates = Mutex::new(BTreeMap::new());
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap().next();
                    let Some(mutant) = next else { break };
                    let fate = fate(sets, mutant);
                    fates.lock().unwrap().insert(fate.mutant.id.clone(), fate);
                }
            });
        }
    });
    let fates = fates.into_inner().unwrap();
    judge((name, command), &fates, whole.then_some(least));
}

fn judge((name, command): (&str, &str), fates: &BTreeMap<String, Fate>, least: Option<usize>) {
    let mut table = String::new();
    let mut faults = Vec::new();
    let (mut live, mut right) = (0, 0);
    let mut catches = BTreeMap::<&str, u32>::new();
    for (id, fate) in fates {
        let verdict = match (fate.caught, &fate.mutant.equivalent) {
            (false, Some(_)) => "equivalent",
            (false, None) => "SURVIVES",
            (true, Some(_)) => "NOT EQUIVALENT",
            (true, None) if fate.wrong() => "WRONG CAUSE",
            (true, None) if fate.right() => "named",
            (true, None) => "caught",
        };
        // A hang, or an answer that moves before it is taken, is seen by the bench and in no row.
        let classes = match (fate.caught, fate.classes.is_empty()) {
            (false, _) => "-".to_owned(),
            (true, true) => "the bench itself".to_owned(),
            (true, false) => fate.classes.iter().cloned().collect::<Vec<_>>().join(" "),
        };
        for class in &fate.classes {
            *catches.entry(class).or_default() += 1;
        }
        let _ = writeln!(table, "| {id} | {} | {verdict} | {classes} |", fate.mutant.class);
        if verdict.chars().all(|c| c.is_uppercase() || c == ' ') {
            faults.push(format!("{id}: {verdict}: {:?} {:?}", fate.named, fate.listed));
        }
        eprintln!("{verdict} {id}: {:?} | {:?} | {:?}", fate.mutant.cause, fate.named, fate.listed);
        if fate.mutant.equivalent.is_none() {
            live += 1;
            right += usize::from(fate.right() && !fate.wrong());
        }
    }
    let mut text = format!(
        "# Which class of tests catches which defect\n\nWritten by `GUARDBIT_WRITE=1 cargo test --test hdl {command}` \
         and compared by it. {right} of {live} causes named, {} mutants.\n\n| class of tests | defects \
         |\n| --- | --- |\n",
        fates.len()
    );
    for (class, count) in catches {
        let _ = writeln!(text, "| {class} | {count} |");
    }
    let _ = write!(
        text,
        "\n| defect | kind | verdict | caught by |\n| --- | --- | --- | --- |\n{table}"
    );
    assert!(faults.is_empty(), "{faults:#?}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/hdl/{name}.md"));
    if let Some(least) = least {
        if std::env::var_os("GUARDBIT_WRITE").is_some() {
            std::fs::write(&path, &text).unwrap();
        }
        let written = std::fs::read_to_string(&path).unwrap_or_default();
        assert_eq!(written, text, "tests/hdl/{name}.md is not what the benches find");
        assert!(live >= least, "{live}");
        assert!(right * 5 >= live * 4, "{right} of {live} causes named");
    } else {
        // Of a part, each row stands as it was.
        let written = std::fs::read_to_string(&path).unwrap();
        for row in table.lines() {
            assert!(written.lines().any(|line| line == row), "tests/hdl/{name}.md has not: {row}");
        }
    }
}
