//! Points of the unit circle, the same on every machine.
//!
//! The standard library's `sin` and `cos` are the platform's and may differ in the last bit; these
//! are polynomials in `+ - * /`, with the angle reduced in integers.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

/// `[cos, sin]` of `k / n` turns.
///
/// `n = 0` is taken as 1. Error: below 4e-16 absolute; exact at multiples of a quarter turn. After
/// reduction the angle is at most an eighth of a turn, where the first terms left out, x^17 / 17!
/// and x^18 / 18!, are below 5e-17.
pub(crate) fn circle(k: u16, n: u16) -> [f64; 2] {
    let n = i32::from(n).max(1);
    let k = i32::from(k) % n;
    // 4k/n = quarter + rest/n with |rest| <= n/2; everything stays below 2^20.
    let quarter = (8 * k + n) / (2 * n);
    let rest = 4 * k - quarter * n;
    let [cos, sin] = eighth(f64::from(rest) / f64::from(4 * n) * TAU);
    match quarter % 4 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// The tangent of an angle in radians, 0 < angle < pi/2.
///
/// Error: below 1e-15 of the value up to an eighth of a turn. Beyond, the angle is taken from pi/2, whose
/// double is 6e-17 off.
pub(crate) fn tangent(angle: f64) -> f64 {
    if angle <= FRAC_PI_4 {
        let [cos, sin] = eighth(angle);
        sin / cos
    } else {
        let [cos, sin] = eighth(FRAC_PI_2 - angle);
        cos / sin
    }
}

/// `[cos, sin]` of an angle of at most an eighth of a turn, in radians.
fn eighth(x: f64) -> [f64; 2] {
    let sin = x * nested(x * x, &[6., 20., 42., 72., 110., 156., 210.]);
    let cos = nested(x * x, &[2., 12., 30., 56., 90., 132., 182., 240.]);
    [cos, sin]
}

/// 1 - s/d0 (1 - s/d1 (1 - ...)), innermost first.
fn nested(square: f64, divisors: &[f64]) -> f64 {
    divisors.iter().rev().fold(1.0, |inner, divisor| 1.0 - square / divisor * inner)
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests {
    use super::*;

    #[test]
    fn the_error_bound_holds() {
        for n in [1, 2, 3, 7, 360, 1000, 65535] {
            for k in (0..n).step_by(1 + usize::from(n / 5000)) {
                let [cos, sin] = circle(k, n);
                // The platform's own functions, good to an ULP, on an angle that is itself rounded:
                // below pi/4 that costs nothing, so compare eighth by eighth.
                let eighth = 8 * u32::from(k) / u32::from(n);
                let part = |k: u32, n: u32| f64::from(k) / f64::from(n) * TAU;
                let up = part(8 * u32::from(k) - eighth * u32::from(n), 8 * u32::from(n));
                let down = part((eighth + 1) * u32::from(n) - 8 * u32::from(k), 8 * u32::from(n));
                let (want_cos, want_sin) = match eighth {
                    0 => (up.cos(), up.sin()),
                    1 => (down.sin(), down.cos()),
                    2 => (-up.sin(), up.cos()),
                    3 => (-down.cos(), down.sin()),
                    4 => (-up.cos(), -up.sin()),
                    5 => (-down.sin(), -down.cos()),
                    6 => (up.sin(), -up.cos()),
                    _ => (down.cos(), -down.sin()),
                };
                assert!((cos - want_cos).abs() < 4e-16, "cos {k}/{n}: {cos} {want_cos}");
                assert!((sin - want_sin).abs() < 4e-16, "sin {k}/{n}: {sin} {want_sin}");
            }
        }
    }

    #[test]
    fn the_tangent_is_that_of_the_platform_but_for_the_last_bits() {
        for n in 1..1000 {
            let angle = f64::from(n) / 1000.0 * FRAC_PI_2;
            let (got, want) = (tangent(angle), angle.tan());
            assert!((got / want - 1.0).abs() < 1e-13, "{angle}: {got} {want}");
        }
        assert!((tangent(FRAC_PI_4) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn quarter_turns_are_exact() {
        for n in [4, 48, 65532] {
            for quarter in 0..4 {
                let want = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]][usize::from(quarter)];
                assert_eq!(circle(n / 4 * quarter, n), want);
            }
        }
        assert_eq!(circle(5, 0), [1.0, 0.0]);
    }
}
