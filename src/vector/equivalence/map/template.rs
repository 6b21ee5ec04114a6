//! A map to begin with.

use super::Map;
use crate::vector::equivalence::Signal;
use crate::vector::equivalence::netlist::Port;
use crate::vector::equivalence::unit::{ANY, Block, Unit};
use std::fmt::Write as _;

impl Map {
    /// A map to begin with, from the ports of a module.
    pub(in crate::vector::equivalence) fn template(
        unit: &Unit,
        module: &str,
        ports: &[Port],
    ) -> String {
        let mut text = format!("# A map for guardbit prove --rtl: the ports of {module}\n");
        for port in ports {
            let way = if port.output { "output" } else { "input" };
            let _ = writeln!(text, "#   {way} {}, {} bits", port.name, port.width);
        }
        let find = |names: &[&str]| {
            ports.iter().find(|port| names.iter().any(|name| port.name.eq_ignore_ascii_case(name)))
        };
        let _ = writeln!(text, "module = \"{module}\"");
        let operations = unit.block.operations();
        match find(&["clk", "clock", "clk_i", "i_clk"]) {
            Some(port) => text.extend(["clock = \"", &port.name, "\"\n"]),
            None if operations.is_empty() => {}
            None => text += "clock = \"?\"\n",
        }
        if !matches!(unit.block, Block::Divider | Block::Engine) {
            text += "latency = 0         # clocks that the outputs come late\n";
        }
        if let Some(load) = operations.first() {
            let _ = writeln!(
                text,
                "held = false        # true: inputs other than the operation change with {load} alone"
            );
        }
        let high = find(&["rst", "reset", "rst_i", "i_rst"]);
        let low = find(&["rst_n", "rstn", "resetn", "reset_n", "rst_ni", "aresetn"]);
        if let Some(load) = operations.first() {
            let _ = writeln!(
                text,
                "\n# Without this table nothing is compared before the first {load}."
            );
        }
        match (high, low) {
            (Some(port), _) => {
                let _ = writeln!(text, "[reset]\nport = \"{}\"\nactive-low = false", port.name);
            }
            (None, Some(port)) => {
                let _ = writeln!(text, "[reset]\nport = \"{}\"\nactive-low = true", port.name);
            }
            (None, None) if operations.is_empty() => {}
            (None, None) => text += "# [reset]\n# port = \"?\"\n# active-low = false\n",
        }
        text += "\n# The port of each signal; an output may be left out.\n[ports]\n";
        for Signal { name, port, width, output } in &unit.signals {
            match find(&[name, port]) {
                Some(port) => text.extend([name, " = \"", &port.name, "\"\n"]),
                // An output is needed by nobody.
                None if *output && *width == ANY && unit.block == Block::SetUp => {
                    let _ = writeln!(
                        text,
                        "# {name} = \"?\"         # of any width that holds it; a wire inside, too"
                    );
                }
                None if *output && *width != ANY => {
                    let _ = writeln!(text, "# {name} = \"?\"         # {width} bits");
                }
                None => text.extend([name, " = \"?\"\n"]),
            }
        }
        if !operations.is_empty() {
            text += "\n[op]\n";
            for (code, name) in operations.iter().enumerate() {
                let _ = writeln!(text, "{name} = {code}");
            }
        }
        if unit.block == Block::Divider {
            text += "\n[division]\nbits-per-clock = 1\nlead = 0            # clocks before the first step\n\
                     merged = true       # false: the quotient has a register of its own\n\
                     lemmas = [          # what registers mean; none are needed if they are those of long division\n    \
                     # \"left == ref_left\", \"!ref_known || remainder == ref_remainder\",\n]\n\n\
                     [division.wires]    # names in lemmas for wires inside the module\n# left = \"count\"\n# remainder = \"r\"\n";
        }
        text += "\n# [constants]         # inputs that stand still\n# enable = 1\n\n# [parameters]\n# WIDTH = 39\n";
        text
    }
}
