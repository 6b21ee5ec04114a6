//! The fields of channels and of 1/w, under names that a profile makes. Spec clause `Q-1`.

use super::{Decision, Field, Owner};
use crate::profile::Profile;
use crate::value::{AttributeConfig, InverseWConfig};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The name of the plane of 1/w, before the dot. No channel can be called so: a set-up word of it would
/// have the name of one of 1/w.
const W: &str = "w";

/// Fields that were asked for. Few, and kept: what is named once is named again by every budget.
static KNOWN: Mutex<BTreeMap<String, Field>> = Mutex::new(BTreeMap::new());

impl Field {
    /// The name within its owner: `interpolation` of `color.interpolation`.
    pub(super) fn part(self) -> &'static str {
        self.name().split_once('.').map_or(self.name(), |(_, part)| part)
    }

    /// A field `OWNER.PART`.
    pub(super) fn of_channel(name: &str) -> Option<Self> {
        let (owner, part) = name.split_once('.')?;
        let decisions =
            if owner == W { InverseWConfig::DECISIONS } else { AttributeConfig::DECISIONS };
        let decision = decisions.iter().find(|decision| decision.name == part)?;
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(field) = known.get(name) {
            return Some(*field);
        }
        let kept: &'static str = name.to_owned().leak();
        let owner = match kept.split_once('.') {
            Some((W, _)) | None => Owner::InverseW,
            Some((channel, _)) => Owner::Channel(channel),
        };
        let decision = Box::leak(Box::new(Decision { name: kept, ..*decision }));
        let field = Self::of(owner, decision);
        known.insert(name.to_owned(), field);
        Some(field)
    }

    /// The fields of the channels of a profile and of its 1/w.
    pub(super) fn of_channels(profile: &Profile) -> impl Iterator<Item = Self> {
        let named = |owner: &str, decisions: &'static [Decision]| {
            let names = decisions.iter().map(|decision| format!("{owner}.{}", decision.name));
            names.filter_map(|name| Self::of_channel(&name)).collect::<Vec<_>>()
        };
        let w = profile.w.iter().flat_map(move |_| named(W, InverseWConfig::DECISIONS));
        let channels = profile
            .channel
            .iter()
            .flat_map(move |channel| named(&channel.name, AttributeConfig::DECISIONS));
        w.chain(channels)
    }
}
