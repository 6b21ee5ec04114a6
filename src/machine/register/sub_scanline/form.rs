//! The engine `sub-scanlines` as a profile configures it.

use super::{MASK, NAME, Product, SubScanlineConfig};
use crate::format::Layout;
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::{
    EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, WiredEngine, Word,
};
use crate::value::ChannelConfig;

impl EngineForm for SubScanlineConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        let ends = ["scissor_xh", "scissor_yh", "scissor_xl", "scissor_yl"];
        Some(ClipNames { ends, sub_pixels: true, on: None })
    }

    fn edge_word(&self) -> Option<Word> {
        let facts = [
            ("resolution", "2^-16 pixel".to_owned()),
            ("rows", "four sub-scanlines each".to_owned()),
        ];
        Some(Word::new("edge", [("guard", 2), ("integer", 10), ("fraction", 16)], facts))
    }

    fn device(&self, machine: &RegisterConfig) -> Option<RegisterDevice> {
        let depth = |channel: &&ChannelConfig| channel.names.contains(&self.depth);
        let input = Layout::parse(&machine.input).ok()?;
        for record in &machine.records {
            // The device has no wires for these.
            let layout = Layout::parse(&record.words).ok()?;
            if layout.names().any(|name| MASK.contains(&name)) {
                return None;
            }
        }
        let values = vec![
            ("RESIZE", (self.product == Product::Resize).into()),
            ("SIGNED_DISTANCE", self.signed_distance.into()),
            ("LONG_SIGN", input.find("long_sign").is_some().into()),
            ("DROP_Z", machine.channels.iter().find(depth)?.drop.into()),
        ];
        let facts = vec![("DEPTH_AT", machine.channel_place(&self.depth)?)];
        Some(RegisterDevice::wired(WiredEngine::SubScanlines, [values, facts], machine.clone()))
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
