//! The fields of a profile that a search may vary, by name: the decisions that its owners list. Spec clause
//! `Q-1`.

mod channel;
mod place;

use crate::cover::{EdgeWordConfig, TraversalConfig};
use crate::machine::{EdgeWalkConfig, kinds, triangle_machines};
use crate::profile::Profile;
use crate::setup::VertexConfig;
use crate::value::DepthConfig;
use std::fmt::Display;
use std::sync::OnceLock;

pub use crate::format::{Decision, Level, Takes, Value};

/// Whose decision a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Owner {
    /// The vertex field.
    Vertex,
    /// The profile: its machine.
    Form,
    /// The traversal.
    Traversal,
    /// The machine.
    Machine,
    /// The depth plane.
    Depth,
    /// The channel of that name.
    Channel(&'static str),
    /// The plane of 1/w.
    InverseW,
}

/// A field of a profile: a decision of the vertex field, the traversal, the machine, the depth plane, a
/// channel or the plane of 1/w.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    decision: &'static Decision,
    owner: Owner,
}

impl PartialEq for Field {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Field {}

/// Why a field does not take a value in some profile.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FieldError {
    /// The profile has no such field: an edge width under an edge walk, guard bits without depth.
    #[error("{0}: the profile does not have this field")]
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

/// The machine itself.
const FORM: Decision = Decision::words("form", Level::Stage, "A-2", || {
    triangle_machines().map(|kind| kind.name).collect()
});

impl Field {
    /// Sub-pixel bits of the vertex grid.
    pub const SUB_PIXEL: Self = Self::of(Owner::Vertex, &VertexConfig::SUB_PIXEL);
    /// The machine.
    pub const FORM: Self = Self::of(Owner::Form, &FORM);
    /// Bits of an edge word.
    pub const EDGE_WIDTH: Self = Self::of(Owner::Machine, &EdgeWordConfig::WIDTH);
    /// Fraction bits of a walked edge.
    pub const WALK_FRACTION: Self = Self::of(Owner::Machine, &EdgeWalkConfig::FRACTION);
    /// Integer bits of a walked edge.
    pub const WALK_INTEGER: Self = Self::of(Owner::Machine, &EdgeWalkConfig::INTEGER);
    /// Guard bits of a walked edge.
    pub const WALK_GUARD: Self = Self::of(Owner::Machine, &EdgeWalkConfig::GUARD);
    /// Depth bits.
    pub const INTEGER: Self = Self::of(Owner::Depth, &DepthConfig::INTEGER);
    /// Interpolation bits of depth.
    pub const INTERPOLATION: Self = Self::of(Owner::Depth, &DepthConfig::INTERPOLATION);
    /// Guard bits of depth.
    pub const GUARD: Self = Self::of(Owner::Depth, &DepthConfig::GUARD);
    /// Clamp of the depth read-out.
    pub const CLAMP: Self = Self::of(Owner::Depth, &DepthConfig::CLAMP);
    /// Bits of the reciprocal behind the depth plane.
    pub const RECIPROCAL: Self = Self::of(Owner::Depth, &DepthConfig::RECIPROCAL);

    const fn of(owner: Owner, decision: &'static Decision) -> Self {
        Self { decision, owner }
    }

    /// Every field, in the order that budgets are listed in: the outer level first, and within a level the
    /// vertex field, the machine with its traversal, and depth. Made on first use: machines of one's own are
    /// added before ([`crate::machine::add`]).
    pub fn all() -> &'static [Self] {
        static ALL: OnceLock<Vec<Field>> = OnceLock::new();
        ALL.get_or_init(Self::listed)
    }

    fn listed() -> Vec<Self> {
        let list = |owner, decisions: &'static [Decision]| {
            decisions.iter().map(move |decision| Self::of(owner, decision))
        };
        // Depth bits are a part of the stage and come before the machine.
        let mut all: Vec<Self> = list(Owner::Vertex, VertexConfig::DECISIONS)
            .chain(list(Owner::Depth, DepthConfig::DECISIONS))
            .chain([Self::FORM])
            .chain(list(Owner::Traversal, TraversalConfig::DECISIONS))
            .collect();
        for kind in kinds() {
            for field in list(Owner::Machine, kind.decisions) {
                // Machines that share a word share its decisions.
                if !all.contains(&field) {
                    all.push(field);
                }
            }
        }
        all.sort_by_key(|field| field.level());
        all
    }

    /// The name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        self.decision.name
    }

    /// How far a change of the field reaches.
    pub const fn level(self) -> Level {
        self.decision.level
    }

    /// The clause that says what it decides.
    pub const fn clause(self) -> &'static str {
        self.decision.clause
    }

    /// What it takes.
    pub const fn takes(self) -> Takes {
        self.decision.takes
    }

    /// The field of that name; `color.interpolation` is one of the channel `color`, `w.integer` one of 1/w.
    pub fn find(name: &str) -> Option<Self> {
        let own = Self::all().iter().copied().find(|field| field.name() == name);
        own.or_else(|| Self::of_channel(name))
    }

    /// Every field that a profile has, those of its channels last.
    pub fn of_profile(profile: &Profile) -> Vec<Self> {
        let own = Self::all().iter().copied().chain(Self::of_channels(profile));
        own.filter(|field| field.read(profile).is_some()).collect()
    }

    /// The words that the field takes, beside or instead of numbers.
    pub fn words(self) -> Vec<&'static str> {
        match self.decision.takes {
            Takes::Bits { word, .. } => word.into_iter().collect(),
            Takes::Number { .. } => Vec::new(),
            Takes::Words(words) => words(),
        }
    }

    /// Whether the field counts bits, so that "one bit less" means something.
    pub const fn is_bits(self) -> bool {
        matches!(self.decision.takes, Takes::Bits { .. })
    }

    /// The value that a word or number stands for.
    ///
    /// # Errors
    /// [`FieldError::Value`] says what the field takes.
    pub fn parse(self, text: &str) -> Result<Value, FieldError> {
        if let Some(word) = self.words().into_iter().find(|word| *word == text) {
            return Ok(Value::Name(word));
        }
        let number = match self.takes() {
            Takes::Bits { .. } => text.parse().ok().map(Value::Bits),
            Takes::Number { .. } => text.parse().ok().map(Value::Number),
            Takes::Words(_) => None,
        };
        number.ok_or_else(|| self.unfit(text))
    }

    fn unfit(self, value: impl Display) -> FieldError {
        let words = self.words().join(", ");
        let expected = match (self.takes(), words.is_empty()) {
            (Takes::Bits { .. }, true) => "a number of bits is expected".to_owned(),
            (Takes::Bits { .. }, false) => format!("a number of bits or {words} is expected"),
            (Takes::Number { .. }, _) => "a whole number with its sign is expected".to_owned(),
            (Takes::Words(_), _) => format!("one of {words} is expected"),
        };
        FieldError::Value { field: self.name(), value: value.to_string(), expected }
    }
}
