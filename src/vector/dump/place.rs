//! Where a defect is, from what differs. Clause `N-14`.

use super::explain::Causes;
use super::observe::Observed;
use super::{Judged, Placed};
use crate::format::Role;

/// Where the defect is: modules, likeliest first, and the columns that show it. Modules in `sound` have
/// been seen to be right, `broken` ones have not.
pub(super) fn place(
    (group, all): (&[&Judged], &[&Judged]),
    causes: &Causes,
    sound: &[&str],
    broken: &[&str],
) -> Placed {
    let mut columns: Vec<String> = Vec::new();
    for Judged { subject, report, .. } in group {
        let observed = &report.observed;
        let stem = subject.spec.stem.trim_end_matches(".exp");
        let mut add = |name: &str| {
            let told = if group.len() > 1 { format!("{stem}.{name}") } else { name.to_owned() };
            if !columns.contains(&told) {
                columns.push(told);
            }
        };
        observed.differ.iter().for_each(|differs| add(&differs.column));
        if observed.missing + observed.extra > 0 {
            // Without a key, rows are told apart by their test.
            let key = subject.key().max(usize::from(subject.names_tests()));
            subject.spec.columns[..key].iter().for_each(|column| add(&column.name));
        }
    }
    let mut modules: Vec<&str> = Vec::new();
    for (_, place) in &causes.named {
        let module = place.map(|(module, _)| module);
        modules.extend(module.filter(|module| !modules.contains(module)));
    }
    if modules.is_empty() || modules.len() > 2 {
        modules = by_columns(group, all);
        modules.retain(|module| !sound.contains(module));
    }
    if group[0].subject.bench.name() == "triangle" {
        // What is wrong by itself is enough to make an engine wrong.
        modules.sort_by_key(|module| !broken.contains(module));
        let parts = ["dda", "edge_stepper"];
        let own: Vec<&str> = broken.iter().copied().filter(|part| parts.contains(part)).collect();
        modules.splice(
            ..0,
            own.into_iter().filter(|part| !modules.contains(part)).collect::<Vec<_>>(),
        );
    }
    Placed { modules: modules.into_iter().map(str::to_owned).collect(), columns }
}

/// What the files and columns that differ, and the classes of their rows, say of the module.
fn by_columns(group: &[&Judged], all: &[&Judged]) -> Vec<&'static str> {
    let Judged { subject, report, .. } = group[0];
    let plane = |name: &str| {
        [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY].iter().any(|role| role.pattern == name)
    };
    let differ = &report.observed.differ;
    let file = |stem: &str| {
        all.iter()
            .find(|judged| judged.subject.spec.stem == stem)
            .map(|judged| &judged.report.observed)
    };
    match subject.bench.name() {
        "dda" => vec!["dda"],
        "edge" => vec!["edge_stepper"],
        // The quotients are all that the divider makes, and it makes all three.
        "setup" if differ.len() == 3 && differ.iter().all(|d| plane(&d.column)) => {
            vec!["setup_divider", "triangle_setup"]
        }
        "setup" => vec!["triangle_setup"],
        "channel" if group[0].subject.spec.stem == "channel-setup.exp" => vec!["channel_setup"],
        "channel" => vec!["interpolator"],
        name if name.starts_with("interpolator-") => vec!["interpolator"],
        name if name.starts_with("reciprocal-") => vec!["reciprocal_unit"],
        // What the reciprocal gives is looked at before what is made of it.
        name if name.starts_with("divider-") => {
            let unit = differ.iter().any(|d| ["mantissa", "exponent"].contains(&d.column.as_str()));
            let read = differ.iter().any(|d| ["p", "q"].contains(&d.column.as_str()));
            if unit && !read { vec!["reciprocal_unit"] } else { vec!["perspective_divider"] }
        }
        "triangle" => {
            let moved = |seen: &Observed| seen.missing + seen.extra > 0;
            let runs = file("span.exp").is_some_and(moved) || file("depth.exp").is_some_and(moved);
            let depths = file("depth.exp").is_some_and(|seen| !seen.differ.is_empty());
            // In these every sample of a box is covered, whatever the edges step by.
            let still = |seen: &Observed| {
                ["guard-patterns", "guard-splits"]
                    .iter()
                    .any(|class| seen.classes.contains_key(*class))
            };
            let covered = file("depth.exp").is_some_and(|seen| !moved(seen));
            if depths && !runs {
                vec!["depth_evaluator", "dda"]
            } else if covered {
                // Every covered sample is there, and none too many: the edges are right.
                vec!["triangle_engine"]
            } else if runs
                && !["span.exp", "depth.exp"].iter().filter_map(|stem| file(stem)).any(still)
            {
                vec!["edge_evaluator", "triangle_engine", "edge_stepper"]
            } else {
                vec!["triangle_engine", "edge_evaluator"]
            }
        }
        _ => Vec::new(),
    }
}
