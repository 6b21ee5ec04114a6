//! Rounding of a shift or a quotient to an integer. Spec clauses `R-1` to `R-4`.

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rounding's name in other fixed-point libraries; `None` where it has no such mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RoundingNames {
    /// This crate's name, as profiles spell it.
    pub guardbit: &'static str,
    /// Algorithmic C `ac_fixed` quantisation mode.
    pub ac_fixed: Option<&'static str>,
    /// Vitis HLS `ap_fixed` quantisation mode.
    pub ap_fixed: Option<&'static str>,
    /// SystemC `sc_fixed` quantisation mode.
    pub systemc: Option<&'static str>,
    /// The VHDL numeric_std operation that rounds so.
    pub numeric_std: Option<&'static str>,
    /// The direction in Gappa's `fixed<...>`.
    pub gappa: &'static str,
    /// Value of the devices' parameter `ROUNDING`; `hdl/setup_divider.sv` has a constant of the
    /// same name and value. Spec clause `J-1`.
    pub code: u32,
}

/// What was dropped, compared with one half of the last kept bit.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Dropped {
    Nothing,
    BelowHalf,
    Half,
    AboveHalf,
}

/// What decides between the two neighbours of a quotient that is no integer.
#[derive(Clone, Copy)]
#[allow(clippy::struct_excessive_bools, reason = "four independent facts of one quotient")]
struct Between {
    /// Whether the lower neighbour is odd.
    odd: bool,
    /// Whether the quotient is negative.
    negative: bool,
    /// Whether more than one half of the last kept bit was dropped.
    beyond_half: bool,
    /// Whether exactly one half was.
    tie: bool,
}

/// The table of roundings, one row each: name in profiles; code in RTL; whether it errs by one half at
/// most (the others err by less than one); names elsewhere; when the lower neighbour is raised by one.
macro_rules! roundings {
    ($($(#[$meta:meta])* $name:ident $text:literal $code:literal $error:ident
        hls($($hls:literal)*) vhdl($($vhdl:literal)?) gappa($gappa:literal)
        raises |$q:ident| $raises:expr;)*) => {
        /// How the part below the last kept bit is disposed of. Spec clause `R-1`.
        ///
        /// [`Rounding::names`] has each rounding's names in other libraries.
        ///
        /// ```
        /// use guardbit::bits::Rounding;
        /// // -5/2 lies between -3 and -2, half way.
        /// assert_eq!(Rounding::Floor.shift_right(-5, 1), (-3, true));
        /// assert_eq!(Rounding::NearestEven.shift_right(-5, 1), (-2, true));
        /// assert_eq!(Rounding::Odd.shift_right(-5, 1), (-3, true));
        /// assert_eq!(Rounding::Odd.names().gappa, "od");
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[cfg_attr(feature = "verification", derive(JsonSchema))]
        #[serde(rename_all = "kebab-case")]
        pub enum Rounding {
            $($(#[$meta])* $name,)*
        }

        impl Rounding {
            /// Every rounding, in the order of the table.
            pub const ALL: [Self; [$($text),*].len()] = [$(Self::$name),*];

            /// The names of this rounding elsewhere.
            pub const fn names(self) -> RoundingNames {
                match self {
                    $(Self::$name => {
                        let (hls, vhdl): (&[&str], &[&str]) = (&[$($hls),*], &[$($vhdl)?]);
                        names($text, $code, hls, vhdl, $gappa)
                    })*
                }
            }

            /// Whether the rounding errs by one half at most; the others err by less than one.
            pub const fn is_nearest(self) -> bool {
                match self {
                    $(Self::$name => matches!(Error::$error, Error::Half),)*
                }
            }

            /// Whether the lower neighbour of a quotient has to be raised by one.
            #[inline]
            const fn raises(self, odd: bool, negative: bool, dropped: Dropped) -> bool {
                let beyond_half = matches!(dropped, Dropped::AboveHalf);
                let tie = matches!(dropped, Dropped::Half);
                if matches!(dropped, Dropped::Nothing) {
                    return false;
                }
                let between = Between { odd, negative, beyond_half, tie };
                match self {
                    $(Self::$name => { let $q = between; $raises })*
                }
            }
        }
    };
}

/// The largest error of a rounding, in units of the last kept bit.
enum Error {
    Half,
    One,
}

const fn names(
    guardbit: &'static str,
    code: u32,
    hls: &[&'static str],
    vhdl: &[&'static str],
    gappa: &'static str,
) -> RoundingNames {
    let (ac_fixed, ap_fixed, systemc) = match hls {
        [ac, ap, sc] => (Some(*ac), Some(*ap), Some(*sc)),
        _ => (None, None, None),
    };
    let numeric_std = match vhdl {
        [operation] => Some(*operation),
        _ => None,
    };
    RoundingNames { guardbit, ac_fixed, ap_fixed, systemc, numeric_std, gappa, code }
}

roundings! {
    /// Toward minus infinity.
    Floor "floor" 0 One
        hls("AC_TRN" "AP_TRN" "SC_TRN") vhdl("shift_right") gappa("dn") raises |_q| false;
    /// Toward plus infinity.
    Ceiling "ceiling" 1 One hls() vhdl() gappa("up") raises |_q| true;
    /// Toward zero: drop the fraction of the magnitude.
    TowardZero "toward-zero" 2 One
        hls("AC_TRN_ZERO" "AP_TRN_ZERO" "SC_TRN_ZERO") vhdl("\"/\"") gappa("zr")
        raises |q| q.negative;
    /// Away from zero whenever anything is dropped.
    AwayFromZero "away-from-zero" 3 One hls() vhdl() gappa("aw") raises |q| !q.negative;
    /// Nearest; a tie goes to the even neighbour. "Nearest" alone means this.
    #[serde(alias = "nearest")]
    NearestEven "nearest-even" 4 Half
        hls("AC_RND_CONV" "AP_RND_CONV" "SC_RND_CONV") vhdl() gappa("ne")
        raises |q| q.beyond_half || (q.tie && q.odd);
    /// Nearest; a tie goes toward plus infinity.
    NearestUp "nearest-up" 5 Half
        hls("AC_RND" "AP_RND" "SC_RND") vhdl() gappa("nu")
        raises |q| q.beyond_half || q.tie;
    /// Nearest; a tie goes toward minus infinity.
    NearestDown "nearest-down" 6 Half
        hls("AC_RND_MIN_INF" "AP_RND_MIN_INF" "SC_RND_MIN_INF") vhdl() gappa("nd")
        raises |q| q.beyond_half;
    /// Nearest; a tie goes away from zero.
    NearestAway "nearest-away" 7 Half
        hls("AC_RND_INF" "AP_RND_INF" "SC_RND_INF") vhdl() gappa("na")
        raises |q| q.beyond_half || (q.tie && !q.negative);
    /// Nearest; a tie goes toward zero.
    NearestTowardZero "nearest-toward-zero" 8 Half
        hls("AC_RND_ZERO" "AP_RND_ZERO" "SC_RND_ZERO") vhdl() gappa("nz")
        raises |q| q.beyond_half || (q.tie && q.negative);
    /// To the odd neighbour whenever anything is dropped, so that a later, narrower rounding to
    /// nearest is still right.
    Odd "odd" 9 One hls() vhdl() gappa("od") raises |q| !q.odd;
}

impl Rounding {
    /// `value / 2^shift`, rounded once, and whether anything was dropped. Spec clause `R-2`.
    ///
    /// Formats: any Q-format in, `shift` fewer fraction bits out. Range: the result of a shift by
    /// one or more always fits. A shift of 128 or more keeps only the sign.
    #[inline]
    pub const fn shift_right(self, value: i128, shift: u32) -> (i128, bool) {
        if shift == 0 {
            return (value, false);
        }
        if shift >= 128 {
            // The magnitude is at most 2^127, which is at most half of 2^128.
            let dropped = match (value, shift) {
                (0, _) => Dropped::Nothing,
                (i128::MIN, 128) => Dropped::Half,
                (1.., _) => Dropped::BelowHalf,
                _ => Dropped::AboveHalf,
            };
            let floor = value >> 127;
            let raised = self.raises(floor & 1 != 0, value < 0, dropped);
            return (floor + raised as i128, value != 0);
        }
        let floor = value >> shift;
        let rest = value.cast_unsigned() & ((1u128 << shift) - 1);
        let half = 1u128 << (shift - 1);
        let dropped = if rest == 0 {
            Dropped::Nothing
        } else if rest < half {
            Dropped::BelowHalf
        } else if rest == half {
            Dropped::Half
        } else {
            Dropped::AboveHalf
        };
        (floor + self.raises(floor & 1 != 0, value < 0, dropped) as i128, rest != 0)
    }

    /// [`Rounding::shift_right`] of a number of at most 62 bits by at most 62 places, without branches.
    /// Spec clause `R-2`.
    #[inline]
    pub(crate) const fn shift_right_narrow(self, value: i64, shift: u32) -> i64 {
        debug_assert!(value.unsigned_abs() >> 62 == 0 && shift <= 62, "62 bits");
        let (rest, negative) = ((1 << shift) - 1, value >> 63 & 1);
        let (half, odd) = (((rest + 1) >> 1) & rest, value >> shift & 1);
        // What carries into the last kept bit exactly where the rounding raises.
        let raise = match self {
            Self::Floor => 0,
            Self::Ceiling => rest,
            Self::TowardZero => rest * negative,
            Self::AwayFromZero => rest * (1 - negative),
            Self::Odd => rest * (1 - odd),
            _ if shift == 0 => 0,
            Self::NearestUp => half,
            Self::NearestDown => half - 1,
            Self::NearestEven => half - 1 + odd,
            Self::NearestAway => half - negative,
            Self::NearestTowardZero => half - 1 + negative,
        };
        (value + raise) >> shift
    }

    /// `numerator / denominator`, rounded once, and whether anything was dropped.
    /// `None` when the denominator is zero or the quotient does not fit. Spec clause `R-3`.
    ///
    /// Error against exact: below one unit for the directed roundings and odd, at most one half
    /// for the nearest ones.
    #[inline]
    pub fn divide(self, numerator: i128, denominator: i128) -> Option<(i128, bool)> {
        let quotient = match (i64::try_from(numerator), i64::try_from(denominator)) {
            // A 64-bit divide is several times quicker than the 128-bit library routine.
            (Ok(n), Ok(d)) if d != 0 && n != i64::MIN => i128::from(n / d),
            _ => numerator.checked_div(denominator)?,
        };
        let rest = numerator - quotient * denominator;
        if rest == 0 {
            return Some((quotient, false));
        }
        // The remainder has the numerator's sign: lower by one where the true quotient is negative.
        let negative = (numerator < 0) != (denominator < 0);
        let floor = quotient - i128::from(negative);
        let magnitude = denominator.unsigned_abs();
        let above_floor =
            if negative { magnitude - rest.unsigned_abs() } else { rest.unsigned_abs() };
        let dropped = match above_floor.cmp(&(magnitude - above_floor)) {
            std::cmp::Ordering::Less => Dropped::BelowHalf,
            std::cmp::Ordering::Equal => Dropped::Half,
            std::cmp::Ordering::Greater => Dropped::AboveHalf,
        };
        Some((floor + i128::from(self.raises(floor & 1 != 0, negative, dropped)), true))
    }
}

impl std::fmt::Display for Rounding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.names().guardbit)
    }
}

#[cfg(test)]
mod tests {
    use super::Rounding;

    /// Clause R-2, of numbers of few bits by all shifts, and at the ends.
    #[test]
    fn a_narrow_shift_is_the_shift() {
        let ends = [(1 << 62) - 1, 1 - (1 << 62), 3 << 60, -(3 << 60), 5 << 59];
        for value in (-70..=70).chain(ends) {
            for shift in (0..=9).chain(55..=62) {
                for rounding in Rounding::ALL {
                    let plain = rounding.shift_right(value.into(), shift).0;
                    let narrow = rounding.shift_right_narrow(value, shift);
                    assert_eq!(i128::from(narrow), plain, "{value} >> {shift}, {rounding}");
                }
            }
        }
    }
}
