//! The texts in each language.

use super::{Parts, up};
use crate::format::{Clamp, ReadOut};
use crate::vector::package::identifier;
use crate::vector::reference::package;

/// An item so many times, between commas.
fn times(count: usize, item: &str) -> String {
    vec![item; count].join(", ")
}

/// The verb behind a unit.
fn differs(unit: &str) -> &'static str {
    if unit.ends_with('s') { "differ" } else { "differs" }
}

impl Parts<'_> {
    fn clamp(&self) -> Clamp {
        self.shape.depth.map_or(Clamp::Wrap, |depth| depth.clamp)
    }

    /// Every word and product of a valid profile fits 128 bits (clause `P-5`).
    pub(in crate::vector::reference) fn c(&self, plus: bool) -> String {
        let id = identifier(&self.profile.name);
        let upper = format!("{}_", id.to_uppercase());
        let prefix = if plus { String::new() } else { format!("{id}_") };
        let scope = if plus { format!("{id}::") } else { prefix.clone() };
        let word = |width| if width > 64 { format!("{prefix}bits") } else { "uint64_t".to_owned() };
        let digests: Vec<_> =
            self.digests.iter().map(|digest| format!("0x{digest:016x}u")).collect();
        let read = match self.clamp() {
            Clamp::Guard | Clamp::Error => {
                "    const @P@bits middle = ((@P@bits)1 << (@K@GUARD + @K@INTEGER - 1)) + (whole >> 1);\n    \
                 if (u >= whole) return u >= middle ? 0 : (uint64_t)(whole - 1);"
            }
            Clamp::Sign => {
                "    if ((acc >> (@K@DEPTH_BITS - 1) & 1) != 0) return 0;\n    \
                 if (u >= whole) return (uint64_t)(whole - 1);"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        let step = word(self.shape.step_read().width());
        let depth = self.shape.depth_read();
        let flags = self.shape.flags();
        let has = |flag: &str| flags.contains(&flag);
        let edge = if has("plain_edges") { "{0, 0, 0}" } else { "{0, 0, 0, 0, 0}" };
        let plane = if depth.is_some() { ", {0, 0, 0}" } else { "" };
        let empty = format!("{{{{{}}}{plane}, 1}}", times(3, edge));
        let places: Vec<_> = self.places().iter().map(|[x, y]| format!("{{{x}, {y}}}")).collect();
        let several = self.shape.several;
        let (last, others) = bits(&self.shape.units());
        let complaints = self.complaints(|unit, bit| {
            format!("    if (wrong & {bit}) puts(\"{unit} {}\");\n", differs(unit))
        });
        let quotients = self.quotients(include_str!("../divide.c.in"), up);
        self.fill(
            &include_str!("../c.in").replace("@RANDOM@\n", include_str!("../random.c.in")),
            &[
                ("OPEN", &if plus { format!("namespace {id} {{") } else { String::new() }),
                ("CLOSE", if plus { "}" } else { "" }),
                ("DIVIDES", &quotients),
                ("FN", if plus { "constexpr" } else { "static inline" }),
                ("CONST", if plus { "constexpr" } else { "const" }),
                ("ZERO", if plus { "{}" } else { "{0}" }),
                ("READ_OUT", read),
                ("EDGE", &step),
                ("XWORD", &step),
                ("WORD", &word(depth.map_or(1, ReadOut::width))),
                ("EXPECTED", &digests.join(", ")),
                ("ZEROS", &times(digests.len(), "0")),
                ("EMPTY", &empty),
                ("E0", edge),
                ("V0", if depth.is_some() { "{0, 0, 0}" } else { "{0, 0}" }),
                ("SX", if several { "@P@samples[n][0]" } else { "@K@SAMPLE_X" }),
                ("SY", if several { "@P@samples[n][1]" } else { "@K@SAMPLE_Y" }),
                ("NUMBER", if several { ", int n" } else { "" }),
                ("PASS", if several { ", n" } else { "" }),
                ("PLACES", &places.len().to_string()),
                ("POSITIONS", &places.join(", ")),
                ("KINDS", if has("rich") { "7" } else { "3" }),
                ("BOXED", if has("edges") { "1" } else { "0" }),
                ("BIT_LIST", &format!("{others},\n   {last}")),
                ("COMPLAINTS", &complaints),
                ("P", &prefix),
                ("K", &upper),
                ("Q", &scope),
            ],
        )
    }

    pub(in crate::vector::reference) fn python(&self) -> String {
        let read = match self.clamp() {
            Clamp::Guard | Clamp::Error => {
                "    if u >= whole:\n        \
                 return 0 if u >= (1 << GUARD + INTEGER >> 1) + (whole >> 1) else whole - 1"
            }
            Clamp::Sign => {
                "    if acc >> (DEPTH_BITS - 1):\n        return 0\n    \
                 if u >= whole:\n        return whole - 1"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        let digests: Vec<_> =
            self.digests.iter().map(|digest| format!("0x{digest:016X}")).collect();
        let python =
            |text: &str| text.replace("||", "or").replace("&&", "and").replace('!', "not ");
        let quotients =
            self.quotients(include_str!("../divide.py.in"), |rounding| python(&up(rounding)));
        let places: Vec<_> = self.places().iter().map(|[x, y]| format!("({x}, {y})")).collect();
        let units: Vec<_> = self.shape.units().iter().map(|unit| format!("\"{unit}\"")).collect();
        let several = self.shape.several;
        self.fill(
            &include_str!("../py.in").replace("@RANDOM@\n", include_str!("../random.py.in")),
            &[
                ("DIVIDES", &quotients),
                ("READ_OUT", read),
                ("EXPECTED", &digests.join(", ")),
                ("OWNS", &python(self.shape.owns())),
                ("SX", if several { "PLACES[n][0]" } else { "SAMPLE_X" }),
                ("SY", if several { "PLACES[n][1]" } else { "SAMPLE_Y" }),
                ("NUMBER", if several { ", n" } else { "" }),
                ("BOX_NUMBER", if several { ", n" } else { "" }),
                ("PASS", if several { ", n" } else { "" }),
                ("POSITIONS", &places.join(", ")),
                ("UNIT_NAMES", &units.join(", ")),
                ("V0", if self.shape.depth.is_some() { "(0, 0, 0)" } else { "(0, 0)" }),
            ],
        )
    }

    pub(in crate::vector::reference) fn systemverilog(&self) -> String {
        let read = match self.clamp() {
            Clamp::Guard | Clamp::Error => {
                "            \
                 if (u >= WHOLE) read_out = u >= (WHOLE << G >> 1) + (WHOLE >> 1) ? {I{1'b0}} : {I{1'b1}};"
            }
            Clamp::Sign => {
                "            if (acc[N-1]) read_out = {I{1'b0}};\n            \
                 else if (u >= WHOLE) read_out = {I{1'b1}};"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        let lines = |axis: usize| -> String {
            let places = self.places();
            let last = places.len() - 1;
            let line = |(n, place): (usize, &[i128; 2])| {
                let (label, at) =
                    (if n == last { "default".to_owned() } else { n.to_string() }, place[axis]);
                format!("            {label}: place_{} = {at};\n", ["x", "y"][axis])
            };
            places.iter().enumerate().map(line).collect()
        };
        let expected: Vec<_> = self
            .digests
            .iter()
            .enumerate()
            .map(|(n, digest)| format!("expected[{n}] = 64'h{digest:016x};"))
            .collect();
        let complaints = self.complaints(|unit, bit| {
            format!(
                "            if ((wrong & {bit}) != 0) $display(\"{unit} {}\");\n",
                differs(unit)
            )
        });
        let flags = self.shape.flags();
        let has = |flag: &str| flags.contains(&flag);
        let (edges, depth, several) = (has("edges"), has("depth"), self.shape.several);
        let parameters = |names: &[(&str, bool)]| {
            let package = package(self.profile);
            let list = names.iter().filter(|(_, used)| *used);
            list.map(|(name, _)| format!("{name} = {package}::{name}"))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let word = [("M", edges), ("W", !edges)];
        let [m, w] = word;
        let mut set_up = parameters(&[
            ("D", true),
            m,
            w,
            ("N", depth),
            ("I", depth),
            ("P", true),
            ("Q", depth),
            ("F", depth),
            ("S", depth),
        ]);
        if several {
            set_up += ", SAMPLE = 0";
        }
        let sample = parameters(&[m, ("W", !edges), ("N", depth), ("I", depth)]);
        let pixel = parameters(&[("D", true), m, ("N", depth), ("I", depth), ("SAMPLES", true)]);
        let package = package(self.profile);
        let words = spoken(edges, depth);
        let quotients = self.quotients(include_str!("../divide.sv.in"), up);
        let (expected, columns, rows) = (expected.join(" "), lines(0), lines(1));
        let own: &[(&str, &str)] = &[
            ("DIVIDES", &quotients),
            ("READ_OUT", read),
            ("EXPECTED", &expected),
            ("COMPLAINTS", &complaints),
            ("CASES_X", &columns),
            ("CASES_Y", &rows),
            ("SX0", if several { "@P@::place_x(0)" } else { "SAMPLE_X" }),
            ("SY0", if several { "@P@::place_y(0)" } else { "SAMPLE_Y" }),
            ("SX", if several { "place_x(n)" } else { "SAMPLE_X" }),
            ("SY", if several { "place_y(n)" } else { "SAMPLE_Y" }),
            ("NUMBER", if several { ", input int n" } else { "" }),
            ("PASS", if several { ", SAMPLE" } else { "" }),
            ("SETUP_PARAMETERS", &set_up),
            ("SAMPLE_PARAMETERS", &sample),
            ("PIXEL_PARAMETERS", &pixel),
            ("P", &package),
        ];
        self.fill(include_str!("../sv.in"), &[&words, own].concat())
    }
}

/// The units and their bits: the last, and those before it.
fn bits(units: &[&str]) -> (String, String) {
    let mut list: Vec<_> =
        units.iter().enumerate().map(|(n, unit)| format!("{} {unit}", 1 << n)).collect();
    (list.pop().unwrap_or_default(), list.join(", "))
}

/// What the SystemVerilog text says in comments, with edge words or without, and with depth or without.
fn spoken(edges: bool, depth: bool) -> [(&'static str, &'static str); 5] {
    [
        (
            "SETUP_CLAUSES",
            match (edges, depth) {
                (true, true) => "T-3, E, P",
                (true, false) => "T-3, E",
                (false, true) => "T-3, K, P",
                (false, false) => "T-3, K",
            },
        ),
        (
            "AT_CLAUSES",
            match (edges, depth) {
                (true, true) => "C-5, P-2",
                (true, false) => "C-5",
                _ => "P-2",
            },
        ),
        (
            "REGISTERS",
            match (edges, depth) {
                (true, true) => "An accumulator and an edge word",
                (true, false) => "An edge word",
                _ => "An accumulator",
            },
        ),
        (
            "EVALUATED",
            if depth { "An edge function and a depth plane" } else { "An edge function" },
        ),
        ("OF_WHAT", if edges { "its box" } else { "the window" }),
    ]
}
