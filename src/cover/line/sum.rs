//! Sums and tests of a line's measures, as a profile writes them. Spec clause `RL-2`.

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// The names, in the order of [`Measures`].
const NAMES: [&str; 9] = ["n", "m", "w", "h", "left", "up", "back", "max", "e"];
/// Where the greatest length stands.
const MAX: usize = 7;
/// Where the error word stands.
const ERROR: usize = 8;
/// The most terms of a sum.
const TERMS: usize = 8;
/// The largest factor and divisor.
const LARGEST: i128 = 1 << 16;

/// What a line measures, by the names of a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measures([i128; 9]);

impl Measures {
    /// Those of a line from one end to the other; `max` is the greatest length of several lines.
    pub fn of([from, to]: [[i128; 2]; 2], max: i128) -> Self {
        let d = [to[0] - from[0], to[1] - from[1]];
        let [w, h] = d.map(i128::abs);
        let negative = d.map(|d| i128::from(d < 0));
        let back = negative[usize::from(h > w)];
        Self([w.max(h), w.min(h), w, h, negative[0], negative[1], back, max, 0])
    }

    /// The longer of both differences: how many steps the line has.
    pub const fn length(&self) -> i128 {
        self.0[0]
    }

    /// The same measures, and an error word.
    const fn with(mut self, error: i128) -> Self {
        self.0[ERROR] = error;
        self
    }
}

/// A part of a sum: a count of a measure, divided; or a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Term {
    negative: bool,
    factor: i128,
    measure: Option<usize>,
    divisor: i128,
}

/// A sum of measures, such as `2m - n`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[cfg_attr(feature = "verification", schemars(with = "String"))]
#[serde(try_from = "String", into = "String")]
pub struct Sum(Vec<Term>);

/// How the two sides of a test compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    Above,
    AtLeast,
    Below,
    AtMost,
}

/// A comparison of two sums, such as `2e >= -h`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[cfg_attr(feature = "verification", schemars(with = "String"))]
#[serde(try_from = "String", into = "String")]
pub struct Test {
    left: Sum,
    relation: Relation,
    right: Sum,
}

/// A sum or a test that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SumError {
    /// A part that is no term.
    #[error(
        "{0:?} is not a sum; a sum has 1 to 8 terms with + or - between them, such as \"2m - n\" or \
         \"n/2 - 1\"; a term is a number, or a name with a factor before it or a divisor behind it, both 1 to \
         65536; the names are n, m, w, h, left, up, back, max and e"
    )]
    Sum(String),
    /// A text without a comparison.
    #[error(
        "{0:?} is not a test; a test is two sums with >, >=, < or <= between them, such as \"e > 0\""
    )]
    Test(String),
}

impl Term {
    fn parse(text: &str, negative: bool) -> Option<Self> {
        let (head, divisor) = match text.split_once('/') {
            None => (text, 1),
            Some((head, divisor)) => (head.trim_end(), number(divisor.trim_start())?),
        };
        let digits = head.len() - head.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (factor, name) = head.split_at(digits);
        let name = name.trim_start();
        let measure = match name {
            "" => None,
            name => Some(NAMES.iter().position(|known| *known == name)?),
        };
        let factor = match factor {
            "" if measure.is_some() => 1,
            factor => number(factor)?,
        };
        // Only a number may be zero: "0" is a sum.
        let good = divisor > 0 && (factor > 0 || measure.is_none());
        good.then_some(Self { negative, factor, measure, divisor })
    }

    /// The magnitude is divided and floored, then the sign is applied, as a shifter before an adder does.
    fn value(self, measures: &Measures) -> i128 {
        let measure = self.measure.map_or(1, |at| measures.0[at]);
        let magnitude = (self.factor * measure).div_euclid(self.divisor);
        if self.negative { -magnitude } else { magnitude }
    }
}

/// A factor or a divisor.
fn number(text: &str) -> Option<i128> {
    let digits = !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    text.parse().ok().filter(|value| digits && *value <= LARGEST)
}

impl FromStr for Sum {
    type Err = SumError;

    fn from_str(text: &str) -> Result<Self, SumError> {
        let fault = || SumError::Sum(text.chars().take(40).collect());
        let mut terms = Vec::new();
        let (mut rest, mut first) = (text.trim(), true);
        while first || !rest.is_empty() {
            let negative = rest.starts_with('-');
            let signed = negative || rest.starts_with('+');
            if !signed && !first {
                return Err(fault());
            }
            let body = if signed { rest[1..].trim_start() } else { rest };
            let end = body.find(['+', '-']).unwrap_or(body.len());
            terms.push(Term::parse(body[..end].trim_end(), negative).ok_or_else(fault)?);
            (rest, first) = (&body[end..], false);
        }
        if terms.len() <= TERMS { Ok(Self(terms)) } else { Err(fault()) }
    }
}

impl fmt::Display for Sum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, term) in self.0.iter().enumerate() {
            f.write_str(match (n, term.negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            })?;
            match term.measure {
                None => write!(f, "{}", term.factor)?,
                Some(at) if term.factor == 1 => f.write_str(NAMES[at])?,
                Some(at) => write!(f, "{}{}", term.factor, NAMES[at])?,
            }
            if term.divisor != 1 {
                write!(f, "/{}", term.divisor)?;
            }
        }
        Ok(())
    }
}

impl Sum {
    /// The value for a line.
    ///
    /// ```
    /// use guardbit::cover::{Measures, Sum};
    /// let line = Measures::of([[10, 10], [3, 15]], 0);
    /// assert_eq!("2m - n".parse::<Sum>()?.value(&line), 2 * 5 - 7);
    /// assert_eq!("-n/2 + left".parse::<Sum>()?.value(&line), -3 + 1);
    /// # Ok::<(), guardbit::cover::SumError>(())
    /// ```
    pub fn value(&self, measures: &Measures) -> i128 {
        self.0.iter().map(|term| term.value(measures)).sum()
    }

    /// The first name that there is none of here: the error word outside a test, or the greatest length of
    /// several lines where there is one line.
    pub(super) fn foreign(&self, error: bool, max: bool) -> Option<&'static str> {
        let mut named = self.0.iter().filter_map(|term| term.measure);
        let at = named.find(|at| (*at == ERROR && !error) || (*at == MAX && !max))?;
        Some(NAMES[at])
    }

    /// The sum and a number.
    #[must_use]
    pub fn plus(&self, number: i8) -> Self {
        let mut terms = self.0.clone();
        let at = terms.iter().position(|term| term.measure.is_none() && term.divisor == 1);
        let before = at.map_or(0, |at| {
            let term = terms.remove(at);
            if term.negative { -term.factor } else { term.factor }
        });
        let sum = before + i128::from(number);
        if sum != 0 || terms.is_empty() {
            let (negative, factor) = (sum < 0, sum.abs());
            terms.push(Term { negative, factor, measure: None, divisor: 1 });
        }
        Self(terms)
    }
}

impl Relation {
    /// Each, as a test writes it; a text that begins another one comes after it.
    const ALL: [(Self, &'static str); 4] =
        [(Self::AtLeast, ">="), (Self::AtMost, "<="), (Self::Above, ">"), (Self::Below, "<")];

    fn holds(self, order: Ordering) -> bool {
        match self {
            Self::Above => order.is_gt(),
            Self::AtLeast => order.is_ge(),
            Self::Below => order.is_lt(),
            Self::AtMost => order.is_le(),
        }
    }

    /// The one that differs where both sides are equal.
    const fn other(self) -> Self {
        match self {
            Self::Above => Self::AtLeast,
            Self::AtLeast => Self::Above,
            Self::Below => Self::AtMost,
            Self::AtMost => Self::Below,
        }
    }
}

impl FromStr for Test {
    type Err = SumError;

    fn from_str(text: &str) -> Result<Self, SumError> {
        let fault = || SumError::Test(text.chars().take(40).collect());
        let mut found = Relation::ALL.iter();
        let (relation, (left, right)) = found
            .find_map(|(relation, sign)| Some((*relation, text.split_once(sign)?)))
            .ok_or_else(fault)?;
        Ok(Self { left: left.parse()?, relation, right: right.parse()? })
    }
}

impl fmt::Display for Test {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = Relation::ALL.iter().find(|(relation, _)| *relation == self.relation);
        let sign = sign.map_or("", |(_, sign)| sign);
        write!(f, "{} {sign} {}", self.left, self.right)
    }
}

impl Test {
    /// Whether it holds for a line and an error word.
    pub fn holds(&self, measures: &Measures, error: i128) -> bool {
        let measures = measures.with(error);
        self.relation.holds(self.left.value(&measures).cmp(&self.right.value(&measures)))
    }

    pub(super) fn foreign(&self, max: bool) -> Option<&'static str> {
        self.left.foreign(true, max).or_else(|| self.right.foreign(true, max))
    }

    /// The test that differs where both sides are equal.
    #[must_use]
    pub fn other(&self) -> Self {
        Self { relation: self.relation.other(), ..self.clone() }
    }
}

macro_rules! texts {
    ($($form:ident),*) => {$(
        impl TryFrom<String> for $form {
            type Error = SumError;

            fn try_from(text: String) -> Result<Self, SumError> {
                text.parse()
            }
        }

        impl From<$form> for String {
            fn from(form: $form) -> Self {
                form.to_string()
            }
        }
    )*};
}

texts!(Sum, Test);
