//! Trials that need a program from outside; without it they count as ignored.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "tools/export.rs"]
mod export;
#[path = "tools/prover.rs"]
mod prover;
#[path = "support/run.rs"]
mod run;
#[path = "tools/slurm.rs"]
mod slurm;
#[path = "support/tool.rs"]
mod tool;

use guardbit::measure::cost::{estimate, synthesise};
use guardbit::profile;
use libtest_mimic::Arguments;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;
use tool::{Tool, Z3};

const CHROMIUM: Tool =
    Tool::other(&["chromium", "chromium-browser", "google-chrome"], "apt-get install chromium");
const GAPPA: Tool = Tool::other(&["gappa"], "apt-get install gappa");
const SHELLCHECK: Tool = Tool::other(&["shellcheck"], "apt-get install shellcheck");
/// Its packages bring the programs of a node, of a user and of munge, too.
const SLURM: Tool = Tool {
    name: "slurm",
    // Daemons are not on every user's search path.
    programs: &["slurmctld", "/usr/sbin/slurmctld"],
    version: "-V",
    hardware: false,
    package: "apt-get install slurmctld slurmd slurm-client munge",
};

const GCC: Tool = Tool::other(&["gcc", "cc", "clang"], "apt-get install gcc");
const CPP: Tool = Tool::other(&["g++", "c++", "clang++"], "apt-get install g++");
const PYTHON: Tool = Tool::other(&["python3"], "apt-get install python3");

fn main() {
    let trials = vec![
        CHROMIUM.trial("a_browser_draws_the_page_and_clicks_through_it", page_of_two_fields),
        CHROMIUM.trial("a_page_of_one_budget_is_no_special_case", page_of_one_budget),
        CHROMIUM.trial("a_page_without_depth_is_no_special_case", page_without_depth),
        CHROMIUM.trial("the_rasterizer_of_a_browser_is_named", browser_is_named),
        tool::YOSYS.trial("every_built_in_profile_is_synthesised", profiles_are_synthesised),
        tool::YOSYS.trial("a_sweep_counts_the_cells_of_its_front", sweep_is_synthesised),
        Z3.trial("z3_agrees_with_every_claim", prover::z3_agrees_with_every_claim),
        Z3.trial(
            "z3_reads_the_file_and_refutes_a_spoiled_one",
            prover::z3_reads_the_file_and_refutes_a_spoiled_one,
        ),
        Z3.trial(
            "z3_finds_no_way_to_unreachable_cells",
            prover::z3_finds_no_way_to_unreachable_cells,
        ),
        GAPPA.trial("gappa_agrees_with_every_claim", prover::gappa_agrees_with_every_claim),
        GAPPA.trial(
            "gappa_reads_the_file_and_refuses_a_spoiled_one",
            prover::gappa_reads_the_file_and_refuses_a_spoiled_one,
        ),
        GCC.trial("exported_c_agrees", export::c_agrees),
        GCC.soak_trial("long_exported_c_agrees_on_a_million_cases", export::c_agrees_on_a_million),
        CPP.trial("exported_cpp_agrees", export::cpp_agrees),
        PYTHON.trial("exported_python_agrees", export::python_agrees),
        tool::ICARUS.trial("exported_systemverilog_agrees", export::systemverilog_agrees),
        tool::VERILATOR
            .trial("verilator_finds_nothing_in_exports", export::verilator_finds_nothing),
        tool::YOSYS.trial("yosys_reads_exported_modules", export::yosys_reads_the_modules),
        SHELLCHECK.trial("the_scripts_are_clean", slurm::scripts_are_clean),
        SLURM.soak_trial(
            "job_arrays_do_what_the_readme_says",
            slurm::arrays_do_what_the_readme_says,
        ),
    ];
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

fn page_of_two_fields(chromium: &str) {
    let space = "--scene terrain --window 160x120 --vary sub-pixel=4,8 --vary interpolation=3..6 \
                 --vary rounding=floor,nearest-even";
    let dom = click_through(chromium, "sgi-4k", space, 16);
    // Four maps are the default; the selected budget's is shown twice.
    assert_eq!(dom.matches("src=\"data:image/png").count(), 5, "maps");
}

fn page_of_one_budget(chromium: &str) {
    click_through(chromium, "tiny", "--scene triangle --vary guard=1", 1);
}

fn page_without_depth(chromium: &str) {
    let space = "--scene fan --window 64x48 --vary walk-fraction=2..4";
    click_through(chromium, "flat.toml", space, 3);
}

/// Clause ID-1: the recipe's page draws on whatever the browser has, here its software rasterizer, and `identify`
/// names what drew. Its sub-pixel bits are those that the device itself states.
fn browser_is_named(chromium: &str) {
    let home = tempfile::tempdir().unwrap();
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("recipes/identify/webgl.html");
    let address = format!("file://{}?seed=7&count=40", page.display());
    let software = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
    let output = browse(chromium, home.path(), &address, &software);
    let dom = String::from_utf8_lossy(&output.stdout);
    let (before, after) = dom.split_once("it says it has ").unwrap_or_else(|| panic!("{dom}"));
    assert!(before.contains("SwiftShader"), "{before}");
    let bits = after.split_whitespace().next().unwrap();
    let (_, cases) = dom.split_once("<pre id=\"cases\">").unwrap();
    let (cases, _) = cases.split_once("</pre>").unwrap();
    assert_eq!(cases.lines().count(), 40);
    std::fs::write(home.path().join("cases.jsonl"), cases).unwrap();
    let line = "identify --base vulkan-4bit --no-depth --cases cases.jsonl";
    let found = run::run_in(home.path(), line).ends(0).out;
    let row = |name: &str| {
        let line = found.lines().find(|line| line.starts_with(name)).unwrap();
        line[name.len()..].trim().to_owned()
    };
    assert_eq!(row("sub-pixel"), bits);
    assert_eq!([row("snap"), row("rule")], ["nearest-even", "top-left"]);
}

/// Makes a page, lets a browser click through it, and gives the document that came of it.
fn click_through(chromium: &str, profile: &str, space: &str, budgets: usize) -> String {
    let home = tempfile::tempdir().unwrap();
    let walk = run::run_in(home.path(), "profile show sgi-4k-walk").ends(0).out;
    let (before, _) = walk.split_once("[depth]").unwrap();
    std::fs::write(home.path().join("flat.toml"), before).unwrap();
    run::run_in(home.path(), &format!("explore {profile} {space} --no-speed --html page.html"))
        .ends(0);
    let page = home.path().join("page.html");
    assert!(page.metadata().unwrap().len() < 2_000_000, "a page stays small");
    let address = format!("file://{}#selftest", page.display());
    let output = browse(chromium, home.path(), &address, &["--disable-gpu"]);
    let dom = String::from_utf8_lossy(&output.stdout).into_owned();
    let log = String::from_utf8_lossy(&output.stderr);
    let console: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    assert!(console.is_empty(), "{console:#?}");
    let head = &dom[dom.find("<html").unwrap()..][..400.min(dom.len())];
    let head = &head[..head.find('>').unwrap()];
    for (attribute, value) in [("ready", &*budgets.to_string()), ("selftest", "passed")] {
        assert!(
            head.contains(&format!("data-{attribute}=\"{value}\"")),
            "{attribute}: {head}\n{log}"
        );
    }
    assert!(!head.contains("data-errors"), "{head}");
    let points = dom.matches("<circle class=\"point\"").count();
    assert_eq!(points, budgets, "a point a budget");
    dom
}

fn browse(chromium: &str, home: &Path, address: &str, graphics: &[&str]) -> std::process::Output {
    let mut command = Command::new(chromium);
    command.args(graphics).args([
        "--headless",
        "--no-sandbox",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--enable-logging=stderr",
        "--v=0",
        "--window-size=1400,1000",
        "--virtual-time-budget=20000",
        "--dump-dom",
    ]);
    command.arg(format!("--user-data-dir={}", home.join("browser").display())).arg(address);
    command.stdin(Stdio::null()).output().unwrap()
}

fn profiles_are_synthesised(yosys: &str) {
    for (name, _) in profile::BUILTIN {
        let profile = profile::load(name).unwrap();
        // Machines that begin at registers are described, not chosen: they have no estimate.
        if matches!(profile.form, profile::Form::Registers(_)) {
            continue;
        }
        // Samples between the sub-pixels have no estimate either, and say so.
        if name == "gamecube" {
            assert!(estimate(&profile).unwrap_err().to_string().contains("between the sub-pixels"));
            continue;
        }
        let found = synthesise(&profile, Path::new(yosys), Duration::from_mins(2)).unwrap();
        // Registers are what the estimate counts as well; tables have no count of ours to meet.
        assert_eq!(found.flip_flops, estimate(&profile).unwrap().register_bits, "{name}");
        for unit in &found.units {
            assert!(
                unit.luts > 0 && unit.flip_flops > 0 && unit.longest_path > 0,
                "{name} {unit:?}"
            );
        }
    }
}

fn sweep_is_synthesised(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let space = "explore tiny --scene triangle --vary guard=0..1 --no-speed --synth";
    let ran = run::run_in(home.path(), &format!("{space} --json --html page.html")).ends(0);
    let records: Vec<serde_json::Value> = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(records.len(), 2);
    for record in &records {
        let (found, bits) = (&record["synthesis"], &record["cost"]["register_bits"]);
        if record["pareto"] == true {
            assert_eq!(found["flip_flops"], *bits);
            assert_eq!(found["units"].as_array().unwrap().len(), 2);
        } else {
            assert!(found.is_null());
        }
    }
    assert!(records.iter().any(|record| record["pareto"] == true));
    let page = std::fs::read_to_string(home.path().join("page.html")).unwrap();
    assert!(page.contains("\"longest-path\""), "the page offers the figures");
    let table = run::run_in(home.path(), space).ends(0).out;
    assert!(table.lines().next().unwrap().contains("luts  flip-flops  longest-path"), "{table}");
    let csv = run::run_in(home.path(), &format!("{space} --csv")).ends(0).out;
    assert!(csv.lines().next().unwrap().ends_with(",luts,flip-flops,longest-path,pareto"), "{csv}");
    let columns: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
    assert!(columns.windows(2).all(|pair| pair[0] == pair[1]), "{columns:?}");
}
