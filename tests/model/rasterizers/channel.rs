//! Words, channels and the two depth codecs.

use super::{model, records, wrap};
use guardbit::format::{Layout, LayoutError};
use guardbit::value::{leading_ones, slope_code, w_float};

/// Clauses RG-1, RG-2 and RG-3: a value of five bits in three pieces, all of it, there and back; bits that no field
/// holds; and texts that are no fields.
#[test]
fn pieces_go_there_and_back() {
    let layout = Layout::parse(&["v[3]:2@30 -unused:3", "v:1@4 v[1]:2 %4x"]).unwrap();
    let gather = layout.find("v").unwrap();
    for value in 0..32u32 {
        let mut words = [0, 0];
        gather.scatter(i128::from(value), &mut words);
        assert_eq!(words, [(value >> 3) << 30, (value & 1) << 4 | value >> 1 & 3]);
        assert_eq!(gather.unsigned(&words), u64::from(value));
        assert_eq!(i128::from(gather.signed(&words)), wrap(i128::from(value), 5));
        let packer = layout.packer(&["v".to_owned()]).unwrap();
        assert_eq!(packer.words(&[i64::from(value)]).collect::<Vec<_>>(), words);
    }
    for word in 0..64u32 {
        // Five bits at the bottom: kept if the sixth is a copy of the fifth, as are all above it.
        let field = Layout::parse(&["x:5"]).unwrap();
        assert_eq!(field.dropped(&[word]).is_empty(), word < 32, "{word:b}");
        let negative = word | !0x1f;
        assert_eq!(field.dropped(&[negative]).is_empty(), negative >> 4 & 1 == 1, "{word:b}");
    }
    let mut text = String::new();
    layout.push_text(1, 0x2f, &mut text);
    assert_eq!(text, "002f");
    for bad in ["x:0", "x:33", "x:4@29", "x:4 y:1@3", "X", "x[64]:1", "x[40]:32", "%9x", "x@"] {
        assert!(Layout::parse(&[bad]).is_err(), "{bad}");
    }
    assert_eq!(Layout::parse::<&str>(&[]), Err(LayoutError::Empty));
}

/// Clause RG-20: every start and slope of four bits, by extension, shift, dropped bits and clamp, against
/// the arithmetic of the clause on plain integers.
#[test]
fn channels_of_four_bits() {
    let mut seen = 0;
    for (start, shift, along, drop) in
        [("sign", 0, 0, 0), ("zero", 0, 0, 1), ("sign", 1, 0, 0), ("zero", 2, 1, 2)]
    {
        for (clamp, guard, integer, fraction, width) in [
            ("wrap", 0, 3, 2, 5),
            ("guard", 1, 2, 2, 6),
            ("sign", 2, 2, 1, 5),
            ("guard", 0, 2, 2, 7),
        ] {
            let text = format!(
                "radix = 16
input = [\"clip_left\", \"clip_right\", \"clip_top\", \"clip_bottom\", \"x\", \"y\", \"x_step\", \"end01\",
    \"end01_step\", \"rows01\", \"end12\", \"end12_step\", \"rows12\", \"leftward\", \"c:4\", \"c_dx:4\", \"c_dy:4\"]
records = [{{ letter = \"P\", words = [\"x\", \"y\", \"c\"] }}]
channels = [{{ names = [\"c\"], guard = {guard}, integer = {integer}, interpolation = {fraction}, \
                 clamp = \"{clamp}\", width = {width}, start = \"{start}\", shift = {shift}, \
                 shift-along = {along} }}]
[form.registers.engine.slopes]
edges = {{ given = {{ fraction = 4, rows = \"down\" }} }}
pixel-bias = 15
plane = {{ at-vertex = {{}} }}
clip = \"half-open\"
"
            )
            .replace("start = ", &format!("drop = {drop}, start = "));
            let model = model(8, 4, [8, 8], &text);
            for n in 0..4096u32 {
                let [c, dx, dy] = [n & 15, n >> 4 & 15, n >> 8];
                let words = [0, 8, 0, 8, 0, 0, 0, 48, 0, 2, 0, 0, 0, 0, c, dx, dy];
                for (_, record) in records(&model, &words) {
                    let (x, y) = (i128::from(record[0]), i128::from(record[1]));
                    let signed = |value: u32| wrap(i128::from(value), 4);
                    let first = if start == "zero" { i128::from(c) } else { signed(c) };
                    let step = (signed(dx) << along).div_euclid(1 << drop) << drop;
                    let held = wrap((first << shift) + step * x + (signed(dy) << shift) * y, width);
                    let bits = guard + integer + fraction;
                    let seen_bits = held.rem_euclid(1 << bits);
                    let top = 1 << (integer + fraction);
                    let value = match clamp {
                        "wrap" => seen_bits % top,
                        "sign" => wrap(seen_bits, bits).clamp(0, top - 1),
                        // The upper half of what lies outside reads as below.
                        _ if seen_bits < top => seen_bits,
                        _ if seen_bits - top < ((1 << bits) - top) / 2 => top - 1,
                        _ => 0,
                    };
                    assert_eq!(i128::from(record[2]), value >> fraction, "{n:03x} {x} {y} {text}");
                    seen += 1;
                }
            }
        }
    }
    assert_eq!(seen, 4 * 4 * 4096 * 6);
}

/// Clause RG-14: every 1/w of 16 bits and zeros, and all ones below, against the definition bit by bit.
#[test]
fn every_w() {
    for high in 0..1i64 << 17 {
        for low in [0, 0xffff, 0x8000] {
            let w = high << 16 | low;
            let expected = if w >= 1 << 32 {
                0
            } else if high == 0 {
                0xf001
            } else {
                let bits: Vec<i64> = (0..32).rev().map(|bit| w >> bit & 1).collect();
                let one = bits.iter().position(|bit| *bit == 1).unwrap();
                let below: i64 = (1..=12).map(|n| (1 - bits[one + n]) << (12 - n)).sum();
                (i64::try_from(one).unwrap() * 4096 + below + 1).min(0xffff)
            };
            assert_eq!(i64::from(w_float(w)), expected, "{w:x}");
        }
    }
}

/// Clause RG-19: all 18 bits of depth, and all pairs of depth slopes of a few codes.
#[test]
fn every_depth_and_slope() {
    for depth in 0..1u32 << 18 {
        let text = format!("{depth:018b}");
        let ones = text.chars().take_while(|c| *c == '1').count().min(7);
        // Seven ones leave eleven bits; the zero after fewer is not stored.
        let from = if ones == 7 { 7 } else { ones + 1 };
        let mantissa = u32::from_str_radix(&text[from..from + 11], 2).unwrap();
        assert_eq!(leading_ones(depth), (u32::try_from(ones).unwrap() << 11 | mantissa) << 2);
    }
    for along in -40i64..40 {
        for down in [-0x7fff, -0x4000, -1, 0, 1, 2, 0x3fff, 0x7fff] {
            let size = |slope: i64| if slope < 0 { -slope - 1 } else { slope };
            let power = match size(along) + size(down) {
                0 => 1,
                1 => 3,
                0x4000.. => 0x8000,
                sum => (1..16).map(|n| 1i64 << n).find(|power| *power > sum).unwrap(),
            };
            let masks = [0xaaaa, 0xcccc, 0xf0f0, 0xff00];
            let meets =
                masks.iter().enumerate().map(|(bit, mask)| i64::from(power & mask != 0) << bit);
            let got = i64::from(slope_code(along << 16, down << 16));
            assert_eq!(got, meets.sum::<i64>(), "{along} {down}");
        }
    }
}
