//! Machines that are not built in: another crate implements [`Rasterizer`] and adds them to the list.
//!
//! The list is one for the process. A profile is read by serde in several places (TOML, the manifest of a
//! set), none of which could be handed a list; so it is extended once, before the first profile is read.

use super::list::{kinds, unknown};
use super::{Form, Kind, Rasterizer};
use crate::cover::TraversalConfig;
use crate::setup::VertexConfig;
use crate::value::DepthConfig;
use serde::de::{DeserializeOwned, Error as _, VariantAccess};
use serde::{Serialize, Serializer};
use std::any::Any;
use std::sync::OnceLock;

/// A machine to add to the list.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    kind: &'static Kind,
    read: fn(toml::Table) -> Result<Form, String>,
}

/// Why machines were not added.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AddError {
    /// A machine of that name is there already.
    #[error("the machine {0:?} already exists: give your machine another name")]
    Name(&'static str),
    /// A name that no profile could be asked for.
    #[error("the machine {0:?}: a name contains only a-z, 0-9 and -, and begins with a letter")]
    Spelling(&'static str),
    /// A decision that belongs to another part of a profile.
    #[error(
        "the machine {machine:?} lists the decision {decision:?}, but the {owner} already has a decision of this name; choose another name"
    )]
    Decision {
        /// The machine.
        machine: &'static str,
        /// Its decision.
        decision: &'static str,
        /// Whose it is.
        owner: &'static str,
    },
    /// The list was extended before.
    #[error(
        "machines were already added: add all machines in one call, before the first profile is read"
    )]
    Twice,
}

static OWN: OnceLock<Vec<Own>> = OnceLock::new();

/// The machines that were added.
pub(super) fn own_machines() -> &'static [Own] {
    OWN.get().map_or(&[], Vec::as_slice)
}

/// Reads the configuration of an added machine.
pub(super) fn read<'de, A: VariantAccess<'de>>(name: &str, from: A) -> Result<Form, A::Error> {
    match own_machines().iter().find(|own| own.kind.name == name) {
        Some(own) => own.read(from.newtype_variant()?).map_err(A::Error::custom),
        None => Err(A::Error::custom(unknown(name))),
    }
}

/// Adds machines to the list, once in a process and before a profile is read.
///
/// # Errors
/// [`AddError`] if a name is taken or malformed, or the list was extended before; nothing is added then.
pub fn add(machines: &[Own]) -> Result<(), AddError> {
    for (n, own) in machines.iter().enumerate() {
        let Kind { name, decisions, .. } = *own.kind;
        let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(legal) {
            return Err(AddError::Spelling(name));
        }
        let mut before = kinds().chain(machines[..n].iter().map(Own::kind));
        if before.any(|kind| kind.name == name) {
            return Err(AddError::Name(name));
        }
        let owners = [
            ("vertex field", VertexConfig::DECISIONS),
            ("traversal", TraversalConfig::DECISIONS),
            ("depth plane", DepthConfig::DECISIONS),
        ];
        for decision in decisions {
            let taken =
                owners.iter().find(|(_, list)| list.iter().any(|d| d.name == decision.name));
            if let Some((owner, _)) = taken {
                return Err(AddError::Decision { machine: name, decision: decision.name, owner });
            }
        }
    }
    if machines.is_empty() {
        return Ok(());
    }
    OWN.set(machines.to_vec()).map_err(|_| AddError::Twice)
}

impl Own {
    /// The machine with this configuration.
    pub const fn of<C>(kind: &'static Kind) -> Self
    where
        C: Rasterizer + Clone + PartialEq + Serialize + DeserializeOwned + 'static,
    {
        Self { kind, read: |table| table.try_into::<C>().map(Form::own).map_err(|e| e.to_string()) }
    }

    /// What is known of it.
    pub const fn kind(&self) -> &'static Kind {
        self.kind
    }

    /// Reads its table.
    fn read(&self, table: toml::Table) -> Result<Form, String> {
        (self.read)(table).map_err(|error| error.trim_end().replace('\n', " "))
    }
}

impl Form {
    /// A machine that is not built in.
    pub fn own<C>(config: C) -> Self
    where
        C: Rasterizer + Clone + PartialEq + Serialize + 'static,
    {
        Self::Own(OwnForm(Box::new(config)))
    }
}

/// The configuration of a machine that is not built in.
#[derive(Debug)]
pub struct OwnForm(Box<dyn Erased>);

/// A configuration of any type. What the compiler derives for a known type is asked here.
trait Erased: Rasterizer + Any {
    fn copy(&self) -> Box<dyn Erased>;
    fn is_equal(&self, other: &dyn Any) -> bool;
    fn table(&self) -> Result<toml::Value, String>;
    fn rasterizer(&self) -> &(dyn Rasterizer + 'static);
    fn rasterizer_mut(&mut self) -> &mut (dyn Rasterizer + 'static);
    fn any(&self) -> &dyn Any;
}

impl<C: Rasterizer + Clone + PartialEq + Serialize + 'static> Erased for C {
    fn copy(&self) -> Box<dyn Erased> {
        Box::new(self.clone())
    }

    fn is_equal(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<C>().is_some_and(|other| self == other)
    }

    fn table(&self) -> Result<toml::Value, String> {
        toml::Value::try_from(self).map_err(|error| error.to_string())
    }

    fn rasterizer(&self) -> &(dyn Rasterizer + 'static) {
        self
    }

    fn rasterizer_mut(&mut self) -> &mut (dyn Rasterizer + 'static) {
        self
    }

    fn any(&self) -> &dyn Any {
        self
    }
}

impl OwnForm {
    pub(super) fn rasterizer(&self) -> &(dyn Rasterizer + 'static) {
        self.0.rasterizer()
    }

    pub(super) fn rasterizer_mut(&mut self) -> &mut (dyn Rasterizer + 'static) {
        self.0.rasterizer_mut()
    }

    /// The configuration, if it is of this type.
    pub fn config<C: 'static>(&self) -> Option<&C> {
        self.0.any().downcast_ref()
    }
}

impl Clone for OwnForm {
    fn clone(&self) -> Self {
        Self(self.0.copy())
    }
}

impl PartialEq for OwnForm {
    fn eq(&self, other: &Self) -> bool {
        self.0.is_equal(other.0.any())
    }
}

impl Eq for OwnForm {}

impl Serialize for OwnForm {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.0.table().map_err(serde::ser::Error::custom)?.serialize(to)
    }
}
