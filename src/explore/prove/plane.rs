//! Interpolation bits: the error that a rounded start and rounded slopes gather over a walk.
//! Spec clauses `B-5` and `B-6`.

use super::domain::Question;
use super::formal::{Formal, Obligation, Script, Variable, real};
use super::plane_witness;
use super::trial::scaled;
use super::{Proof, guard};
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use crate::format::Clamp;
use crate::setup::Division;
use crate::value::DepthConfig;
use num_traits::Zero;
use std::fmt::Write as _;

/// What the error must stay below, in ULP.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Goal {
    Half,
    One,
}

impl Goal {
    pub(super) fn ulp(self) -> Rational {
        dyadic(1, u32::from(self == Self::Half))
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Half => "half an ULP",
            Self::One => "one ULP",
        }
    }
}

/// The bound of an accumulated error: so many roundings, and what division adds.
pub(super) struct Growth {
    pub(super) roundings: i128,
    pub(super) nearest: bool,
    /// What a shared reciprocal adds, in ULP.
    pub(super) division: Rational,
}

impl Growth {
    pub(super) fn new(question: &Question, depth: &DepthConfig) -> Self {
        let [w, h] = question.size();
        let division = match depth.division {
            Division::Quotient => Rational::zero(),
            // The reciprocal is off by at most 2^-b of itself, and a covered sample is at most
            // the whole depth range away from the anchor.
            Division::Reciprocal { bits } => dyadic((1 << depth.integer) - 1, bits),
        };
        Self { roundings: w + h - 1, nearest: depth.rounding.is_nearest(), division }
    }

    /// The bound with `fraction` fraction bits, in ULP.
    pub(super) fn at(&self, fraction: u32) -> Rational {
        dyadic(self.roundings, fraction + u32::from(self.nearest)) + &self.division
    }

    /// Whether the error stays below the goal. A rounding that is not to nearest errs by strictly
    /// less than its unit, so there the bound itself is out of reach.
    fn holds(&self, fraction: u32, goal: Goal) -> bool {
        let (bound, goal) = (self.at(fraction), goal.ulp());
        if self.nearest { bound < goal } else { bound <= goal }
    }

    fn fewest(&self, goal: Goal) -> Option<u32> {
        (0..=120).find(|fraction| self.holds(*fraction, goal))
    }

    /// The inequality at `fraction` bits.
    fn text(&self, fraction: u32, goal: Goal) -> String {
        let relation = match (self.holds(fraction, goal), self.nearest) {
            (true, true) => "<",
            (true, false) => "<=",
            (false, true) => ">=",
            (false, false) => ">",
        };
        let power = fraction + u32::from(self.nearest);
        let mut text = format!("{} x 2^-{power}", self.roundings);
        if !self.division.is_zero() {
            let _ = write!(text, " + {}", self.division);
        }
        format!("{text} = {} {relation} {}", self.at(fraction), goal.ulp())
    }
}

/// What walks the plane, as claims and texts call it: depth, or a channel whose words stand for those of depth.
pub(super) struct Subject {
    /// The first part of the claim's name.
    pub(super) topic: String,
    pub(super) noun: String,
    /// Whether the vertex values are those of depth, so that the model can draw a counterexample.
    pub(super) drawn: bool,
}

impl Subject {
    pub(super) fn depth() -> Self {
        Self { topic: "depth".to_owned(), noun: "the depth".to_owned(), drawn: true }
    }
}

/// Below half an ULP; for a rounding that is not to nearest also below one.
pub(super) fn proofs(question: &Question, subject: &Subject) -> Vec<Proof> {
    let Some(depth) = question.profile.depth else { return Vec::new() };
    let mut proofs = vec![proof(question, subject, &depth, Goal::Half)];
    if !depth.rounding.is_nearest() {
        proofs.push(proof(question, subject, &depth, Goal::One));
    }
    proofs
}

fn proof(question: &Question, subject: &Subject, depth: &DepthConfig, goal: Goal) -> Proof {
    let growth = Growth::new(question, depth);
    let sticky = depth.clamp == Clamp::Saturate;
    let bits = growth.fewest(goal).filter(|_| !sticky);
    let found = bits
        .and_then(|bits| bits.checked_sub(1))
        .filter(|_| subject.drawn)
        .and_then(|fewer| plane_witness::find(question, fewer, goal));
    let given = depth.interpolation;
    let (witness, residues) = found.unzip();
    Proof {
        claim: match goal {
            Goal::Half => format!("{}.interpolation", subject.topic),
            Goal::One => format!("{}.interpolation-one", subject.topic),
        },
        row: None,
        unit: None,
        place: question.place(),
        statement: statement(
            question,
            subject,
            depth,
            goal,
            &growth,
            bits.zip(Some(witness.is_some())),
        ),
        error: None,
        bits,
        given: Some(given),
        sufficient: !sticky && growth.holds(given, goal),
        bound: match bits {
            Some(0) => growth.text(0, goal),
            Some(bits) => {
                format!(
                    "{}; with {}: {}",
                    growth.text(bits, goal),
                    bits - 1,
                    growth.text(bits - 1, goal)
                )
            }
            None if sticky => "the error of a sticky accumulator depends on its path".to_owned(),
            None => format!("{} >= {} for every F", growth.division, goal.ulp()),
        },
        clause: if growth.division.is_zero() { "B-5" } else { "B-6" },
        witness,
        formal: bits.map_or_else(Formal::default, |bits| Formal {
            smt: Some(obligation(question, &growth, goal, bits, residues)),
            gappa: growth
                .division
                .is_zero()
                .then(|| script(question, depth.rounding, &growth, bits)),
        }),
    }
}

fn statement(
    question: &Question,
    subject: &Subject,
    depth: &DepthConfig,
    goal: Goal,
    growth: &Growth,
    enough: Option<(u32, bool)>,
) -> String {
    let [w, h] = question.size();
    let walk = format!(
        "a start and {} steps, the longest walk in {w} x {h}, each rounded {}",
        growth.roundings - 1,
        depth.rounding
    );
    let Some((bits, tight)) = enough else {
        return format!(
            "No number of interpolation bits keeps the error of {} below {}: {walk}.",
            subject.noun,
            goal.name()
        );
    };
    let mut text = format!(
        "{} keep the error of {} below {} at every sample of the window: {walk}",
        interpolation_bits(bits),
        subject.noun,
        goal.name()
    );
    if tight {
        let _ = write!(text, "; {} bits are not enough", bits - 1);
    }
    if !growth.division.is_zero() {
        text += "; start and slopes share one reciprocal, and its error is included";
    }
    let DepthConfig { guard, integer, interpolation, .. } = *depth;
    if interpolation == bits {
        let needed = guard::fewest(question, depth).map_or(String::new(), |needed| {
            let verb = if needed == 1 { "is" } else { "are" };
            format!(
                "; {needed} of its {guard} guard bits {verb} needed for samples that are covered at their \
                 own position"
            )
        });
        let _ = write!(
            text,
            ". The profile has exactly this budget: {guard} guard + {integer} integer + {bits} interpolation \
             = {} bits{needed}",
            guard + integer + bits
        );
    }
    text + "."
}

fn interpolation_bits(count: u32) -> String {
    format!("{count} interpolation bit{}", if count == 1 { "" } else { "s" })
}

/// |e0 + x ex + y ey| in units of 2^-F, each e one rounding.
fn obligation(
    question: &Question,
    growth: &Growth,
    goal: Goal,
    bits: u32,
    residues: Option<Vec<(&'static str, Rational)>>,
) -> Obligation {
    let unit = dyadic(1, u32::from(growth.nearest));
    let rounding =
        |name| Variable { name, low: -unit.clone(), high: unit.clone(), open: !growth.nearest };
    let [w, h] = question.size();
    let mut variables = vec![
        rounding("e0"),
        rounding("ex"),
        rounding("ey"),
        Variable::closed("x", integer(0), integer(w - 1)),
        Variable::closed("y", integer(0), integer(h - 1)),
    ];
    let mut sum = "e0 (* x ex) (* y ey)".to_owned();
    if !growth.division.is_zero() {
        let most = &growth.division * scaled(1, bits);
        variables.push(Variable::closed("reciprocal", -most.clone(), most));
        sum.push_str(" reciprocal");
    }
    let beyond = |bits: u32| {
        let limit = real(&(goal.ulp() * scaled(1, bits)));
        format!("(or (>= error {limit}) (<= error (- {limit})))")
    };
    Obligation {
        variables,
        definitions: vec![("error", format!("(+ {sum})"))],
        facts: Vec::new(),
        violated: vec![beyond(bits)],
        fewer: bits.checked_sub(1).and_then(|fewer| Some((beyond(fewer), residues?))),
    }
}

fn script(question: &Question, rounding: Rounding, growth: &Growth, bits: u32) -> Script {
    let mode = rounding.names().gappa;
    let [w, h] = question.size();
    let power = bits + u32::from(growth.nearest);
    Script {
        comments: vec![
            "S, DX and DY are the exact start and slopes, in ULP and ULP per pixel; x and y count"
                .to_owned(),
            "pixels from the window's corner. The goal is the bound of the accumulated error."
                .to_owned(),
        ],
        definitions: vec![
            format!("@rnd$ = fixed<-{bits}, {mode}>;"),
            "s$ = rnd$(S$);".to_owned(),
            "dx$ = rnd$(DX$);".to_owned(),
            "dy$ = rnd$(DY$);".to_owned(),
            "z$ = s$ + x$ * dx$ + y$ * dy$;".to_owned(),
            "Z$ = S$ + x$ * DX$ + y$ * DY$;".to_owned(),
        ],
        hypotheses: vec![format!("x$ in [0, {}]", w - 1), format!("y$ in [0, {}]", h - 1)],
        goals: vec![format!("|z$ - Z$| <= {}b-{power}", growth.roundings)],
        hints: vec!["z$ - Z$ -> (s$ - S$) + x$ * (dx$ - DX$) + y$ * (dy$ - DY$);".to_owned()],
    }
}
