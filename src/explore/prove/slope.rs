//! The steepest depth slope that set-up meets. Spec clause `B-8`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Variable, real};
use super::text::bits as count;
use super::trial::{scaled, shoot};
use super::{Proof, Witness};
use crate::bits::{RunTime, Word};
use crate::exact::integer;
use crate::explore::corner::signed_bits;
use crate::setup::Triangle;

/// The claim on the quotient of the depth slopes, for a profile with depth.
pub(super) fn proof(question: &Question) -> Option<Proof> {
    let depth = question.profile.depth?;
    let (s, fraction) = (question.sub_pixel(), depth.interpolation);
    let [low, high] = question.vertices;
    let spans = [0, 1].map(|axis| high[axis] - low[axis]);
    let span = spans[0].max(spans[1]);
    let most = (1 << depth.integer) - 1;
    let steepest: i128 = (most * span) << (s + fraction);
    let bits = signed_bits([steepest, -steepest]);
    let codes = signed_bits([(most * span) << s]);
    let triangle = sliver(low, spans, most);
    let seen = Word::wrapping(RunTime::new(bits - 1).ok()?, steepest).to_i128();
    // What set-up hands to the machine, with every bit it has.
    let shot = shoot(question, &question.profile, &triangle, question.origin);
    let drawn = shot.is_some_and(|shot| shot.setup.iter().any(|word| word.abs() == steepest));
    let witness = (drawn && seen != steepest).then(|| {
        Witness::drawn(
            bits - 1,
            &triangle,
            format!("a slope of {steepest} units a pixel, twice the area being 1"),
            format!("{seen}"),
        )
    });
    let width = depth.guard + depth.integer + fraction;
    let quotient = |bits: u32| {
        let limit = real(&(scaled(1, bits - 1) - integer(1)));
        // Twice the area is at least 1: the quotient is beyond the limit.
        format!("(> (* g {}) (* {limit} area))", real(&scaled(1, s + fraction)))
    };
    let rise = |name| Variable::closed(name, integer(0), integer(most));
    Some(Proof {
        claim: "depth.slope".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} are enough for every depth slope in units of 2^-{fraction} ULP ({codes} without the \
             fraction); the divider needs this width. The adder needs only {width} bits, because its sum \
             is correct mod 2^{width}.",
            count(bits)
        ),
        bits: Some(bits),
        given: None,
        error: None,
        sufficient: true,
        bound: format!(
            "(2^{} - 1) x {span} x 2^{} = {steepest} <= 2^{} - 1",
            depth.integer,
            s + fraction,
            bits - 1
        ),
        clause: "B-8",
        formal: Formal {
            smt: Some(Obligation {
                variables: vec![
                    rise("z0"),
                    rise("z1"),
                    rise("z2"),
                    Variable::closed("y0", integer(0), integer(span)),
                    Variable::closed("y1", integer(0), integer(span)),
                    Variable::closed("y2", integer(0), integer(span)),
                    Variable::closed("area", integer(1), integer(2 * span * span)),
                ],
                definitions: vec![(
                    "g",
                    "(- (* (- z1 z0) (- y2 y0)) (* (- z2 z0) (- y1 y0)))".to_owned(),
                )],
                facts: Vec::new(),
                violated: vec![quotient(bits)],
                fewer: witness.as_ref().map(|_| {
                    let values = [
                        ("z0", 0),
                        ("z1", most),
                        ("z2", 0),
                        ("y0", 0),
                        ("y1", span - 1),
                        ("y2", span),
                        ("area", 1),
                    ];
                    (quotient(bits - 1), values.map(|(name, v)| (name, integer(v))).to_vec())
                }),
            }),
            gappa: None,
        },
        witness,
    })
}

/// A triangle along the longer side of the box with a twice-area of 1 and its whole depth range
/// between two neighbouring lattice points.
fn sliver([x, y]: [i128; 2], [across, down]: [i128; 2], most: i128) -> Triangle {
    let xy = if down >= across {
        [[x, y], [x + 1, y + down - 1], [x + 1, y + down]]
    } else {
        [[x, y], [x + across - 1, y + 1], [x + across, y + 1]]
    };
    Triangle { xy, z: Some([0, most, 0]) }
}
