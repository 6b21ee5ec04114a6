//! The engine `quads` as a profile configures it.

use super::{Descent, Emit, NAME, QuadConfig, QuadEdges, QuadRule};
use crate::format::Layout;
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::{
    EngineConfig, QuadDevice, RegisterConfig, RegisterDevice, Step, Steps, WiredDevice,
    WiredEngine, Word, near,
};

impl EngineForm for QuadConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        let (ends, sub_pixels) = match self.edges {
            QuadEdges::Given { .. } => (["x_min", "y_min", "x_max", "y_max"], false),
            QuadEdges::Vertices => (["left", "top", "right", "bottom"], true),
        };
        Some(ClipNames { ends, sub_pixels, on: None })
    }

    fn edge_word(&self) -> Option<Word> {
        let facts = [("beyond its range", "wraps".to_owned())];
        Some(Word::new("edge", [("edge", self.width)], facts))
    }

    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice> {
        if self.edges == QuadEdges::Vertices {
            let (tile, block) =
                self.descent.map_or((0, 0), |descent| (descent.tile, descent.block));
            let facts = vec![
                ("EDGE", self.width.into()),
                ("TILE", tile.into()),
                ("BLOCK", block.into()),
                ("TRUNCATED", (self.rule == QuadRule::TruncatedSide).into()),
                ("MASKS", (self.emit == Emit::Quads).into()),
            ];
            return Some(RegisterDevice::Wired(WiredDevice {
                engine: WiredEngine::VertexQuads,
                values: Vec::new(),
                facts,
                rounding: None,
                wiring: Box::new(machine.clone()),
            }));
        }
        let input = Layout::parse(&machine.input).ok()?;
        let Descent { tile, block } = self.descent.filter(|_| self.emit == Emit::Quads)?;
        let bits = |names: &[&str]| {
            let mut all = names.iter().map(|name| Some(input.find(name)?.bits()));
            let first = all.next()??;
            all.all(|other| other == Some(first)).then_some(first)
        };
        let coordinate = bits(&["tile_x", "tile_y", "x_min", "x_max", "y_min", "y_max"])?;
        let edge = bits(&["a0", "b0", "c0", "a1", "b1", "c1", "a2", "b2", "c2"])?;
        let device = QuadDevice { edge: self.width, tile, block, coordinate };
        (edge >= self.width).then_some(RegisterDevice::Quads(device))
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        for (rule, name, other) in [
            (QuadRule::Both, "both", "truncated-side"),
            (QuadRule::TruncatedSide, "truncated-side", "both"),
        ] {
            steps.add("rule", &name, &other, |quads| quads.rule = rule);
        }
        for width in near(self.width) {
            steps.add("width", &width, &self.width, |quads| quads.width = width);
        }
        steps.found()
    }
}
