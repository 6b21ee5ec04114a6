//! The list of machines against everything that is made of it, a machine that is not built in, and the
//! examples, each run.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use guardbit::cover::Bitmask;
use guardbit::explore::field::{Field, FieldError, Takes, Value};
use guardbit::machine::{AddError, DrawError, Intake, Kind, Own, ScanlineConfig, add, kinds};
use guardbit::measure::cost::estimate;
use guardbit::model::{Drawing, Model, View};
use guardbit::profile::{BUILTIN, InvalidProfile, load, parse, triangle_machines};
use guardbit::scene::Triangle;
use guardbit::setup::Polygon;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// Clause A-2: the table of the specification and that of the README are the list.
#[test]
fn the_tables_of_machines_are_the_list() {
    let list: Vec<(&str, &str)> =
        triangle_machines().map(|kind| (kind.name, kind.known_as)).collect();
    assert!(list.len() >= 8, "{list:?}");
    let spec = text("spec/19-machines.md");
    let table = spec.split("| `form` |").nth(1).unwrap();
    let rows: Vec<(&str, &str)> = table
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            (cells[1].trim_matches('`'), cells[2])
        })
        .collect();
    assert_eq!(rows, list, "spec/19-machines.md, A-2");
    let readme = text("README.md");
    let table = readme.split("machine          known as").nth(1).unwrap();
    let rows: Vec<&str> = table.lines().skip(1).take_while(|line| line.trim() != "...").collect();
    assert_eq!(rows.len(), list.len(), "README.md, the output of compare");
    for (row, (name, known_as)) in rows.iter().zip(list) {
        assert!(row.starts_with(name) && row[name.len()..].trim().starts_with(known_as), "{row}");
    }
}

/// Every machine and every decision names a clause that exists.
#[test]
fn clauses_of_machines_and_decisions_exist() {
    let mut spec = String::new();
    for entry in std::fs::read_dir(root().join("spec")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "md") {
            spec += &std::fs::read_to_string(path).unwrap();
        }
    }
    let machines = kinds().map(|kind| (kind.name, kind.clause));
    let fields = Field::all().iter().map(|field| (field.name(), field.clause()));
    let all: Vec<(&str, &str)> = machines.chain(fields).collect();
    assert!(all.len() >= 9 + 19, "{all:?}");
    for (name, clause) in all {
        assert!(spec.contains(&format!("\n### {clause} ")), "{name}: no clause {clause}");
    }
}

/// Clause Q-1: the order that reports list fields in.
#[test]
fn fields_are_listed_by_level_and_owner() {
    let names: Vec<&str> = Field::all().iter().map(|field| field.name()).collect();
    let expected = "sub-pixel vertex-integer snap integer form traversal stamp edge-width walk-fraction \
                    walk-integer walk-guard walk-rounding walk-clamp interpolation guard rounding clamp \
                    reciprocal start-bias depth-format bias-constant bias-slope";
    assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
    let spec = text("spec/13-search.md");
    let clause = spec.split("### Q-1").nth(1).unwrap().split("\n###").next().unwrap();
    for name in names {
        assert!(clause.contains(&format!("`{name}`")), "{name} is not in Q-1");
    }
}

/// A number outside the range that a field states is refused by every machine that has it, and words and
/// numbers that were read are what is set again.
#[test]
fn ranges_of_fields_are_those_that_profiles_allow() {
    let mut outside = 0;
    for kind in triangle_machines() {
        let profile = load("sgi-4k").unwrap().with_machine(kind.name).unwrap();
        for field in Field::all() {
            let Some(own) = field.read(&profile) else {
                let value = field.words().first().map_or(Value::Bits(3), |word| Value::Name(word));
                let refused = field.write(&mut profile.clone(), &value);
                assert_eq!(refused, Err(FieldError::Absent(field.name())), "{}", kind.name);
                continue;
            };
            let mut same = profile.clone();
            field.write(&mut same, &own).unwrap();
            assert_eq!(same, profile, "{} {}", kind.name, field.name());
            let Takes::Bits { least, most, .. } = field.takes() else { continue };
            for bits in [least.checked_sub(1), Some(most + 1)].into_iter().flatten() {
                let mut changed = profile.clone();
                field.write(&mut changed, &Value::Bits(bits)).unwrap();
                assert!(changed.validate().is_err(), "{} {} = {bits}", kind.name, field.name());
                outside += 1;
            }
        }
    }
    assert!(outside > 60, "{outside}");
}

/// The fault of a machine is shown in its own table.
#[test]
fn a_fault_is_shown_in_the_table_of_its_machine() {
    for (machine, from, to, field) in [
        ("engine-per-pixel", "width = 35", "width = 1", "form.engine-per-pixel.width"),
        ("edge-function", "width = 35", "width = 121", "form.edge-function.width"),
        ("tiles", "width = 35", "width = 1", "form.tiles.edge.width"),
        ("tiles", "tile = 16", "tile = 12", "form.tiles.tile"),
        (
            "barycentric",
            "walk-fraction = 12",
            "walk-fraction = 41",
            "form.barycentric.walk-fraction",
        ),
        ("gouraud", "fraction = 22", "fraction = 119", "form.gouraud"),
        ("homogeneous", "w = 12", "w = 0", "form.homogeneous.w"),
    ] {
        let good = load("sgi-4k").unwrap().with_machine(machine).unwrap().to_toml();
        let bad = good.replacen(from, to, 1);
        assert!(good != bad, "{machine}: {good}");
        let error = parse(&bad, "own.toml").unwrap_err().to_string();
        assert!(error.contains(&format!(": {field}: ")), "{machine}: {error}");
        let line = 1 + bad.lines().position(|line| line.starts_with(to)).unwrap();
        // Where a whole table is at fault its line is named.
        let table = 1 + bad.lines().position(|line| line.starts_with("[form")).unwrap();
        let place = if field.ends_with(machine) { table } else { line };
        assert!(error.starts_with(&format!("own.toml:{place}: ")), "{place}: {error}");
    }
}

#[test]
fn an_unknown_machine_is_refused_with_the_list() {
    let bad = load("sgi-4k").unwrap().to_toml().replace("form.edge-function", "form.quads");
    let error = parse(&bad, "own.toml").unwrap_err().to_string();
    let line = 1 + bad.lines().position(|line| line.contains("[form.quads]")).unwrap();
    assert!(error.starts_with(&format!("own.toml:{line}: form.quads: ")), "{error}");
    for kind in kinds() {
        assert!(error.contains(&format!("`{}`", kind.name)), "{error}");
    }
}

/// A machine that is described by its registers is not charged as any other.
#[test]
fn registers_state_no_cost_and_no_exact_coverage() {
    let view = View { window: Some((64, 64)), ..View::default() };
    let (mut seen, mut differs) = (0, 0);
    for (name, _) in BUILTIN {
        let profile = load(name).unwrap();
        if profile.form.kind().intake != Intake::Registers {
            continue;
        }
        seen += 1;
        assert_eq!(estimate(&profile), Err(InvalidProfile::NoCost("registers")), "{name}");
        assert!(!profile.covers_exactly(), "{name}");
        // What is covered is what is drawn, and not the exact picture of the triangle.
        let model = Model::with_view(&profile, view).unwrap();
        let exact = Model::with_view(&profile.with_machine("scanline").unwrap(), view).unwrap();
        for index in 0..20 {
            let mut words = guardbit::case::Words::new(5, 0, index);
            let xy: [[i128; 2]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| words.between(0, 63 * 16)));
            let real = |value: i128| f64::from(i32::try_from(value).unwrap()) / 16.0;
            let triangle = Triangle::Real { xy: xy.map(|at| at.map(real)), z: None };
            let triangle = model.snap(&triangle).unwrap();
            let [mut covered, mut drawn, mut truth] = [(); 3].map(|()| Bitmask::new(model.clip()));
            model.cover(&triangle, &mut covered).unwrap();
            model.draw(&triangle, &mut drawn).unwrap();
            exact.draw(&triangle, &mut truth).unwrap();
            assert_eq!(covered, drawn, "{name}: {triangle:?}");
            differs += u32::from(drawn != truth);
        }
    }
    assert!(seen == 17 && differs > 20, "{seen} {differs}");
}

/// The error says which machine, what it does not do, and what to do instead.
#[test]
fn depth_of_polygons_is_refused_with_the_way_out() {
    let xy = vec![[0, 0], [9000, 0], [9000, 9000], [0, 9000]];
    let polygon = Polygon { xy, z: Some(vec![1, 2, 3, 400]) };
    let draw = |machine: &str, polygon: &Polygon| {
        let profile = load("sgi-4k").unwrap().with_machine(machine).unwrap();
        let model = Model::new(&profile).unwrap();
        model.draw(&model.place(polygon.clone()).unwrap(), &mut Drawing::default())
    };
    let error = draw("scanline", &polygon).unwrap_err();
    assert_eq!(error, DrawError::PolygonDepth { machine: "scanline" });
    let said = error.to_string();
    for part in ["the machine scanline", "only the coverage of polygons", "leave z out", "gouraud"]
    {
        assert!(said.contains(part), "{said}");
    }
    // Both ways out work.
    draw("scanline", &Polygon { z: None, ..polygon.clone() }).unwrap();
    draw("gouraud", &polygon).unwrap();
}

/// Clause A-15: what a list of one's own may not do. Nothing is added.
#[test]
fn a_machine_that_clashes_is_refused() {
    static NAMED: [Kind; 4] = {
        let kind = Kind {
            name: "tiles",
            known_as: "",
            clause: "A-2",
            intake: Intake::Triangles,
            polygons: guardbit::machine::Polygons::Refused,
            decisions: &[],
            adopt: |_, _| None,
        };
        let decisions = &[guardbit::value::DepthConfig::GUARD];
        [
            kind,
            Kind { name: "Bad Name", ..kind },
            Kind { name: "new", ..kind },
            Kind { name: "other", decisions, ..kind },
        ]
    };
    let before = kinds().count();
    let own = |n: usize| Own::of::<ScanlineConfig>(&NAMED[n]);
    assert_eq!(add(&[own(0)]), Err(AddError::Name("tiles")));
    assert_eq!(add(&[own(1)]), Err(AddError::Spelling("Bad Name")));
    assert_eq!(add(&[own(2), own(2)]), Err(AddError::Name("new")));
    let refused = add(&[own(3)]).unwrap_err().to_string();
    assert!(refused.contains("\"guard\"") && refused.contains("depth plane"), "{refused}");
    assert_eq!(kinds().count(), before);
}

/// An example's program, built with the others on first use.
fn example(name: &str) -> Command {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let built = Command::new(env!("CARGO"))
            .args(["build", "--quiet", "--examples"])
            .current_dir(root())
            .status()
            .unwrap();
        assert!(built.success());
        // target/PROFILE/deps/this-test
        let own = std::env::current_exe().unwrap();
        own.parent().unwrap().parent().unwrap().join("examples")
    });
    Command::new(folder.join(name))
}

fn good(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    assert_eq!(output.status.code(), Some(0), "{out}\n{err}");
    out.into_owned()
}

#[test]
fn the_small_examples_say_what_they_should() {
    let run = |name: &str| good(&example(name).output().unwrap());
    let words = run("word_and_dda");
    // 100 + 100 = 200 = 256 - 56; 3000 = 0xbb8 = 4096 - 1096; 14 + 2 * 3/4 = 15 1/2, and beyond 15 the clamp.
    for part in ["100 + 100 = -56, wraps: true", "0xbb8 and reads as -1096", "depth 15"] {
        assert!(words.contains(part), "{words}");
    }
    let triangle = run("one_triangle");
    assert!(
        triangle.contains("21 samples") && triangle.contains("event inexact: 21"),
        "{triangle}"
    );
    let set = run("golden_set");
    let correct = set.lines().find(|line| line.starts_with("correct device: ")).unwrap();
    assert!(correct.ends_with(" rows, 0 mismatches") && !correct.contains(" 0 rows"), "{set}");
    assert!(set.contains("likely cause: depth.rounding is floor instead of nearest-even"), "{set}");
    let plot = run("error_against_bits");
    let errors: Vec<f64> = plot
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().nth(1).unwrap().parse().unwrap())
        .collect();
    assert!(errors.len() == 8 && errors.is_sorted_by(|a, b| a >= b), "{plot}");
    // Half a code is the read-out's own; clause B-5 bounds the rest by about 2000 steps of 2^-17.
    assert!(errors[0] > 8.0 && errors[7] < 0.5 + 2000.0 / 131_072.0, "{plot}");
}

/// Clause A-15: a machine of one's own goes through eval, sets, verify, diagnosis, trace, compare, explore and budget.
#[test]
fn a_machine_of_ones_own_has_the_whole_command() {
    let home = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        let mut command = example("own_machine");
        command.current_dir(home.path()).args(arguments.split_whitespace());
        command.output().unwrap()
    };
    let shown = good(&run("profile show sgi-4k --machine conservative"));
    assert!(shown.contains("\n[form.conservative]\nmargin = 0\n"), "{shown}");
    let shown = shown.replace("width = 4096\nheight = 4096", "width = 256\nheight = 256");
    std::fs::write(home.path().join("own.toml"), &shown).unwrap();
    let narrower = shown.replace("margin = 0", "margin = 1");
    std::fs::write(home.path().join("narrower.toml"), narrower).unwrap();

    // The triangle (1/2, 1/2), (2 1/2, 1/2), (1/2, 2 1/2) in pixels has its long side on x + y = 3. The boxes
    // of pixels (2, 1) and (1, 2) touch it at a corner, that of (2, 2) begins at x + y = 4.
    let mut child = example("own_machine")
        .args(["eval", home.path().join("own.toml").to_str().unwrap()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let line = "{\"id\": 1, \"v\": [[512,512,0],[2560,512,20],[512,2560,40]]}\n";
    child.stdin.take().unwrap().write_all(line.as_bytes()).unwrap();
    let answer = good(&child.wait_with_output().unwrap());
    assert!(answer.contains("\"rows\": [[0, 0, 3], [1, 0, 3], [2, 0, 2]]"), "{answer}");
    assert!(answer.contains("\"z\": ["), "{answer}");

    let written = good(&run("vectors own.toml --out set --count 4000 --scene triangle"));
    assert!(written.contains("set: "), "{written}");
    let manifest = std::fs::read_to_string(home.path().join("set/manifest.json")).unwrap();
    assert!(manifest.contains("\"conservative\": {"), "{manifest}");
    let package = std::fs::read_to_string(home.path().join("set/pkg.sv")).unwrap();
    assert!(package.contains("c0") && package.contains("SETUP"), "{package}");
    let verified = good(&run("verify set --recompute --profile own.toml"));
    assert!(verified.contains("PASS"), "{verified}");
    // The diagnosis tries what the machine lists.
    good(&run("vectors narrower.toml --out device --count 4000 --scene triangle"));
    let judged = run("verify set --dut device/span.exp.tv");
    let said = String::from_utf8_lossy(&judged.stdout).into_owned();
    assert_eq!(judged.status.code(), Some(1), "{said}");
    assert!(said.contains("form.conservative.margin is 1 instead of 0"), "{said}");

    let traced = good(&run("trace own.toml"));
    assert!(traced.contains("dda.cfg"), "{traced}");
    // No bound of coverage is stated: compare says so, and lends it no other machine's.
    let compared =
        good(&run("compare own.toml --scene fan --machines conservative,scanline --no-time"));
    assert!(
        compared.contains(
            "these machines state no bound for this profile, so it is not checked: conservative"
        ),
        "{compared}"
    );
    let compared = good(&run(
        "compare own.toml --scene fan --machines conservative,scanline --no-time --json",
    ));
    let compared: serde_json::Value = serde_json::from_str(&compared).unwrap();
    let row = |name: &str| {
        let rows = compared["machines"].as_array().unwrap();
        rows.iter().find(|row| row["name"] == name).unwrap().clone()
    };
    let (own, other) = (row("conservative"), row("scanline"));
    assert_eq!(own["known_as"], "an example");
    assert!(own["beyond_bound"].is_null() && other["beyond_bound"] == 0, "{own}");
    assert!(own["coverage_differs"].as_u64().unwrap() > 1000 && other["coverage_differs"] == 0);
    assert_ne!(own["ops"]["triangle"], other["ops"]["triangle"], "charged by its own count");
    let help = good(&run("explore --vary help"));
    assert!(help.lines().any(|line| line.trim().starts_with("margin ")), "{help}");
    let explored = good(&run("explore own.toml --scene fan --vary margin=0..2 --json"));
    let explored: serde_json::Value = serde_json::from_str(&explored).unwrap();
    let extra: Vec<u64> = explored
        .as_array()
        .unwrap()
        .iter()
        .map(|budget| budget["accuracy"]["arithmetic"]["extra"].as_u64().unwrap())
        .collect();
    // A smaller box covers less beyond the triangle.
    assert!(extra.len() == 3 && extra.is_sorted_by(|a, b| a > b) && extra[2] > 0, "{extra:?}");
    let words = good(&run("budget own.toml"));
    // 2 (12 + 10 + 2) + 2 bits: two differences of the vertex field.
    assert!(words.contains("edge: 50 edge = 50 bits"), "{words}");

    // The built-in command does not know it, and says what it knows.
    let plain = Command::new(env!("CARGO_BIN_EXE_guardbit"))
        .current_dir(home.path())
        .args(["budget", "own.toml"])
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&plain.stderr).into_owned();
    assert_eq!(plain.status.code(), Some(2), "{error}");
    assert!(error.contains("form.conservative: unknown variant `conservative`"), "{error}");
}
