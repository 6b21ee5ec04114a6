//! Reciprocal units by their clauses.

use super::{NEAREST, newton, rounded, unit};
use guardbit::bits::Rounding;
use guardbit::exact::{integer, ratio};
use guardbit::value::{ReciprocalConfig, Refine};

/// Clauses CH-9, CH-10, CH-11 and CH-12: every operand of small units, by the clauses; and malformed ones by name.
#[test]
fn reciprocals_are_those_of_the_clauses() {
    let unit = ReciprocalConfig { operand: 10, index: 4, entry: 7, ..unit() };
    let ready = unit.unit().unwrap();
    for x in 512..1024 {
        assert_eq!(i128::from(ready.mantissa(x)), newton(&unit, x.into()), "{x}");
    }
    let lines = ReciprocalConfig { refine: Refine::Linear, ..unit.clone() };
    let ready = lines.unit().unwrap();
    for x in 512..1024i128 {
        let j = x >> 5 & 15;
        let entry = |j: i128| {
            let exact = integer(128) / (integer(1) + ratio(j, 16).unwrap());
            rounded(&exact, NEAREST).min(127)
        };
        let fall = ratio((entry(j) - entry(j + 1)) * (x & 31), 32).unwrap();
        let want = entry(j) - rounded(&fall, Rounding::Floor);
        assert_eq!(i128::from(ready.mantissa(x.try_into().unwrap())), want, "{x}");
    }
    // The worst operand is the worst of all, and is reached.
    let worst = ready.worst();
    let error = |x: u64| i128::from(x) * i128::from(ready.mantissa(x)) - (1i128 << worst.scale);
    assert_eq!((512..1024).map(|x| error(x).abs()).max().unwrap(), worst.error.abs());
    assert_eq!(error(worst.operand), worst.error);
    let faults = [
        (ReciprocalConfig { index: 10, ..unit.clone() }, "1 <= index <= 9"),
        (ReciprocalConfig { entry: 1, ..unit.clone() }, "2 <= entry <= 31"),
        (ReciprocalConfig { operand: 33, ..unit.clone() }, "2 <= operand <= 32"),
        (ReciprocalConfig { refine: Refine::Newton { bits: vec![] }, ..unit.clone() }, "0 steps"),
        (ReciprocalConfig { table: Some(vec![1; 15]), ..unit.clone() }, "needs 16"),
        (ReciprocalConfig { table: Some(vec![128; 16]), ..unit.clone() }, "2^7 - 1"),
        (
            ReciprocalConfig { table: Some((1..18).collect()), refine: Refine::Linear, ..unit },
            "must not rise",
        ),
    ];
    for (config, want) in faults {
        let error = config.unit().unwrap_err().to_string();
        assert!(error.contains(want), "{want}: {error}");
    }
}

/// Clauses CH-9 and CH-14: what a cut adds to the error of a unit is less than 2^-(p-1), without a product of both errors;
/// every q of 9 bits, and tables that are too small, too large and rounded.
#[test]
fn a_cut_adds_less_than_a_unit_of_the_operand() {
    let mut cuts = 0;
    for table in [None, Some(vec![31; 4]), Some(vec![1; 4]), Some(vec![31, 31, 20, 31])] {
        for operand in [3, 4, 6] {
            let config = ReciprocalConfig {
                operand,
                index: 2,
                entry: 5,
                refine: Refine::None,
                table: table.clone(),
            };
            let unit = config.unit().unwrap();
            let worst = unit.worst();
            let d = ratio(worst.error.abs(), 1 << worst.scale).unwrap();
            let cut = ratio(1, 1 << (operand - 1)).unwrap();
            for q in 1..512i128 {
                let got = unit.of(q);
                let off = ratio(q * got.mantissa, 1 << got.exponent).unwrap() - integer(1);
                let off = if off < integer(0) { -off } else { off };
                assert!(off < &d + &cut, "{operand} {table:?} {q}: {off}");
                cuts += u32::from(off > d);
            }
        }
    }
    // Cuts do matter: an error above that of all normalised operands is found.
    assert!(cuts > 100, "{cuts}");
}
