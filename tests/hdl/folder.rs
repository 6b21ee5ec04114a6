//! The folder `formal` of a set: its scripts prove the set's devices, and its assertions see defects in a simulator.

// Clause J-13.
use crate::set::{Set, VERILATOR, build_asserted, good, run};
use std::path::Path;

/// Devices with a script.
const UNITS: [&str; 4] = ["dda", "edge_stepper", "edge_evaluator", "depth_evaluator"];

/// What SymbiYosys does between the script of a file and the solver: registers are made plain, and logic gates.
const GATES: &str = "\nhierarchy -smtcheck\nmemory_nordff\nasync2sync\nchformal -assume -early\nopt_clean\n\
    formalff -setundef -clk2ff -ff2anyinit\nchformal -live -fair -cover -remove\nopt_clean\ncheck\n\
    setundef -undriven -anyseq\nopt -fast\nopt_clean\nhierarchy -simcheck\nflatten\nsetattr -unset keep\n\
    delete -output\nopt -full\ntechmap\nopt -fast\nmemory_map -formal\nformalff -clk2ff -ff2anyinit\nsimplemap\n\
    dffunmap\nabc -g AND -fast\nopt_clean\nwrite_aiger -I -B -zinit gates.aig\n";

/// The lines of a section of a script, and the name in its head.
fn sections(text: &str) -> Vec<(String, String)> {
    let mut list: Vec<(String, String)> = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        match line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            Some(head) => list.push((head.to_owned(), String::new())),
            None => {
                if let Some((_, lines)) = list.last_mut() {
                    lines.extend([line, "\n"]);
                }
            }
        }
    }
    list
}

/// What the solver says of a set's script, as SymbiYosys would ask it.
fn asked(set: &Path, unit: &str) -> String {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let text = std::fs::read_to_string(set.join(format!("formal/{unit}.sby"))).unwrap();
    let mut script = String::new();
    for (head, lines) in sections(&text) {
        match head.split_once(' ').map_or((head.as_str(), ""), |(kind, name)| (kind, name)) {
            ("options", "") => assert_eq!(lines.trim(), "mode prove"),
            ("engines", "") => assert_eq!(lines.trim(), "abc pdr"),
            ("script", "") => script = lines,
            ("files", "") => {
                for file in lines.split_whitespace() {
                    let path = set.join("formal").join(file);
                    std::fs::copy(&path, home.join(path.file_name().unwrap())).unwrap();
                }
            }
            ("file", name) => std::fs::write(home.join(name), lines).unwrap(),
            other => panic!("{other:?}"),
        }
    }
    std::fs::write(home.join("script.ys"), script + GATES).unwrap();
    good(home, "yosys", &["-q", "script.ys"]);
    let (_, said) = run(home, "yosys-abc", &["-c", "read_aiger gates.aig; fold; strash; pdr"]);
    said
}

/// The set's own devices are proved; a defect of a device is not.
pub(crate) fn scripts(_: &str) {
    for profile in ["sgi-4k", "tiny"] {
        let set = Set::new(&format!("{profile} --size smoke"));
        for unit in UNITS {
            let said = asked(&set.folder, unit);
            assert!(said.contains("Property proved."), "{profile} {unit}: {said}");
        }
        if profile != "tiny" {
            continue;
        }
        let devices = set.read("dut.sv");
        for (unit, old, new) in [
            ("dda", "op == STEP_Y ? dy", "op == STEP_Y ? dx"),
            ("edge_stepper", "e <= e + ea", "e <= e + eb"),
            ("edge_evaluator", "left + edge_dy", "left - edge_dy"),
            ("depth_evaluator", "across[N-1:0] + down[N-1:0]", "across[N-1:0]"),
        ] {
            assert!(devices.contains(old), "{old}");
            std::fs::write(set.folder.join("dut.sv"), devices.replace(old, new)).unwrap();
            let said = asked(&set.folder, unit);
            assert!(said.contains("was asserted in frame"), "{profile} {unit}: {said}");
        }
    }
}

/// A bench whose devices are wrong in several places breaks the assertion of each place.
pub(crate) fn assertions(_: &str) {
    let set = Set::new("tiny --count 1500");
    build_asserted(&set.folder);
    assert!(good(&set.folder, VERILATOR.0, VERILATOR.1).contains("PASS "));
    let mut devices = set.read("dut.sv");
    let mut named = Vec::new();
    for (old, new, name) in [
        ("e <= e + ea", "e <= e - ea", "edge_word"),
        ("op == STEP_Y ? dy", "op == STEP_Y ? dx", "accumulator"),
        ("step(yb, yc)", "step(yc, yb)", "edge_1"),
        ("HALF != 0", "HALF == 0", "plane"),
        ("assign sample_x = x;", "assign sample_x = right;", "in_the_box"),
        ("&& covers == 3'b111", "&& covers != 3'b000", "inside_bit"),
        ("samples <= samples + 1;", "samples <= samples + 2;", "sample_count"),
        ("if (closes) spans <= spans + 1;", "", "span_count"),
    ] {
        assert!(devices.contains(old), "{old}");
        devices = devices.replace(old, new);
        named.push(format!(".properties.{name}: 'assert' failed"));
    }
    std::fs::write(set.folder.join("dut.sv"), devices).unwrap();
    build_asserted(&set.folder);
    let on = "+verilator+error+limit+100000";
    let (_, said) = run(&set.folder, VERILATOR.0, &[on]);
    for name in named {
        assert!(said.contains(&name), "{name}: {said}");
    }
}
