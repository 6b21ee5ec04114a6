//! The figures of channels, under names that a profile makes: `color-worst`, `map-rms@1024`. Spec clause
//! `Q-4`.

use super::{Cause, Metric, Source, Subject};
use crate::measure::accuracy::{Accuracy, Spread};
use crate::profile::Profile;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// A figure of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OfChannel {
    channel: &'static str,
    part: Part,
    scale: Scale,
}

/// What is made of the errors of all samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Worst,
    Mean,
    Rms,
}

/// In which units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    /// The last place of a code.
    Ulp,
    /// The real number 1 of the scene.
    World,
    /// Texels of a texture of so many.
    Texels(u32),
}

const PARTS: [(&str, Part); 3] = [("worst", Part::Worst), ("mean", Part::Mean), ("rms", Part::Rms)];

/// The largest texture, in texels a side.
const MOST_TEXELS: u32 = 1 << 20;

/// Metrics that were asked for. Few, and kept: what is named once is read of every budget.
static KNOWN: Mutex<BTreeMap<String, Metric>> = Mutex::new(BTreeMap::new());

impl OfChannel {
    /// The figure; `None` where the scenes have no values for the channel.
    pub(super) fn of(self, accuracy: &Accuracy) -> Option<f64> {
        let error = accuracy.channels.iter().find(|error| error.name == self.channel)?;
        let Spread { worst, mean, rms } = error.ulp;
        let ulp = match self.part {
            Part::Worst => worst,
            Part::Mean => mean.abs(),
            Part::Rms => rms,
        };
        Some(match self.scale {
            Scale::Ulp => ulp,
            Scale::World => ulp / error.unit,
            Scale::Texels(size) => ulp / error.unit * f64::from(size),
        })
    }
}

/// Channel, part and scale of `CHANNEL-PART`, `CHANNEL-PART-world` or `CHANNEL-PART@TEXELS`.
fn parse(name: &str) -> Option<(&str, Part, Scale)> {
    let (rest, scale) = match (name.split_once('@'), name.strip_suffix("-world")) {
        (Some((rest, size)), _) => {
            let size = size.parse().ok().filter(|size| (1..=MOST_TEXELS).contains(size))?;
            (rest, Scale::Texels(size))
        }
        (None, Some(rest)) => (rest, Scale::World),
        (None, None) => (name, Scale::Ulp),
    };
    let (channel, part) = rest.rsplit_once('-')?;
    let (_, part) = PARTS.into_iter().find(|(known, _)| *known == part)?;
    (!channel.is_empty()).then_some((channel, part, scale))
}

impl Metric {
    /// A figure of a channel by its name, whether any profile has such a channel or not.
    pub(super) fn of_channel(name: &str) -> Option<Self> {
        parse(name)?;
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(metric) = known.get(name) {
            return Some(*metric);
        }
        let kept: &'static str = name.to_owned().leak();
        let (channel, part, scale) = parse(kept)?;
        let (unit, about) = match scale {
            Scale::Ulp => ("ULP", "error of a channel's codes"),
            Scale::World => ("of 1", "error of a channel's codes, as a part of the real number 1"),
            Scale::Texels(_) => ("texels", "error of a channel's codes in texels of that size"),
        };
        let metric = Self {
            name: kept,
            unit,
            about,
            subject: Subject::Channel(channel),
            cause: Cause::Arithmetic,
            source: Source::Channel(OfChannel { channel, part, scale }),
        };
        known.insert(name.to_owned(), metric);
        Some(metric)
    }

    /// The channel that the metric is about.
    pub const fn channel(&self) -> Option<&'static str> {
        match self.subject {
            Subject::Channel(channel) => Some(channel),
            _ => None,
        }
    }
}

/// The metrics of the channels of a profile, in ULP.
pub fn of_channels(profile: &Profile) -> impl Iterator<Item = Metric> {
    let names = profile
        .channel
        .iter()
        .flat_map(|channel| PARTS.map(|(part, _)| format!("{}-{part}", channel.name)));
    names.filter_map(|name| Metric::of_channel(&name))
}
