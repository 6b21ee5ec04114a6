//! The machine `tiles` as a profile configures it. Spec clauses `A-2` and `A-7`.

use super::{Tiles, TilesConfig};
use crate::cover::{EdgeWordConfig, FillRule};
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Word, edge_words, plane_bound,
};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "tiles",
    known_as: "Bali",
    clause: "A-7",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: EdgeWordConfig::DECISIONS,
    // A tile has 16 pixels on a side, or as many as a smaller window has.
    adopt: |from, state| {
        let side = state.window.0.min(state.window.1).max(1);
        let tile = 16.min(side.checked_next_power_of_two().unwrap_or(16)).max(2);
        Some(TilesConfig { tile, edge: edge_words::adopted(from, state) }.into())
    },
};

impl TilesConfig {
    fn operations(&self) -> Operations {
        let edge = Count::edge_word_setup(&self.edge) + Count::JUMP + Count::corners();
        Operations {
            triangle: Count::AREA + Count::bounds() + edge.times(3),
            tile: Count::block(),
            visit: Count::sample(),
            ..Operations::default()
        }
    }
}

impl Rasterizer for TilesConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        self.validate().map_err(|error| FormError::own(&KIND, error.field(), error))?;
        edge_words::validate_conservative(self.edge, state, &KIND, &["edge"])
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, processor } = site;
        Ok(Box::new(Tiles::new(*self, depth, &state.vertex, target, processor)))
    }

    fn rule(&self) -> FillRule {
        self.edge.rule
    }

    fn covers_exactly(&self, state: &RasterState) -> bool {
        edge_words::hold_all(self.edge, self.exact_edge_width(state))
    }

    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![edge_words::word(self.edge, state)]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let operations = self.operations().with_plane(state.depth.as_ref());
        Some(Datapath::of_edge_words(self.edge, state, operations))
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
        self.edge.conservative.is_none().then_some(false)
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        edge_words::steps(&mut steps, "edge.", |config| &mut config.edge);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn decision(&self, name: &str) -> Option<Value> {
        edge_words::decision(self.edge, name)
    }

    fn decide(&mut self, name: &str, value: &Value, state: &RasterState) -> Result<(), Refused> {
        self.edge.width = edge_words::decided(name, value, self.exact_edge_width(state))?;
        Ok(())
    }

    fn edge(&self) -> Option<&EdgeWordConfig> {
        Some(&self.edge)
    }

    fn edge_mut(&mut self) -> Option<&mut EdgeWordConfig> {
        Some(&mut self.edge)
    }

    fn tile(&self) -> Option<u32> {
        Some(self.tile)
    }

    fn exact_edge_width(&self, state: &RasterState) -> Option<u32> {
        state.exact_edge_width(&self.edge, self.tile.max(1))
    }
}
