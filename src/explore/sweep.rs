//! Measuring every budget of a space. Spec clause `Q-3`.
//!
//! Budgets that share a grid share its exact picture, those that also share a coverage form share
//! what it draws, and only the depth budget itself is measured one by one. Threads take whole grids
//! where there are enough of them, and the budgets of one grid where not; each budget is summed up
//! by one thread in drawing order, so the figures do not depend on how many there are.

use super::clock::Clock;
use super::field::Level;
use super::record::{Record, Speed};
use super::space::{Point, Space, describe};
use crate::measure::accuracy::{
    Accuracy, ChannelError, ChannelTally, Drawn, Measured, Reference, Stage, Tally, Truth,
    depth_of, measure, measure_channels,
};
use crate::measure::cost::{Cost, Operations, estimate};
use crate::measure::error::exact_rule;
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::value::DepthConfig;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A space and the scenes it is measured on.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The budgets.
    pub space: Space,
    /// The scenes, loaded for the space's base profile.
    pub scenes: Vec<Reference>,
}

/// What a sweep found about one number.
#[derive(Clone, Debug)]
pub enum Found {
    /// A measured budget.
    Measured(Box<Record>),
    /// No budget, or another number's.
    Skipped(u64),
}

impl Sweep {
    /// Measures the numbers that `wanted` asks for, on so many threads. `found` is called as they
    /// come, from any thread, and returns false to stop.
    ///
    /// # Errors
    /// [`InvalidProfile`] if a budget that validated cannot be built: never.
    pub fn run(
        &self,
        threads: usize,
        wanted: &(dyn Fn(u64) -> bool + Sync),
        found: &(dyn Fn(Found) -> bool + Sync),
    ) -> Result<(), InvalidProfile> {
        let groups: Vec<Vec<u64>> = self
            .space
            .groups(Level::Stage)
            .into_iter()
            .map(|group| self.space.members(group, Level::Stage, Level::Coverage))
            .collect();
        let (next, stop) = (AtomicUsize::new(0), std::sync::atomic::AtomicBool::new(false));
        let teams = threads.clamp(1, groups.len().max(1));
        let crew = (threads / teams).max(1);
        let team = || -> Result<(), InvalidProfile> {
            while let Some(coverages) = groups.get(next.fetch_add(1, Ordering::Relaxed)) {
                self.group(coverages, crew, wanted, &|one| {
                    let go_on = !stop.load(Ordering::Relaxed) && found(one);
                    stop.fetch_or(!go_on, Ordering::Relaxed);
                    go_on
                })?;
                if stop.load(Ordering::Relaxed) {
                    break;
                }
            }
            Ok(())
        };
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..teams).map(|_| scope.spawn(team)).collect();
            workers.into_iter().try_for_each(|worker| worker.join().unwrap_or(Ok(())))
        })
    }

    /// All budgets of one grid: one list for each coverage form.
    fn group(
        &self,
        coverages: &[u64],
        crew: usize,
        wanted: &(dyn Fn(u64) -> bool + Sync),
        found: &(dyn Fn(Found) -> bool + Sync),
    ) -> Result<(), InvalidProfile> {
        let mut scenes: Option<Vec<Stage>> = None;
        for start in coverages {
            let members = self.space.members(*start, Level::Coverage, Level::Value);
            let mut budgets = Vec::new();
            for index in members.into_iter().filter(|index| wanted(*index)) {
                match self.space.point(index) {
                    Ok(Point::Budget(profile)) => budgets.push((index, *profile)),
                    _ => {
                        if !found(Found::Skipped(index)) {
                            return Ok(());
                        }
                    }
                }
            }
            let Some((_, first)) = budgets.first() else { continue };
            let scenes = match &mut scenes {
                Some(scenes) => scenes,
                None => scenes.insert(self.stages(first)?),
            };
            let drawn: Vec<Drawn> =
                scenes.iter().map(|scene| Drawn::new(scene, first)).collect::<Result<_, _>>()?;
            let (next, scenes) = (AtomicUsize::new(0), &*scenes);
            let known = Known::default();
            std::thread::scope(|scope| {
                for _ in 0..crew.min(budgets.len()) {
                    scope.spawn(|| {
                        while let Some((index, profile)) =
                            budgets.get(next.fetch_add(1, Ordering::Relaxed))
                        {
                            let record = record(*index, profile, scenes, &drawn, &known);
                            let one = record.map_or(Found::Skipped(*index), |record| {
                                Found::Measured(Box::new(record))
                            });
                            if !found(one) {
                                next.store(budgets.len(), Ordering::Relaxed);
                            }
                        }
                    });
                }
            });
        }
        Ok(())
    }

    /// The scenes on the grid of a budget.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn stages(&self, profile: &Profile) -> Result<Vec<Stage>, InvalidProfile> {
        let (grid, clip) = (profile.whole_grid()?, profile.window()?);
        self.scenes
            .iter()
            .map(|reference| {
                let truth = Truth::new(reference, &grid, clip, exact_rule(&profile.form));
                Stage::new(reference, &truth, profile)
            })
            .collect()
    }

    /// How long the sweep will take on so many threads, from one budget of it.
    ///
    /// # Errors
    /// [`InvalidProfile`] as for [`Sweep::run`].
    pub fn expected(&self, threads: usize) -> Result<Duration, InvalidProfile> {
        let groups = self.space.groups(Level::Stage).len();
        let coverages = self.space.groups(Level::Coverage).len();
        let budget = (0..self.space.len()).find_map(|index| match self.space.point(index) {
            Ok(Point::Budget(profile)) => Some(*profile),
            _ => None,
        });
        let Some(profile) = budget else { return Ok(Duration::ZERO) };
        let begin = Instant::now();
        let scenes = self.stages(&profile)?;
        let (stage, begin) = (begin.elapsed(), Instant::now());
        let drawn: Result<Vec<Drawn>, _> =
            scenes.iter().map(|scene| Drawn::new(scene, &profile)).collect();
        let (coverage, begin) = (begin.elapsed(), Instant::now());
        record(0, &profile, &scenes, &drawn?, &Known::default());
        let value = begin.elapsed();
        let seconds = |time: Duration, count: u64| time.as_secs_f64() * real(count);
        let total = seconds(stage, groups as u64)
            + seconds(coverage, coverages as u64)
            + seconds(value, self.space.len());
        Ok(Duration::from_secs_f64(total / real(threads.max(1) as u64)))
    }

    /// Times the model with each of these budgets, in turn with the base profile. On one thread,
    /// while nothing else runs.
    pub fn time(&self, records: &mut [Record], go_on: &dyn Fn() -> bool) {
        let Some(clock) = self.scenes.first().and_then(|s| Clock::new(s, self.space.base())) else {
            return;
        };
        for record in records.iter_mut().filter(|record| record.speed.is_none()) {
            if !go_on() {
                return;
            }
            if let Ok(Point::Budget(profile)) = self.space.point(record.index) {
                let timed = clock.time(&profile);
                record.speed = timed.map(|[ns_per_sample, ratio]| Speed { ns_per_sample, ratio });
            }
        }
    }
}

#[allow(clippy::cast_precision_loss, reason = "a count in a report")]
fn real(count: u64) -> f64 {
    count as f64
}

/// What was measured on one coverage, scene by scene, for depth budgets but for their guard bits.
#[derive(Default)]
struct Known(Mutex<Vec<(DepthConfig, Vec<Measured>)>>);

impl Known {
    /// The errors of a budget on each scene: those of one that differs in guard bits alone, where
    /// both hold all accumulators, or measured.
    fn measure(&self, profile: &Profile, scenes: &[Stage], drawn: &[Drawn]) -> Vec<Measured> {
        let depth = depth_of(profile).map(|depth| depth.read_out());
        let held = |all: &[Measured]| depth.is_some_and(|read| all.iter().all(|m| m.held_by(read)));
        let config = profile.depth.map(|depth| DepthConfig { guard: 0, ..depth });
        if let (Some(config), Ok(known)) = (config, self.0.lock())
            && let Some((_, all)) = known.iter().find(|(of, all)| *of == config && held(all))
        {
            return all.clone();
        }
        let scenes = scenes.iter().zip(drawn);
        let all: Vec<Measured> =
            scenes.map(|(stage, drawn)| measure(stage, drawn, profile)).collect();
        if let (Some(config), true, Ok(mut known)) = (config, held(&all), self.0.lock()) {
            known.push((config, all.clone()));
        }
        all
    }
}

/// The accuracy of a budget over all scenes.
fn record(
    index: u64,
    profile: &Profile,
    scenes: &[Stage],
    drawn: &[Drawn],
    known: &Known,
) -> Option<Record> {
    let (mut snap, mut arithmetic) = (Tally::default(), Tally::default());
    for (scene, measured) in scenes.iter().zip(known.measure(profile, scenes, drawn)) {
        snap.merge(&scene.snap);
        arithmetic.merge(&measured.tally);
    }
    let cost = estimate(profile).ok()?;
    let mut accuracy = accuracy(scenes, &snap, &arithmetic);
    accuracy.channels = channels(profile, scenes, drawn)?;
    Some(Record {
        index,
        budget: describe(profile),
        accuracy,
        operations_per_fragment: operations(&cost, scenes, drawn),
        cost,
        speed: None,
        synthesis: None,
        pareto: false,
    })
}

/// The errors of the channels of a budget over all scenes that have values for them.
pub(super) fn channels(
    profile: &Profile,
    scenes: &[Stage],
    drawn: &[Drawn],
) -> Option<Vec<ChannelError>> {
    if scenes.iter().all(|scene| scene.shades.is_none()) {
        return Some(Vec::new());
    }
    let (model, wanted) = (Model::new(profile).ok()?, vec![true; profile.channel.len()]);
    let mut all = ChannelTally::of(wanted.len());
    for (stage, drawn) in scenes.iter().zip(drawn) {
        if let Some(tally) = measure_channels(stage, drawn, &model, &wanted) {
            all.merge(&tally);
        }
    }
    Some(all.report(profile))
}

pub(super) fn accuracy(scenes: &[Stage], snap: &Tally, arithmetic: &Tally) -> Accuracy {
    let mut units: Vec<&str> = scenes.iter().map(|scene| scene.world.unit()).collect();
    units.dedup();
    Accuracy {
        samples: scenes.iter().map(|scene| scene.samples).sum(),
        world: units.join(" or "),
        snap: snap.report(),
        arithmetic: arithmetic.report(),
        channels: Vec::new(),
    }
}

/// All operations of the scenes over their covered samples.
fn operations(cost: &Cost, scenes: &[Stage], drawn: &[Drawn]) -> f64 {
    let Operations { triangle, row, tile, run, visit, fragment } = cost.operations;
    let (mut all, mut covered) = (0.0, 0);
    for (scene, drawn) in scenes.iter().zip(drawn) {
        let work = [
            (triangle, scene.faces.len() as u64),
            (row, drawn.work.rows),
            (tile, drawn.work.tiles),
            (run, scene.runs.len() as u64),
            (visit, drawn.work.visits),
            (fragment, drawn.covered),
        ];
        for (count, times) in work {
            let each = count.add + count.multiply + count.divide + count.compare;
            all += real(each) * real(times);
        }
        covered += drawn.covered;
    }
    all / real(covered.max(1))
}
