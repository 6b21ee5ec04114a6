//! Guard bits that covered samples need. Spec clause `B-7`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Variable, real};
use super::plane::Growth;
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
struct Reach {
    /// The accumulated error, in units.
    error: Rational,
    nearest: bool,
    low: i128,
    high: i128,
}

impl Reach {
    fn new(question: &Question, depth: &DepthConfig) -> Option<Self> {
        let growth = Growth::new(question, depth);
        let error = growth.at(depth.interpolation) * scaled(1, depth.interpolation);
        // A rounding that is not to nearest stays strictly below its bound.
        let whole = if growth.nearest { error.floor() } else { error.ceil() - integer(1) };
        let most = whole.to_integer().to_i128()?;
        let top = ((1_i128 << depth.integer) - 1) << depth.interpolation;
        let bias = start_bias(depth, depth.interpolation);
        let nearest = growth.nearest;
        Some(Self {
            error,
            nearest,
            low: bias - most,
            high: top.checked_add(bias)?.checked_add(most)?,
        })
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
    let reach = Reach::new(question, depth)?;
    (0..=120).find(|guard| {
        read_out(depth, *guard).is_some_and(|read| {
            let (low, limit) = read.range();
            low <= reach.low && reach.high < limit
        })
    })
}

/// The claim on guard bits, for a profile with depth.
pub(super) fn proof(question: &Question) -> Option<Proof> {
    let depth = question.profile.depth?;
    let reach = Reach::new(question, &depth)?;
    let bits = fewest(question, &depth);
    let witness =
        bits.and_then(|bits| bits.checked_sub(1)).and_then(|n| wraps(question, &depth, n));
    let range = |bits: u32| read_out(&depth, bits).map(ReadOut::range).unwrap_or_default();
    let sum = format!("{} to {} units of 2^-{}", reach.low, reach.high, depth.interpolation);
    Some(Proof {
        claim: "depth.guard".to_owned(),
        row: None,
        place: question.place(),
        statement: match bits {
            Some(bits) => format!(
                "{bits} guard bit{} the accumulator of every sample that is covered at its own \
                 position within the range that the read-out can decode. This does not hold for values \
                 taken outside their triangle: for them, no number of guard bits is enough.",
                if bits == 1 { " keeps" } else { "s keep" }
            ),
            None => format!(
                "No number of guard bits keeps covered samples in range under the clamp mode {}.",
                depth.clamp.name()
            ),
        },
        bits,
        given: Some(depth.guard),
        sufficient: bits.is_some_and(|bits| depth.guard >= bits),
        bound: match bits {
            Some(bits) => {
                let (low, limit) = range(bits);
                format!("accumulator {sum}, within [{low}, {limit})")
            }
            None => format!("accumulator {sum}"),
        },
        clause: "B-7",
        formal: Formal {
            smt: bits.map(|bits| obligation(&depth, &reach, bits, witness.as_ref(), range)),
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
            bits: guard,
            by: "model",
            triangle: triangle.xy.to_vec(),
            depths: triangle.z,
            edge: None,
            pixel: Some(pixel),
            sample: Some(question.sample(pixel)),
            expected: format!(
                "depth 0 at the vertex {}",
                point(triangle.xy[0], question.sub_pixel())
            ),
            got: format!("{got}: the accumulator, {accumulator}/2^{}, wraps", depth.interpolation),
        };
        right.then_some((witness, accumulator))
    })
}

fn obligation(
    depth: &DepthConfig,
    reach: &Reach,
    bits: u32,
    witness: Option<&(Witness, i128)>,
    range: impl Fn(u32) -> (i128, i128),
) -> Obligation {
    let most = integer((1 << depth.integer) - 1);
    let bias = start_bias(depth, depth.interpolation);
    let (unit, bias) = (scaled(1, depth.interpolation), integer(bias));
    let outside = |bits| {
        // An accumulator is an integer, so what is below the range is lower by one at least.
        let (low, limit) = range(bits);
        let [below, limit] = [low - 1, limit].map(|end| real(&integer(end)));
        format!("(or (<= accumulator {below}) (>= accumulator {limit}))")
    };
    let fewer = witness.map(|(_, accumulator)| {
        (outside(bits - 1), vec![("z", integer(0)), ("error", integer(*accumulator))])
    });
    let sum = format!("(+ (* z {}) {} error)", real(&unit), real(&bias));
    Obligation {
        variables: vec![
            Variable::closed("z", integer(0), most),
            Variable {
                name: "error",
                low: -reach.error.clone(),
                high: reach.error.clone(),
                open: !reach.nearest,
            },
        ],
        definitions: vec![("accumulator", sum)],
        facts: Vec::new(),
        violated: vec![outside(bits)],
        fewer,
    }
}
