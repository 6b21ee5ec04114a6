//! Correct rounding of a rational: the two integers around it, and the choice between them.
//! The oracle of spec clauses `R-1` to `R-4`.

use super::number::{Rational, dyadic, ratio};
use crate::bits::Rounding;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive};
use std::cmp::Ordering;

/// `value` rounded to an integer.
///
/// ```
/// use guardbit::{bits::Rounding, exact};
/// let tie = exact::dyadic(-5, 1);
/// assert_eq!(exact::round(&tie, Rounding::NearestAway), (-3).into());
/// assert_eq!(exact::round(&tie, Rounding::NearestUp), (-2).into());
/// ```
pub fn round(value: &Rational, rounding: Rounding) -> BigInt {
    let below = value.floor().to_integer();
    let above = value.ceil().to_integer();
    let (inner, outer) = if value.is_negative() {
        (above.clone(), below.clone())
    } else {
        (below.clone(), above.clone())
    };
    let (even, odd) = if below.is_even() {
        (below.clone(), above.clone())
    } else {
        (above.clone(), below.clone())
    };
    // An integer is its own neighbour on both sides, so every choice but this one is harmless.
    if below == above {
        return below;
    }
    let nearest = |on_tie: BigInt| {
        let to_below = value - Rational::from_integer(below.clone());
        let to_above = Rational::from_integer(above.clone()) - value;
        match to_below.cmp(&to_above) {
            Ordering::Less => below.clone(),
            Ordering::Equal => on_tie,
            Ordering::Greater => above.clone(),
        }
    };
    match rounding {
        Rounding::Floor => below,
        Rounding::Ceiling => above,
        Rounding::TowardZero => inner,
        Rounding::AwayFromZero => outer,
        Rounding::NearestEven => nearest(even),
        Rounding::NearestUp => nearest(above.clone()),
        Rounding::NearestDown => nearest(below.clone()),
        Rounding::NearestAway => nearest(outer),
        Rounding::NearestTowardZero => nearest(inner),
        Rounding::Odd => odd,
    }
}

/// `value / 2^shift` rounded; the twin of a right shift. Always fits for `shift >= 1`.
pub fn round_dyadic(value: i128, shift: u32, rounding: Rounding) -> i128 {
    // The quotient lies between value and zero, or one unit beside zero.
    let rounded = round(&dyadic(value, shift), rounding).to_i128();
    rounded.unwrap_or_else(|| unreachable!("{value} >> {shift} is no larger than {value}"))
}

/// `numerator / denominator` rounded; `None` when the denominator is zero or the result too large.
pub fn divide(numerator: i128, denominator: i128, rounding: Rounding) -> Option<i128> {
    round(&ratio(numerator, denominator)?, rounding).to_i128()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_round_as_the_definitions_say() {
        // -6/4 to 6/4: the integers nearest to each, written down by hand.
        let rows: [(Rounding, [i128; 13]); Rounding::ALL.len()] = [
            (Rounding::Floor, [-2, -2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1]),
            (Rounding::Ceiling, [-1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2]),
            (Rounding::TowardZero, [-1, -1, -1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1]),
            (Rounding::AwayFromZero, [-2, -2, -1, -1, -1, -1, 0, 1, 1, 1, 1, 2, 2]),
            (Rounding::NearestEven, [-2, -1, -1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 2]),
            (Rounding::NearestUp, [-1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1, 2]),
            (Rounding::NearestDown, [-2, -1, -1, -1, -1, 0, 0, 0, 0, 1, 1, 1, 1]),
            (Rounding::NearestAway, [-2, -1, -1, -1, -1, 0, 0, 0, 1, 1, 1, 1, 2]),
            (Rounding::NearestTowardZero, [-1, -1, -1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 1]),
            (Rounding::Odd, [-1, -1, -1, -1, -1, -1, 0, 1, 1, 1, 1, 1, 1]),
        ];
        assert_eq!(rows.map(|(rounding, _)| rounding), Rounding::ALL, "a row for each rounding");
        for (rounding, expected) in rows {
            let got: Vec<i128> = (-6..=6).map(|n| round_dyadic(n, 2, rounding)).collect();
            assert_eq!(got, expected, "{rounding}");
        }
    }

    #[test]
    fn the_ends_of_the_lane_do_not_overflow() {
        assert_eq!(divide(i128::MIN, -1, Rounding::Floor), None);
        assert_eq!(divide(1, 0, Rounding::Floor), None);
        assert_eq!(divide(i128::MIN, 2, Rounding::Odd), Some(-(1 << 126)));
        assert_eq!(round_dyadic(i128::MIN, 0, Rounding::Floor), i128::MIN);
    }
}
