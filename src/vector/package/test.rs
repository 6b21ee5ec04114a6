//! Properties of the generated texts; simulators judge them elsewhere.

use super::keyword::{identifier, unique};
use super::record::Record;
use super::template::{comment, fill};
use super::*;

fn column(name: &str, width: u32) -> Column {
    Column::new(name, width, name.starts_with('d'), width / 3, "What it holds.")
}

fn layout(name: &str, rows: u64, columns: &[(&str, u32)]) -> FileLayout {
    FileLayout {
        name: name.to_owned(),
        rows,
        columns: columns.iter().map(|&(name, width)| column(name, width)).collect(),
    }
}

fn dda() -> Vec<FileLayout> {
    vec![
        layout("dda.cfg.tv", 7, &[("init", 39), ("dx", 39), ("dy", 39)]),
        layout("dda.exp.tv", 5_000_000_000, &[("op", 2), ("acc", 39), ("out", 24)]),
    ]
}

fn edge() -> Vec<FileLayout> {
    vec![
        layout("edge.cfg.tv", 9, &[("e0", 35), ("ea", 35), ("eb", 35)]),
        layout("edge.exp.tv", 123, &[("op", 2), ("e", 35), ("in", 1)]),
    ]
}

fn interface(files: Vec<FileLayout>) -> Interface {
    let clamp = ClampParameters { guard: 2, integer: 24, fraction: 13, mode: Clamp::Guard };
    let (set, none) = ("sgi-4k-g2".to_owned(), "no such device".to_owned());
    let (setup, engine, registers) = (Err(none.clone()), Err(none.clone()), Err(none));
    let units = Vec::new();
    Interface { set, model_version: 3, clamp, setup, engine, registers, units, files }
}

fn text(interface: &Interface, name: &str) -> String {
    files(interface).into_iter().find(|(file, _)| file == name).expect("it is there").1
}

#[test]
fn the_list_of_files_is_pinned() {
    let names: Vec<String> = files(&interface(dda())).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        [
            "pkg.sv",
            "pkg.vh",
            "pkg.vhd",
            "pkg.h",
            "tb.sv",
            "dut.sv",
            "tb.vhd",
            "dut.vhd",
            "tb_cocotb.py",
        ]
    );
}

#[test]
fn nothing_is_left_to_fill_in_for_any_choice_of_halves() {
    let both = [dda(), edge()].concat();
    for set in [both, dda(), edge(), vec![], vec![layout("span.exp.tv", 1, &[("y", 12)])]] {
        for (name, text) in files(&interface(set)) {
            assert!(
                !text
                    .split('@')
                    .skip(1)
                    .any(|rest| rest.starts_with(|c: char| c.is_ascii_uppercase())),
                "{name}: a placeholder is left"
            );
            assert!(
                text.ends_with('\n') && !text.contains('\r') && text.is_ascii(),
                "{name}: not plain text"
            );
            assert!(
                text.lines()
                    .next()
                    .expect("it is there")
                    .contains("set sgi-4k-g2, model version 3"),
                "{name}: heading"
            );
            assert!(
                text.to_lowercase().contains("from inside the set folder"),
                "{name}: how to run it"
            );
        }
    }
}

#[test]
fn every_column_and_row_count_is_in_every_package() {
    let mut set = [dda(), edge()].concat();
    set.push(layout("span.exp.tv", 77, &[("test", 32), ("y", 128), ("x0", 13), ("in", 1)]));
    let interface = interface(set);
    for (package, rows) in
        [("pkg.sv", "64'd"), ("pkg.vh", "64'd"), ("pkg.vhd", "-- "), ("pkg.h", "UINT64_C(")]
    {
        let text = text(&interface, package);
        for file in &interface.files {
            let record = Record::new(file);
            let head = text
                .lines()
                .find(|line| line.contains(&format!("{}_ROWS ", record.constant())))
                .expect("it is there");
            assert!(head.contains(&format!("{rows}{}", file.rows)), "{package}: {head}");
            for field in &record.fields {
                for (what, value) in
                    [("WIDTH", field.column.width), ("FRACTION", field.column.fraction)]
                {
                    let name = format!("{}_{}_{what} ", record.constant(), field.constant());
                    let line = text
                        .lines()
                        .find(|line| line.contains(&name))
                        .unwrap_or_else(|| panic!("{package}: {name}"));
                    assert!(
                        line.trim_end_matches(';').ends_with(&format!(" {value}")),
                        "{package}: {line}"
                    );
                }
                assert!(text.contains(&field.comment()), "{package}: {}", field.comment());
            }
        }
    }
}

#[test]
fn a_record_packs_whole_nibbles_and_pads_above_each_value() {
    let file = layout("toy.tv", 1, &[("a", 1), ("b", 2), ("c", 3), ("d", 4), ("e", 5), ("f", 128)]);
    let record = Record::new(&file);
    assert_eq!(record.bits, 4 * (1 + 1 + 1 + 1 + 2 + 32));
    assert_eq!(record.line as usize, record.shape().len());
    assert_eq!(record.shape(), format!("0_0_0_0_00_{}\n", "0".repeat(32)));
    assert_eq!(record.pads(), format!("ec80e0{}", "0".repeat(32)));
    let mut top = record.bits;
    for field in &record.fields {
        assert_eq!(field.msb() + 1 + field.pad(), top, "{}", field.id);
        assert_eq!(field.lsb % 4, 0, "{}", field.id);
        top = field.lsb;
    }
    assert_eq!(top, 0);
}

#[test]
fn structures_and_slices_agree_with_the_widths() {
    let interface = interface(dda());
    let sv = text(&interface, "pkg.sv");
    assert!(sv.contains("localparam int DDA_EXP_BITS = 68;"));
    assert!(sv.contains("        logic [1:0] pad0;\n        logic [1:0] op;\n        logic [0:0] pad1;\n        logic [38:0] acc;\n        logic [23:0] out_v;\n    } dda_exp_t;"));
    assert!(sv.contains("logic signed [38:0] dx;"));
    let vh = text(&interface, "pkg.vh");
    assert!(vh.contains("`define GUARDBIT_DDA_EXP_ACC(row) row[62:24]"));
    assert!(
        vh.contains("`define GUARDBIT_DDA_EXP_ACC_MSB 62\n`define GUARDBIT_DDA_EXP_ACC_LSB 24\n")
    );
    let vhd = text(&interface, "pkg.vhd");
    assert!(vhd.contains("row.acc := packed_bits(62 downto 24);"));
    assert!(vhd.contains("DDA_EXP_ROWS : unsigned(63 downto 0) := x\"000000012a05f200\";"));
    let h = text(&interface, "pkg.h");
    assert!(h.contains("    X(acc, 39, 0, 13, 10, 24) \\\n"));
}

#[test]
fn a_missing_half_leaves_no_trace() {
    for (set, other) in [(dda(), "edge_check"), (edge(), "dda_check")] {
        let interface = interface(set);
        for name in ["tb.sv", "tb.vhd"] {
            assert!(!text(&interface, name).contains(other), "{name}");
        }
    }
    let only_walks = interface(edge());
    assert!(!text(&only_walks, "dut.sv").contains("module dda"));
    assert!(!text(&only_walks, "dut.vhd").contains("entity dda"));
    for name in ["tb.sv", "tb.vhd"] {
        assert!(text(&interface(vec![]), name).contains("FAIL nothing to check"), "{name}");
    }
}

#[test]
fn a_pair_without_its_fixed_columns_is_not_driven() {
    let mut set = [dda(), edge()].concat();
    set[1].columns[1].name = "accumulator".to_owned();
    assert!(!text(&interface(set), "tb.sv").contains("dda_check"));
}

#[test]
fn identifiers_are_legal_and_distinct() {
    for (name, id) in [
        ("acc", "acc"),
        ("in", "in_v"),
        ("out", "out_v"),
        ("inside", "inside_v"),
        ("signed", "signed_v"),
        ("y", "y"),
        ("_a__b_", "a_b"),
        ("dda.exp", "dda_exp"),
        ("3d", "c3d"),
        ("", "c"),
        ("Dx", "dx"),
        ("pad0", "pad0_v"),
        ("pad", "pad_v"),
        ("padding", "padding"),
    ] {
        assert_eq!(identifier(name), id, "{name}");
    }
    let mut taken = Vec::new();
    let ids: Vec<String> =
        ["in_v", "in", "in"].iter().map(|name| unique(name, &mut taken)).collect();
    assert_eq!(ids, ["in_v", "in_v_v", "in_v_v_v"]);
}

#[test]
fn comments_cannot_break_out() {
    assert_eq!(comment(" a */ b\n`c \u{d7} \"d\" \\ "), "a * / b 'c ? 'd' '");
    let mut set = dda();
    set[0].columns[0].meaning = "evil */ \nendmodule".to_owned();
    assert!(files(&interface(set)).iter().all(|(_, text)| {
        !text.lines().any(|line| line == "endmodule" && text.contains("evil */"))
    }));
}

#[test]
fn filling_in_replaces_every_place() {
    assert_eq!(fill("@A@ @B@ @A@", &[("A", "1"), ("B", "2")]), "1 2 1");
}

#[test]
fn every_mode_has_its_name_and_error_decodes_as_guard() {
    for (mode, name) in [
        (Clamp::Wrap, "WRAP"),
        (Clamp::Guard, "GUARD"),
        (Clamp::Sign, "SIGN"),
        (Clamp::Saturate, "SATURATE"),
        (Clamp::Error, "GUARD"),
    ] {
        let mut interface = interface(dda());
        interface.clamp.mode = mode;
        assert!(text(&interface, "pkg.sv").contains(&format!("CLAMP_MODE = CLAMP_{name};")));
        assert!(
            text(&interface, "pkg.vhd").contains(&format!("CLAMP_MODE : clamp_t := CLAMP_{name};"))
        );
    }
}

// Clause J-3
#[test]
fn a_bench_that_is_left_out_is_named_with_its_reason() {
    let mut set = dda();
    set[1].rows = 5;
    set.push(layout("setup.cfg.tv", 3, &[("v0_x", 12)]));
    set.push(layout("setup.exp.tv", 3, &[("zero_area", 1)]));
    set.push(layout("edge.cfg.tv", 3, &[("e0", 12)]));
    set.push(layout("edge.exp.tv", 3, &[("op", 2)]));
    set.push(layout("line.cfg.tv", 3, &[("v0_x", 12)]));
    set.push(layout("line.exp.tv", 0, &[("test", 32)]));
    let interface = interface(set);
    let left: Vec<(&str, String, String)> = unchecked(&interface)
        .into_iter()
        .map(|left| (left.testbench, left.bench, left.reason))
        .collect();
    let expected: Vec<(&str, String, String)> = ["tb.sv", "tb.vhd"]
        .into_iter()
        .flat_map(|testbench| {
            [
                ("setup", "no such device"),
                ("edge", "its files lack a column of the device"),
                ("line", "line.exp.tv has no rows"),
            ]
            .map(|(bench, reason)| (testbench, bench.to_owned(), reason.to_owned()))
        })
        .collect();
    assert_eq!(left, expected);
    for name in ["tb.sv", "tb.vhd"] {
        let text = text(&interface, name);
        let head: Vec<&str> =
            text.lines().take_while(|l| l.starts_with("//") || l.starts_with("--")).collect();
        for (_, bench, reason) in &expected[..3] {
            let line = format!("Not checked, {bench}: {reason}.");
            assert!(head.iter().any(|found| found.ends_with(&line)), "{name}: {line}");
            assert!(text.contains(&format!("NOT CHECKED {bench}: {reason}\"")), "{name}: {bench}");
        }
        assert!(text.contains(" not checked: setup edge line\""), "{name}");
    }
}
