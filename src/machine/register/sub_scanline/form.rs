//! The engine `sub-scanlines` as a profile configures it.

use super::{NAME, Product, SubScanlineConfig};
use crate::machine::register::engine::{Built, EngineForm};
use crate::machine::register::input::{Inputs, RegisterError};
use crate::machine::{EngineConfig, Step, Steps, Target, Word};
use crate::setup::VertexConfig;
use crate::value::Channel;

impl EngineForm for SubScanlineConfig {
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

    fn edge_word(&self) -> Option<Word> {
        let facts = [
            ("resolution", "2^-16 pixel".to_owned()),
            ("rows", "four sub-scanlines each".to_owned()),
        ];
        Some(Word::new("edge", [("guard", 2), ("integer", 10), ("fraction", 16)], facts))
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        for (product, name, other) in
            [(Product::Wrap, "wrap", "resize"), (Product::Resize, "resize", "wrap")]
        {
            steps.add("product", &name, &other, |lines| lines.product = product);
        }
        for signed in [true, false] {
            steps.add("signed-distance", &signed, &!signed, |lines| {
                lines.signed_distance = signed;
            });
        }
        steps.found()
    }
}
