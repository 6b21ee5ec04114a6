//! Steppers, evaluators and the read-out: a miter of the module and the reference as gates, for all time.

use super::miter::{Held, Miter};
use super::work::Work;
use super::{Asked, EquivalenceError, Refutation, Verdict};
use crate::vector::reference::{Language, package, reference};

/// Asks whether the module answers as the reference does.
pub(super) fn prove(
    asked: &Asked<'_>,
    work: &Work<'_>,
) -> Result<(Verdict, Vec<String>), EquivalenceError> {
    let Asked { profile, unit, map, module, .. } = *asked;
    work.write("reference.sv", &reference(profile, Language::Sv)?)?;
    let name = format!("{}_{}", package(profile), unit.block.module());
    let assumed = map.assumed(unit);
    let ways = if map.held { &[Held::Loaded, Held::Followed][..] } else { &[Held::Followed] };
    let mut said = String::new();
    for held in ways {
        work.write("miter.sv", &Miter(asked, *held).text(&name))?;
        work.netlist(&format!("{}\nread_verilog -sv reference.sv", module.read), &map.module)?;
        // A proof in which nothing is ever compared would be none.
        let reached = work.pdr("compared", "bad")?;
        if !reached.is_some_and(|ran| ran.says("was asserted in frame")) {
            let words =
                "no input leads to a clock at which answers are compared, or none was found";
            return Ok((Verdict::Undecided { words: words.to_owned() }, assumed));
        }
        said = match work.pdr("bad", "compared")? {
            Some(ran) if ran.good() && ran.says("Property proved.") => {
                let engine = "yosys-abc scorr and pdr";
                return Ok((Verdict::Proved { engine, words: ran.last() }, assumed));
            }
            Some(ran) => {
                let said = format!("yosys-abc pdr: {}", ran.last());
                return Ok((search(work, map.latency, &said)?, assumed));
            }
            None => {
                let seconds = work.limit.as_secs();
                format!("yosys-abc pdr ran longer than {seconds} s: give more with --limit")
            }
        };
    }
    Ok((search(work, map.latency, &said)?, assumed))
}

/// Looks for inputs that make a difference, from reset on, after what another tool said.
fn search(work: &Work<'_>, latency: u32, said: &str) -> Result<Verdict, EquivalenceError> {
    const WAVE: &str = "counterexample.vcd";
    let undecided = |words: String| Ok(Verdict::Undecided { words: format!("{said}; {words}") });
    work.yosys("smt2", "read_rtlil netlist.il\nwrite_smt2 -wires miter.smt2\n")?;
    if !work.read("miter.smt2")?.contains("yosys-smt2-assert") {
        return undecided("yosys wrote no assertion, so no search was made".to_owned());
    }
    let depth = (latency + 12).to_string();
    let arguments = ["-s", "z3", "-t", &depth, "--noprogress", "--dump-vcd", WAVE, "miter.smt2"];
    match work.run("yosys-smtbmc", &arguments, "smtbmc.log")? {
        Some(ran) if ran.says("Status: FAILED") => Ok(Verdict::Refuted(Refutation::Wave(WAVE))),
        Some(ran) => undecided(format!("yosys-smtbmc, {depth} clocks: {}", ran.last())),
        None => undecided(format!("yosys-smtbmc ran longer than {} s", work.limit.as_secs())),
    }
}
