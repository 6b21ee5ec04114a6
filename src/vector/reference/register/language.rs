//! The texts of registers in each language.

use super::RegisterText;
use crate::format::{Clamp, Layout};
use crate::vector::package::identifier;
use crate::vector::reference::CASES;
use crate::vector::reference::parts::up;

impl RegisterText<'_> {
    pub(super) fn c(&self, plus: bool) -> String {
        let id = identifier(&self.profile.name);
        let upper = format!("{}_", id.to_uppercase());
        let prefix = if plus { String::new() } else { format!("{id}_") };
        let scope = if plus { format!("{id}::") } else { prefix.clone() };
        let (mut reads, mut writes) = (Vec::new(), Vec::new());
        for port in self.engine.ports() {
            let pieces = pieces(self.input(), &port.name);
            let bits = pieces.iter().map(|piece| piece.from + piece.width).max().unwrap_or(1);
            let term = |p: &Piece| format!("(uint64_t){}", p.taken("u"));
            let value = pieces.iter().map(term).collect::<Vec<_>>().join(" | ");
            let value = if port.signed {
                format!("@P@sign({value}, {bits})")
            } else if port.c.contains("value") {
                value
            } else {
                format!("(int64_t)({value})")
            };
            reads.push(format!("    {} = {value};\n", port.c));
            for p in pieces {
                let (keep, put) = (p.keep("u"), p.placed(&format!("(uint64_t){}", port.c), "u"));
                writes.push(format!(
                    "    words[{0}] = (words[{0}] & {keep}) | (uint32_t){put};\n",
                    p.word
                ));
            }
        }
        let (reads, writes) = (reads.concat(), writes.concat());
        let before = usize::from(self.records().len() > 1);
        let [packs, packs1] = self.packs(|word, parts| {
            let term = |(value, p): &((String, String), Piece)| {
                format!("(uint32_t){}", p.placed(&value.0, "u"))
            };
            format!(
                "    record[{}] = {};\n",
                word + before,
                parts.iter().map(term).collect::<Vec<_>>().join(" | ")
            )
        });
        let read = self.read_out(
            |number| format!("@P@formats[c][3] == {number} && "),
            [
                "    const @P@bits middle = ((@P@bits)1 << (guard + integer - 1)) + (whole >> 1);\n    \
                 if (@IF@u >= whole) return u >= middle ? 0 : (uint64_t)(whole - 1);\n",
                "    if (@IF@(acc >> (guard + integer + fraction - 1) & 1) != 0) return 0;\n    \
                 if (@IF@u >= whole) return (uint64_t)(whole - 1);\n",
            ],
        );
        let engine = self.engine.keys(true);
        let own = engine.iter().map(|(key, value)| (*key, value.as_str()));
        let up = self.rounding.map_or_else(String::new, up);
        self.fill(
            include_str!("../register.c.in"),
            [
                self.engine.templates()[0],
                include_str!("../random.c.in"),
                include_str!("../divide.c.in"),
            ],
            &own.chain([
                ("OWN_UP", up.as_str()),
                ("OPEN", &if plus { format!("namespace {id} {{") } else { String::new() }),
                ("CLOSE", if plus { "}" } else { "" }),
                ("FN", if plus { "constexpr" } else { "static inline" }),
                // A compiler would try to run a constexpr self test while it compiles.
                ("TRIAL", if plus { "inline" } else { "static inline" }),
                ("CONST", if plus { "constexpr" } else { "const" }),
                ("ZERO", if plus { "{}" } else { "{0}" }),
                ("FORMATS", &self.formats('{', '}')),
                ("READS", reads.trim_end()),
                ("WRITES", writes.trim_end()),
                ("PACKS", packs.trim_end()),
                ("PACKS1", packs1.trim_end()),
                ("V0", "{0, 0}"),
                ("READ_OUT", read.trim_end()),
                ("EXPECTED", &format!("0x{:016x}u", self.digest(1, CASES))),
                ("P", &prefix),
                ("K", &upper),
                ("Q", &scope),
            ])
            .collect::<Vec<_>>(),
        )
    }

    pub(super) fn python(&self) -> String {
        let (mut reads, mut writes) = (Vec::new(), Vec::new());
        let mut pair = Vec::new();
        for port in self.engine.ports() {
            let pieces = pieces(self.input(), &port.name);
            let bits = pieces.iter().map(|piece| piece.from + piece.width).max().unwrap_or(1);
            let term = |p: &Piece| p.taken("");
            let value = pieces.iter().map(term).collect::<Vec<_>>().join(" | ");
            let value = if port.signed { format!("sign({value}, {bits})") } else { value };
            if let Some((vertex, _)) =
                port.python.strip_suffix(']').and_then(|at| at.rsplit_once('['))
                && vertex.starts_with("self.v[")
            {
                pair.push(value);
                if pair.len() == 2 {
                    reads.push(format!(
                        "        {vertex} = (\n            {},\n        )\n",
                        pair.join(",\n            ")
                    ));
                    pair.clear();
                }
            } else {
                reads.push(format!("        {} = {value}\n", port.python));
            }
            for p in pieces {
                let (keep, put) = (p.keep(""), p.placed(&port.python, ""));
                writes.push(format!("        words[{0}] = words[{0}] & {keep} | {put}\n", p.word));
            }
        }
        let (reads, writes) = (reads.concat(), writes.concat());
        let [packs, packs1] = self.packs(|_, parts| {
            let term = |(value, p): &((String, String), Piece)| p.placed(&value.1, "");
            format!("        {},\n", parts.iter().map(term).collect::<Vec<_>>().join(" | "))
        });
        let read = self.read_out(
            |number| format!("clamp == {number} and "),
            [
                "    if @IF@u >= whole:\n        \
                 return 0 if u >= (1 << guard + integer >> 1) + (whole >> 1) else whole - 1\n",
                "    if @IF@acc >> (guard + integer + fraction - 1) & 1:\n        return 0\n    \
                 if @IF@u >= whole:\n        return whole - 1\n",
            ],
        );
        let engine = self.engine.keys(false);
        let own = engine.iter().map(|(key, value)| (*key, value.as_str()));
        let up = self.rounding.map_or_else(String::new, up);
        let up = up.replace("||", "or").replace("&&", "and").replace('!', "not ");
        self.fill(
            include_str!("../register.py.in"),
            [
                self.engine.templates()[1],
                include_str!("../random.py.in"),
                include_str!("../divide.py.in"),
            ],
            &own.chain([
                ("OWN_UP", up.as_str()),
                ("FORMATS", &(self.formats('(', ')') + ",")),
                ("READS", reads.trim_end()),
                ("WRITES", writes.trim_end()),
                ("PACKS", packs.trim_end()),
                ("PACKS1", packs1.trim_end()),
                ("READ_OUT", read.trim_end()),
                ("EXPECTED", &format!("0x{:016X}", self.digest(1, CASES))),
            ])
            .collect::<Vec<_>>(),
        )
    }

    /// What the clamps that there are make of a read-out, of the lines for `guard` and for `sign`: where there are
    /// several, each asks first for its own number.
    fn read_out(&self, asks: impl Fn(u8) -> String, lines: [&str; 2]) -> String {
        let mut text = String::new();
        for clamp in &self.clamps {
            let (number, lines) = match clamp {
                Clamp::Guard | Clamp::Error => (1, lines[0]),
                Clamp::Sign => (2, lines[1]),
                Clamp::Wrap | Clamp::Saturate => continue,
            };
            let own = if self.clamps.len() > 1 { asks(number) } else { String::new() };
            text += &lines.replace("@IF@", &own);
        }
        text
    }

    /// The words of the first two kinds of records: each with its values and where their bits go.
    fn packs(&self, line: impl Fn(usize, &[((String, String), Piece)]) -> String) -> [String; 2] {
        [0, 1].map(|kind| {
            let Some(record) = self.records().get(kind) else { return String::new() };
            let values = self.engine.values(kind);
            let word = |word: usize| {
                let fields = record.layout.fields(word).iter();
                let parts = fields.filter_map(|field| {
                    let piece = Piece { word, from: field.piece, width: field.width, at: field.at };
                    record.position(&field.name).map(|n| (values[n].clone(), piece))
                });
                line(word, &parts.collect::<Vec<_>>())
            };
            (0..record.layout.len()).map(word).collect()
        })
    }
}

/// Bits of a value in a word.
struct Piece {
    word: usize,
    from: u32,
    width: u32,
    at: u32,
}

impl Piece {
    const fn mask(&self) -> u32 {
        u32::MAX >> (32 - self.width)
    }

    /// These bits of a word, at their place in the value; `u` ends a number.
    fn taken(&self, u: &str) -> String {
        let (down, up) = (shift(">>", self.at), shift("<<", self.from));
        format!("(words[{}]{down} & {:#x}{u}){up}", self.word, self.mask())
    }

    /// These bits of a value, at their place in the word.
    fn placed(&self, value: &str, u: &str) -> String {
        let (down, up) = (shift(">>", self.from), shift("<<", self.at));
        format!("({value}{down} & {:#x}{u}){up}", self.mask())
    }

    /// The other bits of the word.
    fn keep(&self, u: &str) -> String {
        format!("~({:#x}{u}{})", self.mask(), shift("<<", self.at))
    }
}

/// Where the bits of a register lie.
fn pieces(layout: &Layout, name: &str) -> Vec<Piece> {
    let fields = |word: usize| layout.fields(word).iter().map(move |field| (word, field));
    let own = (0..layout.len()).flat_map(fields).filter(|(_, field)| field.name == name);
    own.map(|(word, field)| Piece { word, from: field.piece, width: field.width, at: field.at })
        .collect()
}

/// A shift, or nothing by 0.
fn shift(operator: &str, by: u32) -> String {
    if by == 0 { String::new() } else { format!(" {operator} {by}") }
}
