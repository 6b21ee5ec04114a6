//! The claims on corrected channels for other provers. Spec clause `CH-23`.

use super::correction::Incoming;
use super::formal::{Obligation, Script, Variable, real};
use super::trial::scaled;
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use num_traits::{One, Zero};

/// A division at a sample, with all its numbers.
pub(super) struct Division {
    /// Smallest and largest code.
    pub(super) codes: [i128; 2],
    /// The smallest code of 1/w.
    pub(super) least: i128,
    /// Bits of a code of 1/w.
    pub(super) bits: u32,
    /// Interpolation bits of u/w and 1/w.
    pub(super) fractions: [u32; 2],
    pub(super) roundings: [Rounding; 2],
    pub(super) last: Rounding,
    pub(super) window: [i128; 2],
    /// Whether both are planes that are walked from the window's corner.
    pub(super) planes: bool,
    pub(super) errors: Incoming,
}

fn symmetric(name: &'static str, most: &Rational) -> Variable {
    Variable::closed(name, -most.clone(), most.clone())
}

/// That 1/w stays above 0, and the value before its rounding within half an ULP.
pub(super) fn obligation(division: &Division) -> Obligation {
    let Division { codes: [low, high], least, bits, errors, .. } = division;
    let (whole, half) = (real(&scaled(1, *bits)), real(&dyadic(1, 1)));
    let mut variables = vec![
        Variable::closed("u", integer(*low), integer(*high)),
        Variable::closed("q", integer(*least), scaled(1, *bits) - integer(1)),
        symmetric("ep", &errors.p),
        symmetric("eq", &errors.q),
    ];
    // P 2^B / Q - u, times Q.
    let product = if errors.unit.is_zero() {
        "(* P whole)"
    } else {
        variables.push(symmetric("r", &errors.unit));
        "(* P whole (+ 1.0 r))"
    };
    Obligation {
        variables,
        definitions: vec![
            ("whole", whole),
            ("P", "(+ (/ (* u q) whole) ep)".to_owned()),
            ("Q", "(+ q eq)".to_owned()),
            ("off", format!("(- {product} (* u Q))")),
        ],
        facts: Vec::new(),
        violated: vec![
            "(<= Q 0.0)".to_owned(),
            format!("(and (> Q 0.0) (>= off (* {half} Q)))"),
            format!("(and (> Q 0.0) (<= off (- (* {half} Q))))"),
        ],
        fewer: None,
    }
}

/// That two rounded coordinates keep a weighted code within half an ULP.
pub(super) fn coordinate_obligation(rise: i128, nearest: bool, bits: u32) -> Obligation {
    let unit = dyadic(1, bits + u32::from(nearest));
    let half = real(&dyadic(1, 1));
    let difference = |name| symmetric(name, &integer(rise));
    Obligation {
        variables: vec![
            difference("u1"),
            difference("u2"),
            symmetric("e1", &unit),
            symmetric("e2", &unit),
        ],
        definitions: vec![("off", "(+ (* u1 e1) (* u2 e2))".to_owned())],
        facts: Vec::new(),
        violated: vec![format!("(>= off {half})"), format!("(<= off (- {half}))")],
        fewer: None,
    }
}

/// The least multiple of 2^-`places` that is not below, as Gappa writes it.
fn up(value: &Rational, places: u32) -> String {
    format!("{}b-{places}", (value * scaled(1, places)).ceil().to_integer())
}

/// The error of the code with every rounding of the planes and of the division; of walked planes.
pub(super) fn script(division: &Division, code: &Rational) -> Option<Script> {
    if !division.planes {
        return None;
    }
    let Division { codes: [low, high], least, bits, fractions, roundings, .. } = division;
    let [columns, rows] = division.window.map(|side| side - 1);
    let [p, q] =
        [0, 1].map(|n| format!("fixed<-{}, {}>", fractions[n], roundings[n].names().gappa));
    let plane = |name: &str, of: &str, round: &str| {
        vec![
            format!("s{name}$ = {round}(S{of}$);"),
            format!("dx{name}$ = {round}(DX{of}$);"),
            format!("dy{name}$ = {round}(DY{of}$);"),
            format!("{name}$ = s{name}$ + x$ * dx{name}$ + y$ * dy{name}$;"),
            format!("{of}$ = S{of}$ + x$ * DX{of}$ + y$ * DY{of}$;"),
        ]
    };
    let mut definitions = vec![format!("@rp$ = {p};"), format!("@rq$ = {q};")];
    definitions.extend(plane("p", "P", "rp$"));
    definitions.extend(plane("q", "Q", "rq$"));
    let whole = scaled(1, *bits);
    let unit = !division.errors.unit.is_zero();
    definitions.push(format!("U$ = P$ * {whole} / Q$;"));
    definitions.push(format!("w$ = p$ * {whole} / q${};", if unit { " * (1 + r$)" } else { "" }));
    definitions.push(format!("v$ = fixed<0, {}>(w$);", division.last.names().gappa));
    let mut hypotheses = vec![
        format!("x$ in [0, {columns}]"),
        format!("y$ in [0, {rows}]"),
        format!("U$ in [{low}, {high}]"),
        format!("Q$ in [{least}, {}]", &whole - Rational::one()),
    ];
    let walk = |name: &str, of: &str| {
        format!(
            "{name}$ - {of}$ -> (s{name}$ - S{of}$) + x$ * (dx{name}$ - DX{of}$) + y$ * (dy{name}$ - DY{of}$);"
        )
    };
    let quotient = format!("p$ * {whole} / q$");
    let mut hints = vec![
        walk("p", "P"),
        walk("q", "Q"),
        "q$ -> Q$ + (q$ - Q$);".to_owned(),
        format!(
            "{quotient} - U$ -> ((p$ - P$) * {whole} - U$ * (q$ - Q$)) / q$ {{ q$ <> 0, Q$ <> 0 }};"
        ),
    ];
    if unit {
        let most = up(&division.errors.unit, 80);
        hypotheses.push(format!("r$ in [-{most}, {most}]"));
        hints.push(format!("w$ - U$ -> ({quotient} - U$) * (1 + r$) + U$ * r$;"));
    }
    hints.push("v$ - U$ -> (v$ - w$) + (w$ - U$);".to_owned());
    Some(Script {
        comments: vec![
            "SP, DXP, DYP and SQ, DXQ, DYQ are the exact start and slopes of u/w and 1/w, U is the exact value;"
                .to_owned(),
            "x and y count pixels from the window's corner. The goal is the bound of the code's error, rounded up."
                .to_owned(),
        ],
        definitions,
        hypotheses,
        goals: vec![format!("|v$ - U$| <= {}", up(&(code + dyadic(1, 30)), 30))],
        hints,
    })
}
