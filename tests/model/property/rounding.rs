//! Roundings against exact rationals.

use crate::property::cases;
use crate::property::words::wide;
use guardbit::bits::{Rounding, RunTime, Word};
use guardbit::exact;
use num_bigint::BigInt;
use num_integer::Integer;
use proptest::prelude::*;

/// The rounding of n / d by the oracle of clause R-1.
pub(crate) fn round(mode: Rounding, n: &BigInt, d: &BigInt) -> BigInt {
    exact::round(&exact::Rational::new(n.clone(), d.clone()), mode)
}

pub(crate) fn roundings() -> impl Strategy<Value = Rounding> {
    prop::sample::select(&Rounding::ALL[..])
}

/// Numbers in which ties are common.
fn with_ties() -> impl Strategy<Value = i128> {
    prop_oneof![
        wide(),
        (wide(), 0..127u32).prop_map(|(v, shift)| v >> shift << shift),
        (any::<i64>(), 0..64u32).prop_map(|(v, shift)| i128::from(v) << shift),
        Just(i128::MIN),
        Just(i128::MAX),
    ]
}

proptest! {
    #![proptest_config(cases(3000))]

    // Clauses
    #[test]
    fn a_shift_is_a_rounded_quotient(v in with_ties(), shift in 0..=260u32, mode in roundings()) {
        let divisor = BigInt::from(1) << shift;
        let (got, inexact) = mode.shift_right(v, shift);
        prop_assert_eq!(BigInt::from(got), round(mode, &v.into(), &divisor));
        prop_assert_eq!(inexact, BigInt::from(v).mod_floor(&divisor) != BigInt::ZERO);
    }

    // Clauses
    #[test]
    fn a_word_shifts_like_its_value(n in 1..=128u32, v in any::<i128>(), shift in 0..=130u32, mode in roundings()) {
        let word = Word::wrapping(RunTime::new(n).unwrap(), v);
        let expected = round(mode, &word.to_i128().into(), &(BigInt::from(1) << shift));
        prop_assert_eq!(BigInt::from(word.shift_right(shift, mode).0.to_i128()), expected);
    }

    // Clauses
    #[test]
    fn a_quotient_is_rounded_once(n in with_ties(), d in with_ties(), small in -9..=9i128, mode in roundings()) {
        for (n, d) in [(n, d), (n, small), (small, d), ((d / 2).wrapping_mul(small), d)] {
            let got = mode.divide(n, d);
            if d == 0 {
                prop_assert_eq!(got, None);
                continue;
            }
            let expected = round(mode, &n.into(), &d.into());
            let exact = BigInt::from(n).is_multiple_of(&d.into());
            let expected = i128::try_from(expected).ok().map(|quotient| (quotient, !exact));
            prop_assert_eq!(got, expected, "{} / {}", n, d);
        }
    }

    // Clause R-4
    #[test]
    fn odd_may_come_before_a_narrower_rounding(
        v in wide(), first in 0..60u32, second in 2..60u32, mode in roundings(),
    ) {
        let (between, _) = Rounding::Odd.shift_right(v, first);
        prop_assert_eq!(mode.shift_right(between, second).0, mode.shift_right(v, first + second).0);
    }
}
