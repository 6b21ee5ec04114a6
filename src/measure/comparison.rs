//! Comparison of machines on one scene: coverage and depth against the exact result, operations, bits, time.
//! Spec clauses `A-10` to `A-13`.

mod bound;
mod need;
mod order;
mod size;

pub use order::{OrderRow, orders};
pub use size::{SIZES, SizeRow, sizes};

use super::accuracy::{ChannelError, Drawn, Reference, Stage, Truth, measure, measure_channels};
use super::cost::{Count, Operations, estimate};
use super::error::exact_rule;
use crate::exact::Rule;
use crate::machine::{Kind, Sink, Work, triangle_machines};
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::scene::Scene;
use crate::setup::{Snapped, Triangle};
use serde::Serialize;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Operations of a real number of times a fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Rate {
    /// Additions and subtractions.
    pub add: f64,
    /// Multiplications of two variables.
    pub multiply: f64,
    /// Divisions, reciprocals included.
    pub divide: f64,
    /// Comparisons and sign tests.
    pub compare: f64,
}

/// Operations by what they are shared among.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Shares {
    /// Set-up, once a triangle.
    pub triangle: Count,
    /// Everything else, over all covered samples.
    pub fragment: Rate,
}

/// One machine on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The name profiles use.
    pub name: &'static str,
    /// The one that a lecture knows it by.
    pub known_as: &'static str,
    /// Whether its coverage is exact by construction.
    pub exact: bool,
    /// Samples covered that should not be, and the other way round, triangle by triangle.
    pub coverage_differs: u64,
    /// Samples of the scene that fewer triangles hit than should.
    pub holes: u64,
    /// Samples that more hit.
    pub double_hits: u64,
    /// Largest depth error in ULP; absent where the scene has no depth.
    pub depth_worst_ulp: Option<f64>,
    /// Mean signed depth error in ULP.
    pub depth_mean_ulp: Option<f64>,
    /// Largest depth error as a part of the bound that the machine's clause states; at most 1. Absent where
    /// no bound is stated.
    pub depth_of_bound: Option<f64>,
    /// Samples misplaced further from an edge than the machine's clause allows; 0. Absent where no bound is
    /// stated and a sample is misplaced.
    pub beyond_bound: Option<u64>,
    /// Errors of the channels against exact interpolation; none where the profile has no channels.
    pub channels: Vec<ChannelError>,
    /// Neighbours in depth that change places.
    pub inversions: u64,
    /// Operations.
    pub ops: Shares,
    /// Bits of all accumulators.
    pub accumulator_bits: u32,
    /// What finding the fragments took, over the scene.
    pub work: Effort,
    /// Samples covered.
    pub fragments: u64,
    /// Nanoseconds a covered sample, set-up included; absent if it was not asked for.
    pub ns_per_fragment: Option<f64>,
}

/// [`Work`], as reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Effort {
    /// Rows walked.
    pub rows: u64,
    /// Tiles or blocks tested as a whole.
    pub tiles: u64,
    /// Samples evaluated.
    pub visits: u64,
}

/// What leaving an evaluator out saves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Saved {
    /// The evaluator.
    pub evaluator: String,
    /// Why the scene does without.
    pub why: String,
    /// Operations a triangle of the first machine.
    pub triangle: u64,
    /// Operations a covered sample.
    pub fragment: u64,
    /// Accumulator bits.
    pub bits: u32,
    /// Cell area with ripple-carry adders, in square micrometres.
    pub area_um2: f64,
}

/// All machines on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The scene.
    pub scene: String,
    /// Columns and rows of the window.
    pub window: [u32; 2],
    /// Triangles with an area.
    pub triangles: usize,
    /// Triangles left out: a vertex outside the vertex field, or behind the camera.
    pub refused: u64,
    /// Samples that they cover, hits counted one by one.
    pub samples: u64,
    /// A row a machine.
    pub machines: Vec<Row>,
    /// Evaluators of the profile that the scene does not need, and that were left out.
    pub saved: Vec<Saved>,
}

/// A scene on the grids that its machines share.
#[derive(Debug)]
pub struct Compared {
    reference: Reference,
    profile: Profile,
    stages: Vec<(Rule, Stage)>,
    dropped: u64,
    saved: Vec<Saved>,
}

impl Compared {
    /// Brings a scene to a profile's grid, and drops what it does not require.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(scene: Scene, profile: &Profile) -> Result<Self, InvalidProfile> {
        profile.validate()?;
        let mut profile = profile.clone();
        let mut saved = Vec::new();
        let has_depth = scene.triangles.iter().any(|triangle| match triangle {
            crate::scene::Triangle::Lattice { z, .. } => z.is_some(),
            crate::scene::Triangle::Real { z, .. } => z.is_some(),
        });
        if !has_depth && profile.depth.is_some() {
            saved.push(without_depth(&profile)?);
            profile.depth = None;
        }
        if let Some(multisample) = profile.multisample.take() {
            saved.push(without_samples(&profile, multisample.samples)?);
        }
        let unneeded = need::channels(&scene, &profile)?;
        saved.extend(without_channels(&mut profile, unneeded)?);
        let dropped = scene.dropped as u64;
        let reference = Reference::new(scene, &profile);
        Ok(Self { reference, profile, stages: Vec::new(), dropped, saved })
    }

    /// The profile as compared.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The profile of a machine, and the scene on its grid.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn stage(&mut self, name: &str) -> Result<(Profile, &Stage), InvalidProfile> {
        let profile = self.profile.with_machine(name).unwrap_or_else(|| self.profile.clone());
        let rule = exact_rule(&profile.form);
        if !self.stages.iter().any(|(known, _)| *known == rule) {
            let (grid, clip) = (profile.whole_grid()?, profile.window()?);
            let truth = Truth::new(&self.reference, &grid, clip, rule);
            self.stages.push((rule, Stage::new(&self.reference, &truth, &profile)?));
        }
        let found = self.stages.iter().find(|(known, _)| *known == rule);
        let (_, stage) = found.unwrap_or_else(|| unreachable!("made above"));
        Ok((profile, stage))
    }

    /// Measures the machines of these names; `go_on` is asked before each.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn measure(
        mut self,
        names: &[&str],
        timed: bool,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Comparison, InvalidProfile> {
        let mut machines = Vec::new();
        for kind in triangle_machines().filter(|kind| names.contains(&kind.name)) {
            if !go_on() {
                break;
            }
            let (profile, stage) = self.stage(kind.name)?;
            machines.push(row(kind, stage, &profile, timed)?);
        }
        let stage = self.stages.first().map(|(_, stage)| stage);
        Ok(Comparison {
            scene: self.reference.name.clone(),
            window: [self.profile.window.width, self.profile.window.height],
            triangles: stage.map_or(0, |stage| stage.faces.len()),
            refused: stage.map_or(0, |stage| stage.snap.refused) + self.dropped,
            samples: stage.map_or(0, |stage| stage.samples),
            machines,
            saved: self.saved,
        })
    }
}

/// Machines are compared at one sample a pixel: what the others would take.
fn without_samples(profile: &Profile, samples: u32) -> Result<Saved, InvalidProfile> {
    let cost = estimate(&Profile { depth: None, channel: Vec::new(), w: None, ..profile.clone() })?;
    let more = u64::from(samples - 1);
    Ok(Saved {
        evaluator: "antialiasing".to_owned(),
        why: "machines are compared at one sample a pixel".to_owned(),
        triangle: more * all(cost.operations.triangle),
        fragment: more * all(cost.operations.visit + cost.operations.fragment),
        bits: (samples - 1) * cost.adder_bits,
        area_um2: f64::from(samples - 1) * cost.ripple.area_um2,
    })
}

fn without_depth(profile: &Profile) -> Result<Saved, InvalidProfile> {
    let less = Profile { depth: None, ..profile.clone() };
    without(profile, &less, "depth".to_owned(), "no triangle of the scene has depth".to_owned())
}

/// Leaves channels out one after another, and the plane of 1/w with the last that walks it.
fn without_channels(
    profile: &mut Profile,
    unneeded: Vec<(String, String)>,
) -> Result<Vec<Saved>, InvalidProfile> {
    let mut saved = Vec::new();
    for (name, why) in unneeded {
        let mut less = profile.clone();
        less.channel.retain(|channel| channel.name != name);
        if !less.channel.iter().any(|channel| channel.correction.walks_w()) {
            less.w = None;
        }
        saved.push(without(profile, &less, format!("channel {name}"), why)?);
        *profile = less;
    }
    Ok(saved)
}

/// What a profile with less takes less.
fn without(
    profile: &Profile,
    less: &Profile,
    evaluator: String,
    why: String,
) -> Result<Saved, InvalidProfile> {
    let (with, without) = (estimate(profile)?, estimate(less)?);
    let [more, less] = [with.operations, without.operations];
    Ok(Saved {
        evaluator,
        why,
        triangle: all(more.triangle) - all(less.triangle),
        fragment: all(more.fragment) - all(less.fragment),
        bits: with.adder_bits - without.adder_bits,
        area_um2: with.ripple.area_um2 - without.ripple.area_um2,
    })
}

/// Operations of any kind.
fn all(count: Count) -> u64 {
    count.add + count.multiply + count.divide + count.compare
}

fn row(kind: &Kind, stage: &Stage, profile: &Profile, timed: bool) -> Result<Row, InvalidProfile> {
    let drawn = Drawn::new(stage, profile)?;
    let deviation = measure(stage, &drawn, profile).tally.report();
    let cost = estimate(profile)?;
    let depth = deviation.depth.map(|depth| depth.ulp);
    let used = bound::used(stage, profile)?;
    let fragments = drawn.covered;
    Ok(Row {
        name: kind.name,
        known_as: kind.known_as,
        exact: profile.covers_exactly(),
        coverage_differs: deviation.misclassified,
        holes: deviation.holes,
        double_hits: deviation.double_hits,
        depth_worst_ulp: depth.map(|spread| spread.worst),
        depth_mean_ulp: depth.map(|spread| spread.mean),
        depth_of_bound: used.depth,
        beyond_bound: used.beyond,
        channels: channels(stage, &drawn, profile)?,
        inversions: deviation.inversions,
        ops: shares(&cost.operations, &drawn.work, stage.runs.len() as u64, fragments),
        accumulator_bits: cost.adder_bits,
        work: Effort { rows: drawn.work.rows, tiles: drawn.work.tiles, visits: drawn.work.visits },
        fragments,
        ns_per_fragment: if timed { time(stage, profile, fragments)? } else { None },
    })
}

fn channels(
    stage: &Stage,
    drawn: &Drawn,
    profile: &Profile,
) -> Result<Vec<ChannelError>, InvalidProfile> {
    let (model, wanted) = (Model::new(profile)?, vec![true; profile.channel.len()]);
    let tally = measure_channels(stage, drawn, &model, &wanted);
    Ok(tally.map_or_else(Vec::new, |tally| tally.report(profile)))
}

/// Operations over what was counted.
fn shares(operations: &Operations, work: &Work, runs: u64, fragments: u64) -> Shares {
    let parts = [
        (operations.row, work.rows),
        (operations.tile, work.tiles),
        (operations.run, runs),
        (operations.visit, work.visits),
        (operations.fragment, fragments),
    ];
    let sum = |kind: fn(&Count) -> u64| {
        let all: f64 = parts.iter().map(|(count, times)| real(kind(count)) * real(*times)).sum();
        if fragments == 0 { 0.0 } else { all / real(fragments) }
    };
    Shares {
        triangle: operations.triangle,
        fragment: Rate {
            add: sum(|count| count.add),
            multiply: sum(|count| count.multiply),
            divide: sum(|count| count.divide),
            compare: sum(|count| count.compare),
        },
    }
}

/// Takes spans and values and keeps a sum of them, so that nothing is optimised away.
#[derive(Default)]
pub(super) struct Drain(pub(super) u64);

impl Sink for Drain {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        let last = depth.last().copied().unwrap_or(0);
        self.0 = self.0.wrapping_add(u64::from(x1 - x0) ^ u64::from(y) ^ last);
    }
}

/// The quickest of a few passes over triangles, in nanoseconds.
fn quickest(model: &Model, triangles: &[Snapped<Triangle>]) -> f64 {
    let (begin, mut best, mut passes) = (Instant::now(), Duration::MAX, 0);
    while passes < 3 || (begin.elapsed() < Duration::from_millis(40) && passes < 1000) {
        let pass = Instant::now();
        let mut drain = Drain::default();
        for triangle in triangles {
            model.draw_own(triangle, &mut drain);
        }
        black_box(drain.0);
        best = best.min(pass.elapsed());
        passes += 1;
        if begin.elapsed() > Duration::from_secs(2) {
            break;
        }
    }
    best.as_secs_f64() * 1e9
}

fn time(stage: &Stage, profile: &Profile, fragments: u64) -> Result<Option<f64>, InvalidProfile> {
    let model = Model::new(profile)?;
    let triangles: Vec<Snapped<Triangle>> = stage.faces.iter().map(|face| face.triangle).collect();
    Ok((fragments > 0).then(|| quickest(&model, &triangles) / real(fragments)))
}

#[allow(clippy::cast_precision_loss, reason = "figures are reported as real numbers")]
fn real(value: u64) -> f64 {
    value as f64
}
