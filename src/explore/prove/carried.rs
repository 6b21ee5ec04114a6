//! A value of a channel, or 1/w, that a machine carries over the window: its range, its error, its guard bits.
//! Spec clause `CH-22`.

use super::Proof;
use super::domain::Question;
use super::formal::Formal;
use super::guard::{self, Reach};
use super::trial::scaled;
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use crate::format::{Clamp, ReadOut};
use crate::machine::EveryLinear;
use crate::setup::Division;
use crate::value::{AttributeConfig, InverseWConfig};
use num_traits::Zero;
use std::fmt::Write as _;

/// A linear value, and the words that carry it.
pub(super) struct CarriedValue<'a> {
    pub(super) question: &'a Question,
    /// The first part of the claims' names.
    pub(super) topic: String,
    /// What it can be inside a triangle, in ULP.
    pub(super) values: [Rational; 2],
    pub(super) integer: u32,
    pub(super) fraction: u32,
    pub(super) rounding: Rounding,
    guard: u32,
    clamp: Clamp,
    /// What is added before the read-out, in ULP: of signed codes.
    offset: i128,
    /// What the start gains, in units.
    gain: i128,
    /// What a shared reciprocal in set-up adds to the error, in ULP.
    shared: Rational,
}

impl<'a> CarriedValue<'a> {
    /// The codes of an affine channel, or u q / 2^B with every code of 1/w up to `most`, `inverse` = B bits.
    pub(super) fn component(
        question: &'a Question,
        channel: &AttributeConfig,
        inverse: Option<u32>,
    ) -> Self {
        let (low, high) = channel.range();
        let values = [low, high].map(|code| match inverse {
            // The largest code of 1/w keeps the sign and makes the most of it.
            Some(bits) => integer(code) * dyadic((1 << bits) - 1, bits),
            None => integer(code),
        });
        let shared = match channel.division {
            Division::Quotient => Rational::zero(),
            // As `B-6`: a covered sample is at most the whole range away from the anchor.
            Division::Reciprocal { bits } => dyadic(high - low, bits),
        };
        Self {
            question,
            topic: format!("channel.{}", channel.name),
            values,
            integer: channel.integer,
            fraction: channel.interpolation,
            rounding: channel.rounding,
            guard: channel.guard,
            clamp: channel.clamp,
            offset: channel.offset(),
            gain: channel.start_gain(),
            shared,
        }
    }

    /// The codes of 1/w, from `least` on.
    pub(super) fn inverse(question: &'a Question, w: &InverseWConfig, least: i128) -> Self {
        Self {
            question,
            topic: "w".to_owned(),
            values: [integer(least), integer((1 << w.integer) - 1)],
            integer: w.integer,
            fraction: w.interpolation,
            rounding: w.rounding,
            guard: w.guard,
            clamp: w.clamp,
            offset: 0,
            gain: 0,
            shared: Rational::zero(),
        }
    }

    /// The largest error of an accumulator of `fraction` bits, in ULP; none where the machine states none.
    pub(super) fn error(&self, fraction: u32) -> Option<Rational> {
        let question = self.question;
        let rise = &self.values[1] - &self.values[0];
        let [low, high] = question.vertices;
        let span = (high[0] - low[0]).max(high[1] - low[1]);
        let steepest = &rise * scaled(span, question.sub_pixel());
        let (window, rounding) = (question.size(), self.rounding);
        let every = EveryLinear { window, rise, steepest, rounding, fraction };
        Some(question.profile.form.window_bound(&every)? + &self.shared)
    }

    /// The error with the bits that the profile has.
    pub(super) fn own_error(&self) -> Option<Rational> {
        self.error(self.fraction)
    }

    /// Whether the value is a plane that is walked from pixel (0, 0), with exact division.
    pub(super) fn is_walked(&self) -> bool {
        self.question.profile.form.walks_a_plane() && self.shared.is_zero()
    }

    /// How it is carried, in words.
    pub(super) fn walk(&self) -> String {
        let [w, h] = self.question.size();
        let form = &self.question.profile.form;
        if form.walks_a_plane() {
            format!("a start and {} steps, each rounded {}", w + h - 2, self.rounding)
        } else {
            format!("as the machine {} carries it, rounded {}", form.name(), self.rounding)
        }
    }

    fn read_out(&self, guard: u32) -> Option<ReadOut> {
        ReadOut::new(guard, self.integer, self.fraction, self.clamp).ok()
    }

    fn reach(&self) -> Option<Reach> {
        let offset = integer(self.offset);
        let values = self.values.clone().map(|value| value + &offset);
        let nearest = self.rounding.is_nearest() || !self.is_walked();
        Reach::of(values, &self.own_error()?, nearest, self.gain, self.fraction)
    }

    /// The fewest guard bits that keep covered samples in range.
    fn fewest_guard(&self) -> Option<u32> {
        self.reach()?.fewest(|guard| self.read_out(guard))
    }

    /// Whether no accumulator of a covered sample wraps.
    pub(super) fn never_wraps(&self) -> bool {
        self.fewest_guard().is_some_and(|bits| bits <= self.guard)
    }

    /// The claim on guard bits; none where the machine states no error. `inside` says that values are taken in
    /// their triangle.
    pub(super) fn guard_proof(&self, inside: bool) -> Option<Proof> {
        let reach = self.reach()?;
        let bits = self.fewest_guard().filter(|_| inside);
        let range = |bits: u32| self.read_out(bits).map(ReadOut::range).unwrap_or_default();
        let sum = reach.text(self.fraction);
        let mut statement = if inside {
            guard::statement(bits, self.clamp)
        } else {
            "No number of guard bits keeps the accumulator in range: the value is also taken outside its \
             triangle."
                .to_owned()
        };
        if let Some(bits) = bits {
            let _ = write!(
                statement,
                " The word needs {bits} guard + {} integer + {} interpolation = {} bits.",
                self.integer,
                self.fraction,
                bits + self.integer + self.fraction
            );
        }
        Some(Proof {
            claim: format!("{}.guard", self.topic),
            row: None,
            place: self.question.place(),
            statement,
            error: None,
            bits,
            given: Some(self.guard),
            sufficient: bits.is_some_and(|bits| self.guard >= bits),
            bound: match bits.map(range) {
                Some((low, limit)) => format!("{sum}, within [{low}, {limit})"),
                None => sum,
            },
            clause: "CH-22",
            witness: None,
            formal: Formal {
                smt: bits.map(|bits| reach.obligation(bits, None, self.fraction, range)),
                gappa: None,
            },
        })
    }
}
