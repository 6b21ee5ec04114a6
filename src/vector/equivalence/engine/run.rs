//! A solver's search for a run from a reset on that shows a difference.

use crate::vector::equivalence::work::Work;
use crate::vector::equivalence::{EquivalenceError, Refutation, Verdict};
use std::fmt::Write as _;

/// The file of waves.
pub(super) const WAVE: &str = "counterexample.vcd";
/// Clocks of the longest run that is looked for.
const CLOCKS: u32 = 200;
/// Seconds that the search may take, if no less is given.
const SECONDS: u64 = 60;

/// How yosys writes one of two outputs of a netlist as gates.
pub(super) fn gates(netlist: &str, output: &str, other: &str) -> String {
    format!(
        "read_rtlil {netlist}.il\nchformal -remove\ndelete -output w:{other}\nopt_expr\nwreduce\nopt_expr\nopt_merge\n\
         formalff -clk2ff -ff2anyinit\ntechmap\nopt_clean\nabc -g AND -fast\nopt_clean\n\
         write_aiger -zinit -map {output}.map {output}.aig\n"
    )
}

/// Looks for a run, after what another tool said.
pub(super) fn search(work: &Work<'_>, said: &str) -> Result<Verdict, EquivalenceError> {
    let undecided = |words: &str| Ok(Verdict::Undecided { words: format!("{said}; {words}") });
    work.yosys("aiger-search", &gates("search", "bad", "compared"))?;
    let seconds = work.limit.as_secs().clamp(1, SECONDS);
    let ran = work.abc("bad", &format!("bmc3 -F {CLOCKS} -T {seconds}"))?;
    let frame = ran.and_then(|ran| {
        let last = ran.last();
        let (_, frame) = last.split_once("was asserted in frame ")?;
        frame.split('.').next()?.trim().parse::<u32>().ok()
    });
    let Some(frame) = frame else {
        return undecided(&format!(
            "nor does any run that yosys-abc bmc3 finds in {seconds} s, of at most {CLOCKS} clocks"
        ));
    };
    let script = format!(
        "read_rtlil search.il\nchformal -remove\nopt_clean\nsat -tempinduct-baseonly -tempinduct -maxsteps {} \
         -prove bad 0 -show-public -dump_vcd wave.vcd guardbit_miter\n",
        frame + 2
    );
    work.write("wave.ys", &script)?;
    let _ = work.run("yosys", &["-q", "wave.ys"], "wave.log")?;
    if !work.folder.join("wave.vcd").exists() {
        return undecided(&format!(
            "yosys-abc bmc3 finds one after {frame} clocks, and yosys no wave of it: give more time with --limit"
        ));
    }
    work.write(WAVE, &plain(&work.read("wave.vcd")?))?;
    Ok(Verdict::Refuted(Refutation::Wave(WAVE)))
}

/// The waves of yosys with plain names, and ten units a clock.
fn plain(text: &str) -> String {
    let (mut clock, mut plain) = (0, String::new());
    for line in text.lines() {
        if line.starts_with('#') {
            let _ = writeln!(plain, "#{}", clock * 10);
            clock += 1;
        } else {
            plain.extend([&line.replace('\\', ""), "\n"]);
        }
    }
    plain
}
