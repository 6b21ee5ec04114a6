//! A flat netlist with numbers at its inputs: the plain reading of the cells that [`super::words`] reads as
//! polynomials. Registers are wires: what is asked for is what they take.

use super::netlist::{Bit, Cell, Flat};
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::HashMap;

/// A netlist with its inputs.
pub(super) struct Simulation<'a> {
    flat: &'a Flat,
    /// The cell that drives a net, and the place in its output.
    drivers: HashMap<u64, (&'a Cell, usize)>,
    /// Values of nets; `None` where a cell before it has no plain reading.
    known: HashMap<u64, Option<bool>>,
    /// What registers hold, by their outputs: nothing where they are wires.
    held: HashMap<u64, Option<bool>>,
}

/// How deep cells stand behind each other at most.
const DEPTH: u32 = 10_000;

impl<'a> Simulation<'a> {
    pub(super) fn new(flat: &'a Flat) -> Self {
        let mut drivers = HashMap::new();
        for cell in flat.cells.values() {
            for (place, bit) in cell.output().iter().enumerate() {
                if let Bit::Net(net) = bit {
                    drivers.insert(*net, (cell, place));
                }
            }
        }
        Self { flat, drivers, known: HashMap::new(), held: HashMap::new() }
    }

    /// Other inputs; those that are not named are 0.
    pub(super) fn set<'n>(&mut self, inputs: impl IntoIterator<Item = (&'n str, i128)>) {
        self.known.clear();
        for (name, port) in &self.flat.ports {
            if !port.output {
                self.drive(name, 0);
            }
        }
        for (name, value) in inputs {
            self.drive(name, value);
        }
        self.known.extend(&self.held);
    }

    /// With registers that hold, zeros at first.
    pub(super) fn clocked(mut self) -> Self {
        let registers = self.flat.cells.values().filter(|cell| cell.is_register());
        for bit in registers.flat_map(Cell::output) {
            if let Bit::Net(net) = bit {
                self.held.insert(*net, Some(false));
            }
        }
        self
    }

    /// Other contents of registers.
    pub(super) fn hold(&mut self, bits: impl IntoIterator<Item = (Bit, bool)>) {
        for (bit, value) in bits {
            if let Bit::Net(net) = bit {
                self.held.insert(net, Some(value));
            }
        }
    }

    /// What a register holds.
    pub(super) fn held(&self, bit: Bit) -> Option<bool> {
        match bit {
            Bit::Net(net) => self.held.get(&net).copied().flatten(),
            _ => None,
        }
    }

    /// A rising edge: registers take what stands before them.
    pub(super) fn clock(&mut self) {
        let mut next = HashMap::new();
        for cell in self.flat.cells.values().filter(|cell| cell.is_register()) {
            for (bit, d) in cell.output().iter().zip(&cell.wires["D"]) {
                if let Bit::Net(net) = bit {
                    next.insert(*net, self.bit(*d, DEPTH));
                }
            }
        }
        self.held = next;
    }

    fn drive(&mut self, name: &str, value: i128) {
        let Some(port) = self.flat.ports.get(name) else { return };
        for (place, bit) in port.bits.iter().enumerate() {
            if let Bit::Net(net) = bit {
                self.known.insert(*net, Some(value >> place.min(127) & 1 == 1));
            }
        }
    }

    /// The number on some bits; `None` where a cell has no plain reading.
    pub(super) fn number(&mut self, bits: &[Bit]) -> Option<BigInt> {
        self.at(bits, DEPTH)
    }

    fn at(&mut self, bits: &[Bit], depth: u32) -> Option<BigInt> {
        let mut number = BigInt::zero();
        for (place, bit) in bits.iter().enumerate() {
            if self.bit(*bit, depth)? {
                number += BigInt::one() << place;
            }
        }
        Some(number)
    }

    fn bit(&mut self, bit: Bit, depth: u32) -> Option<bool> {
        let net = match bit {
            Bit::Zero => return Some(false),
            Bit::One => return Some(true),
            Bit::Free => return None,
            Bit::Net(net) => net,
        };
        if let Some(value) = self.known.get(&net) {
            return *value;
        }
        let (cell, _) = *self.drivers.get(&net)?;
        let answer = self.cell(cell, depth.checked_sub(1)?)?;
        for (place, bit) in cell.output().iter().enumerate() {
            if let Bit::Net(net) = bit {
                self.known.insert(*net, Some(answer.bit(place as u64)));
            }
        }
        self.known.get(&net).copied().flatten()
    }

    /// A port, in two's complement if it is signed.
    fn port(&mut self, cell: &Cell, name: &str, is_signed: bool, depth: u32) -> Option<BigInt> {
        let bits = cell.wires.get(name)?;
        let number = self.at(bits, depth)?;
        let negative = is_signed && number.bit(bits.len() as u64 - 1);
        Some(if negative { number - (BigInt::one() << bits.len()) } else { number })
    }

    /// One of several words, or `a`.
    fn chosen(&mut self, cell: &Cell, a: BigInt, depth: u32) -> Option<BigInt> {
        let width = cell.output().len();
        let mut chosen = a;
        for (place, bit) in cell.wires["S"].iter().enumerate().rev() {
            if self.bit(*bit, depth)? {
                chosen = self.at(&cell.wires["B"][place * width..(place + 1) * width], depth)?;
            }
        }
        Some(chosen)
    }

    fn cell(&mut self, cell: &Cell, depth: u32) -> Option<BigInt> {
        let kind = cell.kind.as_str();
        if cell.is_register() {
            return self.port(cell, "D", false, depth);
        }
        if kind == "$mux" {
            // What is not chosen may be X.
            let port = if self.port(cell, "S", false, depth)?.is_zero() { "A" } else { "B" };
            return self.port(cell, port, false, depth);
        }
        let is_shift = ["$shl", "$sshl", "$shr", "$sshr"].contains(&kind);
        let two = cell.wires.contains_key("B");
        let is_signed = cell.is("A_SIGNED") && (!two || is_shift || cell.is("B_SIGNED"));
        if kind == "$anyseq" || kind == "$anyconst" {
            return Some(BigInt::zero());
        }
        let a = self.port(cell, "A", is_signed, depth)?;
        if kind == "$pmux" {
            return self.chosen(cell, a, depth);
        }
        if !two {
            return Some(match kind {
                "$neg" => -a,
                "$pos" => a,
                "$not" => -a - 1,
                "$logic_not" => truth(a.is_zero()),
                "$reduce_or" | "$reduce_bool" => truth(!a.is_zero()),
                "$reduce_and" => truth(self.at(&cell.wires["A"], depth)? == full(cell)),
                "$reduce_xor" | "$reduce_xnor" => {
                    let ones = self.at(&cell.wires["A"], depth)?.magnitude().count_ones();
                    truth(ones.is_multiple_of(2) == (kind == "$reduce_xnor"))
                }
                _ => return None,
            });
        }
        let b = self.port(cell, "B", is_signed && !is_shift, depth)?;
        Some(match kind {
            "$add" => a + b,
            "$sub" => a - b,
            "$mul" => a * b,
            "$and" => a & b,
            "$or" => a | b,
            "$xor" => a ^ b,
            "$xnor" => -(a ^ b) - 1,
            "$eq" | "$eqx" => truth(a == b),
            "$ne" | "$nex" => truth(a != b),
            "$lt" => truth(a < b),
            "$le" => truth(a <= b),
            "$gt" => truth(a > b),
            "$ge" => truth(a >= b),
            "$logic_and" => truth(!a.is_zero() && !b.is_zero()),
            "$logic_or" => truth(!a.is_zero() || !b.is_zero()),
            "$div" if !b.is_zero() => a / b,
            "$mod" if !b.is_zero() => a % b,
            "$div" | "$mod" => BigInt::zero(),
            "$shiftx" => a >> b.to_u32()?.min(1 << 10),
            "$shl" | "$sshl" => a << b.to_u32()?.min(1 << 10),
            "$sshr" if is_signed => a >> b.to_u32()?.min(1 << 10),
            "$shr" | "$sshr" => {
                // It fills with zeros from the wider of both words on.
                let all = cell.output().len().max(cell.wires["A"].len());
                let a = if a.is_negative() { a + (BigInt::one() << all) } else { a };
                a >> b.to_u32()?.min(1 << 10)
            }
            _ => return None,
        })
    }
}

fn full(cell: &Cell) -> BigInt {
    (BigInt::one() << cell.wires["A"].len()) - 1
}

fn truth(is: bool) -> BigInt {
    BigInt::from(u8::from(is))
}
