//! The registers an engine asks for, and what is wrong with a list of them.

use crate::format::{Gather, Layout, LayoutError};
use crate::value::ChannelError;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// A register machine that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RegisterError {
    /// Words in another radix.
    #[error("radix = {0}: the radix of words is 10 or 16")]
    Radix(u32),
    /// The list of registers.
    #[error("input: {0}")]
    Input(LayoutError),
    /// A condition that cannot be read.
    #[error(
        "legal: {0:?} is not a condition; a condition is two sides with >=, <=, ==, !=, > or < between them, \
         and a side is a number, a register of `input`, or `signed` and a register"
    )]
    Legal(String),
    /// A register that the engine needs.
    #[error("input: the engine {engine} needs a register {name:?}")]
    Missing {
        /// The engine.
        engine: &'static str,
        /// The register.
        name: String,
    },
    /// A register that the engine does not have.
    #[error(
        "input: the engine {engine} has no register {name:?}; its registers are {known}; begin the name \
         with - if the engine does not use the register"
    )]
    Unknown {
        /// The engine.
        engine: &'static str,
        /// The register.
        name: String,
        /// Those it has.
        known: String,
    },
    /// Another number of kinds of records.
    #[error(
        "records: the profile lists {got} kinds of records, but the engine {engine} writes {need}"
    )]
    Records {
        /// The engine.
        engine: &'static str,
        /// Its kinds.
        need: usize,
        /// Those given.
        got: usize,
    },
    /// The words of a record.
    #[error("record {letter}: {source}")]
    Record {
        /// Its letter.
        letter: char,
        /// Why.
        source: LayoutError,
    },
    /// A value that the engine does not make.
    #[error("record {letter}: there is no value {name:?}; the values of this record are {known}")]
    Value {
        /// The record's letter.
        letter: char,
        /// The value.
        name: String,
        /// Those there are.
        known: String,
    },
    /// A channel.
    #[error(transparent)]
    Channel(#[from] ChannelError),
    /// Knobs without a meaning together.
    #[error("engine {engine}: {reason}")]
    Together {
        /// The engine.
        engine: &'static str,
        /// Why.
        reason: String,
    },
}

impl RegisterError {
    /// The table or key the fault lies in, from the profile's root.
    pub const fn field(&self) -> &'static [&'static str] {
        match self {
            Self::Legal(_) => &["form", "registers", "legal"],
            Self::Radix(_) => &["form", "registers", "radix"],
            Self::Input(_) | Self::Missing { .. } | Self::Unknown { .. } => {
                &["form", "registers", "input"]
            }
            Self::Records { .. } | Self::Record { .. } | Self::Value { .. } => {
                &["form", "registers", "records"]
            }
            Self::Channel(_) => &["form", "registers", "channels"],
            Self::Together { .. } => &["form", "registers", "engine"],
        }
    }
}

/// The registers of a list, and which of them were asked for.
#[derive(Debug)]
pub(super) struct Inputs<'a> {
    layout: &'a Layout,
    asked: RefCell<BTreeSet<String>>,
}

impl<'a> Inputs<'a> {
    pub(super) fn new(layout: &'a Layout) -> Self {
        Self { layout, asked: RefCell::default() }
    }

    /// A register that may be absent.
    pub(super) fn may(&self, name: &str) -> Option<Gather> {
        self.asked.borrow_mut().insert(name.to_owned());
        self.layout.find(name)
    }

    /// A register that has to be there.
    pub(super) fn need(&self, engine: &'static str, name: &str) -> Result<Gather, RegisterError> {
        self.may(name).ok_or_else(|| RegisterError::Missing { engine, name: name.to_owned() })
    }

    /// Several.
    pub(super) fn all<const N: usize>(
        &self,
        engine: &'static str,
        names: [&str; N],
    ) -> Result<[Gather; N], RegisterError> {
        let found = names.map(|name| self.need(engine, name));
        let found: Vec<Gather> = found.into_iter().collect::<Result<_, _>>()?;
        // N results of N names.
        <[Gather; N]>::try_from(found)
            .map_err(|_| RegisterError::Missing { engine, name: names.join(", ") })
    }

    /// Refuses what nobody asked for: a register misspelt does nothing.
    pub(super) fn all_known(&self, engine: &'static str) -> Result<(), RegisterError> {
        let asked = self.asked.borrow();
        match self.layout.names().find(|name| !asked.contains(*name)) {
            None => Ok(()),
            Some(name) => {
                let known = asked.iter().cloned().collect::<Vec<_>>().join(", ");
                Err(RegisterError::Unknown { engine, name: name.to_owned(), known })
            }
        }
    }
}

/// The registers of a channel.
#[derive(Clone, Debug)]
pub(super) struct ChannelInput {
    pub(super) start: Gather,
    pub(super) along: Gather,
    pub(super) down: Gather,
}
