//! Edge walks: how far an accumulated x strays. Spec clause `B-9`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Variable, real};
use super::text::{bits as count, decimal, mixed};
use super::trial::{scaled, shoot};
use super::{Proof, Witness, walk_coverage, walk_range};
use crate::case::Words;
use crate::exact::{Rational, dyadic, edge_x, integer};
use crate::machine::EdgeWalkConfig;
use crate::profile::Profile;
use crate::setup::Triangle;
use num_traits::Signed;

/// How long a walk can be.
#[derive(Clone, Copy)]
pub(super) struct Length {
    /// Sample rows that one edge can cross down to the window's last.
    pub(super) rows: i128,
    /// Height of the vertex box in sub-pixels.
    pub(super) span: i128,
}

impl Length {
    fn new(question: &Question) -> Self {
        let (s, offset) = (question.sub_pixel(), question.sample([0, 0])[1]);
        let [low, high] = question.vertices.map(|end| end[1]);
        let first = -((offset - low) >> s);
        let last = ((high - 1 - offset) >> s).min(question.origin[1] + question.size()[1] - 1);
        Self { rows: (last - first + 1).max(1), span: high - low }
    }

    /// Whether a start and slopes of `fraction` bits keep x within half a sub-pixel.
    fn holds(self, fraction: u32, s: u32, nearest: bool) -> bool {
        let (bound, limit) = (self.bound(fraction, nearest), dyadic(1, s + 1));
        if !nearest || bound != limit {
            return bound < limit || (!nearest && bound == limit);
        }
        // A slope is half way between two words only if 2^(F+1) divides the edge's height.
        self.rows >= 2 && !self.slopes_tie(fraction)
    }

    fn slopes_tie(self, fraction: u32) -> bool {
        integer(self.span) >= scaled(1, fraction + 1)
    }

    pub(super) fn bound(self, fraction: u32, nearest: bool) -> Rational {
        dyadic(self.rows, fraction + u32::from(nearest))
    }
}

/// Both claims, for a profile that walks edges.
pub(super) fn proofs(question: &Question) -> Vec<Proof> {
    let Some(&walk) = question.profile.form.walk() else { return Vec::new() };
    let length = Length::new(question);
    let mut proofs: Vec<Proof> = fraction(question, walk, length).into_iter().collect();
    proofs.push(walk_coverage::proof(question, walk, length));
    proofs.push(walk_range::proof(question, walk, length));
    proofs
}

fn fraction(question: &Question, walk: EdgeWalkConfig, length: Length) -> Option<Proof> {
    let (s, nearest) = (question.sub_pixel(), walk.rounding.is_nearest());
    let bits = (0..=120).find(|fraction| length.holds(*fraction, s, nearest))?;
    let found = bits.checked_sub(1).and_then(|fewer| strays(question, walk, fewer));
    let fewer =
        if found.is_some() { format!("; {} bits are not enough", bits - 1) } else { String::new() };
    let (witness, residues) = found.unzip();
    let bound = length.bound(bits, nearest);
    let strict = match (nearest, bound == dyadic(1, s + 1)) {
        (true, true) => {
            format!(", and no slope is half way between words: {} < 2^{}", length.span, bits + 1)
        }
        (false, true) => ", and the error of no rounding is a whole unit".to_owned(),
        _ => String::new(),
    };
    Some(Proof {
        claim: "walk.fraction".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} of fraction keep the x of every edge (a start and up to {} steps, each rounded {}) \
             within half a sub-pixel of the exact x{fewer}. This does not make the coverage exact.",
            count(bits),
            length.rows - 1,
            walk.rounding
        ),
        bits: Some(bits),
        given: Some(walk.fraction),
        error: None,
        sufficient: length.holds(walk.fraction, s, nearest),
        bound: format!(
            "{} x 2^-{} = {bound} <= 2^-{} pixel{strict}",
            length.rows,
            bits + u32::from(nearest),
            s + 1
        ),
        clause: "B-9",
        formal: Formal { smt: Some(obligation(length, (bits, s, nearest), residues)), gappa: None },
        witness,
    })
}

/// The question's profile with another number of fraction bits.
pub(super) fn with_fraction(question: &Question, walk: EdgeWalkConfig, fraction: u32) -> Profile {
    let form = EdgeWalkConfig { fraction, ..walk };
    Profile { form: form.into(), ..question.profile.clone() }
}

/// One edge of a triangle as the model set it up.
pub(super) struct Walked {
    pub(super) start: i128,
    slope: i128,
    pub(super) first_row: i128,
    pub(super) end_row: i128,
}

/// Set-up of the edge between the triangle's first two vertices.
pub(super) fn walked(
    question: &Question,
    profile: &Profile,
    triangle: &Triangle,
) -> Option<Walked> {
    let shot = shoot(question, profile, triangle, question.origin)?;
    let ends = [triangle.xy[0], triangle.xy[1]];
    let v = triangle.normalised().xy;
    let k = (0..3).find(|k| ends.contains(&v[*k]) && ends.contains(&v[(k + 1) % 3]))?;
    let [start, slope, first_row, end_row] = *shot.setup.get(4 * k..4 * k + 4)? else {
        return None;
    };
    (first_row < end_row).then_some(Walked { start, slope, first_row, end_row })
}

type Found = (Witness, Vec<(&'static str, Rational)>);

/// An edge whose x is off by half a sub-pixel with `fraction` bits, and not with one more.
fn strays(question: &Question, walk: EdgeWalkConfig, fraction: u32) -> Option<Found> {
    edges(question, fraction, walk.rounding.is_nearest()).find_map(|triangle| {
        let (s, limit) = (question.sub_pixel(), dyadic(1, question.sub_pixel() + 1));
        let error = |fraction: u32| {
            let profile = with_fraction(question, walk, fraction);
            let walked = walked(question, &profile, &triangle)?;
            let row = (walked.end_row - 1).min(question.size()[1] - 1);
            let exact = |row| {
                let y = question.sample([0, row])[1];
                Some(edge_x(triangle.xy[0], triangle.xy[1], y)? / scaled(1, s))
            };
            let n = row - walked.first_row;
            let x = dyadic(walked.start + walked.slope * n, fraction);
            let off = x - exact(row)?;
            let unit = scaled(1, fraction);
            let e0 = integer(walked.start) - exact(walked.first_row)? * &unit;
            let step = exact(walked.first_row + 1)? - exact(walked.first_row)?;
            let es = integer(walked.slope) - step * &unit;
            Some((off, row, exact(row)?, vec![("e0", e0), ("es", es), ("n", integer(n))]))
        };
        let ((few, row, x, residues), (enough, ..)) = (error(fraction)?, error(fraction + 1)?);
        (few.abs() >= limit && enough.abs() < limit).then(|| {
            let witness = Witness {
                edge: Some([triangle.xy[0], triangle.xy[1]]),
                ..Witness::drawn(
                    fraction,
                    &triangle,
                    format!("x {} on row {row}, in pixels", mixed(&x)),
                    format!(
                        "off by {} sub-pixel; with {} bits by {}",
                        decimal(&(few * scaled(1, s))),
                        fraction + 1,
                        decimal(&(enough * scaled(1, s)))
                    ),
                )
            };
            (witness, residues)
        })
    })
}

/// Edges as tall as the box, of odd height and with a slope whose residue is near the worst, then
/// seeded ones.
fn edges(question: &Question, fraction: u32, nearest: bool) -> impl Iterator<Item = Triangle> {
    let [low, high] = question.vertices;
    let span = [0, 1].map(|axis| high[axis] - low[axis]);
    let tall = (0..8).map(move |n| ((span[1] - 1) | 1) - 2 * n).filter(|height| *height > 0);
    let leaning = tall.flat_map(move |height| {
        let half = i128::midpoint(height, 1);
        let undo = (0..fraction).fold(1 % height, |power, _| power * half % height);
        let worst = if nearest { [(height - 1) / 2, half] } else { [height - 1, 1] };
        let runs = worst.map(|r| r * undo % height);
        [runs[0], runs[1], runs[0] - height, runs[1] - height].map(move |run| {
            let x = if run < 0 { high[0] } else { low[0] };
            [[x, low[1]], [x + run, low[1] + height]]
        })
    });
    let drawn = (0..4096).map(move |index| {
        let mut words = Words::new(11, 1, index);
        let mut point = || {
            [0, 1].map(|axis| {
                low[axis] + words.between(0, i64::try_from(span[axis]).unwrap_or(i64::MAX))
            })
        };
        [point(), point()]
    });
    leaning.chain(drawn).filter(move |[_, [x, _]]| (low[0]..=high[0]).contains(x)).map(
        move |[from, to]| {
            let side = if to[0] < high[0] { high[0] } else { low[0] };
            Triangle { xy: [from, to, [side, to[1]]], z: None }
        },
    )
}

/// |e0 + n es| in units of 2^-F.
fn obligation(
    length: Length,
    (bits, s, nearest): (u32, u32, bool),
    residues: Option<Vec<(&'static str, Rational)>>,
) -> Obligation {
    let unit = dyadic(1, u32::from(nearest));
    let variable = |name, open| Variable { name, low: -unit.clone(), high: unit.clone(), open };
    let beyond = |bits: u32| {
        let limit = real(&(dyadic(1, s + 1) * scaled(1, bits)));
        format!("(or (>= error {limit}) (<= error (- {limit})))")
    };
    Obligation {
        variables: vec![
            variable("e0", !nearest),
            variable("es", !nearest || !length.slopes_tie(bits)),
            Variable::closed("n", integer(0), integer(length.rows - 1)),
        ],
        definitions: vec![("error", "(+ e0 (* n es))".to_owned())],
        facts: Vec::new(),
        violated: vec![beyond(bits)],
        fewer: bits.checked_sub(1).and_then(|fewer| Some((beyond(fewer), residues?))),
    }
}
