//! Bits of channels: how far a code is off, over a whole window. Spec clauses `CH-22` and `CH-23`.

use super::carried::CarriedValue;
use super::channel_formal::coordinate_obligation;
use super::corrected::{Corrected, of_w};
use super::domain::Question;
use super::formal::Formal;
use super::plane::{self, Goal, Subject};
use super::text::{bits as count, decimal_up};
use super::{Proof, guard};
use crate::cover::ConservativeMode;
use crate::exact::{Rational, dyadic, integer};
use crate::profile::Profile;
use crate::value::{
    AttributeConfig, Correction, DepthConfig, EvaluatedAt, InverseWConfig, StartBias,
};
use std::fmt::Write as _;

/// More bits than any word has.
pub(super) const MOST: u32 = 120;

/// The claims on every channel and on 1/w.
pub(super) fn proofs(question: &Question) -> Vec<Proof> {
    let Profile { channel: channels, w, .. } = &question.profile;
    let mut proofs: Vec<Proof> =
        channels.iter().flat_map(|channel| of_channel(question, channel, w.as_ref())).collect();
    if let Some(w) = w.filter(|_| channels.iter().any(|channel| channel.correction.walks_w())) {
        proofs.extend(of_w(question, channels, &w));
    }
    proofs
}

fn of_channel(
    question: &Question,
    channel: &AttributeConfig,
    w: Option<&InverseWConfig>,
) -> Vec<Proof> {
    match (&channel.correction, w) {
        (Correction::Flat { .. }, _) => vec![flat(question, channel)],
        (Correction::Affine, _) => affine(question, channel),
        (Correction::Barycentric { bits, .. }, _) => vec![coordinates(question, channel, *bits)],
        (_, Some(w)) => {
            let corrected = Corrected::new(question, channel, w);
            let guard = corrected.over.guard_proof(corrected.inside);
            [Some(corrected.proof()), guard].into_iter().flatten().collect()
        }
        (_, None) => Vec::new(),
    }
}

/// Whether the channel is evaluated inside its triangle wherever a sample is covered. The standard positions of
/// several samples lie around the centre, so a pixel with all of them covered has its centre inside. A pixel that a
/// triangle only touches has not: clause `CR-8`.
pub(super) fn is_inside(question: &Question, channel: &AttributeConfig) -> bool {
    if touches(question) {
        return false;
    }
    let half = (1 << question.sub_pixel()) / 2;
    let (at, several) = (question.sample([0, 0]), question.profile.multisample.is_some());
    match channel.at {
        EvaluatedAt::Sample => true,
        EvaluatedAt::Centroid => several || at == [half; 2],
        EvaluatedAt::Centre => !several && at == [half; 2],
        EvaluatedAt::Corner => !several && at == [0; 2],
    }
}

/// Whether pixels are drawn that the triangle only touches.
fn touches(question: &Question) -> bool {
    question.profile.conservative().is_some_and(|config| config.mode == ConservativeMode::Outer)
}

/// Why a channel is not always inside its triangle, and what would help.
pub(super) fn outside(question: &Question) -> &'static str {
    if touches(question) {
        "pixels that the triangle only touches are drawn, too, and there the channel is evaluated outside its \
         triangle, without a limit; mode = \"inner\" is inside"
    } else {
        "the channel is evaluated outside its triangle, without a limit; at = \"sample\" is not"
    }
}

pub(super) fn codes(channel: &AttributeConfig) -> String {
    let (low, high) = channel.range();
    format!("channel {} (codes {low} to {high})", channel.name)
}

/// What every bound takes for granted.
pub(super) fn granted(question: &Question) -> String {
    let mut text = "Taken for granted: the exact triangle covers the place of the value".to_owned();
    if !question.profile.form.covers_exactly(&question.profile.state()) {
        text += ", which this machine does not promise for each sample that it draws";
    }
    text + "; the exact value is that of the codes of the vertices"
}

pub(super) fn with_own_bits(error: &Rational) -> String {
    format!(
        " With the bits of the profile a code differs from the exact value by at most {} ULP.",
        about(error)
    )
}

/// A fraction, and the same in decimals, rounded up.
pub(super) fn about(value: &Rational) -> String {
    if value.is_integer() { value.to_string() } else { format!("{value} = {}", decimal_up(value)) }
}

fn flat(question: &Question, channel: &AttributeConfig) -> Proof {
    Proof {
        claim: format!("channel.{}.interpolation", channel.name),
        row: None,
        unit: None,
        place: question.place(),
        statement: format!(
            "{} is flat: each code is that of a vertex, and it is exact. It needs no interpolation bits.",
            codes(channel)
        ),
        error: Some("0".to_owned()),
        bits: Some(0),
        given: None,
        sufficient: true,
        bound: "0 = 0".to_owned(),
        clause: "CH-3",
        witness: None,
        formal: Formal::default(),
    }
}

/// The words of an affine channel as those of depth.
fn as_depth(question: &Question, channel: &AttributeConfig) -> Option<Question> {
    let depth = DepthConfig {
        guard: channel.guard,
        integer: channel.integer,
        interpolation: channel.interpolation,
        rounding: channel.rounding,
        division: channel.division,
        clamp: channel.clamp,
        start_bias: channel.start_bias,
        format: None,
        bias: None,
    };
    let mut question = question.without_channels();
    let profile = &mut question.profile;
    (profile.depth, profile.multisample) = (Some(depth), None);
    profile.validate().is_ok().then_some(question)
}

fn affine(question: &Question, channel: &AttributeConfig) -> Vec<Proof> {
    let value = CarriedValue::component(question, channel, None);
    let inside = is_inside(question, channel);
    let planes = question.profile.form.walks_a_plane();
    let mut proofs: Vec<Proof> = match as_depth(question, channel).filter(|_| inside && planes) {
        Some(asked) => {
            let subject = Subject {
                topic: value.topic.clone(),
                noun: codes(channel),
                // The codes of depth start at 0, and it is taken at one sample of a pixel.
                drawn: !channel.signed && question.profile.multisample.is_none(),
            };
            let mut proofs = plane::proofs(&asked, &subject);
            proofs.extend(guard::proof(&asked, &subject));
            proofs.into_iter().map(of_codes).collect()
        }
        None => [Some(carried_affine(question, channel, &value)), value.guard_proof(inside)]
            .into_iter()
            .flatten()
            .collect(),
    };
    // The floor of the read-out, of a value that is in range.
    let floor = match channel.start_bias {
        StartBias::Half if channel.interpolation > 0 => dyadic(1, 1),
        _ => integer(1),
    };
    let error =
        value.own_error().filter(|_| inside && value.never_wraps()).map(|error| error + floor);
    let first = &mut proofs[0];
    match &error {
        Some(error) => first.statement += &with_own_bits(error),
        None => first.statement += " No bound of the codes is proved, see the claim on guard bits.",
    }
    let _ = write!(first.statement, " {}.", granted(question));
    first.error = error.map(|error| error.to_string());
    proofs
}

/// A proof on depth of the same words, as one on codes.
fn of_codes(mut proof: Proof) -> Proof {
    if let Some(witness) = &mut proof.witness {
        witness.codes = witness.depths.take();
        for text in [&mut witness.expected, &mut witness.got] {
            if let Some(rest) = text.strip_prefix("depth") {
                *text = format!("code{rest}");
            }
        }
    }
    proof
}

/// Of a machine with an error of its own, or at a place outside the triangle.
fn carried_affine(question: &Question, channel: &AttributeConfig, value: &CarriedValue) -> Proof {
    let refusal = (!is_inside(question, channel))
        .then(|| format!("Nothing is proved: {}.", outside(question)));
    value.interpolation_proof(&codes(channel), Goal::Half, refusal.as_deref())
}

fn coordinates(question: &Question, channel: &AttributeConfig, given: u32) -> Proof {
    let Correction::Barycentric { rounding, .. } = channel.correction else {
        unreachable!("a channel of coordinates")
    };
    let (low, high) = channel.range();
    let inside = is_inside(question, channel);
    // Two differences of codes, each with a coordinate that is rounded once.
    let error = |bits: u32| dyadic(2 * (high - low), bits + u32::from(rounding.is_nearest()));
    let half = dyadic(1, 1);
    let bits = (0..=MOST).find(|bits| inside && error(*bits) < half);
    let own = (inside).then(|| error(given) + integer(1));
    let mut statement = match bits {
        Some(bits) => format!(
            "{} of a coordinate keep the error of {} below half an ULP before its floor, for every code of 1/w from 1 \
             on: the differences of two codes from the third, each times a coordinate that is rounded {rounding}.",
            count(bits),
            codes(channel)
        ),
        None => format!(
            "No number of bits of a coordinate is enough for {}: {}.",
            codes(channel),
            outside(question)
        ),
    };
    if let Some(own) = &own {
        statement += &with_own_bits(own);
    }
    let _ = write!(statement, " {}.", granted(question));
    let inequality = |bits: u32| {
        let relation = if error(bits) < half { "<" } else { ">=" };
        format!(
            "2 x {} x 2^-{} = {} {relation} 1/2",
            high - low,
            bits + u32::from(rounding.is_nearest()),
            error(bits)
        )
    };
    Proof {
        claim: format!("channel.{}.coordinate", channel.name),
        row: None,
        unit: None,
        place: question.place(),
        statement,
        error: own.map(|own| own.to_string()),
        bits,
        given: Some(given),
        sufficient: bits.is_some_and(|bits| given >= bits),
        bound: bits.map_or("not inside".to_owned(), |bits| match bits.checked_sub(1) {
            Some(fewer) => format!("{}; with {fewer}: {}", inequality(bits), inequality(fewer)),
            None => inequality(bits),
        }),
        clause: "CH-22",
        witness: None,
        formal: Formal {
            smt: bits.map(|bits| coordinate_obligation(high - low, rounding.is_nearest(), bits)),
            gappa: None,
        },
    }
}
