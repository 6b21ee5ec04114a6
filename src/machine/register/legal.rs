//! Which words a driver may write. Spec clause `RG-26`.

use super::Registers;
use super::input::RegisterError;
use crate::format::{Gather, Layout};

/// How the sides of a condition compare, as a profile writes it; a text that begins another one comes after it.
type Relation = (&'static str, fn(i128, i128) -> bool);
const RELATIONS: [Relation; 6] = [
    (">=", |a, b| a >= b),
    ("<=", |a, b| a <= b),
    ("==", |a, b| a == b),
    ("!=", |a, b| a != b),
    (">", |a, b| a > b),
    ("<", |a, b| a < b),
];

/// A side of a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Side {
    Number(i128),
    Plain(Gather),
    Signed(Gather),
}

/// A condition that legal words meet, such as `left <= right`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Legal {
    text: String,
    /// The place of the relation in [`RELATIONS`].
    relation: usize,
    sides: [Side; 2],
}

impl Side {
    fn parse(text: &str, layout: &Layout) -> Option<Self> {
        let text = text.trim();
        if let Ok(number) = text.parse::<i64>() {
            return Some(Self::Number(number.into()));
        }
        match text.strip_prefix("signed ") {
            Some(name) => layout.find(name.trim()).map(Self::Signed),
            None => layout.find(text).map(Self::Plain),
        }
    }

    fn value(&self, words: &[u32]) -> i128 {
        match self {
            Self::Number(number) => *number,
            Self::Plain(gather) => gather.unsigned(words).into(),
            Self::Signed(gather) => gather.signed(words).into(),
        }
    }

    const fn register(&self) -> Option<&Gather> {
        match self {
            Self::Number(_) => None,
            Self::Plain(gather) | Self::Signed(gather) => Some(gather),
        }
    }
}

impl Legal {
    pub(super) fn parse(text: &str, layout: &Layout) -> Result<Self, RegisterError> {
        let found = RELATIONS.iter().enumerate().find_map(|(relation, (sign, _))| {
            let (left, right) = text.split_once(sign)?;
            let sides = [Side::parse(left, layout)?, Side::parse(right, layout)?];
            Some(Self { text: text.to_owned(), relation, sides })
        });
        found.ok_or_else(|| RegisterError::Legal(text.to_owned()))
    }

    /// Whether words meet it.
    pub fn holds(&self, words: &[u32]) -> bool {
        let [left, right] = self.sides.each_ref().map(|side| side.value(words));
        RELATIONS[self.relation].1(left, right)
    }

    /// As the profile writes it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Words that break it, one register changed: to an end of its range, or beside the other side.
    pub fn broken(&self, words: &[u32]) -> Vec<Vec<u32>> {
        let mut found = Vec::new();
        for (n, side) in self.sides.iter().enumerate() {
            let Some(gather) = side.register() else { continue };
            let other = self.sides[1 - n].value(words);
            for value in [0, -1, other, other - 1, other + 1, 1 << (gather.bits() - 1)] {
                let mut changed = words.to_vec();
                gather.scatter(value, &mut changed);
                if !self.holds(&changed) && !found.contains(&changed) {
                    found.push(changed);
                }
            }
        }
        found
    }
}

impl Registers {
    /// The conditions that words break; none for legal words.
    pub fn illegal(&self, words: &[u32]) -> impl Iterator<Item = &Legal> {
        self.legal.iter().filter(move |legal| !legal.holds(words))
    }
}
