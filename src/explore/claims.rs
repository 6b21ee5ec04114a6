//! Known facts about edge, depth and line arithmetic, recomputed by this project's own code.
//!
//! A claim states what is known and where the number comes from, the expectation, and what came
//! out. Exhaustive wherever the space is small; a statistical claim names its generator (always
//! [`crate::case::mix64`]), seed, sample count and tolerance. Lectures are cited by key: A
//! (Akeley and Hanrahan), O (Owens), M (Durand and Cutler), S (Sharma), I (the Italian one).

mod cover;
mod depth_error;
mod depth_format;
mod edge_budget;
mod edge_population;
mod edge_walk;
mod edge_width;
mod edge_word;
mod guard;
mod inverse_w;
mod line;
mod perspective;
mod plane;
mod profile;
mod reciprocal;
mod statement;
mod wraparound;

pub use statement::{Claim, Statement};

/// Every statement, in report order.
pub fn all() -> Vec<Statement> {
    [
        edge_width::statements(),
        edge_budget::statements(),
        edge_word::statements(),
        edge_walk::statements(),
        edge_population::statements(),
        cover::statements(),
        plane::statements(),
        depth_error::statements(),
        reciprocal::statements(),
        guard::statements(),
        wraparound::statements(),
        line::statements(),
        perspective::statements(),
        inverse_w::statements(),
        profile::statements(),
        depth_format::statements(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The statement called `id`.
pub fn find(id: &str) -> Option<Statement> {
    all().into_iter().find(|statement| statement.id == id)
}

/// Checks every statement in order. `progress` gets how many are done, how many there are and the
/// id of the next; it returns false to stop, and what is done by then is returned.
pub fn run(progress: &mut dyn FnMut(usize, usize, &str) -> bool) -> Vec<Claim> {
    let statements = all();
    let mut claims = Vec::with_capacity(statements.len());
    for (done, statement) in statements.iter().enumerate() {
        if !progress(done, statements.len(), &statement.id) {
            break;
        }
        claims.push(statement.check());
    }
    claims
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn ids_are_unique_and_found() {
        let statements = all();
        let ids: BTreeSet<&str> = statements.iter().map(|s| s.id.as_str()).collect();
        assert_eq!(ids.len(), statements.len());
        assert!(ids.iter().all(|id| find(id).is_some_and(|s| s.id == **id)));
        assert!(find("no.such.claim").is_none());
    }

    #[test]
    fn quick_claims_hold() {
        for statement in all().iter().filter(|s| s.quick) {
            let claim = statement.check();
            assert!(claim.good, "{}: expected {}, got {}", claim.id, claim.expected, claim.got);
        }
    }

    #[test]
    fn a_run_stops_when_told() {
        let mut asked = 0;
        let claims = run(&mut |done, total, _| {
            asked += 1;
            assert!(done < total);
            done < 2
        });
        assert_eq!((claims.len(), asked), (2, 3));
    }
}
