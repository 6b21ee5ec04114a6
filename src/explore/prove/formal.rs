//! A claim as other provers take it: variables over intervals, definitions, and a violation.
//! Spec clause `B-11`.

use crate::exact::Rational;

/// What each prover is handed; either may be missing.
#[derive(Clone, Debug, Default)]
pub(in crate::explore) struct Formal {
    /// For SMT solvers.
    pub(super) smt: Option<Obligation>,
    /// For Gappa.
    pub(super) gappa: Option<Script>,
}

/// A real variable within an interval.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) name: &'static str,
    pub(super) low: Rational,
    pub(super) high: Rational,
    /// Whether the ends are left out.
    pub(super) open: bool,
}

impl Variable {
    pub(super) fn closed(name: &'static str, low: Rational, high: Rational) -> Self {
        Self { name, low, high, open: false }
    }
}

/// Terms are SMT-LIB text.
#[derive(Clone, Debug)]
pub(super) struct Obligation {
    pub(super) variables: Vec<Variable>,
    pub(super) definitions: Vec<(&'static str, String)>,
    /// Further facts on the variables, such as that they are lattice distances.
    pub(super) facts: Vec<String>,
    /// The ways in which `bits` would not be enough: no values may satisfy any of them. Solvers
    /// decide each by itself at once, and their disjunction not.
    pub(super) violated: Vec<String>,
    /// That one bit fewer is not enough, and the witness's values, which must satisfy it.
    pub(super) fewer: Option<(String, Vec<(&'static str, Rational)>)>,
}

/// One part of a Gappa script. `$` in a name stands for what makes it unique in the script.
#[derive(Clone, Debug)]
pub(super) struct Script {
    /// Comment lines.
    pub(super) comments: Vec<String>,
    /// Definitions, one a line.
    pub(super) definitions: Vec<String>,
    /// Ranges of the free variables.
    pub(super) hypotheses: Vec<String>,
    /// What is to be shown.
    pub(super) goals: Vec<String>,
    /// Rewriting hints.
    pub(super) hints: Vec<String>,
}

/// A rational as an SMT-LIB real.
pub(super) fn real(value: &Rational) -> String {
    use num_traits::Signed;
    let magnitude = value.abs();
    let text = if magnitude.is_integer() {
        format!("{}.0", magnitude.numer())
    } else {
        format!("(/ {}.0 {}.0)", magnitude.numer(), magnitude.denom())
    };
    if value.is_negative() { format!("(- {text})") } else { text }
}
