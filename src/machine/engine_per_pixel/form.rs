//! The machine `engine-per-pixel` as a profile configures it. Spec clauses `A-2` and `A-4`.

use super::EnginePerPixel;
use crate::cover::{EdgeWordConfig, FillRule};
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Word, edge_words, plane_bound,
};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "engine-per-pixel",
    known_as: "Pixel-Planes 4",
    clause: "A-4",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: EdgeWordConfig::DECISIONS,
    adopt: |from, state| Some(EnginePerPixelConfig(edge_words::adopted(from, state)).into()),
};

/// The machine of `[form.engine-per-pixel]`: the edge words of its engines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(transparent)]
pub struct EnginePerPixelConfig(pub EdgeWordConfig);

impl From<EdgeWordConfig> for EnginePerPixelConfig {
    fn from(config: EdgeWordConfig) -> Self {
        Self(config)
    }
}

impl Deref for EnginePerPixelConfig {
    type Target = EdgeWordConfig;

    fn deref(&self) -> &EdgeWordConfig {
        &self.0
    }
}

impl DerefMut for EnginePerPixelConfig {
    fn deref_mut(&mut self) -> &mut EdgeWordConfig {
        &mut self.0
    }
}

impl EnginePerPixelConfig {
    /// No bounding box: the tree reaches every engine, where its last adder and a test are.
    fn operations(self, state: &RasterState) -> Operations {
        let triangle = Count::AREA + Count::edge_setup(self.rule).times(3);
        let mut operations =
            Operations { triangle, visit: Count::sample(), ..Operations::default() };
        if let Some(depth) = &state.depth {
            // Every engine evaluates the plane, as part of the same tree.
            operations.triangle = triangle + Count::plane(depth);
            operations.visit = Count::sample() + Count::STEP;
            operations.fragment = Count::read_out(depth.clamp);
        }
        operations
    }
}

impl Rasterizer for EnginePerPixelConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, _: &RasterState) -> Result<(), FormError> {
        edge_words::validate(self.0, &KIND, &[])?;
        let reason = "an engine at each pixel knows three edge words and no bounding box, and a sharp vertex \
                      would cover squares beyond it";
        edge_words::refuse_conservative(self.0, &KIND, &[], reason)
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, processor } = site;
        let exact = self.exact_edge_width(state).unwrap_or(u32::MAX);
        let vertex = &state.vertex;
        Ok(Box::new(EnginePerPixel::new(self.0, exact, depth, vertex, target, processor)))
    }

    fn rule(&self) -> FillRule {
        self.rule
    }

    fn covers_exactly(&self, state: &RasterState) -> bool {
        edge_words::hold_all(self.0, self.exact_edge_width(state))
    }

    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![edge_words::word(self.0, state)]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        Some(Datapath::of_edge_words(self.0, state, self.operations(state)))
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
        edge_words::steps(&mut steps, "", |config| &mut config.0);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn decision(&self, name: &str) -> Option<Value> {
        edge_words::decision(self.0, name)
    }

    fn decide(&mut self, name: &str, value: &Value, state: &RasterState) -> Result<(), Refused> {
        self.width = edge_words::decided(name, value, self.exact_edge_width(state))?;
        Ok(())
    }

    fn edge(&self) -> Option<&EdgeWordConfig> {
        Some(self)
    }

    fn edge_mut(&mut self) -> Option<&mut EdgeWordConfig> {
        Some(self)
    }

    fn exact_edge_width(&self, state: &RasterState) -> Option<u32> {
        state.exact_edge_width(self, 1)
    }
}
