//! Widths of an exact edge function, its coefficients and its constant. Spec clauses `B-2` to
//! `B-4`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Script, Variable, real};
use super::text::{bits as count, pixels};
use super::trial::{covers, shoot};
use super::{Proof, Witness};
use crate::bits::{Rounding, RunTime, Word};
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule};
use crate::exact::integer;
use crate::explore::corner::{Area, at_corners, bias, edges_at_corners, signed_bits, widths};
use crate::profile::{Form, Profile};
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

/// The question's profile with an edge function of this word.
fn narrowed(question: &Question, storage: EdgeStorage, width: u32) -> Profile {
    let form = Form::EdgeFunction(EdgeWordConfig { rule: question.rule(), storage, width });
    Profile { form, ..question.profile.clone() }
}

/// A value as a word of `width` bits reads it.
fn read(value: i128, width: u32) -> Option<i128> {
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
    let given = match question.profile.form {
        Form::EdgeFunction(edges) if edges.storage == storage => Some(edges.width),
        _ => None,
    };
    let values: Vec<i128> = at_corners(vertices, samples)
        .map(|(edge, e)| Rounding::Floor.shift_right(e + bias(rule, &edge), shift).0)
        .collect();
    let [low, high] = [values.iter().min(), values.iter().max()].map(|v| v.copied().unwrap_or(0));
    let witness = misread(question, storage, bits);
    let what = if shift == 0 { "E + bias".to_owned() } else { format!("(E + bias) >> {shift}") };
    let enough = match given {
        Some(given) if given == bits => format!("; the profile's {given} are exactly enough"),
        _ => String::new(),
    };
    let fewer =
        if witness.is_some() { format!(", {} misread one", bits - 1) } else { String::new() };
    let budget = budget(question, bits, storage);
    let beyond = pixels(first_wider(question, bits, needed), s);
    Proof {
        claim: match storage {
            EdgeStorage::Shifted => "edge.stored".to_owned(),
            EdgeStorage::Full => "edge.full".to_owned(),
        },
        row: None,
        place: question.place(),
        statement: format!(
            "{} hold {what} for every edge of the vertex box at every sample of the window, so an \
             exact edge function misclassifies no sample{fewer}{enough}.{budget} Vertices \
             {beyond} pixels further out on each side take more.",
            count(bits)
        ),
        bits: Some(bits),
        given,
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
        " {bits} = 1 guard + {k} integer + {s} sub-pixel + {k} interpolation bits, a budget for \
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

/// A triangle and a pixel drawn wrong with one bit fewer and right with `bits`.
fn misread(question: &Question, storage: EdgeStorage, bits: u32) -> Option<Witness> {
    let [narrow, wide] = [bits - 1, bits].map(|width| narrowed(question, storage, width));
    let (s, rule) = (question.sub_pixel(), question.rule());
    let shift = if storage == EdgeStorage::Shifted { s } else { 0 };
    let [w, h] = question.size();
    let pixels = Area {
        low: question.origin,
        high: [question.origin[0] + w - 1, question.origin[1] + h - 1],
    };
    edges_at_corners(question.vertex_area()).find_map(|(ends, edge)| {
        pixels.corners().into_iter().find_map(|pixel| {
            let sample = question.sample(pixel);
            let biased = edge.at(sample[0], sample[1]) + bias(rule, &edge);
            let stored = Rounding::Floor.shift_right(biased, shift).0;
            let seen = read(stored, bits - 1).filter(|seen| *seen != stored)?;
            thirds(question.vertex_area(), sample).into_iter().find_map(|third| {
                let triangle = Triangle { xy: [ends[0], ends[1], third], z: None };
                if triangle.area2() <= 0 {
                    return None;
                }
                let truth = covers(question, &triangle, pixel);
                let covered = |profile| Some(shoot(question, profile, &triangle, pixel)?.covered);
                let agrees = covered(&wide)? == truth && covered(&narrow)? != truth;
                let text = |covered| if covered { "covered" } else { "not covered" };
                agrees.then(|| Witness {
                    bits: bits - 1,
                    by: "model",
                    triangle: triangle.xy.to_vec(),
                    depths: None,
                    edge: Some(ends),
                    pixel: Some(pixel),
                    sample: Some(sample),
                    expected: format!("{}: the edge word is {stored}", text(truth)),
                    got: format!("{}: {} read {seen}", text(!truth), count(bits - 1)),
                })
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

const VERTICES: [&str; 6] = ["ax", "ay", "bx", "by", "px", "py"];

/// The edge's ends in the box, its sample in `samples`, and E of it all.
fn variables(vertices: Area, samples: Area) -> (Vec<Variable>, Vec<(&'static str, String)>) {
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

fn values(ends: [[i128; 2]; 2], sample: [i128; 2]) -> Vec<(&'static str, crate::exact::Rational)> {
    let [[ax, ay], [bx, by]] = ends;
    let all = [ax, ay, bx, by, sample[0], sample[1]];
    VERTICES.into_iter().zip(all.map(integer)).collect()
}

/// The two ways in which terms leave a word of `bits` bits.
fn outside(above: &str, below: &str, bits: u32) -> [String; 2] {
    let half = super::trial::scaled(1, bits - 1);
    let [low, high] = [real(&-half.clone()), real(&(half - integer(1)))];
    [format!("(> {above} {high})"), format!("(< {below} {low})")]
}

fn either([above, below]: [String; 2]) -> String {
    format!("(or {above} {below})")
}

/// E + bias in `bits` bits, the bits that a shift drops counted in.
fn width_obligation(question: &Question, bits: u32, witness: Option<&Witness>) -> Obligation {
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

/// The same for Gappa: E is linear in each coordinate of a vertex, so sixteen corner edges do.
fn width_script(question: &Question, bits: u32) -> Script {
    let samples = question.sample_area();
    let mut script = Script {
        comments: vec![
            "E is linear in each vertex coordinate, so the sixteen edges between corners of the"
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

fn coefficient(question: &Question) -> Proof {
    let vertices = question.vertex_area();
    let all =
        || edges_at_corners(vertices).flat_map(|(ends, edge)| [edge.a, edge.b].map(|v| (ends, v)));
    let bits = signed_bits(all().map(|(_, value)| value));
    let most = all().map(|(_, value)| value).max().unwrap_or(0);
    let misread = all().find_map(|(ends, value)| Some((ends, value, register(value, bits)?)));
    let (variables, definitions) = variables(vertices, question.sample_area());
    let both = |bits| ["dx", "dy"].map(|d| outside(d, d, bits)).concat();
    Proof {
        claim: "edge.coefficient".to_owned(),
        row: None,
        place: question.place(),
        statement: format!(
            "{} hold A and B, differences of two vertex coordinates, of every edge.",
            count(bits)
        ),
        bits: Some(bits),
        given: None,
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
        edge: None,
        pixel: None,
        sample: None,
        expected: value.to_string(),
        got: seen.to_string(),
    })
}

fn constant(question: &Question) -> Proof {
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
        place: question.place(),
        statement: format!(
            "{} hold C, E at the window's top left corner without a bias, of every edge; taken \
             from the window's centre it is {from_centre}.",
            count(bits)
        ),
        bits: Some(bits),
        given: None,
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
