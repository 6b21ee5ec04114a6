//! The units of channels in a simulator: they pass, and their faults are named.

// Clauses CH-15, CH-16, CH-17, CH-18 and CH-19.
use crate::foreign::{bench, build};
use crate::run::run_in;
use crate::set::build_icarus;
use std::path::Path;

/// Channels: those of `examples/textured.toml`, and every other kind of unit.
pub(crate) const CHANNELS: [&str; 2] =
    [include_str!("../../examples/textured.toml"), include_str!("channel_units.toml")];

/// Writes the profile `tiny` with these channels.
pub(crate) fn profile(home: &Path, name: &str, channels: &str) {
    let tiny = guardbit::profile::load("tiny").unwrap().to_toml();
    let at = channels.find("[w]").expect("words of 1/w");
    std::fs::write(home.join(format!("{name}.toml")), tiny + "\n" + &channels[at..]).unwrap();
}

/// Every kind of unit passes.
pub(crate) fn pass(_: &str) {
    let home = tempfile::tempdir().unwrap();
    for (name, channels) in ["textured", "every"].into_iter().zip(CHANNELS) {
        profile(home.path(), name, channels);
        run_in(home.path(), &format!("vectors {name}.toml --count 600 --out {name}")).ends(0);
        let folder = home.path().join(name);
        build_icarus(&folder);
        let (good, text) = bench(&folder, &[]);
        assert!(good && text.trim_end().ends_with("not checked: channel"), "{text}");
        let units = text.matches(" interpolator-").count()
            + text.matches(" reciprocal-").count()
            + text.matches(" divider-").count();
        assert_eq!(units, if name == "textured" { 6 } else { 13 }, "{text}");
    }
}

/// The typical faults, each by its name: module, what is changed, by what, and the cause.
const FAULTS: [(&str, &str, &str, &str); 8] = [
    (
        "reciprocal_unit",
        ".index(index), .entry",
        ".index(index + 1'b1), .entry",
        "the entry that is read is one too large",
    ),
    (
        "reciprocal_unit",
        "REFINE == ONE_STEP ? N'(y1)",
        "REFINE == ONE_STEP ? {entry, {(N-M){1'b0}}}",
        "what that step began with, moved to its place, where the result of the last Newton step belongs",
    ),
    (
        "reciprocal_unit",
        "(L'(W) - length)",
        "(L'(W) - length - 1'b1)",
        "the distance of the normalisation is one too small",
    ),
    ("interpolator", "op == STEP_X ? dx", "op == STEP_X ? -dx", "minus dx where dx belongs"),
    (
        "perspective_divider",
        ": METHOD != 0 ? V'($signed(rounded)) :",
        ": METHOD != 0 ? V'(o_p >> F) :",
        "P alone, not corrected for perspective",
    ),
    (
        "rounded_shift",
        "up = over || (tie && is_odd);",
        "up = inexact && negative;",
        "the product is rounded by floor",
    ),
    (
        "perspective_divider",
        "above ? HIGH[I-1:0] : below",
        "below",
        "the code is held from above: never true",
    ),
    (
        "held_value",
        "assign held = clamped",
        "assign held = moved[I-1:0]",
        "clamp and w.clamp are wrap",
    ),
];

/// The devices with one place of a module changed.
fn changed(devices: &str, (module, old, new): (&str, &str, &str)) -> String {
    let begin = devices.find(&format!("\nmodule {module} ")).expect("the module is there");
    let end = begin + devices[begin..].find("\nendmodule").unwrap();
    assert_eq!(devices[begin..end].matches(old).count(), 1, "{module}: {old}");
    let module = devices[begin..end].replace(old, new);
    format!("{}{module}{}", &devices[..begin], &devices[end..])
}

pub(crate) fn faults(_: &str) {
    let home = tempfile::tempdir().unwrap();
    profile(home.path(), "textured", CHANNELS[0]);
    run_in(home.path(), "vectors textured.toml --count 500 --out set").ends(0);
    let set = home.path().join("set");
    let devices = std::fs::read_to_string(set.join("dut.sv")).unwrap();
    for (module, old, new, cause) in FAULTS {
        std::fs::write(set.join("own.sv"), changed(&devices, (module, old, new))).unwrap();
        build(&set, &[], &["own.sv"]);
        assert!(!bench(&set, &["+dump"]).0, "{new}");
        let dumps = home.path().join("dumps");
        std::fs::create_dir_all(&dumps).unwrap();
        for entry in std::fs::read_dir(&set).unwrap().flatten() {
            let name = entry.file_name().into_string().unwrap();
            if name.ends_with(".exp.dut.tv") {
                std::fs::rename(entry.path(), dumps.join(name)).unwrap();
            }
        }
        let ran = run_in(home.path(), "verify set --dut dumps");
        assert!(likely(&ran.out, cause), "{cause}: {}", ran.out);
    }
}

/// Whether a likely cause has these words in it.
fn likely(report: &str, cause: &str) -> bool {
    report.lines().any(|line| line.contains("likely cause: ") && line.contains(cause))
}
