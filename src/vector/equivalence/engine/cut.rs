//! The engine without its registers: what they hold is an input, and what they take an output.

use super::draw::Draw;
use super::expect::{STREAMS, Texts};
use crate::vector::equivalence::netlist::{Bit, Cell, Flat};
use crate::vector::equivalence::simulate::Simulation;
use num_traits::{One, Zero};
use serde_json::{Value, json};

/// Triangles that are drawn to see which bits of the state are known where one begins.
const TRIANGLES: u64 = 40;

/// The bits that all registers hold, and those that they take.
pub(super) fn registers(flat: &Flat) -> (Vec<Bit>, Vec<Bit>) {
    let registers = flat.cells.values().filter(|cell| cell.is_register());
    let (mut held, mut taken) = (Vec::new(), Vec::new());
    for cell in registers {
        held.extend(cell.output());
        taken.extend(&cell.wires["D"]);
    }
    (held, taken)
}

/// The netlist of yosys with its registers cut, as yosys reads it.
pub(super) fn cut(text: &str, flat: &Flat) -> Result<String, String> {
    let odd = || "the netlist of yosys is not as expected".to_owned();
    let mut netlist: Value = serde_json::from_str(text).map_err(|_| odd())?;
    let module = netlist.pointer_mut("/modules/guardbit_core").ok_or_else(odd)?;
    let cells = module.get_mut("cells").and_then(Value::as_object_mut).ok_or_else(odd)?;
    for (name, _) in flat.cells.iter().filter(|(_, cell)| Cell::is_register(cell)) {
        cells.remove(name).ok_or_else(odd)?;
    }
    let (held, taken) = registers(flat);
    let bits = |bits: &[Bit]| -> Value {
        let bit = |bit: &Bit| match bit {
            Bit::Net(net) => json!(net),
            Bit::Zero => json!("0"),
            Bit::One => json!("1"),
            Bit::Free => json!("x"),
        };
        bits.iter().map(bit).collect()
    };
    for (name, direction, wires) in
        [("guardbit_state", "input", &held), ("guardbit_next", "output", &taken)]
    {
        module["ports"][name] = json!({ "direction": direction, "bits": bits(wires) });
        module["netnames"][name] = json!({ "hide_name": 0, "bits": bits(wires), "attributes": {} });
    }
    Ok(netlist.to_string())
}

/// The sides of a box, by name.
pub(super) type Sides = [(&'static str, u64); 4];

impl Texts<'_> {
    /// The bits of the state that are known where a triangle begins: they are the same after each reset and after each
    /// triangle, as far as some show; a proof follows. `Err`: a triangle does not end.
    pub(super) fn known(&self, flat: &Flat) -> Result<Result<Vec<Option<bool>>, String>, String> {
        let (held, _) = registers(flat);
        let mut draw = Draw(1);
        let mut known: Option<Vec<Option<bool>>> = None;
        let mut simulation = Simulation::new(flat).clocked();
        let mut meets = |simulation: &Simulation<'_>| {
            let now = held.iter().map(|bit| simulation.held(*bit));
            known = Some(match known.take() {
                None => now.collect(),
                Some(before) => {
                    before.into_iter().zip(now).map(|(a, b)| a.filter(|_| a == b)).collect()
                }
            });
        };
        for n in 0..TRIANGLES {
            simulation.hold(held.iter().map(|bit| (*bit, draw.below(2) == 1)));
            let sides = self.sides(n, &mut Draw(1 + n / 2));
            simulation.set(self.given(sides, n, None));
            simulation.clock();
            meets(&simulation);
            if let Err(why) = self.end(flat, &mut simulation, sides, n)? {
                return Ok(Err(why));
            }
            meets(&simulation);
        }
        Ok(Ok(known.unwrap_or_default()))
    }

    /// The most clocks that some triangles take in a box, with every ready high. `Err`: one does not end.
    pub(super) fn clocks(&self, flat: &Flat, sides: Sides) -> Result<Result<u32, String>, String> {
        let mut simulation = Simulation::new(flat).clocked();
        let mut most = 0;
        // Every sample is covered, none is, and some are.
        for n in 0..4 {
            simulation.set(self.given(sides, n, None));
            simulation.clock();
            match self.end(flat, &mut simulation, sides, n)? {
                Ok(clocks) => most = most.max(clocks),
                Err(why) => return Ok(Err(why)),
            }
        }
        Ok(Ok(most))
    }

    /// Gives a triangle to an engine that has been reset, until it is ready for the next one: after how many clocks.
    fn end(
        &self,
        flat: &Flat,
        simulation: &mut Simulation<'_>,
        sides: Sides,
        n: u64,
    ) -> Result<Result<u32, String>, String> {
        let [columns, rows] = self.window;
        let limit = 64 * columns * rows + 256;
        let map = self.asked.map;
        let (mut taken, mut ended) = (false, false);
        for clock in 0..limit {
            simulation.set(self.given(sides, n, Some(!taken)));
            let mut high = |signal: &str| {
                let port = &map.ports[signal];
                let bits = flat.ports.get(port).map(|port| port.bits.as_slice());
                let number = bits.and_then(|bits| simulation.number(bits));
                number
                    .map(|number| !number.is_zero())
                    .ok_or_else(|| format!("{port}: a cell before it has no plain reading here"))
            };
            let (ready, last) = (high("in_ready")?, high("triangle_valid")?);
            if ended && ready {
                return Ok(Ok(clock));
            }
            taken |= ready;
            ended |= last && taken;
            simulation.clock();
        }
        Ok(Err(format!("with every ready high, a triangle does not end within {limit} clocks")))
    }

    /// The inputs of the engine alone: in reset, or with a triangle that is valid or not. The first two triangles
    /// cover all samples and none.
    fn given(&self, sides: Sides, n: u64, valid: Option<bool>) -> Vec<(&str, i128)> {
        let map = self.asked.map;
        let mut draw = Draw(n);
        let mut list: Vec<(&str, i128)> = Vec::new();
        for word in self.words() {
            let value = match sides.iter().find(|(side, _)| *side == word.name) {
                Some((_, value)) => i128::from(*value),
                None if word.name == "zero_area" => i128::from(n % 8 == 7),
                None if n == 0 => 0,
                None if n == 1 && word.name.ends_with("_init") => {
                    i128::one() << (word.width - 1).min(126)
                }
                None if n == 1 => 0,
                None => draw.word(word.width),
            };
            list.push((map.ports[word.name].as_str(), value));
        }
        let port = map
            .reset
            .iter()
            .map(|port| (port.port.as_str(), i128::from(valid.is_none() != port.active_low)));
        list.extend(port);
        list.extend(map.constants.iter().map(|(port, value)| (port.as_str(), i128::from(*value))));
        list.push((map.ports["in_valid"].as_str(), i128::from(valid == Some(true))));
        let readies = STREAMS.iter().filter_map(|stream| map.ports.get(&format!("{stream}_ready")));
        list.extend(readies.map(|port| (port.as_str(), 1)));
        list
    }

    /// The sides of a box: the whole window first.
    pub(super) fn sides(&self, n: u64, draw: &mut Draw) -> Sides {
        let [columns, rows] = self.window.map(u64::from);
        let mut pair = |size: u64| {
            if n % 4 < 2 {
                return [0, size];
            }
            let [a, b] = [draw.below(size + 1), draw.below(size + 1)];
            [a.min(b), a.max(b)]
        };
        let [[top, bottom], [left, right]] = [pair(rows), pair(columns)];
        [("box_y_begin", top), ("box_y_end", bottom), ("box_x_begin", left), ("box_x_end", right)]
    }
}
