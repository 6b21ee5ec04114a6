//! The atoms of polynomials, their products and ranges.

use super::Polynomial;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What a polynomial is made of: a number in an [`Algebra`].
pub(in crate::vector::equivalence) type Atom = u32;

/// What an atom stands for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// An input of the module, by name.
    Input(String),
    /// 1 where a polynomial is below zero.
    Negative(Polynomial),
    /// 1 where a polynomial is zero.
    Zero(Polynomial),
    /// A bit of a polynomial.
    Bit(Polynomial, u32),
    /// The whole part of a polynomial over a power of two.
    Floor(Polynomial, u32),
}

struct Known {
    kind: Kind,
    low: BigInt,
    high: BigInt,
    /// An atom that is 0 where this one is 1.
    excludes: Option<Atom>,
}

/// What is known of a polynomial beside its atoms' ranges: it is at least a bound.
type AtLeast = (Polynomial, BigInt);

/// The atoms that were met.
#[derive(Default)]
pub(in crate::vector::equivalence) struct Algebra {
    atoms: Vec<Known>,
    found: BTreeMap<Kind, Atom>,
    /// Terms that were worked on.
    work: Cell<u64>,
}

/// Terms that are worked on before a question is given up.
const WORK: u64 = 1 << 24;
/// Conditions that a range is split by, one after the other.
const SPLITS: usize = 8;
/// Atoms at whose ends a range is looked for.
const ENDS: usize = 7;

impl Algebra {
    /// An input, from `low` to `high`.
    pub(in crate::vector::equivalence) fn input(
        &mut self,
        name: &str,
        low: BigInt,
        high: BigInt,
    ) -> Polynomial {
        Polynomial::atom(self.intern(Kind::Input(name.to_owned()), low, high))
    }

    pub(super) fn intern(&mut self, kind: Kind, low: BigInt, high: BigInt) -> Atom {
        if let Some(atom) = self.found.get(&kind) {
            return *atom;
        }
        let atom = Atom::try_from(self.atoms.len()).unwrap_or(Atom::MAX);
        self.found.insert(kind.clone(), atom);
        self.atoms.push(Known { kind, low, high, excludes: None });
        atom
    }

    /// Two conditions that are never both true.
    pub(super) fn exclude(&mut self, one: Atom, other: Atom) {
        self.atoms[one as usize].excludes = Some(other);
        self.atoms[other as usize].excludes = Some(one);
    }

    /// What an atom stands for.
    #[cfg(test)]
    pub(super) fn kind(&self, atom: Atom) -> &Kind {
        &self.atoms[atom as usize].kind
    }

    /// Whether an atom is 0 or 1: it is its own square.
    fn is_condition(&self, atom: Atom) -> bool {
        let known = &self.atoms[atom as usize];
        known.low.is_zero() && known.high.is_one()
    }

    /// Whether it took too much: what was worked out since then means nothing.
    pub(in crate::vector::equivalence) fn is_spent(&self) -> bool {
        self.work.get() > WORK
    }

    /// Gives up.
    pub(in crate::vector::equivalence) fn spend(&self) {
        self.work.set(u64::MAX);
    }

    pub(super) fn works(&self, terms: usize) -> bool {
        self.work.set(self.work.get().saturating_add(terms as u64));
        !self.is_spent()
    }

    /// The product.
    pub(in crate::vector::equivalence) fn product(
        &self,
        one: &Polynomial,
        other: &Polynomial,
    ) -> Polynomial {
        let mut all = Polynomial::default();
        if !self.works(one.len() * other.len()) {
            return all;
        }
        for (left, a) in one.terms() {
            for (right, b) in other.terms() {
                let mut atoms = [left, right].concat();
                atoms.sort_unstable();
                // dedup_by gives the later one first.
                atoms.dedup_by(|again, first| again == first && self.is_condition(*first));
                let never = atoms.iter().any(|atom| {
                    self.atoms[*atom as usize].excludes.is_some_and(|other| atoms.contains(&other))
                });
                if !never {
                    all.gain(atoms, a * b);
                }
            }
        }
        all
    }

    /// The first condition in a polynomial.
    pub(super) fn condition(&self, of: &Polynomial) -> Option<Atom> {
        let atoms = of.terms().flat_map(|(product, _)| product);
        atoms.copied().filter(|atom| self.is_condition(*atom)).min()
    }

    /// The polynomial where a condition is true, or false.
    pub(super) fn given(&self, of: &Polynomial, condition: Atom, is: bool) -> Polynomial {
        let excluded = self.atoms[condition as usize].excludes.filter(|_| is);
        let mut rest = Polynomial::default();
        if !self.works(of.len()) {
            return rest;
        }
        for (product, factor) in of.terms() {
            let has = product.contains(&condition);
            if has && !is || excluded.is_some_and(|atom| product.contains(&atom)) {
                continue;
            }
            let product = product.iter().copied().filter(|atom| *atom != condition).collect();
            rest.gain(product, factor.clone());
        }
        rest
    }

    /// Whether a polynomial never leaves a range.
    pub(in crate::vector::equivalence) fn fits(
        &self,
        of: &Polynomial,
        low: &BigInt,
        high: &BigInt,
    ) -> bool {
        let (least, most) = self.sum_of_ranges(of);
        least >= *low && most <= *high || self.fits_given(of, (low, high), &mut Vec::new())
    }

    /// The same, condition by condition: an absolute value is one of two polynomials, each where it is not below zero.
    fn fits_given(
        &self,
        of: &Polynomial,
        (low, high): (&BigInt, &BigInt),
        known: &mut Vec<AtLeast>,
    ) -> bool {
        let Some(condition) = self.condition(of).filter(|_| known.len() < 2 * SPLITS) else {
            let (mut least, mut most) = self.bounds(of);
            for (bounded, bound) in &*known {
                if let Some(more) = (of - bounded).value() {
                    least = least.max(bound + more);
                }
                if let Some(sum) = (of + bounded).value() {
                    most = most.min(sum - bound);
                }
            }
            return least >= *low && most <= *high;
        };
        let zero = BigInt::zero();
        [true, false].into_iter().all(|is| {
            let before = known.len();
            match (&self.atoms[condition as usize].kind, is) {
                (Kind::Negative(below), true) => known.push((-below, BigInt::one())),
                (Kind::Negative(above), false) => known.push((above.clone(), zero.clone())),
                (Kind::Zero(nothing), true) => {
                    known.extend([(nothing.clone(), zero.clone()), (-nothing, zero.clone())]);
                }
                _ => known.push((Polynomial::default(), zero.clone())),
            }
            let fits = self.fits_given(&self.given(of, condition, is), (low, high), known);
            known.truncate(before);
            fits
        })
    }

    /// A range: exact where each atom has the power one and they are few.
    pub(super) fn bounds(&self, of: &Polynomial) -> (BigInt, BigInt) {
        let mut atoms: Vec<Atom> =
            of.terms().flat_map(|(product, _)| product.iter().copied()).collect();
        atoms.sort_unstable();
        atoms.dedup();
        let square = of.terms().any(|(product, _)| product.windows(2).any(|two| two[0] == two[1]));
        if square || atoms.len() > ENDS || !self.works(of.len() << atoms.len()) {
            return self.sum_of_ranges(of);
        }
        let (mut least, mut most) = (None::<BigInt>, None::<BigInt>);
        for ends in 0u32..1 << atoms.len() {
            let at = |atom: &Atom| {
                let known = &self.atoms[*atom as usize];
                let place = atoms.binary_search(atom).unwrap_or_default();
                if ends >> place & 1 == 1 { &known.high } else { &known.low }
            };
            let value: BigInt = of
                .terms()
                .map(|(product, factor)| {
                    product.iter().fold(factor.clone(), |all, atom| all * at(atom))
                })
                .sum();
            least = Some(least.map_or(value.clone(), |least| least.min(value.clone())));
            most = Some(most.map_or(value.clone(), |most| most.max(value)));
        }
        (least.unwrap_or_default(), most.unwrap_or_default())
    }

    /// A range that may be too wide: the sum of those of the terms.
    fn sum_of_ranges(&self, of: &Polynomial) -> (BigInt, BigInt) {
        let (mut least, mut most) = (BigInt::zero(), BigInt::zero());
        for (product, factor) in of.terms() {
            let (mut low, mut high) = (factor.clone(), factor.clone());
            for atom in product {
                let known = &self.atoms[*atom as usize];
                let ends = [
                    &low * &known.low,
                    &low * &known.high,
                    &high * &known.low,
                    &high * &known.high,
                ];
                let [a, b, c, d] = ends;
                low = a.clone().min(b.clone()).min(c.clone()).min(d.clone());
                high = a.max(b).max(c).max(d);
            }
            least += low;
            most += high;
        }
        (least, most)
    }

    /// A polynomial as text.
    pub(in crate::vector::equivalence) fn text(&self, of: &Polynomial) -> String {
        let mut text = String::new();
        for (product, factor) in of.terms() {
            let sign = match (factor.is_negative(), text.is_empty()) {
                (true, true) => "-",
                (true, false) => " - ",
                (false, true) => "",
                (false, false) => " + ",
            };
            text += sign;
            let size = factor.magnitude();
            if product.is_empty() || !size.is_one() {
                let _ = write!(text, "{size}");
            }
            let names = product.iter().map(|atom| match &self.atoms[*atom as usize].kind {
                Kind::Input(name) => name.clone(),
                Kind::Negative(of) => format!("[{} < 0]", self.text(of)),
                Kind::Zero(of) => format!("[{} = 0]", self.text(of)),
                Kind::Bit(of, place) => format!("({})[{place}]", self.text(of)),
                Kind::Floor(of, power) => format!("floor(({}) / 2^{power})", self.text(of)),
            });
            let names: Vec<String> = names.collect();
            if !names.is_empty() && !size.is_one() {
                text.push(' ');
            }
            text += &names.join(" ");
        }
        if text.is_empty() { "0".to_owned() } else { text }
    }
}
