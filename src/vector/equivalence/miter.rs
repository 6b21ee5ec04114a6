//! The text in which a module and a reference get the same inputs, and their answers are compared.

use super::{Asked, Signal};
use std::fmt::Write as _;

pub(super) fn range(width: u32) -> String {
    if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) }
}

/// How inputs stand still that change with a load alone: as registers of the module may hold them, so that a solver
/// finds the two alike. Both say the same where answers are compared.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Held {
    /// In registers that a load fills, zero before; then the module's own inputs are anything before the first load.
    Loaded,
    /// In registers that follow the inputs.
    Followed,
}

/// The miter of a question.
pub(super) struct Miter<'a>(pub(super) &'a Asked<'a>, pub(super) Held);

impl Miter<'_> {
    /// The miter of the module with the reference's module `name`.
    pub(super) fn text(&self, name: &str) -> String {
        [self.head(), self.reference(name), self.device(), self.compared()].concat()
    }

    fn inputs(&self) -> impl Iterator<Item = &Signal> {
        self.0.unit.signals.iter().filter(|signal| !signal.output)
    }

    /// The outputs that are compared.
    fn outputs(&self) -> impl Iterator<Item = &Signal> {
        let signals = self.0.unit.signals.iter();
        signals.filter(|signal| signal.output && self.0.map.ports.contains_key(signal.name))
    }

    fn is_held(&self, signal: &Signal) -> bool {
        self.0.map.held && signal.name != "op"
    }

    fn is_clocked(&self) -> bool {
        !self.0.unit.block.operations().is_empty()
    }

    /// Ports, the first clock, and inputs that stand still.
    fn head(&self) -> String {
        let mut text = String::from(
            "// Written by guardbit prove --rtl. A module and its reference get the same inputs; bad is high where\n\
             // their answers differ, compared where they are looked at.\nmodule guardbit_miter (\n    \
             input wire clk,\n    input wire rst",
        );
        for input in self.inputs() {
            let next = if self.is_held(input) { "next_" } else { "" };
            let _ = write!(text, ",\n    input wire {}{next}{}", range(input.width), input.name);
        }
        let free = if self.0.map.reset.is_some() { "rst || !started" } else { "!started" };
        let _ = writeln!(
            text,
            ",\n    output wire compared,\n    output wire bad\n);\n    // The first clock is a reset.\n    \
             reg started = 1'b0;\n    always @(posedge clk) started <= 1'b1;\n    wire reset = {free};"
        );
        text += if self.is_clocked() && self.0.map.awaits_a_load() {
            "    // The registers are known once they have been loaded.\n    reg known = 1'b0;\n    \
             always @(posedge clk) known <= !reset && (known || op == 2'd0);\n"
        } else {
            "    wire known = started;\n"
        };
        for input in self.inputs().filter(|input| self.is_held(input)) {
            let (name, width, range) = (input.name, input.width, range(input.width));
            let _ = writeln!(text, "    reg {range}last_{name};");
            let _ = match self.1 {
                Held::Loaded => writeln!(
                    text,
                    "    wire {range}{name} = op == 2'd0 ? next_{name} : last_{name};\n    \
                     wire {range}own_{name} = known ? {name} : next_{name};\n    \
                     always @(posedge clk) last_{name} <= reset ? {width}'d0 : {name};"
                ),
                Held::Followed => writeln!(
                    text,
                    "    wire {range}{name} = op == 2'd0 ? next_{name} : last_{name};\n    \
                     wire {range}own_{name} = {name};\n    \
                     always @(posedge clk) last_{name} <= {name};"
                ),
            };
        }
        text
    }

    fn reference(&self, name: &str) -> String {
        let mut text = String::new();
        let mut ports = Vec::new();
        if self.is_clocked() {
            ports.push(".clk(clk), .rst(reset)".to_owned());
        }
        for signal in &self.0.unit.signals {
            let want = if signal.output { "want_" } else { "" };
            ports.push(format!(".{}({want}{})", signal.port, signal.name));
            if signal.output {
                let _ = writeln!(text, "    wire {}want_{};", range(signal.width), signal.name);
            }
        }
        let _ = writeln!(text, "    {name} reference ({});", ports.join(", "));
        text
    }

    fn device(&self) -> String {
        let map = self.0.map;
        let mut text = String::new();
        let mut pins: Vec<String> =
            self.0.wiring.clock.iter().map(|clock| format!(".{clock}(clk)")).collect();
        if let Some(reset) = &map.reset {
            let level = if reset.active_low { "!reset" } else { "reset" };
            pins.push(format!(".{}({level})", reset.port));
        }
        for (port, value) in &map.constants {
            pins.push(format!(".{port}(64'd{value})"));
        }
        for signal in self.inputs() {
            let Some(port) = map.ports.get(signal.name) else { continue };
            let given = if signal.name == "op" {
                let codes = map.codes(self.0.unit);
                let last = codes.len() - 1;
                let chosen = codes[..last].iter().enumerate();
                text += "    wire [31:0] code = ";
                for (op, code) in chosen {
                    let _ = write!(text, "op == 2'd{op} ? {code} : ");
                }
                let _ = writeln!(text, "{};", codes[last]);
                format!("code[{}:0]", self.0.wiring.code_bits - 1)
            } else if self.is_held(signal) {
                format!("own_{}", signal.name)
            } else {
                signal.name.to_owned()
            };
            pins.push(format!(".{port}({given})"));
        }
        for output in self.outputs() {
            let _ = writeln!(text, "    wire {}got_{};", range(output.width), output.name);
            pins.push(format!(".{}(got_{})", map.ports[output.name], output.name));
        }
        let set = self.0.module.parameters.iter().map(|(name, value)| format!(".{name}({value})"));
        let set = set.collect::<Vec<_>>().join(", ");
        let set = if set.is_empty() { set } else { format!("#({set}) ") };
        let _ = writeln!(text, "    {} {set}device ({});", map.module, pins.join(", "));
        text
    }

    /// Where the answers are looked at, and what differs there.
    fn compared(&self) -> String {
        let map = self.0.map;
        let mut text = String::new();
        // What the reference answered some clocks ago.
        let late = |name: &str, clocks: u32| {
            if clocks == 0 { format!("want_{name}") } else { format!("want_{name}_{clocks}") }
        };
        for output in self.outputs() {
            for clocks in 1..=map.latency {
                let (now, before) = (late(output.name, clocks), late(output.name, clocks - 1));
                let _ = writeln!(
                    text,
                    "    reg {}{now};\n    always @(posedge clk) {now} <= {before};",
                    range(output.width)
                );
            }
        }
        let differ = self
            .outputs()
            .map(|output| format!("got_{} != {}", output.name, late(output.name, map.latency)));
        let differ = differ.collect::<Vec<_>>().join(" || ");
        let latency = map.latency;
        let _ = write!(
            text,
            "    // Clocks since then, and since the last reset: what is under way is not compared.\n    \
             reg [6:0] age = 7'd0;\n    \
             always @(posedge clk) age <= reset || !known ? 7'd0 : age == 7'd{latency} ? age : age + 7'd1;\n    \
             assign compared = known && !reset && age == 7'd{latency};\n    \
             assign bad = compared && ({differ});\n    always @* assert (!bad);\nendmodule\n"
        );
        text
    }
}
