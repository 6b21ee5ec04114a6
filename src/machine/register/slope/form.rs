//! The engine `slopes` as a profile configures it.

use super::{ClipEnds, NAME, Plane, RowCounts, RowOrder, SlopeConfig, SlopeEdges};
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::{
    EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, WiredEngine, Word, near,
    near_or_none,
};

impl EngineForm for SlopeConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        let ends = ["clip_left", "clip_top", "clip_right", "clip_bottom"];
        self.clip.map(|_| ClipNames { ends, sub_pixels: false, on: Some("clip") })
    }

    fn edge_word(&self) -> Option<Word> {
        let (SlopeEdges::Divided { fraction, .. } | SlopeEdges::Given { fraction, .. }) =
            self.edges;
        let facts = [("resolution", format!("2^-{fraction} pixel"))];
        Some(Word::new("edge", [("integer", 32 - fraction), ("fraction", fraction)], facts))
    }

    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice> {
        if self.pixel_bits.is_some() {
            return None;
        }
        let (engine, fraction, [row_bias, down]) = match self.edges {
            SlopeEdges::Divided { fraction, row_bias } => {
                (WiredEngine::DividedSlopes, fraction, [i128::from(row_bias), 0])
            }
            SlopeEdges::Given { counts: RowCounts::All, .. } => return None,
            SlopeEdges::Given { fraction, rows, .. } => {
                let down = if rows == RowOrder::Down { 1 } else { -1 };
                (WiredEngine::GivenSlopes, fraction, [0, down])
            }
        };
        let part = match self.plane {
            Plane::AtVertex {} => 0,
            Plane::AtEdge { fraction } => fraction,
            Plane::AtPoint {} => return None,
        };
        let place = |name: &str| machine.channel_place(name).unwrap_or(0);
        let depth = self.depth.as_ref();
        let facts = vec![
            ("FRACTION", fraction.into()),
            ("ROW_BIAS", row_bias),
            ("DOWN", down),
            ("PIXEL_BIAS", self.pixel_bias.into()),
            ("PART", part.into()),
            ("CLOSED", (self.clip? == ClipEnds::Closed).into()),
            ("DEPTH", depth.is_some().into()),
            ("INTEGER_AT", depth.map_or(0, |depth| place(&depth.integer))),
            ("W_AT", depth.map_or(0, |depth| place(&depth.w_float))),
        ];
        Some(RegisterDevice::wired(engine, [Vec::new(), facts], machine.clone()))
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        // Of one pixel: floor, round half up, ceiling.
        let (SlopeEdges::Divided { fraction, .. } | SlopeEdges::Given { fraction, .. }) =
            self.edges;
        let mut biases: Vec<u32> = near_or_none(self.pixel_bias).collect();
        for rounding in [0, 1 << fraction >> 1, (1 << fraction) - 1] {
            if !biases.contains(&rounding) {
                biases.push(rounding);
            }
        }
        for bias in biases {
            steps.add("pixel-bias", &bias, &self.pixel_bias, |slopes| slopes.pixel_bias = bias);
        }
        if self.clip.is_some() {
            let both = [
                (ClipEnds::HalfOpen, "half-open", "closed"),
                (ClipEnds::Closed, "closed", "half-open"),
            ];
            for (clip, name, other) in both {
                steps.add("clip", &name, &other, |slopes| slopes.clip = Some(clip));
            }
        }
        if let Some(was) = self.pixel_bits {
            for bits in near(was) {
                steps.add("pixel-bits", &bits, &was, |slopes| slopes.pixel_bits = Some(bits));
            }
            steps.add("pixel-bits", &"none", &was, |slopes| slopes.pixel_bits = None);
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
