//! The generated cocotb scoreboard.

use crate::set::{Set, run};
use std::path::Path;
use std::process::Command;

/// Runs the scoreboard as its head says; whether it ended well, and what it said.
fn scoreboard(folder: &Path, device: Option<&str>) -> (bool, String) {
    let mut command = Command::new("python3");
    command.arg("tb_cocotb.py").current_dir(folder);
    if let Some(device) = device {
        command.env("GUARDBIT_DEVICE", device);
    }
    let ran = command.output().unwrap();
    let text = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (ran.status.success(), text.concat())
}

fn spoiled(set: &Set, name: &str, spoil: impl Fn(&str) -> String, device: &str, says: &str) {
    let whole = set.read(name);
    let spoilt = spoil(&whole);
    assert_ne!(spoilt, whole, "{name}: nothing was spoilt");
    std::fs::write(set.folder.join(name), spoilt).unwrap();
    let (good, text) = scoreboard(&set.folder, Some(device));
    assert!(!good && text.contains(says), "{name}: {text}");
    std::fs::write(set.folder.join(name), whole).unwrap();
}

pub(crate) fn cocotb(_: &str) {
    let mut rows = 0;
    for set in ["tiny --count 1200", "sgi-4k --count 1500", "d3d11 --count 600"].map(Set::new) {
        let (good, text) = scoreboard(&set.folder, None);
        assert!(
            good && text.contains("PASS dda edge_stepper triangle_setup triangle_engine"),
            "{text}"
        );
        let counts = text.split("rows=").skip(1);
        rows += counts
            .filter_map(|rest| rest.split_whitespace().next()?.parse::<u64>().ok())
            .sum::<u64>();
    }
    assert!(rows >= 5000, "{rows}");
    // A bench without a device is named, and a register-level machine has its own.
    let (_, text) = scoreboard(&Set::new("d3d11 --count 60").folder, Some("dda"));
    assert!(
        text.contains("NOT CHECKED line: ") && text.contains("PASS dda not checked: line point"),
        "{text}"
    );
    let (good, text) = scoreboard(&Set::new("vortex --count 60").folder, None);
    assert!(good && text.contains("PASS quad_engine\n"), "{text}");
    // What it has to see: files that are not the manifest's, and devices that are not the set's.
    let set = Set::new("tiny --count 300");
    let short = |text: &str| text.split_inclusive('\n').take(9).collect();
    spoiled(&set, "dda.exp.tv", short, "dda", "9 rows, the manifest says 300");
    spoiled(&set, "edge.cfg.tv", |text| text.replacen('0', "1", 1), "edge_stepper", "SHA-256");
    let lag = |text: &str| text.replace("? dx : op == STEP_Y ? dy", "? dy : op == STEP_Y ? dx");
    spoiled(&set, "dut.sv", lag, "dda", "MISMATCH dda.exp.tv line");
    let drops = |text: &str| text.replace("(covered && !sample_ready) ||", "");
    spoiled(&set, "dut.sv", drops, "triangle_engine", "FAIL");
    let (_, version) = run(&set.folder, "cocotb-config", &["--version"]);
    assert!(version.starts_with("2."), "{version}");
}
