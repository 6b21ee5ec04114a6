//! Depth codecs that register machines pick: 1/w as a small float, 18 bits by leading ones, and the code of
//! a depth slope. Spec clauses `RG-14` and `RG-19`.

/// 1/w of .32 fixed point as 4.12 float, larger is farther; the lowest 0 for 1/w of one or more, and
/// 0xf001 below 2^-16.
///
/// ```
/// use guardbit::value::w_float;
/// assert_eq!(w_float(1 << 32), 0);
/// assert_eq!(w_float(0xffff), 0xf001);
/// // One half: no leading zero, and all of the bits below the leading one inverted.
/// assert_eq!(w_float(0x8000_0000), 0x1000);
/// ```
pub const fn w_float(w: i64) -> u32 {
    let bits = w.cast_unsigned();
    if bits >> 32 & 0xffff != 0 {
        return 0;
    }
    let zeros = (bits << 32).leading_zeros();
    if zeros >= 16 {
        return 0xf001;
    }
    #[allow(clippy::cast_possible_truncation, reason = "12 bits")]
    let mantissa = (!bits >> (19 - zeros)) as u32 & 0xfff;
    let code = (zeros << 12) + mantissa + 1;
    if code > 0xffff { 0xffff } else { code }
}

/// 18 bits as a 3-bit exponent, the number of leading ones, and the 11 bits below the zero that ends them;
/// moved up by the two bits that a buffer stores beside.
///
/// ```
/// use guardbit::value::leading_ones;
/// assert_eq!(leading_ones(0x2c8), 0x2c);
/// assert_eq!(leading_ones(0x3ffff), 0xfffc);
/// ```
pub const fn leading_ones(depth: u32) -> u32 {
    let ones = (!(depth << 14)).leading_zeros();
    let exponent = if ones > 7 { 7 } else { ones };
    let shift = 6u32.saturating_sub(exponent);
    (exponent << 11 | depth >> shift & 0x7ff) << 2
}

/// 16 bits of slope along and down, as the power of two above their sum, by its logarithm: what tells a
/// coplanar surface from another.
pub const fn slope_code(along: i64, down: i64) -> u32 {
    let sum = (magnitude(along) + magnitude(down)) & 0xffff;
    let power = match sum {
        0x4000.. => 0x8000,
        0 => 1,
        1 => 3,
        _ => 1 << (u32::BITS - sum.leading_zeros()),
    };
    let mut code = 0;
    let masks = [0xaaaa, 0xcccc, 0xf0f0, 0xff00];
    let mut bit = 0;
    while bit < 4 {
        if power & masks[bit] != 0 {
            code |= 1 << bit;
        }
        bit += 1;
    }
    code
}

/// The 16 bits above the fraction, a negative one by its complement.
const fn magnitude(slope: i64) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "16 bits")]
    let high = (slope >> 16) as u32 & 0xffff;
    if high & 0x8000 != 0 { !high & 0x7fff } else { high }
}
