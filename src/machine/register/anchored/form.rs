//! The engine `anchored` as a profile configures it.

use super::{Anchor, AnchoredConfig, HalfOrder, Largest, NAME, VertexSort};
use crate::bits::Rounding;
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::{
    EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, WiredDevice, WiredEngine, Word,
};

impl EngineForm for AnchoredConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        Some(ClipNames { ends: ["left", "top", "right", "bottom"], sub_pixels: false, on: None })
    }

    /// Its sides are exact.
    fn edge_word(&self) -> Option<Word> {
        None
    }

    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice> {
        let Largest { x, y } = self.largest?;
        let values = vec![
            ("SORTED", (self.anchor == Anchor::LeftmostSorted).into()),
            ("FIRST_MATCH", (self.sort == VertexSort::FirstMatch).into()),
            ("UPPER_FIRST", (self.halves == HalfOrder::UpperFirst).into()),
            ("LARGEST_X", x.into()),
            ("LARGEST_Y", y.into()),
        ];
        let same = Self {
            anchor: Anchor::LeftmostGiven,
            sort: VertexSort::Stable,
            halves: HalfOrder::FromAnchor,
            rounding: self.rounding,
            largest: None,
        };
        let wiring = Box::new(RegisterConfig { engine: same.into(), ..machine.clone() });
        let (engine, rounding) = (WiredEngine::Anchored, Some(self.rounding));
        let facts = Vec::new();
        Some(RegisterDevice::Wired(WiredDevice { engine, values, facts, rounding, wiring }))
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        for (anchor, name, other) in [
            (Anchor::LeftmostGiven, "leftmost-given", "leftmost-sorted"),
            (Anchor::LeftmostSorted, "leftmost-sorted", "leftmost-given"),
        ] {
            steps.add("anchor", &name, &other, |config| config.anchor = anchor);
        }
        for (sort, name, other) in [
            (VertexSort::Stable, "stable", "first-match"),
            (VertexSort::FirstMatch, "first-match", "stable"),
        ] {
            steps.add("sort", &name, &other, |config| config.sort = sort);
        }
        for (halves, name, other) in [
            (HalfOrder::FromAnchor, "from-anchor", "upper-first"),
            (HalfOrder::UpperFirst, "upper-first", "from-anchor"),
        ] {
            steps.add("halves", &name, &other, |config| config.halves = halves);
        }
        for rounding in Rounding::ALL {
            steps.add("rounding", &rounding, &self.rounding, |config| config.rounding = rounding);
        }
        let was = if self.largest.is_some() { "a limit" } else { "none" };
        steps.add("largest", &"none", &was, |config| config.largest = None);
        steps.found()
    }
}
