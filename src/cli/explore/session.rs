//! One run of a sweep: what is kept, resumed, joined and interrupted.

use super::keeper::Keeper;
use super::{Failure, Record, Shard, Sweep};
use crate::cli::progress;
use guardbit::explore::store::{self, Results};
use guardbit::explore::sweep::Found;
use guardbit::profile::read_text_at_most;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Sweeps that take longer than this say so before they start.
pub(crate) const PATIENCE: Duration = Duration::from_secs(30);

/// The most bytes of a file of results that are read: those of a million budgets.
pub(super) const LARGEST: u64 = 1 << 30;

/// A sweep about to be run.
pub(super) struct Session<'a> {
    sweep: &'a Sweep,
    threads: usize,
}

impl<'a> Session<'a> {
    pub(super) fn new(sweep: &'a Sweep, threads: usize) -> Self {
        Self { sweep, threads }
    }

    /// Measures what is asked for and not known yet.
    pub(super) fn measure(
        &self,
        save: Option<&Path>,
        shard: Option<Shard>,
        timed: bool,
    ) -> Result<Vec<Record>, Failure> {
        let mut results = Results::new();
        let keeper = save.map(|path| Keeper::open(path, self.sweep, &mut results)).transpose()?;
        let (first, end) = shard.unwrap_or(Shard::WHOLE).range(self.sweep.space.len());
        let range = first..end;
        let known = results.clone();
        let wanted = |index: u64| range.contains(&index) && !known.contains_key(&index);
        let left = range.clone().filter(|index| wanted(*index)).count() as u64;
        self.announce(left, save)?;
        let monitor = progress::monitor();
        let (done, shared) = (AtomicU64::new(0), Mutex::new((results, keeper, None)));
        progress::count(left, &done, || {
            let found = |found: Found| {
                let Ok(mut shared) = shared.lock() else { return false };
                let (results, keeper, failure) = &mut *shared;
                // Another thread's line did not fit: nothing may follow what is left of it.
                if failure.is_some() {
                    return false;
                }
                let index = match &found {
                    Found::Measured(record) => record.index,
                    Found::Skipped(index) => *index,
                };
                if let Some(keeper) = keeper
                    && let Err(error) = keeper.add(&found)
                {
                    *failure = Some(error);
                    return false;
                }
                results.insert(index, found);
                done.fetch_add(1, Ordering::Relaxed);
                !monitor.cancel.load(Ordering::Relaxed)
            };
            self.sweep.run(self.threads, &wanted, &found).map_err(Failure::input)
        })?;
        let (mut results, mut keeper, failure) =
            shared.into_inner().map_err(|_| Failure::input("a worker failed"))?;
        if let Some(failure) = failure {
            return Err(failure);
        }
        Self::interrupted(&monitor, save, done.load(Ordering::Relaxed), left)?;
        results.retain(|index, _| range.contains(index));
        let mut records = measured(results);
        if timed {
            self.sweep.time(&mut records, &|| !monitor.cancel.load(Ordering::Relaxed));
            Self::interrupted(&monitor, save, left, left)?;
            if let Some(keeper) = &mut keeper {
                let before = |record: &&Record| match known.get(&record.index) {
                    Some(Found::Measured(known)) => known.speed != record.speed,
                    _ => true,
                };
                for record in records.iter().filter(before) {
                    keeper.add(&Found::Measured(Box::new(record.clone())))?;
                }
            }
        }
        // One of more parts than numbers is empty, and no failure: whoever waits for all parts waits
        // for this one, too. A whole space never is.
        if records.is_empty() {
            eprintln!(
                "note: this part of the space contains no valid budget, so nothing is measured"
            );
        }
        Ok(records)
    }

    fn interrupted(
        monitor: &guardbit::vector::write::Monitor,
        save: Option<&Path>,
        done: u64,
        left: u64,
    ) -> Result<(), Failure> {
        if !monitor.cancel.load(Ordering::Relaxed) {
            return Ok(());
        }
        let message = format!("interrupted after {done} of {left} budgets");
        let failure = Failure::interrupted(&message);
        Err(match save {
            Some(path) => failure
                .hint(&format!("run the same command again to continue from {}", path.display())),
            None => failure.hint("use --save FILE, and an interrupted sweep can continue"),
        })
    }

    /// Says how long a long sweep will take.
    fn announce(&self, left: u64, save: Option<&Path>) -> Result<(), Failure> {
        // Below this no sweep is long enough to measure it first.
        if left < 64 {
            return Ok(());
        }
        let whole = self.sweep.expected(self.threads).map_err(Failure::input)?;
        #[allow(clippy::cast_precision_loss, reason = "an estimate")]
        let part = whole.mul_f64(left as f64 / self.sweep.space.len() as f64);
        if part > PATIENCE {
            let keep =
                if save.is_some() { "" } else { "; use --save FILE to keep finished results" };
            eprintln!(
                "note: {left} budgets on {} threads will take about {}{keep}",
                self.threads,
                in_words(part)
            );
        }
        Ok(())
    }

    /// Joins files of results.
    pub(super) fn merge(&self, files: &[PathBuf]) -> Result<Vec<Record>, Failure> {
        let mut results = Results::new();
        for path in files {
            let name = path.display().to_string();
            let text =
                read_text_at_most(path, LARGEST).map_err(|error| Failure::io(&name, &error))?;
            store::read(self.sweep, &name, &text, &mut results).map_err(Failure::input)?;
        }
        let missing: Vec<u64> =
            (0..self.sweep.space.len()).filter(|index| !results.contains_key(index)).collect();
        if let Some(first) = missing.first() {
            let message = format!(
                "{} of {} budgets are missing in the files; the first missing budget is number {first}",
                missing.len(),
                self.sweep.space.len()
            );
            return Err(Failure::input(message).hint("measure the missing parts, then merge again"));
        }
        Ok(measured(results))
    }
}

fn measured(results: Results) -> Vec<Record> {
    let records = results.into_values().filter_map(|found| match found {
        Found::Measured(record) => Some(*record),
        Found::Skipped(_) => None,
    });
    records.collect()
}

/// `1 h 20 min`, `3 min`, `40 s`.
pub(crate) fn in_words(time: Duration) -> String {
    let seconds = time.as_secs();
    match (seconds / 3600, seconds / 60 % 60) {
        (0, 0) => format!("{seconds} s"),
        (0, minutes) => format!("{minutes} min"),
        (hours, minutes) => format!("{hours} h {minutes} min"),
    }
}
