//! The units that evaluate the channels of a profile, each different one once. Spec clauses `CH-15` and
//! `CH-16`.

use crate::format::ReadOut;
use crate::model::Model;
use crate::profile::Profile;
use crate::value::{
    AttributeConfig, Correction, Corrector, EvaluatedAt, ReciprocalUnit, StartBias,
};

/// Who walks the plane of 1/w. No channel has such a name: a name of a channel has no `-`.
const INVERSE_W: &str = "inverse-w";

/// A unit, named after the first channel that has it.
#[derive(Clone, Debug)]
pub(in crate::vector) struct Named<T> {
    /// The name of its bench.
    pub(in crate::vector) bench: String,
    pub(in crate::vector) unit: T,
}

/// A component, or 1/w, along a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::vector) struct InterpolatorUnit {
    /// The accumulator and what is read of it: a code, or u/w and 1/w with their fraction.
    pub(in crate::vector) read: ReadOut,
    /// Whether what is read is two's complement.
    pub(in crate::vector) signed: bool,
    /// Bits of what is read that stand below the binary point.
    pub(in crate::vector) below: u32,
}

impl InterpolatorUnit {
    /// What is added before the read-out, in units of what is read, and taken away after it.
    pub(in crate::vector) fn offset(&self) -> i128 {
        if self.signed { 1 << (self.read.integer() - 1) } else { 0 }
    }

    /// Bits of the accumulator below its binary point.
    pub(in crate::vector) fn fraction(&self) -> u32 {
        self.below + self.read.fraction()
    }
}

/// A reciprocal unit, and the integers that it takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::vector) struct ReciprocalPort {
    /// The unit.
    pub(in crate::vector) unit: ReciprocalUnit,
    /// Bits of an integer.
    pub(in crate::vector) width: u32,
}

/// The units of a profile.
#[derive(Clone, Debug, Default)]
pub(in crate::vector) struct Units {
    pub(in crate::vector) interpolators: Vec<Named<InterpolatorUnit>>,
    pub(in crate::vector) reciprocals: Vec<Named<ReciprocalPort>>,
    pub(in crate::vector) dividers: Vec<Named<Corrector>>,
}

/// What a divider depends on: of two channels with the same words here, one divider is enough.
pub(in crate::vector) fn divides(channel: &AttributeConfig) -> AttributeConfig {
    let correction = match &channel.correction {
        // The same quotient; only its 1/w is that of another sample.
        Correction::ConstantW { rounding } => Correction::Quotient { rounding: *rounding },
        other => other.clone(),
    };
    AttributeConfig {
        name: String::new(),
        components: Vec::new(),
        at: EvaluatedAt::Sample,
        start_bias: StartBias::None,
        rounding: crate::bits::Rounding::Floor,
        division: crate::setup::Division::Quotient,
        unit: None,
        source: None,
        correction,
        ..channel.clone()
    }
}

impl Units {
    /// The units of a profile; none of one without channels.
    pub(in crate::vector) fn of(profile: &Profile) -> Self {
        let mut units = Self::default();
        if profile.channel.is_empty() {
            return units;
        }
        let Ok(model) = Model::new(profile) else { return units };
        let steps = model.channels().is_some_and(crate::machine::Channels::steps);
        let w = profile.w.as_ref();
        let mut dividers: Vec<AttributeConfig> = Vec::new();
        let walked = |channel: &&AttributeConfig| channel.correction.walks_w();
        if steps
            && profile.channel.iter().any(|channel| walked(&channel))
            && let Some(read) = w.and_then(|w| w.validate(&profile.vertex).ok())
        {
            units.interpolates(INVERSE_W, read, (false, true));
        }
        for channel in &profile.channel {
            let Ok(corrector) = Corrector::new(channel, w, &profile.vertex) else { continue };
            let carried = walked(&channel) || channel.correction == Correction::Affine;
            if steps && carried {
                let how = (channel.signed, walked(&channel));
                units.interpolates(&channel.name, corrector.read_out(), how);
            }
            if !walked(&channel) {
                continue;
            }
            if let (Some(unit), Some(read)) = (corrector.unit(), corrector.w_read_out()) {
                let port =
                    ReciprocalPort { unit: unit.clone(), width: read.integer() + read.fraction() };
                add(&mut units.reciprocals, "reciprocal", &channel.name, port);
            }
            let own = divides(channel);
            if !dividers.contains(&own) {
                let bench = format!("divider-{}", channel.name);
                units.dividers.push(Named { bench, unit: corrector });
                dividers.push(own);
            }
        }
        units
    }

    /// Adds the interpolator of an accumulator; `whole` has its fraction read, too.
    fn interpolates(&mut self, name: &str, read: ReadOut, (signed, whole): (bool, bool)) {
        let below = if whole { read.fraction() } else { 0 };
        let (integer, fraction) = (read.integer() + below, read.fraction() - below);
        // The split of the guard range is the same pattern, wherever the binary point stands.
        let Ok(read) = ReadOut::new(read.guard(), integer, fraction, read.clamp()) else { return };
        let unit = InterpolatorUnit { read, signed, below };
        add(&mut self.interpolators, "interpolator", name, unit);
    }
}

fn add<T: PartialEq>(list: &mut Vec<Named<T>>, kind: &str, name: &str, unit: T) {
    if list.iter().all(|known| known.unit != unit) {
        list.push(Named { bench: format!("{kind}-{name}"), unit });
    }
}
