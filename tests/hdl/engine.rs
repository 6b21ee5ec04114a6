//! `prove --rtl` for engines: ours and one of another kind, and nothing that differs.

// Clause J-12.
use crate::equivalence::ask;
use crate::run::{Ran, run_in};
use std::path::Path;

const HDL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/hdl");
const SHIPPED: &str = include_str!("../../hdl/triangle_engine.sv");
/// Every pixel by products, with output registers that are taken one by one.
const FOREIGN: [&str; 2] =
    [include_str!("designs/pixel_engine.sv"), include_str!("designs/pixel_engine.toml")];

/// 2 x 2 pixels in halves.
fn mini(home: &Path) {
    let profile = run_in(home, "profile show tiny").ends(0).out;
    let profile = profile
        .replace("\"tiny\"", "\"mini\"")
        .replace("width = 4\nheight = 4", "width = 2\nheight = 2")
        .replace("\ninteger = 2\n", "\ninteger = 1\n")
        .replace("\nwidth = 6\n", "\nwidth = 4\n");
    std::fs::write(home.join("mini.toml"), profile).unwrap();
}

/// An engine with the parts of ours.
fn ours(home: &Path, profile: &str, engine: &str) -> Ran {
    std::fs::write(home.join("engine.sv"), engine).unwrap();
    let parts = ["edge_evaluator", "depth_evaluator", "edge_stepper", "dda"];
    let parts = parts.map(|part| format!("{HDL}/{part}.sv")).join(" ");
    ask(home, &format!("{profile} --rtl engine.sv {parts} --block engine"))
}

fn foreign(home: &Path, profile: &str, edge: u32, [text, map]: [&str; 2]) -> Ran {
    std::fs::write(home.join("own.sv"), text).unwrap();
    let map = format!("{map}\n[parameters]\nEW = {edge}\n");
    std::fs::write(home.join("own.toml"), map).unwrap();
    ask(home, &format!("{profile} --rtl own.sv --block engine --map own.toml"))
}

#[track_caller]
fn proves(home: &Path, ran: &Ran, boxes: u32) {
    assert_eq!(ran.status, Some(0), "{}{}", ran.out, ran.err);
    assert!(ran.out.starts_with("PROVED by yosys-abc fraig and iprove"), "{}", ran.out);
    let said = format!("{boxes} of {boxes} boxes are UNSATISFIABLE");
    assert!(ran.out.contains(&said), "{}", ran.out);
    // The tool's own words are kept.
    let log = std::fs::read_to_string(home.join("guardbit-proof/box.log")).unwrap();
    assert!(log.lines().any(|line| line.starts_with("UNSATISFIABLE")), "{log}");
}

#[track_caller]
fn refutes(ran: &Ran, home: &Path, what: &str) {
    assert!(
        ran.status == Some(1) && ran.out.starts_with("REFUTED in "),
        "{what}: {}{}",
        ran.out,
        ran.err
    );
    assert!(home.join("guardbit-proof/counterexample.vcd").exists());
    // The rows end with a clock at which something is wrong.
    assert!(ran.out.contains("got_sample_depth want_sample_depth"), "{}", ran.out);
}

fn changed(text: &str, edits: &[(&str, &str)]) -> String {
    edits.iter().fold(text.to_owned(), |text, (old, new)| {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        text.replace(old, new)
    })
}

/// In a window of 2 x 2 pixels, all 36 boxes.
pub(crate) fn equal(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    let ran = ours(home, "mini.toml", SHIPPED);
    proves(home, &ran, 36);
}

pub(crate) fn other_kind(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    let ran = foreign(home, "mini.toml", 4, FOREIGN);
    proves(home, &ran, 36);
}

/// In the 225 boxes of 4 x 4 pixels: some minutes.
pub(crate) fn tiny(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let ran = ours(home, "tiny --limit 900", SHIPPED);
    proves(home, &ran, 225);
    let early = changed(
        SHIPPED,
        &[("if (last_row) state <= DONE;", "if (last_row || y == 1) state <= DONE;")],
    );
    refutes(&ours(home, "tiny", &early), home, "the summary after two rows");
}

/// Faults of the shipped engine.
const FAULTS: [&[(&str, &str)]; 20] = [
    &[("span_x_end = x;", "span_x_end = x + 1'b1;")],
    &[("if (!in_run) first <= x;", "if (!in_run) first <= x + 1'b1;")],
    &[("span_y = y;", "span_y = y + 1'b1;"), ("sample_y = y;", "sample_y = y + 1'b1;")],
    &[("last_row = y + 1'b1 >= bottom", "last_row = y + 2 >= bottom")],
    &[("at_end = x == right", "at_end = x + 1'b1 == right")],
    &[("covers == 3'b111", "covers[1:0] == 2'b11")],
    &[("covers == 3'b111", "covers != 3'b000")],
    &[("(covered && !sample_ready) ||", "")],
    &[("|| (closes && !span_ready)", "")],
    &[("if (triangle_ready) state <= IDLE", "state <= IDLE")],
    &[("triangle_samples = samples;", "triangle_samples = samples + 1;")],
    // The count of the triangle before.
    &[
        ("                        samples <= 0;\n", ""),
        (
            "            in_run <= 1'b0;\n        end\n        else",
            "            in_run <= 1'b0;\n            samples <= 0;\n        end\n        else",
        ),
    ],
    &[(
        "                        in_run <= covered;",
        "                        in_run <= covered || (in_run && at_end);",
    )],
    &[(
        "if (rst) begin\n            state <= IDLE;",
        "if (rst && state !== RUN) begin\n            state <= IDLE;",
    )],
    &[("y >= bottom ? DONE : RUN", "y > bottom ? DONE : RUN")],
    &[("triangle_test = name;", "triangle_test = test;")],
    // Steppers that go on while a record waits: the depth is that of the next sample.
    &[("!moves || (at_end && last_row) ? HOLD", "(at_end && last_row) ? HOLD")],
    // A slope of the triangle before.
    &[("slope_y <= depth_dy;", "if (!in_run) slope_y <= depth_dx;")],
    &[("CORNER: state <= nothing || ", "CORNER: state <= ")],
    // Rows in another order.
    &[("sample_y = y;", "sample_y = y == 1 ? 0 : y;")],
];

pub(crate) fn differences(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    for edits in FAULTS.iter().step_by(3) {
        refutes(&ours(home, "mini.toml", &changed(SHIPPED, edits)), home, edits[0].1);
    }
    for (old, new) in [
        // A record that is overwritten while it waits, one that comes twice, and words of the next triangle.
        ("wire free = (!run_valid || run_ready) &&", "wire free ="),
        ("if (dot_ready) dot_valid <= 0;", "if (dot_ready && !run_valid) dot_valid <= 0;"),
        ("ended && free", "ended"),
        ("!whole[ZW] ?", "!wz[DW-2] ?"),
        ("open <= inside && !last;", "open <= inside;"),
        ("cz <= z0;", "cz <= z0 + 1;"),
    ] {
        let text = changed(FOREIGN[0], &[(old, new)]);
        refutes(&foreign(home, "mini.toml", 4, [&text, FOREIGN[1]]), home, new);
    }
    // A stream that is not named is not compared, and that is said.
    let kept: Vec<&str> = FOREIGN[1].lines().filter(|line| !line.starts_with("span_")).collect();
    let map = kept.join("\n") + "\n\n[constants]\nrun_ready = 1\n";
    let ran = foreign(
        home,
        "mini.toml",
        4,
        [&changed(FOREIGN[0], &[("cz <= z0;", "cz <= z0 + 1;")]), &map],
    );
    assert!(ran.out.contains("assumed: not compared, as no port is named: span"), "{}", ran.out);
    assert!(ran.out.contains("assumed: run_ready is 1 at every clock"), "{}", ran.out);
    refutes(&ran, home, "one stream alone");
}

/// All faults of the shipped engine.
pub(crate) fn all_differences(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    for edits in FAULTS {
        refutes(&ours(home, "mini.toml", &changed(SHIPPED, edits)), home, edits[0].1);
    }
}

/// What no drawn triangle meets is found by a solver, or left open: never proved.
pub(crate) fn rare(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    let one_word = [(
        "slope_x <= depth_dx;",
        "slope_x <= depth_dx == 7'h35 && depth_init == 7'h2a ? depth_dx + 1'b1 : depth_dx;",
    )];
    refutes(&ours(home, "mini.toml", &changed(SHIPPED, &one_word)), home, "one word");
    // The tenth triangle loses its number; a record that waited for 60 clocks is dropped.
    for edits in [
        &[
            ("    logic nothing;", "    logic nothing; logic [3:0] many;"),
            (
                "            state <= IDLE;\n            in_run",
                "            state <= IDLE;\n            many <= 0;\n            in_run",
            ),
            ("name <= test;", "name <= many == 4'd9 ? 0 : test; many <= many + (many != 4'd10);"),
        ][..],
        &[
            ("    logic nothing;", "    logic nothing; logic [5:0] waited;"),
            (
                "    always_ff @(posedge clk)\n        if (rst)",
                "    always_ff @(posedge clk) waited <= rst || !stalled ? 0 : waited + 1;\n    \
                 always_ff @(posedge clk)\n        if (rst)",
            ),
            (
                "wire moves = state == RUN && !stalled;",
                "wire moves = state == RUN && (!stalled || waited == 60);",
            ),
        ],
    ] {
        let ran = ours(home, "mini.toml", &changed(SHIPPED, edits)).ends(1);
        assert!(
            ran.out.starts_with("REFUTED in ")
                || (ran.out.starts_with("UNDECIDED after ")
                    && ran.out.contains("the induction fails in the box")),
            "{}",
            ran.out
        );
    }
}

pub(crate) fn refused(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    mini(home);
    for (old, new, says) in [
        (
            "[reset]\nport = \"resetn\"\nactive-low = true",
            "[constants]\nresetn = 1",
            "an engine needs [reset]",
        ),
        ("module = ", "latency = 1\nmodule = ", "it has no latency"),
        ("module = ", "held = true\nmodule = ", "no operation that loads"),
        ("in_ready = \"idle\"\n", "", "[ports] has no in_ready"),
        ("triangle_valid = \"end_valid\"\n", "", "[ports] has no triangle_valid"),
        ("sample_valid = \"dot_valid\"\n", "", "and no sample_valid"),
        ("sample_ready = \"dot_ready\"\n", "", "[ports] has no sample_ready"),
        ("sample_y = \"dot_y\"\n", "", "[ports] has no sample_y"),
        ("test = \"id\"\n", "", "[ports] has no test"),
        ("zero_area = \"flat\"\n", "", "[ports] has no zero_area"),
        ("sample_depth = \"dot_z\"", "sample_depth = \"dot_x\"", "has 17 bits != 3"),
        ("edge0_init = \"e0\"", "edge0_init = \"e9\"", "the module has no port e9"),
        ("sample_ready = \"dot_ready\"", "sample_ready = \"run_ready\"", "dot_ready"),
    ] {
        assert_eq!(FOREIGN[1].matches(old).count(), 1, "{old}");
        let ran = foreign(home, "mini.toml", 4, [FOREIGN[0], &FOREIGN[1].replace(old, new)]);
        assert!(ran.status == Some(2) && ran.err.contains(says), "{new}: {}{}", ran.out, ran.err);
    }
    // A window that is too large, by its name and number.
    let _ = ours(home, "sgi-4k", SHIPPED)
        .complains(2, &["the window of sgi-4k has 4096 x 4096 pixels", "16"]);
    // An engine that takes a triangle and never answers: nothing was compared.
    let silent = changed(
        SHIPPED,
        &[("assign triangle_valid = state == DONE;", "assign triangle_valid = 1'b0;")],
    );
    let ran = ours(home, "mini.toml", &silent).ends(1);
    assert!(
        ran.out.starts_with("UNDECIDED after ") && ran.out.contains("nothing was compared"),
        "{}",
        ran.out
    );
    // What nobody drives is anything.
    let undriven = changed(SHIPPED, &[("    assign sample_x = x;\n", "")]);
    let ran = ours(home, "mini.toml", &undriven).ends(1);
    assert!(!ran.out.starts_with("PROVED"), "{}", ran.out);
    let latch = changed(
        FOREIGN[0],
        &[(
            "assign end_id = held_id;",
            "reg [31:0] kept; always @* if (idle) kept = id; assign end_id = kept;",
        )],
    );
    let ran = foreign(home, "mini.toml", 4, [&latch, FOREIGN[1]]);
    assert!(ran.status == Some(2) && ran.err.contains("latch"), "{}{}", ran.out, ran.err);
    let template = ask(home, "mini.toml --rtl own.sv --block engine --map-template").ends(0).out;
    assert!(
        template.contains("module = \"pixel_engine\"") && !template.contains("latency"),
        "{template}"
    );
}
