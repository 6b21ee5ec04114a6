//! Vector sets in folders of their own, and simulators that are run on them.

use crate::run::run_in;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A set, gone with this value.
pub(crate) struct Set {
    _home: TempDir,
    pub(crate) folder: PathBuf,
}

impl Set {
    /// What `guardbit vectors` writes for these arguments.
    pub(crate) fn new(arguments: &str) -> Self {
        let home = tempfile::tempdir().unwrap();
        run_in(home.path(), &format!("vectors {arguments} --out set")).ends(0);
        let folder = home.path().join("set");
        Self { _home: home, folder }
    }

    /// A set of a built-in profile with lines of its TOML replaced.
    pub(crate) fn of(profile: &str, lines: &[(&str, &str)], arguments: &str) -> Self {
        let home = tempfile::tempdir().unwrap();
        let mut text = run_in(home.path(), &format!("profile show {profile}")).ends(0).out;
        for (old, new) in lines {
            assert!(text.contains(old), "{old}");
            text = text.replace(old, new);
        }
        std::fs::write(home.path().join("own.toml"), text).unwrap();
        run_in(home.path(), &format!("vectors own.toml {arguments} --out set")).ends(0);
        let folder = home.path().join("set");
        Self { _home: home, folder }
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.join(name)).unwrap()
    }
}

/// Text of both streams, and whether it ended well.
pub(crate) fn run(folder: &Path, program: &str, arguments: &[&str]) -> (bool, String) {
    let ran = Command::new(program).args(arguments).current_dir(folder).output();
    let Output { status, stdout, stderr } = ran.unwrap();
    let text = [stdout, stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (status.success(), text.concat())
}

/// The same within a time; `None` if it did not end, and was ended.
pub(crate) fn limited(
    folder: &Path,
    program: &str,
    arguments: &[&str],
    limit: Duration,
) -> Option<(bool, String)> {
    // Output goes to a file: a pipe that nobody empties would stop the program.
    let path = folder.join("limited.txt");
    let file = File::create(&path).unwrap();
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    let mut child = command.stdout(file.try_clone().unwrap()).stderr(file).spawn().unwrap();
    let begin = Instant::now();
    let mut pause = Duration::from_millis(1);
    while begin.elapsed() < limit {
        if let Some(status) = child.try_wait().unwrap() {
            let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
            return Some((status.success(), text));
        }
        thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(50));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    None
}

/// Text of both streams of a program that has to end well.
#[track_caller]
pub(crate) fn good(folder: &Path, program: &str, arguments: &[&str]) -> String {
    let (good, text) = run(folder, program, arguments);
    assert!(good, "{program} {arguments:?}: {text}");
    text
}

/// Builds a set's bench in Icarus, as its head says.
pub(crate) fn build_icarus(folder: &Path) {
    let built = good(folder, "iverilog", &["-g2012", "-o", "sim.vvp", "pkg.sv", "dut.sv", "tb.sv"]);
    assert_eq!(built, "", "no warnings");
}

/// Builds a set's bench in Verilator, as its head says.
pub(crate) fn build_verilator(folder: &Path) {
    let options = ["--binary", "-O3", "-Wno-fatal", "--top-module", "tb", "-j", "2"];
    let files = ["pkg.sv", "dut.sv", "tb.sv", "-o", "sim"];
    good(folder, "verilator", &[&options[..], &files].concat());
}

/// Builds it with the assertions of the set's folder `formal` in the devices, as `bind.sv` says there.
pub(crate) fn build_asserted(folder: &Path) {
    let options = ["--binary", "--assert", "-O3", "-Wno-fatal", "--top-module", "tb", "-j", "2"];
    let formal = ["formal/reference.sv", "formal/properties.sv", "formal/bind.sv"];
    let files = ["pkg.sv", "dut.sv", "tb.sv", "-o", "sim"];
    good(folder, "verilator", &[&options[..], &formal, &files].concat());
}

/// Builds a set's bench in GHDL, as its head says.
pub(crate) fn build_ghdl(folder: &Path) {
    good(folder, "ghdl", &["-a", "--std=08", "pkg.vhd", "dut.vhd", "tb.vhd"]);
    good(folder, "ghdl", &["-e", "--std=08", "tb"]);
}

/// The command that runs a built bench.
pub(crate) const ICARUS: (&str, &[&str]) = ("vvp", &["-n", "sim.vvp"]);
pub(crate) const VERILATOR: (&str, &[&str]) = ("./obj_dir/sim", &[]);
pub(crate) const GHDL: (&str, &[&str]) = ("ghdl", &["-r", "--std=08", "tb"]);
