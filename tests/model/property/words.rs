//! Words and DDAs against unbounded integers.

use crate::property::cases;
use guardbit::bits::{Event, Mismatch, Overflow, RunTime, Width as _, Word};
use guardbit::dda::{Linear, Planar};
use guardbit::format::{Q, QFormat};
use num_bigint::BigInt;
use num_integer::Integer;
use proptest::prelude::*;

fn modulus(width: u32) -> BigInt {
    BigInt::from(1) << width
}

/// The pattern of `value` in `width` bits.
fn pattern(value: &BigInt, width: u32) -> BigInt {
    value.mod_floor(&modulus(width))
}

/// The signed reading of that pattern.
fn signed(value: &BigInt, width: u32) -> BigInt {
    let pattern = pattern(value, width);
    if pattern < modulus(width - 1) { pattern } else { pattern - modulus(width) }
}

fn widths() -> impl Strategy<Value = u32> {
    1..=128u32
}

/// Integers of every magnitude.
pub(crate) fn wide() -> impl Strategy<Value = i128> {
    (any::<i128>(), 0..128u32).prop_map(|(value, shift)| value >> shift)
}

fn word(width: u32, value: i128) -> Word<RunTime> {
    Word::wrapping(RunTime::new(width).unwrap(), value)
}

proptest! {
    #![proptest_config(cases(2000))]

    // Clauses W-1, W-2
    #[test]
    fn words_are_integers_mod_2_to_the_n(n in widths(), a in wide(), b in wide(), k in wide()) {
        let (x, y) = (word(n, a), word(n, b));
        let (u, v) = (signed(&a.into(), n), signed(&b.into(), n));
        prop_assert_eq!(BigInt::from(x.to_i128()), u.clone());
        prop_assert_eq!(BigInt::from(x.to_bits()), pattern(&a.into(), n));
        prop_assert_eq!(Word::from_bits(x.width(), x.to_bits()), x);
        let sum = &u + &v;
        prop_assert_eq!(BigInt::from(x.try_add(y).unwrap().to_i128()), signed(&sum, n));
        prop_assert_eq!(BigInt::from(x.try_sub(y).unwrap().to_i128()), signed(&(&u - &v), n));
        prop_assert_eq!(BigInt::from(x.wrapping_mul(k).to_i128()), signed(&(&u * k), n));
        let fits = signed(&sum, n) == sum;
        let (wrapped, status) = x.add_with(y, Overflow::Wrap).unwrap();
        prop_assert_eq!(Ok(wrapped), x.try_add(y));
        prop_assert_eq!(status.has(Event::Wrap), !fits);
        let checked = x.add_with(y, Overflow::Error).ok();
        prop_assert_eq!(checked.map(|(w, _)| BigInt::from(w.to_i128())), fits.then(|| sum.clone()));
        let (low, high): (BigInt, BigInt) = (-modulus(n - 1), modulus(n - 1) - 1);
        let held = sum.clamp(low.clone(), high.clone());
        let (end, _) = x.add_with(y, Overflow::Saturate).unwrap();
        prop_assert_eq!(BigInt::from(end.to_i128()), held);
        // Equal as words, too: nothing is left below the word.
        prop_assert_eq!(end, word(n, end.to_i128()));
        let saturated = BigInt::from(Word::saturating(x.width(), a).to_i128());
        prop_assert_eq!(saturated, BigInt::from(a).clamp(low, high));
        prop_assert_eq!(Word::checked(x.width(), a).is_some(), u == BigInt::from(a));
    }

    // Clause W-2
    #[test]
    fn words_of_two_widths_do_not_mix(n in widths(), m in widths(), a in wide(), b in wide()) {
        prop_assume!(n != m);
        let (x, y) = (word(n, a), word(m, b));
        let refused = Mismatch { left: x.width(), right: y.width() };
        prop_assert_eq!(x.try_add(y), Err(refused));
        prop_assert_eq!(x.try_sub(y), Err(refused));
        prop_assert!(x.add_with(y, Overflow::Wrap).is_err());
        prop_assert_eq!(Linear::try_new(x, y), Err(refused));
        prop_assert_eq!(Planar::try_new(x, x, y), Err(refused));
        prop_assert_eq!(Planar::try_new(x, y, x), Err(refused));
        prop_assert_eq!(x.partial_cmp(&y), None);
        prop_assert_ne!(x, y);
    }

    // Clause W-4: a decimal is the exact value
    #[test]
    fn decimals_are_exact(value in wide(), i in 0..=4u32, f in 0..=124u32) {
        prop_assume!(i + f > 0);
        let word = Word::wrapping(QFormat::new(i, f).unwrap(), value);
        let text = word.to_string();
        let (whole, part) = text.split_once('.').unwrap_or((&text, ""));
        let digits: BigInt = format!("{whole}{part}").parse().unwrap();
        // digits / 10^n == value / 2^f
        let ten = (0..part.len()).fold(BigInt::from(1), |n, _| n * 10);
        prop_assert_eq!(digits << f, BigInt::from(word.to_i128()) * ten);
        prop_assert!(!part.ends_with('0'));
    }

    // Clause W-4
    #[test]
    fn text_is_the_pattern_in_whole_nibbles(n in widths(), a in any::<i128>()) {
        let text = format!("{:x}", word(n, a));
        prop_assert_eq!(text.len(), n.div_ceil(4) as usize);
        prop_assert_eq!(u128::from_str_radix(&text, 16).unwrap(), word(n, a).to_bits());
        let mut bytes = Vec::new();
        guardbit::bits::push_hex(&mut bytes, word(n, a).to_bits(), text.len());
        prop_assert_eq!(bytes, text.into_bytes());
        let binary = format!("{:b}", word(n, a));
        prop_assert_eq!(binary.len(), n as usize);
        prop_assert_eq!(u128::from_str_radix(&binary, 2).unwrap(), word(n, a).to_bits());
    }

    // Clauses D-1, D-2, D-3
    #[test]
    fn every_path_reads_the_same_bits(
        n in widths(), start in wide(), dx in wide(), dy in wide(),
        moves in prop::collection::vec(0..4u8, 0..80), jump in wide(),
    ) {
        let there = Planar::try_new(word(n, start), word(n, dx), word(n, dy)).unwrap();
        let (mut walk, mut x, mut y) = (there, 0i128, 0i128);
        for step in moves {
            match step {
                0 => { walk.step_x(); x += 1; }
                1 => { walk.back_x(); x -= 1; }
                2 => { walk.step_y(); y += 1; }
                _ => { walk.back_y(); y -= 1; }
            }
            let exact = BigInt::from(start) + BigInt::from(x) * dx + BigInt::from(y) * dy;
            prop_assert_eq!(BigInt::from(walk.accumulator().to_bits()), pattern(&exact, n));
            prop_assert_eq!(walk.accumulator(), there.at(x, y));
        }
        // However far, in closed form.
        let exact = BigInt::from(start) + BigInt::from(jump) * dy;
        prop_assert_eq!(BigInt::from(there.row(jump).accumulator().to_bits()), pattern(&exact, n));
        let mut line = Linear::try_new(word(n, start), word(n, dx)).unwrap();
        let exact = BigInt::from(start) + BigInt::from(jump) * dx;
        prop_assert_eq!(BigInt::from(line.at(jump).to_bits()), pattern(&exact, n));
        let (before, status) = (line.accumulator(), line.overflowing_step());
        let sum = signed(&start.into(), n) + signed(&dx.into(), n);
        prop_assert_eq!(status.has(Event::Wrap), signed(&sum, n) != sum);
        line.step_back();
        prop_assert_eq!(line.accumulator(), before);
    }

    // Clause F-1
    #[test]
    fn conversions_are_exact_or_absent(
        value in wide(), i in 0..=64u32, f in 0..=64u32, i2 in 0..=64u32, f2 in 0..=64u32,
    ) {
        prop_assume!(i + f > 0 && i2 + f2 > 0);
        let (from, to) = (QFormat::new(i, f).unwrap(), QFormat::new(i2, f2).unwrap());
        let word = Word::wrapping(from, value);
        // value / 2^f == bits / 2^f2
        let (bits, rest) = (BigInt::from(word.to_i128()) << f2).div_mod_floor(&modulus(f));
        let fits = signed(&bits, i2 + f2) == bits;
        let expected = (rest == BigInt::ZERO && fits).then_some(bits);
        let got = word.checked_convert(to).map(|w| BigInt::from(w.to_i128()));
        prop_assert_eq!(got, expected);
    }

    // Clause F-2
    #[test]
    fn fixed_numbers_convert_exactly_or_not_at_all(bits in any::<u64>(), narrow in any::<i16>()) {
        use fixed::types::{I8F8, I24F40, I40F24, U20F44};
        let format = Q::<30, 40>;
        let from = U20F44::from_bits(bits);
        let exact = bits % 16 == 0;
        let word = Word::from_fixed(format, from);
        prop_assert_eq!(word.map(Word::to_i128), exact.then(|| i128::from(bits >> 4)));
        prop_assert_eq!(word.and_then(Word::to_fixed::<U20F44>), exact.then_some(from));
        let small = I8F8::from_bits(narrow);
        let word = Word::from_fixed(format, small).unwrap();
        prop_assert_eq!(word.to_i128(), i128::from(narrow) << 32);
        prop_assert_eq!(word.to_fixed::<I8F8>(), Some(small));
        prop_assert_eq!(word.to_fixed::<I24F40>().map(I24F40::to_bits), Some(i64::from(narrow) << 32));
        prop_assert_eq!(word.to_fixed::<I40F24>().map(I40F24::to_bits), Some(i64::from(narrow) << 16));
        prop_assert_eq!(word.to_fixed::<U20F44>().is_some(), narrow >= 0);
        prop_assert_eq!(QFormat::of::<U20F44>().unwrap().fraction(), 44);
    }
}
