//! Claims as SMT-LIB 2.6 text. Spec clause `B-11`.

use super::Proof;
use super::formal::{Obligation, Variable, real};
use std::fmt::Write as _;

/// Each question starts from nothing rather than from a pushed context: solvers have a quicker way
/// for a single question than for an incremental one.
const FRESH: &str = "(reset)\n(set-logic QF_NRA)\n";

/// One file for all these claims: what must be unsatisfiable and, from the witness, what must not.
///
/// Reals, not bit-vectors: the bounds are linear or bilinear in box variables, which a solver
/// decides at once, while words of this width take it for ever.
pub fn script<'a>(proofs: impl IntoIterator<Item = &'a Proof>) -> String {
    let mut text = "; Growth bounds over whole windows, one claim after the other.\n\
                    (set-info :smt-lib-version 2.6)\n"
        .to_owned();
    for proof in proofs {
        match &proof.formal.smt {
            Some(obligation) => text += &part(proof, obligation),
            None => {
                let _ = writeln!(
                    text,
                    "\n; {}: nothing to decide, no number of bits is enough",
                    proof.claim
                );
            }
        }
    }
    text + "\n(exit)\n"
}

fn part(proof: &Proof, obligation: &Obligation) -> String {
    let bits = proof.bits.unwrap_or(0);
    let mut text = format!("\n; {}: {}\n; {}\n", proof.claim, proof.place, proof.bound);
    let declare = |text: &mut String, values: &dyn Fn(&Variable) -> String| {
        for variable in &obligation.variables {
            let _ = writeln!(text, "(declare-const {} Real)", variable.name);
        }
        for variable in &obligation.variables {
            text.push_str(&values(variable));
        }
        for (name, term) in &obligation.definitions {
            let _ = writeln!(text, "(define-fun {name} () Real {term})");
        }
        for fact in &obligation.facts {
            let _ = writeln!(text, "(assert {fact})");
        }
    };
    let within = |variable: &Variable| {
        let Variable { name, low, high, open } = variable;
        let relation = if *open { "<" } else { "<=" };
        format!("(assert ({relation} {} {name} {}))\n", real(low), real(high))
    };
    for violated in &obligation.violated {
        text += FRESH;
        declare(&mut text, &within);
        let _ = writeln!(text, "(assert {violated})");
        text += &ask(&proof.claim, bits, "unsat");
    }
    if let Some((violated, values)) = &obligation.fewer {
        text += FRESH;
        let fixed = |variable: &Variable| {
            let value = values.iter().find(|(name, _)| *name == variable.name);
            value.map_or_else(
                || within(variable),
                |(name, value)| format!("(assert (= {name} {}))\n", real(value)),
            )
        };
        declare(&mut text, &fixed);
        let _ = writeln!(text, "(assert {violated})");
        text += &ask(&proof.claim, bits.saturating_sub(1), "sat");
    }
    text
}

fn ask(claim: &str, bits: u32, expect: &str) -> String {
    format!(
        "; expect: {expect}\n(echo \"{claim} with {bits} bits, expect {expect}\")\n(check-sat)\n"
    )
}

#[cfg(test)]
mod tests {
    use crate::exact::ratio;
    use crate::explore::prove::formal::real;

    #[test]
    fn reals_have_points_and_no_signs() {
        assert_eq!(real(&ratio(-3, 1).unwrap()), "(- 3.0)");
        assert_eq!(real(&ratio(1, -3).unwrap()), "(- (/ 1.0 3.0))");
    }
}
