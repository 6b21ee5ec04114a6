//! Edge functions as other provers take them. Spec clause `B-11`.

use super::Witness;
use super::domain::Question;
use super::formal::{Obligation, Script, Variable, real};
use crate::cover::FillRule;
use crate::exact::integer;
use crate::explore::corner::{Area, at_corners, bias, edges_at_corners, signed_bits};

const VERTICES: [&str; 6] = ["ax", "ay", "bx", "by", "px", "py"];

/// The edge's ends in the box, its sample in `samples`, and E of it all.
pub(super) fn variables(
    vertices: Area,
    samples: Area,
) -> (Vec<Variable>, Vec<(&'static str, String)>) {
    let variables = VERTICES.into_iter().enumerate().map(|(n, name)| {
        let area = if n < 4 { vertices } else { samples };
        Variable::closed(name, integer(area.low[n % 2]), integer(area.high[n % 2]))
    });
    let e = [
        ("dx", "(- bx ax)".to_owned()),
        ("dy", "(- by ay)".to_owned()),
        ("e", "(- (* dx (- py ay)) (* dy (- px ax)))".to_owned()),
    ];
    (variables.collect(), e.to_vec())
}

pub(super) fn values(
    ends: [[i128; 2]; 2],
    sample: [i128; 2],
) -> Vec<(&'static str, crate::exact::Rational)> {
    let [[ax, ay], [bx, by]] = ends;
    let all = [ax, ay, bx, by, sample[0], sample[1]];
    VERTICES.into_iter().zip(all.map(integer)).collect()
}

/// The two ways in which terms leave a word of `bits` bits.
pub(super) fn outside(above: &str, below: &str, bits: u32) -> [String; 2] {
    let half = super::trial::scaled(1, bits - 1);
    let [low, high] = [real(&-half.clone()), real(&(half - integer(1)))];
    [format!("(> {above} {high})"), format!("(< {below} {low})")]
}

pub(super) fn either([above, below]: [String; 2]) -> String {
    format!("(or {above} {below})")
}

/// E + bias in `bits` bits, the bits that a shift drops counted in.
pub(super) fn width_obligation(
    question: &Question,
    bits: u32,
    witness: Option<&Witness>,
) -> Obligation {
    let (vertices, samples) = (question.vertex_area(), question.sample_area());
    let (variables, definitions) = variables(vertices, samples);
    let owns = match question.rule() {
        FillRule::TopLeft => "(or (< dy 0.0) (and (= dy 0.0) (> dx 0.0)))",
        FillRule::Shadow => "(or (> dy 0.0) (and (= dy 0.0) (> dx 0.0)))",
    };
    // Either bias for every edge is simpler to decide, and where it holds it is as good.
    let both = at_corners(vertices, samples).flat_map(|(_, e)| [e, e - 1]);
    let (mut facts, violated) = if signed_bits(both) <= bits {
        (Vec::new(), outside("e", "(- e 1.0)", bits).to_vec())
    } else {
        let owned = outside("e", "e", bits).map(|out| format!("(and {owns} {out})"));
        let other = outside("(- e 1.0)", "(- e 1.0)", bits);
        let other = other.map(|out| format!("(and (not {owns}) {out})"));
        (vec![String::new(); 2], [owned, other].concat())
    };
    // Over the reals an edge may be owned by a hair; on the lattice only by a step.
    for (fact, d) in facts.iter_mut().zip(["dx", "dy"]) {
        *fact = format!("(or (<= {d} (- 1.0)) (= {d} 0.0) (>= {d} 1.0))");
    }
    let fewer = witness.and_then(|witness| {
        let biased = format!("(ite {owns} e (- e 1.0))");
        let values = values(witness.edge?, witness.sample?);
        Some((either(outside(&biased, &biased, bits - 1)), values))
    });
    Obligation { variables, definitions, facts, violated, fewer }
}

/// The same for Gappa: E is linear in each coordinate of a vertex, so the corner edges do,
/// but for the four without a length.
pub(super) fn width_script(question: &Question, bits: u32) -> Script {
    let samples = question.sample_area();
    let mut script = Script {
        comments: vec![
            "E is linear in each vertex coordinate, so the twelve edges between corners of the"
                .to_owned(),
            "vertex box bound all others. With their numbers in place each sample coordinate"
                .to_owned(),
            "occurs once and interval arithmetic is exact; over six free coordinates it would"
                .to_owned(),
            "ask for a bit too many.".to_owned(),
        ],
        definitions: Vec::new(),
        hypotheses: ["px", "py"]
            .into_iter()
            .enumerate()
            .map(|(n, name)| format!("{name}$ in [{}, {}]", samples.low[n], samples.high[n]))
            .collect(),
        goals: Vec::new(),
        hints: Vec::new(),
    };
    let half = super::trial::scaled(1, bits - 1).to_integer();
    let edges = edges_at_corners(question.vertex_area()).filter(|(ends, _)| ends[0] != ends[1]);
    for (n, ([from, _], edge)) in edges.enumerate() {
        let ([dx, dy], bias) = (edge.direction(), bias(question.rule(), &edge));
        script.definitions.push(format!(
            "e{n}$ = ({dx}) * (py$ - ({})) - ({dy}) * (px$ - ({})) + ({bias});",
            from[1], from[0]
        ));
        script.goals.push(format!("e{n}$ in [-{half}, {}]", &half - 1));
    }
    script
}
