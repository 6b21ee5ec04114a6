//! The machine `edge-function` as a profile configures it. Spec clauses `C-4` to `C-7` and `O-1`.

use super::EdgeFunction;
use crate::cover::{EdgeWordConfig, FillRule, Order, TILE};
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Traversed, Word, edge_words, plane_bound,
};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "edge-function",
    known_as: "Pineda",
    clause: "C-7",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: EdgeWordConfig::DECISIONS,
    adopt: |from, state| Some(EdgeFunctionConfig(edge_words::adopted(from, state)).into()),
};

/// The machine of `[form.edge-function]`: its edge words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(transparent)]
pub struct EdgeFunctionConfig(pub EdgeWordConfig);

impl From<EdgeWordConfig> for EdgeFunctionConfig {
    fn from(config: EdgeWordConfig) -> Self {
        Self(config)
    }
}

impl Deref for EdgeFunctionConfig {
    type Target = EdgeWordConfig;

    fn deref(&self) -> &EdgeWordConfig {
        &self.0
    }
}

impl DerefMut for EdgeFunctionConfig {
    fn deref_mut(&mut self) -> &mut EdgeWordConfig {
        &mut self.0
    }
}

impl EdgeFunctionConfig {
    /// The bounding box row by row.
    fn box_operations(&self) -> Operations {
        let edge = Count::edge_word_setup(self) + Count::JUMP;
        Operations {
            triangle: Count::AREA + Count::bounds() + edge.times(3),
            row: Count::STEP.times(3),
            visit: Count::sample(),
            ..Operations::default()
        }
    }

    /// Any order of visits: what it looks at depends on what it finds, and is measured.
    fn traversed_operations(&self) -> Operations {
        let edge = Count::edge_word_setup(self) + Count::JUMP + Count::corners();
        Operations {
            triangle: Count::AREA + Count::bounds() + edge.times(3),
            tile: Count::block(),
            visit: Count::sample(),
            ..Operations::default()
        }
    }
}

impl Rasterizer for EdgeFunctionConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        edge_words::validate(self.0, &KIND, &[])?;
        edge_words::validate_conservative(self.0, state, &KIND, &[])
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, processor } = site;
        Ok(match state.traversal {
            None => Box::new(EdgeFunction::new(self.0, depth, &state.vertex, target, processor)),
            Some(order) => Box::new(Traversed::new(self.0, order, depth, &state.vertex, target)),
        })
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
        let coverage = match state.traversal {
            None => self.box_operations(),
            Some(_) => self.traversed_operations(),
        };
        let operations = coverage.with_plane(state.depth.as_ref());
        Some(Datapath::of_edge_words(self.0, state, operations))
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
        // The samples of `C-2` are no measure of squares.
        self.conservative.is_none().then_some(false)
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
        let tile = match state.traversal.map(|traversal| traversal.order) {
            Some(Order::Tiles) => TILE,
            Some(Order::Binned) => TILE * TILE,
            _ => 1,
        };
        state.exact_edge_width(self, tile)
    }

    fn visits_the_box(&self) -> bool {
        true
    }
}
