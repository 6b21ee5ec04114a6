//! The recipe of `recipes/mutation`: a score of our own devices, and what it says of nonsense.

// Clause J-5.
use crate::blind::sample::week;
use crate::run::{Ran, run_in};
use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

/// The recipe in a folder, with the test's guardbit.
fn recipe(folder: &Path, path: Option<&str>, arguments: &str) -> Ran {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new("/bin/bash");
    command.arg(root.join("recipes/mutation/mutate.sh")).args(arguments.split_whitespace());
    command.env("GUARDBIT", env!("CARGO_BIN_EXE_guardbit")).current_dir(folder);
    if let Some(path) = path {
        command.env("PATH", path);
    }
    command.output().unwrap().into()
}

/// A few mutants of each device, others each week. The recipe ends with 1 if one survives that yosys shows to
/// be another device; how many are caught depends on the week.
pub(crate) fn scores_our_devices(_: &str) {
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), "vectors sgi-4k --size smoke --out set").ends(0);
    let seed = week(SystemTime::now());
    for (top, bench) in [
        ("dda", "dda"),
        ("edge_stepper", "edge"),
        ("triangle_setup", "setup"),
        ("triangle_engine", "triangle"),
    ] {
        let arguments = format!(
            "--set set --top {top} --count 2 --seed {seed} --limit 2 --out {top} set/dut.sv"
        );
        let ran = recipe(home.path(), None, &arguments).ends(0);
        eprintln!("{}", ran.out);
        let head = format!("module {top}, seed {seed}: 2 mutants, ");
        assert!(ran.out.starts_with(&head), "{}", ran.out);
        let score = ran.out.lines().find_map(|line| line.strip_prefix("score: ")).unwrap();
        let caught: u32 = score.split(' ').next().unwrap().parse().unwrap();
        let table = std::fs::read_to_string(home.path().join(top).join("mutants.tsv")).unwrap();
        let killed = table.lines().filter(|line| line.split('\t').nth(1) == Some("killed"));
        assert_eq!(killed.count(), usize::try_from(caught).unwrap());
        // A bench that catches none is not looking.
        assert!(caught >= 1, "{}", ran.out);
        assert!(ran.out.contains(&format!("   {bench}/")), "{}", ran.out);
    }
}

pub(crate) fn says_what_is_missing(_: &str) {
    let home = tempfile::tempdir().unwrap();
    run_in(home.path(), "vectors tiny --scene fan --count 1000 --out set").ends(0);
    let write = |name: &str, text: &str| std::fs::write(home.path().join(name), text).unwrap();
    write("empty.sv", " \n");
    write("hollow.sv", "module dda;\nendmodule\n");
    write("broken.sv", "module dda; assign = 1;\nendmodule\n");
    let dut = std::fs::read_to_string(home.path().join("set/dut.sv")).unwrap();
    let wrong = dut.replace("assign in_v = ~e[M-1]", "assign in_v = e[M-1]");
    assert_ne!(dut, wrong);
    write("wrong.sv", &wrong);
    std::fs::create_dir(home.path().join("there")).unwrap();
    // The path has the shell's own programs and not those of hardware.
    let bare = home.path().join("bin");
    std::fs::create_dir(&bare).unwrap();
    for program in ["grep", "realpath", "nproc", "bash"] {
        let found = Command::new("bash").args(["-c", &format!("command -v {program}")]).output();
        let found = String::from_utf8(found.unwrap().stdout).unwrap();
        std::os::unix::fs::symlink(found.trim(), bare.join(program)).unwrap();
    }
    let says = |path: Option<&str>, arguments: &str, about: &[&str]| {
        let _ = recipe(home.path(), path, arguments).complains(2, about);
    };
    says(
        bare.to_str(),
        "--set set --top dda set/dut.sv",
        &["yosys is missing", "apt-get install yosys"],
    );
    says(None, "--top dda set/dut.sv", &["no bench", "--set", "--bench"]);
    says(
        None,
        "--set nowhere --top dda set/dut.sv",
        &["nowhere/pkg.sv: no such file", "guardbit vectors"],
    );
    says(None, "--set set --top ddb set/dut.sv", &["no module ddb", "dda", "edge_stepper"]);
    says(None, "--set set --top dda", &["no source file of dda"]);
    says(None, "--set set set/dut.sv", &["which module?"]);
    says(None, "--set set --top dda nowhere.sv", &["nowhere.sv: there is no such file"]);
    says(None, "--set set --top dda empty.sv", &["empty.sv is empty"]);
    says(None, "--set set --top dda --out o1 hollow.sv", &["no place to mutate"]);
    says(None, "--set set --top dda --out o2 broken.sv", &["yosys cannot read it", "broken.sv:1"]);
    says(None, "--set set --top dda --out there set/dut.sv", &["there is there already"]);
    says(None, "--set set --top dda --count 0 set/dut.sv", &["--count 0", "a number from 1"]);
    says(None, "--set set --top dda --cuont 3 set/dut.sv", &["no option --cuont"]);
    says(None, "--set set --top dda --seed", &["--seed needs a value"]);
    says(None, "--top dda --bench false --out o3 set/dut.sv", &["fails without a mutation"]);
    let ran = recipe(home.path(), None, "--set set --top edge_stepper --out o4 wrong.sv").ends(2);
    assert!(
        ran.err.contains("fails without a mutation") && ran.err.contains("FAIL"),
        "{}",
        ran.err
    );
}
