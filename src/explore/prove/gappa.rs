//! Claims as a Gappa script. Spec clause `B-11`.

use super::Proof;
use std::fmt::Write as _;

/// One script for those of the claims that interval arithmetic with roundings can show; `None`
/// where there are none. Gappa proves and does not refute, so witnesses are no part of it.
pub fn script<'a>(proofs: impl IntoIterator<Item = &'a Proof>) -> Option<String> {
    let (mut head, mut hypotheses, mut goals, mut hints) =
        (String::new(), Vec::new(), Vec::new(), String::new());
    let parts = proofs.into_iter().filter_map(|proof| Some((proof, proof.formal.gappa.as_ref()?)));
    for (n, (proof, part)) in parts.enumerate() {
        let unique = |line: &String| line.replace('$', &format!("_{n}"));
        let _ = writeln!(head, "\n# {}: {}\n# {}", proof.claim, proof.place, proof.bound);
        for line in &part.comments {
            let _ = writeln!(head, "# {line}");
        }
        for line in part.definitions.iter().map(unique) {
            head += &(line + "\n");
        }
        hypotheses.extend(part.hypotheses.iter().map(unique));
        goals.extend(part.goals.iter().map(unique));
        for line in part.hints.iter().map(unique) {
            hints += &(line + "\n");
        }
    }
    if goals.is_empty() {
        return None;
    }
    let (hypotheses, goals) = (hypotheses.join(" ->\n  "), goals.join(" /\\\n  "));
    Some(format!(
        "# Growth bounds over whole windows, all in one property.\n{head}\n{{ {hypotheses} ->\n  \
         {goals} }}\n{hints}"
    ))
}
