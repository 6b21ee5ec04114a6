//! Steppers and error words that are one decision away: for the diagnosis.

use crate::bits::Rounding;
use crate::cover::{ErrorWord, Looks, OwnErrors, SharedError, SlopeSteps, Stepper, Sum, Test};
use crate::machine::near;
use std::fmt::Display;

/// A part with one field changed.
#[derive(Debug)]
pub(super) struct Change<T> {
    pub(super) field: String,
    pub(super) got: String,
    pub(super) was: String,
    pub(super) part: T,
}

impl<T> Change<T> {
    fn new(field: &str, got: &dyn Display, was: &dyn Display, part: T) -> Self {
        Self { field: field.to_owned(), got: got.to_string(), was: was.to_string(), part }
    }

    /// The same with its place before the field.
    pub(super) fn of(self, place: &str) -> Self {
        Self { field: format!("{place}.{}", self.field), ..self }
    }

    /// The change of a part as one of the whole.
    fn within<U>(self, place: &str, whole: impl FnOnce(T) -> U) -> Change<U> {
        self.of(place).map(whole)
    }

    /// The same change of what holds the part.
    fn map<U>(self, whole: impl FnOnce(T) -> U) -> Change<U> {
        let Self { field, got, was, part } = self;
        Change { field, got, was, part: whole(part) }
    }
}

fn quoted(text: &dyn Display) -> String {
    format!("{:?}", text.to_string())
}

fn test_change(field: &str, was: &Test) -> Change<Test> {
    let other = was.other();
    Change::new(field, &quoted(&other), &quoted(was), other)
}

fn sum_changes(field: &str, was: &Sum) -> impl Iterator<Item = Change<Sum>> {
    [-1, 1]
        .map(|by| was.plus(by))
        .map(|sum| Change::new(field, &quoted(&sum), &quoted(was), sum))
        .into_iter()
}

fn bits_changes(was: Option<u32>) -> Vec<Change<Option<u32>>> {
    let Some(bits) = was else { return Vec::new() };
    near(bits).map(|other| Change::new("bits", &other, &bits, Some(other))).collect()
}

/// Error words one decision away.
pub(super) fn word_changes(word: &ErrorWord) -> Vec<Change<ErrorWord>> {
    let mut changes =
        vec![test_change("when", &word.when).map(|when| ErrorWord { when, ..word.clone() })];
    for change in sum_changes("start", &word.start) {
        changes.push(change.map(|start| ErrorWord { start, ..word.clone() }));
    }
    for change in bits_changes(word.bits) {
        changes.push(change.map(|bits| ErrorWord { bits, ..word.clone() }));
    }
    changes
}

fn shared_changes(shared: &SharedError) -> Vec<Change<SharedError>> {
    let with = |change: &dyn Fn(&mut SharedError)| {
        let mut other = shared.clone();
        change(&mut other);
        other
    };
    let mut changes = vec![
        test_change("x.when", &shared.x.when).map(|when| with(&|s| s.x.when = when.clone())),
        test_change("y.when", &shared.y.when).map(|when| with(&|s| s.y.when = when.clone())),
    ];
    for change in sum_changes("start", &shared.start) {
        changes.push(change.map(|start| with(&|s| s.start = start.clone())));
    }
    for change in bits_changes(shared.bits) {
        changes.push(change.map(|bits| with(&|s| s.bits = bits)));
    }
    let all =
        [(Looks::Together, "together"), (Looks::XFirst, "x-first"), (Looks::YFirst, "y-first")];
    let was = all.iter().find(|(looks, _)| *looks == shared.looks).map_or("", |looks| looks.1);
    for (looks, got) in all {
        changes.push(Change::new("looks", &got, &was, with(&|s| s.looks = looks)));
    }
    changes
}

fn own_changes(own: &OwnErrors) -> Vec<Change<OwnErrors>> {
    let x = word_changes(&own.x).into_iter().map(|change| change.of("x"));
    let y = word_changes(&own.y).into_iter().map(|change| change.of("y"));
    let x = x.map(|change| change.map(|x| OwnErrors { x, ..own.clone() }));
    let y = y.map(|change| change.map(|y| OwnErrors { y, ..own.clone() }));
    x.chain(y).collect()
}

fn slope_changes(slope: SlopeSteps) -> Vec<Change<SlopeSteps>> {
    let mut changes = Vec::new();
    for rounding in Rounding::ALL {
        let other = SlopeSteps { rounding, ..slope };
        changes.push(Change::new("rounding", &rounding, &slope.rounding, other));
    }
    let half = 1i64 << slope.fraction >> 1;
    for bias in [0, half - 1, half] {
        let [x, y] = [SlopeSteps { x_bias: bias, ..slope }, SlopeSteps { y_bias: bias, ..slope }];
        changes.push(Change::new("x-bias", &bias, &slope.x_bias, x));
        changes.push(Change::new("y-bias", &bias, &slope.y_bias, y));
    }
    changes
}

/// Steppers one decision away.
pub(super) fn stepper_changes(stepper: &Stepper) -> Vec<Change<Stepper>> {
    match stepper {
        Stepper::Major(word) => {
            let changes = word_changes(word).into_iter();
            changes
                .map(|change| change.within("major", |word| Stepper::Major(Box::new(word))))
                .collect()
        }
        Stepper::Shared(shared) => {
            let changes = shared_changes(shared).into_iter();
            changes
                .map(|change| change.within("shared", |s| Stepper::Shared(Box::new(s))))
                .collect()
        }
        Stepper::Own(own) => {
            let changes = own_changes(own).into_iter();
            changes.map(|change| change.within("own", |own| Stepper::Own(Box::new(own)))).collect()
        }
        Stepper::Slope(slope) => {
            let changes = slope_changes(*slope).into_iter();
            changes.map(|change| change.within("slope", Stepper::Slope)).collect()
        }
    }
}
