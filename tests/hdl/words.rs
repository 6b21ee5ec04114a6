//! `prove --rtl` for set-ups: foreign architectures are proved, and nothing that differs is.

// Clause J-10.
use crate::equivalence::ask;
use crate::run::run_in;
use crate::set::good;
use std::path::Path;

const HDL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/hdl");
/// Three architectures: a text and its map.
const CROSSED: [&str; 2] =
    [include_str!("designs/crossed.sv"), include_str!("designs/crossed.toml")];
const LATE: [&str; 2] = [
    include_str!("../../examples/equivalence/late.sv"),
    include_str!("../../examples/equivalence/late.toml"),
];
const STAGED: [&str; 2] = [include_str!("designs/staged.sv"), include_str!("designs/staged.toml")];

/// The last stage of `late`.
const STAGE: &str = "  // stage 4\n  always @(posedge clk) begin";

fn words(home: &Path, [text, map]: [&str; 2]) -> crate::run::Ran {
    std::fs::write(home.join("own.sv"), text).unwrap();
    std::fs::write(home.join("own.toml"), map).unwrap();
    ask(home, "sgi-4k --rtl own.sv --block set-up --map own.toml")
}

#[track_caller]
fn proves(home: &Path, design: [&str; 2]) {
    let out = words(home, design).ends(0).out;
    assert!(out.starts_with("PROVED by polynomials in "), "{out}");
    let forms = std::fs::read_to_string(home.join("guardbit-proof/polynomials.txt")).unwrap();
    assert!(forms.contains("\nedge0_init mod 2^35\n") && !forms.contains("difference: -"));
}

/// The same design with something else in its text or in its map.
fn changed([text, map]: [&str; 2], old: &str, new: &str) -> [String; 2] {
    let count = text.matches(old).count() + map.matches(old).count();
    assert_eq!(count, 1, "{old}");
    [text.replace(old, new), map.replace(old, new)]
}

pub(crate) fn shipped(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    for profile in ["sgi-4k", "tiny", "d3d11"] {
        let rtl = format!("{HDL}/triangle_setup.sv {HDL}/setup_divider.sv");
        let out = ask(home, &format!("{profile} --rtl {rtl} --block set-up")).ends(0).out;
        assert!(out.starts_with("PROVED by polynomials in ") && out.contains(": 14 of 14 words"));
    }
}

pub(crate) fn foreign(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    for design in [CROSSED, LATE, STAGED] {
        proves(home, design);
    }
    // What makes no difference: a sign where the area is zero, a shift whose high bits nobody reads.
    for (design, old, new) in [
        (LATE, "left <= a < 0", "left <= a <= 0"),
        (STAGED, "f >>> 10", "f >> 10"),
        // A stage that clears its words itself.
        (LATE, "    plane_y <= left", "    if (empty) edge0_dx <= 0;\n    plane_y <= left"),
    ] {
        let [text, map] = changed(design, old, new);
        proves(home, [&text, &map]);
    }
}

/// Differences that a simulation of 17,564 triangles has seen, some at one corner of the field alone.
pub(crate) fn differences(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let refuted = [
        (CROSSED, "bycx = by*cx", "bycx = by*bx"),
        (CROSSED, "wire signed [24:0] Sab", "wire signed [23:0] Sab"),
        (CROSSED, "wire o1 = A1 > 0", "wire o1 = A1 >= 0"),
        (CROSSED, "[45:0] axby", "[43:0] axby"),
        (CROSSED, "live ? {{11{B2[23]}},B2} : 35'd0", "{{11{B2[23]}},B2}"),
        (CROSSED, "za = {1'b0,az}", "za = $signed(az)"),
        (LATE, "rx <= $signed({1'b0,fx}) - 24'sd512", "rx <= $signed({1'b0,fx}) - 24'sd511"),
        (LATE, "nx*sxx + ny*syy", "nx*sxx + ny*sxx"),
        (LATE, "$signed({1'b0,z00})*a", "$signed(z00)*a"),
        (LATE, "reg signed [45:0] a; ", "reg signed [44:0] a; "),
        (STAGED, "4'b0001: bias = 1'b0;", "4'b0001: bias = 1'b1;"),
        (STAGED, "pa < pb", "pa[45:0] < pb[45:0]"),
        (STAGED, "flat <= pa == pb", "flat <= pa[43:0] == pb[43:0]"),
        (STAGED, "reg signed [46:0] pa, pb", "reg signed [44:0] pa, pb"),
        // A register that a word of the data clears or sets.
        (LATE, "ex <= {1'b0,tx}", "if (tx < fx) ex <= 0; else ex <= {1'b0,tx}"),
        (LATE, "z0 <= v0_z;", "if (v0_z[23]) z0 <= 0; else z0 <= v0_z;"),
        (LATE, "zero_area <= empty;", "if (left) zero_area <= 1; else zero_area <= empty;"),
    ];
    for (design, old, new) in refuted {
        let [text, map] = changed(design, old, new);
        let ran = words(home, [&text, &map]);
        assert!(
            ran.status == Some(1) && ran.out.starts_with("REFUTED in "),
            "{new}: {}{}",
            ran.out,
            ran.err
        );
        // The triangle is one that the profile draws, and its words are shown.
        let out = &ran.out;
        assert!(
            out.contains(" by the triangle {\"id\":0,\"v\":[[") && out.contains(" got "),
            "{out}"
        );
        // What is wanted stands in the trace, as it is printed.
        let trace = out.lines().find_map(|line| line.strip_prefix("its words: guardbit "));
        let trace = run_in(home, trace.unwrap()).ends(0).out;
        assert!(trace.contains("setup.exp (1 rows)") && trace.contains("edge0_init="), "{trace}");
    }
}

/// What no proof here takes, and proofs that would be empty.
pub(crate) fn refused(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let negedge = STAGE.replace("posedge", "negedge");
    let by_data = STAGE.replace("begin", "if (!left) begin");
    let cleared = "  // stage 4\n  reg flag;\n  always @(posedge clk or posedge left) if (left) flag <= 1; else flag <= empty;\n  always @(posedge clk) begin";
    for (design, old, new, says) in [
        (LATE, STAGE, negedge.as_str(), "rising edge of the map's clock"),
        (LATE, STAGE, by_data.as_str(), "enable of a register depends on v"),
        (LATE, "latency = 4", "latency = 3", "latency = 3, and the words come 4 clocks late"),
        (LATE, "latency = 4", "latency = 4\nclock = \"ax\"", "the module has no port ax"),
        (
            LATE,
            "plane_y <= left ? -ny3 : ny3;",
            "plane_y <= left ? -ny3 : ny;",
            "registers meets one behind",
        ),
        (LATE, "v0_z = \"v0_z\"\n", "", "[ports] has no v0_z"),
        // What a set-up has no use for is not passed over.
        (LATE, "latency = 4", "latency = 4\nheld = true", "no operation that loads"),
        (LATE, "[ports]", "[op]\nload = 1\n\n[ports]", "[op] load: there is no such operation"),
        (LATE, "[ports]", "[division]\nlead = 1\n\n[ports]", "belongs to the block divider"),
        (STAGED, "in_valid = 1", "in_valid = 2", "in_valid = 2 >= 2^1"),
        (
            CROSSED,
            "assign flat = ~|area;",
            "assign flat = ~|area;\n  assign flat = az[0];",
            "two things drive one wire",
        ),
        (CROSSED, "wire live = |area;", "wire live = ^area;", "none of sums, products"),
        (CROSSED, "output [46:0] area2", "output [43:0] area2", "area: 44 bits are too few"),
        (CROSSED, "area = \"area2\"", "area = \"nowhere\"", "neither a port nor a wire nowhere"),
    ] {
        let [text, map] = changed(design, old, new);
        let ran = words(home, [&text, &map]);
        assert!(ran.status == Some(2) && ran.err.contains(says), "{new}: {}{}", ran.out, ran.err);
    }
    // A reset that is no reset.
    let [text, map] = changed(LATE, STAGE, cleared);
    let text = text.replace("zero_area <= empty;", "zero_area <= flag;");
    let ran = words(home, [&text, &map.replace("latency = 4", "latency = 5")]);
    assert!(
        ran.status == Some(2) && ran.err.contains("reset by something else than the map's reset"),
        "{}{}",
        ran.out,
        ran.err
    );
    // Registers that never load: both sides are equal, and nothing ever comes.
    for (old, new) in [
        ("out_ready = 1", "out_ready = 0"),
        (
            "always @(posedge clock) if (en2) begin",
            "always @(posedge clock) if (en2 && !s1v) begin",
        ),
    ] {
        let [text, map] = changed(STAGED, old, new);
        let ran = words(home, [&text, &map]);
        assert!(
            ran.status == Some(1) && ran.out.contains("does not show the words within"),
            "{}",
            ran.out
        );
    }
}

/// At 3 bits a coordinate, a solver of bits says the same of a set-up and of every fault of it.
pub(crate) fn bits_agree(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    // 2 x 2 pixels in halves.
    let profile = run_in(home, "profile show tiny").ends(0).out;
    let profile = profile
        .replace("\"tiny\"", "\"mini\"")
        .replace("width = 4\nheight = 4", "width = 2\nheight = 2")
        .replace("\ninteger = 2\n", "\ninteger = 1\n")
        .replace("\nwidth = 6\n", "\nwidth = 4\n");
    std::fs::write(home.join("mini.toml"), profile).unwrap();
    let reference = run_in(home, "export mini.toml --as sv").ends(0).out;
    std::fs::write(home.join("reference.sv"), reference).unwrap();
    let text = include_str!("designs/small.sv");
    std::fs::write(home.join("map.toml"), include_str!("designs/small.toml")).unwrap();
    let mut said = [0; 3];
    for (old, new) in [
        ("", ""),
        ("turned ? x2 : x1", "x1"),
        ("turned = area < 0", "turned = area[6]"),
        ("ey < 0 ||", "ey <= 0 ||"),
        ("ey == 0 && ex > 0", "ey == 0"),
        ("(owns ? 0 : 1)", "1"),
        ("ex * (1 - fy) - ey * (1 - fx)", "ex * (1 - ty) - ey * (1 - tx)"),
        ("{4{area != 0}}", "4'hf"),
        ("{4{area != 0}}", "{4{area > 0}}"),
        ("wire signed [9:0] area", "wire signed [5:0] area"),
        ("wire signed [9:0] area", "wire signed [4:0] area"),
        ("value >>> 1", "value >> 1"),
        (
            "(x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)",
            "x0 * y1 - x1 * y0 + x1 * y2 - x2 * y1 + x2 * y0 - x0 * y2",
        ),
    ] {
        assert!(old.is_empty() || text.matches(old).count() == 1, "{old}");
        let text = if old.is_empty() { text.to_owned() } else { text.replace(old, new) };
        std::fs::write(home.join("small.sv"), &text).unwrap();
        let script = "read_verilog -sv reference.sv small.sv; hierarchy -check -top both; proc; flatten; \
                      opt_clean; techmap; aigmap; opt_clean; write_aiger both.aig";
        good(home, "yosys", &["-q", "-p", script]);
        let says = good(home, "yosys-abc", &["-c", "read_aiger both.aig; strash; dsat"]);
        let last = says.lines().last().unwrap_or_default();
        let equal = last.starts_with("UNSATISFIABLE");
        assert!(equal || last.starts_with("SATISFIABLE"), "{new}: {says}");
        let ran = ask(home, "mini.toml --rtl small.sv --block set-up --map map.toml");
        let answer = ran.out.split(' ').next().unwrap_or_default();
        match (answer, equal) {
            ("PROVED", true) => said[0] += 1,
            ("REFUTED", false) => said[1] += 1,
            ("UNDECIDED" | "", _) => said[2] += 1,
            _ => panic!("{new}: {answer}, and the solver says {equal}: {}", ran.out),
        }
    }
    // Most have an answer.
    assert!(said[0] >= 3 && said[1] >= 6 && said[2] <= 3, "{said:?}");
}
