//! The engine `slopes` as a profile configures it.

use super::{ClipEnds, NAME, SlopeConfig, SlopeEdges};
use crate::machine::register::engine::{Built, ClipNames, EngineForm};
use crate::machine::register::input::{Inputs, RegisterError};
use crate::machine::{
    EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, Target, WiredEngine, Word,
    near_or_none,
};
use crate::setup::VertexConfig;
use crate::value::Channel;

impl EngineForm for SlopeConfig {
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
        self.engine(inputs, channels, vertex, target)
    }

    fn clip(&self) -> ClipNames {
        let ends = ["clip_left", "clip_top", "clip_right", "clip_bottom"];
        ClipNames { ends, sub_pixels: false, on: Some("clip") }
    }

    fn edge_word(&self) -> Option<Word> {
        let (SlopeEdges::Divided { fraction, .. } | SlopeEdges::Given { fraction, .. }) =
            self.edges;
        let facts = [("resolution", format!("2^-{fraction} pixel"))];
        Some(Word::new("edge", [("integer", 32 - fraction), ("fraction", fraction)], facts))
    }

    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice> {
        let engine = match self.edges {
            SlopeEdges::Divided { .. } => WiredEngine::DividedSlopes,
            SlopeEdges::Given { .. } => WiredEngine::GivenSlopes,
        };
        Some(RegisterDevice::wired(engine, Vec::new(), machine.clone()))
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        for bias in near_or_none(self.pixel_bias) {
            steps.add("pixel-bias", &bias, &self.pixel_bias, |slopes| slopes.pixel_bias = bias);
        }
        for (clip, name, other) in
            [(ClipEnds::HalfOpen, "half-open", "closed"), (ClipEnds::Closed, "closed", "half-open")]
        {
            steps.add("clip", &name, &other, |slopes| slopes.clip = clip);
        }
        if let SlopeEdges::Divided { row_bias: was, .. } = self.edges {
            for bias in near_or_none(was) {
                steps.add("edges.divided.row-bias", &bias, &was, |slopes| {
                    if let SlopeEdges::Divided { row_bias, .. } = &mut slopes.edges {
                        *row_bias = bias;
                    }
                });
            }
        }
        steps.found()
    }
}
