//! Neighbours of a machine that begins at registers: its engine's decisions, and its channels'.

use super::{List, near, near_or_none};
use crate::bits::Rounding;
use crate::format::Clamp;
use crate::machine::{
    Anchor, ClipEnds, EngineConfig, HalfOrder, Product, QuadRule, RegisterConfig, SlopeEdges,
};
use crate::profile::{Form, Profile};
use crate::value::{ChannelConfig, Extension};
use std::fmt::Display;

/// A number of a channel.
type Bits = fn(&mut ChannelConfig) -> &mut u32;

impl List<'_> {
    /// Adds a profile whose registers are changed.
    fn registers_with(
        &mut self,
        field: &str,
        got: &dyn Display,
        was: &dyn Display,
        change: &dyn Fn(&mut RegisterConfig),
    ) {
        let mut profile: Profile = self.profile.clone();
        if let Form::Registers(machine) = &mut profile.form {
            change(machine);
        }
        self.add(&format!("form.registers.{field}"), got, was, profile);
    }

    /// Every neighbour of the registers.
    pub(super) fn registers(&mut self, machine: &RegisterConfig) {
        for (n, channel) in machine.channels.iter().enumerate() {
            self.channel(n, channel);
        }
        self.engine(&machine.engine);
    }

    fn channel(&mut self, n: usize, channel: &ChannelConfig) {
        let names = channel.names.join(", ");
        let field = |name: &str| format!("channels ({names}): {name}");
        for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign] {
            self.registers_with(&field("clamp"), &clamp.name(), &channel.clamp.name(), &|m| {
                m.channels[n].clamp = clamp;
            });
        }
        for (start, name, other) in
            [(Extension::Sign, "sign", "zero"), (Extension::Zero, "zero", "sign")]
        {
            self.registers_with(&field("start"), &name, &other, &|m| m.channels[n].start = start);
        }
        let bits: [(&str, u32, Bits); 6] = [
            ("guard", channel.guard, |c| &mut c.guard),
            ("integer", channel.integer, |c| &mut c.integer),
            ("interpolation", channel.interpolation, |c| &mut c.interpolation),
            ("shift", channel.shift, |c| &mut c.shift),
            ("drop", channel.drop, |c| &mut c.drop),
            ("correction", channel.correction, |c| &mut c.correction),
        ];
        for (name, was, of) in bits {
            for got in near_or_none(was) {
                self.registers_with(&field(name), &got, &was, &|m| *of(&mut m.channels[n]) = got);
            }
        }
        let was = channel.shift_along.unwrap_or(channel.shift);
        for got in near(was) {
            self.registers_with(&field("shift-along"), &got, &was, &|m| {
                m.channels[n].shift_along = Some(got);
            });
        }
        let read = channel.guard + channel.integer + channel.interpolation;
        let was = channel.width.unwrap_or(read);
        for got in near(was).chain((read + 1 < was).then_some(read)) {
            self.registers_with(&field("width"), &got, &was, &|m| m.channels[n].width = Some(got));
        }
    }

    fn engine(&mut self, engine: &EngineConfig) {
        match engine {
            EngineConfig::Quads(quads) => {
                for (rule, name, other) in [
                    (QuadRule::Both, "both", "truncated-side"),
                    (QuadRule::TruncatedSide, "truncated-side", "both"),
                ] {
                    self.engine_with("quads.rule", &name, &other, &|e| {
                        if let EngineConfig::Quads(quads) = e {
                            quads.rule = rule;
                        }
                    });
                }
                for width in near(quads.width) {
                    self.engine_with("quads.width", &width, &quads.width, &|e| {
                        if let EngineConfig::Quads(quads) = e {
                            quads.width = width;
                        }
                    });
                }
            }
            EngineConfig::Anchored(anchored) => {
                for (anchor, name, other) in [
                    (Anchor::LeftmostGiven, "leftmost-given", "leftmost-sorted"),
                    (Anchor::LeftmostSorted, "leftmost-sorted", "leftmost-given"),
                ] {
                    self.engine_with("anchored.anchor", &name, &other, &|e| {
                        if let EngineConfig::Anchored(anchored) = e {
                            anchored.anchor = anchor;
                        }
                    });
                }
                for (halves, name, other) in [
                    (HalfOrder::FromAnchor, "from-anchor", "upper-first"),
                    (HalfOrder::UpperFirst, "upper-first", "from-anchor"),
                ] {
                    self.engine_with("anchored.halves", &name, &other, &|e| {
                        if let EngineConfig::Anchored(anchored) = e {
                            anchored.halves = halves;
                        }
                    });
                }
                for rounding in Rounding::ALL {
                    let was = anchored.rounding;
                    self.engine_with("anchored.rounding", &rounding, &was, &|e| {
                        if let EngineConfig::Anchored(anchored) = e {
                            anchored.rounding = rounding;
                        }
                    });
                }
                let was = if anchored.largest.is_some() { "a limit" } else { "none" };
                self.engine_with("anchored.largest", &"none", &was, &|e| {
                    if let EngineConfig::Anchored(anchored) = e {
                        anchored.largest = None;
                    }
                });
            }
            EngineConfig::Slopes(slopes) => self.slopes(slopes),
            EngineConfig::SubScanlines(_) => {
                for (product, name, other) in
                    [(Product::Wrap, "wrap", "resize"), (Product::Resize, "resize", "wrap")]
                {
                    self.engine_with("sub-scanlines.product", &name, &other, &|e| {
                        if let EngineConfig::SubScanlines(lines) = e {
                            lines.product = product;
                        }
                    });
                }
                for signed in [true, false] {
                    self.engine_with("sub-scanlines.signed-distance", &signed, &!signed, &|e| {
                        if let EngineConfig::SubScanlines(lines) = e {
                            lines.signed_distance = signed;
                        }
                    });
                }
            }
        }
    }

    fn slopes(&mut self, slopes: &crate::machine::SlopeConfig) {
        let was = slopes.pixel_bias;
        for bias in near_or_none(was) {
            self.engine_with("slopes.pixel-bias", &bias, &was, &|e| {
                if let EngineConfig::Slopes(slopes) = e {
                    slopes.pixel_bias = bias;
                }
            });
        }
        for (clip, name, other) in
            [(ClipEnds::HalfOpen, "half-open", "closed"), (ClipEnds::Closed, "closed", "half-open")]
        {
            self.engine_with("slopes.clip", &name, &other, &|e| {
                if let EngineConfig::Slopes(slopes) = e {
                    slopes.clip = clip;
                }
            });
        }
        if let SlopeEdges::Divided { row_bias: was, .. } = slopes.edges {
            for bias in near_or_none(was) {
                self.engine_with("slopes.edges.divided.row-bias", &bias, &was, &|e| {
                    if let EngineConfig::Slopes(slopes) = e
                        && let SlopeEdges::Divided { row_bias, .. } = &mut slopes.edges
                    {
                        *row_bias = bias;
                    }
                });
            }
        }
    }

    fn engine_with(
        &mut self,
        field: &str,
        got: &dyn Display,
        was: &dyn Display,
        change: &dyn Fn(&mut EngineConfig),
    ) {
        self.registers_with(&format!("engine.{field}"), got, was, &|m| change(&mut m.engine));
    }
}
