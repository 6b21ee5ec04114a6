//! The words of a flat netlist as polynomials of its inputs. Spec clause `J-10`.

mod cell;

use super::netlist::{Bit, Cell, Flat};
use super::polynomial::{Algebra, Polynomial};
use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::{BTreeSet, HashMap};

/// Longer polynomials are given up.
const TERMS: usize = 20_000;

/// Registers on a way, first one first: by the bits that enable them, and at which level.
pub(super) type Way = Vec<(Bit, bool)>;

/// A word: a polynomial that is its value mod 2^bits, and the registers on its way, by their enables. A constant
/// has been everywhere.
#[derive(Clone, Debug)]
pub(super) struct Word {
    pub(super) value: Polynomial,
    pub(super) way: Option<Way>,
}

/// What drives a bit: a word of the netlist, and the place in it.
#[derive(Clone, Copy)]
struct Driver<'a> {
    source: Source<'a>,
    place: u32,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Source<'a> {
    Input(&'a str),
    Cell(&'a str),
}

/// The words of a netlist, worked out when they are asked for.
pub(super) struct Words<'a> {
    flat: &'a Flat,
    drivers: HashMap<u64, Driver<'a>>,
    /// Words by what drives them, the first bit and their number.
    known: HashMap<(Source<'a>, u32, u32), Word>,
    under_way: Vec<(Source<'a>, u32, u32)>,
    control: Control<'a>,
    /// Cells of the registers that were met.
    pub(super) registers: BTreeSet<&'a str>,
    /// Whether one of them loads by an enable.
    pub(super) enabled: bool,
}

/// What registers on a way may be driven by.
#[derive(Clone, Copy, Default)]
pub(super) struct Control<'a> {
    /// The net of the clock.
    pub(super) clock: Option<Bit>,
    /// The net of the reset, and whether the module is in reset while it is low.
    pub(super) reset: Option<(Bit, bool)>,
    /// Inputs that enables may not depend on.
    pub(super) data: &'a [&'a str],
}

impl<'a> Words<'a> {
    /// Of a netlist, some of whose inputs are known words.
    pub(super) fn new(
        flat: &'a Flat,
        inputs: &[(&'a str, Polynomial)],
        control: Control<'a>,
    ) -> Self {
        let mut drivers = HashMap::new();
        let mut drive = |source, bits: &[Bit]| {
            for (place, bit) in (0..).zip(bits) {
                if let Bit::Net(net) = bit {
                    drivers.insert(*net, Driver { source, place });
                }
            }
        };
        for (name, port) in flat.ports.iter().filter(|(_, port)| !port.output) {
            drive(Source::Input(name.as_str()), &port.bits);
        }
        for (name, cell) in &flat.cells {
            drive(Source::Cell(name.as_str()), cell.output());
        }
        let word = |value: &Polynomial| Word { value: value.clone(), way: Some(Vec::new()) };
        let known = inputs.iter().map(|(name, value)| ((Source::Input(name), 0, 0), word(value)));
        let (known, under_way) = (known.collect(), Vec::new());
        Self {
            flat,
            drivers,
            known,
            under_way,
            control,
            registers: BTreeSet::new(),
            enabled: false,
        }
    }

    /// The word on some bits, mod 2^(their number).
    pub(super) fn joined(&mut self, bits: &[Bit], algebra: &mut Algebra) -> Result<Word, String> {
        let width = u32::try_from(bits.len()).unwrap_or(u32::MAX);
        let top = bits.last().copied().unwrap_or(Bit::Zero);
        let same = bits.iter().rev().take_while(|bit| **bit == top).count();
        if same > 1 || (same == 1 && top == Bit::Zero && width > 1) {
            // Extended: by zeros, or by a sign of which the last one belongs to the word.
            let kept = if top == Bit::Zero { bits.len() - same } else { bits.len() - same + 1 };
            if top == Bit::Zero && kept > 0 {
                let word = self.joined(&bits[..kept], algebra)?;
                return Ok(Word { value: algebra.unsigned(&word.value, from(kept)), ..word });
            }
            if top != Bit::Zero && top != Bit::One {
                let word = self.joined(&bits[..kept], algebra)?;
                return Ok(Word { value: algebra.signed(&word.value, from(kept)), ..word });
            }
        }
        let mut sum = Word { value: Polynomial::default(), way: None };
        let mut place = 0;
        while place < bits.len() {
            let (part, count) = self.part(&bits[place..], algebra)?;
            sum = meet(&sum, &part)?.with(&sum.value + &part.value.shifted(from(place)));
            place += count;
        }
        Ok(sum.with(word(&sum.value, width, algebra)))
    }

    /// The first bits, as many as come from one word in a row, as a number that is not below zero; or, if they
    /// are all, mod 2^(their number).
    fn part(&mut self, bits: &[Bit], algebra: &mut Algebra) -> Result<(Word, usize), String> {
        let driver = match bits[0] {
            Bit::Zero => return Ok((constant(0), 1)),
            Bit::One => return Ok((constant(1), 1)),
            Bit::Free => return Err("a bit of it is X, or nobody drives it".to_owned()),
            Bit::Net(net) => *self.drivers.get(&net).ok_or("a bit of it has no driver")?,
        };
        let follows = |(place, bit): (u32, &Bit)| match bit {
            Bit::Net(net) => self.drivers.get(net).is_some_and(|other| {
                other.source == driver.source && other.place == driver.place + place
            }),
            _ => false,
        };
        let count = (0..).zip(bits).take_while(|pair| follows((pair.0, pair.1))).count();
        let (source, place) = self.source(driver, from(count), algebra)?;
        let value = if count == bits.len() && place == 0 {
            word(&source.value, from(count), algebra)
        } else {
            algebra.bits(&source.value, place, from(count))
        };
        Ok((source.with(value), count))
    }

    /// The word that drives some bits, and their place in it. Of a cell that works bit by bit, it is these bits alone.
    fn source(
        &mut self,
        driver: Driver<'a>,
        count: u32,
        algebra: &mut Algebra,
    ) -> Result<(Word, u32), String> {
        let Driver { source, place } = driver;
        let part = match source {
            Source::Input(_) => None,
            Source::Cell(name) => self.flat.cells[name].part(place, count),
        };
        let (key, place) =
            if part.is_some() { ((source, place, count), 0) } else { ((source, 0, 0), place) };
        if let Some(word) = self.known.get(&key) {
            return Ok((word.clone(), place));
        }
        let word = match source {
            Source::Input(name) => {
                let width = self.flat.ports[name].bits.len();
                let most = (BigInt::one() << width) - 1u32;
                let value = algebra.input(name, BigInt::zero(), most);
                Word { value, way: Some(Vec::new()) }
            }
            Source::Cell(name) => {
                let cell = &self.flat.cells[name];
                if self.under_way.contains(&key) {
                    return Err(format!(
                        "what is worked out in several steps is none of these polynomials: a register or a gate \
                         feeds itself, at {}",
                        origin(name, cell)
                    ));
                }
                self.under_way.push(key);
                let word = self.cell(name, part.as_ref().unwrap_or(cell), algebra);
                self.under_way.pop();
                let word = word.map_err(|what| {
                    let at = if what.contains(" at ") {
                        String::new()
                    } else {
                        format!(", at {}", origin(name, cell))
                    };
                    what + &at
                })?;
                if word.value.len() > TERMS {
                    algebra.spend();
                }
                if algebra.is_spent() {
                    let terms = word.value.len();
                    return Err(format!(
                        "the words grow beyond what is worked out here ({terms} terms, at {})",
                        origin(name, cell)
                    ));
                }
                word
            }
        };
        self.known.insert(key, word.clone());
        Ok((word, place))
    }

    /// A port of a cell as a number of its own bits, or, if the cell takes more of them, extended.
    fn operand(
        &mut self,
        (cell, port): (&Cell, &str),
        width: u32,
        algebra: &mut Algebra,
    ) -> Result<Word, String> {
        let bits = cell.wires.get(port).ok_or_else(|| format!("{} has no {port}", cell.kind))?;
        let own = from(bits.len());
        if width <= own {
            return self.joined(&bits[..width as usize], algebra);
        }
        let word = self.joined(bits, algebra)?;
        let is_shift = cell.kind.contains("sh");
        let is_signed = cell.is("A_SIGNED")
            && (is_shift || cell.is("B_SIGNED") || !cell.wires.contains_key("B"));
        let value = if is_signed {
            algebra.signed(&word.value, own)
        } else {
            algebra.unsigned(&word.value, own)
        };
        Ok(word.with(value))
    }
}

impl Word {
    fn with(&self, value: Polynomial) -> Self {
        Self { value, way: self.way.clone() }
    }
}

/// A word of both: what is put together was taken at the same clocks.
fn meet(one: &Word, other: &Word) -> Result<Word, String> {
    match (&one.way, &other.way) {
        (Some(here), Some(there)) if here != there => {
            let [here, there] = [here.len(), there.len()];
            Err(format!(
                "a word behind {here} registers meets one behind {there}, or their registers do not load together"
            ))
        }
        (None, _) => Ok(other.clone()),
        _ => Ok(one.clone()),
    }
}

fn constant(value: u32) -> Word {
    Word { value: Polynomial::constant(value), way: None }
}

/// A value as a word of so many bits: a single one is 0 or 1 and nothing else.
fn word(value: &Polynomial, width: u32, algebra: &mut Algebra) -> Polynomial {
    if width == 1 { algebra.unsigned(value, 1) } else { value.reduced(width) }
}

fn from(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Where a cell is from.
fn origin(name: &str, cell: &Cell) -> String {
    cell.src.clone().unwrap_or_else(|| name.to_owned())
}
