//! Whether a map fits the ports of a module.

use super::{Map, MapError, Wiring};
use crate::vector::equivalence::netlist::Port;
use crate::vector::equivalence::unit::{ANY, Block, Unit};

impl Map {
    /// Whether each port is there, as wide as its signal, and each input of the module driven.
    pub(in crate::vector::equivalence) fn fits(
        &self,
        unit: &Unit,
        ports: &[Port],
    ) -> Result<Wiring, MapError> {
        let names: Vec<&str> = unit.signals.iter().map(|signal| signal.name).collect();
        if let Some(name) = self.ports.keys().find(|name| !names.contains(&name.as_str())) {
            let there = names.join(", ");
            return Err(
                self.wrong(format!("[ports] {name}: there is no such signal; there are {there}"))
            );
        }
        if self.latency > 63 {
            return Err(self.wrong(format!("latency = {}: 0 to 63 clocks", self.latency)));
        }
        let operations = unit.block.operations();
        if unit.block == Block::SetUp {
            return self.fits_words(unit, ports);
        }
        if self.division.is_some() && unit.block != Block::Divider {
            return Err(self.wrong("[division] belongs to the block divider".to_owned()));
        }
        if unit.block == Block::Divider {
            self.divides(ports)?;
        }
        let has_clk = ports.iter().any(|port| port.name == "clk");
        let clocked = unit.block.is_clocked() || has_clk;
        let clock = self.clock.clone().or_else(|| clocked.then(|| "clk".to_owned()));
        if let Some(clock) = &clock {
            self.port(ports, ("clock", clock), false, 1)?;
        }
        if let Some(reset) = &self.reset {
            self.port(ports, ("reset", &reset.port), false, 1)?;
        }
        if self.held && operations.is_empty() {
            return Err(self.wrong("held = true: the unit has no operation that loads".to_owned()));
        }
        let op = self.ports.get("op").and_then(|op| ports.iter().find(|port| port.name == *op));
        let code_bits = op.map_or(2, |port| port.width);
        for signal in &unit.signals {
            let width = if signal.name == "op" { code_bits } else { signal.width };
            match self.ports.get(signal.name) {
                Some(port) if width == ANY => {
                    let own = ports.iter().find(|other| other.name == *port);
                    let own = own.map_or(1, |port| port.width);
                    self.port(ports, (signal.name, port), signal.output, own)?;
                }
                Some(port) => self.port(ports, (signal.name, port), signal.output, width)?,
                None if signal.output => {}
                None => {
                    let name = signal.name;
                    return Err(self.wrong(format!("[ports] has no {name}: which port takes it?")));
                }
            }
        }
        if !unit.signals.iter().any(|signal| signal.output && self.ports.contains_key(signal.name))
        {
            return Err(self.wrong("[ports] has no output: nothing would be compared".to_owned()));
        }
        self.has_codes(unit, code_bits)?;
        self.drives(clock.as_ref(), ports)?;
        Ok(Wiring { clock, code_bits })
    }

    /// Whether a divider has what its protocol needs.
    fn divides(&self, ports: &[Port]) -> Result<(), MapError> {
        let has = |signal: &str| self.ports.contains_key(signal);
        if self.reset.is_none() {
            return Err(self.wrong("a divider needs [reset]".to_owned()));
        }
        if self.latency > 0 {
            return Err(self.wrong("a divider says when it ends: it has no latency".to_owned()));
        }
        if !has("quotient") || has("busy") == has("done") {
            return Err(self.wrong("[ports] needs quotient, and one of busy and done".to_owned()));
        }
        for (name, wire) in self.division.iter().flat_map(|steps| &steps.wires) {
            if name.starts_with("ref_") || name.contains('.') {
                return Err(self.wrong(format!(
                    "[division.wires] {name}: names with a point or beginning with ref_ are the reference's"
                )));
            }
            if ports.iter().any(|port| port.name == *wire) {
                return Err(self.wrong(format!(
                    "[division.wires] {name}: {wire} is a port; only wires inside can be named"
                )));
            }
        }
        Ok(())
    }

    /// The same for words that are read from the netlist: outputs are also wires, inputs that no output needs may be
    /// left out, and what is not named is looked at if a word depends on it.
    fn fits_words(&self, unit: &Unit, ports: &[Port]) -> Result<Wiring, MapError> {
        let has = |name: &str| self.ports.contains_key(name);
        let needs_depth =
            unit.signals.iter().any(|signal| signal.name.starts_with("plane") && has(signal.name));
        for signal in unit.signals.iter().filter(|signal| !signal.output) {
            let name = signal.name;
            match self.ports.get(name) {
                Some(port) => self.port(ports, (name, port), false, signal.width)?,
                None if name.ends_with("_z") && !needs_depth => {}
                None => {
                    return Err(self.wrong(format!("[ports] has no {name}: which port takes it?")));
                }
            }
        }
        if self.latency > 63 {
            return Err(self.wrong(format!("latency = {}: 0 to 63 clocks", self.latency)));
        }
        let has_clk = ports.iter().any(|port| port.name == "clk");
        let clock = self.clock.clone().or_else(|| has_clk.then(|| "clk".to_owned()));
        if let Some(clock) = &clock {
            self.port(ports, ("clock", clock), false, 1)?;
        }
        if let Some(reset) = &self.reset {
            self.port(ports, ("reset", &reset.port), false, 1)?;
        }
        for name in self.constants.keys() {
            if !ports.iter().any(|port| port.name == *name && !port.output) {
                return Err(self.wrong(format!("[constants] {name}: the module has no such input")));
            }
        }
        let mut taken: Vec<&String> = self.ports.values().chain(self.constants.keys()).collect();
        taken.extend(self.reset.iter().map(|reset| &reset.port).chain(&clock));
        taken.sort_unstable();
        if let Some([twice, _]) = taken.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(self.wrong(format!("the port {twice} is named twice")));
        }
        Ok(Wiring { clock, code_bits: 0 })
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
    fn has_codes(&self, unit: &Unit, bits: u32) -> Result<(), MapError> {
        let operations = unit.block.operations();
        if let Some(name) = self.op.keys().find(|name| !operations.contains(&name.as_str())) {
            let there =
                if operations.is_empty() { "none".to_owned() } else { operations.join(", ") };
            return Err(
                self.wrong(format!("[op] {name}: there is no such operation; there are {there}"))
            );
        }
        if bits > 32 {
            return Err(self.wrong(format!("op has {bits} bits > 32")));
        }
        let codes = self.codes(unit);
        for (n, code) in codes.iter().enumerate() {
            let name = operations[n];
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
    fn drives(&self, clock: Option<&String>, ports: &[Port]) -> Result<(), MapError> {
        let reset = self.reset.as_ref().map(|reset| &reset.port);
        let mut taken: Vec<&String> = self.ports.values().chain(self.constants.keys()).collect();
        taken.extend(reset.into_iter().chain(clock));
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
}
