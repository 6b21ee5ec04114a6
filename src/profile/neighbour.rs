//! The one-change neighbours of a profile: what `verify` tries when a dump disagrees.

use super::Profile;
use crate::bits::Rounding;
use crate::cover::SampleConfig;
use crate::format::Clamp;
use crate::machine::{Step, near};
use crate::setup::{CullConfig, Division, Winding};
use crate::value::{DepthBias, DepthConfig, StartBias};
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
    list.depth();
    list.machine();
    list.vertex();
    list.cull();
    list.found
}

/// A term of the depth bias, and its absence.
type Term = (&'static str, fn(&mut DepthBias));

/// What a set-up that forgets a term of the depth bias does.
const BIAS_LEFT_OUT: [Term; 3] = [
    ("constant", |bias| bias.constant = 0),
    ("slope", |bias| bias.slope = 0),
    ("clamp", |bias| bias.clamp = 0),
];

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
        for (key, change) in BIAS_LEFT_OUT {
            if let Some(bias) = depth.bias {
                let mut without = bias;
                change(&mut without);
                let changed = with(&|d| d.bias = Some(without));
                self.add(&format!("depth.bias.{key}"), &"left out", &"added", changed);
            }
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

    /// What the machine lists.
    fn machine(&mut self) {
        let profile = self.profile;
        for Step { field, got, was, form } in profile.form.neighbours() {
            let field = format!("form.{}.{field}", profile.form.name());
            self.add(&field, &got, &was, Profile { form, ..profile.clone() });
        }
    }

    fn cull(&mut self) {
        let Some(cull) = self.profile.cull else { return };
        let name = |winding: Option<Winding>| winding.map_or("none".to_owned(), |w| w.to_string());
        for winding in [None].into_iter().chain(Winding::ALL.map(Some)) {
            let changed =
                Profile { cull: Some(CullConfig { winding, ..cull }), ..self.profile.clone() };
            self.add("cull.winding", &name(winding), &name(cull.winding), changed);
        }
        if cull.largest.is_some() {
            let changed = Profile {
                cull: Some(CullConfig { largest: None, ..cull }),
                ..self.profile.clone()
            };
            self.add("cull.largest", &"none", &"as in the profile", changed);
        }
    }

    fn vertex(&mut self) {
        let of = self.profile.sample.and_then(|sample| sample.of);
        let half = of.unwrap_or(1 << self.profile.vertex.sub_pixel) / 2;
        let SampleConfig { x, y, .. } =
            self.profile.sample.unwrap_or(SampleConfig::sub_pixels(half, half));
        for (to_x, to_y) in [(0, 0), (half, half), (x + 1, y), (x, y + 1)] {
            if (to_x, to_y) != (x, y) {
                let sample = Some(SampleConfig { x: to_x, y: to_y, of });
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
