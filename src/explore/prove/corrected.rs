//! Bits of channels that are divided by 1/w at each sample. Spec clauses `CH-22` and `CH-23`.

use super::Proof;
use super::carried::CarriedValue;
use super::channel::{MOST, about, codes, granted, is_inside, outside, with_own_bits};
use super::channel_formal::{Division, obligation, script};
use super::correction::{Incoming, Stages, TRIED, UnitError, last_rounding};
use super::domain::Question;
use super::formal::Formal;
use super::text::bits as count;
use crate::exact::{Rational, dyadic, integer};
use crate::value::{AttributeConfig, Correction, InverseWConfig};
use num_traits::Signed;
use std::fmt::Write as _;

/// A channel that is divided at each sample.
pub(super) struct Corrected<'a> {
    question: &'a Question,
    channel: &'a AttributeConfig,
    pub(super) over: CarriedValue<'a>,
    inverse: CarriedValue<'a>,
    stages: Stages,
    pub(super) inside: bool,
    /// Why no bits are enough, whatever their number.
    hopeless: Option<String>,
}

impl<'a> Corrected<'a> {
    pub(super) fn new(
        question: &'a Question,
        channel: &'a AttributeConfig,
        w: &InverseWConfig,
    ) -> Self {
        let (low, high) = channel.range();
        let unit = match &channel.correction {
            Correction::Reciprocal { unit, .. } => unit.unit().ok(),
            _ => None,
        };
        let inside = is_inside(question, channel);
        let error = unit.as_ref().map(UnitError::of);
        let least = question.least_w(w.integer);
        let stages = Stages {
            top: integer(high.max(-low)),
            bits: w.integer,
            least,
            rounding: last_rounding(&channel.correction).unwrap_or(channel.rounding),
            unit: error.flatten(),
        };
        let over = CarriedValue::component(question, channel, Some(w.integer));
        let hopeless = if matches!(channel.correction, Correction::ConstantW { .. }) {
            Some(
                "constant-w divides by the 1/w of another sample: its error is that of a changed w, and more \
                 bits do not make it smaller; use quotient or reciprocal"
                    .to_owned(),
            )
        } else if !inside {
            Some(outside(question).to_owned())
        } else if let Some(unit) = unit.filter(|_| stages.unit.is_none()) {
            Some(format!(
                "the error of a reciprocal unit is found by trying every operand, and operand = {} > {TRIED} \
                 bits; use {TRIED} bits or fewer",
                unit.config().operand
            ))
        } else if over.own_error().is_none() {
            Some("the machine states no error of the values that it carries".to_owned())
        } else {
            None
        };
        let inverse = CarriedValue::inverse(question, w, least);
        Self { question, channel, over, inverse, stages, inside, hopeless }
    }

    /// What comes in with such fraction bits of u/w and of 1/w.
    fn incoming(&self, [over, inverse]: [u32; 2]) -> Option<Incoming> {
        let unit = self.stages.unit_error(inverse);
        Some(Incoming { p: self.over.error(over)?, q: self.inverse.error(inverse)?, unit })
    }

    fn value_error(&self, fractions: [u32; 2]) -> Option<Rational> {
        self.stages.value_error(&self.incoming(fractions)?)
    }

    fn holds(&self, fractions: [u32; 2]) -> bool {
        self.hopeless.is_none()
            && self.value_error(fractions).is_some_and(|error| error < dyadic(1, 1))
    }

    fn own(&self) -> [u32; 2] {
        [self.over.fraction, self.inverse.fraction]
    }

    /// The bound of a code with the bits of the profile.
    fn code_error(&self) -> Option<Rational> {
        let sound =
            self.hopeless.is_none() && self.over.never_wraps() && self.inverse.never_wraps();
        Some(self.value_error(self.own()).filter(|_| sound)? + self.stages.last())
    }

    /// Why no bits of u/w are enough with this 1/w, and what to do.
    fn why(&self) -> String {
        if let Some(why) = &self.hopeless {
            return why.clone();
        }
        let half = dyadic(1, 1);
        let [_, w] = self.own();
        let q = self.inverse.own_error().unwrap_or_default();
        let least = self.stages.least;
        let room = self.stages.room(&q);
        let what = if room.is_positive() {
            let limit = self.value_error([MOST, w]).unwrap_or_default();
            format!("even with {MOST} bits the value is off by {} >= 1/2", about(&limit))
        } else {
            format!(
                "1/w comes within its error of 0: its smallest code is {least} <= {} = its error",
                about(&q)
            )
        };
        let cure = (0..=MOST).find(|w| self.holds([MOST, *w]));
        let advice = if let Some(w) = cure {
            let over = (0..=MOST).find(|over| self.holds([*over, w])).unwrap_or(MOST);
            format!("give [w] interpolation = {w} bits and the channel {over}, or a lower w ratio")
        } else {
            let unit = &self.stages.top * self.stages.unit_error(MOST);
            if unit >= half {
                format!(
                    "the reciprocal unit alone makes {} >= 1/2: its relative error must be below 1/{}, so give \
                     its table \
                     or its last step more bits",
                    about(&unit),
                    &self.stages.top * integer(2)
                )
            } else {
                "more bits of 1/w do not help; lower the w ratio, or make the machine's own words finer".to_owned()
            }
        };
        format!("{what}; {advice}")
    }

    fn inequality(&self, fractions: [u32; 2]) -> String {
        let Some(incoming) = self.incoming(fractions) else {
            return "no error is stated".to_owned();
        };
        match self.stages.value_error(&incoming) {
            Some(error) => {
                let relation = if error < dyadic(1, 1) { "<" } else { ">=" };
                format!("{} = {} {relation} 1/2", self.stages.text(&incoming), about(&error))
            }
            None => format!("{} <= {}", self.stages.least, incoming.q),
        }
    }

    /// The stages with the bits of the profile, in words.
    fn stages(&self) -> String {
        let [over, inverse] = self.own();
        let errors = self.incoming([over, inverse]);
        let of = |pick: &dyn Fn(&Incoming) -> String| errors.as_ref().map_or("?".to_owned(), pick);
        let mut text = format!(
            "u/w is {} to {over} bits, off by at most {} ULP; 1/w is {} to {inverse} bits, off by at most {} of \
             its codes, \
             which are {} to {}",
            self.over.walk(),
            of(&|errors| errors.p.to_string()),
            self.inverse.walk(),
            of(&|errors| errors.q.to_string()),
            self.stages.least,
            (1i128 << self.stages.bits) - 1
        );
        if self.stages.unit.is_some() {
            let _ = write!(
                text,
                "; the reciprocal is off by at most {} of itself",
                of(&|errors| about(&errors.unit))
            );
        }
        format!(
            "{text}; the last rounding is {}, at most {} ULP",
            self.stages.rounding,
            self.stages.last()
        )
    }

    fn conclusion(&self) -> String {
        let own = match self.code_error() {
            Some(error) => with_own_bits(&error),
            None if self.hopeless.is_some() => String::new(),
            None => " With the bits of the profile no bound of the codes is proved.".to_owned(),
        };
        format!(
            "{own} Stages: {}. {}; no accumulator wraps, as the claims on guard bits say; the largest w of a \
             triangle is at \
             most {} times its smallest, and codes of 1/w are those of `CH-4`.",
            self.stages(),
            granted(self.question),
            self.question.w_ratio
        )
    }

    fn division(&self, [over, inverse]: [u32; 2]) -> Option<Division> {
        let (low, high) = self.channel.range();
        Some(Division {
            codes: [low, high],
            least: self.stages.least,
            bits: self.stages.bits,
            fractions: [over, inverse],
            roundings: [self.over.rounding, self.inverse.rounding],
            last: self.stages.rounding,
            window: self.question.size(),
            planes: self.over.is_walked() && self.inverse.is_walked(),
            errors: self.incoming([over, inverse])?,
        })
    }

    pub(super) fn proof(&self) -> Proof {
        let [over, inverse] = self.own();
        let bits = (0..=MOST).find(|over| self.holds([*over, inverse]));
        let code = self.code_error();
        let mut statement = match bits {
            Some(bits) => format!(
                "{} of interpolation keep {} within half an ULP before its last rounding, at every covered \
                 sample of the \
                 window, with {inverse} bits below the point of 1/w.",
                count(bits),
                codes(self.channel)
            ),
            None => format!(
                "No number of interpolation bits is enough for {}: {}.",
                codes(self.channel),
                self.why()
            ),
        };
        statement += &self.conclusion();
        Proof {
            claim: format!("{}.interpolation", self.over.topic),
            row: None,
            unit: None,
            place: self.question.place(),
            statement,
            bits,
            given: Some(over),
            sufficient: self.holds([over, inverse]),
            bound: match bits {
                Some(0) => self.inequality([0, inverse]),
                Some(bits) => {
                    let fewer = self.inequality([bits - 1, inverse]);
                    format!("{}; with {}: {fewer}", self.inequality([bits, inverse]), bits - 1)
                }
                None => self.inequality([over, inverse]),
            },
            clause: "CH-22",
            witness: None,
            formal: Formal {
                smt: bits.and_then(|bits| Some(obligation(&self.division([bits, inverse])?))),
                gappa: code.as_ref().and_then(|code| script(&self.division(self.own())?, code)),
            },
            error: code.map(|code| code.to_string()),
        }
    }
}

/// The bits of 1/w that all channels together need, and its guard bits.
pub(super) fn of_w(
    question: &Question,
    channels: &[AttributeConfig],
    w: &InverseWConfig,
) -> Vec<Proof> {
    let divided: Vec<Corrected> = channels
        .iter()
        .filter(|channel| channel.correction.walks_w())
        .map(|channel| Corrected::new(question, channel, w))
        .collect();
    let Some(first) = divided.first() else { return Vec::new() };
    let fewest =
        |one: &Corrected| (0..=MOST).find(|inverse| one.holds([one.over.fraction, *inverse]));
    let needs: Vec<Option<u32>> = divided.iter().map(fewest).collect();
    // A channel that no bits help does not say how many the others need.
    let helped: Vec<(u32, &Corrected)> =
        needs.iter().zip(&divided).filter_map(|(bits, one)| Some(((*bits)?, one))).collect();
    let most = helped.iter().max_by_key(|(bits, _)| *bits);
    let unhelped: Vec<&str> = needs
        .iter()
        .zip(&divided)
        .filter(|(bits, _)| bits.is_none())
        .map(|(_, one)| &*one.channel.name)
        .collect();
    let mut statement = match most {
        Some((bits, one)) => format!(
            "{} below the point of 1/w are enough for the channels that are divided by it; channel {} needs them.",
            count(*bits),
            one.channel.name
        ),
        None => "No number of bits below the point of 1/w is enough.".to_owned(),
    };
    if !unhelped.is_empty() {
        let _ = write!(
            statement,
            " With the interpolation bits of the profile, no number of bits of 1/w is enough for: {}; see the \
             claims of \
             these channels.",
            unhelped.join(", ")
        );
    }
    let bits = most.map(|(bits, _)| *bits).filter(|_| unhelped.is_empty());
    let bound = match most {
        Some((bits, one)) => one.inequality([one.over.fraction, *bits]),
        None => first.inequality(first.own()),
    };
    let inside = divided.iter().all(|one| one.inside);
    let proof = Proof {
        claim: "w.interpolation".to_owned(),
        row: None,
        unit: None,
        place: question.place(),
        statement,
        error: None,
        bits,
        given: Some(w.interpolation),
        sufficient: bits.is_some_and(|bits| w.interpolation >= bits),
        bound,
        clause: "CH-22",
        witness: None,
        formal: Formal {
            smt: bits.zip(most).and_then(|(bits, (_, one))| {
                Some(obligation(&one.division([one.over.fraction, bits])?))
            }),
            gappa: None,
        },
    };
    let guard = first.inverse.guard_proof(inside);
    [Some(proof), guard].into_iter().flatten().collect()
}
