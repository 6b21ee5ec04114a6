//! `tb.*` and `dut.*`: the testbenches and the devices that pass them.

use super::Interface;
use super::half::Half;
use super::keyword::identifier;
use super::plan::Plan;
use super::record::Record;
use super::rtl::{Source, Values};
use super::stream::{self, Stream};
use super::template::{fill, head};
use super::unit::{self, wire};

/// What the head of a SystemVerilog file says of a bench that is left out.
const LEFT_OUT: &str = "// Not checked, @BENCH@: @REASON@.\n";
/// The same in VHDL.
const LEFT_OUT_VHDL: &str = "-- Not checked, @BENCH@: @REASON@.\n";

/// A generic of the VHDL testbench, where it drives walks.
const LATENCY: &str = ";
        -- Clocks that the outputs of walks come late.
        LATENCY : natural range 0 to 63 := 0";

/// What the cocotb scoreboard knows of the units of channels: a device of the name of each bench.
const COCOTB_UNITS: &str = r#"for file in SET.glob("*-*.cfg.tv"):
    stem = file.name[: -len(".cfg.tv")]
    kind = stem.split("-")[0]
    if kind in ("interpolator", "reciprocal", "divider"):
        prefix = "" if kind == "interpolator" else "o_"
        DEVICES["dut_" + stem.replace("-", "_")] = (f"{stem}.cfg", {f"{stem}.exp": prefix})
"#;
/// Which devices are walked.
const COCOTB_WALKS: &str = r#"device in ("dda", "edge_stepper")"#;
const COCOTB_UNIT_WALKS: &str =
    r#"device in ("dda", "edge_stepper") or device.startswith("dut_interpolator_")"#;

/// The SystemVerilog testbench.
pub(super) fn systemverilog(interface: &Interface, records: &[Record]) -> String {
    let plan = Plan::systemverilog(interface, records);
    let (halves, streams, names) = (&plan.halves, &plan.streams, plan.names());
    let left_out = plan.each_unchecked(LEFT_OUT);
    let say = |indent: &str| {
        plan.each_unchecked(&format!("{indent}$display(\"NOT CHECKED @BENCH@: @REASON@\");\n"))
    };
    if names.is_empty() {
        let values = [("LEFT_OUT", left_out.as_str()), ("SAY", &say("        "))];
        let text = fill(include_str!("tb.none.sv.in"), &values);
        return head(interface, &text);
    }
    let each = |between: &str, text: &dyn Fn(&str) -> String| {
        names.iter().map(|name| text(name)).collect::<Vec<_>>().join(between)
    };
    let checks = halves.iter().map(Half::systemverilog);
    let checks: String = checks.chain(streams.iter().map(Stream::systemverilog)).collect();
    let instances = each("\n", &|name| {
        let (scope, name) = (identifier(name), wire(name));
        format!(
            "    wire {name}_done;\n    wire [63:0] {name}_rows, {name}_mismatches;\n    {name}_check {scope} (.clk(clk && !{name}_done), .done({name}_done), .rows({name}_rows), .mismatches({name}_mismatches));\n"
        )
    });
    let text = fill(
        include_str!("tb.sv.in"),
        &[
            ("HALVES", &checks),
            ("INSTANCES", &instances),
            ("LEFT_OUT", &left_out),
            ("SAY", &say("            ")),
            ("UNCHECKED", &plan.verdict()),
            ("SCOPES", &each(", ", &identifier)),
            ("DONE", &each(" && ", &|name| wire(name) + "_done")),
            ("BAD", &each(" || ", &|name| wire(name) + "_mismatches != 0")),
            ("SUMMARY", &each("", &|name| format!(" {name} rows=%0d"))),
            ("ROWS", &each("", &|name| format!(", {}_rows", wire(name)))),
            ("MISMATCHES", &each(" + ", &|name| wire(name) + "_mismatches")),
        ],
    );
    head(interface, &text)
}

/// The SystemVerilog devices.
pub(super) fn systemverilog_device(interface: &Interface, records: &[Record]) -> String {
    let plan = Plan::systemverilog(interface, records);
    let start = fill(include_str!("dut.sv.in"), &[("LEFT_OUT", &plan.each_unchecked(LEFT_OUT))]);
    let text = start
        + &devices(interface, &plan.halves, |half| half.module)
        + &stream::modules(&plan.streams, &plan.halves)
        + &unit::modules(interface, records, &plan);
    head(interface, &text)
}

/// The cocotb scoreboard, which reads what it has to know from the manifest.
pub(super) fn cocotb(interface: &Interface) -> String {
    let units = if interface.units.is_empty() { "" } else { COCOTB_UNITS };
    let walks = if interface.units.is_empty() { COCOTB_WALKS } else { COCOTB_UNIT_WALKS };
    let text = include_str!("tb_cocotb.py.in");
    head(interface, &fill(text, &[("UNITS", units), ("WALKS", walks)]))
}

/// The VHDL testbench.
pub(super) fn vhdl(interface: &Interface, records: &[Record]) -> String {
    let plan = Plan::vhdl(interface, records);
    let (halves, streams, names) = (&plan.halves, &plan.streams, plan.names());
    let left_out = plan.each_unchecked(LEFT_OUT_VHDL);
    let say = plan.each_unchecked("        say(\"NOT CHECKED @BENCH@: @REASON@\");\n");
    if names.is_empty() {
        let text = fill(include_str!("tb.none.vhd.in"), &[("LEFT_OUT", &left_out), ("SAY", &say)]);
        return head(interface, &text);
    }
    let each = |between: &str, text: &dyn Fn(&str) -> String| {
        names.iter().map(|name| text(name)).collect::<Vec<_>>().join(between)
    };
    let keyed = |name: &str| streams.iter().any(|stream| stream.name == name && stream.keyed());
    let walks = |name: &str| halves.iter().any(|half| half.name == name);
    let latency = if halves.is_empty() { "" } else { LATENCY };
    let any_order = streams.iter().find(|stream| stream.keyed()).map(|stream| {
        format!(
            ";\n        -- Rows of a test in any order, for engines with an order of their own.\n        ANY_ORDER : boolean := {}",
            stream.any_order
        )
    });
    let checks = halves.iter().map(Half::vhdl).chain(streams.iter().map(Stream::vhdl));
    let signals = each("", &|name| {
        format!(
            "    signal {name}_done : boolean;\n    signal {name}_rows, {name}_mismatches : count_t;\n"
        )
    });
    let instances = each("", &|name| {
        let scope = identifier(name);
        let order = match name {
            _ if walks(name) => ", LATENCY => LATENCY",
            _ if keyed(name) => ", ANY_ORDER => ANY_ORDER",
            _ => "",
        };
        format!(
            "    {scope} : entity work.{name}_check\n        generic map (DUMP => DUMP{order})\n        port map (clk => clk, done => {name}_done, rows => {name}_rows, mismatches => {name}_mismatches);\n"
        )
    });
    let text = fill(
        include_str!("tb.vhd.in"),
        &[
            ("HALVES", &checks.collect::<String>()),
            ("LATENCY", latency),
            ("ANY_ORDER", &any_order.unwrap_or_default()),
            ("LEFT_OUT", &left_out),
            ("SAY", &say),
            ("UNCHECKED", &plan.verdict()),
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
    let plan = Plan::vhdl(interface, records);
    let left_out = plan.each_unchecked(LEFT_OUT_VHDL);
    let mut text = fill(include_str!("dut.vhd.in"), &[("LEFT_OUT", &left_out)]);
    text += &devices(interface, &plan.halves, |half| half.entity);
    text += &stream::entities(&plan.streams, &plan.halves);
    if plan.names().is_empty() {
        // A design file needs a design unit.
        text += "\npackage guardbit_no_device is\nend package guardbit_no_device;\n";
    }
    head(interface, &text)
}

/// The device of each half, after an empty line.
fn devices(
    interface: &Interface,
    halves: &[Half],
    source: fn(&Half<'_>) -> Option<&'static Source>,
) -> String {
    let texts = halves.iter().filter_map(|half| {
        let width = half.state.column.width;
        let values = Values::of_clamp(&interface.clamp).and("M", width);
        Some(format!("\n{}", source(half)?.with(&values)))
    });
    texts.collect()
}
