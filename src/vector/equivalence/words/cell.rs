//! What the cells of yosys do to words.

use super::{Source, Word, Words, from, meet, word};
use crate::vector::equivalence::netlist::{Bit, Cell};
use crate::vector::equivalence::polynomial::{Algebra, Polynomial};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::BTreeSet;

impl<'a> Words<'a> {
    /// 1 where a port of a cell is not zero.
    fn truth(
        &mut self,
        (cell, port): (&Cell, &str),
        algebra: &mut Algebra,
    ) -> Result<Word, String> {
        let bits = &cell.wires[port];
        let word = self.joined(bits, algebra)?;
        Ok(word.with(not(&algebra.zero_word(&word.value, from(bits.len())))))
    }

    /// The output of a cell.
    pub(super) fn cell(
        &mut self,
        name: &'a str,
        cell: &Cell,
        algebra: &mut Algebra,
    ) -> Result<Word, String> {
        let width = from(cell.output().len());
        let kind = cell.kind.as_str();
        let answer = match kind {
            "$add" | "$sub" | "$mul" | "$and" | "$or" | "$xor" | "$xnor" => {
                let a = self.operand((cell, "A"), width, algebra)?;
                let b = self.operand((cell, "B"), width, algebra)?;
                let value = match kind {
                    "$add" => &a.value + &b.value,
                    "$sub" => &a.value - &b.value,
                    "$mul" => algebra.product(&a.value, &b.value),
                    _ => masked(kind, [&a.value, &b.value], width, algebra)?,
                };
                meet(&a, &b)?.with(value)
            }
            "$neg" | "$pos" | "$not" => {
                let a = self.operand((cell, "A"), width, algebra)?;
                let value = match kind {
                    "$neg" => -&a.value,
                    "$not" if width == 1 => not(&a.value),
                    "$not" => &Polynomial::constant(-1) - &a.value,
                    _ => a.value.clone(),
                };
                a.with(value)
            }
            "$logic_and" | "$logic_or" => {
                let [a, b] = [self.truth((cell, "A"), algebra)?, self.truth((cell, "B"), algebra)?];
                let both = algebra.product(&a.value, &b.value);
                let value =
                    if kind == "$logic_and" { both } else { &(&a.value + &b.value) - &both };
                meet(&a, &b)?.with(value)
            }
            "$logic_not" => {
                let a = self.truth((cell, "A"), algebra)?;
                a.with(not(&a.value))
            }
            "$reduce_or" | "$reduce_bool" => self.truth((cell, "A"), algebra)?,
            "$reduce_and" => {
                let bits = &cell.wires["A"];
                let a = self.joined(bits, algebra)?;
                // All ones are -1.
                let next = &a.value + &Polynomial::constant(1);
                a.with(algebra.zero_word(&next, from(bits.len())))
            }
            "$eq" | "$ne" => {
                let both = from(cell.wires["A"].len().max(cell.wires["B"].len()));
                let a = self.operand((cell, "A"), both, algebra)?;
                let b = self.operand((cell, "B"), both, algebra)?;
                let same = algebra.zero_word(&(&a.value - &b.value), both);
                meet(&a, &b)?.with(if kind == "$eq" { same } else { not(&same) })
            }
            "$lt" | "$le" | "$gt" | "$ge" => {
                let both = from(cell.wires["A"].len().max(cell.wires["B"].len()));
                let [a, b] = ["A", "B"].map(|port| self.number((cell, port), both, algebra));
                let (a, b) = (a?, b?);
                let difference = match kind {
                    "$le" | "$gt" => &b.value - &a.value,
                    _ => &a.value - &b.value,
                };
                let value = match kind {
                    "$lt" | "$gt" => algebra.negative(&difference),
                    _ => not(&algebra.negative(&difference)),
                };
                meet(&a, &b)?.with(value)
            }
            "$shl" | "$sshl" | "$shr" | "$sshr" => self.shift(cell, width, algebra)?,
            "$mux" => {
                let a = self.operand((cell, "A"), width, algebra)?;
                let b = self.operand((cell, "B"), width, algebra)?;
                let s = self.operand((cell, "S"), 1, algebra)?;
                let more = algebra.product(&s.value, &(&b.value - &a.value));
                meet(&meet(&a, &b)?, &s)?.with(&a.value + &more)
            }
            "$dff" | "$dffe" | "$adff" | "$adffe" => self.register(name, cell, algebra)?,
            _ => {
                return Err(format!(
                    "the cell {kind} is none of sums, products, shifts by constants, comparisons and choices"
                ));
            }
        };
        Ok(answer.with(word(&answer.value, width, algebra)))
    }

    /// A port of a comparison as its exact number.
    fn number(
        &mut self,
        port: (&Cell, &str),
        width: u32,
        algebra: &mut Algebra,
    ) -> Result<Word, String> {
        let own = from(port.0.wires[port.1].len());
        let word = self.operand(port, width, algebra)?;
        if width > own {
            return Ok(word);
        }
        let is_signed = port.0.is("A_SIGNED") && port.0.is("B_SIGNED");
        let value = if is_signed {
            algebra.signed(&word.value, own)
        } else {
            algebra.unsigned(&word.value, own)
        };
        Ok(word.with(value))
    }

    fn shift(&mut self, cell: &Cell, width: u32, algebra: &mut Algebra) -> Result<Word, String> {
        let by = self.joined(&cell.wires["B"], algebra)?;
        let by = algebra.unsigned(&by.value, from(cell.wires["B"].len())).value();
        let by = by.ok_or("a shift by what is no constant")?;
        // No word has so many bits.
        let by = u32::try_from(by).unwrap_or(u32::MAX).min(1 << 10);
        if cell.kind.ends_with("shl") {
            let a = self.operand((cell, "A"), width, algebra)?;
            return Ok(a.with(a.value.shifted(by)));
        }
        let own = from(cell.wires["A"].len());
        let fills = cell.kind == "$sshr" && cell.is("A_SIGNED");
        let a = self.joined(&cell.wires["A"], algebra)?;
        let value = if cell.is("A_SIGNED") && (fills || width > own) {
            algebra.signed(&a.value, own)
        } else {
            algebra.unsigned(&a.value, own)
        };
        // A logical shift fills with zeros from the wider of both words on.
        let value = if fills {
            algebra.bits(&value, by, width)
        } else {
            let all = own.max(width);
            if by >= all {
                Polynomial::default()
            } else {
                algebra.bits(&value, by, (all - by).min(width))
            }
        };
        Ok(a.with(value))
    }

    /// What a register takes; what another one takes has to be taken at the same clocks.
    fn register(
        &mut self,
        name: &'a str,
        cell: &Cell,
        algebra: &mut Algebra,
    ) -> Result<Word, String> {
        if self.control.clock != Some(cell.wires["CLK"][0]) || !cell.is("CLK_POLARITY") {
            return Err(
                "a register is not clocked by the rising edge of the map's clock".to_owned()
            );
        }
        if let Some(reset) = cell.wires.get("ARST") {
            let level = !cell.is("ARST_POLARITY");
            if self.control.reset != Some((reset[0], level)) {
                return Err("a register is reset by something else than the map's reset".to_owned());
            }
        }
        let enable = cell.wires.get("EN").map(|bits| bits[0]);
        if let Some(input) = enable.and_then(|enable| self.data_before(enable)) {
            return Err(format!("the enable of a register depends on {input}"));
        }
        let d = self.joined(&cell.wires["D"], algebra)?;
        self.registers.insert(name);
        self.enabled |= enable.is_some();
        let way = d.way.map(|mut way| {
            way.push((enable.unwrap_or(Bit::One), cell.is("EN_POLARITY")));
            way
        });
        Ok(Word { way, ..d })
    }

    /// An input before a bit that no enable may depend on.
    fn data_before(&self, bit: Bit) -> Option<&'a str> {
        let (mut seen, mut open) = (BTreeSet::new(), vec![bit]);
        while let Some(bit) = open.pop() {
            let Bit::Net(net) = bit else { continue };
            if !seen.insert(net) {
                continue;
            }
            match self.drivers.get(&net).map(|driver| driver.source) {
                Some(Source::Input(name)) if self.control.data.contains(&name) => {
                    return Some(name);
                }
                Some(Source::Cell(name)) => {
                    open.extend(self.flat.cells[name].wires.values().flatten());
                }
                _ => {}
            }
        }
        None
    }
}

fn not(condition: &Polynomial) -> Polynomial {
    &Polynomial::constant(1) - condition
}

/// A bit operation of conditions, or of a word and a mask that is the same bit everywhere: it is 0 or -1.
fn masked(
    kind: &str,
    [a, b]: [&Polynomial; 2],
    width: u32,
    algebra: &mut Algebra,
) -> Result<Polynomial, String> {
    let (zero, one) = (BigInt::zero(), BigInt::one());
    let bit = |algebra: &Algebra, of: &Polynomial| algebra.fits(of, &zero, &one);
    if width == 1 && bit(algebra, a) && bit(algebra, b) {
        let both = algebra.product(a, b);
        let sum = a + b;
        return Ok(match kind {
            "$and" => both,
            "$or" => &sum - &both,
            "$xor" => &sum - &both.shifted(1),
            _ => not(&(&sum - &both.shifted(1))),
        });
    }
    let mask = |algebra: &Algebra, of: &Polynomial| algebra.fits(of, &-&one, &zero);
    let (word, choice) = if mask(algebra, b) {
        (a, -b)
    } else if mask(algebra, a) {
        (b, -a)
    } else {
        return Err(format!(
            "the operands of {kind} are no conditions, and none is one bit everywhere"
        ));
    };
    let gain = match kind {
        "$and" => return Ok(algebra.product(word, &choice)),
        "$or" => &Polynomial::constant(-1) - word,
        _ => &Polynomial::constant(-1) - &word.shifted(1),
    };
    let own = word + &algebra.product(&choice, &gain);
    Ok(if kind == "$xnor" { &Polynomial::constant(-1) - &own } else { own })
}
