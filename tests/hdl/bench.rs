//! Benches that pass, in sizes and profiles that mean something.

// Clauses J-1, J-2 and J-3.
use crate::set::{
    GHDL, ICARUS, Set, VERILATOR, build_asserted, build_ghdl, build_icarus, build_verilator, good,
};
use guardbit::bits::Rounding;
use std::path::{Path, PathBuf};
use std::thread;

/// Profiles with 1 to 4 guard bits, every read-out, both fill rules, both storages, signed and
/// unsigned vertices, and each way to round.
fn sets(walks: u64) -> Vec<Set> {
    let count = format!("--count {walks}");
    let own = |profile, lines: &[(&str, &str)]| Set::of(profile, lines, &count);
    let rounded = |rounding: &str| {
        let line = format!("rounding = \"{rounding}\"");
        own("sgi-4k", &[("guard = 2", "guard = 3"), ("rounding = \"nearest-even\"", &line)])
    };
    vec![
        Set::new(&format!("sgi-4k {count}")),
        Set::new(&format!("d3d11 {count}")),
        Set::new(&format!("tiny {count}")),
        Set::new(&format!("sgi-4k-walk {count}")),
        own("sgi-4k", &[("guard = 2", "guard = 4"), ("top-left", "shadow")]),
        own("tiny", &[("clamp = \"guard\"", "clamp = \"saturate\"")]),
        own(
            "tiny",
            &[
                ("clamp = \"guard\"", "clamp = \"sign\""),
                ("shifted", "full"),
                ("width = 6", "width = 8"),
            ],
        ),
        own("tiny", &[("clamp = \"guard\"", "clamp = \"wrap\""), ("guard = 1", "guard = 0")]),
        rounded("nearest-toward-zero"),
    ]
}

/// Runs a built bench and gives the rows it says it compared. It has to have compared those of every
/// device of this bench that the set's `dut.sv` has.
fn passes(folder: &Path, (program, arguments): (&str, &[&str])) -> u64 {
    let text = good(folder, program, arguments);
    let pass = text.lines().find(|line| line.contains("PASS ")).expect(&text);
    let devices = std::fs::read_to_string(folder.join("dut.sv")).unwrap();
    for (bench, device) in [
        ("dda", "dda"),
        ("edge", "edge_stepper"),
        ("setup", "triangle_setup"),
        ("triangle", "triangle_engine"),
    ] {
        let has = devices.contains(&format!("\nmodule {device} "));
        assert_eq!(pass.contains(&format!("{bench} rows=")), has, "{bench}: {pass}");
    }
    let counts = pass.split("rows=").skip(1);
    counts.map(|rest| rest.split(' ').next().unwrap().trim().parse::<u64>().unwrap()).sum()
}

/// Modules that are only parts of others.
const PARTS: [&str; 5] =
    ["bit_length", "reciprocal_table", "newton_step", "held_value", "rounded_shift"];

pub(crate) fn lint_clean(verilator: &str) {
    let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).join("hdl");
    let names = [
        "dda",
        "edge_stepper",
        "edge_evaluator",
        "depth_evaluator",
        "triangle_engine",
        "setup_divider",
        "triangle_setup",
        "quad_engine",
        "anchored_engine",
        "vertex_quad_engine",
        "given_slope_engine",
        "divided_slope_engine",
        "sub_scanline_engine",
        "bit_length",
        "reciprocal_table",
        "newton_step",
        "held_value",
        "rounded_shift",
        "reciprocal_unit",
        "interpolator",
        "perspective_divider",
    ];
    let files: Vec<String> = names.iter().map(|name| format!("{name}.sv")).collect();
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    let tops = ["triangle_engine", "triangle_setup"]
        .into_iter()
        .chain(names[7..].iter().copied().filter(|name| !PARTS.contains(name)));
    for top in tops {
        let options = ["--lint-only", "-Wall", "--top-module", top];
        assert_eq!(good(&rtl, verilator, &[&options[..], &files].concat()), "", "{top}");
    }
}

pub(crate) fn icarus(_: &str) {
    let mut rows = 0;
    for set in sets(6000) {
        build_icarus(&set.folder);
        rows += passes(&set.folder, ICARUS);
    }
    assert!(rows >= 100_000, "{rows}");
    // The divider of hardware, a bit a clock, in place of the quick one.
    for profile in ["sgi-4k", "tiny"] {
        let set = Set::new(&format!("{profile} --count 3000"));
        let devices = set.read("dut.sv");
        let serial = devices.replace("parameter int SERIAL = 0", "parameter int SERIAL = 1");
        assert_ne!(serial, devices);
        std::fs::write(set.folder.join("dut.sv"), serial).unwrap();
        build_icarus(&set.folder);
        passes(&set.folder, ICARUS);
    }
}

/// The divider's rounding is a parameter: each of them, under a profile that has it.
pub(crate) fn icarus_rounds(_: &str) {
    for rounding in Rounding::ALL.map(|rounding| rounding.names().guardbit) {
        let line = format!("rounding = \"{rounding}\"");
        let set = Set::of("tiny", &[("rounding = \"nearest-even\"", &line)], "--count 1200");
        build_icarus(&set.folder);
        passes(&set.folder, ICARUS);
    }
}

pub(crate) fn verilator(_: &str) {
    let mut sets = sets(60_000);
    // With the units of channels.
    let textured = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/textured.toml");
    sets.push(Set::new(&format!("{} --count 20000", textured.display())));
    let folders: Vec<PathBuf> = sets.iter().map(|set| set.folder.clone()).collect();
    // A build keeps one core busy: two at a time.
    let halves: Vec<Vec<PathBuf>> = folders.chunks(5).map(<[PathBuf]>::to_vec).collect();
    let jobs = halves.into_iter().map(|folders| {
        thread::spawn(move || {
            folders
                .iter()
                .map(|folder| {
                    // Under assertions, where the set has some.
                    if folder.join("formal").exists() {
                        build_asserted(folder);
                    } else {
                        build_verilator(folder);
                    }
                    passes(folder, VERILATOR)
                })
                .sum::<u64>()
        })
    });
    let jobs: Vec<_> = jobs.collect();
    let rows: u64 = jobs.into_iter().map(|job| job.join().unwrap()).sum();
    assert!(rows >= 1_000_000, "{rows}");
}

pub(crate) fn ghdl(_: &str) {
    let mut rows = 0;
    for set in sets(800) {
        build_ghdl(&set.folder);
        rows += passes(&set.folder, GHDL);
    }
    assert!(rows >= 8_000, "{rows}");
    // What the devices answer comes back as a dump that agrees.
    let set = Set::new("tiny --count 300");
    build_ghdl(&set.folder);
    let arguments = [GHDL.1, &["-gDUMP=true"]].concat();
    good(&set.folder, GHDL.0, &arguments);
    for stem in ["dda.exp", "edge.exp", "setup.exp", "span.exp", "depth.exp"] {
        // GHDL writes capital digits.
        let dump = set.read(&format!("{stem}.dut.tv")).to_lowercase();
        assert!(dump == set.read(&format!("{stem}.tv")), "{stem}");
    }
}
