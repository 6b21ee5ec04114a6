//! Runs of an engine from a reset on, with any ready: what shows a difference.

use super::draw::Draw;
use super::expect::{STREAMS, Texts};
use crate::vector::equivalence::miter::range;
use crate::vector::equivalence::netlist::Flat;
use crate::vector::equivalence::simulate::Simulation;
use num_traits::{ToPrimitive, Zero};
use std::fmt::Write as _;

/// Runs that are worked through, clock by clock.
const RUNS: u64 = 120;
/// Triangles in each.
const TRIANGLES: u64 = 3;

/// What became of them.
pub(super) enum Worked {
    /// So many triangles came to an end, with so many records, and all were right.
    Right { triangles: u64, records: u64 },
    /// One was not: its wave.
    Wrong(String),
}

impl Texts<'_> {
    /// The engine, given triangles one after the other as a stream gives them, and what is expected of it.
    pub(super) fn search(&self) -> String {
        let map = self.asked.map;
        let mut text = String::from(
            "// Written by guardbit prove --rtl. An engine, and what is expected of it: bad is high where a record is\n\
             // wrong, or changes before it is taken.\n`default_nettype none\nmodule guardbit_miter (\n    \
             input wire clk,\n    input wire rst,\n    input wire offers,\n    input wire [2:0] readies",
        );
        for word in self.words() {
            let _ = write!(text, ",\n    input wire {}next_{}", range(word.width), word.name);
        }
        text += ",\n    output wire compared,\n    output wire bad\n);\n    reg started = 1'b0;\n    \
                 always @(posedge clk) started <= 1'b1;\n    wire reset = rst || !started;\n    \
                 wire in_valid, span_ready, sample_ready, triangle_ready, begins;\n    wire [2:0] takes;\n    \
                 assign {triangle_ready, sample_ready, span_ready} = readies;\n    \
                 reg waiting = 1'b0;\n";
        for word in self.words() {
            let (name, range) = (word.name, range(word.width));
            let _ = write!(
                text,
                "    reg {range}last_{name};\n    wire {range}{name} = waiting ? last_{name} : next_{name};\n    \
                 always @(posedge clk) last_{name} <= {name};\n    \
                 reg {range}own_{name};\n    always @(posedge clk) if (begins) own_{name} <= {name};\n"
            );
        }
        if !self.has("test") {
            text += "    wire [31:0] own_test = 32'd0;\n";
        }
        let (wires, pins) = self.pins("reset", str::to_owned, "readies", "got_");
        let set = self.asked.module.parameters.iter();
        let set =
            set.map(|(name, value)| format!(".{name}({value})")).collect::<Vec<_>>().join(", ");
        let set = if set.is_empty() { set } else { format!("#({set}) ") };
        let _ = write!(
            text,
            "{wires}    {} {set}device ({pins});\n    assign in_valid = waiting || (offers && !busy);\n    \
             assign begins = in_valid && got_in_ready && !reset;\n    assign takes = got_v & readies;\n    \
             always @(posedge clk) waiting <= !reset && in_valid && !got_in_ready;\n",
            map.module
        );
        text += &self.expected("own_");
        text += "    // A record stands until it is taken.\n    reg [2:0] stood = 3'd0;\n    \
                 always @(posedge clk) stood <= reset ? 3'd0 : got_v & ~readies;\n";
        for field in STREAMS.into_iter().flat_map(|stream| self.fields(stream)) {
            let (name, range) = (field.name, range(field.width));
            let _ = writeln!(
                text,
                "    reg {range}stood_{name};\n    always @(posedge clk) stood_{name} <= got_{name};"
            );
        }
        let _ = write!(
            text,
            "    wire changed = (stood & ~got_v) != 0 || {};\n    assign compared = takes != 0 && !reset;\n    \
             assign bad = started && !reset && (wrong || changed);\n    always @* assert (!bad);\nendmodule\n",
            self.differ("stood", "stood_", "got_")
        );
        text
    }

    /// Works triangles through.
    pub(super) fn work(&self, flat: &Flat) -> Result<Worked, String> {
        let mut simulation = Simulation::new(flat).clocked();
        let mut draw = Draw(7);
        let (mut triangles, mut records) = (0, 0);
        let [columns, rows] = self.window;
        for run in 0..RUNS {
            if run == 4 && triangles == 0 {
                break;
            }
            let mut wave = Wave::new(self, flat);
            let mut number = run * TRIANGLES;
            let (last, mut clock) = (number + TRIANGLES, 0);
            // Some runs are reset in the middle.
            let again = if run % 4 == 3 { 2 + draw.below(24) } else { u64::MAX };
            let mut sides = self.sides(number / 2, &mut draw);
            while number < last && clock < 40 * u64::from(columns * rows + 8) {
                let mut inputs = vec![("rst", i128::from(clock == 0 || clock == again))];
                for word in self.words() {
                    let side = sides.iter().find(|(side, _)| *side == word.name);
                    let value = match (side, word.name) {
                        (Some((_, value)), _) => i128::from(*value),
                        (None, "zero_area") => i128::from(draw.below(16) == 0),
                        // Words that cover most samples, some of them.
                        (None, _) if number.is_multiple_of(3) => {
                            draw.word(word.width) >> (word.width / 2 + 1)
                        }
                        (None, _) => draw.word(word.width),
                    };
                    inputs.push((next(word.name), value));
                }
                let ready = match run % 3 {
                    0 => 7,
                    1 => draw.below(8),
                    _ => draw.below(8) & draw.below(8),
                };
                inputs.push(("readies", ready.into()));
                inputs.push(("offers", i128::from(run % 2 == 0 || draw.below(2) == 0)));
                simulation.set(inputs.iter().copied());
                wave.clock(&mut simulation)?;
                let mut high = |name: &str| read(flat, &mut simulation, name).map(|n| n != 0);
                if high("bad")? {
                    return Ok(Worked::Wrong(wave.text()));
                }
                if high("begins")? {
                    sides = self.sides(number.div_ceil(2), &mut draw);
                }
                records += u64::from(high("compared")?);
                if read(flat, &mut simulation, "takes")? & 4 != 0 && clock != again {
                    (number, triangles) = (number + 1, triangles + 1);
                }
                simulation.clock();
                clock += 1;
            }
        }
        Ok(Worked::Right { triangles, records })
    }
}

/// The input of the miter for a word.
fn next(word: &str) -> &'static str {
    const NAMES: [&str; 18] = [
        "next_test",
        "next_zero_area",
        "next_edge0_init",
        "next_edge0_dx",
        "next_edge0_dy",
        "next_edge1_init",
        "next_edge1_dx",
        "next_edge1_dy",
        "next_edge2_init",
        "next_edge2_dx",
        "next_edge2_dy",
        "next_depth_init",
        "next_depth_dx",
        "next_depth_dy",
        "next_box_y_begin",
        "next_box_y_end",
        "next_box_x_begin",
        "next_box_x_end",
    ];
    NAMES.into_iter().find(|name| &name[5..] == word).unwrap_or_default()
}

fn read(flat: &Flat, simulation: &mut Simulation<'_>, name: &str) -> Result<u128, String> {
    let number = flat.wire(name).and_then(|bits| simulation.number(bits));
    number
        .and_then(|number| number.to_u128())
        .ok_or_else(|| format!("{name}: a cell before it has no plain reading here"))
}

/// The signals of a run, as a file of waves.
struct Wave<'a> {
    flat: &'a Flat,
    signals: Vec<(String, usize)>,
    clocks: Vec<Vec<u128>>,
}

impl<'a> Wave<'a> {
    fn new(texts: &Texts<'_>, flat: &'a Flat) -> Self {
        let mut names = vec![
            "reset".to_owned(),
            "wrong_sample".into(),
            "wrong_span".into(),
            "wrong_triangle".into(),
            "changed".into(),
        ];
        for signal in &texts.asked.unit.signals {
            let name = signal.name;
            names.extend([name.to_owned(), format!("got_{name}"), format!("want_{name}")]);
        }
        let there = names.into_iter().filter_map(|name| {
            let bits = flat.wire(&name)?.len();
            Some((name, bits))
        });
        Self { flat, signals: there.collect(), clocks: Vec::new() }
    }

    fn clock(&mut self, simulation: &mut Simulation<'_>) -> Result<(), String> {
        let now = self.signals.iter().map(|(name, _)| read(self.flat, simulation, name));
        self.clocks.push(now.collect::<Result<_, _>>()?);
        Ok(())
    }

    /// A clock takes ten units, as in the waves of the other units.
    fn text(&self) -> String {
        let mut text = String::from("$timescale 1ns $end\n$scope module guardbit_miter $end\n");
        for (place, (name, bits)) in self.signals.iter().enumerate() {
            let _ = writeln!(text, "$var wire {bits} s{place} {name} $end");
        }
        text += "$upscope $end\n$enddefinitions $end\n";
        for (clock, values) in self.clocks.iter().enumerate() {
            let _ = writeln!(text, "#{}", clock * 10);
            for (place, (value, (_, bits))) in values.iter().zip(&self.signals).enumerate() {
                let _ = if *bits == 1 {
                    writeln!(text, "{}s{place}", u8::from(!value.is_zero()))
                } else {
                    writeln!(text, "b{value:b} s{place}")
                };
            }
        }
        let _ = writeln!(text, "#{}", self.clocks.len() * 10);
        text
    }
}
