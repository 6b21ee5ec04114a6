//! Suspects of channels: the faults that interpolators, reciprocal units and dividers usually have.

use super::reciprocal::beyond;
use super::{Suspect, Suspects};
use crate::bits::{Rounding, bounded};
use crate::format::Clamp;
use crate::model::Model;
use crate::profile::Profile;
use crate::value::{
    AttributeConfig, Correction, EvaluatedAt, Provoking, ReciprocalConfig, Refine, StartBias,
};
use crate::vector::bench::ChannelBench;
use crate::vector::device::ChannelDrawer;
use std::sync::Arc;

impl Suspects for ChannelBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let profile = self.model().profile();
        let mut changes = Vec::new();
        for (n, channel) in profile.channel.iter().enumerate() {
            for (what, changed) in changed(channel) {
                let mut profile = profile.clone();
                profile.channel[n] = changed;
                if !profile.channel.iter().any(|channel| channel.correction.needs_w()) {
                    profile.w = None;
                }
                changes.push((format!("channel {}: {what}", channel.name), profile));
            }
        }
        changes.extend(other_w(profile));
        let suspect = |(change, profile): (String, Profile)| {
            let model = Arc::new(Model::new(&profile).ok()?);
            Some(Suspect::new(self, change, ChannelDrawer::new(model)))
        };
        changes.into_iter().filter_map(suspect).collect()
    }
}

/// Profiles whose plane of 1/w differs in one thing.
pub(super) fn other_w(profile: &Profile) -> Vec<(String, Profile)> {
    let Some(w) = profile.w else { return Vec::new() };
    let mut list = Vec::new();
    let mut add = |what: String, w| list.push((what, Profile { w: Some(w), ..profile.clone() }));
    for rounding in Rounding::ALL.into_iter().filter(|rounding| *rounding != w.rounding) {
        let mut other = w;
        other.rounding = rounding;
        add(format!("w.rounding is {rounding}"), other);
    }
    for (field, value) in [("guard", w.guard), ("interpolation", w.interpolation)] {
        for value in [value.checked_sub(1), Some(value + 1)].into_iter().flatten() {
            let mut other = w;
            *(if field == "guard" { &mut other.guard } else { &mut other.interpolation }) = value;
            add(format!("w.{field} is {value}"), other);
        }
    }
    list
}

/// Channels that differ in one thing, and what it is.
pub(super) fn changed(channel: &AttributeConfig) -> Vec<(String, AttributeConfig)> {
    let mut list = Vec::new();
    let mut add = |what: String, change: &dyn Fn(&mut AttributeConfig)| {
        let mut other = channel.clone();
        change(&mut other);
        list.push((what, other));
    };
    for correction in other_corrections(&channel.correction) {
        add(correction.0, &|other| other.correction = correction.1.clone());
    }
    for rounding in Rounding::ALL.into_iter().filter(|rounding| *rounding != channel.rounding) {
        add(format!("rounding is {rounding}"), &|other| other.rounding = rounding);
    }
    for value in [channel.interpolation.checked_sub(1), Some(channel.interpolation + 1)] {
        let Some(value) = value else { continue };
        add(format!("interpolation is {value}"), &|other| other.interpolation = value);
    }
    for value in [channel.guard.checked_sub(1), Some(channel.guard + 1)].into_iter().flatten() {
        add(format!("guard is {value}"), &|other| other.guard = value);
    }
    for clamp in [Clamp::Wrap, Clamp::Guard, Clamp::Sign] {
        if clamp != channel.clamp {
            add(format!("clamp is {}", clamp.name()), &|other| other.clamp = clamp);
        }
    }
    let places = [
        ("sample", EvaluatedAt::Sample),
        ("centre", EvaluatedAt::Centre),
        ("corner", EvaluatedAt::Corner),
        ("centroid", EvaluatedAt::Centroid),
    ];
    for (name, at) in places.into_iter().filter(|(_, at)| *at != channel.at) {
        add(format!("at is {name}"), &|other| other.at = at);
    }
    let (bias, name) = match channel.start_bias {
        StartBias::None => (StartBias::Half, "half"),
        StartBias::Half => (StartBias::None, "none"),
    };
    add(format!("start-bias is {name}"), &|other| other.start_bias = bias);
    list
}

/// Other corrections than this one, likeliest first.
fn other_corrections(correction: &Correction) -> Vec<(String, Correction)> {
    let mut list = Vec::new();
    let affine = ("it is not corrected for perspective".to_owned(), Correction::Affine);
    let rounded = |own: Rounding| Rounding::ALL.into_iter().filter(move |other| *other != own);
    match correction {
        Correction::Affine => {}
        Correction::Flat { provoking } => {
            let (provoking, name) = match provoking {
                Provoking::First => (Provoking::Last, "last"),
                Provoking::Last => (Provoking::First, "first"),
            };
            list.push((format!("the {name} vertex is provoking"), Correction::Flat { provoking }));
        }
        Correction::Quotient { rounding } | Correction::ConstantW { rounding } => {
            list.push(affine);
            let every = |rounding| Correction::Quotient { rounding };
            let constant = |rounding| Correction::ConstantW { rounding };
            let (own, other, what): (&dyn Fn(Rounding) -> _, &dyn Fn(Rounding) -> _, _) =
                if matches!(correction, Correction::Quotient { .. }) {
                    (&every, &constant, "w is constant along a span")
                } else {
                    (&constant, &every, "w is taken at every sample")
                };
            for rounding in rounded(*rounding) {
                list.push((format!("the quotient is rounded by {rounding}"), own(rounding)));
            }
            list.push((what.to_owned(), other(*rounding)));
        }
        Correction::Reciprocal { unit, rounding } => {
            list.push(affine);
            for (what, unit) in other_units(unit) {
                list.push((what, Correction::Reciprocal { unit, rounding: *rounding }));
            }
            for rounding in rounded(*rounding) {
                let what = format!("the product is rounded by {rounding}");
                list.push((what, Correction::Reciprocal { unit: unit.clone(), rounding }));
            }
        }
        Correction::Barycentric { bits, rounding } => {
            list.push(affine);
            for bits in [bits - 1, bits + 1] {
                let rounding = *rounding;
                list.push((
                    format!("a coordinate has {bits} bits"),
                    Correction::Barycentric { bits, rounding },
                ));
            }
            for rounding in rounded(*rounding) {
                let what = format!("a coordinate is rounded by {rounding}");
                list.push((what, Correction::Barycentric { bits: *bits, rounding }));
            }
        }
    }
    list
}

/// Reciprocal units with one fault.
pub(super) fn other_units(unit: &ReciprocalConfig) -> Vec<(String, ReciprocalConfig)> {
    let mut list = Vec::new();
    let Ok(ready) = unit.unit() else { return list };
    let with = |table: Vec<u32>| ReciprocalConfig { table: Some(table), ..unit.clone() };
    let (mut up, mut down) = (ready.table().to_vec(), ready.table().to_vec());
    up.rotate_left(1);
    down.rotate_right(1);
    list.push(("the table is read one entry too far".to_owned(), with(up)));
    list.push(("the table is read one entry too early".to_owned(), with(down)));
    if let Refine::Newton { bits } = &unit.refine {
        let fewer = bits[..bits.len() - 1].to_vec();
        let refine = if fewer.is_empty() { Refine::None } else { Refine::Newton { bits: fewer } };
        list.push((
            "the last Newton step is missing".to_owned(),
            ReciprocalConfig { refine, ..unit.clone() },
        ));
        for (step, own) in bits.iter().enumerate() {
            for value in [own - 1, own + 1] {
                let mut bits = bits.clone();
                bits[step] = value;
                let refine = Refine::Newton { bits };
                list.push((
                    format!("Newton step {step} makes {value} bits"),
                    ReciprocalConfig { refine, ..unit.clone() },
                ));
            }
        }
    }
    if unit.refine == Refine::Linear {
        let table = ready.table()[..ready.table().len() - 1].to_vec();
        let none = ReciprocalConfig { refine: Refine::None, table: Some(table), ..unit.clone() };
        list.push(("the line between entries is missing".to_owned(), none));
    }
    list.extend(other_ends(unit));
    let operand = unit.operand - 1;
    list.push((
        format!("the operand has {operand} bits"),
        ReciprocalConfig { operand, table: Some(ready.table().to_vec()), ..unit.clone() },
    ));
    list
}

/// The same unit with the entries of lines where it has none, or the other way round.
fn other_ends(unit: &ReciprocalConfig) -> Option<(String, ReciprocalConfig)> {
    if unit.table.is_some() {
        return None;
    }
    let lines = unit.refine == Refine::Linear;
    let refine = if lines { Refine::None } else { Refine::Linear };
    let other = ReciprocalConfig { refine, ..unit.clone() }.unit().ok()?;
    let mut table = other.table().to_vec();
    let what = if lines {
        table.push(bounded(beyond(unit.index, unit.entry)));
        "the entries are those in the middle of the intervals"
    } else {
        table.pop();
        "the entries are those at the lower ends of the intervals"
    };
    Some((what.to_owned(), ReciprocalConfig { table: Some(table), ..unit.clone() }))
}
