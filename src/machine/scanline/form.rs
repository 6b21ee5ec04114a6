//! The machine `scanline` as a profile configures it. Spec clauses `A-2` and `A-9`.

use super::{Scanline, ScanlineConfig};
use crate::cover::FillRule;
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Unit, Word, edge_words, plane_bound,
};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "scanline",
    known_as: "Crow",
    clause: "A-9",
    intake: Intake::Triangles,
    polygons: Polygons::Coverage,
    decisions: &[],
    adopt: |from, _| Some(ScanlineConfig { rule: from.rule() }.into()),
};

/// Three vertices sorted, three sides cut by quotient and remainder; a row is two steps with carry.
fn operations() -> Operations {
    let side = Count::new(5, 2, 2, 2);
    let step = Count::new(2, 0, 0, 1) + Count::new(2, 0, 0, 0);
    let sorted = Count::TEST.times(3) + Count::PIXELS.times(3);
    Operations {
        triangle: Count::AREA + sorted + Count::CLIP + side.times(3),
        row: step.times(2) + Count::CLIP,
        ..Operations::default()
    }
}

impl Rasterizer for ScanlineConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, _: &RasterState) -> Result<(), FormError> {
        Ok(())
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        Ok(Box::new(Scanline::new(*self, site.depth, &state.vertex, site.target)))
    }

    fn rule(&self) -> FillRule {
        self.rule
    }

    fn covers_exactly(&self, _: &RasterState) -> bool {
        true
    }

    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![Word::exact_edge(Self::width(&state.vertex))]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        // A quotient and a remainder, each with its step.
        let mut units = vec![Unit::linear("edge", Self::width(&state.vertex)).times(2)];
        units.extend(state.depth.as_ref().map(Unit::depth));
        let operations = operations().with_plane(state.depth.as_ref());
        Some(Datapath { units, setup_bits: Self::width(&state.vertex), operations })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        _: &PlaneNumerator,
    ) -> Option<Rational> {
        plane_bound(state, face)
    }

    fn may_misplace(&self, _: &Face<'_>, _: [i128; 2]) -> Option<bool> {
        Some(false)
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        edge_words::rules(&mut steps, "", |config, rule| config.rule = rule);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn decision(&self, _: &str) -> Option<Value> {
        None
    }

    fn decide(&mut self, _: &str, _: &Value, _: &RasterState) -> Result<(), Refused> {
        Err(Refused::Absent)
    }
}
