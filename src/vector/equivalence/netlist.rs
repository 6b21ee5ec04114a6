//! What yosys writes of a design as JSON: its ports, and the cells that no proof here takes.

use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// A port of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Port {
    /// Its name.
    pub(super) name: String,
    /// Its bits.
    pub(super) width: u32,
    /// Whether the module drives it.
    pub(super) output: bool,
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
    cells: BTreeMap<String, JsonCell>,
    #[serde(default)]
    netnames: BTreeMap<String, NetName>,
}

#[derive(Deserialize)]
struct NetName {
    bits: Vec<serde_json::Value>,
}

#[derive(Deserialize)]
struct JsonPort {
    direction: String,
    bits: Vec<serde_json::Value>,
}

#[derive(Deserialize)]
struct JsonCell {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    attributes: BTreeMap<String, serde_json::Value>,
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

/// A bit of a flat netlist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bit {
    /// A wire.
    Net(u64),
    /// 0.
    Zero,
    /// 1.
    One,
    /// X, or nothing.
    Free,
}

/// A cell of yosys.
pub(super) struct Cell {
    pub(super) kind: String,
    /// Where it is from.
    pub(super) src: Option<String>,
    /// Parameters that are not zero.
    flags: BTreeSet<String>,
    pub(super) wires: BTreeMap<String, Vec<Bit>>,
}

impl Cell {
    /// Whether a parameter is not zero.
    pub(super) fn is(&self, parameter: &str) -> bool {
        self.flags.contains(parameter)
    }

    pub(super) fn is_register(&self) -> bool {
        self.kind.contains("dff")
    }

    /// What it drives.
    pub(super) fn output(&self) -> &[Bit] {
        self.wires.get("Y").or_else(|| self.wires.get("Q")).map_or(&[], Vec::as_slice)
    }

    /// Some bits of the output alone, if the cell works bit by bit.
    pub(super) fn part(&self, place: u32, count: u32) -> Option<Self> {
        let (inputs, output): (&[&str], _) = match self.kind.as_str() {
            "$mux" | "$and" | "$or" | "$xor" | "$xnor" => (&["A", "B"], "Y"),
            "$not" => (&["A"], "Y"),
            kind if kind.contains("dff") => (&["D"], "Q"),
            _ => return None,
        };
        let width = self.wires.get(output)?.len();
        let (from, to) = (place as usize, (place + count) as usize);
        let mut wires = self.wires.clone();
        for port in inputs.iter().chain([&output]) {
            let bits = wires.get_mut(*port).filter(|bits| bits.len() == width)?;
            *bits = bits.get(from..to)?.to_vec();
        }
        Some(Self {
            kind: self.kind.clone(),
            src: self.src.clone(),
            flags: self.flags.clone(),
            wires,
        })
    }
}

/// Bits of a name, lowest first.
pub(super) struct Wire {
    pub(super) bits: Vec<Bit>,
    pub(super) output: bool,
}

/// A flat module: its ports, all its names, and its cells.
pub(super) struct Flat {
    pub(super) ports: BTreeMap<String, Wire>,
    pub(super) names: BTreeMap<String, Vec<Bit>>,
    pub(super) cells: BTreeMap<String, Cell>,
}

impl Flat {
    /// The bits of a port or a wire.
    pub(super) fn wire(&self, name: &str) -> Option<&[Bit]> {
        let port = self.ports.get(name).map(|port| &port.bits);
        port.or_else(|| self.names.get(name)).map(Vec::as_slice)
    }

    /// Whether it has registers.
    pub(super) fn is_clocked(&self) -> bool {
        self.cells.values().any(Cell::is_register)
    }
}

fn bits(values: &[serde_json::Value]) -> Vec<Bit> {
    let bit = |value: &serde_json::Value| match (value.as_u64(), value.as_str()) {
        (Some(net), _) => Bit::Net(net),
        (_, Some("0")) => Bit::Zero,
        (_, Some("1")) => Bit::One,
        _ => Bit::Free,
    };
    values.iter().map(bit).collect()
}

/// A flat netlist with its bits.
pub(super) fn flat(text: &str) -> Result<Flat, String> {
    let (_, module) = parse(text)?;
    let ports = module.ports.into_iter();
    let wire = |port: JsonPort| Wire { bits: bits(&port.bits), output: port.direction == "output" };
    let is_set = |value: &serde_json::Value| value.as_str().is_some_and(|bits| bits.contains('1'));
    let cell = |cell: JsonCell| Cell {
        kind: cell.kind,
        src: cell.attributes.get("src").and_then(|src| src.as_str()).map(str::to_owned),
        flags: cell
            .parameters
            .into_iter()
            .filter(|(_, value)| is_set(value))
            .map(|(name, _)| name)
            .collect(),
        wires: cell.connections.into_iter().map(|(port, wires)| (port, bits(&wires))).collect(),
    };
    Ok(Flat {
        ports: ports.map(|(name, port)| (name, wire(port))).collect(),
        names: module.netnames.into_iter().map(|(name, net)| (name, bits(&net.bits))).collect(),
        cells: module.cells.into_iter().map(|(name, own)| (name, cell(own))).collect(),
    })
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
