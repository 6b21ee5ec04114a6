//! How the ports of a user's module are the signals of a unit.

mod fit;
mod template;

use super::unit::{Block, Unit};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A map of ports, as TOML has it.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Map {
    /// The module.
    pub module: String,
    /// The port of its clock: `clk` if nothing is said, or none if the unit and the module have no register.
    pub clock: Option<String>,
    /// Its reset, if it has one.
    pub reset: Option<Reset>,
    /// Clocks that its outputs come late.
    #[serde(default)]
    pub latency: u32,
    /// Whether its other inputs change with the first operation alone, the one that loads.
    #[serde(default)]
    pub held: bool,
    /// The port of each signal.
    pub ports: BTreeMap<String, String>,
    /// The code of each operation.
    #[serde(default)]
    pub op: BTreeMap<String, u32>,
    /// Inputs that stand still.
    #[serde(default)]
    pub constants: BTreeMap<String, u64>,
    /// Parameters of the module.
    #[serde(default)]
    pub parameters: BTreeMap<String, i128>,
    /// How a divider goes about it.
    pub division: Option<Steps>,
}

/// The steps of a divider, and what its registers mean.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
pub struct Steps {
    /// Bits of the quotient a clock.
    pub bits_per_clock: u32,
    /// Clocks between the one that takes the operands and the first step.
    pub lead: u32,
    /// Whether the quotient is shifted into the register that the numerator leaves.
    pub merged: bool,
    /// Wires of the module, by the names that lemmas have for them.
    pub wires: BTreeMap<String, String>,
    /// Conditions in SystemVerilog that hold at every clock.
    pub lemmas: Vec<String>,
}

impl Default for Steps {
    fn default() -> Self {
        let (wires, lemmas) = (BTreeMap::new(), Vec::new());
        Self { bits_per_clock: 1, lead: 0, merged: true, wires, lemmas }
    }
}

/// A reset.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Reset {
    /// Its port.
    pub port: String,
    /// Whether the module is in reset while it is low.
    #[serde(default)]
    pub active_low: bool,
}

/// What the miter has to know of a module's ports.
pub(super) struct Wiring {
    /// The port of the clock.
    pub(super) clock: Option<String>,
    /// The bits of the operation's port.
    pub(super) code_bits: u32,
}

/// Why a map does not fit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the map of {module}: {what}")]
pub struct MapError {
    /// The module.
    pub module: String,
    /// What is wrong, and what to do.
    pub what: String,
}

impl Map {
    /// Reads a map.
    ///
    /// # Errors
    /// [`MapError`] with line and field if it is none.
    pub fn parse(text: &str) -> Result<Self, MapError> {
        toml::from_str(text).map_err(|error| MapError {
            module: "the module".to_owned(),
            what: error.to_string().trim().to_owned(),
        })
    }

    /// The map of a device of `hdl`, with a profile's parameters.
    pub(super) fn of_devices(unit: &Unit) -> Self {
        let parameters = unit.parameters.iter().map(|(name, value)| ((*name).to_owned(), *value));
        let signals = unit.signals.iter();
        let has_reset = unit.block != Block::ReadOut;
        Self {
            module: unit.block.module().to_owned(),
            clock: None,
            reset: has_reset.then(|| Reset { port: "rst".to_owned(), active_low: false }),
            latency: 0,
            held: false,
            ports: signals
                // The divider of `hdl` says when it is busy.
                .filter(|signal| signal.name != "done")
                .map(|signal| (signal.name.to_owned(), signal.port.to_owned()))
                .collect(),
            op: BTreeMap::new(),
            constants: BTreeMap::new(),
            parameters: parameters.collect(),
            division: None,
        }
    }

    /// The codes of a unit's operations.
    pub(super) fn codes(&self, unit: &Unit) -> Vec<u32> {
        let code = |(own, name): (u32, &&str)| self.op.get(*name).copied().unwrap_or(own);
        (0..).zip(unit.block.operations()).map(code).collect()
    }

    fn wrong(&self, what: String) -> MapError {
        MapError { module: self.module.clone(), what }
    }

    /// Whether its names are names: they stand in scripts of other programs.
    ///
    /// # Errors
    /// [`MapError`] with the name that is none.
    pub(super) fn is_spelt(&self) -> Result<(), MapError> {
        let reset = self.reset.as_ref().map(|reset| &reset.port);
        let names =
            [&self.module].into_iter().chain(&self.clock).chain(reset).chain(self.ports.values());
        let steps = self.division.iter();
        let wires = steps.clone().flat_map(|steps| steps.wires.iter().flat_map(|(a, b)| [a, b]));
        let names = names.chain(self.constants.keys()).chain(self.parameters.keys()).chain(wires);
        for name in names {
            let begins = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
            if !begins || !name.chars().all(|c| c.is_ascii_alphanumeric() || "_.".contains(c)) {
                return Err(
                    self.wrong(format!("{name:?} is no name: letters, digits and underscores"))
                );
            }
        }
        // Those of the texts that a proof writes.
        if self.module.starts_with("guardbit_") {
            return Err(self.wrong("a module's name may not begin with guardbit_".to_owned()));
        }
        for lemma in steps.flat_map(|steps| &steps.lemmas) {
            // It stands in parentheses, in one line of the miter.
            if lemma.contains([';', '`', '"', '\n', '\\'])
                || lemma.contains("//")
                || lemma.contains("/*")
            {
                return Err(self.wrong(format!("[division] the lemma {lemma:?} is no expression")));
            }
        }
        Ok(())
    }

    /// What a proof under this map takes for granted.
    pub(super) fn assumed(&self, unit: &Unit) -> Vec<String> {
        let mut list = Vec::new();
        let load = unit.block.operations().first();
        if load.is_some() {
            list.push(
                "all state changes at the rising edge of one clock, or at a reset".to_owned(),
            );
        }
        if self.reset.is_some() {
            list.push("the first clock is a reset; resets may come at any later clock".to_owned());
            list.push("nothing is compared at a clock with a reset".to_owned());
        }
        if let Some(load) = load.filter(|_| self.awaits_a_load()) {
            list.push(format!("nothing is compared before the first {load}"));
        }
        if let Some(load) = load.filter(|_| self.held) {
            list.push(format!("inputs other than the operation change with {load} alone"));
        }
        if self.latency > 0 {
            let after = match load {
                Some(load) if self.awaits_a_load() => format!("the first {load}"),
                _ => "a reset".to_owned(),
            };
            let clocks = if self.latency == 1 { "clock" } else { "clocks" };
            list.push(format!("nothing is compared for {} {clocks} after {after}", self.latency));
        }
        list.extend(
            self.constants.iter().map(|(port, value)| format!("{port} is {value} at every clock")),
        );
        list
    }

    /// Whether nothing is known of the module's state before a load.
    pub(super) fn awaits_a_load(&self) -> bool {
        self.reset.is_none() || self.held
    }
}
