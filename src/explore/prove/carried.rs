//! A value of a channel, 1/w, or depth that is no plane, which a machine carries over the window: its range, its error,
//! its bits. Spec clauses `B-5` and `CH-22`.

use super::Proof;
use super::channel::MOST;
use super::domain::Question;
use super::formal::Formal;
use super::guard::{self, Reach};
use super::plane::{Goal, Growth};
use super::plane_witness::start_bias;
use super::text::bits as count;
use super::trial::scaled;
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use crate::format::{Clamp, ReadOut};
use crate::machine::EveryLinear;
use crate::setup::Division;
use crate::value::{AttributeConfig, DepthConfig, InverseWConfig};
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
    /// The clauses of the claims on interpolation bits and on guard bits.
    clauses: [&'static str; 2],
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
            clauses: ["CH-22"; 2],
        }
    }

    /// Depth of a machine that makes it by its own means.
    pub(super) fn depth(question: &'a Question, depth: &DepthConfig) -> Self {
        Self {
            question,
            topic: "depth".to_owned(),
            values: [integer(0), integer((1 << depth.integer) - 1)],
            integer: depth.integer,
            fraction: depth.interpolation,
            rounding: depth.rounding,
            guard: depth.guard,
            clamp: depth.clamp,
            offset: 0,
            gain: start_bias(depth, depth.interpolation),
            shared: Growth::new(question, depth).division,
            clauses: ["B-5", "B-7"],
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
            clauses: ["CH-22"; 2],
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
        let vertices = question.vertices.map(|end| question.to_model(end));
        let sub_pixel = question.sub_pixel();
        let every = EveryLinear { window, vertices, sub_pixel, rise, steepest, rounding, fraction };
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
        // A sticky accumulator depends on its path, and has no range to stay in.
        let sticky = self.clamp == Clamp::Saturate;
        self.reach().filter(|_| !sticky)?.fewest(|guard| self.read_out(guard))
    }

    /// The claim on interpolation bits. `refusal` is a sentence on why no number is enough.
    pub(super) fn interpolation_proof(
        &self,
        noun: &str,
        goal: Goal,
        refusal: Option<&str>,
    ) -> Proof {
        let enough = |bits: &u32| self.error(*bits).is_some_and(|error| error < goal.ulp());
        let bits = (0..=MOST).find(|bits| refusal.is_none() && enough(bits));
        let mut statement = match bits {
            Some(bits) => format!(
                "{} of interpolation keep the error of {noun} below {}: {}.",
                count(bits),
                goal.name(),
                self.walk()
            ),
            None => format!(
                "No number of interpolation bits is proved to keep the error of {noun} below {}: {}.",
                goal.name(),
                self.walk()
            ),
        };
        if let Some(refusal) = refusal {
            let _ = write!(statement, " {refusal}");
        }
        Proof {
            claim: match goal {
                Goal::Half => format!("{}.interpolation", self.topic),
                Goal::One => format!("{}.interpolation-one", self.topic),
            },
            row: None,
            unit: None,
            place: self.question.place(),
            statement,
            error: None,
            bits,
            given: Some(self.fraction),
            sufficient: bits.is_some_and(|bits| self.fraction >= bits),
            bound: match (refusal, self.error(bits.unwrap_or(MOST))) {
                (Some(refusal), _) => refusal.trim_end_matches('.').to_owned(),
                (_, Some(error)) if bits.is_some() => format!("{error} < {}", goal.ulp()),
                (_, Some(error)) => format!("{error} >= {} with {MOST} bits", goal.ulp()),
                (_, None) => {
                    let kind = self.question.profile.form.kind();
                    format!("{} states no bound for these words ({})", kind.name, kind.clause)
                }
            },
            clause: self.clauses[0],
            witness: None,
            formal: Formal::default(),
        }
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
            unit: None,
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
            clause: self.clauses[1],
            witness: None,
            formal: Formal {
                smt: bits.map(|bits| reach.obligation(bits, None, self.fraction, range)),
                gappa: None,
            },
        })
    }
}
