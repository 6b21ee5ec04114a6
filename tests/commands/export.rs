//! `export`: which profiles have a reference, and why the others have none.

#![cfg(feature = "cli")]

use crate::run::run_in;
use guardbit::profile::BUILTIN;
use std::path::Path;

/// What is said of a profile that has a reference, but none in SystemVerilog.
const NO_SYSTEMVERILOG: [(&str, &str, &str); 8] = [
    ("ps1", "anchored", "anchored_engine.sv"),
    ("ps1-rtl", "anchored", "anchored_engine.sv"),
    ("vortex", "quads", " quad_engine.sv"),
    ("psp", "quads", "vertex_quad_engine.sv"),
    ("voodoo", "slopes", "divided_slope_engine.sv"),
    ("virge", "slopes", "given_slope_engine.sv"),
    ("n64", "sub-scanlines", "sub_scanline_engine.sv"),
    ("n64-rtl", "sub-scanlines", "sub_scanline_engine.sv"),
];

/// Profiles without a reference, and their engines.
const NO_REFERENCE: [(&str, &str); 6] = [
    ("projf-line", "lines"),
    ("projf-fill", "lines"),
    ("saturn-line", "lines"),
    ("saturn-quad", "lines"),
    ("ps1-line", "lines"),
    ("gplgpu", "slopes"),
];

// Clause J-8
#[test]
fn a_profile_is_exported_or_refused_by_name() {
    for (name, _) in BUILTIN {
        for language in ["sv", "c", "cpp", "python"] {
            let export = || run_in(Path::new("."), &format!("export {name} --as {language}"));
            let without = match name {
                "gamecube" => Some("samples lie between the sub-pixels"),
                name if name.starts_with("d3d12-") => Some("coverage is conservative"),
                _ => None,
            };
            if let Some(reason) = without {
                let ran = export().complains(2, &[name, "no reference", reason]);
                assert!(ran.out.is_empty(), "{name}");
            } else if ["rasterix", "picogs", "graphite"].contains(&name) {
                let ran =
                    export().complains(2, &[name, "no reference", "the machine is edge-functions"]);
                assert!(ran.out.is_empty(), "{name}");
            } else if let Some((_, machine)) = NO_REFERENCE.iter().find(|(named, _)| *named == name)
            {
                let reason = format!("the machine is {machine}");
                let ran = export().complains(2, &[name, "no reference", &reason]);
                assert!(ran.out.is_empty(), "{name}");
            } else if let Some((_, machine, device)) =
                NO_SYSTEMVERILOG.iter().find(|(named, ..)| language == "sv" && *named == name)
            {
                let reason = format!("the machine is {machine}");
                let ran = export().complains(2, &[name, "no reference", &reason, device, "hdl"]);
                assert!(ran.out.is_empty(), "{name}");
            } else {
                let text = export().ends(0).out;
                assert_eq!(text, export().ends(0).out, "{name} {language}");
                let head: String = text.lines().take(12).collect();
                assert!(head.contains(name) && head.contains("SHA-256"), "{head}");
            }
        }
    }
}

#[test]
fn an_export_refuses_nonsense() {
    let home = tempfile::tempdir().unwrap();
    let export = |line: &str| run_in(home.path(), &format!("export {line}"));
    export("tiny --as vhdl").complains(2, &["vhdl", "sv, c, cpp, python"]);
    export("tiny").complains(2, &["--as"]);
    export("none --as c").complains(2, &["no profile \"none\""]);
    std::fs::write(home.path().join("cut.toml"), "schema = 1\nname = \"cut\"\n").unwrap();
    export("cut.toml --as sv").complains(2, &["cut.toml", "missing field"]);
    let tiny = run_in(home.path(), "profile show tiny").ends(0).out;
    let other = tiny.replace("[depth]", "[depth]\ndivision = \"reciprocal\"");
    std::fs::write(home.path().join("reciprocal.toml"), other).unwrap();
    export("reciprocal.toml --as c").complains(2, &["reciprocal"]);
    for clamp in ["saturate", "error"] {
        let other = tiny.replace("clamp = \"guard\"", &format!("clamp = \"{clamp}\""));
        std::fs::write(home.path().join("clamp.toml"), other).unwrap();
        export("clamp.toml --as sv").complains(2, &["no reference", &format!("clamp is {clamp}")]);
    }
    let walk = run_in(home.path(), "profile show sgi-4k-walk").ends(0).out;
    let several = format!("{walk}\n[multisample]\nsamples = 4\ndepth = \"sample\"\n");
    std::fs::write(home.path().join("several.toml"), several).unwrap();
    export("several.toml --as c").complains(2, &["it walks edges for several samples in a pixel"]);
}

/// Each machine that takes triangles has a reference, or is named where it has none.
#[test]
fn every_machine_of_triangles_is_exported_or_named() {
    let home = tempfile::tempdir().unwrap();
    let base = guardbit::profile::load("sgi-4k").unwrap();
    let mut exported = Vec::new();
    for kind in guardbit::profile::triangle_machines() {
        let profile = base.with_machine(kind.name).unwrap();
        std::fs::write(home.path().join("own.toml"), profile.to_toml()).unwrap();
        let export = run_in(home.path(), "export own.toml --as python");
        if export.status == Some(0) {
            exported.push(kind.name);
        } else {
            export.complains(2, &[&format!("the machine is {}", kind.name)]);
        }
    }
    assert_eq!(exported, ["edge-function", "edge-walk", "tiles"]);
}
