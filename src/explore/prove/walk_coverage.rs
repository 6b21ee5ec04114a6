//! Edge walks: whether their coverage can be exact. Spec clause `B-9`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Variable, real};
use super::text::{bits as count, point};
use super::trial::{covers, scaled, shoot};
use super::walk::{Length, with_fraction};
use super::{Proof, Witness};
use crate::bits::Rounding;
use crate::exact::{dyadic, integer};
use crate::machine::EdgeWalkConfig;
use crate::setup::Triangle;

/// The claim on exact coverage.
pub(super) fn proof(question: &Question, walk: EdgeWalkConfig, length: Length) -> Proof {
    let s = question.sub_pixel();
    let floor = walk.rounding == Rounding::Floor;
    // Rows, height and sub-pixels: each doubling of one takes a bit.
    let reach = (length.rows * length.span) << s;
    let bits = floor.then(|| i128::BITS - (reach - 1).leading_zeros());
    let witness = match bits {
        Some(bits) => bits.checked_sub(1).and_then(|fewer| late(question, walk, fewer)),
        None => tie(question, walk),
    };
    Proof {
        claim: "walk.coverage".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: match bits {
            Some(bits) => format!(
                "{} of fraction make the coverage of an edge walk with rounding floor exact, if x \
                 stays in the range of its word.",
                count(bits)
            ),
            None if witness.is_none() => format!(
                "For an edge walk with rounding {}, no number of fraction bits is known that makes the \
                 coverage exact.",
                walk.rounding
            ),
            None => format!(
                "No number of fraction bits makes the coverage of an edge walk exact if its \
                 slopes are rounded {}: where an edge goes through a sample, the walk with a slope that \
                 was rounded up is beyond the sample.",
                walk.rounding
            ),
        },
        bits,
        given: Some(walk.fraction),
        error: None,
        sufficient: bits.is_some_and(|bits| walk.fraction >= bits),
        bound: match bits {
            Some(bits) => format!(
                "{} rows x {} sub-pixels x 2^{s} = {reach} <= 2^{bits}",
                length.rows, length.span
            ),
            None => "a slope of one third or minus one third of a pixel a row is rounded up at \
                     every F"
                .to_owned(),
        },
        clause: "B-9",
        formal: Formal { smt: bits.map(|bits| obligation(length, bits, s)), gappa: None },
        witness,
    }
}

/// What the model draws at a pixel where the exact triangle differs.
fn differs(
    question: &Question,
    walk: EdgeWalkConfig,
    (fraction, enough): (u32, Option<u32>),
    triangle: Triangle,
    pixel: [i128; 2],
) -> Option<Witness> {
    let truth = covers(question, &triangle, pixel);
    let covered = |fraction| {
        let profile = with_fraction(question, walk, fraction);
        Some(shoot(question, &profile, &triangle, pixel)?.covered)
    };
    if covered(fraction)? == truth || enough.is_some_and(|more| covered(more) != Some(truth)) {
        return None;
    }
    let text = |covered| if covered { "covered" } else { "not covered" }.to_owned();
    Some(Witness {
        edge: Some([triangle.xy[0], triangle.xy[1]]),
        pixel: Some(pixel),
        sample: Some(question.sample(pixel)),
        ..Witness::drawn(fraction, &triangle, text(truth), text(!truth))
    })
}

/// An edge that meets a sample after three rows of a third of a pixel each, taken as a left and as
/// a right edge.
fn tie(question: &Question, walk: EdgeWalkConfig) -> Option<Witness> {
    let (s, [w, h], area) = (question.sub_pixel(), question.size(), question.vertex_area());
    let [left, top] = question.origin;
    let starts = [[1, 0], [w / 2, h / 2], [w - 2, 0]].map(|[x, y]| [left + x, top + y]);
    let columns = starts.into_iter().flat_map(|start| [(start, 1), (start, -1)]);
    let mut edges = columns.flat_map(|(start, by)| {
        let [x, y] = question.sample(start);
        let to = [x + ((2 * by) << s), y + (6 << s)];
        let third = |along: i128| [x + (along << s), y + (6 << s)];
        [8, -8, 3, -3].map(|along| {
            (Triangle { xy: [[x, y], to, third(along)], z: None }, [start[0] + by, start[1] + 3])
        })
    });
    edges.find_map(|(triangle, pixel)| {
        let inside = triangle.xy.iter().all(|at| area.holds(*at));
        let seen = question.to_model(question.sample(pixel));
        let visible = (0..2).all(|axis| (0..question.size()[axis] << s).contains(&seen[axis]));
        if !inside || !visible {
            return None;
        }
        let mut witness = differs(question, walk, (walk.fraction, None), triangle, pixel)?;
        let at = point(question.sample(pixel), s);
        witness.expected = format!("{}: the edge meets the sample {at}", witness.expected);
        Some(witness)
    })
}

/// An edge that passes a sample by the least distance there is, and is walked short of it.
fn late(question: &Question, walk: EdgeWalkConfig, fraction: u32) -> Option<Witness> {
    let (s, area) = (question.sub_pixel(), question.vertex_area());
    let [low, high] = question.vertices;
    let span = high[1] - low[1];
    let last = question.origin[1] + question.size()[1] - 1;
    let heights = (0..64).map(|n| ((span - 1) | 1) - 2 * n).filter(|height| *height > 0);
    heights.into_iter().find_map(|height| {
        let to_y = low[1] + height;
        let row = last.min((to_y - 1 - question.sample([0, 0])[1]) >> s);
        let down = question.sample([0, row])[1] - low[1];
        let run = inverse(down, height)?;
        [run, run - height].into_iter().find_map(|run| {
            // `down run / height` is a whole number and 1 / height: put the whole on a sample.
            let whole = (down * run - 1) / height;
            let near = if run < 0 {
                high[0].min(question.sample([question.size()[0] - 1, 0])[0] - whole)
            } else {
                low[0]
            };
            let pixel_x = if run < 0 {
                (near + whole - question.sample([0, 0])[0]) >> s
            } else {
                -((question.sample([0, 0])[0] - near - whole) >> s)
            };
            let pixel = [pixel_x, row];
            let from = [question.sample(pixel)[0] - whole, low[1]];
            let to = [from[0] + run, to_y];
            [[high[0], to_y], [low[0], to_y], [high[0], low[1]], [low[0], low[1]]]
                .into_iter()
                .map(|third| Triangle { xy: [from, to, third], z: None })
                .filter(|triangle| triangle.xy.iter().all(|at| area.holds(*at)))
                .find_map(|t| differs(question, walk, (fraction, Some(fraction + 1)), t, pixel))
        })
    })
}

/// The inverse of `value` modulo an odd `modulus`, if it has one.
fn inverse(value: i128, modulus: i128) -> Option<i128> {
    let (mut r, mut t) = ([modulus, value.rem_euclid(modulus)], [0, 1]);
    while r[1] != 0 {
        let quotient = r[0] / r[1];
        r = [r[1], r[0] - quotient * r[1]];
        t = [t[1], t[0] - quotient * t[1]];
    }
    (r[0] == 1).then(|| t[0].rem_euclid(modulus))
}

/// How far x falls short, in units of 2^-F, against the least distance of an edge from a sample
/// left of it.
fn obligation(length: Length, bits: u32, s: u32) -> Obligation {
    let rounding = |name| Variable { name, low: integer(-1), high: integer(1), open: true };
    let least = dyadic(1, s) / integer(length.span) * scaled(1, bits);
    Obligation {
        variables: vec![
            rounding("e0"),
            rounding("es"),
            Variable::closed("n", integer(0), integer(length.rows - 1)),
        ],
        definitions: vec![("short", "(+ e0 (* n es))".to_owned())],
        facts: Vec::new(),
        violated: vec![format!("(>= short {})", real(&least))],
        fewer: None,
    }
}
