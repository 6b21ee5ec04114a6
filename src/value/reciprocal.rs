//! A reciprocal unit: normalise, look up, refine. Spec clauses `CH-9` to `CH-12`.

mod words;

pub use words::ReciprocalWords;

use crate::bits::{Rounding, bounded};
use num_traits::PrimInt;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A reciprocal unit, described.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ReciprocalConfig {
    /// Bits of the normalised operand, its leading one included.
    pub operand: u32,
    /// Bits below the leading one that address the table.
    pub index: u32,
    /// Bits of an entry.
    pub entry: u32,
    /// What follows the table.
    #[serde(default)]
    pub refine: Refine,
    /// The entries, where they are not those of the formula: 2^index numbers, one more for `linear`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<Vec<u32>>,
}

/// What follows the table.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Refine {
    /// Nothing: the entry is the result.
    #[default]
    None,
    /// A straight line to the next entry.
    Linear,
    /// Newton steps.
    Newton {
        /// Bits of the result of each step, one or two steps.
        bits: Vec<u32>,
    },
}

/// A reciprocal unit that cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReciprocalError {
    /// A field outside its range.
    #[error("{field} = {value}: {low} <= {field} <= {high} is needed")]
    Range {
        /// The field.
        field: &'static str,
        /// Its value.
        value: u32,
        /// The smallest allowed.
        low: u32,
        /// The largest allowed.
        high: u32,
    },
    /// Another number of Newton steps.
    #[error("newton has {0} steps: a unit has one step or two; give bits = [n] or bits = [n, m]")]
    Steps(usize),
    /// A table of another length.
    #[error("table has {got} entries, but index = {index} needs {need}")]
    Length {
        /// Entries given.
        got: usize,
        /// Entries needed.
        need: usize,
        /// Bits of the index.
        index: u32,
    },
    /// An entry that no word of the table holds.
    #[error("table[{place}] = {value}: 1 <= entry <= 2^{bits} - 1 is needed")]
    Entry {
        /// Its place.
        place: usize,
        /// The entry.
        value: u32,
        /// Bits of an entry.
        bits: u32,
    },
    /// A table that rises, so that a straight line between entries would not fall.
    #[error(
        "table[{place}] = {value} is above the entry before it; 1/x falls, so the entries of `linear` must not rise"
    )]
    Rises {
        /// The place of the larger entry.
        place: usize,
        /// The entry.
        value: u32,
    },
}

/// The result of a unit: `mantissa * 2^-exponent`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reciprocal {
    /// The result word, unsigned, [`ReciprocalUnit::bits`] bits.
    pub mantissa: i128,
    /// Its scale.
    pub exponent: u32,
}

/// A reciprocal unit, ready.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReciprocalUnit {
    config: ReciprocalConfig,
    table: Vec<u32>,
}

/// The largest relative error of a unit, and an operand that shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorstReciprocal {
    /// The normalised operand.
    pub operand: u64,
    /// The result for it.
    pub mantissa: u64,
    /// Operand times result, less one, times `2^scale`: the relative error, exactly.
    pub error: i128,
    /// Bits below the one of that product.
    pub scale: u32,
}

fn within(field: &'static str, value: u32, (low, high): (u32, u32)) -> Result<(), ReciprocalError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(ReciprocalError::Range { field, value, low, high })
}

impl ReciprocalConfig {
    /// Checks the unit and fills its table.
    ///
    /// # Errors
    /// [`ReciprocalError`] names the violated inequality.
    pub fn unit(&self) -> Result<ReciprocalUnit, ReciprocalError> {
        within("operand", self.operand, (2, 32))?;
        within("index", self.index, (1, 16.min(self.operand - 1)))?;
        within("entry", self.entry, (2, 31))?;
        if let Refine::Newton { bits } = &self.refine {
            if !(1..=2).contains(&bits.len()) {
                return Err(ReciprocalError::Steps(bits.len()));
            }
            bits.iter().try_for_each(|bits| within("newton.bits", *bits, (2, 40)))?;
        }
        let table = match &self.table {
            None => self.formula(),
            Some(table) => self.given(table)?,
        };
        Ok(ReciprocalUnit { config: self.clone(), table })
    }

    const fn is_linear(&self) -> bool {
        matches!(self.refine, Refine::Linear)
    }

    /// Entries by their formula. Spec clause `CH-10`.
    fn formula(&self) -> Vec<u32> {
        let (k, m) = (self.index, self.entry);
        let most = (1i128 << m) - 1;
        let count = (1i128 << k) + i128::from(self.is_linear());
        let entry = |i: i128| {
            // At the lower end of the interval for a line, in its middle otherwise, in halves.
            let place = 2 * i + i128::from(!self.is_linear());
            let exact = Rounding::NearestEven.divide(1 << (m + k + 1), (2 << k) + place);
            bounded(exact.map_or(most, |(value, _)| value.min(most)))
        };
        (0..count).map(entry).collect()
    }

    fn given(&self, table: &[u32]) -> Result<Vec<u32>, ReciprocalError> {
        let need = (1usize << self.index) + usize::from(self.is_linear());
        let (got, bits) = (table.len(), self.entry);
        if got != need {
            return Err(ReciprocalError::Length { got, need, index: self.index });
        }
        let outside = |value: u32| value == 0 || value >> bits != 0;
        if let Some((place, value)) = table.iter().enumerate().find(|(_, value)| outside(**value)) {
            return Err(ReciprocalError::Entry { place, value: *value, bits });
        }
        if self.is_linear()
            && let Some(place) = (1..got).find(|place| table[*place] > table[place - 1])
        {
            return Err(ReciprocalError::Rises { place, value: table[place] });
        }
        Ok(table.to_vec())
    }
}

impl ReciprocalUnit {
    /// Its description.
    pub fn config(&self) -> &ReciprocalConfig {
        &self.config
    }

    /// Its entries, by index.
    pub fn table(&self) -> &[u32] {
        &self.table
    }

    /// Bits of the result.
    pub fn bits(&self) -> u32 {
        match &self.config.refine {
            Refine::Newton { bits } => bits.last().copied().unwrap_or(self.config.entry),
            Refine::None | Refine::Linear => self.config.entry,
        }
    }

    /// The operand's leading bits: `operand` of them, the first one set. Spec clause `CH-9`.
    ///
    /// `value > 0`.
    #[inline]
    pub const fn normalised(&self, value: i128) -> u64 {
        let (length, operand) = (i128::BITS - value.leading_zeros(), self.config.operand);
        let moved = if length > operand {
            value >> (length - operand)
        } else {
            value << (operand - length)
        };
        #[expect(clippy::cast_possible_truncation, reason = "`operand` bits, at most 32")]
        let leading = moved.cast_unsigned() as u64;
        leading
    }

    /// The result word for a normalised operand. Spec clauses `CH-10` to `CH-12`.
    #[inline]
    pub fn mantissa(&self, normalised: u64) -> u64 {
        let ReciprocalConfig { operand, index, entry, ref refine, .. } = self.config;
        let below = operand - 1 - index;
        let place = bounded::<_, usize>(normalised >> below) & ((1 << index) - 1);
        let found = u64::from(self.table[place]);
        match refine {
            Refine::None => found,
            Refine::Linear => {
                let part = normalised & ((1 << below) - 1);
                found - (((found - u64::from(self.table[place + 1])) * part) >> below)
            }
            Refine::Newton { bits } => {
                let step =
                    |(y, m): (u64, u32), b: &u32| (newton((normalised, operand), (y, m), *b), *b);
                bits.iter().fold((found, entry), step).0
            }
        }
    }

    /// The reciprocal of `value > 0`.
    #[inline]
    pub fn of(&self, value: i128) -> Reciprocal {
        let length = i128::BITS - value.leading_zeros();
        let mantissa = self.mantissa(self.normalised(value));
        Reciprocal { mantissa: mantissa.into(), exponent: self.bits() + length - 1 }
    }

    /// The same for 64-bit operands: mantissa and exponent.
    #[inline]
    pub fn of_narrow(&self, value: u64) -> (i64, u32) {
        let (length, operand) = (u64::BITS - value.leading_zeros(), self.config.operand);
        let leading = value << (u64::BITS - length) >> (u64::BITS - operand);
        (self.mantissa(leading).cast_signed(), self.bits() + length - 1)
    }

    /// The largest relative error over every normalised operand, and the first operand that has it.
    pub fn worst(&self) -> WorstReciprocal {
        let operand = self.config.operand;
        let scale = operand - 1 + self.bits();
        let one = 1i128 << scale;
        let mut worst = WorstReciprocal { operand: 0, mantissa: 0, error: 0, scale };
        for x in 1u64 << (operand - 1)..1 << operand {
            let mantissa = self.mantissa(x);
            let error = i128::from(x) * i128::from(mantissa) - one;
            if error.abs() > worst.error.abs() || x == 1 << (operand - 1) {
                worst = WorstReciprocal { operand: x, mantissa, error, scale };
            }
        }
        worst
    }
}

/// A Newton step: from y of m bits to b bits, for x of p bits. Spec clause `CH-12`.
#[inline]
fn newton((x, p): (u64, u32), (y, m): (u64, u32), b: u32) -> u64 {
    if p + m <= 64 && m + b + 2 <= 64 {
        return newton_in::<u64>((x, p), (y, m), b);
    }
    bounded(newton_in::<u128>((x.into(), p), (y.into(), m), b))
}

/// The same in integers that hold `p + m` and `m + b + 2` bits.
#[inline]
fn newton_in<T: PrimInt>((x, p): (T, u32), (y, m): (T, u32), b: u32) -> T {
    // x has p - 1 bits below its one, y has m.
    let (product, places) = (x * y, p - 1 + m);
    let product = if places >= b {
        product.unsigned_shr(places - b)
    } else {
        product.unsigned_shl(b - places)
    };
    let (one, two) = (T::one(), T::one().unsigned_shl(b + 1));
    let rest = if product > two { T::zero() } else { two - product };
    (y * rest).unsigned_shr(m).min(one.unsigned_shl(b) - one)
}
