//! What a normal form stands for, at every point of small inputs.

use super::algebra::Kind;
use super::{Algebra, Polynomial};
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

/// Ends of the three inputs.
const ENDS: [(i32, i32); 3] = [(0, 7), (-4, 3), (0, 1)];

/// The value of a polynomial at a point.
fn at(algebra: &Algebra, of: &Polynomial, point: [i32; 3]) -> BigInt {
    let value = |atom: u32| -> BigInt {
        match algebra.kind(atom) {
            Kind::Input(name) => point[name.parse::<usize>().unwrap()].into(),
            Kind::Negative(of) => u8::from(at(algebra, of, point).is_negative()).into(),
            Kind::Zero(of) => u8::from(at(algebra, of, point).is_zero()).into(),
            Kind::Bit(of, place) => (at(algebra, of, point) >> *place) & BigInt::one(),
            Kind::Floor(of, power) => at(algebra, of, point) >> *power,
        }
    };
    of.terms()
        .map(|(atoms, factor)| atoms.iter().fold(factor.clone(), |all, atom| all * value(*atom)))
        .sum()
}

fn inputs(algebra: &mut Algebra) -> [Polynomial; 3] {
    let mut n = 0..;
    ENDS.map(|(low, high)| algebra.input(&n.next().unwrap().to_string(), low.into(), high.into()))
}

/// Sums of products of two inputs, with small factors.
fn polynomial(algebra: &Algebra, [x, y, c]: &[Polynomial; 3], factors: &[i32]) -> Polynomial {
    let one = Polynomial::constant(1);
    let parts = [
        one.clone(),
        x.clone(),
        y.clone(),
        c.clone(),
        algebra.product(x, y),
        algebra.product(x, c),
        algebra.product(x, x),
        algebra.product(&algebra.product(x, y), c),
    ];
    let scaled = parts.iter().zip(factors).map(|(part, factor)| part.scaled(&(*factor).into()));
    scaled.fold(Polynomial::default(), |sum, part| &sum + &part)
}

fn points() -> impl Iterator<Item = [i32; 3]> {
    (0..=7).flat_map(|x| (-4..=3).flat_map(move |y| (0..=1).map(move |c| [x, y, c])))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn forms_are_what_they_stand_for(
        factors in proptest::collection::vec(-9i32..=9, 8),
        other in proptest::collection::vec(-3i32..=3, 8),
        low in 0u32..6,
        count in 1u32..6,
    ) {
        let mut algebra = Algebra::default();
        let inputs = inputs(&mut algebra);
        let p = polynomial(&algebra, &inputs, &factors);
        let q = polynomial(&algebra, &inputs, &other);
        // A choice, as a netlist has it, and then everything of it.
        let choice = algebra.negative(&q);
        let chosen = &p + &algebra.product(&choice, &(&q - &p));
        for of in [&p, &chosen] {
            let negative = algebra.negative(of);
            let zero = algebra.zero(of);
            let bits = algebra.bits(of, low, count);
            let signed = algebra.signed(&of.reduced(count), count);
            let unsigned = algebra.unsigned(of, count);
            let zero_word = algebra.zero_word(of, count);
            // A word in two parts, put together again.
            let high = algebra.bits(of, 2, 4);
            let word = &algebra.bits(of, 0, 2) + &high.shifted(2);
            prop_assert_eq!(&word.reduced(6), &algebra.bits(of, 0, 6).reduced(6));
            for point in points() {
                let value = at(&algebra, of, point);
                let mask = |bits: u32| (BigInt::one() << bits) - 1u32;
                let truth = |is: bool| BigInt::from(u8::from(is));
                let at = |form: &Polynomial| at(&algebra, form, point);
                prop_assert_eq!(at(&negative), truth(value.is_negative()));
                prop_assert_eq!(at(&zero), truth(value.is_zero()));
                prop_assert_eq!(at(&bits), (&value >> low) & mask(count));
                prop_assert_eq!(at(&unsigned), &value & mask(count));
                prop_assert_eq!(at(&zero_word), truth((&value & mask(count)).is_zero()));
                let word = &value & mask(count);
                let sign = BigInt::from(u8::from(word.bit(u64::from(count) - 1)));
                prop_assert_eq!(at(&signed), word - (sign << count));
            }
        }
    }

    #[test]
    fn ranges_hold_every_value(factors in proptest::collection::vec(-9i32..=9, 8)) {
        let mut algebra = Algebra::default();
        let inputs = inputs(&mut algebra);
        let p = polynomial(&algebra, &inputs, &factors);
        let (low, high) = algebra.bounds(&p);
        let values: Vec<BigInt> = points().map(|point| at(&algebra, &p, point)).collect();
        prop_assert!(values.iter().all(|value| *value >= low && *value <= high));
        prop_assert!(algebra.fits(&p, &low, &high));
        // What fits, is so.
        let (least, most) = (values.iter().min().unwrap(), values.iter().max().unwrap());
        prop_assert!(!algebra.fits(&p, &(least + 1), most) && !algebra.fits(&p, least, &(most - 1)));
    }
}

/// A difference is one way round, an absolute value is not below zero, and the order of factors is nothing.
#[test]
fn one_form_for_what_is_equal() {
    let mut algebra = Algebra::default();
    let [x, y, _] = inputs(&mut algebra);
    let difference = &x - &y;
    let below = algebra.negative(&difference);
    let above = algebra.negative(&-&difference);
    let same = algebra.zero(&difference);
    assert_eq!(&(&below + &above) + &same, Polynomial::constant(1));
    assert_eq!(algebra.product(&below, &same), Polynomial::default());
    let double = algebra.product(&below, &difference).shifted(1);
    let size = &difference - &double;
    assert!(algebra.fits(&size, &BigInt::zero(), &BigInt::from(11)));
    let square = algebra.product(&size, &size);
    assert_eq!(square, algebra.product(&difference, &difference));
}
