//! Lines: from the lectures' integer algorithms to the diamond exit rules of Direct3D and Vulkan, and
//! lines with a width. Spec clauses `L-1` to `L-8`.

mod diamond;
mod march;
mod step;
mod stepper;
mod sum;
mod wide;

pub use march::march;
pub use step::{Tie, bresenham, incremental, integer_incremental, midpoint, naive};
pub use stepper::{
    AxisMove, ErrorState, ErrorWord, Looks, OwnErrors, SharedError, SlopeSteps, Stepper,
    StepperError,
};
pub use sum::{Measures, Sum, SumError, Test};

use super::rect::Rect;
use super::sample::SampleGrid;
use crate::bits::Rounding;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where the remainder of an integer incremental line starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// At zero: the minor coordinate is floored.
    Zero,
    /// At half the length, floored: the minor coordinate is rounded.
    Half,
}

/// Which pixels a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum LineRule {
    /// Pixels whose diamond the line leaves; the diamond has its lower edges (Direct3D).
    DiamondD3d,
    /// The same for open diamonds and a line moved by -(e, e^2) (Vulkan, OpenGL).
    DiamondVulkan,
    /// Bresenham's error term; a tie stays.
    Bresenham,
    /// The midpoint algorithm.
    Midpoint {
        /// What it does where the line passes through a midpoint.
        tie: Tie,
    },
    /// A remainder that gains the minor and loses the major difference.
    IntegerIncremental {
        /// What it starts at.
        start: Start,
    },
    /// A fixed-point accumulator and a rounded slope.
    Incremental {
        /// Fraction bits of both.
        fraction: u32,
        /// Rounding of the slope.
        rounding: Rounding,
    },
    /// The exact minor coordinate at each step, rounded.
    Naive {
        /// To which pixel.
        rounding: Rounding,
    },
    /// Samples inside a rectangle around the segment.
    Rectangle {
        /// Its width, in sub-pixels.
        width: u32,
    },
}

/// A pattern along a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Stipple {
    /// Sixteen pixels, the first in the lowest bit.
    pub pattern: u16,
    /// How many pixels a bit stands for, 1 to 256.
    pub factor: u32,
}

impl Stipple {
    /// Whether pixel number `s` of a line is drawn: bit `floor(s / factor) mod 16`.
    pub fn draws(self, s: u64) -> bool {
        self.pattern >> (s / u64::from(self.factor.max(1)) % 16) & 1 == 1
    }
}

/// How lines are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct LineConfig {
    /// Which pixels.
    pub rule: LineRule,
    /// Which of them are drawn; all when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stipple: Option<Stipple>,
}

impl Default for LineConfig {
    fn default() -> Self {
        Self { rule: LineRule::DiamondVulkan, stipple: None }
    }
}

/// A line rule that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LineError {
    /// A fraction outside the arithmetic.
    #[error("line fraction = {0}: an incremental line has 1 to 60 fraction bits")]
    Fraction(u32),
    /// A factor outside its range.
    #[error("stipple factor = {0}: 1 <= factor <= 256 is needed")]
    Factor(u32),
    /// A pattern has no place on a rectangle.
    #[error(
        "a stipple needs a line rule that walks pixel by pixel, so it does not work with the rule rectangle"
    )]
    Stipple,
    /// A rectangle without width, or too large to compare exactly.
    #[error(
        "line width = {width}, vertex difference bits = {difference}: 1 <= line width <= 2^24 \
         sub-pixels and vertex difference bits <= 30 are needed for the rule rectangle"
    )]
    Rectangle {
        /// The width.
        width: u32,
        /// Bits of a vertex difference.
        difference: u32,
    },
}

/// One end and the other, in sub-pixels.
pub type Segment = [[i128; 2]; 2];

impl LineConfig {
    /// Checks the rule; `difference` is the bits of a vertex difference.
    ///
    /// # Errors
    /// [`LineError`] names the violated inequality.
    pub fn validate(&self, difference: u32) -> Result<(), LineError> {
        match self.rule {
            LineRule::Incremental { fraction, .. } if !(1..=60).contains(&fraction) => {
                return Err(LineError::Fraction(fraction));
            }
            LineRule::Rectangle { width } => {
                if !(1..=1 << 24).contains(&width) || difference > 30 {
                    return Err(LineError::Rectangle { width, difference });
                }
                if self.stipple.is_some() {
                    return Err(LineError::Stipple);
                }
            }
            _ => {}
        }
        match self.stipple {
            Some(Stipple { factor, .. }) if !(1..=256).contains(&factor) => {
                Err(LineError::Factor(factor))
            }
            _ => Ok(()),
        }
    }

    /// Calls `plot(x, y)` for the pixels of a line inside `clip`, in walking order; a rectangle's row
    /// by row. The algorithms of integer end points take the pixels that hold the ends.
    ///
    /// The work grows with what the window holds of the line, whatever its length.
    pub fn pixels(
        &self,
        line: Segment,
        grid: &SampleGrid,
        clip: Rect,
        plot: &mut dyn FnMut(u32, u32),
    ) {
        let stipple = self.stipple;
        let mut inside = |s: u64, x: i128, y: i128| {
            let column = u32::try_from(x).ok().filter(|x| (clip.x0..clip.x1).contains(x));
            let row = u32::try_from(y).ok().filter(|y| (clip.y0..clip.y1).contains(y));
            if let (Some(x), Some(y)) = (column, row)
                && stipple.is_none_or(|stipple| stipple.draws(s))
            {
                plot(x, y);
            }
        };
        let pixel = |end: [i128; 2]| end.map(|value| value >> grid.sub_pixel);
        let ends = line.map(pixel);
        match self.rule {
            LineRule::DiamondD3d => {
                diamond::walk(diamond::Kind::D3d, line, grid, clip, &mut inside);
            }
            LineRule::DiamondVulkan => {
                diamond::walk(diamond::Kind::Vulkan, line, grid, clip, &mut inside);
            }
            LineRule::Bresenham => {
                step::within(ends, clip, step::Rule::Tie(Tie::East), &mut inside);
            }
            LineRule::Midpoint { tie } => {
                step::within(ends, clip, step::Rule::Tie(tie), &mut inside);
            }
            LineRule::IntegerIncremental { start } => {
                step::within(ends, clip, step::Rule::Start(start), &mut inside);
            }
            LineRule::Incremental { fraction, rounding } => {
                step::within(ends, clip, step::Rule::Slope(fraction, rounding), &mut inside);
            }
            LineRule::Naive { rounding } => {
                step::within(ends, clip, step::Rule::Exact(rounding), &mut inside);
            }
            LineRule::Rectangle { width } => wide::rectangle(line, width, grid, clip, plot),
        }
    }
}
