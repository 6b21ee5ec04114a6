//! The words of a reciprocal on their way through a unit, as the clauses have them: what a bench of the unit
//! compares. `ReciprocalUnit::of` is the quick way to the last of them. Spec clauses `CH-9` to `CH-12`.

use super::{ReciprocalUnit, Refine};
use crate::bits::bounded;

/// The words of a reciprocal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReciprocalWords {
    /// The bit length of the integer.
    pub length: u32,
    /// The normalised operand.
    pub operand: u64,
    /// The table's entry for it.
    pub entry: u32,
    /// Of a unit with straight lines: the next entry, the bits of the operand below the index, and what
    /// the line has fallen up to there.
    pub line: Option<[i128; 3]>,
    /// Of each Newton step: r, t, and the result.
    pub steps: Vec<[i128; 3]>,
    /// The result.
    pub mantissa: i128,
    /// Its scale: 1/q is about mantissa 2^-exponent.
    pub exponent: u32,
}

impl ReciprocalUnit {
    /// The words for `value > 0`.
    pub fn words(&self, value: i128) -> ReciprocalWords {
        let config = &self.config;
        let (p, k, m) = (config.operand, config.index, config.entry);
        let length = i128::BITS - value.leading_zeros();
        let x = if length > p { value >> (length - p) } else { value << (p - length) };
        let h = p - 1 - k;
        let index = (x >> h) - (1 << k);
        let entry = |index: i128| self.table[bounded::<_, usize>(index)];
        let found = entry(index);
        let (mut line, mut steps, mut mantissa) = (None, Vec::new(), i128::from(found));
        match &config.refine {
            Refine::None => {}
            Refine::Linear => {
                let (next, part) = (i128::from(entry(index + 1)), x & ((1 << h) - 1));
                let fall = ((mantissa - next) * part) >> h;
                line = Some([next, part, fall]);
                mantissa -= fall;
            }
            Refine::Newton { bits } => {
                let mut m = m;
                for b in bits {
                    let r = ((x * mantissa) << b) >> (p - 1 + m);
                    let t = (1 << (b + 1)) - r;
                    mantissa = ((mantissa * t) >> m).min((1 << b) - 1);
                    steps.push([r, t, mantissa]);
                    m = *b;
                }
            }
        }
        let exponent = self.bits() + length - 1;
        ReciprocalWords {
            length,
            operand: bounded(x),
            entry: found,
            line,
            steps,
            mantissa,
            exponent,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::ReciprocalConfig;

    // Clause CH-12
    #[test]
    fn the_last_words_are_the_quick_ones() {
        let refines = [
            Refine::None,
            Refine::Linear,
            Refine::Newton { bits: vec![9] },
            Refine::Newton { bits: vec![6, 11] },
        ];
        for refine in refines {
            let config = ReciprocalConfig { operand: 8, index: 3, entry: 5, refine, table: None };
            let unit = config.unit().unwrap();
            for value in 1..1 << 11 {
                let (words, quick) = (unit.words(value), unit.of(value));
                assert_eq!(words.operand, unit.normalised(value), "{config:?} {value}");
                assert_eq!((words.mantissa, words.exponent), (quick.mantissa, quick.exponent));
            }
        }
    }
}
