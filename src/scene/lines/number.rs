//! Numbers and lists out of raw JSON text, each error with its field.

use serde_json::value::RawValue;

use super::{Fault, Part, count, object};

/// How much of a wrong value a message shows.
const SHOWN: usize = 48;

/// The start of a value, for a message.
fn shown(text: &str) -> String {
    let mut short: String = text.chars().take(SHOWN).collect();
    if short.len() < text.len() {
        short.push_str("...");
    }
    short
}

/// A value of the wrong kind.
pub(super) fn kind(need: &'static str, got: &str) -> Fault {
    Fault::Kind { need, got: shown(got) }
}

/// The elements of a list, unread.
pub(super) fn list<'a>(raw: &'a RawValue, field: &str) -> Part<Vec<&'a RawValue>> {
    serde_json::from_str(raw.get()).map_err(|_| (field.to_owned(), kind("a list [...]", raw.get())))
}

/// A string, such as a register word.
pub(super) fn word(raw: &RawValue, field: &str) -> Part<String> {
    serde_json::from_str(raw.get())
        .map_err(|_| (field.to_owned(), kind("a string of digits", raw.get())))
}

/// x, y and z where it is given.
pub(super) fn triple<T>(
    raw: &RawValue,
    field: &str,
    number: impl Fn(&RawValue, &str) -> Part<T>,
) -> Part<([T; 2], Option<T>)> {
    let read = |raw, index| number(raw, &format!("{field}[{index}]"));
    match list(raw, field)?.as_slice() {
        [x, y] => Ok(([read(x, 0)?, read(y, 1)?], None)),
        [x, y, z] => Ok(([read(x, 0)?, read(y, 1)?], Some(read(z, 2)?))),
        other => Err(count(field, "2 or 3 coordinates x, y, z are needed", other.len())),
    }
}

/// An exact integer: a JSON number or a string of decimal digits.
pub(super) fn integer(raw: &RawValue, field: &str) -> Part<i128> {
    let text = raw.get();
    let fail = |fault| Err((field.to_owned(), fault));
    let quoted;
    let digits = if text.starts_with('"') {
        quoted = word(raw, field)?;
        quoted.as_str()
    } else {
        text
    };
    let magnitude = digits.strip_prefix('-').unwrap_or(digits);
    if magnitude.is_empty() || !magnitude.bytes().all(|byte| byte.is_ascii_digit()) {
        return fail(Fault::NotInteger(shown(text)));
    }
    digits.parse().or_else(|_| fail(Fault::TooWide(shown(text))))
}

/// A double: a JSON number, rounded to nearest even, or a bit pattern.
pub(super) fn real(raw: &RawValue, field: &str) -> Part<f64> {
    let text = raw.get();
    let fail = |fault| Err((field.to_owned(), fault));
    match text.as_bytes().first() {
        Some(b'-' | b'0'..=b'9') => match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => fail(Fault::Overflow(shown(text))),
        },
        Some(b'{') => pattern(raw, field),
        _ => fail(kind("a number or {\"bits\": \"...\"}", text)),
    }
}

/// `{"bits": "7fc00000"}`: the pattern of a binary32 or binary64.
fn pattern(raw: &RawValue, field: &str) -> Part<f64> {
    let fail = |fault| Err((field.to_owned(), fault));
    let members = object::members(raw.get())?;
    let [(key, bits)] = members.as_slice() else {
        return fail(kind("exactly one key `bits`", raw.get()));
    };
    if key != "bits" {
        return Err((format!("{field}.{key}"), kind("the key `bits`", key)));
    }
    let field = format!("{field}.bits");
    let digits = word(bits, &field)?;
    let hex = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let value = match digits.len() {
        8 if hex => u32::from_str_radix(&digits, 16).map(widen),
        16 if hex => u64::from_str_radix(&digits, 16).map(f64::from_bits),
        _ => return Err((field, Fault::Pattern(shown(bits.get())))),
    };
    value.map_err(|_| (field, Fault::Pattern(shown(bits.get()))))
}

/// Exact. A NaN keeps sign and payload, which a conversion need not do.
fn widen(bits: u32) -> f64 {
    let value = f32::from_bits(bits);
    if !value.is_nan() {
        return f64::from(value);
    }
    let bits = u64::from(bits);
    f64::from_bits((bits >> 31) << 63 | 0x7ff << 52 | (bits & 0x7f_ffff) << 29)
}
