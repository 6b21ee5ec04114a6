//! Conditions on polynomials, and bits of them, in a normal form: no condition stands in another one.

use super::algebra::Kind;
use super::{Algebra, Polynomial};
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// No polynomial of words reaches 2 to this power.
const FAR: u32 = 1 << 12;

impl Algebra {
    /// What a function gives where a condition of its argument is true, and where it is false, put together.
    fn each_case(
        &mut self,
        of: &Polynomial,
        function: &mut dyn FnMut(&mut Self, &Polynomial) -> Polynomial,
    ) -> Polynomial {
        let Some(condition) = self.condition(of) else { return function(self, of) };
        let [when, unless] = [true, false].map(|is| self.given(of, condition, is));
        let [when, unless] = [&when, &unless].map(|case| self.each_case(case, function));
        let condition = Polynomial::atom(condition);
        &unless + &self.product(&condition, &(&when - &unless))
    }

    /// 1 where a polynomial is below zero, else 0.
    pub(in crate::vector::equivalence) fn negative(&mut self, of: &Polynomial) -> Polynomial {
        self.each_case(of, &mut |own, of| own.sign(of, true))
    }

    /// 1 where a polynomial is zero, else 0.
    pub(in crate::vector::equivalence) fn zero(&mut self, of: &Polynomial) -> Polynomial {
        self.each_case(of, &mut |own, of| own.sign(of, false))
    }

    /// 1 where a word of so many bits is zero: its value is known mod 2^width.
    pub(in crate::vector::equivalence) fn zero_word(
        &mut self,
        of: &Polynomial,
        width: u32,
    ) -> Polynomial {
        let most = (BigInt::one() << width) - 1u32;
        if self.fits(of, &-&most, &most) {
            return self.zero(of);
        }
        let number = self.bits(of, 0, width);
        self.zero(&number)
    }

    /// Either of them, without conditions inside: of each polynomial and its negative one alone is an atom.
    fn sign(&mut self, of: &Polynomial, negative: bool) -> Polynomial {
        let one = BigInt::one();
        let truth = |is: bool| Polynomial::constant(u32::from(is));
        if let Some(value) = of.value() {
            return truth(if negative { value.is_negative() } else { value.is_zero() });
        }
        let far = BigInt::one() << FAR;
        if negative && self.fits(of, &BigInt::zero(), &far) {
            return truth(false);
        }
        if self.fits(of, &one, &far) || self.fits(of, &-&far, &-&one) {
            return truth(negative);
        }
        let common = of.terms().fold(BigInt::zero(), |all, (_, factor)| all.gcd(factor));
        let turned = of.terms().last().is_some_and(|(_, factor)| factor.is_negative());
        let basic = of.mapped(|factor| if turned { -factor / &common } else { factor / &common });
        let [below, zero] = [Kind::Negative(basic.clone()), Kind::Zero(basic)]
            .map(|kind| self.intern(kind, BigInt::zero(), one.clone()));
        self.exclude(below, zero);
        let [below, zero] = [below, zero].map(Polynomial::atom);
        match (negative, turned) {
            (false, _) => zero,
            (true, false) => below,
            (true, true) => &(&truth(true) - &below) - &zero,
        }
    }

    /// Some bits of a polynomial that is known mod 2^(low + count), as a number that is not below zero.
    ///
    /// A single bit is a condition. More of them are what is left of the word above `low` when what is above them is
    /// taken away: so parts of a word that are put together again make the word.
    pub(in crate::vector::equivalence) fn bits(
        &mut self,
        of: &Polynomial,
        low: u32,
        count: u32,
    ) -> Polynomial {
        let of = of.reduced(low + count);
        if count == 1 {
            return self.bit(&of, low);
        }
        let above = self.floor(&of, low + count);
        &self.floor(&of, low) - &above.shifted(count)
    }

    fn bit(&mut self, of: &Polynomial, place: u32) -> Polynomial {
        let half = BigInt::one() << place;
        if self.fits(of, &BigInt::zero(), &(&half - 1u32)) {
            return Polynomial::default();
        }
        if self.fits(of, &-&half, &(&half - 1u32)) {
            return self.negative(of);
        }
        if place == 0 && self.fits(of, &BigInt::zero(), &BigInt::one()) {
            return of.clone();
        }
        self.each_case(of, &mut |own, of| {
            let of = &of.reduced(place + 1);
            if let Some(value) = of.value() {
                return Polynomial::constant((value >> place) & BigInt::one());
            }
            if own.fits(of, &-&half, &(&half - 1u32)) {
                return own.negative(of);
            }
            let kind = Kind::Bit(of.clone(), place);
            Polynomial::atom(own.intern(kind, BigInt::zero(), BigInt::one()))
        })
    }

    /// The whole part of a polynomial over a power of two.
    fn floor(&mut self, of: &Polynomial, power: u32) -> Polynomial {
        if power == 0 {
            return of.clone();
        }
        if self.fits(of, &BigInt::zero(), &((BigInt::one() << power) - 1u32)) {
            return Polynomial::default();
        }
        self.each_case(of, &mut |own, of| own.plain_floor(of, power))
    }

    fn plain_floor(&mut self, of: &Polynomial, power: u32) -> Polynomial {
        let whole = BigInt::one() << power;
        let (zero, most) = (BigInt::zero(), &whole - 1u32);
        // What is a multiple of the power comes out; the rest has factors about zero, or else above it.
        let rest = of.reduced(power);
        let out = (of - &rest).mapped(|factor| factor >> power);
        if self.fits(&rest, &zero, &most) {
            return out;
        }
        if self.fits(&rest, &-&whole, &most) {
            return &out - &self.negative(&rest);
        }
        let rest = of.mapped(|factor| factor & &most);
        let out = (of - &rest).mapped(|factor| factor >> power);
        let (low, high) = self.bounds(&rest);
        let (low, high): (BigInt, BigInt) = (low >> power, high >> power);
        if low == high {
            return &out + &Polynomial::constant(low);
        }
        let rest = Polynomial::atom(self.intern(Kind::Floor(rest, power), low, high));
        &out + &rest
    }

    /// A word of so many bits as a number that is not below zero.
    pub(in crate::vector::equivalence) fn unsigned(
        &mut self,
        of: &Polynomial,
        width: u32,
    ) -> Polynomial {
        let most = (BigInt::one() << width) - 1u32;
        if self.fits(of, &BigInt::zero(), &most) { of.clone() } else { self.bits(of, 0, width) }
    }

    /// A word of so many bits as a number in two's complement.
    pub(in crate::vector::equivalence) fn signed(
        &mut self,
        of: &Polynomial,
        width: u32,
    ) -> Polynomial {
        let half = BigInt::one() << (width - 1);
        if self.fits(of, &-&half, &(&half - 1u32)) {
            return of.clone();
        }
        let sign = self.bits(of, width - 1, 1);
        &self.bits(of, 0, width) - &sign.shifted(width)
    }
}
