//! Long division as hardware, and a module in step with it.

use super::Division;
use crate::vector::equivalence::Map;
use crate::vector::equivalence::map::{Steps, Wiring};
use crate::vector::equivalence::miter::range;
use crate::vector::equivalence::netlist::Port;
use crate::vector::reference::rounds_up;
use std::fmt::Write as _;

impl Division<'_> {
    /// The module and long division with the same operands. `bad` is high where a lemma does not hold, or the
    /// quotient differs where it is looked at.
    pub(super) fn miter(&self, map: &Map, wiring: &Wiring, wires: &[(&str, Port)]) -> String {
        let [n, d] = [self.numerator, self.divisor];
        let mut text = format!(
            "// Written by guardbit prove --rtl. A divider and long division in step: bad is high where their quotients\n\
             // differ, or a lemma on the divider's registers does not hold.\n`default_nettype none\nmodule guardbit_miter (\n    \
             input wire clk,\n    input wire rst,\n    input wire start,\n    input wire {}numerator,\n    \
             input wire {}divisor,\n    output wire compared,\n    output wire bad\n);\n    \
             reg started = 1'b0;\n    always @(posedge clk) started <= 1'b1;\n    \
             wire reset = rst || !started;\n    wire {}got_quotient;\n",
            range(n),
            range(d),
            range(n)
        );
        let waits = !map.ports.contains_key("busy");
        text += if waits {
            "    wire got_done;\n    reg ref_pending;\n    wire takes = start && !ref_pending;\n    \
             always @(posedge clk) ref_pending <= !reset && (takes || (ref_pending && !got_done));\n    \
             wire ends = got_done;\n"
        } else {
            "    wire got_busy;\n    wire takes = start && !got_busy;\n    wire ends = !got_busy;\n"
        };
        self.reference(&mut text);
        device(&mut text, map, wiring, wires);
        let spurious = if waits { " || (got_done && !ref_pending)" } else { "" };
        let mut lemmas = String::new();
        for (place, lemma) in self.steps.lemmas.iter().enumerate() {
            let _ = writeln!(text, "    wire lemma_{place} = ({lemma}) != 0;");
            let _ = write!(lemmas, " || !lemma_{place}");
        }
        let _ = write!(
            text,
            "    assign compared = ref_known && ends && !reset;\n    assign bad = started && !reset\n        \
             && ((compared && (ref_left != 0 || ref_wait != 0 || got_quotient != want_quotient)){spurious}{lemmas});\n    \
             always @* assert (!bad);\nendmodule\n"
        );
        text
    }

    /// Long division: each bit of the magnitude, highest first, follows the remainder; the divisor is taken away
    /// where it fits.
    fn reference(&self, text: &mut String) {
        let &Steps { bits_per_clock: k, lead, merged, .. } = self.steps;
        let ([n, d], steps) = ([self.numerator, self.divisor], self.clocks());
        let w = steps * k;
        let last = w - 1;
        let rest = if merged { String::new() } else { format!("    reg [{last}:0] ref_rest;\n") };
        let _ = write!(
            text,
            "    // Long division, {k} bits a clock.\n    reg ref_known, ref_negative;\n    reg [7:0] ref_left, ref_wait;\n    \
             reg [{last}:0] ref_quotient;\n{rest}    reg [{d}:0] ref_remainder;\n    reg {0}ref_divisor;\n    \
             wire [{1}:0] magnitude = numerator[{1}] ? -numerator : numerator;\n    \
             wire works = ref_wait == 0 && ref_left != 0;\n    wire [{d}:0] r_0 = ref_remainder;\n",
            range(d),
            n - 1
        );
        let from = if merged { "ref_quotient" } else { "ref_rest" };
        let mut digits = Vec::new();
        for step in 0..k {
            let bit = w - 1 - step;
            let (below, next) = (d - 1, step + 1);
            let low = if d == 1 { format!("r_{step}[0]") } else { format!("r_{step}[{below}:0]") };
            let _ = write!(
                text,
                "    wire [{d}:0] n_{step} = {{{low}, {from}[{bit}]}};\n    \
                 wire f_{step} = n_{step} >= {{1'b0, ref_divisor}};\n    \
                 wire [{d}:0] r_{next} = f_{step} ? n_{step} - {{1'b0, ref_divisor}} : n_{step};\n"
            );
            digits.push(format!("f_{step}"));
        }
        let digits = digits.join(", ");
        let quotient = if w == k {
            format!("{{{digits}}}")
        } else {
            format!("{{ref_quotient[{}:0], {digits}}}", w - k - 1)
        };
        let (start, rest, rests, reset) = if merged {
            ("magnitude", "", String::new(), "")
        } else {
            let shifts = format!("            ref_rest <= ref_rest << {k};\n");
            ("0", "            ref_rest <= magnitude;\n", shifts, " ref_rest <= 0;")
        };
        let _ = write!(
            text,
            "    always @(posedge clk)\n        if (reset) begin\n            ref_known <= 0; ref_negative <= 0; ref_left <= 0; \
             ref_wait <= 0; ref_quotient <= 0; ref_remainder <= 0; ref_divisor <= 0;{reset}\n        end\n        \
             else if (takes) begin\n            ref_known <= divisor != 0;\n            \
             ref_negative <= numerator[{0}];\n            ref_left <= {steps};\n            ref_wait <= {lead};\n            \
             ref_quotient <= {start};\n{rest}            ref_remainder <= 0;\n            ref_divisor <= divisor;\n        \
             end\n        else if (ref_wait != 0) ref_wait <= ref_wait - 1'b1;\n        else if (works) begin\n            \
             ref_left <= ref_left - 1'b1;\n            ref_quotient <= {quotient};\n{rests}            \
             ref_remainder <= r_{k};\n        end\n    \
             // Rounded: {1}.\n    wire negative = ref_negative;\n    wire inexact = ref_remainder != 0;\n    \
             wire over = {{ref_remainder, 1'b0}} > {{2'b00, ref_divisor}};\n    \
             wire tie = {{ref_remainder, 1'b0}} == {{2'b00, ref_divisor}};\n    wire odd = ref_quotient[0];\n    \
             wire up = {2};\n    wire [{0}:0] raised = ref_quotient + up;\n    \
             wire [{0}:0] want_quotient = negative ? -raised : raised;\n",
            n - 1,
            self.rounding,
            rounds_up(self.rounding)
        );
    }
}

/// The module, with its wires that lemmas name.
fn device(text: &mut String, map: &Map, wiring: &Wiring, wires: &[(&str, Port)]) {
    let mut pins: Vec<String> = wiring.clock.iter().map(|clock| format!(".{clock}(clk)")).collect();
    if let Some(reset) = &map.reset {
        let level = if reset.active_low { "!reset" } else { "reset" };
        pins.push(format!(".{}({level})", reset.port));
    }
    pins.extend(map.constants.iter().map(|(port, value)| format!(".{port}(64'd{value})")));
    let start = if map.ports.contains_key("busy") { "start" } else { "takes" };
    for (signal, with) in [
        ("start", start),
        ("numerator", "numerator"),
        ("divisor", "divisor"),
        ("quotient", "got_quotient"),
        ("busy", "got_busy"),
        ("done", "got_done"),
    ] {
        if let Some(port) = map.ports.get(signal) {
            pins.push(format!(".{port}({with})"));
        }
    }
    for (name, port) in wires {
        let _ = writeln!(text, "    wire {}{name};", range(port.width));
        pins.push(format!(".\\{} ({name})", port.name));
    }
    let _ = writeln!(text, "    guardbit_device device ({});", pins.join(", "));
}
