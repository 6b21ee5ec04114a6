//! The fields of a profile that a search may vary, by name. Spec clause `Q-1`.

mod place;

use crate::bits::Rounding;
use crate::cover::{Order, Stamp};
use crate::format::Clamp;
use crate::profile::MACHINES;
use crate::value::DepthFormat;
use serde::Serialize;
use std::fmt::Display;

/// What a field is set to.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number of bits.
    Bits(u32),
    /// A choice.
    Name(&'static str),
}

/// How much of a measurement depends on a field: fields of an outer level are varied last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The scene on its grid, and everything after it.
    Stage,
    /// What is drawn, and the values at drawn samples.
    Coverage,
    /// The values alone.
    Value,
}

/// A field of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// Sub-pixel bits of the vertex grid.
    SubPixel,
    /// Integer bits of the vertex field.
    VertexInteger,
    /// Rounding of vertices to their grid.
    Snap,
    /// Depth bits.
    Integer,
    /// The machine.
    Form,
    /// The order in which samples are visited.
    Traversal,
    /// Pixels evaluated in one step.
    Stamp,
    /// Bits of an edge word.
    EdgeWidth,
    /// Fraction bits of a walked edge.
    WalkFraction,
    /// Integer bits of a walked edge.
    WalkInteger,
    /// Guard bits of a walked edge.
    WalkGuard,
    /// Rounding of a walked edge.
    WalkRounding,
    /// Interpolation bits of depth.
    Interpolation,
    /// Guard bits of depth.
    Guard,
    /// Rounding of the depth plane.
    Rounding,
    /// Clamp of the depth read-out.
    Clamp,
    /// Bits of the reciprocal behind the depth plane.
    Reciprocal,
    /// What the depth start gains.
    StartBias,
    /// What is stored of depth.
    DepthFormat,
}

/// Why a field does not take a value in some profile.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FieldError {
    /// The profile has no such field: an edge width under an edge walk, guard bits without depth.
    #[error("{0}: this profile has no such field")]
    Absent(&'static str),
    /// The value is of the wrong kind, or unknown.
    #[error("{field} = {value}: {expected}")]
    Value {
        /// The field.
        field: &'static str,
        /// What was asked for.
        value: String,
        /// What it takes.
        expected: String,
    },
}

/// The word that makes an edge width follow the grid and the window.
const EXACT: &str = "exact";
/// The word for a division without a reciprocal.
const QUOTIENT: &str = "quotient";
/// The word for visiting the bounding box row by row, as a profile without a `[traversal]` does.
const ROWS: &str = "rows";
const BIASES: [&str; 2] = ["none", "half"];

impl Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bits(bits) => write!(f, "{bits}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

impl Field {
    /// Every field, in the order that budgets are listed in.
    pub const ALL: [Self; 19] = [
        Self::SubPixel,
        Self::VertexInteger,
        Self::Snap,
        Self::Integer,
        Self::Form,
        Self::Traversal,
        Self::Stamp,
        Self::EdgeWidth,
        Self::WalkFraction,
        Self::WalkInteger,
        Self::WalkGuard,
        Self::WalkRounding,
        Self::Interpolation,
        Self::Guard,
        Self::Rounding,
        Self::Clamp,
        Self::Reciprocal,
        Self::StartBias,
        Self::DepthFormat,
    ];

    /// The name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SubPixel => "sub-pixel",
            Self::VertexInteger => "vertex-integer",
            Self::Snap => "snap",
            Self::Integer => "integer",
            Self::Form => "form",
            Self::Traversal => "traversal",
            Self::Stamp => "stamp",
            Self::EdgeWidth => "edge-width",
            Self::WalkFraction => "walk-fraction",
            Self::WalkInteger => "walk-integer",
            Self::WalkGuard => "walk-guard",
            Self::WalkRounding => "walk-rounding",
            Self::Interpolation => "interpolation",
            Self::Guard => "guard",
            Self::Rounding => "rounding",
            Self::Clamp => "clamp",
            Self::Reciprocal => "reciprocal",
            Self::StartBias => "start-bias",
            Self::DepthFormat => "depth-format",
        }
    }

    /// How far a change of the field reaches.
    pub const fn level(self) -> Level {
        match self {
            Self::SubPixel | Self::VertexInteger | Self::Snap | Self::Integer | Self::Form => {
                Level::Stage
            }
            Self::Traversal
            | Self::Stamp
            | Self::EdgeWidth
            | Self::WalkFraction
            | Self::WalkInteger
            | Self::WalkGuard
            | Self::WalkRounding => Level::Coverage,
            _ => Level::Value,
        }
    }

    /// The field of that name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|field| field.name() == name)
    }

    /// The words that the field takes, beside or instead of numbers.
    pub fn words(self) -> Vec<&'static str> {
        match self {
            Self::Snap | Self::WalkRounding | Self::Rounding => {
                Rounding::ALL.map(|rounding| rounding.names().guardbit).to_vec()
            }
            Self::Form => MACHINES.map(|(name, _)| name).to_vec(),
            Self::Traversal => std::iter::once(ROWS).chain(Order::ALL.map(Order::name)).collect(),
            Self::Stamp => Stamp::ALL.map(Stamp::name).to_vec(),
            Self::Clamp => Clamp::ALL.map(Clamp::name).to_vec(),
            Self::StartBias => BIASES.to_vec(),
            Self::DepthFormat => DepthFormat::NAMES.to_vec(),
            Self::EdgeWidth => vec![EXACT],
            Self::Reciprocal => vec![QUOTIENT],
            _ => Vec::new(),
        }
    }

    /// Whether the field counts bits, so that "one bit less" means something.
    pub fn is_bits(self) -> bool {
        self.words().len() <= 1
    }

    /// The value that a word or number stands for.
    ///
    /// # Errors
    /// [`FieldError::Value`] says what the field takes.
    pub fn parse(self, text: &str) -> Result<Value, FieldError> {
        if let Some(word) = self.words().into_iter().find(|word| *word == text) {
            return Ok(Value::Name(word));
        }
        match text.parse() {
            Ok(bits) if self.is_bits() => Ok(Value::Bits(bits)),
            _ => Err(self.unfit(text)),
        }
    }

    fn unfit(self, value: impl Display) -> FieldError {
        let words = self.words().join(", ");
        let expected = match (self.is_bits(), words.is_empty()) {
            (true, true) => "a number of bits is expected".to_owned(),
            (true, false) => format!("a number of bits or {words} is expected"),
            _ => format!("one of {words} is expected"),
        };
        FieldError::Value { field: self.name(), value: value.to_string(), expected }
    }
}
