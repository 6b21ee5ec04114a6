//! Guard bits that covered samples need. Spec clause `B-7`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Variable, real};
use super::plane::{Growth, Subject};
use super::plane_witness::start_bias;
use super::text::point;
use super::trial::{scaled, shoot};
use super::{Proof, Witness};
use crate::exact::{Rational, integer};
use crate::format::{Clamp, ReadOut};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::value::DepthConfig;
use num_traits::ToPrimitive;

/// The accumulator values that covered samples can hold, in units of 2^-F.
pub(super) struct Reach {
    /// What the value can be without its error, in ULP.
    values: [Rational; 2],
    /// The accumulated error, in units.
    error: Rational,
    nearest: bool,
    /// What the start gains, in units.
    bias: i128,
    low: i128,
    high: i128,
}

impl Reach {
    fn new(question: &Question, depth: &DepthConfig) -> Option<Self> {
        let growth = Growth::new(question, depth);
        let values = [integer(0), integer((1 << depth.integer) - 1)];
        let bias = start_bias(depth, depth.interpolation);
        let error = growth.at(depth.interpolation);
        Self::of(values, &error, growth.nearest, bias, depth.interpolation)
    }

    /// For values between two, with an error in ULP, of which a rounding that is not to nearest stays strictly
    /// below its bound.
    pub(super) fn of(
        values: [Rational; 2],
        error: &Rational,
        nearest: bool,
        bias: i128,
        fraction: u32,
    ) -> Option<Self> {
        let unit = scaled(1, fraction);
        let (error, gain) = (error * &unit, integer(bias));
        let low = &values[0] * &unit + &gain - &error;
        let high = &values[1] * &unit + &gain + &error;
        // An accumulator is an integer.
        let [low, high] = if nearest {
            [low.ceil(), high.floor()]
        } else {
            [low.floor() + integer(1), high.ceil() - integer(1)]
        };
        let [low, high] = [low, high].map(|end| end.to_integer().to_i128());
        Some(Self { values, error, nearest, bias, low: low?, high: high? })
    }

    /// The fewest guard bits whose range holds all of them.
    pub(super) fn fewest(&self, read_out: impl Fn(u32) -> Option<ReadOut>) -> Option<u32> {
        (0..=120).find(|guard| {
            read_out(*guard).is_some_and(|read| {
                let (low, limit) = read.range();
                low <= self.low && self.high < limit
            })
        })
    }

    pub(super) fn text(&self, fraction: u32) -> String {
        format!("accumulator {} to {} units of 2^-{fraction}", self.low, self.high)
    }

    /// That no accumulator leaves the ranges of so many guard bits.
    pub(super) fn obligation(
        &self,
        bits: u32,
        witness: Option<i128>,
        fraction: u32,
        range: impl Fn(u32) -> (i128, i128),
    ) -> Obligation {
        let outside = |bits| {
            // An accumulator is an integer, so what is below the range is lower by one at least.
            let (low, limit) = range(bits);
            let [below, limit] = [low - 1, limit].map(|end| real(&integer(end)));
            format!("(or (<= accumulator {below}) (>= accumulator {limit}))")
        };
        let fewer = witness.map(|accumulator| {
            (outside(bits - 1), vec![("z", integer(0)), ("error", integer(accumulator))])
        });
        let (unit, bias) = (scaled(1, fraction), integer(self.bias));
        let [low, high] = self.values.clone();
        Obligation {
            variables: vec![
                Variable::closed("z", low, high),
                Variable {
                    name: "error",
                    low: -self.error.clone(),
                    high: self.error.clone(),
                    open: !self.nearest,
                },
            ],
            definitions: vec![(
                "accumulator",
                format!("(+ (* z {}) {} error)", real(&unit), real(&bias)),
            )],
            facts: Vec::new(),
            violated: vec![outside(bits)],
            fewer,
        }
    }
}

fn read_out(depth: &DepthConfig, guard: u32) -> Option<ReadOut> {
    ReadOut::new(guard, depth.integer, depth.interpolation, depth.clamp).ok()
}

/// The fewest guard bits whose range holds every covered sample; none where no number does.
pub(super) fn fewest(question: &Question, depth: &DepthConfig) -> Option<u32> {
    // A sticky accumulator depends on its path, and has no range to stay in.
    if depth.clamp == Clamp::Saturate {
        return None;
    }
    Reach::new(question, depth)?.fewest(|guard| read_out(depth, guard))
}

/// The statement on guard bits.
pub(super) fn statement(bits: Option<u32>, clamp: Clamp) -> String {
    match bits {
        Some(bits) => format!(
            "{bits} guard bit{} the accumulator of every sample that is covered at its own \
             position within the range that the read-out can decode. This does not hold for values \
             taken outside their triangle: for them, no number of guard bits is enough.",
            if bits == 1 { " keeps" } else { "s keep" }
        ),
        None => format!(
            "No number of guard bits keeps covered samples in range under the clamp mode {}.",
            clamp.name()
        ),
    }
}

/// The claim on guard bits, for a profile with depth.
pub(super) fn proof(question: &Question, subject: &Subject) -> Option<Proof> {
    let depth = question.profile.depth?;
    let reach = Reach::new(question, &depth)?;
    let bits = fewest(question, &depth);
    let witness = bits
        .and_then(|bits| bits.checked_sub(1))
        .filter(|_| subject.drawn)
        .and_then(|n| wraps(question, &depth, n));
    let range = |bits: u32| read_out(&depth, bits).map(ReadOut::range).unwrap_or_default();
    let sum = reach.text(depth.interpolation);
    Some(Proof {
        claim: format!("{}.guard", subject.topic),
        row: None,
        unit: None,
        place: question.place(),
        statement: statement(bits, depth.clamp),
        error: None,
        bits,
        given: Some(depth.guard),
        sufficient: bits.is_some_and(|bits| depth.guard >= bits),
        bound: match bits {
            Some(bits) => {
                let (low, limit) = range(bits);
                format!("{sum}, within [{low}, {limit})")
            }
            None => sum,
        },
        clause: "B-7",
        formal: Formal {
            smt: bits.map(|bits| {
                let accumulator = witness.as_ref().map(|(_, accumulator)| *accumulator);
                reach.obligation(bits, accumulator, depth.interpolation, range)
            }),
            gappa: None,
        },
        witness: witness.map(|(witness, _)| witness),
    })
}

/// Candidate triangles: a vertex on a sample with depth 0, and two legs along the axes.
fn candidates(question: &Question, depth: &DepthConfig) -> Vec<(Triangle, [i128; 2])> {
    let (s, [w, h], [left, top]) = (question.sub_pixel(), question.size(), question.origin);
    let most = (1 << depth.integer) - 1;
    let mut list = Vec::new();
    for leg in [3 << s, 5 << s, 6 << s, 7 << s, 3, 5, 7, (3 << s) / 2] {
        for x in [5, 1, 2, 3, w / 2, w - 1] {
            for y in [0, 5, 1, h / 2, h - 1] {
                let pixel = [left + x.min(w - 1), top + y.min(h - 1)];
                let [ax, ay] = question.sample(pixel);
                for [along, down] in [[leg, leg], [-leg, leg], [leg, -leg], [-leg, -leg]] {
                    let xy = [[ax, ay], [ax + along, ay], [ax, ay + down]];
                    if xy.iter().all(|at| question.vertex_area().holds(*at)) {
                        for z in [[0, 1, 0], [0, 0, 1], [0, 1, 1], [0, most, 0], [0, 0, most]] {
                            list.push((Triangle { xy, z: Some(z) }, pixel));
                        }
                    }
                }
            }
        }
    }
    list
}

/// A covered sample that wraps with `guard` guard bits and not with one more, and its accumulator.
fn wraps(question: &Question, depth: &DepthConfig, guard: u32) -> Option<(Witness, i128)> {
    let with = |guard| Profile {
        depth: Some(DepthConfig { guard, ..*depth }),
        ..question.profile.clone()
    };
    let (few, enough) = (with(guard), with(guard + 1));
    candidates(question, depth).into_iter().find_map(|(triangle, pixel)| {
        let narrow = shoot(question, &few, &triangle, pixel)?;
        if !narrow.covered || !narrow.wrapped {
            return None;
        }
        let wide = shoot(question, &enough, &triangle, pixel)?;
        let at = [0, 1].map(|axis| pixel[axis] - question.origin[axis]);
        // Depth 0 lies at the vertex itself, so the exact read is 0.
        let right = !wide.wrapped && wide.depth == Some(0) && narrow.depth != Some(0);
        let accumulator = narrow.accumulator(at)?;
        let got = narrow
            .depth
            .map_or_else(|| "refused".to_owned(), |depth| format!("depth {depth} read"));
        let witness = Witness {
            pixel: Some(pixel),
            sample: Some(question.sample(pixel)),
            ..Witness::drawn(
                guard,
                &triangle,
                format!("depth 0 at the vertex {}", point(triangle.xy[0], question.sub_pixel())),
                format!("{got}: the accumulator, {accumulator}/2^{}, wraps", depth.interpolation),
            )
        };
        right.then_some((witness, accumulator))
    })
}
