//! What the templates of a reference are filled in with.

mod language;

use super::choose::choose;
use super::shape::{Coverage, Shape};
use super::{CASES, rounds_up, stimulus};
use crate::bits::Rounding;
use crate::model::MODEL_VERSION;
use crate::profile::Profile;
use crate::vector::manifest::sha256;
use crate::vector::package::{comment, fill};

/// What the texts are filled in with.
pub(super) struct Parts<'a> {
    profile: &'a Profile,
    shape: Shape,
    digests: Vec<u64>,
    values: Vec<(&'static str, String)>,
}

/// A rounded quotient that a text needs: its name, its rounding, the clause that asks for it.
struct Quotient {
    name: &'static str,
    rounding: Rounding,
    clause: &'static str,
}

impl<'a> Parts<'a> {
    pub(super) fn of(profile: &'a Profile, shape: Shape) -> Self {
        let digests = stimulus::digests(profile, &shape, 1, CASES);
        let mut parts = Self { profile, digests, values: Vec::new(), shape };
        parts.describe();
        parts.number();
        parts.units();
        parts
    }

    fn push(&mut self, key: &'static str, value: impl Into<String>) {
        self.values.push((key, value.into()));
    }

    /// Words in comments, and what is worked out before it is written.
    fn describe(&mut self) {
        let (several, depth) = (self.shape.several, self.shape.depth);
        let edges = matches!(self.shape.coverage, Coverage::Edges(..));
        self.push("SET", comment(&self.profile.name));
        self.push("GUARDBIT", env!("CARGO_PKG_VERSION"));
        self.push("VERSION", MODEL_VERSION.to_string());
        self.push("DIGEST", sha256(self.profile.to_toml().as_bytes()));
        self.push("OWNS", self.shape.owns());
        self.push("CLAMP", depth.map_or("", |depth| depth.clamp.name()));
        let set_up = match (edges, depth.is_some()) {
            (true, true) => "T-3, E, P-2, P-3",
            (true, false) => "T-3, E",
            (false, true) => "T-3, K-2, K-3, P-2, P-3",
            (false, false) => "T-3, K-2, K-3",
        };
        self.push("SET_CLAUSES", set_up);
        self.push(
            "STEP_CLAUSES",
            match (edges, depth.is_some()) {
                (true, true) => "D-4, C-5",
                (true, false) => "C-5",
                _ => "D-4",
            },
        );
        self.push("AND_DEPTH", if depth.is_some() { ", and its depth there (P-2)" } else { "" });
        self.push("AT_SAMPLE", if several { " on the grid of sample n" } else { "" });
        let centre = self.shape.centre.is_some();
        self.push("AND_CENTRE", if centre { ", and after them the centre" } else { "" });
        self.push("AND_PLANE", if centre { ", and depth at the centre" } else { "" });
    }

    fn number(&mut self) {
        let Shape { coverage, depth, shift, .. } = self.shape;
        let vertex = &self.profile.vertex;
        let (low, high) = vertex.range();
        let (window, [x, y]) = (&self.profile.window, self.shape.samples[0]);
        let mut list: Vec<(&'static str, i128)> = vec![
            ("WIDTH", window.width.into()),
            ("HEIGHT", window.height.into()),
            ("S", vertex.sub_pixel.into()),
            ("SAMPLE_X", x),
            ("SAMPLE_Y", y),
            ("COUNT", self.shape.samples.len() as i128),
            ("LOW", low),
            ("HIGH", high),
            ("D", vertex.difference_bits().into()),
            ("SHIFT", shift.into()),
            ("CASES", CASES.into()),
        ];
        match coverage {
            Coverage::Edges(edge, tile) => {
                list.extend([("M", edge.width.into()), ("TILE", tile.unwrap_or(1).into())]);
            }
            Coverage::Walk(walk) => list.extend([
                ("XG", walk.guard.into()),
                ("XI", walk.integer.into()),
                ("XF", walk.fraction.into()),
                ("XW", walk.width().into()),
            ]),
        }
        if let Some(depth) = &depth {
            list.extend([
                ("G", depth.guard.into()),
                ("I", depth.integer.into()),
                ("F", depth.interpolation.into()),
                ("N", (depth.guard + depth.integer + depth.interpolation).into()),
                ("HALF", depth.start_gain()),
            ]);
        }
        self.values.extend(list.into_iter().map(|(key, value)| (key, value.to_string())));
    }

    /// What the self test says of its units.
    fn units(&mut self) {
        let units = self.shape.units();
        let count = units.len();
        self.push("UNITS", count.to_string());
        self.push("LAST", (count - 1).to_string());
        self.push("STEP", (count - 3).to_string());
        self.push("SET_UP", (count - 2).to_string());
        self.push("DRAWN", (count - 1).to_string());
        let (last, others) = units.split_last().unwrap_or_else(|| unreachable!("four at most"));
        self.push("UNIT_LIST", format!("{} and {last}", others.join(", ")));
    }

    /// A template as the profile has it.
    fn fill(&self, template: &str, own: &[(&str, &str)]) -> String {
        let shared = self.values.iter().map(|(key, value)| (*key, value.as_str()));
        // What is filled in has keys of its own.
        let values: Vec<(&str, &str)> = own.iter().copied().chain(shared).collect();
        fill(&choose(template, &self.shape.flags()), &values)
    }

    /// The rounded quotients of a text, one after another; `up` says when a magnitude is raised.
    fn quotients(&self, template: &str, up: impl Fn(Rounding) -> String) -> String {
        let depth = self.shape.depth.map(|depth| Quotient {
            name: "divide",
            rounding: depth.rounding,
            clause: "P-3",
        });
        let walk = match self.shape.coverage {
            Coverage::Walk(walk) => {
                Some(Quotient { name: "divide_x", rounding: walk.rounding, clause: "K-3" })
            }
            Coverage::Edges(..) => None,
        };
        let text = |quotient: Quotient| {
            // Bits of a numerator, of a divisor and of a quotient, in SystemVerilog.
            let [q, p, n] =
                if quotient.name == "divide" { ["Q", "P", "N"] } else { ["T", "T", "W"] };
            fill(
                template,
                &[
                    ("NAME", quotient.name),
                    ("CLAUSE", quotient.clause),
                    ("OWN_ROUNDING", &quotient.rounding.to_string()),
                    ("OWN_UP", &up(quotient.rounding)),
                    ("OWN_Q", q),
                    ("OWN_P", p),
                    ("OWN_N", n),
                ],
            )
        };
        let texts: String = depth.into_iter().chain(walk).map(text).collect();
        texts.strip_suffix('\n').unwrap_or_default().to_owned()
    }

    /// The samples' places, and the centre's behind them where they share a depth.
    fn places(&self) -> Vec<[i128; 2]> {
        self.shape.samples.iter().copied().chain(self.shape.centre).collect()
    }

    /// A line for each unit, by its name and its bit.
    fn complaints(&self, line: impl Fn(&str, u32) -> String) -> String {
        self.shape.units().iter().zip(0..).map(|(unit, n)| line(unit, 1 << n)).collect()
    }
}

pub(super) fn up(rounding: Rounding) -> String {
    rounds_up(rounding).to_owned()
}
