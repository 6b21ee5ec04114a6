//! Fixed-width hexadecimal text, the form every vector file uses. Spec clause `W-4`.

use super::bounded;

/// `bits` in lower-case hexadecimal, zero-padded to whole nibbles of `width`.
///
/// ```
/// assert_eq!(guardbit::bits::hex(0x1f, 35), "00000001f");
/// ```
pub fn hex(bits: u128, width: u32) -> String {
    format!("{bits:0digits$x}", digits = width.div_ceil(4) as usize)
}

/// Appends `digits` hexadecimal digits of `bits`, for words of any width up to 128.
#[inline]
pub fn push_hex(out: &mut Vec<u8>, bits: u128, digits: usize) {
    let low = bounded(bits & u128::from(u64::MAX));
    if digits <= 16 {
        push_hex_narrow(out, low, digits);
    } else {
        push_hex_narrow(out, bounded(bits >> 64), digits - 16);
        push_hex_narrow(out, low, 16);
    }
}

/// Appends `digits` (1 to 16) hexadecimal digits of a word of up to 64 bits.
#[inline]
pub fn push_hex_narrow(out: &mut Vec<u8>, bits: u64, digits: usize) {
    debug_assert!((1..=16).contains(&digits));
    out.extend_from_slice(&hex_digits(bits)[16 - digits..]);
}

/// All sixteen hexadecimal digits of a word, most significant first.
///
/// Nibbles are spread to bytes eight at a time in plain integer arithmetic: vector files are
/// written tens of millions of rows a second.
#[inline]
pub fn hex_digits(bits: u64) -> [u8; 16] {
    let high = u128::from(spread(bits >> 32));
    let low = u128::from(spread(bits & 0xffff_ffff));
    (high << 64 | low).to_be_bytes()
}

/// Eight nibbles of a 32-bit value as eight ASCII digits, most significant first in the word.
#[inline]
const fn spread(half: u64) -> u64 {
    let pairs = (half | half << 16) & 0x0000_ffff_0000_ffff;
    let quads = (pairs | pairs << 8) & 0x00ff_00ff_00ff_00ff;
    let nibbles = (quads | quads << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    // Adding 6 carries into bit 4 exactly for the digits a to f; 'a' - '0' - 10 is 39.
    let letters = (nibbles + 0x0606_0606_0606_0606) >> 4 & 0x0101_0101_0101_0101;
    nibbles + 0x3030_3030_3030_3030 + letters * 39
}
