//! Exported references, compiled and run by others: they answer as the model does.

// Clause J-8.
use crate::run::run_in;
use guardbit::bits::Rounding;
use guardbit::profile::{self, Profile};
use guardbit::vector::reference::digests;
use std::path::Path;
use std::process::Command;

/// Profiles of edge functions and depth, one sample a pixel.
const PLAIN: [&str; 5] = ["sgi-4k", "d3d11", "tiny", "vulkan-8bit", "vulkan-4bit"];

const BUILT_IN: [&str; 9] = [
    "sgi-4k",
    "d3d11",
    "tiny",
    "vulkan-8bit",
    "vulkan-4bit",
    "vulkan-8bit-4x",
    "vulkan-4bit-4x",
    "larrabee",
    "sgi-4k-walk",
];

/// Those of the engine `anchored`.
const ANCHORED: [&str; 2] = ["ps1", "ps1-rtl"];

/// Those that begin at registers: in C, C++ and Python.
const REGISTERS: [&str; 8] =
    ["ps1", "ps1-rtl", "vortex", "psp", "voodoo", "virge", "n64", "n64-rtl"];

/// Sets a key of a profile, where it first occurs behind the line `table`.
fn set_in(text: &mut String, table: &str, key: &str, value: &str) {
    let table = text.find(table).unwrap();
    let from = table + text[table..].find(&format!("\n{key} = ")).unwrap() + 1;
    let end = from + text[from..].find('\n').unwrap();
    text.replace_range(from..end, &format!("{key} = {value}"));
}

/// Writes a profile of one's own and reads it.
fn own(home: &Path, name: &str, mut text: String) -> (String, Profile) {
    set_in(&mut text, "", "name", &format!("\"{name}\""));
    let path = home.join(format!("{name}.toml"));
    std::fs::write(&path, &text).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (path.clone(), profile::load(&path).unwrap())
}

/// Machines with words too narrow for their window, with depth or without, at several samples in a pixel.
fn shapes(home: &Path) -> Vec<(String, Profile)> {
    let text = |name: &str| profile::load(name).unwrap().to_toml();
    let tiny = text("tiny");
    let depth = tiny[tiny.find("[depth]").unwrap()..].to_owned();
    // `[depth]` is the last table but for `[multisample]`.
    let without_depth = |text: &str| {
        let at = text.find("[depth]").unwrap();
        let rest = text[at..].find("\n[multisample]").map_or("", |end| &text[at + end..]);
        format!("{}{rest}", &text[..at])
    };
    let changed = |text: &str, changes: &[(&str, &str, &str)]| {
        let mut text = text.to_owned();
        for (table, key, value) in changes {
            set_in(&mut text, table, key, value);
        }
        text
    };
    let small =
        [("[window]", "width", "32"), ("[window]", "height", "16"), ("[vertex]", "integer", "6")];
    let tiles = changed(&text("larrabee"), &small);
    let tiles_and_depth = changed(
        &format!("{tiles}\n{depth}"),
        &[
            ("[vertex]", "sub-pixel", "5"),
            ("[form.tiles]", "tile", "4"),
            ("[form.tiles.edge]", "rule", "\"shadow\""),
            ("[form.tiles.edge]", "storage", "\"full\""),
            ("[form.tiles.edge]", "width", "12"),
            ("[depth]", "clamp", "\"sign\""),
        ],
    );
    let narrow_tiles = changed(
        &tiles,
        &[
            ("[vertex]", "sub-pixel", "3"),
            ("[form.tiles]", "tile", "2"),
            ("[form.tiles.edge]", "width", "8"),
        ],
    );
    let walk = text("sgi-4k-walk");
    let narrow_walk = changed(
        &walk,
        &[
            ("[window]", "width", "64"),
            ("[form.edge-walk]", "guard", "2"),
            ("[form.edge-walk]", "integer", "3"),
            ("[form.edge-walk]", "fraction", "4"),
            ("[form.edge-walk]", "rounding", "\"away-from-zero\""),
            ("[depth]", "clamp", "\"wrap\""),
        ],
    );
    let flat_walk = changed(
        &without_depth(&walk),
        &[("[form.edge-walk]", "guard", "0"), ("[form.edge-walk]", "rounding", "\"floor\"")],
    );
    let several = text("vulkan-4bit-4x");
    let centre = changed(&several, &[("[multisample]", "depth", "\"centre\"")]);
    let sixteen = changed(&without_depth(&several), &[("[multisample]", "samples", "16")]);
    let eight = format!("{tiles}\n{depth}\n[multisample]\nsamples = 8\ndepth = \"centre\"\n");
    [
        ("own-flat", without_depth(&tiny)),
        ("own-tiles", tiles_and_depth),
        ("own-narrow-tiles", narrow_tiles),
        ("own-narrow-walk", narrow_walk),
        ("own-flat-walk", flat_walk),
        ("own-centre", centre),
        ("own-sixteen", sixteen),
        ("own-eight-tiles", eight),
    ]
    .into_iter()
    .map(|(name, text)| own(home, name, text))
    .collect()
}

/// Machines that begin at registers, and others of the same engine: roundings, each clamp, an unsigned field.
fn registers(home: &Path) -> Vec<(String, Profile)> {
    let mut list: Vec<_> =
        REGISTERS.map(|name| (name.to_owned(), profile::load(name).unwrap())).into();
    for (n, rounding) in Rounding::ALL.into_iter().step_by(2).enumerate() {
        let mut text = profile::load(ANCHORED[n % 2]).unwrap().to_toml();
        let mut set = |key: &str, value: &str| set_in(&mut text, "", key, value);
        set("rounding", &format!("\"{rounding}\""));
        set("clamp", ["\"guard\"", "\"wrap\"", "\"sign\""][n % 3]);
        set("guard", ["2", "1", "3"][n / 2 % 3]);
        set("halves", ["\"from-anchor\"", "\"upper-first\""][n / 2 % 2]);
        if n % 4 == 3 {
            set("signed", "false");
        }
        list.push(own(home, &format!("own-registers-{n}"), text));
    }
    list.extend(quads(home));
    list.extend(slopes(home));
    list
}

/// A built-in profile as it was written, where the engine is one table, with keys set.
fn changed(home: &Path, name: &str, changes: &[(&str, &str, &str)]) -> String {
    let mut text = run_in(home, &format!("profile show {name}")).ends(0).out;
    for (table, key, value) in changes {
        set_in(&mut text, table, key, value);
    }
    text
}

/// The engine `slopes` with what neither built-in profile has: given edges and channels at a vertex, divided ones and
/// channels at the long side, without a bias or half a pixel, one clamp for all channels.
fn slopes(home: &Path) -> Vec<(String, Profile)> {
    const ENGINE: &str = "[form.registers.engine.slopes]";
    let given = [
        (ENGINE, "edges", "{ given = { fraction = 12, rows = \"down\" } }"),
        (ENGINE, "plane", "{ at-vertex = {} }"),
        (ENGINE, "pixel-bias", "0"),
        (ENGINE, "clip", "\"half-open\""),
    ];
    let given = changed(home, "virge", &given).replace("\"clip\",", "\"adjust\",");
    let divided = [
        (ENGINE, "edges", "{ divided = { fraction = 13, row-bias = 16 } }"),
        (ENGINE, "plane", "{ at-edge = { fraction = 3 } }"),
        (ENGINE, "pixel-bias", "0xfff"),
        (ENGINE, "clip", "\"closed\""),
    ];
    let divided = changed(home, "voodoo", &divided)
        .replace("\"adjust\"", "\"-adjust\"")
        .replace("\"sign\"", "\"guard\"")
        .replace("\"wrap\"", "\"guard\"")
        .replace("guard = 0, integer = 64", "guard = 1, integer = 63")
        .replace("shift = 14", "drop = 3, shift = 7")
        .replace("\"leftward:", "\"rightward:");
    [("own-given-slopes", given), ("own-divided-slopes", divided)]
        .into_iter()
        .map(|(name, text)| own(home, name, text))
        .collect()
}

/// The engine `quads` with narrow words, and what neither built-in profile has: vertices with a sign, of which it
/// makes quads, with a descent or without.
fn quads(home: &Path) -> Vec<(String, Profile)> {
    const ENGINE: &str = "[form.registers.engine.quads]";
    let changed = |name: &str, changes: &[(&str, &str, &str)]| changed(home, name, changes);
    let place = |edge: usize| (0..4).map(move |place| format!("\"e{edge}_{place}\""));
    let values = (0..3).flat_map(place).collect::<Vec<_>>().join(", ");
    let records =
        format!("[{{ letter = \"Q\", words = [\"x:16 y:16@16\", \"mask:4\", {values}] }}]");
    let records = ("[form.registers]", "records", &*records);
    let narrow = changed(
        "vortex",
        &[
            (ENGINE, "edges", "{ given = { fraction = 8 } }"),
            (ENGINE, "width", "20"),
            (ENGINE, "descent", "{ tile = 32, block = 2 }"),
        ],
    );
    let both = changed(
        "psp",
        &[("[vertex]", "signed", "true"), (ENGINE, "width", "17"), (ENGINE, "rule", "\"both\"")],
    );
    let masks = changed("psp", &[(ENGINE, "emit", "\"quads\""), records]);
    let of_tiles = "\"quads\"\ndescent = { tile = 16, block = 4 }";
    let tiles = changed("psp", &[(ENGINE, "width", "26"), (ENGINE, "emit", of_tiles), records]);
    let of_tiles = "\"pixels\"\ndescent = { tile = 8, block = 2 }";
    let pixels = changed("psp", &[(ENGINE, "emit", of_tiles)]);
    [
        ("own-narrow-quads", narrow),
        ("own-both-quads", both),
        ("own-masks", masks),
        ("own-mask-tiles", tiles),
        ("own-pixel-tiles", pixels),
    ]
    .into_iter()
    .map(|(name, text)| own(home, name, text))
    .collect()
}

/// Profiles that differ in everything that a reference folds in: the built-in ones, one for each rounding, and
/// the other shapes.
fn profiles(home: &Path) -> Vec<(String, Profile)> {
    let mut list: Vec<_> =
        BUILT_IN.map(|name| (name.to_owned(), profile::load(name).unwrap())).into();
    list.extend(shapes(home));
    for (n, rounding) in Rounding::ALL.into_iter().enumerate() {
        let mut text = profile::load(if n % 2 == 0 { "tiny" } else { "sgi-4k" }).unwrap().to_toml();
        let mut set = |key: &str, value: &str| set_in(&mut text, "", key, value);
        set("rounding", &format!("\"{rounding}\""));
        set("clamp", ["\"guard\"", "\"wrap\"", "\"sign\""][n % 3]);
        set("guard", ["1", "2", "3", "4"][n % 4]);
        set("rule", ["\"shadow\"", "\"top-left\""][n / 2 % 2]);
        if n % 5 < 2 {
            // One sub-pixel bit or ten are no longer dropped.
            set("storage", "\"full\"");
            set("width", if n % 2 == 0 { "7" } else { "45" });
        }
        set("start-bias", ["\"none\"", "\"half\""][n / 3 % 2]);
        list.push(own(home, &format!("own-{n}"), text));
    }
    list
}

/// Writes the reference of a profile in a language.
fn export(home: &Path, profile: &str, language: &str, file: &str) {
    let ran = run_in(home, &format!("export {profile} --as {language}")).ends(0);
    assert!(ran.out.lines().count() < 700 && !ran.out.contains("@P@"), "{}", ran.out);
    std::fs::write(home.join(file), ran.out).unwrap();
}

/// Runs a program in a folder; what it prints.
fn run(home: &Path, line: &str) -> String {
    let mut words = line.split_whitespace();
    let output =
        Command::new(words.next().unwrap()).args(words).current_dir(home).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success() && err.is_empty(), "{line}\n{out}{err}");
    out
}

/// The digests of a profile as the references print them.
fn model(profile: &Profile, seed: u64, cases: u64) -> String {
    let lines = digests(profile, seed, cases).unwrap();
    lines.iter().map(|digest| format!("{digest:016x}\n")).collect::<Vec<_>>().concat()
}

/// Which profiles are tried.
#[derive(Clone, Copy)]
enum Scope {
    All,
    BuiltIn,
}

fn is_built_in(path: &str) -> bool {
    BUILT_IN.contains(&path) || REGISTERS.contains(&path)
}

/// The self test of each profile's reference, and other cases of the built-in ones; `build` makes a program of
/// a reference and says how it is run, and how with a seed and a number of cases.
fn agree((language, scope): (&str, Scope), cases: u64, build: impl Fn(&Path, &str) -> [String; 2]) {
    let home = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    let mut profiles = profiles(home.path());
    if language != "sv" {
        profiles.extend(registers(home.path()));
    }
    // C++ has the text of C but for its scopes: roundings and clamps are tried in C, and more shapes in the soak tier.
    if matches!(scope, Scope::BuiltIn) {
        let is_rounding =
            |name: &str| name.strip_prefix("own-").is_some_and(|n| n.parse::<u32>().is_ok());
        profiles.retain(|(path, profile)| {
            is_built_in(path) || (language == "c" && is_rounding(&profile.name))
        });
    }
    for (path, profile) in profiles {
        let is_plain = PLAIN.contains(&path.as_str());
        // A simulator of four values takes long for many samples.
        let many = profile.multisample.is_some_and(|samples| samples.samples > 4);
        if language == "sv" && many {
            continue;
        }
        let id = profile.name.replace('-', "_");
        let file = format!("{id}.{language}");
        export(home.path(), &path, language, &file);
        let [plain, other] = build(home.path(), &id);
        let said = run(home.path(), &plain);
        if said != format!("{}: PASS, 1000 cases\n", profile.name) {
            wrong.push(said);
        }
        if is_built_in(&path) && (is_plain || language != "sv") {
            // The model takes its time for what is not one sample of edge functions; several samples in a pixel
            // are as many triangles.
            let cases = if is_plain { cases } else { cases.min(30_000) };
            let cases = if profile.multisample.is_some() { cases / 4 } else { cases };
            // Python takes its time for thousands of records.
            let slow = language == "python" && REGISTERS.contains(&path.as_str());
            let cases = if slow { cases / 5 } else { cases };
            let other = other.replace("SEED", "77").replace("CASES", &cases.to_string());
            assert_eq!(run(home.path(), &other), model(&profile, 77, cases), "{id}");
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

const CHECKS: &str = "-O2 -Wall -Wextra -Wconversion -Wpedantic -Werror -fsanitize=undefined -fno-sanitize-recover=all";

/// The references in C or C++, compiled for a standard.
fn compiled(compiler: &str, scope: Scope, [language, standard]: [&str; 2], cases: u64) {
    let of_file = if language == "cpp" { "c++" } else { "c" };
    agree((language, scope), cases, |home, id| {
        let main = id.to_uppercase();
        let build = format!(
            "{compiler} -std={standard} {CHECKS} -D{main}_MAIN -o {id}.run -x {of_file} {id}.{language}"
        );
        let _ = run(home, &build);
        let program = format!("{}/{id}.run", home.display());
        [program.clone(), format!("{program} SEED CASES")]
    });
}

pub(crate) fn c_agrees(compiler: &str) {
    compiled(compiler, Scope::BuiltIn, ["c", "c99"], 8_000);
}

pub(crate) fn c_agrees_on_a_million(compiler: &str) {
    compiled(compiler, Scope::All, ["c", "c99"], 1_000_000);
}

pub(crate) fn cpp_agrees(compiler: &str) {
    compiled(compiler, Scope::BuiltIn, ["cpp", "c++17"], 4_000);
}

pub(crate) fn python_agrees(python: &str) {
    agree(("python", Scope::All), 2000, |_, id| {
        [format!("{python} {id}.python"), format!("{python} {id}.python SEED CASES")]
    });
}

pub(crate) fn systemverilog_agrees(iverilog: &str) {
    agree(("sv", Scope::All), 2000, |home, id| {
        let top = format!("{id}_reference_self_test");
        let _ = run(
            home,
            &format!("{iverilog} -g2012 -Wall -Wno-timescale -s {top} -o {id}.vvp {id}.sv"),
        );
        [format!("vvp -n {id}.vvp"), format!("vvp -n {id}.vvp +seed=SEED +cases=CASES")]
    });
}

pub(crate) fn verilator_finds_nothing(verilator: &str) {
    let home = tempfile::tempdir().unwrap();
    for (path, profile) in profiles(home.path()) {
        let id = profile.name.replace('-', "_");
        export(home.path(), &path, "sv", "reference.sv");
        let top = format!("{id}_reference_self_test");
        let _ = run(
            home.path(),
            &format!("{verilator} --lint-only -Wall --timing --top-module {top} reference.sv"),
        );
    }
}

pub(crate) fn yosys_reads_the_modules(yosys: &str) {
    let home = tempfile::tempdir().unwrap();
    for name in BUILT_IN {
        export(home.path(), name, "sv", "reference.sv");
        let id = name.replace('-', "_");
        let text = std::fs::read_to_string(home.path().join("reference.sv")).unwrap();
        let head = format!("\nmodule {id}_reference_");
        let modules = text.split(&head).skip(1).map(|rest| rest.split(' ').next().unwrap());
        let modules: Vec<_> = modules.filter(|module| *module != "self_test").collect();
        assert!(modules.len() >= 4, "{name}: {modules:?}");
        for module in modules {
            let script = format!(
                "read_verilog -sv reference.sv\nhierarchy -check -top {id}_reference_{module}\nproc\ncheck -assert\n"
            );
            std::fs::write(home.path().join("read.ys"), script).unwrap();
            let _ = run(home.path(), &format!("{yosys} -q read.ys"));
        }
    }
}
