//! Whether a map fits the ports of a module.

use super::{Map, MapError, Wiring};
use crate::vector::equivalence::Signal;
use crate::vector::equivalence::netlist::Port;
use crate::vector::equivalence::unit::{ANY, Block, Unit};

impl Map {
    /// Whether each port is there, as wide as its signal, and each input of the module driven. The words of a set-up are
    /// read from the netlist: its outputs are wires, too, and what is not named is looked at if a word depends on it.
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
        if unit.block == Block::Divider {
            self.divides(ports)?;
        } else if self.division.is_some() {
            return Err(self.wrong("[division] belongs to the block divider".to_owned()));
        }
        if unit.block == Block::Engine {
            self.streams()?;
        }
        if self.held && unit.block.operations().is_empty() {
            return Err(self.wrong("held = true: the unit has no operation that loads".to_owned()));
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
        let code_bits = self.signals(unit, ports)?;
        self.has_codes(unit, code_bits)?;
        self.drives(unit.block, clock.as_ref(), ports)?;
        Ok(Wiring { clock, code_bits })
    }

    /// Whether signals have their ports. Gives the bits of the operation's port.
    fn signals(&self, unit: &Unit, ports: &[Port]) -> Result<u32, MapError> {
        let width_of =
            |name: &String| ports.iter().find(|port| port.name == *name).map(|port| port.width);
        let has = |name: &str| self.ports.contains_key(name);
        let outputs = || unit.signals.iter().filter(|signal| signal.output && has(signal.name));
        let in_netlist = unit.block == Block::SetUp;
        let in_engine = unit.block == Block::Engine;
        let absent = |stream: &str| !has(&format!("{stream}_valid"));
        let needs_depth = outputs().any(|signal| signal.name.starts_with("plane"));
        let code_bits = self.ports.get("op").and_then(width_of).unwrap_or(2);
        for Signal { name, width, output, .. } in &unit.signals {
            match self.ports.get(*name) {
                Some(_) if in_netlist && *output => {}
                Some(port) => {
                    let width = match *width {
                        _ if *name == "op" => code_bits,
                        ANY => width_of(port).unwrap_or(1),
                        width => width,
                    };
                    self.port(ports, (name, port), *output, width)?;
                }
                None if *output => {}
                None if in_netlist && name.ends_with("_z") && !needs_depth => {}
                // A stream that is not there is never ready, and a number may not be taken along.
                None if in_engine
                    && (*name == "test" || name.strip_suffix("_ready").is_some_and(absent)) => {}
                None => {
                    return Err(self.wrong(format!("[ports] has no {name}: which port takes it?")));
                }
            }
        }
        if outputs().next().is_none() {
            return Err(self.wrong("[ports] has no output: nothing would be compared".to_owned()));
        }
        Ok(code_bits)
    }

    /// Whether an engine has what its protocol needs.
    fn streams(&self) -> Result<(), MapError> {
        let has = |signal: &str| self.ports.contains_key(signal);
        if self.reset.is_none() {
            return Err(self.wrong("an engine needs [reset]".to_owned()));
        }
        if self.latency > 0 {
            return Err(self.wrong("an engine has valid and ready: it has no latency".to_owned()));
        }
        let lacks = |name: &str| self.wrong(format!("[ports] has no {name}"));
        for name in ["in_ready", "triangle_valid"] {
            has(name).then_some(()).ok_or_else(|| lacks(name))?;
        }
        for (stream, keys) in [
            ("span", &["span_y", "span_x_begin", "span_x_end"][..]),
            ("sample", &["sample_y", "sample_x"]),
        ] {
            let valid = format!("{stream}_valid");
            let prefix = format!("{stream}_");
            match self.ports.keys().find(|name| name.starts_with(&prefix)) {
                None => {}
                Some(name) if !has(&valid) => {
                    return Err(self.wrong(format!("[ports] has {name} and no {valid}")));
                }
                Some(_) => {
                    for key in keys {
                        has(key).then_some(()).ok_or_else(|| lacks(key))?;
                    }
                }
            }
        }
        if !has("span_valid") && !has("sample_valid") {
            return Err(self.wrong(
                "[ports] has neither span_valid nor sample_valid: nothing would be compared"
                    .to_owned(),
            ));
        }
        if !has("test") && self.ports.keys().any(|name| name.ends_with("_test")) {
            return Err(lacks("test"));
        }
        Ok(())
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
            if name.contains('.') {
                return Err(self.wrong(format!("[division.wires] {name}: a name without a point")));
            }
            if ports.iter().any(|port| port.name == *wire) {
                return Err(self.wrong(format!(
                    "[division.wires] {name}: {wire} is a port; the quotient is got_quotient in lemmas, and busy or \
                     done got_busy or got_done"
                )));
            }
        }
        Ok(())
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
    fn drives(&self, block: Block, clock: Option<&String>, ports: &[Port]) -> Result<(), MapError> {
        let reset = self.reset.as_ref().map(|reset| &reset.port);
        let mut taken: Vec<&String> = self.ports.values().chain(self.constants.keys()).collect();
        taken.extend(reset.into_iter().chain(clock));
        let free = ports.iter().find(|port| !port.output && !taken.contains(&&port.name));
        if let Some(port) = free.filter(|_| block != Block::SetUp) {
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
