//! Files that are not what the package says: the bench itself refuses them.

// Clause J-3.
use crate::set::{GHDL, ICARUS, Set, VERILATOR, build_ghdl, build_icarus, build_verilator, run};
use std::path::Path;

/// What is done to a file's text, how, and what the bench says of it.
type Spoiled = (&'static str, fn(&str) -> String, &'static str);

const SPOILED: [Spoiled; 9] = [
    ("empty", |_| String::new(), "rows"),
    ("cut after a line", |text| cut_lines(text, 5), "the package says"),
    ("cut within a line", |text| text[..text.len() - 3].to_owned(), "characters"),
    ("padded with a row", |text| format!("{text}{}\n", text.lines().last().unwrap()), "more than"),
    ("an over-wide word", over_wide, "wider than its column"),
    ("a longer word", |text| text.replacen('_', "0_", 1), "characters"),
    ("a digit too few", |text| text.replacen("_0", "_", 1), "characters"),
    ("a letter that is no digit", |text| text.replacen("_0", "_x", 1), "hexadecimal"),
    ("words of another profile", |text| text.replacen('_', "", 1), "characters"),
];

fn cut_lines(text: &str, lines: usize) -> String {
    text.split_inclusive('\n').take(lines).collect()
}

/// The first digit of the second word set to f: a 7-bit word has no such digit.
fn over_wide(text: &str) -> String {
    let at = text.find('_').unwrap() + 1;
    format!("{}f{}", &text[..at], &text[at + 1..])
}

fn each(build: fn(&Path), (program, arguments): (&str, &[&str])) {
    let set = Set::new("tiny --count 300");
    build(&set.folder);
    for name in ["dda.exp.tv", "dda.cfg.tv"] {
        let whole = set.read(name);
        for (what, spoil, says) in SPOILED {
            std::fs::write(set.folder.join(name), spoil(&whole)).unwrap();
            let (good, text) = run(&set.folder, program, arguments);
            assert!(
                !good && text.contains("FAIL") && !text.contains("PASS"),
                "{name} {what}: {text}"
            );
            assert!(text.contains(name) && text.contains(says), "{name} {what}: {text}");
        }
        std::fs::write(set.folder.join(name), whole).unwrap();
    }
    std::fs::remove_file(set.folder.join("edge.cfg.tv")).unwrap();
    let (good, text) = run(&set.folder, program, arguments);
    assert!(!good && text.contains("edge.cfg.tv: cannot be opened"), "{text}");
}

pub(crate) fn icarus(_: &str) {
    each(build_icarus, ICARUS);
}

pub(crate) fn verilator(_: &str) {
    each(build_verilator, VERILATOR);
}

pub(crate) fn ghdl(_: &str) {
    each(build_ghdl, GHDL);
}
