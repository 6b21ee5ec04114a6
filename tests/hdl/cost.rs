//! The devices cost what `explore --synth` says of their profile.

use guardbit::measure::cost::{Cost, estimate, sources, synthesise_unit};
use guardbit::profile::{self, Profile};
use std::path::Path;
use std::time::Duration;

use crate::set::good;

/// Look-up tables and flip-flops of a device with its parameters.
fn cells(module: &str, parameters: &str) -> [u32; 2] {
    let home = tempfile::tempdir().unwrap();
    let device = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("hdl/{module}.sv"));
    let script = format!(
        "read_verilog -sv {}; chparam {parameters} {module}; synth -flatten -noabc -top {module}; \
         abc -lut 4; opt_clean; stat",
        device.display()
    );
    let text = good(home.path(), "yosys", &["-p", &script]);
    let last = text.rsplit("Number of cells").next().unwrap();
    let count = |kind: &str| -> u32 {
        let lines = last.lines().filter_map(|line| {
            let (name, count) = line.trim().split_once(' ')?;
            name.starts_with(kind).then(|| count.trim().parse::<u32>().ok()).flatten()
        });
        lines.sum()
    };
    [count("$lut"), count("$_SDFF") + count("$_DFF")]
}

pub(crate) fn as_explored(_: &str) {
    let wide = |guard: u32, interpolation: u32| -> Profile {
        let mut profile = profile::load("sgi-4k").unwrap();
        let depth = profile.depth.as_mut().unwrap();
        (depth.guard, depth.interpolation) = (guard, interpolation);
        profile
    };
    let mut before = [0; 2];
    for (guard, interpolation) in [(1, 4), (2, 13), (4, 24)] {
        let profile = wide(guard, interpolation);
        let sources = sources(&profile).unwrap();
        let source = sources.iter().find(|source| source.name == "depth").unwrap();
        let unit = synthesise_unit(source, Path::new("yosys"), Duration::from_mins(2)).unwrap();
        let parameters = format!("-set G {guard} -set I 24 -set F {interpolation}");
        let [luts, flip_flops] = cells("dda", &parameters);
        // The unit of a budget holds its slopes as well; the device takes them from outside.
        let width = guard + 24 + interpolation;
        assert_eq!(flip_flops, width, "an accumulator");
        assert_eq!(unit.flip_flops, 4 * width, "start and two slopes beside it");
        assert!((luts..luts + luts / 4).contains(&unit.luts), "{luts} {unit:?}");
        assert!(luts > before[0] && flip_flops > before[1], "wider costs more");
        eprintln!("{width} bits: device {luts} LUT4, {flip_flops} FF; explore {unit:?}");
        before = [luts, flip_flops];
    }
}

/// Areas of the smallest cells of Nangate45 in square micrometres: those of the gates that yosys maps to.
const AREAS: [(&str, f64); 10] = [
    ("$_NOT_", 0.532),
    ("$_NAND_", 0.798),
    ("$_NOR_", 0.798),
    ("$_AND_", 1.064),
    ("$_OR_", 1.064),
    ("$_AOI3_", 1.064),
    ("$_OAI3_", 1.064),
    ("$_XOR_", 1.596),
    ("$_XNOR_", 1.596),
    ("$_MUX_", 1.862),
];

/// The area of the gates of a device, without its registers, and the bits of these.
fn gates(module: &str, parts: &[&str], parameters: &str) -> (f64, f64) {
    let home = tempfile::tempdir().unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("hdl");
    let files: Vec<String> = parts
        .iter()
        .chain([&module])
        .map(|part| folder.join(format!("{part}.sv")).display().to_string())
        .collect();
    let script = format!(
        "read_verilog -sv {}; chparam {parameters} {module}; synth -flatten -noabc -top {module}; \
         abc -g AND,NAND,NOR,OR,XOR,XNOR,MUX,AOI3,OAI3; opt_clean; stat",
        files.join(" ")
    );
    let text = good(home.path(), "yosys", &["-p", &script]);
    let last = text.rsplit("Number of cells").next().unwrap();
    let (mut area, mut flip_flops) = (0.0, 0.0);
    for line in last.lines().skip(1) {
        let Some((name, count)) = line.trim().split_once(' ') else { break };
        let Ok(count) = count.trim().parse::<f64>() else { break };
        match AREAS.iter().find(|(gate, _)| *gate == name) {
            Some((_, one)) => area += one * count,
            None if name.contains("DFF") => flip_flops += count,
            None => panic!("{module}: a cell of no known area: {name}"),
        }
    }
    assert!(area > 0.0 && flip_flops > 0.0, "{last}");
    (area, flip_flops)
}

/// A register bit with its multiplexer: clause H-2.
const REGISTER: f64 = 4.2;

/// A profile with one channel of one component, and its cost.
fn channel(
    [integer, interpolation]: [u32; 2],
    [inverse, below]: [u32; 2],
    correction: &str,
) -> (Profile, Cost) {
    let words = "rounding = \"nearest-even\"\nclamp = \"guard\"\nguard = 1\n";
    let text = format!(
        "{}\n[w]\ninteger = {inverse}\ninterpolation = {below}\n{words}\n[[channel]]\nname = \"c\"\ncomponents = \
         [\"s\"]\ninteger = {integer}\ninterpolation = {interpolation}\n{words}correction = {correction}\n",
        profile::load("tiny").unwrap().to_toml()
    );
    let profile = profile::parse(&text, "channel.toml").unwrap();
    let cost = estimate(&profile).unwrap();
    (profile, cost)
}

#[track_caller]
fn near(what: &str, measured: f64, estimated: f64, range: std::ops::Range<f64>) {
    let ratio = measured / estimated;
    eprintln!("{what}: {measured:.0} of {estimated:.0} um2, {ratio:.2}");
    assert!(range.contains(&ratio), "{what}: {measured} is not {range:?} of {estimated}");
}

const QUOTIENT: &str = "{ quotient = { rounding = \"nearest-even\" } }";

/// Clause H-5: the start and two slopes of a component, beside the device's accumulator.
fn interpolator(integer: u32, interpolation: u32) {
    let (_, cost) = channel([integer, interpolation], [5, 5], QUOTIENT);
    let parameters = format!("-set G 1 -set I {integer} -set F {interpolation}");
    let (gates, width) = gates("interpolator", &["held_value"], &parameters);
    let measured = gates + 4.0 * width * REGISTER;
    near("interpolator", measured, cost.channels[1].walked_um2, 1.0..1.3);
}

const DIVIDER: [&str; 7] = [
    "bit_length",
    "reciprocal_table",
    "newton_step",
    "reciprocal_unit",
    "held_value",
    "setup_divider",
    "rounded_shift",
];

/// Clause H-5: what corrects a channel, whose registers are stages and not counted.
fn correction(words: [[u32; 2]; 2], correction: &str, unit: &str, range: std::ops::Range<f64>) {
    let [[integer, fraction], [inverse, below]] = words;
    let (_, cost) = channel(words[0], words[1], correction);
    let parameters = format!(
        "-set G 1 -set I {integer} -set F {fraction} -set GW 1 -set B {inverse} -set FW {below} {unit}"
    );
    let (gates, _) = gates("perspective_divider", &DIVIDER, &parameters);
    near(correction, gates, cost.channels[1].correction_um2, range);
}

fn reciprocal(unit: &str) -> String {
    format!("{{ reciprocal = {{ rounding = \"nearest-even\", unit = {{ {unit} }} }} }}")
}

/// Clauses H-5 and H-6.
pub(crate) fn of_channels(_: &str) {
    interpolator(4, 9);
    correction(
        [[4, 9], [5, 9]],
        &reciprocal("operand = 10, index = 4, entry = 7, refine = { newton = { bits = [12] } }"),
        "-set METHOD 1 -set P 10 -set K 4 -set M 7 -set REFINE 2 -set N1 12",
        0.8..1.1,
    );
    // The divider of set-up: the widest quotient is that of 1/w.
    let (profile, cost) = channel([4, 9], [8, 14], QUOTIENT);
    let divisor = 2 * profile.vertex.difference_bits() + 1;
    let (gates, flip_flops) = gates(
        "setup_divider",
        &[],
        &format!("-set NW {} -set DW {divisor} -set SERIAL 1 -set ROUNDING 4", 1 + 8 + 14),
    );
    near("setup_divider", gates + flip_flops * REGISTER, cost.set_up.area_um2, 1.7..2.6);
}

/// The same for more units and larger ones.
pub(crate) fn of_larger_channels(_: &str) {
    interpolator(8, 14);
    interpolator(16, 17);
    correction([[3, 5], [3, 4]], QUOTIENT, "-set METHOD 0", 1.9..2.8);
    correction([[4, 9], [5, 5]], QUOTIENT, "-set METHOD 0", 1.9..2.8);
    correction(
        [[4, 9], [5, 9]],
        &reciprocal("operand = 10, index = 4, entry = 7"),
        "-set METHOD 1 -set P 10 -set K 4 -set M 7 -set REFINE 0",
        1.1..1.6,
    );
    correction(
        [[8, 12], [8, 10]],
        &reciprocal("operand = 14, index = 6, entry = 9, refine = { newton = { bits = [16] } }"),
        "-set METHOD 1 -set P 14 -set K 6 -set M 9 -set REFINE 2 -set N1 16",
        0.8..1.1,
    );
    correction(
        [[8, 12], [8, 10]],
        &reciprocal("operand = 14, index = 6, entry = 12, refine = \"linear\""),
        "-set METHOD 1 -set P 14 -set K 6 -set M 12 -set REFINE 1",
        0.8..1.1,
    );
}
