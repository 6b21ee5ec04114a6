//! The decisions of a profile that a search may vary: what each is called, what it takes, and how far
//! a change of it reaches. The owner of a configuration lists its own. Spec clause `Q-1`.

use serde::Serialize;
use std::fmt::Display;

/// What a decision is set to.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number of bits.
    Bits(u32),
    /// A number that counts no bits, of either sign.
    Number(i64),
    /// A choice.
    Name(&'static str),
}

impl Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bits(bits) => write!(f, "{bits}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

impl Value {
    /// The number of bits; `None` for what counts none.
    pub const fn bits(&self) -> Option<u32> {
        match self {
            Self::Bits(bits) => Some(*bits),
            Self::Number(_) | Self::Name(_) => None,
        }
    }

    /// The number that counts no bits; `None` for bits and words.
    pub const fn number(&self) -> Option<i64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Bits(_) | Self::Name(_) => None,
        }
    }

    /// The choice that this word stands for; `None` for a number or another word.
    pub fn choose<T: Copy>(&self, all: &[T], name: impl Fn(T) -> &'static str) -> Option<T> {
        all.iter().copied().find(|one| *self == Self::Name(name(*one)))
    }
}

/// How much of a measurement depends on a decision: those of an outer level are varied last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The scene on its grid, and everything after it.
    Stage,
    /// What is drawn, and the values at drawn samples.
    Coverage,
    /// The values alone.
    Value,
}

/// What a decision takes.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A number of bits.
    Bits {
        /// The fewest that any profile allows.
        least: u32,
        /// The most that any profile allows; growth can ask for fewer.
        most: u32,
        /// A word beside the numbers.
        word: Option<&'static str>,
    },
    /// A number that counts no bits.
    Number {
        /// The least that any profile allows; the rest of the profile can ask for more.
        least: i64,
        /// The most that any profile allows.
        most: i64,
    },
    /// One of these words.
    Words(fn() -> Vec<&'static str>),
}

/// A decision that a search may vary.
#[derive(Clone, Copy, Debug)]
pub struct Decision {
    /// The name on the command line and in reports.
    pub name: &'static str,
    /// How far a change reaches.
    pub level: Level,
    /// The clause that says what it decides.
    pub clause: &'static str,
    /// What it takes.
    pub takes: Takes,
}

impl Decision {
    /// A number of bits in a range.
    pub const fn bits(
        name: &'static str,
        level: Level,
        clause: &'static str,
        [least, most]: [u32; 2],
    ) -> Self {
        Self { name, level, clause, takes: Takes::Bits { least, most, word: None } }
    }

    /// A number of either sign in a range.
    pub const fn number(
        name: &'static str,
        level: Level,
        clause: &'static str,
        [least, most]: [i64; 2],
    ) -> Self {
        Self { name, level, clause, takes: Takes::Number { least, most } }
    }

    /// One of a list of words.
    pub const fn words(
        name: &'static str,
        level: Level,
        clause: &'static str,
        words: fn() -> Vec<&'static str>,
    ) -> Self {
        Self { name, level, clause, takes: Takes::Words(words) }
    }
}

/// Why an owner does not take a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// The owner has no such decision.
    Absent,
    /// The value is of the wrong kind, or unknown.
    Unfit,
}

impl Refused {
    /// What was found among those taken.
    ///
    /// # Errors
    /// [`Refused::Unfit`] if nothing was.
    pub fn unless<T>(found: Option<T>) -> Result<T, Self> {
        found.ok_or(Self::Unfit)
    }
}
