//! The live model in real simulators and from C. A trial whose program is missing counts as ignored.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "../../../tests/support/tool.rs"]
mod tool;

use libtest_mimic::Arguments;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Once;
use std::time::Instant;
use tool::{GHDL, ICARUS, Tool, VERILATOR};

const COMPILER: Tool = Tool {
    name: "cc",
    programs: &["cc", "gcc"],
    version: "--version",
    hardware: true,
    package: "apt-get install gcc",
};

fn main() {
    let trials = vec![
        COMPILER.trial("c_calls_that_are_wrong_get_a_code_and_a_message", c),
        VERILATOR.trial("verilator_over_dpi", verilator),
        VERILATOR.trial("verilator_beside_units_of_channels", verilator_channels),
        ICARUS.trial("icarus_over_vpi", icarus),
        GHDL.trial("ghdl_over_vhpidirect", ghdl),
    ];
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

fn here(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path).display().to_string()
}

/// A form of the library. The tests of a package build what they link, not what it delivers.
fn library(name: &str) -> PathBuf {
    static BUILT: Once = Once::new();
    BUILT.call_once(|| {
        let release = if cfg!(debug_assertions) { &[][..] } else { &["--release"] };
        good(Path::new(&here("")), env!("CARGO"), &[&["build", "--quiet"][..], release].concat());
    });
    // This test is in `deps` of the profile's folder.
    let test = std::env::current_exe().unwrap();
    let found = test.ancestors().nth(2).unwrap().join(name);
    assert!(found.is_file(), "{} was not built", found.display());
    found
}

#[track_caller]
fn good(folder: &Path, program: &str, arguments: &[&str]) -> String {
    let ran = Command::new(program).args(arguments).current_dir(folder).output().unwrap();
    let text = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert!(ran.status.success(), "{program} {arguments:?}: {}", text.concat());
    text.concat()
}

/// The profile `channels.toml` in a folder.
fn channels(folder: &Path) {
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let channels = std::fs::read_to_string(here("tests/channels.toml")).unwrap();
    std::fs::write(folder.join("channels.toml"), tiny + "\n" + &channels).unwrap();
}

fn c(compiler: &str) {
    let home = tempfile::tempdir().unwrap();
    channels(home.path());
    let archive = library("libguardbit_c.a").display().to_string();
    let include = here("");
    let source = here("tests/wrong.c");
    let options = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-o", "wrong", "-I", &include];
    let libraries = [&*source, &archive, "-lpthread", "-ldl", "-lm"];
    good(home.path(), compiler, &[&options[..], &libraries].concat());
    assert_eq!(good(home.path(), "./wrong", &[]), "PASS\n");
}

fn verilator(verilator: &str) {
    let home = tempfile::tempdir().unwrap();
    let archive = library("libguardbit_c.a").display().to_string();
    let files = ["dpi/guardbit_dpi.sv", "../../hdl/dda.sv", "dpi/live.sv"].map(here);
    let [package, device, bench] = &files;
    let options = ["--binary", "-O3", "-Wno-fatal", "--top-module", "live", "-j", "2", "-o", "sim"];
    let rest = [package, device, bench, &*archive, "-LDFLAGS", "-lpthread -ldl"];
    good(home.path(), verilator, &[&options[..], &rest].concat());
    let sim = home.path().join("obj_dir/sim").display().to_string();
    let timed = |calls: u32| {
        let begun = Instant::now();
        let text = good(home.path(), &sim, &["+clocks=100000", &format!("+calls={calls}")]);
        assert!(text.contains(&format!("PASS clocks=100000 calls={calls}")), "{text}");
        begun.elapsed()
    };
    let (none, many) = (timed(0), timed(10_000_000));
    let rate = 10.0 / (many.saturating_sub(none)).as_secs_f64();
    eprintln!("{rate:.1} million calls a second over DPI-C");
}

fn verilator_channels(verilator: &str) {
    let home = tempfile::tempdir().unwrap();
    channels(home.path());
    let archive = library("libguardbit_c.a").display().to_string();
    let devices =
        ["interpolator", "held_value", "perspective_divider", "setup_divider", "reciprocal_unit"];
    let rest = ["reciprocal_table", "newton_step", "rounded_shift", "bit_length"];
    let devices = devices.iter().chain(&rest).map(|name| here(&format!("../../hdl/{name}.sv")));
    let files: Vec<String> = [here("dpi/guardbit_dpi.sv"), here("dpi/live_channels.sv")]
        .into_iter()
        .chain(devices)
        .collect();
    let options =
        ["--binary", "-Wno-fatal", "--top-module", "live_channels", "-j", "2", "-o", "sim"];
    let mut all = options.to_vec();
    all.extend(files.iter().map(String::as_str));
    all.extend([&*archive, "-LDFLAGS", "-lpthread -ldl"]);
    good(home.path(), verilator, &all);
    let sim = home.path().join("obj_dir/sim").display().to_string();
    let text = good(home.path(), &sim, &["+clocks=20000"]);
    assert!(text.contains("PASS clocks=20000"), "{text}");
}

fn icarus(_: &str) {
    let home = tempfile::tempdir().unwrap();
    channels(home.path());
    let library = library("libguardbit_c.so");
    let folder = library.parent().unwrap().display().to_string();
    let options = ["--name=guardbit", &*format!("-I{}", here("")), &here("vpi/guardbit_vpi.c")]
        .map(str::to_owned);
    let options: Vec<&str> = options.iter().map(String::as_str).collect();
    let link = [&*format!("-L{folder}"), "-lguardbit_c"].map(str::to_owned);
    let link: Vec<&str> = link.iter().map(String::as_str).collect();
    good(home.path(), "iverilog-vpi", &[&options[..], &link].concat());
    let files = ["../../hdl/dda.sv", "vpi/live.sv"].map(here);
    good(home.path(), "iverilog", &["-g2012", "-o", "sim.vvp", &files[0], &files[1]]);
    let ran = Command::new("vvp")
        .args(["-n", "-M.", "-mguardbit", "sim.vvp"])
        .env("LD_LIBRARY_PATH", &folder)
        .current_dir(home.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&ran.stdout);
    assert!(ran.status.success() && text.contains("PASS clocks=20000"), "{text}");
    assert!(text.contains("an argument has X or Z bits"), "{text}");
    assert!(text.contains("no such profile"), "{text}");
}

fn ghdl(ghdl: &str) {
    let home = tempfile::tempdir().unwrap();
    channels(home.path());
    // The package names the library in the folder where the simulation runs.
    std::os::unix::fs::symlink(library("libguardbit_c.so"), home.path().join("libguardbit_c.so"))
        .unwrap();
    let files = ["../../hdl/dda.vhd", "vhpi/guardbit_vhpi.vhd", "vhpi/live.vhd"].map(here);
    let [device, package, bench] = &files;
    good(home.path(), ghdl, &["-a", "--std=08", device, package, bench]);
    good(home.path(), ghdl, &["-e", "--std=08", "live"]);
    let text = good(home.path(), ghdl, &["-r", "--std=08", "live"]);
    assert!(text.contains("PASS clocks=20000"), "{text}");
}
