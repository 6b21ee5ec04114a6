//! Depth formats: where Z/w spends its codes, and what a complementary float gives back.
//!
//! `r = f/n`. Integer Z/w is u(z) = f (z - n) / (z (f - n)), 0 near and 1 far; complementary is
//! 1 - u. A code of size c spans c |dz/du| of depth; "linear" spreads its codes evenly over z.

use super::statement::{Statement, real};
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer, round};
use num_bigint::BigInt;
use num_traits::ToPrimitive;

pub(super) fn statements() -> Vec<Statement> {
    let mut list = vec![
        Statement::exact(
            "depth-format.far-loss",
            "ratio of the step of integer Z/w at the far plane to the linear step: f/n, so \
             log2(f/n) bits are lost; for f/n = 2, 16, 1000",
            "2, 16, 1000",
            || [2, 16, 1000].map(|r| step_ratio(&integer(r), &integer(r)).to_string()).join(", "),
        ),
        Statement::exact(
            "depth-format.mean-step",
            "mean of the ratio of depth-format.far-loss over z, (r^2 + r + 1) / (3r), for r = 10, \
             100, 1000; computed with Simpson's rule, which is exact for a step that is quadratic \
             in z",
            "37/10, 3367/100, 333667/1000",
            || [10, 100, 1000].map(|r| mean_step(r).to_string()).join(", "),
        ),
        Statement::exact(
            "depth-format.codes-near",
            "percentage of all codes that are nearer than 1 m, for n = 0.1 m, f = 10^4 m, 24 bits",
            "90.0009 %",
            || {
                // In units of n: z = 10, r = 10^5.
                let share = code(&integer(10), &integer(100_000));
                let codes = round(&(share * integer(1 << 24)), Rounding::Ceiling);
                let millionths = Rational::from_integer(codes) * integer(1_000_000) * dyadic(1, 24);
                let digits = round(&millionths, Rounding::NearestEven).to_string();
                let (whole, rest) = digits.split_at(digits.len().saturating_sub(4));
                format!("{whole}.{rest} %")
            },
        ),
        Statement::exact(
            "depth-format.step-1m",
            "depth in cm at which dz per code reaches 1 m, for n = 0.1 m, f = 10^4 m, 24 bits",
            "129528",
            step_one_metre,
        ),
    ];
    list.extend([(100, "1.962"), (500, "1.934"), (1000, "1.937")].map(|(r, expected)| {
        Statement::exact(
            format!("depth-format.float-{r}"),
            format!(
                "complementary Z/w in a 24-bit unsigned floating-point format with gradual \
                 underflow, f/n = {r}: ratio of the mean step over z to the linear step for 4 \
                 exponent bits, and the best number of exponent bits from 1 to 6"
            ),
            format!("{expected}, best 4"),
            move || {
                let means: Vec<f64> = (1..=6).map(|e| float_mean(r, e)).collect();
                let best = (1..=6).zip(&means).min_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |m| m.0);
                format!("{:.3}, best {best}", means[3])
            },
        )
    }));
    list
}

/// u at depth z, both in units of the near plane.
fn code(z: &Rational, r: &Rational) -> Rational {
    r * (z - integer(1)) / (z * (r - integer(1)))
}

/// |dz/du| over f - n at depth z in units of the near plane: z^2 / r.
fn step_ratio(z: &Rational, r: &Rational) -> Rational {
    z * z / r
}

fn mean_step(r: i128) -> Rational {
    let r = integer(r);
    let middle = (&r + integer(1)) * dyadic(1, 1);
    let weighted =
        step_ratio(&integer(1), &r) + integer(4) * step_ratio(&middle, &r) + step_ratio(&r, &r);
    weighted / integer(6)
}

fn step_one_metre() -> String {
    // dz per code is z^2 (f - n) / (f n) / (2^24 - 1) = 1 m; lengths in cm: n = 10, f = 10^6.
    let reaches = |z: i128| z * z * (1_000_000 - 10) >= 100 * 1_000_000 * 10 * ((1 << 24) - 1);
    let (mut low, mut high) = (0, 1_000_000);
    while low < high {
        let middle = i128::midpoint(low, high);
        if reaches(middle) { high = middle } else { low = middle + 1 }
    }
    low.to_string()
}

/// Mean over z of the step of a float with `e` exponent bits in 24, over the linear step.
///
/// In the binade [2^-j, 2^(1-j)) of 1 - u a step is 2^-j 2^-m, m = 24 - e; the lowest exponent
/// is shared with what lies below it. Within a binade dz/du is z^2 times a constant, whose
/// integral is exact.
fn float_mean(r: i128, e: u32) -> f64 {
    let (mantissa, ratio_fn) = (24 - e, integer(r));
    let depth_at = |v: &Rational| &ratio_fn / (integer(1) + v * (&ratio_fn - integer(1)));
    let lowest = (1_u32 << e) - 1;
    // Summed in units of 2^-80: exact sums of so many denominators would take minutes.
    let unit = integer(1 << 80);
    let mut total = BigInt::from(0);
    for j in 1..=lowest {
        let top = dyadic(1, j - 1);
        let bottom = if j == lowest { integer(0) } else { dyadic(1, j) };
        let [near, far] = [depth_at(&top), depth_at(&bottom)];
        let cube = |z: Rational| &z * &z * &z;
        // z^2 (f - n) / (n f) integrated over z, then the mean over f - n in units of the linear
        // step (f - n) / 2^24.
        let integral = (cube(far) - cube(near)) / integer(3) / &ratio_fn;
        let mean = integral * dyadic(1 << 24, j + mantissa) / (&ratio_fn - integer(1));
        total += round(&(mean * &unit), Rounding::NearestEven);
    }
    total.to_f64().unwrap_or(f64::NAN) / real(1_i128 << 80)
}
