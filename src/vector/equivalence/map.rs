//! How the ports of a user's module are the signals of a unit.

use super::{Block, Port, Signal};
use crate::format::ReadOut;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A map of ports, as TOML has it.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Map {
    /// The module.
    pub module: String,
    /// The port of its clock.
    #[serde(default = "clk")]
    pub clock: String,
    /// Its reset, if it has one.
    pub reset: Option<Reset>,
    /// Clocks that its outputs come late.
    #[serde(default)]
    pub latency: u32,
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
    pub parameters: BTreeMap<String, i64>,
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

fn clk() -> String {
    "clk".to_owned()
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

const OPERATIONS: [&str; 4] = ["load", "step-x", "step-y", "hold"];

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
    pub(super) fn of_devices(
        block: Block,
        signals: &[Signal; 6],
        [read, edge]: [ReadOut; 2],
    ) -> Self {
        let parameters = match block {
            Block::Dda => vec![
                ("G", read.guard()),
                ("I", read.integer()),
                ("F", read.fraction()),
                ("MODE", read.clamp().code()),
            ],
            Block::EdgeStepper => vec![("M", edge.width())],
        };
        let parameters =
            parameters.into_iter().map(|(name, value)| (name.to_owned(), value.into()));
        Self {
            module: block.module().to_owned(),
            clock: clk(),
            reset: Some(Reset { port: "rst".to_owned(), active_low: false }),
            latency: 0,
            ports: signals.iter().map(|s| (s.name.to_owned(), s.port.to_owned())).collect(),
            op: BTreeMap::new(),
            constants: BTreeMap::new(),
            parameters: parameters.collect(),
        }
    }

    /// The codes of load, step right, step down, hold.
    pub(super) fn codes(&self) -> [u32; 4] {
        let mut own = 0..;
        OPERATIONS.map(|name| {
            let own = own.next().unwrap_or_default();
            self.op.get(name).copied().unwrap_or(own)
        })
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
        let names = [&self.module, &self.clock].into_iter().chain(reset).chain(self.ports.values());
        for name in names.chain(self.constants.keys()).chain(self.parameters.keys()) {
            let begins = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
            if !begins || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
                return Err(
                    self.wrong(format!("{name:?} is no name: letters, digits and underscores"))
                );
            }
        }
        Ok(())
    }

    /// Whether each port is there, as wide as its signal, and each input of the module driven. Gives the bits of
    /// the operation's port.
    pub(super) fn fits(&self, signals: &[Signal; 6], ports: &[Port]) -> Result<u32, MapError> {
        let names: Vec<&str> = signals.iter().map(|signal| signal.name).collect();
        if let Some(name) = self.ports.keys().find(|name| !names.contains(&name.as_str())) {
            let there = names.join(", ");
            return Err(
                self.wrong(format!("[ports] {name}: there is no such signal; there are {there}"))
            );
        }
        if self.latency > 63 {
            return Err(self.wrong(format!("latency = {}: 0 to 63 clocks", self.latency)));
        }
        self.port(ports, ("clock", &self.clock), false, 1)?;
        if let Some(reset) = &self.reset {
            self.port(ports, ("reset", &reset.port), false, 1)?;
        }
        let op = self.ports.get("op").and_then(|op| ports.iter().find(|port| port.name == *op));
        let code_bits = op.map_or(2, |port| port.width);
        for signal in signals {
            let width = if signal.name == "op" { code_bits } else { signal.width };
            match self.ports.get(signal.name) {
                Some(port) => self.port(ports, (signal.name, port), signal.output, width)?,
                None if signal.output => {}
                None => {
                    let name = signal.name;
                    return Err(self.wrong(format!("[ports] has no {name}: which port takes it?")));
                }
            }
        }
        if !signals.iter().any(|signal| signal.output && self.ports.contains_key(signal.name)) {
            return Err(self.wrong("[ports] has no output: nothing would be compared".to_owned()));
        }
        self.has_codes(code_bits)?;
        self.drives(ports)?;
        Ok(code_bits)
    }

    /// Whether a port is there, and is what a signal needs.
    fn port(
        &self,
        ports: &[Port],
        (what, name): (&str, &str),
        output: bool,
        width: u32,
    ) -> Result<(), MapError> {
        let Some(port) = ports.iter().find(|port| port.name == name) else {
            let there: Vec<&str> = ports.iter().map(|port| port.name.as_str()).collect();
            let there = there.join(", ");
            return Err(
                self.wrong(format!("{what}: the module has no port {name}; it has {there}"))
            );
        };
        if port.output != output {
            let [is, wanted] =
                if output { ["an input", "an output"] } else { ["an output", "an input"] };
            return Err(
                self.wrong(format!("{what}: the port {name} is {is}, and {wanted} is wanted"))
            );
        }
        if port.width != width {
            return Err(self.wrong(format!(
                "{what}: the port {name} has {} bits != {width}, the width in the profile; set the module's \
                 parameters in [parameters]",
                port.width
            )));
        }
        Ok(())
    }

    /// Whether operations have codes of their own.
    fn has_codes(&self, bits: u32) -> Result<(), MapError> {
        if let Some(name) = self.op.keys().find(|name| !OPERATIONS.contains(&name.as_str())) {
            let there = OPERATIONS.join(", ");
            return Err(
                self.wrong(format!("[op] {name}: there is no such operation; there are {there}"))
            );
        }
        if bits > 32 {
            return Err(self.wrong(format!("op has {bits} bits > 32")));
        }
        let codes = self.codes();
        for (n, code) in codes.iter().enumerate() {
            let name = OPERATIONS[n];
            if bits < 32 && code >> bits != 0 {
                return Err(self.wrong(format!("[op] {name} = {code} >= 2^{bits}")));
            }
            if codes[..n].contains(code) {
                return Err(self
                    .wrong(format!("[op] {name} = {code} is the code of another operation, too")));
            }
        }
        Ok(())
    }

    /// Whether each input is driven, and by one thing.
    fn drives(&self, ports: &[Port]) -> Result<(), MapError> {
        let reset = self.reset.as_ref().map(|reset| &reset.port);
        let mut taken: Vec<&String> = self.ports.values().chain(self.constants.keys()).collect();
        taken.extend(reset.into_iter().chain([&self.clock]));
        if let Some(port) = ports.iter().find(|port| !port.output && !taken.contains(&&port.name)) {
            return Err(self.wrong(format!(
                "nothing drives the input {}: name it in [ports], or give it a value in [constants]",
                port.name
            )));
        }
        for (name, value) in &self.constants {
            let Some(port) = ports.iter().find(|port| port.name == *name && !port.output) else {
                return Err(self.wrong(format!("[constants] {name}: the module has no such input")));
            };
            if port.width < 64 && value >> port.width != 0 {
                let width = port.width;
                return Err(self.wrong(format!("[constants] {name} = {value} >= 2^{width}")));
            }
        }
        taken.sort_unstable();
        if let Some([twice, _]) = taken.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(self.wrong(format!("the port {twice} is named twice")));
        }
        Ok(())
    }

    /// What a proof under this map takes for granted.
    pub(super) fn assumed(&self) -> Vec<String> {
        let mut list =
            vec!["all state changes at the rising edge of one clock, or at a reset".to_owned()];
        if self.reset.is_some() {
            list.push("the first clock is a reset; resets may come at any later clock".to_owned());
            list.push("nothing is compared at a clock with a reset".to_owned());
        } else {
            list.push("nothing is compared before the first load".to_owned());
        }
        if self.latency > 0 {
            let after = if self.reset.is_some() { "a reset" } else { "the first load" };
            let clocks = if self.latency == 1 { "clock" } else { "clocks" };
            list.push(format!("nothing is compared for {} {clocks} after {after}", self.latency));
        }
        list.extend(
            self.constants.iter().map(|(port, value)| format!("{port} is {value} at every clock")),
        );
        list
    }

    /// A map to begin with, from the ports of a module.
    pub fn template(block: Block, module: &str, ports: &[Port]) -> String {
        let mut text = format!("# A map for guardbit prove --rtl: the ports of {module}\n");
        for port in ports {
            let way = if port.output { "output" } else { "input" };
            let _ = writeln!(text, "#   {way} {}, {} bits", port.name, port.width);
        }
        let find = |names: &[&str]| {
            ports.iter().find(|port| names.iter().any(|name| port.name.eq_ignore_ascii_case(name)))
        };
        let _ = writeln!(text, "module = \"{module}\"");
        let clock = find(&["clk", "clock", "clk_i", "i_clk"]).map_or("?", |port| &port.name);
        let _ = writeln!(
            text,
            "clock = \"{clock}\"\nlatency = 0         # clocks that the outputs come late"
        );
        let high = find(&["rst", "reset", "rst_i", "i_rst"]);
        let low = find(&["rst_n", "rstn", "resetn", "reset_n", "rst_ni", "aresetn"]);
        text += "\n# Without this table nothing is compared before the first load.\n";
        match (high, low) {
            (Some(port), _) => {
                let _ = writeln!(text, "[reset]\nport = \"{}\"\nactive-low = false", port.name);
            }
            (None, Some(port)) => {
                let _ = writeln!(text, "[reset]\nport = \"{}\"\nactive-low = true", port.name);
            }
            (None, None) => text += "# [reset]\n# port = \"?\"\n# active-low = false\n",
        }
        text += "\n# The port of each signal; an output may be left out.\n[ports]\n";
        for signal in block.signals([1, 1]) {
            let port = find(&[signal.name, signal.port]).map_or("?", |port| &port.name);
            let _ = writeln!(text, "{} = \"{port}\"", signal.name);
        }
        text += "\n[op]\nload = 0\nstep-x = 1\nstep-y = 2\nhold = 3\n";
        text += "\n# [constants]         # inputs that stand still\n# enable = 1\n\n# [parameters]\n# WIDTH = 39\n";
        text
    }
}
