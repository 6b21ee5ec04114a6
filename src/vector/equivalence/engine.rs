//! Engines for all set-up words, all boxes of a small window, and every pattern of ready. Spec clause `J-12`.
//!
//! A triangle with every ready high takes a known number of clocks in a given box, so its run is unrolled. At each
//! of its clocks a solver is asked whether another ready would make any other difference than a wait.

mod cut;
mod draw;
mod expect;
mod induction;
mod run;
mod search;

use super::netlist::{self, Flat};
use super::work::{Work, set};
use super::{Asked, EquivalenceError, MapError, Refutation, Verdict};
use crate::vector::reference::{Language, reference};
use expect::Texts;
use induction::{LIMIT, SIDE, SIDES, SIDES_BITS};
use run::WAVE;
use search::Worked;
use std::fmt::Write as _;

/// Pixels of a window whose boxes are all proved.
const PIXELS: u32 = 16;

/// Asks whether an engine answers as the profile's does.
pub(super) fn prove(
    asked: &Asked<'_>,
    work: &Work<'_>,
) -> Result<(Verdict, Vec<String>), EquivalenceError> {
    let Asked { profile, devices, map, module, .. } = *asked;
    let window = [profile.window.width, profile.window.height];
    let [columns, rows] = window;
    if columns.saturating_mul(rows) > PIXELS {
        let what = format!(
            "the window of {} has {columns} x {rows} pixels: an engine is proved for windows of at most {PIXELS} \
             pixels; take a profile with another [window], as tiny has it",
            profile.name
        );
        return Err(MapError { module: map.module.clone(), what }.into());
    }
    let [read, edge] = devices.registers();
    let texts = Texts { asked, window, widths: [edge.width(), read.width(), read.integer()] };
    let assumed = assumed(&texts);
    let undecided = |words: String| Verdict::Undecided { words };
    work.write("reference.sv", &reference(profile, Language::Sv)?)?;
    work.write("miter.sv", &texts.search())?;
    work.netlist(&format!("{}\nread_verilog -sv reference.sv", module.read), &map.module)?;
    work.write("search.il", &work.read("netlist.il")?)?;
    let design = |what: String| asked.design(what);
    let flat = netlist::flat(&work.read("clocked.json")?).map_err(design)?;
    let triangles = match texts.work(&flat).map_err(design)? {
        Worked::Wrong(wave) => {
            work.write(WAVE, &wave)?;
            return Ok((Verdict::Refuted(Refutation::Wave(WAVE)), assumed));
        }
        Worked::Right { triangles: 0, .. } | Worked::Right { records: 0, .. } => {
            let words = "no triangle came to an end, so nothing was compared".to_owned();
            return Ok((undecided(words), assumed));
        }
        Worked::Right { triangles, .. } => triangles,
    };
    let flat = core(asked, work)?;
    let verdict = match induce(&texts, work, &flat)? {
        Ok(proved) => proved,
        Err(said) => {
            let said = format!("{said}; {triangles} triangles from a reset on show no difference");
            run::search(work, &said)?
        }
    };
    Ok((verdict, assumed))
}

/// The engine without its registers, in `core.json`.
fn core(asked: &Asked<'_>, work: &Work<'_>) -> Result<Flat, EquivalenceError> {
    let Asked { map, module, .. } = *asked;
    // Registers may begin with anything: a reset may come at any time.
    let script = format!(
        "{}\nchformal -remove\n{}hierarchy -check -top {}\nproc\nflatten\nsetundef -undriven -anyseq\nmemory\n\
         opt_clean\ncheck\nasync2sync\ndffunmap\nopt_clean\nrename -top guardbit_core\nsetattr -unset init w:*\n\
         write_json registers.json\n",
        module.read,
        set(&map.module, &module.parameters),
        map.module
    );
    work.yosys("registers", &script)?;
    work.has_one_driver("registers.log", &map.module)?;
    let text = work.read("registers.json")?;
    let flat = netlist::flat(&text).map_err(|what| asked.design(what))?;
    // Whatever holds a state and is not cut would have one of its own in each copy.
    let holds = |kind: &str| {
        let kind = kind.to_lowercase();
        kind != "$dff" && ["ff", "latch", "mem", "sr_"].iter().any(|part| kind.contains(part))
    };
    if let Some(cell) = flat.cells.values().find(|cell| holds(&cell.kind)) {
        return Err(asked.design(format!("it has a register ({}) that is not cut here", cell.kind)));
    }
    if !flat.is_clocked() {
        return Err(asked.design("it has no register: an engine needs some".to_owned()));
    }
    work.write("core.json", &cut::cut(&text, &flat).map_err(|what| asked.design(what))?)?;
    Ok(flat)
}

/// Asks for each box. `Err`: why that does not do.
fn induce(
    texts: &Texts<'_>,
    work: &Work<'_>,
    flat: &Flat,
) -> Result<Result<Verdict, String>, EquivalenceError> {
    let design = |what: String| texts.asked.design(what);
    let known = match texts.known(flat).map_err(design)? {
        Ok(known) => known,
        Err(words) => return Ok(Err(words)),
    };
    work.write("miter.sv", &texts.induction(&known))?;
    work.yosys(
        "induction",
        "read_json core.json\nread_verilog -sv reference.sv\nread_verilog -sv -formal miter.sv\n\
         hierarchy -check -top guardbit_miter\nproc\nflatten\nsetundef -undriven -anyseq\nopt_clean\n\
         write_rtlil netlist.il\n",
    )?;
    for (output, other) in [("compared", "bad"), ("bad", "compared")] {
        work.yosys(&format!("aiger-{output}"), &run::gates("netlist", output, other))?;
    }
    let mut boxes = Vec::new();
    for sides in all_boxes(texts.window) {
        let named = SIDES.into_iter().zip(sides.map(u64::from));
        let mut list = [("", 0); 4];
        list.iter_mut().zip(named).for_each(|(entry, side)| *entry = side);
        match texts.clocks(flat, list).map_err(design)? {
            Ok(clocks) => boxes.push((sides, clocks)),
            Err(words) => return Ok(Err(words)),
        }
    }
    // A proof in which nothing is ever compared would be none.
    if let Some(last) = boxes.last() {
        at_box(texts, work, "compared", *last)?;
        let reached = work.abc("box", &format!("bmc3 -F {}", last.1 + 1))?;
        if !reached.is_some_and(|ran| ran.says("was asserted in frame")) {
            return Ok(Err("no input leads to a clock at which records are compared".to_owned()));
        }
    }
    let mut total = 0;
    for (sides, seen) in &boxes {
        let [top, bottom, left, right] = sides;
        let name = format!("the box of rows {top} to {bottom} and columns {left} to {right}");
        let (mut proved, mut last) = (false, String::new());
        // Other triangles may take longer than those that were seen.
        for clocks in [seen + seen / 4 + 1, seen + seen / 2 + 8] {
            at_box(texts, work, "bad", (*sides, clocks))?;
            let frames = clocks + 1;
            let how =
                format!("frames -i -F {frames}; orpos; &get; &fraig -x -C 1000; &put; iprove");
            let Some(ran) = work.abc("box", &how)? else {
                let seconds = work.limit.as_secs();
                return Ok(Err(format!(
                    "{name}: yosys-abc ran longer than {seconds} s: give more with --limit"
                )));
            };
            last = ran.last();
            proved = ran.good() && last.starts_with("UNSATISFIABLE");
            if proved {
                total += clocks;
                break;
            }
        }
        if !proved {
            return Ok(Err(format!("the induction fails in {name}, yosys-abc: {last}")));
        }
    }
    let count = boxes.len();
    let words = format!("{count} of {count} boxes are UNSATISFIABLE, {total} clocks in all");
    Ok(Ok(Verdict::Proved {
        engine: "yosys-abc fraig and iprove, by induction over triangles",
        words,
    }))
}

/// All boxes of a window, top, bottom, left, right: small ones first.
fn all_boxes([columns, rows]: [u32; 2]) -> Vec<[u32; 4]> {
    let pairs =
        |size: u32| (0..=size).flat_map(move |low| (low..=size).map(move |high| [low, high]));
    let mut list: Vec<[u32; 4]> =
        pairs(rows).flat_map(|[a, b]| pairs(columns).map(move |[c, d]| [a, b, c, d])).collect();
    list.sort_by_key(|[a, b, c, d]| (b - a) * (d - c));
    list
}

/// Writes the gates of an output with the box and its clocks as the first value of their register, in `box.aig`.
fn at_box(
    texts: &Texts<'_>,
    work: &Work<'_>,
    output: &str,
    (sides, clocks): ([u32; 4], u32),
) -> Result<(), EquivalenceError> {
    let odd = || texts.asked.design(format!("{output}.aig of yosys is not as expected"));
    let names = work.read(&format!("{output}.map"))?;
    let path = work.folder.join(format!("{output}.aig"));
    let gates = std::fs::read(&path).map_err(super::io(&path))?;
    let bits =
        sides.iter().rev().fold(u64::from(clocks), |bits, side| bits << SIDE | u64::from(*side));
    let end = gates.iter().position(|byte| *byte == b'\n').ok_or_else(odd)?;
    let head = String::from_utf8_lossy(&gates[..end]).into_owned();
    let numbers: Vec<usize> = head.split(' ').skip(1).filter_map(|n| n.parse().ok()).collect();
    let [_, inputs, latches, ..] = numbers[..] else { return Err(odd()) };
    let mut lines = Vec::new();
    let mut rest = &gates[end + 1..];
    for _ in 0..latches {
        let end = rest.iter().position(|byte| *byte == b'\n').ok_or_else(odd)?;
        lines.push(String::from_utf8_lossy(&rest[..end]).into_owned());
        rest = &rest[end + 1..];
    }
    let mut found = 0u64;
    for line in names.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let ["latch", latch, bit, "guardbit_box"] = words[..] else { continue };
        let (latch, bit): (usize, u32) =
            (latch.parse().map_err(|_| odd())?, bit.parse().map_err(|_| odd())?);
        let line = lines.get_mut(latch).ok_or_else(odd)?;
        // It holds what it begins with.
        if *line != (2 * (inputs + latch + 1)).to_string() || bit >= 64 {
            return Err(odd());
        }
        if bits >> bit & 1 == 1 {
            line.push_str(" 1");
        }
        found |= 1 << bit;
    }
    // Bits that are not there are those that nobody looks at: of the clocks, where only records are asked for.
    let looked_at = if output == "bad" { SIDES_BITS + LIMIT } else { SIDES_BITS };
    let all = (1 << looked_at) - 1;
    if bits & all & !found != 0 || (output == "bad" && found != all) {
        return Err(odd());
    }
    let mut text = head.into_bytes();
    text.push(b'\n');
    for line in lines {
        text.extend(line.into_bytes());
        text.push(b'\n');
    }
    text.extend(rest);
    let path = work.folder.join("box.aig");
    std::fs::write(&path, text).map_err(super::io(&path))
}

/// What a proof takes for granted.
fn assumed(texts: &Texts<'_>) -> Vec<String> {
    let mut list = vec![
        "all state changes at the rising edge of one clock, or at a reset".to_owned(),
        "the first clock is a reset; resets may come at any later clock".to_owned(),
        "set-up words are any; a box lies in the window, and does not end before it begins"
            .to_owned(),
        "a triangle that is offered stands until it is taken".to_owned(),
    ];
    let mut absent = String::new();
    for stream in ["span", "sample"] {
        if !texts.has(&format!("{stream}_valid")) {
            let _ = write!(absent, "{}{stream}", if absent.is_empty() { "" } else { ", " });
        }
    }
    if !absent.is_empty() {
        list.push(format!("not compared, as no port is named: {absent}"));
    }
    let constants = texts.asked.map.constants.iter();
    list.extend(constants.map(|(port, value)| format!("{port} is {value} at every clock")));
    list
}
