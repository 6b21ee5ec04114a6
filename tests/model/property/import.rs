//! Snapping against exact decimal expansions.

use crate::property::cases;
use crate::property::rounding::{round, roundings};
use guardbit::bits::Rounding;
use guardbit::setup::{
    Coordinate, Endless, Source, VertexConfig, VertexError, snap_f64, snap_fixed,
};
use num_bigint::BigInt;
use proptest::prelude::*;

/// A finite double as numerator over 10^1080: its decimal expansion ends by then.
fn decimal(value: f64) -> (BigInt, BigInt) {
    let text = format!("{value:.1080}").replace('.', "");
    (text.parse().unwrap(), BigInt::from(10).pow(1080))
}

/// `value * 2^fraction`, rounded.
fn exact_snap(value: f64, fraction: u32, mode: Rounding) -> BigInt {
    let (numerator, denominator) = decimal(value);
    round(mode, &(numerator << fraction), &denominator)
}

/// Doubles: ties of a grid, coordinates, and any pattern at all.
fn reals() -> impl Strategy<Value = f64> {
    prop_oneof![
        (any::<i32>(), 0..24i32).prop_map(|(v, shift)| f64::from(v) * 0.5f64.powi(shift)),
        -40_000.0..40_000.0f64,
        any::<u64>().prop_map(f64::from_bits),
        any::<u32>().prop_map(|bits| f64::from(f32::from_bits(bits))),
    ]
}

fn fields() -> impl Strategy<Value = VertexConfig> {
    let flags = any::<[bool; 4]>();
    (1..=16u32, 0..=16u32, flags, roundings()).prop_map(|(integer, sub_pixel, flags, snap)| {
        let [signed, closed, narrow, clamp] = flags;
        let source = if narrow { Source::F32 } else { Source::F64 };
        let endless = if clamp { Endless::Clamp } else { Endless::Refuse };
        VertexConfig { integer, sub_pixel, signed, closed, snap, source, endless, lattice: None }
    })
}

proptest! {
    #![proptest_config(cases(300))]

    // Clause S-3
    #[test]
    fn a_double_is_snapped_as_the_number_it_is(
        value in reals(), fraction in 0..=32u32, mode in roundings(),
    ) {
        let got = snap_f64(value, fraction, mode);
        if !value.is_finite() {
            prop_assert_eq!(got, None);
            return Ok(());
        }
        let exact = exact_snap(value, fraction, mode);
        match got {
            Some(got) => prop_assert_eq!(BigInt::from(got), exact),
            None => prop_assert!(exact.magnitude() >= BigInt::from(1u128 << 125).magnitude()),
        }
    }

    // Clauses S-1, S-2, S-3
    #[test]
    fn a_profile_snaps_clamps_or_refuses(field in fields(), value in reals()) {
        field.validate().unwrap();
        let bits = field.integer + field.sub_pixel;
        let (low, end) = if field.signed {
            (-(1i128 << (bits - 1)), 1i128 << (bits - 1))
        } else {
            (0, 1i128 << bits)
        };
        let high = if field.closed { end } else { end - 1 };
        prop_assert_eq!(field.range(), (low, high));
        let here = Coordinate { key: "f", vertex: Some(2), axis: 1 };
        let got = field.snap(here, value, field.sub_pixel, field.range());
        // Rounded to binary32 by reading the decimal expansion, not by a conversion.
        let value = match field.source {
            Source::F32 if value.is_finite() => {
                f64::from(format!("{value:.1080}").parse::<f32>().unwrap())
            }
            _ => value,
        };
        if value.is_finite() {
            let exact = exact_snap(value, field.sub_pixel, field.snap);
            let held = exact.clone().clamp(low.into(), high.into());
            // Beyond 2^126 a finite number is as good as endless.
            let endless = exact.magnitude().bits() > 126;
            if exact == held || (endless && field.endless == Endless::Clamp) {
                prop_assert_eq!(got.map(BigInt::from), Ok(held));
            } else {
                let refused = matches!(
                    got,
                    Err(VertexError::Outside { coordinate, .. }
                        | VertexError::NotFinite { coordinate, .. }) if coordinate == here
                );
                prop_assert!(refused);
            }
        } else if field.endless == Endless::Clamp {
            let expected = if value.is_nan() { 0 } else if value > 0.0 { high } else { low };
            prop_assert_eq!(got, Ok(expected));
        } else {
            let refused = matches!(got, Err(VertexError::NotFinite { coordinate, .. }) if coordinate == here);
            prop_assert!(refused);
        }
    }

    // Clause S-4
    #[test]
    fn a_fixed_number_is_snapped_as_the_number_it_is(
        bits in any::<i64>(), narrow in any::<u8>(), fraction in 0..=200u32, mode in roundings(),
    ) {
        use fixed::types::{I20F44, U4F4};
        let check = |got: Option<i128>, bits: BigInt, from: u32| {
            let exact = round(mode, &(bits << fraction), &(BigInt::from(1) << from));
            prop_assert_eq!(got, i128::try_from(exact).ok());
            Ok(())
        };
        check(snap_fixed(I20F44::from_bits(bits), fraction, mode), bits.into(), 44)?;
        check(snap_fixed(U4F4::from_bits(narrow), fraction, mode), narrow.into(), 4)?;
        check(snap_fixed(U4F4::ZERO, fraction, mode), BigInt::ZERO, 4)?;
    }
}
