//! A blind sample of mutants of the units of channels, drawn and judged as that of the other devices.
//! `GUARDBIT_SEED` and `GUARDBIT_MUTANTS` choose it, `GUARDBIT_ROWS` (default 1500) the sets.

// Clauses CH-15 and CH-19.
use super::sample::{Devices, Sample};
use super::{Sets, fates, judge, number};
use crate::run::run_in;
use crate::units::{CHANNELS, profile};
use std::path::PathBuf;
use std::time::Duration;

/// The modules of `hdl` that are changed; the table and the bit length are what a loop fills.
const MODULES: [&str; 6] = [
    "newton_step",
    "reciprocal_unit",
    "held_value",
    "interpolator",
    "rounded_shift",
    "perspective_divider",
];

/// Parts, and the modules around them.
const OUTER: [(&str, &str); 4] = [
    ("newton_step", "reciprocal_unit"),
    ("rounded_shift", "perspective_divider"),
    ("held_value", "interpolator"),
    ("held_value", "perspective_divider"),
];

pub(crate) fn sampled(_: &str) {
    let (seed, count) = (number("GUARDBIT_SEED", 1), number("GUARDBIT_MUTANTS", 12));
    let rows = number("GUARDBIT_ROWS", 1500);
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, channels: &str, rest: &str| {
        profile(home.path(), name, channels);
        let out = format!("{name}-{}", if rest.is_empty() { 1 } else { 2 });
        let line = format!("vectors {name}.toml --count {rows} {rest} --out {out}");
        run_in(home.path(), &line).ends(0);
        home.path().join(out)
    };
    let names = ["textured", "every"];
    let both = |rest: &str| -> Vec<PathBuf> {
        names.iter().zip(CHANNELS).map(|(name, channels)| write(name, channels, rest)).collect()
    };
    let (first, second) = (both(""), both(&format!("--seed {} --scene fan", seed + 1)));
    let devices: Vec<Devices> = first.iter().map(|set| Devices::of_units(set)).collect();
    let driven = |kind: &str| -> Vec<String> {
        let all = devices.iter().flat_map(Devices::names);
        let mut all: Vec<String> =
            all.filter(|name| name.starts_with(&format!("dut_{kind}"))).collect();
        all.sort();
        all.dedup();
        all
    };
    let tops = driven("");
    let file = |top: &String| {
        let name = top.trim_start_matches("dut_");
        let name = name.replacen('_', "-", 1);
        name.replace("inverse_w", "inverse-w")
    };
    let sets = Sets {
        first,
        second,
        keep: std::env::var_os("GUARDBIT_BLIND").map(PathBuf::from),
        limit: Duration::from_secs(40),
        question: Duration::from_secs(number("GUARDBIT_SECONDS", 5)),
        names: names.map(str::to_owned).to_vec(),
        files: tops.iter().map(file).collect(),
        plain: driven("interpolator"),
        tops,
        placed: MODULES.map(str::to_owned).to_vec(),
        outer: OUTER.to_vec(),
    };
    let sample = Sample::new(&devices[1], seed, |name| MODULES.contains(&name));
    let fates = fates(&sets, &devices, sample, (count, seed, rows));
    for module in MODULES {
        let own: Vec<_> = fates.iter().filter(|fate| fate.module == module).collect();
        let killed = own.iter().filter(|fate| fate.killed.is_some()).count();
        let named = own.iter().filter(|f| f.reports.iter().any(|r| r.causes.len() == 1)).count();
        eprintln!("{module}: {} mutants, {killed} killed, a single cause for {named}", own.len());
    }
    judge(&fates);
}
