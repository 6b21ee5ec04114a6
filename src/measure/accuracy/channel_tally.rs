//! The errors of channels, added up. Spec clause `M-9`.

use super::moment::{Moments, Spread};
use super::reference::real;
use crate::profile::Profile;
use crate::value::AttributeConfig;
use serde::{Deserialize, Serialize};

/// The errors of a channel's codes, as reported.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelError {
    /// The channel.
    pub name: String,
    /// The code of the real number 1.
    pub unit: f64,
    /// In units of the code's last place, all components together.
    pub ulp: Spread,
}

/// The worst code that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstCode {
    /// Component of the channel.
    pub component: usize,
    /// The triangle's place among the faces of its stage.
    pub face: usize,
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// The code.
    pub code: i64,
    /// What it should be.
    pub exact: f64,
}

/// What was measured of some channels.
#[derive(Clone, Debug, Default)]
pub struct ChannelTally {
    /// By channel.
    pub moments: Vec<Moments>,
    /// By channel: the first of the worst codes.
    pub worst: Vec<WorstCode>,
}

impl ChannelTally {
    /// Nothing of so many channels.
    pub fn of(channels: usize) -> Self {
        let (moments, worst) = (Moments::default(), WorstCode::default());
        Self { moments: vec![moments; channels], worst: vec![worst; channels] }
    }

    /// Adds what another has of the same channels.
    pub fn merge(&mut self, other: &Self) {
        for (n, moments) in other.moments.iter().enumerate() {
            if moments.worst > self.moments[n].worst {
                self.worst[n] = other.worst[n];
            }
            self.moments[n].merge(moments);
        }
    }

    /// The report, of those channels of a profile that were measured.
    pub fn report(&self, profile: &Profile) -> Vec<ChannelError> {
        let channels = profile.channel.iter().zip(&self.moments);
        let measured = channels.filter(|(_, moments)| moments.count > 0);
        let report = |(config, moments): (&AttributeConfig, &Moments)| ChannelError {
            name: config.name.clone(),
            unit: real(config.unit()),
            ulp: moments.spread(),
        };
        measured.map(report).collect()
    }
}
