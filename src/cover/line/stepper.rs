//! A line stepper of parts: error words, what is compared with what, and when a coordinate moves. Spec clauses
//! `RL-2` to `RL-6`.

use super::step;
use super::sum::{Measures, Sum, Test};
use crate::bits::Rounding;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An error word that says when one coordinate moves.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ErrorWord {
    /// What it holds at the first pixel.
    pub start: Sum,
    /// What each step adds.
    pub gain: Sum,
    /// When the coordinate moves, after the gain.
    pub when: Test,
    /// What a move takes off.
    pub loss: Sum,
    /// Its bits; as many as it needs when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u32>,
}

/// How one coordinate moves by an error word that both share.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct AxisMove {
    /// When it moves.
    pub when: Test,
    /// What the move adds to the error word.
    pub gain: Sum,
}

/// Which error word the two tests of a step look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Looks {
    /// Both at that of the step's start.
    Together,
    /// That of y at what x has left.
    XFirst,
    /// That of x at what y has left.
    YFirst,
}

/// One error word for both coordinates.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SharedError {
    /// What it holds at the first pixel.
    pub start: Sum,
    /// How x moves.
    pub x: AxisMove,
    /// How y moves.
    pub y: AxisMove,
    /// Which error word the two tests look at.
    pub looks: Looks,
    /// Its bits; as many as it needs when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<u32>,
}

/// An error word for each coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct OwnErrors {
    /// That of x.
    pub x: ErrorWord,
    /// That of y.
    pub y: ErrorWord,
}

/// Two coordinates with fraction bits that gain a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SlopeSteps {
    /// Fraction bits.
    pub fraction: u32,
    /// Rounding of the slopes.
    pub rounding: Rounding,
    /// Added to x at the first pixel, in units of its fraction.
    pub x_bias: i64,
    /// Added to y at the first pixel, in units of its fraction.
    pub y_bias: i64,
}

/// How a line goes from pixel to pixel.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Stepper {
    /// The longer axis moves in each step, and the shorter one by an error word.
    Major(Box<ErrorWord>),
    /// Both axes move by tests of one error word.
    Shared(Box<SharedError>),
    /// Both axes move by error words of their own.
    Own(Box<OwnErrors>),
    /// Both axes gain slopes.
    Slope(SlopeSteps),
}

/// A stepper that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StepperError {
    /// An error word that is too narrow or too wide.
    #[error("bits = {0}: an error word has 2 to 64 bits")]
    Bits(u32),
    /// A name that means nothing here.
    #[error(
        "the name {0:?} has no meaning here: e is only in a test, and max only in the pace of a quad's edges"
    )]
    Name(&'static str),
    /// A fraction outside the arithmetic.
    #[error("fraction = {0}: 1 <= fraction <= 40 is needed")]
    Fraction(u32),
    /// A bias that moves the first pixel.
    #[error("{axis}-bias = {bias}: 0 <= {axis}-bias < 2^fraction = {one} is needed")]
    Bias {
        /// The coordinate.
        axis: char,
        /// The bias.
        bias: i64,
        /// One pixel.
        one: i64,
    },
}

/// The low bits of a word, with its sign; all of it where there is no width.
fn cut(value: i128, bits: Option<u32>) -> i128 {
    bits.map_or(value, |bits| value << (128 - bits) >> (128 - bits))
}

/// An error word at work.
#[derive(Clone, Debug)]
pub struct ErrorState<'a> {
    config: &'a ErrorWord,
    measures: Measures,
    gain: i128,
    loss: i128,
    error: i128,
}

impl ErrorWord {
    /// The word at the first pixel of a line.
    pub fn begin(&self, measures: Measures) -> ErrorState<'_> {
        let [start, gain, loss] =
            [&self.start, &self.gain, &self.loss].map(|sum| sum.value(&measures));
        let error = cut(start, self.bits);
        ErrorState { config: self, measures, gain, loss, error }
    }

    /// Checks widths and names; `max` says whether there is a greatest length of several lines.
    ///
    /// # Errors
    /// [`StepperError`] names what is wrong.
    pub fn check(&self, max: bool) -> Result<(), StepperError> {
        check_bits(self.bits)?;
        let sums = [&self.start, &self.gain, &self.loss];
        let foreign = sums.into_iter().find_map(|sum| sum.foreign(false, max));
        foreign
            .or_else(|| self.when.foreign(max))
            .map_or(Ok(()), |name| Err(StepperError::Name(name)))
    }
}

impl ErrorState<'_> {
    /// A step; whether the coordinate moves.
    pub fn step(&mut self) -> bool {
        let bits = self.config.bits;
        self.error = cut(self.error + self.gain, bits);
        let moves = self.config.when.holds(&self.measures, self.error);
        if moves {
            self.error = cut(self.error - self.loss, bits);
        }
        moves
    }
}

const fn check_bits(bits: Option<u32>) -> Result<(), StepperError> {
    match bits {
        Some(bits) if bits < 2 || bits > 64 => Err(StepperError::Bits(bits)),
        _ => Ok(()),
    }
}

impl SharedError {
    fn check(&self) -> Result<(), StepperError> {
        check_bits(self.bits)?;
        let sums = [&self.start, &self.x.gain, &self.y.gain];
        let foreign = sums.into_iter().find_map(|sum| sum.foreign(false, false));
        let tests = [&self.x.when, &self.y.when];
        let foreign = foreign.or_else(|| tests.into_iter().find_map(|test| test.foreign(false)));
        foreign.map_or(Ok(()), |name| Err(StepperError::Name(name)))
    }

    /// The axes in the order in which they are looked at, with x where both are looked at together.
    const fn order(&self) -> [usize; 2] {
        if matches!(self.looks, Looks::YFirst) { [1, 0] } else { [0, 1] }
    }

    fn walk(&self, ends: [[i128; 2]; 2], visit: &mut dyn FnMut([i128; 2])) {
        let [mut at, to] = ends;
        let measures = Measures::of(ends, 0);
        let signs = [0, 1].map(|axis| (to[axis] - at[axis]).signum());
        let moves = [&self.x, &self.y];
        let gains = moves.map(|axis| axis.gain.value(&measures));
        let mut error = cut(self.start.value(&measures), self.bits);
        visit(at);
        // A line moves an axis in each step; one that does not, or that misses its end, would never end.
        for _ in 0..ends_apart(ends) {
            if at == to {
                return;
            }
            let (seen, mut moved) = (error, false);
            for axis in self.order() {
                let seen = if self.looks == Looks::Together { seen } else { error };
                if moves[axis].when.holds(&measures, seen) {
                    at[axis] += signs[axis];
                    error = cut(error + gains[axis], self.bits);
                    moved = true;
                }
            }
            if !moved {
                return;
            }
            visit(at);
        }
    }
}

/// The sum of both differences: the most steps that bring a line to its end.
const fn ends_apart([from, to]: [[i128; 2]; 2]) -> i128 {
    (to[0] - from[0]).abs() + (to[1] - from[1]).abs()
}

impl SlopeSteps {
    fn check(self) -> Result<(), StepperError> {
        if !(1..=40).contains(&self.fraction) {
            return Err(StepperError::Fraction(self.fraction));
        }
        let one = 1i64 << self.fraction;
        let biases = [('x', self.x_bias), ('y', self.y_bias)];
        match biases.into_iter().find(|(_, bias)| !(0..one).contains(bias)) {
            Some((axis, bias)) => Err(StepperError::Bias { axis, bias, one }),
            None => Ok(()),
        }
    }

    fn walk(self, ends: [[i128; 2]; 2], visit: &mut dyn FnMut([i128; 2])) {
        let [from, to] = ends;
        let n = Measures::of(ends, 0).length();
        let slope = |axis: usize| {
            let whole = (to[axis] - from[axis]) << self.fraction;
            self.rounding.divide(whole, n).map_or(0, |(slope, _)| slope)
        };
        let slopes = [slope(0), slope(1)];
        let mut held = [(from[0], self.x_bias), (from[1], self.y_bias)]
            .map(|(at, bias)| (at << self.fraction) + i128::from(bias));
        for _ in 0..=n {
            visit(held.map(|at| at >> self.fraction));
            held = [held[0] + slopes[0], held[1] + slopes[1]];
        }
    }
}

impl Stepper {
    /// Checks widths and names.
    ///
    /// # Errors
    /// [`StepperError`] names what is wrong.
    pub fn check(&self) -> Result<(), StepperError> {
        match self {
            Self::Major(word) => word.check(false),
            Self::Shared(shared) => shared.check(),
            Self::Own(own) => own.x.check(false).and_then(|()| own.y.check(false)),
            Self::Slope(slope) => slope.check(),
        }
    }

    /// Calls `visit` for the pixels of a line between two pixels, in walking order, the first end included.
    /// Coordinates lie within 33 bits.
    pub fn walk(&self, ends: [[i128; 2]; 2], visit: &mut dyn FnMut([i128; 2])) {
        match self {
            Self::Major(word) => {
                let mut state = word.begin(Measures::of(ends, 0));
                step::walk(ends, |_, _| state.step(), visit);
            }
            Self::Shared(shared) => shared.walk(ends, visit),
            Self::Own(own) => {
                let measures = Measures::of(ends, 0);
                let mut words = [own.x.begin(measures), own.y.begin(measures)];
                let [mut at, to] = ends;
                let signs = [0, 1].map(|axis| (to[axis] - at[axis]).signum());
                visit(at);
                for _ in 0..measures.length() {
                    for ((at, sign), word) in at.iter_mut().zip(signs).zip(&mut words) {
                        *at += if word.step() { sign } else { 0 };
                    }
                    visit(at);
                }
            }
            Self::Slope(slope) => slope.walk(ends, visit),
        }
    }
}
