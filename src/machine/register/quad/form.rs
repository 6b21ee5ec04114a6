//! The engine `quads` as a profile configures it.

use super::{NAME, QuadConfig, QuadRule};
use crate::machine::register::engine::{Built, EngineForm};
use crate::machine::register::input::{Inputs, RegisterError};
use crate::machine::{EngineConfig, Step, Steps, Target, Word, near};
use crate::setup::VertexConfig;
use crate::value::Channel;

impl EngineForm for QuadConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn build(
        &self,
        inputs: &Inputs<'_>,
        channels: Vec<Channel>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        self.engine(inputs, &channels, vertex, target)
    }

    fn edge_word(&self) -> Option<Word> {
        let facts = [("beyond its range", "wraps".to_owned())];
        Some(Word::new("edge", [("edge", self.width)], facts))
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
