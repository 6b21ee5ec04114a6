//! What yosys writes of a design as JSON: its ports, and the cells that no proof here takes.

use serde::Deserialize;
use std::collections::BTreeMap;

/// A port of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port {
    /// Its name.
    pub name: String,
    /// Its bits.
    pub width: u32,
    /// Whether the module drives it.
    pub output: bool,
}

#[derive(Deserialize)]
struct Netlist {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    #[serde(default)]
    attributes: BTreeMap<String, serde_json::Value>,
    ports: BTreeMap<String, JsonPort>,
    cells: BTreeMap<String, Cell>,
}

#[derive(Deserialize)]
struct JsonPort {
    direction: String,
    bits: Vec<serde_json::Value>,
}

#[derive(Deserialize)]
struct Cell {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    parameters: BTreeMap<String, serde_json::Value>,
    #[serde(default)]
    connections: BTreeMap<String, Vec<serde_json::Value>>,
}

fn parse(text: &str) -> Result<(String, Module), String> {
    let netlist: Netlist = serde_json::from_str(text)
        .map_err(|error| format!("the netlist of yosys is not as expected: {error}"))?;
    let mut modules = netlist.modules.into_iter();
    modules
        .find(|(_, module)| module.attributes.contains_key("top"))
        .ok_or_else(|| "yosys found no module at the top".to_owned())
}

/// The top module and its ports.
pub(super) fn top(text: &str) -> Result<(String, Vec<Port>), String> {
    let (name, module) = parse(text)?;
    let mut ports = Vec::new();
    for (name, port) in module.ports {
        if port.direction == "inout" {
            return Err(format!(
                "the port {name} goes both ways: wrap the module in one without it"
            ));
        }
        let width = u32::try_from(port.bits.len()).unwrap_or(u32::MAX);
        ports.push(Port { name, width, output: port.direction == "output" });
    }
    Ok((name, ports))
}

/// Whether a flat netlist has nothing but registers on the rising edge of the one clock, and gates.
pub(super) fn check(text: &str) -> Result<(), String> {
    let (_, module) = parse(text)?;
    let clock = module.ports.get("clk").map(|port| port.bits.clone()).unwrap_or_default();
    for (name, cell) in &module.cells {
        let kind = cell.kind.as_str();
        if kind.contains("latch") || kind == "$sr" {
            return Err(format!(
                "it has a latch ({name}): a proof takes registers alone; give each branch of the process a value. \
                 In VHDL take a GHDL newer than 2.0, which drops `when others` from the Verilog it writes"
            ));
        }
        if ["$assume", "$cover", "$live", "$fair", "$anyconst", "$allconst", "$allseq"]
            .contains(&kind)
        {
            return Err(format!("it has a {kind} of its own ({name}): take it out"));
        }
        if kind == "$ff" {
            return Err(format!("it has a register without a clock ({name})"));
        }
        let Some(driver) = cell.connections.get("CLK") else { continue };
        let rising = cell
            .parameters
            .get("CLK_POLARITY")
            .and_then(|value| value.as_str())
            .is_some_and(|value| value.ends_with('1'));
        if *driver != clock || !rising {
            return Err(format!(
                "a register ({name}) is not clocked by the rising edge of the map's clock: gated, divided or \
                 falling clocks are not proved here; wrap the module in one with enables"
            ));
        }
    }
    Ok(())
}
