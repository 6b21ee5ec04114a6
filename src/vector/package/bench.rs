//! `tb.*` and `dut.*`: the testbenches and the devices that pass them.

use super::Interface;
use super::half::{Half, halves};
use super::record::Record;
use super::template::{fill, head};

/// The SystemVerilog testbench.
pub(super) fn systemverilog(interface: &Interface, records: &[Record]) -> String {
    let halves = halves(interface, records);
    if halves.is_empty() {
        return head(interface, include_str!("tb.none.sv.in"));
    }
    let each = |between: &str, text: &dyn Fn(&str) -> String| {
        halves.iter().map(|half| text(half.name)).collect::<Vec<_>>().join(between)
    };
    let instances = each("\n", &|name| {
        format!(
            "    wire {name}_done;\n    wire [63:0] {name}_rows, {name}_mismatches;\n    {name}_check {name}_half (.clk(clk), .done({name}_done), .rows({name}_rows), .mismatches({name}_mismatches));\n"
        )
    });
    let text = fill(
        include_str!("tb.sv.in"),
        &[
            ("HALVES", &halves.iter().map(Half::systemverilog).collect::<String>()),
            ("INSTANCES", &instances),
            ("DONE", &each(" && ", &|name| format!("{name}_done"))),
            ("BAD", &each(" || ", &|name| format!("{name}_mismatches != 0"))),
            ("SUMMARY", &each("", &|name| format!(" {name} rows=%0d"))),
            ("ROWS", &each("", &|name| format!(", {name}_rows"))),
            ("MISMATCHES", &each(" + ", &|name| format!("{name}_mismatches"))),
        ],
    );
    head(interface, &text)
}

/// The SystemVerilog devices.
pub(super) fn systemverilog_device(interface: &Interface, records: &[Record]) -> String {
    device(
        interface,
        records,
        include_str!("dut.sv.in"),
        include_str!("dut.dda.sv.in"),
        include_str!("dut.edge.sv.in"),
    )
}

/// The VHDL testbench.
pub(super) fn vhdl(interface: &Interface, records: &[Record]) -> String {
    let halves = halves(interface, records);
    if halves.is_empty() {
        return head(interface, include_str!("tb.none.vhd.in"));
    }
    let each = |between: &str, text: &dyn Fn(&str) -> String| {
        halves.iter().map(|half| text(half.name)).collect::<Vec<_>>().join(between)
    };
    let signals = each("", &|name| {
        format!(
            "    signal {name}_done : boolean;\n    signal {name}_rows, {name}_mismatches : count_t;\n"
        )
    });
    let instances = each("", &|name| {
        format!(
            "    {name}_half : entity work.{name}_check\n        port map (clk => clk, done => {name}_done, rows => {name}_rows, mismatches => {name}_mismatches);\n"
        )
    });
    let text = fill(
        include_str!("tb.vhd.in"),
        &[
            ("HALVES", &halves.iter().map(Half::vhdl).collect::<String>()),
            ("SIGNALS", &signals),
            ("INSTANCES", &instances),
            ("DONE", &each(" and ", &|name| format!("{name}_done"))),
            ("BAD", &each(" or ", &|name| format!("{name}_mismatches /= 0"))),
            ("SUMMARY", &each(" & \" ", &|name| format!("{name} rows=\" & decimal({name}_rows)"))),
            ("MISMATCHES", &each(" + ", &|name| format!("{name}_mismatches"))),
        ],
    );
    head(interface, &text)
}

/// The VHDL devices.
pub(super) fn vhdl_device(interface: &Interface, records: &[Record]) -> String {
    let start = include_str!("dut.vhd.in");
    if halves(interface, records).is_empty() {
        // A design file needs a design unit.
        return head(
            interface,
            &format!("{start}\npackage guardbit_no_device is\nend package guardbit_no_device;\n"),
        );
    }
    device(
        interface,
        records,
        start,
        include_str!("dut.dda.vhd.in"),
        include_str!("dut.edge.vhd.in"),
    )
}

fn device(interface: &Interface, records: &[Record], start: &str, dda: &str, edge: &str) -> String {
    let mut text = start.to_owned();
    for half in halves(interface, records) {
        let width = format!("{}_{}_WIDTH", half.exp.constant(), half.state.constant());
        let template = if half.name == "dda" { dda } else { edge };
        text += &half.fill(template, &[("WIDTH", &width)]);
    }
    head(interface, &text)
}
