//! One row a machine.

use super::{Request, compared, interruptible, number, picture};
use crate::cli::Outcome;
use crate::cli::failure::Failure;
use crate::cli::output::{Output, write_text};
use guardbit::measure::comparison::{Comparison, Row, Saved};

pub(super) fn show(request: Request<'_>) -> Result<Outcome, Failure> {
    let (names, timed) = (request.machines(), request.timed());
    let Request { profile, scene, arguments } = request;
    let svg = arguments.svg.as_ref().map(|path| (path, scene.clone()));
    let made = compared(scene, &profile)?;
    let comparison =
        interruptible(|go_on| made.measure(&names, timed, go_on).map_err(Failure::input))?;
    if comparison.refused > 0 {
        eprintln!(
            "note: {}: {} triangles are left out, because a vertex is outside the vertex field or behind the camera",
            comparison.scene, comparison.refused
        );
    }
    if comparison.triangles == 0 {
        return Err(Failure::input(format!("{}: no triangle can be drawn", comparison.scene))
            .hint("choose another --scene, or a profile with a larger vertex field"));
    }
    if let Some((path, scene)) = svg {
        let mut made = compared(scene, &profile)?;
        write_text(path, &picture::machines(&mut made, &comparison)?)?;
    }
    let mut output = Output::new();
    if arguments.json {
        output.json(&comparison)?;
    } else {
        print(&mut output, &profile.name, &comparison)?;
    }
    output.flush()?;
    // What is exact by construction and differs, or leaves a stated bound, is a defect of this program.
    for Row { name, exact, coverage_differs, depth_of_bound, beyond_bound, .. } in
        &comparison.machines
    {
        if *exact && *coverage_differs > 0 {
            eprintln!(
                "error: {name}: its coverage must be exact, but differs from the exact picture; the machine is wrong"
            );
            return Ok(Outcome::Mismatch);
        }
        if depth_of_bound.is_some_and(|part| part > 1.0) || beyond_bound.is_some_and(|n| n > 0) {
            eprintln!(
                "error: {name} exceeds the error bound that its clause states; the machine or the bound is wrong"
            );
            return Ok(Outcome::Mismatch);
        }
    }
    Ok(Outcome::Good)
}

/// How much of its stated bound a machine used.
fn bound(row: &Row) -> String {
    match (row.depth_of_bound, row.beyond_bound) {
        (Some(part), Some(_)) => number(part),
        _ => "none".to_owned(),
    }
}

/// One line of the first table.
fn columns(cells: [&str; 11]) -> String {
    let [name, known, differ, holes, twice, worst, mean, bound, bits, samples, ns] = cells;
    format!(
        "{name:<16} {known:<17} {differ:>7} {holes:>6} {twice:>6} {worst:>16} {mean:>9} {bound:>6} \
         {bits:>11} {samples:>9} {ns:>8}"
    )
    .trim_end()
    .to_owned()
}

fn print(output: &mut Output, profile: &str, comparison: &Comparison) -> Result<(), Failure> {
    let Comparison { scene, window, triangles, samples, machines, saved, .. } = comparison;
    output.line(format!(
        "{scene} with {profile}: {} x {}, {triangles} triangles, {samples} samples",
        window[0], window[1]
    ))?;
    output.line("")?;
    output.line(columns([
        "",
        "",
        "samples",
        "",
        "",
        "depth error, ULP",
        "",
        "of",
        "bits",
        "samples",
        "ns",
    ]))?;
    output.line(columns([
        "machine",
        "known as",
        "differ",
        "holes",
        "twice",
        "worst",
        "mean",
        "bound",
        "accumulated",
        "evaluated",
        "fragment",
    ]))?;
    for row in machines {
        let depth = |value: Option<f64>| value.map_or("-".to_owned(), number);
        output.line(columns([
            row.name,
            row.known_as,
            &if row.exact { "exact".to_owned() } else { row.coverage_differs.to_string() },
            &row.holes.to_string(),
            &row.double_hits.to_string(),
            &depth(row.depth_worst_ulp),
            &depth(row.depth_mean_ulp),
            &bound(row),
            &row.accumulator_bits.to_string(),
            &ratio(row.work.visits, row.fragments),
            &depth(row.ns_per_fragment),
        ]))?;
    }
    output.line("")?;
    output.line(
        "                  operations per triangle: set-up    operations per fragment: the rest",
    )?;
    output.line(
        "machine              add   mul   div   cmp               add     mul     div     cmp",
    )?;
    for row in machines {
        let (t, f) = (row.ops.triangle, row.ops.fragment);
        output.line(format!(
            "{:<17} {:>6} {:>5} {:>5} {:>5}          {:>8} {:>7} {:>7} {:>7}",
            row.name,
            t.add,
            t.multiply,
            t.divide,
            t.compare,
            number(f.add),
            number(f.multiply),
            number(f.divide),
            number(f.compare)
        ))?;
    }
    channels(output, machines)?;
    let unstated = machines.iter().filter(|row| bound(row) == "none").map(|row| row.name);
    let unstated: Vec<&str> = unstated.collect();
    if !unstated.is_empty() {
        output.line("")?;
        output.line(format!(
            "these machines state no bound for this profile, so it is not checked: {}",
            unstated.join(", ")
        ))?;
    }
    for Saved { evaluator, why, triangle, fragment, bits, area_um2 } in saved {
        let counts = [
            (*triangle, "operations per triangle"),
            (*fragment, "operations per fragment"),
            (u64::from(*bits), "accumulator bits"),
        ];
        let counts = counts.iter().filter(|(count, _)| *count > 0);
        let counts: Vec<String> = counts.map(|(count, what)| format!("{count} {what}, ")).collect();
        output.line("")?;
        output.line(format!(
            "left out: {evaluator} ({why}); saves {}{} um2",
            counts.concat(),
            number(*area_um2)
        ))?;
    }
    Ok(())
}

/// The errors of the channels that the scene needs, a line for each and machine.
fn channels(output: &mut Output, machines: &[Row]) -> Result<(), Failure> {
    if machines.iter().all(|row| row.channels.is_empty()) {
        return Ok(());
    }
    output.line("")?;
    output.line("                                      error of the code, ULP: all components")?;
    output.line("machine           channel                  worst      mean       RMS")?;
    for row in machines {
        for channel in &row.channels {
            let [worst, mean, rms] =
                [channel.ulp.worst, channel.ulp.mean, channel.ulp.rms].map(number);
            output.line(format!(
                "{:<17} {:<18} {worst:>11} {mean:>9} {rms:>9}",
                row.name, channel.name
            ))?;
        }
    }
    Ok(())
}

#[allow(clippy::cast_precision_loss, reason = "counts are reported as rates")]
fn ratio(all: u64, of: u64) -> String {
    if of == 0 { "-".to_owned() } else { number(all as f64 / of as f64) }
}
