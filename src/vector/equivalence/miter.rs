//! The text in which a module and a reference get the same inputs, and their answers are compared.

use super::{Map, Signal};
use std::fmt::Write as _;

fn range(width: u32) -> String {
    if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) }
}

/// The miter of a module with the reference's module `name`.
pub(super) fn text(
    name: &str,
    (map, code_bits): (&Map, u32),
    parameters: &[(String, i64)],
    signals: &[Signal; 6],
) -> String {
    let mut text = String::from(
        "// Written by guardbit prove --rtl. A module and its reference get the same inputs; bad is high where\n\
         // their answers differ, compared where they are looked at.\nmodule guardbit_miter (\n    input wire clk,\n    input wire rst",
    );
    let inputs = signals.iter().filter(|signal| !signal.output);
    let outputs: Vec<&Signal> = signals
        .iter()
        .filter(|signal| signal.output && map.ports.contains_key(signal.name))
        .collect();
    for input in inputs.clone() {
        let _ = write!(text, ",\n    input wire {}{}", range(input.width), input.name);
    }
    text += ",\n    output wire compared,\n    output wire bad\n);\n    // The first clock is a reset.\n    reg started = 1'b0;\n    \
             always @(posedge clk) started <= 1'b1;\n";
    let free = if map.reset.is_some() { "rst || !started" } else { "!started" };
    let _ = writeln!(text, "    wire reset = {free};");
    // The reference.
    let ports: Vec<String> = signals
        .iter()
        .map(|signal| {
            let want = if signal.output {
                format!("want_{}", signal.name)
            } else {
                signal.name.to_owned()
            };
            format!(".{}({want})", signal.port)
        })
        .collect();
    for signal in signals.iter().filter(|signal| signal.output) {
        let _ = writeln!(text, "    wire {}want_{};", range(signal.width), signal.name);
    }
    let _ = writeln!(text, "    {name} reference (.clk(clk), .rst(reset), {});", ports.join(", "));
    // The module.
    let mut pins = vec![format!(".{}(clk)", map.clock)];
    if let Some(reset) = &map.reset {
        let level = if reset.active_low { "!reset" } else { "reset" };
        pins.push(format!(".{}({level})", reset.port));
    }
    for (port, value) in &map.constants {
        pins.push(format!(".{port}(64'd{value})"));
    }
    for signal in inputs {
        let Some(port) = map.ports.get(signal.name) else { continue };
        let given = if signal.name == "op" {
            let [load, step_x, step_y, hold] = map.codes();
            let _ = writeln!(
                text,
                "    wire [31:0] code = op == 2'd0 ? {load} : op == 2'd1 ? {step_x} : op == 2'd2 ? {step_y} : {hold};"
            );
            format!("code[{}:0]", code_bits - 1)
        } else {
            signal.name.to_owned()
        };
        pins.push(format!(".{port}({given})"));
    }
    for output in &outputs {
        let _ = writeln!(text, "    wire {}got_{};", range(output.width), output.name);
        pins.push(format!(".{}(got_{})", map.ports[output.name], output.name));
    }
    let set: Vec<String> =
        parameters.iter().map(|(name, value)| format!(".{name}({value})")).collect();
    let set = if set.is_empty() { String::new() } else { format!("#({}) ", set.join(", ")) };
    let _ = writeln!(text, "    {} {set}device ({});", map.module, pins.join(", "));
    // What the reference answered some clocks ago.
    let late = |name: &str, clocks: u32| {
        if clocks == 0 { format!("want_{name}") } else { format!("want_{name}_{clocks}") }
    };
    for output in &outputs {
        for clocks in 1..=map.latency {
            let (now, before) = (late(output.name, clocks), late(output.name, clocks - 1));
            let _ = writeln!(
                text,
                "    reg {}{now};\n    always @(posedge clk) {now} <= {before};",
                range(output.width)
            );
        }
    }
    let differ: Vec<String> = outputs
        .iter()
        .map(|output| format!("got_{} != {}", output.name, late(output.name, map.latency)))
        .collect();
    let known = if map.reset.is_some() {
        "    wire known = started;\n".to_owned()
    } else {
        "    // Without a reset the register is known once it has been loaded.\n    reg known = 1'b0;\n    \
         always @(posedge clk) known <= known || (started && op == 2'd0);\n"
            .to_owned()
    };
    let _ = write!(
        text,
        "{known}    // Clocks since then, and since the last reset: what is under way is not compared.\n    \
         reg [6:0] age = 7'd0;\n    \
         always @(posedge clk) age <= reset || !known ? 7'd0 : age == 7'd{0} ? age : age + 7'd1;\n    \
         assign compared = known && !reset && age == 7'd{0};\n    assign bad = compared && ({1});\n    always @* assert (!bad);\nendmodule\n",
        map.latency,
        differ.join(" || ")
    );
    text
}
