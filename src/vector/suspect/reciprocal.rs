//! A reciprocal unit as hardware has it, over a [`Path`]: a shift, a table, a line or products.
//! Clauses `CH-9` to `CH-12`.

use super::fault::{Operator, Path, low_ones};
use crate::bits::bounded;
use crate::value::Refine;
use crate::vector::device::{NamedWord, STEPS};
use crate::vector::units::ReciprocalPort;

/// The module that the shipped devices have for it.
pub(super) const MODULE: &str = "reciprocal_unit";

/// What the parts of a Newton step are called.
struct Names {
    product: &'static str,
    whole: &'static str,
    cut: &'static str,
    r: &'static str,
    t: &'static str,
    square: &'static str,
    wide: &'static str,
    dropped: &'static str,
    limit: &'static str,
    result: &'static str,
    y: &'static str,
}

const NAMES: [Names; 2] = [
    Names {
        product: "x y of Newton step 1",
        whole: "the product x y of Newton step 1",
        cut: "what r of Newton step 1 is cut by",
        r: "r of Newton step 1",
        t: "t = 2 - r of Newton step 1",
        square: "y t of Newton step 1",
        wide: "the product y t of Newton step 1",
        dropped: "what the result of Newton step 1 drops",
        limit: "the largest result of Newton step 1",
        result: "what Newton step 1 gives",
        y: "the result of Newton step 1",
    },
    Names {
        product: "x y of Newton step 2",
        whole: "the product x y of Newton step 2",
        cut: "what r of Newton step 2 is cut by",
        r: "r of Newton step 2",
        t: "t = 2 - r of Newton step 2",
        square: "y t of Newton step 2",
        wide: "the product y t of Newton step 2",
        dropped: "what the result of Newton step 2 drops",
        limit: "the largest result of Newton step 2",
        result: "what Newton step 2 gives",
        y: "the result of Newton step 2",
    },
];

/// Cut by some places, and rounded to the nearest, where half a unit was forgotten or is too much.
fn cut(path: &Path, name: &'static str, word: i128, places: u32) -> i128 {
    let half = if places > 0 { 1i128 << (places - 1) } else { 0 };
    let all = low_ones(places);
    path.only(
        name,
        ("a floor", word >> places),
        [
            ("the nearest", word.wrapping_add(half) >> places),
            ("a ceiling", word.wrapping_add(all) >> places),
            ("a floor of one place less", word >> places.saturating_sub(1)),
            ("a floor of one place more", word >> (places + 1)),
            ("a shift the other way", word << places),
        ],
    )
}

/// Moved up by some places, where another way is near.
pub(super) fn up(path: &Path, name: &'static str, word: i128, places: u32) -> i128 {
    let near = [("moved down", word >> places), ("where it was", word)];
    path.only(name, ("moved up", word << places), near)
}

/// A distance of a shift.
pub(super) fn distance(places: i128) -> u32 {
    bounded(places.clamp(0, 126))
}

/// The words for q.
pub(super) fn words(path: &Path, port: &ReciprocalPort, q: i128) -> Vec<NamedWord> {
    path.within(MODULE, || unit(path, port, q))
}

fn unit(path: &Path, port: &ReciprocalPort, q: i128) -> Vec<NamedWord> {
    let (config, width) = (port.unit.config(), port.width);
    let (p, k, m, n) = (config.operand, config.index, config.entry, port.unit.bits());
    let q = path.word("q at the reciprocal unit", q, width);
    let length = i128::from(i128::BITS - q.leading_zeros());
    let counted = u32::BITS - width.leading_zeros();
    let length = path.word("the bit length of q", length, counted);
    let places = path.number("the distance of the normalisation", i128::from(width) - length);
    // The distance is a word as wide as the length, and wraps as it does.
    let places = distance(places & low_ones(counted));
    let moved = up(path, "q at the normalisation", q << p, places) & low_ones(width + p);
    let x = cut(path, "what the normalised operand drops", moved, width);
    let x = path.word("the normalised operand", x, p);
    let h = p - 1 - k;
    let index = path.word("the index of the table", (x >> h) & low_ones(k), k);
    let at = path.number("the entry that is read", index);
    let entry = |at: i128| {
        let table = port.unit.table();
        let at = at.rem_euclid(1i128 << (k + 1));
        table.get(bounded::<_, usize>(at)).copied().map_or_else(|| beyond(k, m), i128::from)
    };
    let found = path.word("the entry of the table", entry(at), m);
    let mut named = vec![("length", length), ("x", x), ("entry", found)];
    let mantissa = match &config.refine {
        Refine::None => found,
        Refine::Linear => {
            let after = path.number("the entry at the end of the line", at + 1);
            let next = path.word("the next entry of the table", entry(after), m);
            let part = path.word("the bits of x below the index", x & low_ones(h), h.max(1));
            let drop = [found, next];
            let drop = path.sum("what the line falls in its interval", Operator::Subtract, drop, m);
            let product = path.product("fall of the line times the part of x", drop, part);
            let name = "the product of the line";
            let product = path.word(name, product, m + h.max(1));
            let fall = cut(path, "what the fall of the line drops", product, h);
            let fall = path.word("the fall of the line", fall, m);
            named.extend([("far", next), ("part", part), ("fall", fall)]);
            path.sum("the value on the line", Operator::Subtract, [found, fall], m)
        }
        Refine::Newton { bits } => {
            let (mut y, mut before) = (found, m);
            let mut earlier = [(found, m); 2];
            for ((names, b), words) in NAMES.iter().zip(bits).zip(STEPS) {
                let step = newton(path, names, [x, y], [p, before, *b]);
                named.extend(words.into_iter().zip(step));
                earlier = [(y, before), earlier[0]];
                (y, before) = (step[2], *b);
            }
            let moved = |(y, bits): (i128, u32)| move_to(y, bits, n);
            path.only(
                "what is given as the mantissa",
                ("the result of the last Newton step", y),
                [
                    ("what that step began with, moved to its place,", moved(earlier[0])),
                    ("what that step began with", earlier[0].0),
                    ("the entry of the table, moved to its place,", moved((found, m))),
                    ("the entry of the table", found),
                ],
            )
        }
    };
    let mantissa = path.word("the mantissa", mantissa, n);
    let widest = u32::BITS - (n + width - 1).leading_zeros();
    let exponent = path.sum("the exponent", Operator::Add, [i128::from(n) - 1, length], widest);
    named.extend([("mantissa", mantissa), ("exponent", exponent)]);
    named
}

/// What the formula gives past the last interval, where a table is read too far.
pub(super) fn beyond(k: u32, m: u32) -> i128 {
    let divisor = (4i128 << k) + 1;
    let twice = (2i128 << (m + k + 1)) / divisor;
    (twice + 1) >> 1
}

/// A fraction of some bits as one of others.
fn move_to(y: i128, from: u32, to: u32) -> i128 {
    if to >= from { y << (to - from) } else { y >> (from - to) }
}

fn newton(path: &Path, names: &Names, [x, y]: [i128; 2], [p, m, b]: [u32; 3]) -> [i128; 3] {
    let product = path.product(names.product, x, y);
    let product = path.word(names.whole, product, p + m);
    let places = p - 1 + m;
    let r = if places >= b {
        cut(path, names.cut, product, places - b)
    } else {
        product << (b - places)
    };
    let r = path.word(names.r, r, b + 1);
    let t = path.sum(names.t, Operator::Subtract, [2i128 << b, r], b + 2) & low_ones(b + 2);
    let square = path.product(names.square, y, t);
    let square = path.word(names.wide, square, m + b + 2);
    let next = cut(path, names.dropped, square, m);
    let most = low_ones(b);
    let above = path.when(names.limit, next > most);
    let next = if above { most } else { next };
    let moved = move_to(y, m, b);
    let near = [
        ("y before it, moved to its place: the step is missing,", moved),
        ("y before it: the step is missing,", y),
    ];
    let result = path.only(names.result, ("its result", next), near);
    [r, t, path.word(names.y, result, b)]
}
