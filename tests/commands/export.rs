//! `export`: which profiles have a reference, and why the others have none.

#![cfg(feature = "cli")]

use crate::run::run_in;
use guardbit::profile::BUILTIN;
use std::path::Path;

/// What is said of a built-in profile that has no reference.
const REFUSED: [(&str, &str); 12] = [
    ("sgi-4k-walk", "the machine is edge-walk"),
    ("larrabee", "the machine is tiles"),
    ("vulkan-8bit-4x", "no device takes several samples in a pixel, as [multisample] asks"),
    ("vulkan-4bit-4x", "no device takes several samples in a pixel, as [multisample] asks"),
    ("ps1", "the machine is anchored"),
    ("ps1-rtl", "the machine is anchored"),
    ("vortex", "the machine is quads"),
    ("psp", "the machine is quads"),
    ("voodoo", "the machine is slopes"),
    ("virge", "the machine is slopes"),
    ("n64", "the machine is sub-scanlines"),
    ("n64-rtl", "the machine is sub-scanlines"),
];

// Clause J-8
#[test]
fn a_profile_is_exported_or_refused_by_name() {
    for (name, _) in BUILTIN {
        for language in ["sv", "c", "cpp", "python"] {
            let export = || run_in(Path::new("."), &format!("export {name} --as {language}"));
            if let Some((_, reason)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
                let ran = export().complains(2, &[name, "no reference", reason]);
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
    let (flat, _) = tiny.split_once("[depth]").unwrap();
    std::fs::write(home.path().join("flat.toml"), flat).unwrap();
    export("flat.toml --as c").complains(2, &["the devices draw depth, and the profile has none"]);
    let other = tiny.replace("[depth]", "[depth]\ndivision = \"reciprocal\"");
    std::fs::write(home.path().join("reciprocal.toml"), other).unwrap();
    export("reciprocal.toml --as c").complains(2, &["reciprocal"]);
}
