//! Widths of edge coefficients and of the constant. Spec clause `B-4`.

use super::domain::Question;
use super::edge::read;
use super::edge_formal::{either, outside, values, variables};
use super::formal::{Formal, Obligation};
use super::text::bits as count;
use super::{Proof, Witness};
use crate::explore::corner::{Area, at_corners, edges_at_corners, signed_bits};
use crate::setup::EdgeCoefficients;

pub(super) fn coefficient(question: &Question) -> Proof {
    let vertices = question.vertex_area();
    let all =
        || edges_at_corners(vertices).flat_map(|(ends, edge)| [edge.a, edge.b].map(|v| (ends, v)));
    let bits = signed_bits(all().map(|(_, value)| value));
    let most = all().map(|(_, value)| value).max().unwrap_or(0);
    let misread = all().find_map(|(ends, value)| Some((ends, value, register(value, bits)?)));
    let (variables, definitions) = variables(vertices, question.sample_area());
    let both = |bits| ["(- ay by)", "dx"].map(|d| outside(d, d, bits)).concat();
    Proof {
        claim: "edge.coefficient".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} are enough for A and B of every edge; A and B are differences of two vertex coordinates.",
            count(bits)
        ),
        bits: Some(bits),
        given: None,
        error: None,
        sufficient: true,
        bound: format!("|A|, |B| <= {most} <= 2^{} - 1", bits - 1),
        clause: "B-4",
        formal: Formal {
            smt: Some(Obligation {
                variables,
                definitions,
                facts: Vec::new(),
                violated: both(bits),
                fewer: misread.as_ref().map(|(ends, ..)| {
                    let violated = format!("(or {})", both(bits - 1).join(" "));
                    (violated, values(*ends, question.sample_area().low))
                }),
            }),
            gappa: None,
        },
        witness: misread.map(|(ends, _, witness)| Witness { edge: Some(ends), ..witness }),
    }
}

/// A value that a register of one bit fewer reads as another.
fn register(value: i128, bits: u32) -> Option<Witness> {
    let seen = read(value, bits - 1).filter(|seen| *seen != value)?;
    Some(Witness {
        bits: bits - 1,
        by: "word",
        triangle: Vec::new(),
        depths: None,
        codes: None,
        edge: None,
        pixel: None,
        sample: None,
        expected: value.to_string(),
        got: seen.to_string(),
    })
}

pub(super) fn constant(question: &Question) -> Proof {
    let vertices = question.vertex_area();
    let s = question.sub_pixel();
    let corner = question.origin.map(|at| at << s);
    let [w, h] = question.size();
    let centre = [corner[0] + (w << s) / 2, corner[1] + (h << s) / 2];
    let at = |from| at_corners(vertices, Area::point(from)).map(|(_, c)| c);
    let [bits, from_centre] = [corner, centre].map(|from| signed_bits(at(from)));
    let [low, high] = [at(corner).min(), at(corner).max()].map(|v| v.unwrap_or(0));
    let misread = edges_at_corners(vertices).find_map(|(ends, edge): (_, EdgeCoefficients)| {
        Some((ends, register(edge.at(corner[0], corner[1]), bits)?))
    });
    let (variables, definitions) = variables(vertices, Area::point(corner));
    Proof {
        claim: "edge.constant".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} are enough for C of every edge; C is the value of E at the top left corner of the window, \
             without a bias. If C is taken at the centre of the window, {from_centre} are enough.",
            count(bits)
        ),
        bits: Some(bits),
        given: None,
        error: None,
        sufficient: true,
        bound: format!(
            "-2^{0} <= {low} and {high} <= 2^{0} - 1 over the 16 corner edges",
            bits - 1
        ),
        clause: "B-4",
        formal: Formal {
            smt: Some(Obligation {
                variables,
                definitions,
                facts: Vec::new(),
                violated: outside("e", "e", bits).to_vec(),
                fewer: misread
                    .as_ref()
                    .map(|(ends, _)| (either(outside("e", "e", bits - 1)), values(*ends, corner))),
            }),
            gappa: None,
        },
        witness: misread.map(|(ends, witness)| Witness {
            edge: Some(ends),
            sample: Some(corner),
            ..witness
        }),
    }
}
