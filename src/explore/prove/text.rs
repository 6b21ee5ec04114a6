//! Numbers as people read them.

use crate::exact::{Rational, integer};
use num_traits::{Signed, Zero};

/// Sub-pixels as pixels: `5`, `-1/2`, `32767+255/256`.
pub(super) fn pixels(value: i128, s: u32) -> String {
    let (whole, rest) = (value >> s, value - (value >> s << s));
    if rest == 0 { whole.to_string() } else { mixed(&crate::exact::dyadic(value, s)) }
}

/// A point in pixels.
pub(super) fn point([x, y]: [i128; 2], s: u32) -> String {
    format!("({}, {})", pixels(x, s), pixels(y, s))
}

/// A rational as a whole and a fraction, `3+1/3`; `-1/3` when the whole is zero.
pub(super) fn mixed(value: &Rational) -> String {
    let magnitude = value.abs();
    let (whole, sign) = (magnitude.trunc(), if value.is_negative() { "-" } else { "" });
    let rest = &magnitude - &whole;
    match (whole.is_zero(), rest.is_zero()) {
        (_, true) => format!("{sign}{whole}"),
        (true, false) => format!("{sign}{rest}"),
        (false, false) if sign.is_empty() => format!("{whole}+{rest}"),
        (false, false) => format!("-({whole}+{rest})"),
    }
}

/// A rational to six decimals, cut, for reading beside the exact one.
pub(super) fn decimal(value: &Rational) -> String {
    let scaled = (value.abs() * integer(1_000_000)).to_integer().to_string();
    let padded = format!("{scaled:0>7}");
    let (whole, rest) = padded.split_at(padded.len() - 6);
    format!("{}{whole}.{rest}", if value.is_negative() { "-" } else { "" })
}

/// The same for a bound that is not negative: rounded up.
pub(super) fn decimal_up(value: &Rational) -> String {
    let millions = (value * integer(1_000_000)).ceil();
    decimal(&(millions / integer(1_000_000)))
}

/// `1 bit`, `2 bits`.
pub(super) fn bits(count: u32) -> String {
    if count == 1 { "1 bit".to_owned() } else { format!("{count} bits") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::ratio;

    #[test]
    fn numbers_read_as_they_should() {
        assert_eq!(
            (pixels(-1, 1), pixels(5, 1), pixels(4, 1)),
            ("-1/2".into(), "2+1/2".into(), "2".into())
        );
        assert_eq!(mixed(&ratio(-7, 3).unwrap()), "-(2+1/3)");
        assert_eq!(decimal(&ratio(-1, 3).unwrap()), "-0.333333");
        assert_eq!(decimal(&ratio(25, 2).unwrap()), "12.500000");
        assert_eq!(decimal_up(&ratio(1, 3).unwrap()), "0.333334");
    }
}
