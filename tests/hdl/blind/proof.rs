//! No proof is wrong: mutants of the devices that `prove --rtl` calls equal answer every row of a set.

use super::sample::{Devices, Sample, week};
use super::{build, number, probe};
use crate::mutant::of_units;
use crate::run::run_in;
use crate::set::run;
use guardbit::profile;
use guardbit::vector::equivalence::{Block, EquivalenceError, Map, Question, Verdict, prove};
use std::path::Path;
use std::time::{Duration, SystemTime};

fn block(module: &str) -> Option<Block> {
    const ALL: [Block; 6] = [
        Block::Dda,
        Block::EdgeStepper,
        Block::EdgeEvaluator,
        Block::DepthEvaluator,
        Block::SetUp,
        Block::Divider,
    ];
    ALL.into_iter().find(|block| block.module() == module)
}

/// The divider at the widths of a slope; without a map it has those of the start. A proof is one of these widths.
const OF_A_SLOPE: &str = "module = \"setup_divider\"
[reset]
port = \"rst\"
[ports]
start = \"start\"
numerator = \"numerator\"
divisor = \"divisor\"
busy = \"busy\"
quotient = \"quotient\"
[parameters]
NW = 75
DW = 52
ROUNDING = 4
SERIAL = 1
";

/// What a proof says of the devices in a file at all widths that the set has of them; `None` where it refuses them.
fn at_all_widths(home: &Path, devices: &str, block: Block) -> Option<Verdict> {
    let said = verdict(home, devices, block, None);
    match said {
        Some(Verdict::Proved { .. }) if block == Block::Divider => {
            verdict(home, devices, block, Some(&Map::parse(OF_A_SLOPE).unwrap()))
        }
        said => said,
    }
}

/// What a proof says of the devices in a file; `None` where it refuses them.
fn verdict(home: &Path, devices: &str, block: Block, map: Option<&Map>) -> Option<Verdict> {
    let rtl = [home.join("dut.sv")];
    std::fs::write(&rtl[0], devices).unwrap();
    let folder = home.join("proof");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    let profile = profile::load("sgi-4k").unwrap();
    let limit = Duration::from_mins(1);
    let question = Question { profile: &profile, block, rtl: &rtl, map, folder: &folder, limit };
    match prove(&question) {
        Ok(answer) => Some(answer.verdict),
        Err(
            EquivalenceError::Design { .. }
            | EquivalenceError::Map(_)
            | EquivalenceError::Tool { .. },
        ) => None,
        Err(error) => panic!("{error}\n{devices}"),
    }
}

/// Defects that the blocks do not take: of the set-up behind its words, in the division and in the hand-shake; of the
/// divider one that makes it busy for longer after a reset.
const NOT_OF_THE_BLOCK: [&str; 5] = [
    "setup-slopes-swapped",
    "setup-interpolation-short",
    "setup-answer-unstable",
    "setup-without-valid",
    "divider-reset-ignored",
];

/// The defects of `mutants.toml` are refuted; those that are none are proved.
pub(crate) fn defects(_: &str) {
    are_refuted(|module| module == "dda" || module == "edge_stepper", 50);
}

pub(crate) fn defects_of_larger_units(_: &str) {
    are_refuted(|module| module != "dda" && module != "edge_stepper", 30);
}

fn are_refuted(of: fn(&str) -> bool, least: usize) {
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), "vectors sgi-4k --size smoke --out set").ends(0);
    let devices = std::fs::read_to_string(home.path().join("set/dut.sv")).unwrap();
    let mut wrong = Vec::new();
    let mut mutants = of_units(&devices);
    mutants.retain(|(_, module, ..)| of(module));
    assert!(mutants.len() >= least, "{}", mutants.len());
    for (id, module, equivalent, text) in mutants {
        let verdict = verdict(home.path(), &text, block(&module).unwrap(), None);
        let is_seen = !equivalent && !NOT_OF_THE_BLOCK.contains(&id.as_str());
        let right = match verdict {
            Some(Verdict::Proved { .. }) => !is_seen,
            Some(Verdict::Refuted { .. }) => is_seen,
            // What is left open is neither proved nor wrongly refuted.
            Some(Verdict::Undecided { .. }) => id == "divider-reset-ignored",
            None => false,
        };
        if !right {
            wrong.push(format!("{id}: {verdict:?}"));
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

/// A sample of blind mutants; what is proved equal is simulated.
pub(crate) fn sampled(_: &str) {
    let seed = number("GUARDBIT_SEED", week(SystemTime::now()));
    let (count, rows) = (number("GUARDBIT_PROOFS", 5), number("GUARDBIT_ROWS", 20_000));
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), &format!("vectors sgi-4k --count {rows} --out set")).ends(0);
    let set = home.path().join("set");
    let devices = Devices::read(&set);
    std::fs::copy(set.join("dut.sv"), home.path().join("dut.sv")).unwrap();
    assert_eq!(probe::wrong(home.path(), &set), 0, "the set's own device");
    let mut sample = Sample::new(&devices, seed, |_| true);
    let [mut proved, mut refuted, mut undecided, mut refused] = [0; 4];
    while proved + refuted + undecided + refused < count {
        let Some(mutant) = sample.draw() else { break };
        let Some(block) = block(&mutant.module) else { continue };
        let text = devices.with(&mutant);
        std::fs::write(home.path().join("dut.sv"), &text).unwrap();
        if !build(home.path(), &set).0 {
            continue;
        }
        match at_all_widths(home.path(), &text, block) {
            Some(Verdict::Proved { .. }) => {
                proved += 1;
                // Of a set-up the words are proved, before the division and without its handshake.
                if block == Block::SetUp {
                    let wrong = probe::wrong(home.path(), &set);
                    assert_eq!(wrong, 0, "proved and wrong: {:?}", devices.lines(&mutant));
                    continue;
                }
                for file in std::fs::read_dir(&set).unwrap().flatten() {
                    let link = home.path().join(file.file_name());
                    if link.extension().is_some_and(|ending| ending == "tv") && !link.exists() {
                        std::fs::hard_link(file.path(), link).unwrap();
                    }
                }
                let (good, said) = run(home.path(), "vvp", &["-n", "sim.vvp"]);
                assert!(good, "proved and wrong: {:?}\n{said}", devices.lines(&mutant));
            }
            Some(Verdict::Refuted { .. }) => refuted += 1,
            None => refused += 1,
            Some(Verdict::Undecided { words }) => {
                undecided += 1;
                eprintln!("undecided: {:?}: {words}", devices.lines(&mutant));
            }
        }
    }
    eprintln!(
        "seed {seed}: {proved} proved, {refuted} refuted, {undecided} undecided, {refused} refused"
    );
    assert!(refuted + proved > 0);
}
