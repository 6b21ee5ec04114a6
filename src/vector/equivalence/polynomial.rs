//! Words as polynomials over the integers, of inputs and of conditions on them, in a normal form: two words with
//! the same form are equal for all inputs. Spec clause `J-10`.
//!
//! A product of two words of 23 bits has so many ways to be written as adders that no solver of bits tells two of
//! them equal. As polynomials both are x y, and what differs at all differs in a term.

mod algebra;
mod condition;
#[cfg(test)]
mod test;

pub(super) use algebra::{Algebra, Atom};

use num_bigint::BigInt;
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::ops::{Add, Neg, Sub};

/// A sum of products: atoms in order, each as often as its power, with a factor that is not zero.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Polynomial(BTreeMap<Vec<Atom>, BigInt>);

impl Polynomial {
    pub(super) fn constant(value: impl Into<BigInt>) -> Self {
        let mut own = Self::default();
        own.gain(Vec::new(), value.into());
        own
    }

    fn atom(atom: Atom) -> Self {
        Self(BTreeMap::from([(vec![atom], BigInt::one())]))
    }

    fn gain(&mut self, product: Vec<Atom>, factor: BigInt) {
        let sum = self.0.remove(&product).unwrap_or_default() + factor;
        if !sum.is_zero() {
            self.0.insert(product, sum);
        }
    }

    /// Its value if it has no atoms.
    pub(super) fn value(&self) -> Option<BigInt> {
        match self.0.len() {
            0 => Some(BigInt::zero()),
            1 => self.0.get(&Vec::new()).cloned(),
            _ => None,
        }
    }

    pub(super) fn terms(&self) -> impl Iterator<Item = (&[Atom], &BigInt)> {
        self.0.iter().map(|(product, factor)| (product.as_slice(), factor))
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn scaled(&self, by: &BigInt) -> Self {
        if by.is_zero() {
            return Self::default();
        }
        Self(self.0.iter().map(|(product, factor)| (product.clone(), factor * by)).collect())
    }

    pub(super) fn shifted(&self, bits: u32) -> Self {
        self.scaled(&(BigInt::one() << bits))
    }

    /// The same value mod 2^width, with the factors that are nearest to zero.
    pub(super) fn reduced(&self, width: u32) -> Self {
        let mut own = Self::default();
        for (product, factor) in &self.0 {
            own.gain(product.clone(), centred(factor, width));
        }
        own
    }

    fn mapped(&self, change: impl Fn(&BigInt) -> BigInt) -> Self {
        let mut own = Self::default();
        for (product, factor) in &self.0 {
            own.gain(product.clone(), change(factor));
        }
        own
    }
}

/// A number mod 2^width, from -2^(width-1) + 1 to 2^(width-1).
fn centred(value: &BigInt, width: u32) -> BigInt {
    let whole = BigInt::one() << width;
    let rest = value & (&whole - 1u32);
    if &rest + &rest > whole { rest - whole } else { rest }
}

impl Add for &Polynomial {
    type Output = Polynomial;

    fn add(self, other: Self) -> Polynomial {
        let mut sum = self.clone();
        for (product, factor) in &other.0 {
            sum.gain(product.clone(), factor.clone());
        }
        sum
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;

    fn neg(self) -> Polynomial {
        Polynomial(self.0.iter().map(|(product, factor)| (product.clone(), -factor)).collect())
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;

    fn sub(self, other: Self) -> Polynomial {
        self + &-other
    }
}
