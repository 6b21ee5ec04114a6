//! Joining the answers of all parts of a request.

use super::report::{Report, digest};
use super::{Failure, PathBuf, Request};
use guardbit::explore::fit::Effort;
use guardbit::profile::read_text_at_most;

/// The most bytes of an answer that are read.
const LARGEST: u64 = 1 << 26;

/// Joins the answers of all parts: the cheapest of them is the cheapest of the whole.
pub(super) fn merge(request: &Request<'_>, files: &[PathBuf]) -> Result<Report, Failure> {
    let mut parts: Vec<Report> = Vec::new();
    for path in files {
        let name = path.display().to_string();
        let text = read_text_at_most(path, LARGEST).map_err(|error| Failure::io(&name, &error))?;
        let report: Report = serde_json::from_str(&text).map_err(|error| {
            Failure::input(format!("{name}:{}: {error}", error.line()))
                .hint("--merge reads files that `fit --save` wrote")
        })?;
        if report.request != digest(request) {
            return Err(Failure::input(format!(
                "{name}: the answer to another request: profile, axes, scenes, tolerances and cost \
                 have to be the same"
            )));
        }
        parts.push(report);
    }
    let count = parts.first().and_then(|part| part.part).map_or(1, |[_, parts]| parts);
    for index in 0..count {
        let of = parts.iter().filter(|p| p.part.unwrap_or([0, 1]) == [index, count]).count();
        if of != 1 {
            return Err(Failure::input(format!(
                "part {index}/{count} is in {of} files, but must be in exactly 1"
            ))
            .hint("name the answer of each part once"));
        }
    }
    if parts.len() as u64 != count {
        let message = format!("there are {} files, but the request has {count} parts", parts.len());
        return Err(Failure::input(message).hint("name the answer of each part once"));
    }
    let key =
        |report: &Report| (report.cost.unwrap_or(f64::INFINITY), report.index.unwrap_or(u64::MAX));
    let mut whole = parts
        .iter()
        .min_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.cmp(&key(b).1)))
        .cloned()
        .ok_or_else(|| Failure::input("there are no parts to join"))?;
    whole.effort = Effort::default();
    for part in &parts {
        whole.effort.add(&part.effort);
    }
    whole.evaluated = whole.effort.evaluated;
    whole.pruned = whole.effort.pruned();
    whole.budgets = parts.iter().map(|part| part.budgets).sum();
    whole.part = None;
    Ok(whole)
}
