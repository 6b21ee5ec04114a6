//! The proof of an engine for a box: a triangle with every ready high, and at each clock any other.

use super::expect::Texts;
use crate::vector::equivalence::miter::range;
use std::fmt::Write as _;

/// Bits of the register that holds the box, for each of its sides.
pub(super) const SIDE: u32 = 5;
/// Bits of all sides.
pub(super) const SIDES_BITS: u32 = 4 * SIDE;
/// Bits above them for the number of clocks within which a triangle has to end.
pub(super) const LIMIT: u32 = 16;
/// The sides of a box, lowest bits first.
pub(super) const SIDES: [&str; 4] = ["box_y_begin", "box_y_end", "box_x_begin", "box_x_end"];

impl Texts<'_> {
    /// The miter. `known` has the bits of the state that are known where a triangle begins, and their values.
    #[expect(clippy::too_many_lines, reason = "one text, from top to bottom")]
    pub(super) fn induction(&self, known: &[Option<bool>]) -> String {
        let size = known.len();
        let mut text = String::from(
            "// Written by guardbit prove --rtl. A triangle in a box, with every ready high, from any state that agrees\n\
             // with the known bits; at each clock the same state with any other ready.\n`default_nettype none\n\
             module guardbit_miter (\n    input wire clk",
        );
        for junk in ["j_", "a_", "b_"] {
            for word in self.words() {
                let _ = write!(text, ",\n    input wire {}{junk}{}", range(word.width), word.name);
            }
        }
        let bits = |of: fn(&Option<bool>) -> bool| -> String {
            known.iter().rev().map(|bit| if of(bit) { '1' } else { '0' }).collect()
        };
        let [mask, first] = [bits(Option::is_some), bits(|bit| *bit == Some(true))];
        let top = size - 1;
        let _ = write!(
            text,
            ",\n    input wire [{top}:0] any,\n    input wire a_valid, b_valid, c_valid,\n    \
             input wire [2:0] a_ready, b_ready, c_ready,\n    output wire compared,\n    output wire bad\n);\n    \
             reg started = 1'b0;\n    always @(posedge clk) started <= 1'b1;\n    wire reset = 1'b0;\n    \
             wire [{top}:0] known = {size}'b{mask};\n    wire [{top}:0] first = {size}'b{first};\n    \
             reg [{top}:0] held;\n    wire [{top}:0] state = started ? held : (any & ~known | first);\n    \
             reg taken = 1'b0, done = 1'b0, closed = 1'b0;\n    reg [15:0] clock = 16'd0;\n    \
             reg [{0}:0] guardbit_box = 0;\n    always @(posedge clk) guardbit_box <= guardbit_box;\n",
            SIDES_BITS + LIMIT - 1
        );
        for word in self.words() {
            let (name, range) = (word.name, range(word.width));
            let _ = match SIDES.iter().position(|side| *side == name) {
                Some(place) => {
                    let low = u32::try_from(place).unwrap_or_default() * SIDE;
                    writeln!(
                        text,
                        "    wire {range}{name} = guardbit_box[{}:{low}];",
                        low + SIDE - 1
                    )
                }
                None => writeln!(
                    text,
                    "    reg {range}{name};\n    always @(posedge clk) {name} <= {name};"
                ),
            };
        }
        if !self.has("test") {
            text += "    wire [31:0] test = 32'd0;\n";
        }
        text += "    wire [2:0] takes, a_taken, b_taken, one_ready, two_ready, left;\n    wire begins;\n";
        let own = |valid: &'static str, junk: &'static str| {
            move |name: &str| match name {
                "in_valid" => valid.to_owned(),
                _ => format!("(!taken && {valid}) ? {name} : {junk}{name}"),
            }
        };
        for (name, state, (valid, junk), ready, reset) in [
            ("got_", "state", ("!taken", "j_"), "3'b111", "1'b0"),
            ("reset_", "any", ("c_valid", "j_"), "c_ready", "1'b1"),
            ("a_got_", "state", ("a_valid", "a_"), "a_ready", "1'b0"),
            ("b_got_", "a_got_next", ("b_valid", "b_"), "b_ready", "1'b0"),
            ("one_", "state", ("!taken", "j_"), "one_ready", "1'b0"),
            ("two_", "state", ("!taken", "j_"), "two_ready", "1'b0"),
        ] {
            let bus = match ready.strip_prefix("3'b") {
                Some(_) => {
                    text += "    wire [2:0] every = 3'b111;\n";
                    "every"
                }
                None => ready,
            };
            let (wires, pins) = self.pins(reset, own(valid, junk), bus, name);
            let _ = write!(
                text,
                "{wires}    wire [{top}:0] {name}next;\n    guardbit_core core_{name} ({pins}, \
                 .guardbit_state({state}), .guardbit_next({name}next));\n"
            );
        }
        text += "    assign takes = got_v;\n    assign begins = !taken && got_in_ready;\n";
        text += &self.expected("");
        let _ = write!(
            text,
            "    // Another ready, or nothing valid at the input: what is taken does not matter for what comes.\n    \
             assign a_taken = got_v & a_ready;\n    assign left = got_v & ~a_taken;\n    \
             assign b_taken = a_taken | (got_v & b_ready);\n    assign one_ready = a_taken | ~got_v;\n    \
             assign two_ready = b_taken | ~got_v;\n    wire waits = got_in_ready && !a_valid;\n    \
             wire unlike_a = a_got_v != got_v || a_got_in_ready != got_in_ready || {0};\n    \
             wire unlike_b = b_got_v != left || b_got_in_ready != got_in_ready || {1};\n    \
             wire uneven = unlike_a || (waits ? a_got_next != state : a_got_next != one_next)\n        \
             || (!waits && left != 0 && (unlike_b || b_got_next != two_next));\n    \
             // Where the triangle has ended and another one may come, the state agrees with the known bits again.\n    \
             wire closes = done && got_in_ready;\n    wire early = busy && got_in_ready;\n    \
             wire open = closes && (state & known) != first;\n    \
             wire unreset = !started && (reset_next & known) != first;\n    \
             wire endless = clock == guardbit_box[{2}:{3}] && !closed;\n    \
             assign compared = got_v[0] || got_v[1];\n    \
             assign bad = !closed && (wrong || early || open || (uneven && !closes)) || endless || unreset;\n    \
             always @(posedge clk) begin\n        held <= got_next;\n        clock <= clock + 16'd1;\n        \
             taken <= taken || begins;\n        done <= done || got_v[2];\n        closed <= closed || closes;\n    end\n    \
             always @* assert (!bad);\nendmodule\n",
            self.differ("got_v", "a_got_", "got_"),
            self.differ("left", "b_got_", "got_"),
            SIDES_BITS + LIMIT - 1,
            SIDES_BITS,
        );
        text
    }
}
