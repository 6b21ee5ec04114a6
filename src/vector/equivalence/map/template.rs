//! A map to begin with.

use super::Map;
use crate::vector::equivalence::netlist::Port;
use crate::vector::equivalence::unit::Unit;
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
        text += "latency = 0         # clocks that the outputs come late\n";
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
        for signal in &unit.signals {
            let port = find(&[signal.name, signal.port]).map_or("?", |port| &port.name);
            let _ = writeln!(text, "{} = \"{port}\"", signal.name);
        }
        if !operations.is_empty() {
            text += "\n[op]\n";
            for (code, name) in operations.iter().enumerate() {
                let _ = writeln!(text, "{name} = {code}");
            }
        }
        text += "\n# [constants]         # inputs that stand still\n# enable = 1\n\n# [parameters]\n# WIDTH = 39\n";
        text
    }
}
