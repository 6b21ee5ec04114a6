//! The units that evaluate the channels of a profile, each different one once. Spec clauses `CH-15` and
//! `CH-16`.

use crate::model::Model;
use crate::profile::Profile;
use crate::value::{
    AttributeConfig, Correction, Corrector, EvaluatedAt, InterpolatorUnit, ReciprocalUnit,
    StartBias,
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
        detail: None,
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
            && let Some(unit) = InterpolatorUnit::new(read, false, true)
        {
            units.interpolates(INVERSE_W, unit);
        }
        for channel in &profile.channel {
            let Ok(corrector) = Corrector::new(channel, w, &profile.vertex) else { continue };
            if let Some(unit) = corrector.interpolator().filter(|_| steps) {
                units.interpolates(&channel.name, unit);
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

    fn interpolates(&mut self, name: &str, unit: InterpolatorUnit) {
        add(&mut self.interpolators, "interpolator", name, unit);
    }
}

fn add<T: PartialEq>(list: &mut Vec<Named<T>>, kind: &str, name: &str, unit: T) {
    if list.iter().all(|known| known.unit != unit) {
        list.push(Named { bench: format!("{kind}-{name}"), unit });
    }
}
