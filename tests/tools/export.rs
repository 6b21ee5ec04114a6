//! Exported references, compiled and run by others: they answer as the model does.

// Clause J-8.
use crate::run::run_in;
use guardbit::bits::Rounding;
use guardbit::profile::{self, Profile};
use guardbit::vector::reference::digests;
use std::path::Path;
use std::process::Command;

const BUILT_IN: [&str; 5] = ["sgi-4k", "d3d11", "tiny", "vulkan-8bit", "vulkan-4bit"];

/// Profiles that differ in everything that a reference folds in: the built-in ones, and one for each rounding.
fn profiles(home: &Path) -> Vec<(String, Profile)> {
    let mut list: Vec<_> =
        BUILT_IN.map(|name| (name.to_owned(), profile::load(name).unwrap())).into();
    for (n, rounding) in Rounding::ALL.into_iter().enumerate() {
        let mut text = profile::load(if n % 2 == 0 { "tiny" } else { "sgi-4k" }).unwrap().to_toml();
        let mut set = |key: &str, value: &str| {
            let from = text.find(&format!("\n{key} = ")).unwrap() + 1;
            let end = from + text[from..].find('\n').unwrap();
            text.replace_range(from..end, &format!("{key} = {value}"));
        };
        set("name", &format!("\"own-{n}\""));
        set("rounding", &format!("\"{rounding}\""));
        set("clamp", ["\"guard\"", "\"wrap\"", "\"sign\""][n % 3]);
        set("guard", ["1", "2", "3", "4"][n % 4]);
        set("rule", ["\"shadow\"", "\"top-left\""][n / 2 % 2]);
        if n % 5 < 2 {
            // One sub-pixel bit or ten are no longer dropped.
            set("storage", "\"full\"");
            set("width", if n % 2 == 0 { "7" } else { "45" });
        }
        set("start-bias", ["\"none\"", "\"half\""][n / 3 % 2]);
        let path = home.join(format!("own-{n}.toml"));
        std::fs::write(&path, &text).unwrap();
        let path = path.to_str().unwrap().to_owned();
        list.push((path.clone(), profile::load(&path).unwrap()));
    }
    list
}

/// Writes the reference of a profile in a language.
fn export(home: &Path, profile: &str, language: &str, file: &str) {
    let ran = run_in(home, &format!("export {profile} --as {language}")).ends(0);
    assert!(ran.out.lines().count() < 600 && !ran.out.contains("@P@"), "{}", ran.out);
    std::fs::write(home.join(file), ran.out).unwrap();
}

/// Runs a program in a folder; what it prints.
fn run(home: &Path, line: &str) -> String {
    let mut words = line.split_whitespace();
    let output =
        Command::new(words.next().unwrap()).args(words).current_dir(home).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success() && err.is_empty(), "{line}\n{out}{err}");
    out
}

/// The digests of a profile as the references print them.
fn model(profile: &Profile, seed: u64, cases: u64) -> String {
    let lines = digests(profile, seed, cases).unwrap().map(|digest| format!("{digest:016x}\n"));
    lines.concat()
}

/// The self test of each profile's reference, and other cases of the built-in ones; `build` makes a program of
/// a reference and says how it is run, and how with a seed and a number of cases.
fn agree(language: &str, cases: u64, build: impl Fn(&Path, &str) -> [String; 2]) {
    let home = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    for (path, profile) in profiles(home.path()) {
        let id = profile.name.replace('-', "_");
        let file = format!("{id}.{language}");
        export(home.path(), &path, language, &file);
        let [plain, other] = build(home.path(), &id);
        let said = run(home.path(), &plain);
        if said != format!("{}: PASS, 1000 cases\n", profile.name) {
            wrong.push(said);
        }
        if BUILT_IN.contains(&path.as_str()) {
            let other = other.replace("SEED", "77").replace("CASES", &cases.to_string());
            assert_eq!(run(home.path(), &other), model(&profile, 77, cases), "{id}");
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

const CHECKS: &str = "-O2 -Wall -Wextra -Wconversion -Wpedantic -Werror -fsanitize=undefined -fno-sanitize-recover=all";

/// The references in C or C++, compiled for a standard.
fn compiled(compiler: &str, language: &str, standard: &str, cases: u64) {
    let of_file = if language == "cpp" { "c++" } else { "c" };
    agree(language, cases, |home, id| {
        let main = id.to_uppercase();
        let build = format!(
            "{compiler} -std={standard} {CHECKS} -D{main}_MAIN -o {id}.run -x {of_file} {id}.{language}"
        );
        let _ = run(home, &build);
        let program = format!("{}/{id}.run", home.display());
        [program.clone(), format!("{program} SEED CASES")]
    });
}

pub(crate) fn c_agrees(compiler: &str) {
    compiled(compiler, "c", "c99", 20_000);
}

pub(crate) fn c_agrees_on_a_million(compiler: &str) {
    compiled(compiler, "c", "c99", 1_000_000);
}

pub(crate) fn cpp_agrees(compiler: &str) {
    compiled(compiler, "cpp", "c++17", 20_000);
}

pub(crate) fn python_agrees(python: &str) {
    agree("python", 2000, |_, id| {
        [format!("{python} {id}.python"), format!("{python} {id}.python SEED CASES")]
    });
}

pub(crate) fn systemverilog_agrees(iverilog: &str) {
    agree("sv", 2000, |home, id| {
        let top = format!("{id}_reference_self_test");
        let _ = run(
            home,
            &format!("{iverilog} -g2012 -Wall -Wno-timescale -s {top} -o {id}.vvp {id}.sv"),
        );
        [format!("vvp -n {id}.vvp"), format!("vvp -n {id}.vvp +seed=SEED +cases=CASES")]
    });
}

pub(crate) fn verilator_finds_nothing(verilator: &str) {
    let home = tempfile::tempdir().unwrap();
    for (path, profile) in profiles(home.path()) {
        let id = profile.name.replace('-', "_");
        export(home.path(), &path, "sv", "reference.sv");
        let top = format!("{id}_reference_self_test");
        let _ = run(
            home.path(),
            &format!("{verilator} --lint-only -Wall --timing --top-module {top} reference.sv"),
        );
    }
}

pub(crate) fn yosys_reads_the_modules(yosys: &str) {
    let home = tempfile::tempdir().unwrap();
    for name in BUILT_IN {
        export(home.path(), name, "sv", "reference.sv");
        let id = name.replace('-', "_");
        for module in ["dda", "edge_stepper", "setup", "sample"] {
            let script = format!(
                "read_verilog -sv reference.sv\nhierarchy -check -top {id}_reference_{module}\nproc\ncheck -assert\n"
            );
            std::fs::write(home.path().join("read.ys"), script).unwrap();
            let _ = run(home.path(), &format!("{yosys} -q read.ys"));
        }
    }
}
