//! Widths of an exact edge function, its coefficients and its constant. Spec clauses `B-2` to
//! `B-4`.

use super::domain::Question;
use super::edge_coefficient::{coefficient, constant};
use super::edge_formal::{width_obligation, width_script};
use super::formal::Formal;
use super::text::{bits as count, pixels};
use super::trial::{covers, shoot};
use super::{Proof, Witness};
use crate::bits::{Rounding, RunTime, Word};
use crate::cover::{EdgeStorage, EdgeWordConfig};
use crate::explore::corner::{Area, at_corners, bias, edges_at_corners, widths};
use crate::machine::EdgeFunctionConfig;
use crate::profile::Profile;
use crate::setup::{EdgeCoefficients, Triangle};

/// Stored and full width, then the coefficients and the constant.
pub(super) fn proofs(question: &Question) -> Vec<Proof> {
    vec![
        word(question, EdgeStorage::Shifted),
        word(question, EdgeStorage::Full),
        coefficient(question),
        constant(question),
    ]
}

/// A value as a word of `width` bits reads it.
pub(super) fn read(value: i128, width: u32) -> Option<i128> {
    Some(Word::wrapping(RunTime::new(width).ok()?, value).to_i128())
}

/// The width of one storage.
pub(super) fn word(question: &Question, storage: EdgeStorage) -> Proof {
    let (vertices, samples) = (question.vertex_area(), question.sample_area());
    let (s, rule) = (question.sub_pixel(), question.rule());
    let shift = if storage == EdgeStorage::Shifted { s } else { 0 };
    let pick =
        |(full, stored)| if shift == 0 && storage == EdgeStorage::Full { full } else { stored };
    let needed = |vertices| pick(widths(vertices, samples, s, rule));
    let bits = needed(vertices);
    let given = question.profile.form.edge().filter(|edges| edges.storage == storage);
    let given = given.map(|edges| edges.width);
    let values: Vec<i128> = at_corners(vertices, samples)
        .map(|(edge, e)| Rounding::Floor.shift_right(e + bias(rule, &edge), shift).0)
        .collect();
    let [low, high] = [values.iter().min(), values.iter().max()].map(|v| v.copied().unwrap_or(0));
    let edges = EdgeWordConfig { rule, storage, width: bits, conservative: None };
    let witness = misread(question, edges, &|edge| bias(rule, edge), &|triangle, pixel| {
        covers(question, triangle, pixel)
    });
    let what = if shift == 0 { "E + bias".to_owned() } else { format!("(E + bias) >> {shift}") };
    let enough = match given {
        Some(given) if given == bits => {
            format!("; the {given} bits of the profile are exactly enough")
        }
        _ => String::new(),
    };
    let fewer = if witness.is_some() {
        format!(", but with {} bits one sample is wrong", bits - 1)
    } else {
        String::new()
    };
    let budget = budget(question, bits, storage);
    let beyond = pixels(first_wider(question, bits, needed), s);
    Proof {
        claim: match storage {
            EdgeStorage::Shifted => "edge.stored".to_owned(),
            EdgeStorage::Full => "edge.full".to_owned(),
        },
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} are enough for {what}, for every edge of the vertex box and every sample of the window, so \
             an exact edge function misclassifies no sample{fewer}{enough}.{budget} If vertices may be \
             {beyond} pixels further out on each side, more bits are needed.",
            count(bits)
        ),
        bits: Some(bits),
        given,
        error: None,
        sufficient: given.is_none_or(|given| given >= bits),
        bound: format!(
            "-2^{0} <= {low} and {high} <= 2^{0} - 1 over the 64 corners of vertex box and samples",
            bits - 1
        ),
        clause: "B-3",
        formal: Formal {
            smt: Some(width_obligation(question, bits + shift, witness.as_ref())),
            gappa: Some(width_script(question, bits + shift)),
        },
        witness,
    }
}

/// The lectures' reading of a stored width of 2k + s + 1 bits.
fn budget(question: &Question, bits: u32, storage: EdgeStorage) -> String {
    let ([w, h], s) = (question.size(), question.sub_pixel());
    let k = w.trailing_zeros();
    let corner = question.origin.map(|at| at << s);
    let closed = question.vertices == [corner, [corner[0] + (w << s), corner[1] + (h << s)]];
    if storage == EdgeStorage::Full
        || w != h
        || w.count_ones() != 1
        || !closed
        || bits != 2 * k + s + 1
    {
        return String::new();
    }
    format!(
        " {bits} = 1 guard + {k} integer + {s} sub-pixel + {k} interpolation bits is the budget of \
         an exact edge function without a guard band."
    )
}

/// The least widening of the vertex box, in sub-pixels, that takes more than `bits`.
fn first_wider(question: &Question, bits: u32, needed: impl Fn(Area) -> u32) -> i128 {
    let wider = |by: i128| needed(question.widened(by)) > bits;
    let mut high = 1;
    while !wider(high) {
        high *= 2;
    }
    let mut low = high / 2;
    while high - low > 1 {
        let middle = i128::midpoint(low, high);
        if wider(middle) { high = middle } else { low = middle }
    }
    high
}

/// A triangle and a pixel drawn wrong with one bit fewer than these words have and right with all: `gain` is what E
/// gains before it is stored, `truth` whether the clause covers a pixel.
pub(super) fn misread(
    question: &Question,
    edges: EdgeWordConfig,
    gain: &dyn Fn(&EdgeCoefficients) -> i128,
    truth: &dyn Fn(&Triangle, [i128; 2]) -> bool,
) -> Option<Witness> {
    let fewer = edges.width - 1;
    let [narrow, wide] = [fewer, edges.width].map(|width| {
        let form = EdgeFunctionConfig(EdgeWordConfig { width, ..edges });
        Profile { form: form.into(), ..question.profile.clone() }
    });
    let shift = if edges.storage == EdgeStorage::Shifted { question.sub_pixel() } else { 0 };
    let [w, h] = question.size();
    let pixels = Area {
        low: question.origin,
        high: [question.origin[0] + w - 1, question.origin[1] + h - 1],
    };
    edges_at_corners(question.vertex_area()).find_map(|(ends, edge)| {
        pixels.corners().into_iter().find_map(|pixel| {
            let sample = question.sample(pixel);
            let stored =
                Rounding::Floor.shift_right(edge.at(sample[0], sample[1]) + gain(&edge), shift).0;
            let seen = read(stored, fewer).filter(|seen| *seen != stored)?;
            thirds(question.vertex_area(), sample).into_iter().find_map(|third| {
                let triangle = Triangle { xy: [ends[0], ends[1], third], z: None };
                if triangle.area2() <= 0 {
                    return None;
                }
                let truth = truth(&triangle, pixel);
                let covered = |profile| Some(shoot(question, profile, &triangle, pixel)?.covered);
                let agrees = covered(&wide)? == truth && covered(&narrow)? != truth;
                let text = |covered| if covered { "covered" } else { "not covered" };
                let expected = format!("{}: the edge word is {stored}", text(truth));
                let got = format!("{}: {} read {seen}", text(!truth), count(fewer));
                let witness = Witness::drawn(fewer, &triangle, expected, got);
                let (edge, pixel, sample) = (Some(ends), Some(pixel), Some(sample));
                agrees.then_some(Witness { edge, pixel, sample, ..witness })
            })
        })
    })
}

/// Vertices that can make a triangle around a sample far from an edge.
fn thirds(vertices: Area, [x, y]: [i128; 2]) -> Vec<[i128; 2]> {
    let ([x0, y0], [x1, y1]) = (vertices.low, vertices.high);
    let level = [[x0, y], [x1, y], [x, y0], [x, y1]].into_iter().filter(|at| vertices.holds(*at));
    level.chain(vertices.corners()).collect()
}
