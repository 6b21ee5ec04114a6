//! Channels by barycentric coordinates. Spec clause `CH-13`.

use super::{Barycentric, BarycentricConfig, Weighted};
use crate::format::{Column, Unreduced, WordFormat};
use crate::machine::{Accumulators, Carried, CarriedWords, Carrier, LinearValue};

/// A value weighed by the coordinates of a triangle.
#[derive(Debug)]
struct Shared {
    config: BarycentricConfig,
    weighted: Weighted,
}

impl Carrier for Barycentric {
    fn columns(&self, name: &str, words: &CarriedWords, scale: u32) -> Vec<Column> {
        let word = WordFormat::signed(words.read.integer() + scale + 1).fraction(scale);
        [
            ("base", format!("{name} of vertex 0 of the normalised triangle.")),
            ("rise1", format!("{name} of vertex 1 less that of vertex 0.")),
            ("rise2", format!("{name} of vertex 2 less that of vertex 0.")),
        ]
        .map(|(what, meaning)| word.column(format!("{name}_{what}"), meaning))
        .into()
    }

    fn carry(&self, value: &LinearValue<'_>, words: &CarriedWords) -> Box<dyn Carried> {
        let shares = self.shares(value.triangle, value.grid);
        let format = (words.read.fraction(), words.gain);
        let weighted = Weighted::new(shares, value.values, value.scale, format);
        Box::new(Shared { config: self.config, weighted })
    }
}

impl Carried for Shared {
    fn setup(&self) -> Vec<Unreduced> {
        let Weighted { base, rise, scale, .. } = self.weighted;
        [base, rise[0], rise[1]].map(|raw| Unreduced::new(raw, scale)).into()
    }

    fn run(&self, y: u32, x: u32, length: usize) -> Accumulators {
        let at = |x| self.weighted.at(&self.config, x, y);
        Accumulators::Each((x..).take(length).map(at).collect())
    }
}
