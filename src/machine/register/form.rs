//! The machine `registers` as a profile configures it. Spec clauses `RG-1` to `RG-4`.

use super::{RegisterConfig, RegisterError};
use crate::cover::FillRule;
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{Clamp, Refused, Value};
use crate::machine::{
    Datapath, Face, Form, FormError, Intake, Kind, Machine, Polygons, RasterState, Rasterizer,
    RegisterDevice, Site, Step, Steps, Target, Word, near, near_or_none,
};
use crate::value::{ChannelConfig, Extension};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "registers",
    known_as: "hardware that is described",
    clause: "RG-1",
    intake: Intake::Registers,
    polygons: Polygons::Refused,
    decisions: &[],
    // A profile does not say which registers there are.
    adopt: |_, _| None,
};

/// A number of a channel.
type Bits = fn(&mut ChannelConfig) -> &mut u32;

impl From<RegisterConfig> for Form {
    fn from(config: RegisterConfig) -> Self {
        Box::new(config).into()
    }
}

/// Changes of the channels of one shape.
fn channel_steps(steps: &mut Steps<'_, RegisterConfig>, n: usize, channel: &ChannelConfig) {
    let names = channel.names.join(", ");
    let field = |name: &str| format!("channels ({names}): {name}");
    for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign] {
        steps.add(&field("clamp"), &clamp.name(), &channel.clamp.name(), |m| {
            m.channels[n].clamp = clamp;
        });
    }
    for (start, name, other) in
        [(Extension::Sign, "sign", "zero"), (Extension::Zero, "zero", "sign")]
    {
        steps.add(&field("start"), &name, &other, |m| m.channels[n].start = start);
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
            steps.add(&field(name), &got, &was, |m| *of(&mut m.channels[n]) = got);
        }
    }
    let was = channel.shift_along.unwrap_or(channel.shift);
    for got in near(was) {
        steps.add(&field("shift-along"), &got, &was, |m| {
            m.channels[n].shift_along = Some(got);
        });
    }
    if let Some(was) = channel.slope_width {
        for got in near(was) {
            steps.add(&field("slope-width"), &got, &was, |m| m.channels[n].slope_width = Some(got));
        }
    }
    if channel.scale > 1 {
        for got in near(channel.scale) {
            steps.add(&field("scale"), &got, &channel.scale, |m| m.channels[n].scale = got);
        }
    }
    if let Some(was) = channel.replicate {
        for got in near(was) {
            steps.add(&field("replicate"), &got, &was, |m| m.channels[n].replicate = Some(got));
        }
    }
    let read = channel.guard + channel.integer + channel.interpolation;
    let was = channel.width.unwrap_or(read);
    for got in near(was).chain((read + 1 < was).then_some(read)) {
        steps.add(&field("width"), &got, &was, |m| m.channels[n].width = Some(got));
    }
}

/// The word of the channels of one shape.
fn channel_word(channel: &ChannelConfig) -> Word {
    let (guard, integer, interpolation) = (channel.guard, channel.integer, channel.interpolation);
    let read = guard + integer + interpolation;
    let width = channel.width.unwrap_or(read);
    let bits = [
        ("above", width - read),
        ("guard", guard),
        ("integer", integer),
        ("interpolation", interpolation),
    ];
    let facts = [
        ("clamp", channel.clamp.name().to_owned()),
        ("resolution", format!("2^-{interpolation} of a code")),
    ];
    let fields = bits.into_iter().filter(|(_, bits)| *bits > 0);
    Word::new(channel.names.join(", "), fields, facts)
}

impl From<RegisterError> for FormError {
    fn from(error: RegisterError) -> Self {
        Self { field: error.field().to_vec(), message: error.to_string() }
    }
}

impl Rasterizer for RegisterConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        let beside =
            [("depth", state.depth.is_some()), ("multisample", state.multisample.is_some())];
        if let Some((table, _)) = beside.into_iter().find(|(_, is_there)| *is_there) {
            let message = format!(
                "[{table}] has no effect with [form.registers], where the registers give all values and the \
                 output is records; remove the table"
            );
            return Err(FormError { field: vec![table], message });
        }
        let place = |error: &dyn std::fmt::Display| FormError::own(&KIND, &[], error);
        let grid = state.grid().map_err(|error| place(&error))?;
        let clip = state.clip().map_err(|error| place(&error))?;
        self.machine(&state.vertex, Target { grid, clip, reach: 0 })?;
        Ok(())
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        Ok(Box::new(self.machine(&state.vertex, site.target)?))
    }

    /// The rule that its picture is held against; the engine has one of its own.
    fn rule(&self) -> FillRule {
        FillRule::TopLeft
    }

    /// What registers draw is what their hardware draws, near the exact triangle but not it.
    fn covers_exactly(&self, _: &RasterState) -> bool {
        false
    }

    /// It has no depth beside its channels, so no depth that is made otherwise.
    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, _: &RasterState) -> Vec<Word> {
        self.engine
            .form()
            .edge_word()
            .into_iter()
            .chain(self.channels.iter().map(channel_word))
            .collect()
    }

    /// Its engines are hardware that is described, not a budget that is chosen.
    fn datapath(&self, _: &RasterState) -> Option<Datapath> {
        None
    }

    fn depth_bound(&self, _: &RasterState, _: &Face<'_>, _: &PlaneNumerator) -> Option<Rational> {
        None
    }

    fn may_misplace(&self, _: &Face<'_>, _: [i128; 2]) -> Option<bool> {
        None
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        for (n, channel) in self.channels.iter().enumerate() {
            channel_steps(&mut steps, n, channel);
        }
        let engines = self.engine.form().neighbours().into_iter().map(|step| Step {
            field: format!("engine.{}.{}", self.engine.name(), step.field),
            got: step.got,
            was: step.was,
            form: Self { engine: step.form, ..self.clone() }.into(),
        });
        steps.found().into_iter().chain(engines).collect()
    }

    fn decision(&self, _: &str) -> Option<Value> {
        None
    }

    fn decide(&mut self, _: &str, _: &Value, _: &RasterState) -> Result<(), Refused> {
        Err(Refused::Absent)
    }

    fn engine(&self) -> &'static str {
        self.engine.name()
    }

    fn register_device(&self) -> Option<RegisterDevice> {
        self.engine.form().device(self)
    }

    fn channels(&self) -> &[ChannelConfig] {
        &self.channels
    }
}
