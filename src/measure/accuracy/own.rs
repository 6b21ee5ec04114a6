//! The values of a machine that does not walk a plane: as it draws them, sample by sample.
//! Spec clauses `M-3` and `A-12`.

use super::Measured;
use super::drawn::Drawn;
use super::reference::real;
use super::stage::{Face, Stage, Surface};
use super::tally::ValueTally;
use super::value::{Reach, Values};
use super::world::World;
use crate::bits::{Event, SpanEvents};
use crate::machine::Sink;
use crate::model::{Model, Span};
use crate::profile::Profile;
use crate::value::Depth;
use std::cmp::Ordering;

/// One value of one face as a machine draws it.
#[derive(Debug, Default)]
pub(super) struct Held {
    runs: Vec<(Span, usize)>,
    accumulators: Vec<i128>,
    events: SpanEvents,
    /// What its depth gains, which is no error.
    gain: i128,
}

impl Sink for Held {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.runs.push((Span { y, x0, x1 }, self.accumulators.len()));
    }

    fn wants_events(&self) -> bool {
        true
    }

    fn events(&mut self, events: &SpanEvents) {
        self.events.append(events);
    }

    fn wants_held(&self) -> bool {
        true
    }

    fn held(&mut self, _: u32, _: u32, accumulators: &[i128]) {
        self.accumulators.extend_from_slice(accumulators);
    }
}

impl Held {
    /// Draws a face with the codes of `surface` as its depth.
    pub(super) fn draw(stage: &Stage, model: &Model, face: &Face, surface: &Surface) -> Self {
        let mut held = Self::default();
        let triangle = face.triangle.with_depth(surface.vertex);
        let triangle = triangle.unwrap_or_else(|error| unreachable!("codes of the stage: {error}"));
        // A triangle that is refused has no values.
        model.draw_own(&triangle, &mut held);
        held.gain = model
            .depth()
            .map_or(0, |depth| depth.gain(&face.triangle, surface.vertex, &stage.grid));
        held
    }

    /// The accumulator at a pixel, if it is drawn.
    fn at(&self, x: u32, y: u32) -> Option<i128> {
        let after = self.runs.partition_point(|(run, _)| (run.y, run.x0) <= (y, x));
        let (run, first) = self.runs.get(after.checked_sub(1)?)?;
        let inside = run.y == y && x < run.x1;
        inside.then(|| self.accumulators.get(first + (x - run.x0) as usize).copied())?
    }

    /// How far the accumulator at a pixel lies above the exact plane, in ULP.
    pub(super) fn ulp(
        &self,
        stage: &Stage,
        depth: &Depth,
        surface: &Surface,
        x: u32,
        y: u32,
    ) -> Option<f64> {
        let (fraction, exact) = (depth.read_out().fraction(), &surface.exact);
        let held = self.at(x, y)? - self.gain;
        let at = stage.grid.position(x.into(), y.into());
        let above = held * exact.whole - (exact.at(at) << fraction);
        Some(real(above) / (real(exact.whole) * real(1 << fraction)))
    }
}

/// The arithmetic error of such a machine on a stage, at the samples that are drawn and right.
pub(super) fn measure(stage: &Stage, drawn: &Drawn, profile: &Profile, depth: &Depth) -> Measured {
    let none = Reach::default();
    let mut tally = drawn.tally;
    let mut values = Values::default();
    let models =
        Model::new(profile).and_then(|model| Ok((model, Model::new(&profile.unbiased())?)));
    if let Ok((model, plain)) = models {
        for (n, face) in stage.faces.iter().enumerate() {
            let runs = drawn.runs(stage, n);
            let note = |model, surface: &Option<Surface>, world: &World, into: &mut ValueTally| {
                let surface = surface.as_ref()?;
                let held = Held::draw(stage, model, face, surface);
                for (y, x) in runs.iter().flat_map(|run| (run.x0..run.x1).map(|x| (run.y, x))) {
                    if let Some(ulp) = held.ulp(stage, depth, surface, x, y) {
                        into.note(world, ulp, surface.code.at(x, y) / stage.world.top);
                    }
                }
                into.settle(world);
                Some(held)
            };
            let attribute =
                note(&plain, &face.attribute, &stage.world.flat(), &mut values.attribute);
            values.attribute_extent.widen(extent(attribute.as_ref()));
            let held = note(&model, &face.depth, &stage.world, &mut values.depth);
            values.depth_extent.widen(extent(held.as_ref()));
            let events = held.map(|held| held.events).unwrap_or_default();
            values.wraps += events.count(Event::Wrap);
            values.clamps += events.count(Event::ClampAbove) + events.count(Event::ClampBelow);
        }
        (tally.inversions, tally.ties) = broken(stage, &model, depth, values.depth.ulp.worst);
    }
    tally.depth = values.depth;
    tally.attribute = values.attribute;
    tally.wraps = values.wraps;
    tally.clamps = values.clamps;
    let (depth, attribute) = (values.depth_extent, values.attribute_extent);
    Measured { tally, depth, attribute, order: none }
}

fn extent(held: Option<&Held>) -> Reach {
    let extent = held.and_then(|held| held.events.extent);
    Reach(extent.map(|extent| (extent.minimum, extent.maximum)))
}

/// Pairs of neighbours in depth that the machine exchanges, and pairs that it makes equal, among
/// those that it draws at all.
fn broken(stage: &Stage, model: &Model, depth: &Depth, worst: f64) -> (u64, u64) {
    let reach = if depth.config().moves_codes() { f64::INFINITY } else { 1.0 + 2.0 * worst };
    let pairs = &stage.pairs[..stage.pairs.partition_point(|pair| pair.gap <= reach)];
    let mut drawn: Vec<Option<Held>> = stage.faces.iter().map(|_| None).collect();
    let (mut inversions, mut ties) = (0, 0);
    for pair in pairs {
        let mut code = |index: u32| {
            let index = index as usize;
            let face = &stage.faces[index];
            let surface = face.depth.as_ref()?;
            let held = drawn[index].get_or_insert_with(|| Held::draw(stage, model, face, surface));
            Some(depth.code(held.at(pair.x, pair.y)?))
        };
        let order = code(pair.near).zip(code(pair.far)).map(|(near, far)| near.cmp(&far));
        match order.map(|order| if depth.is_reversed() { order.reverse() } else { order }) {
            Some(Ordering::Greater) => inversions += 1,
            Some(Ordering::Equal) => ties += 1,
            _ => {}
        }
    }
    (inversions, ties)
}
