//! Edge walks: the guard bits that hold every x. Spec clause `K-6`.

use super::domain::Question;
use super::formal::Formal;
use super::text::{bits as count, mixed};
use super::trial::scaled;
use super::walk::{Length, walked};
use super::{Proof, Witness};
use crate::exact::{Rational, dyadic, integer};
use crate::format::ReadOut;
use crate::machine::EdgeWalkConfig;
use crate::profile::Profile;
use crate::setup::Triangle;

/// x of every edge, in pixels: an edge lies between its ends, and its roundings add up.
struct Reach {
    low: Rational,
    high: Rational,
}

impl Reach {
    fn new(question: &Question, walk: EdgeWalkConfig, length: Length) -> Self {
        let s = question.sub_pixel();
        let [low, high] = question.vertices.map(|end| dyadic(end[0], s));
        let error = length.bound(walk.fraction, walk.rounding.is_nearest());
        Self { low: low - &error, high: high + error }
    }

    /// Whether a word with so many guard bits holds all of it.
    fn is_held(&self, walk: EdgeWalkConfig, guard: u32) -> bool {
        let Some((low, limit)) = range(walk, guard) else { return false };
        self.low >= low && self.high < limit
    }
}

fn read(walk: EdgeWalkConfig, guard: u32) -> Option<ReadOut> {
    ReadOut::new(guard, walk.integer, walk.fraction, walk.clamp).ok()
}

/// The half-open range of a word, in pixels.
fn range(walk: EdgeWalkConfig, guard: u32) -> Option<(Rational, Rational)> {
    let (low, limit) = read(walk, guard)?.range();
    Some((dyadic(low, walk.fraction), dyadic(limit, walk.fraction)))
}

/// The claim, for a profile that walks edges.
pub(super) fn proof(question: &Question, walk: EdgeWalkConfig, length: Length) -> Proof {
    let reach = Reach::new(question, walk, length);
    let bits = (0..=119).find(|guard| reach.is_held(walk, *guard));
    let witness = match bits {
        Some(0) => None,
        Some(bits) => leaves(question, walk, bits - 1),
        None => leaves(question, walk, walk.guard),
    };
    let clamp = walk.clamp.name();
    let statement = match bits {
        Some(bits) => {
            let fewer = if witness.is_some() {
                format!("; with {} the word of the edge below reads another x", bits - 1)
            } else {
                String::new()
            };
            format!(
                "{} of guard hold the x of every edge on every row, read by clamp = \"{clamp}\"{fewer}.",
                count(bits)
            )
        }
        None => format!(
            "No number of guard bits holds the x of every edge under clamp = \"{clamp}\": it has no negative x. \
             Write clamp = \"guard\" or \"sign\"."
        ),
    };
    let shown = bits.unwrap_or(walk.guard);
    let (low, limit) = range(walk, shown).unwrap_or((integer(0), integer(0)));
    Proof {
        claim: "walk.guard".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement,
        bits,
        given: Some(walk.guard),
        error: None,
        sufficient: reach.is_held(walk, walk.guard),
        bound: format!(
            "{} <= x <= {} pixels, vertices and {} roundings; {shown} guard bits hold {} <= x < {}",
            mixed(&reach.low),
            mixed(&reach.high),
            length.rows,
            mixed(&low),
            mixed(&limit)
        ),
        clause: "K-6",
        formal: Formal { smt: None, gappa: None },
        witness,
    }
}

/// An upright edge at an end of the vertex box whose x leaves a word with so many guard bits.
fn leaves(question: &Question, walk: EdgeWalkConfig, guard: u32) -> Option<Witness> {
    let read = read(walk, guard)?;
    let [low, high] = question.vertices;
    let profile =
        Profile { form: EdgeWalkConfig { guard, ..walk }.into(), ..question.profile.clone() };
    [(low[0], high[0]), (high[0], low[0])].into_iter().find_map(|(x, other)| {
        let triangle = Triangle { xy: [[x, low[1]], [x, high[1]], [other, high[1]]], z: None };
        let walked = walked(question, &profile, &triangle)?;
        let got = read.reduce(walked.start);
        (got != walked.start).then(|| Witness {
            edge: Some([triangle.xy[0], triangle.xy[1]]),
            ..Witness::drawn(
                guard,
                &triangle,
                format!(
                    "x {} on row {}, in pixels",
                    mixed(&(integer(x) / scaled(1, question.sub_pixel()))),
                    walked.first_row.max(question.origin[1])
                ),
                format!("the word reads {}", mixed(&dyadic(got, walk.fraction))),
            )
        })
    })
}
