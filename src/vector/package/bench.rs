//! `tb.*` and `dut.*`: the testbenches and the devices that pass them.

use super::Interface;
use super::half::{Half, halves};
use super::keyword::identifier;
use super::record::Record;
use super::rtl::{Source, Values};
use super::stream::{self, Stream, streams};
use super::template::{fill, head};

/// The SystemVerilog testbench.
pub(super) fn systemverilog(interface: &Interface, records: &[Record]) -> String {
    let halves = halves(interface, records);
    let streams = streams(interface, records);
    if halves.is_empty() && streams.is_empty() {
        return head(interface, include_str!("tb.none.sv.in"));
    }
    let names = halves.iter().map(|half| half.name).chain(streams.iter().map(|stream| stream.name));
    let names: Vec<&str> = names.collect();
    let each = |between: &str, text: &dyn Fn(&str) -> String| {
        names.iter().map(|name| text(name)).collect::<Vec<_>>().join(between)
    };
    let checks = halves.iter().map(Half::systemverilog);
    let checks: String = checks.chain(streams.iter().map(Stream::systemverilog)).collect();
    let instances = each("\n", &|name| {
        let scope = identifier(name);
        format!(
            "    wire {name}_done;\n    wire [63:0] {name}_rows, {name}_mismatches;\n    {name}_check {scope} (.clk(clk && !{name}_done), .done({name}_done), .rows({name}_rows), .mismatches({name}_mismatches));\n"
        )
    });
    let text = fill(
        include_str!("tb.sv.in"),
        &[
            ("HALVES", &checks),
            ("INSTANCES", &instances),
            ("SCOPES", &each(", ", &identifier)),
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
    let halves = halves(interface, records);
    let mut text = include_str!("dut.sv.in").to_owned();
    text += &devices(interface, &halves, |half| half.module);
    text += &stream::modules(interface, &streams(interface, records), &halves);
    head(interface, &text)
}

/// The cocotb scoreboard, which reads what it has to know from the manifest.
pub(super) fn cocotb(interface: &Interface) -> String {
    head(interface, include_str!("tb_cocotb.py.in"))
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
        let scope = identifier(name);
        format!(
            "    {scope} : entity work.{name}_check\n        generic map (DUMP => DUMP)\n        port map (clk => clk, done => {name}_done, rows => {name}_rows, mismatches => {name}_mismatches);\n"
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
    let halves = halves(interface, records);
    head(interface, &(start.to_owned() + &devices(interface, &halves, |half| half.entity)))
}

/// The device of each half, after an empty line.
fn devices(
    interface: &Interface,
    halves: &[Half],
    source: fn(&Half<'_>) -> &'static Source,
) -> String {
    let texts = halves.iter().map(|half| {
        let width = half.state.column.width;
        let values = Values::of_clamp(&interface.clamp).and("M", width);
        format!("\n{}", source(half).with(&values))
    });
    texts.collect()
}
