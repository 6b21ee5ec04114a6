//! The one-change neighbours of a profile: what `verify` tries when a dump disagrees.

mod register;

use super::{Form, Profile};
use crate::bits::Rounding;
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule, SampleConfig};
use crate::format::Clamp;
use crate::machine::EdgeWalkConfig;
use crate::setup::Division;
use crate::value::{DepthConfig, StartBias};
use std::fmt::Display;

/// A profile that differs in one decision, and that decision in words.
#[derive(Clone, Debug)]
pub struct Neighbour {
    /// What differs, such as `depth.rounding is floor instead of nearest-even`.
    pub change: String,
    /// The changed profile, valid.
    pub profile: Profile,
}

/// Every valid profile one change away, likeliest defects first.
pub fn neighbours(profile: &Profile) -> Vec<Neighbour> {
    let mut list = List { profile, found: Vec::new() };
    if let Form::Registers(machine) = &profile.form {
        list.registers(machine);
        list.vertex();
        return list.found;
    }
    list.depth();
    if let Some(edges) = profile.form.edge() {
        list.edge_words(*edges);
    }
    if let Some(walk) = profile.form.walk() {
        list.edge_walk(*walk);
    }
    list.rule_alone();
    list.vertex();
    list.found
}

/// Each rule, its name, and the one it is not.
const RULES: [(FillRule, &str, &str); 2] =
    [(FillRule::TopLeft, "top-left", "shadow"), (FillRule::Shadow, "shadow", "top-left")];

struct List<'a> {
    profile: &'a Profile,
    found: Vec<Neighbour>,
}

impl List<'_> {
    fn add(&mut self, field: &str, got: &dyn Display, was: &dyn Display, changed: Profile) {
        if changed != *self.profile && changed.validate().is_ok() {
            let change = format!("{field} is {got} instead of {was}");
            self.found.push(Neighbour { change, profile: changed });
        }
    }

    fn depth(&mut self) {
        let Some(depth) = self.profile.depth else { return };
        let profile = self.profile;
        let with = |change: &dyn Fn(&mut DepthConfig)| {
            let mut changed = profile.clone();
            changed.depth.iter_mut().for_each(change);
            changed
        };
        // A device cannot refuse: under `error` it answers as under `guard`.
        for clamp in Clamp::ALL.into_iter().filter(|clamp| *clamp != Clamp::Error) {
            let changed = with(&|d| d.clamp = clamp);
            self.add("depth.clamp", &clamp.name(), &depth.clamp.name(), changed);
        }
        for guard in near(depth.guard) {
            self.add("depth.guard", &guard, &depth.guard, with(&|d| d.guard = guard));
        }
        for rounding in Rounding::ALL {
            let changed = with(&|d| d.rounding = rounding);
            self.add("depth.rounding", &rounding, &depth.rounding, changed);
        }
        for bits in near(depth.interpolation) {
            let changed = with(&|d| d.interpolation = bits);
            self.add("depth.interpolation", &bits, &depth.interpolation, changed);
        }
        for (bias, name, other) in
            [(StartBias::Half, "half", "none"), (StartBias::None, "none", "half")]
        {
            self.add("depth.start-bias", &name, &other, with(&|d| d.start_bias = bias));
        }
        let was = match depth.division {
            Division::Quotient => "an exact quotient".to_owned(),
            Division::Reciprocal { bits } => format!("a reciprocal of {bits} bits"),
        };
        for bits in 8..=32 {
            let changed = with(&|d| d.division = Division::Reciprocal { bits });
            self.add("depth.division", &format!("a reciprocal of {bits} bits"), &was, changed);
        }
        let changed = with(&|d| d.division = Division::Quotient);
        self.add("depth.division", &"an exact quotient", &was, changed);
    }

    /// The rule of a machine that has no edge words.
    fn rule_alone(&mut self) {
        for (rule, name, other) in RULES {
            let mut changed = self.profile.clone();
            match &mut changed.form {
                Form::Scanline(machine) => machine.rule = rule,
                Form::Homogeneous(machine) => machine.rule = rule,
                _ => continue,
            }
            let field = format!("form.{}.rule", changed.form.name());
            self.add(&field, &name, &other, changed);
        }
    }

    fn edge_words(&mut self, edges: EdgeWordConfig) {
        let profile = self.profile;
        let with = |change: &dyn Fn(&mut EdgeWordConfig)| {
            let mut changed = profile.clone();
            if let Some(edges) = changed.form.edge_mut() {
                change(edges);
            }
            changed
        };
        let inner = match profile.form {
            Form::Tiles(_) | Form::Barycentric(_) => ".edge",
            _ => "",
        };
        let field = |name: &str| format!("form.{}{inner}.{name}", profile.form.name());
        for (rule, name, other) in RULES {
            self.add(&field("rule"), &name, &other, with(&|e| e.rule = rule));
        }
        for (storage, name, other) in
            [(EdgeStorage::Full, "full", "shifted"), (EdgeStorage::Shifted, "shifted", "full")]
        {
            let changed = with(&|e| e.storage = storage);
            self.add(&field("storage"), &name, &other, changed);
        }
        for width in near(edges.width) {
            let changed = with(&|e| e.width = width);
            self.add(&field("width"), &width, &edges.width, changed);
        }
    }

    fn edge_walk(&mut self, walk: EdgeWalkConfig) {
        let profile = self.profile;
        let with = |walk| {
            let mut changed = profile.clone();
            changed.form.walk_mut().into_iter().for_each(|old| *old = walk);
            changed
        };
        let field = |name: &str| format!("form.{}.{name}", profile.form.name());
        for rounding in Rounding::ALL {
            let changed = with(EdgeWalkConfig { rounding, ..walk });
            self.add(&field("rounding"), &rounding, &walk.rounding, changed);
        }
        for fraction in near(walk.fraction) {
            let changed = with(EdgeWalkConfig { fraction, ..walk });
            self.add(&field("fraction"), &fraction, &walk.fraction, changed);
        }
    }

    fn vertex(&mut self) {
        let half = 1 << self.profile.vertex.sub_pixel >> 1;
        let SampleConfig { x, y } =
            self.profile.sample.unwrap_or(SampleConfig { x: half, y: half });
        for (to_x, to_y) in [(0, 0), (half, half), (x + 1, y), (x, y + 1)] {
            if (to_x, to_y) != (x, y) {
                let sample = Some(SampleConfig { x: to_x, y: to_y });
                let changed = Profile { sample, ..self.profile.clone() };
                let [got, was] = [(to_x, to_y), (x, y)].map(|(x, y)| format!("({x}, {y})"));
                self.add("sample", &got, &was, changed);
            }
        }
        for snap in Rounding::ALL {
            let mut changed = self.profile.clone();
            changed.vertex.snap = snap;
            self.add("vertex.snap", &snap, &self.profile.vertex.snap, changed);
        }
    }
}

/// The same, and none at all.
fn near_or_none(bits: u32) -> impl Iterator<Item = u32> {
    near(bits).chain((bits > 1).then_some(0))
}

/// One less (if any) and one more.
fn near(bits: u32) -> impl Iterator<Item = u32> {
    bits.checked_sub(1).into_iter().chain([bits + 1])
}
