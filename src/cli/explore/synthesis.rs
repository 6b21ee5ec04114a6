//! Cells counted by a synthesis tool, for the budgets of the front.

use super::{Failure, Record, Sweep};
use crate::cli::progress;
use guardbit::explore::space::Point;
use guardbit::measure::cost::{
    Source, Synthesis, SynthesisError, UnitSynthesis, YOSYS, sources, synthesise_unit,
};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

/// For one unit; the widest of the built-in profiles takes a few seconds.
const LIMIT: Duration = Duration::from_mins(2);
const HINT: &str = "leave out --synth; area and delay are then estimated from the bit widths";

/// Fails where there is no such tool: before a sweep of hours, not after it.
pub(super) fn check() -> Result<(), Failure> {
    let mut command = Command::new(YOSYS);
    command.arg("-V").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    match command.status() {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Err(failure(&SynthesisError::Missing { program: YOSYS.to_owned() }))
        }
        _ => Ok(()),
    }
}

fn failure(error: &SynthesisError) -> Failure {
    Failure::input(error).hint(HINT)
}

/// Synthesises the units of the front, each distinct one once.
pub(super) fn add(sweep: &Sweep, records: &mut [Record], threads: usize) -> Result<(), Failure> {
    let of = |record: &Record| match sweep.space.point(record.index) {
        Ok(Point::Budget(profile)) => sources(&profile).map_err(Failure::input),
        _ => Ok(Vec::new()),
    };
    let front: Vec<&mut Record> = records.iter_mut().filter(|record| record.pareto).collect();
    let needed: Vec<Vec<Source>> =
        front.iter().map(|record| of(record)).collect::<Result<_, _>>()?;
    let mut distinct: Vec<&Source> = needed.iter().flatten().collect();
    distinct.sort_by(|a, b| a.verilog.cmp(&b.verilog));
    distinct.dedup_by(|a, b| a.verilog == b.verilog);
    let known = units(&distinct, threads)?;
    for (record, sources) in front.into_iter().zip(&needed) {
        let units = sources.iter().filter_map(|source| {
            let unit = known.get(&*source.verilog)?;
            Some(UnitSynthesis { name: source.name, copies: source.copies, ..*unit })
        });
        record.synthesis = Some(Synthesis::new(units.collect()));
    }
    Ok(())
}

/// The figures of each text.
fn units<'a>(
    distinct: &[&'a Source],
    threads: usize,
) -> Result<BTreeMap<&'a str, UnitSynthesis>, Failure> {
    let (monitor, done, next) = (progress::monitor(), AtomicU64::new(0), AtomicUsize::new(0));
    let found = Mutex::new((BTreeMap::new(), None));
    let work = || {
        while let Some(source) = distinct.get(next.fetch_add(1, Ordering::Relaxed)) {
            let result = synthesise_unit(source, Path::new(YOSYS), LIMIT);
            done.fetch_add(1, Ordering::Relaxed);
            let Ok(mut found) = found.lock() else { return };
            match result {
                Ok(unit) => drop(found.0.insert(&*source.verilog, unit)),
                Err(error) => drop(found.1.get_or_insert(error)),
            }
            if found.1.is_some() || monitor.cancel.load(Ordering::Relaxed) {
                next.store(distinct.len(), Ordering::Relaxed);
            }
        }
    };
    progress::count(distinct.len() as u64, &done, || {
        std::thread::scope(|scope| {
            (0..threads.clamp(1, distinct.len().max(1))).for_each(|_| drop(scope.spawn(work)));
        });
    });
    // An interrupt reaches the tool as well, which then fails: not a failure of its own.
    if monitor.cancel.load(Ordering::Relaxed) {
        return Err(Failure::interrupted("interrupted during synthesis"));
    }
    let (known, error) = found.into_inner().map_err(|_| Failure::input("a worker failed"))?;
    error.map_or(Ok(known), |error| Err(failure(&error)))
}
