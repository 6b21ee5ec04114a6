//! What reciprocal units and dividers are given: ends, powers of two, every entry, ties, clamps, and random words.

use crate::case::walk::STRIPES;
use crate::case::{Class, Directed, Words};
use crate::format::ReadOut;
use crate::value::Corrector;
use crate::vector::bench::Goal;
use crate::vector::units::ReciprocalPort;

/// The most bits of an index whose entries are all read by directed tests.
const EVERY: u32 = 10;

fn low_ones(width: u32) -> i128 {
    if width == 0 { 0 } else { (u128::MAX >> (128 - width)).cast_signed() }
}

fn directed(
    tag: &'static str,
    catches: &'static str,
    tests: Vec<[i128; 2]>,
) -> Directed<[i128; 2]> {
    Directed { class: Class { tag, catches }, tests }
}

/// Directed tests of a reciprocal unit.
pub(super) fn reciprocal(port: &ReciprocalPort) -> Vec<Directed<[i128; 2]>> {
    let config = port.unit.config();
    let (width, p, k) = (port.width, config.operand, config.index);
    let most = low_ones(width);
    let within = |list: Vec<i128>| -> Vec<[i128; 2]> {
        list.into_iter().filter(|q| (1..=most).contains(q)).map(|q| [q, 0]).collect()
    };
    let ends = [most, 1, most - 1, 2, 3];
    let stripes = STRIPES.map(|stripe| stripe.cast_signed() & most);
    let turned = stripes.map(|stripe| !stripe & most);
    let powers = (0..width).flat_map(|bit| [-1, 0, 1].map(|miss| (1i128 << bit) + miss));
    // Each interval at both ends and in the middle, at changing lengths.
    let (h, step) = (p - 1 - k, k.saturating_sub(EVERY));
    let mut lengths = (1..=width).rev().cycle();
    let entries = (0..1i128 << (k - step)).flat_map(|j| {
        let part = [0, low_ones(h), low_ones(h) / 2 + 1];
        part.map(|part| (1i128 << k | j << step) << h | part.min(low_ones(h)))
    });
    let at_length = |x: i128, length: u32, rest: i128| {
        if length > p { x << (length - p) | rest & low_ones(length - p) } else { x >> (p - length) }
    };
    let entries = entries.flat_map(|x| {
        let length = lengths.next().unwrap_or(width);
        [at_length(x, width, -1), at_length(x, length, 0)]
    });
    // Where the operand is cut: ones and zeros on both sides of the last bit that is kept.
    let cuts = (1..=width).flat_map(|length| {
        [low_ones(p), 1i128 << (p - 1)].into_iter().flat_map(move |x| {
            [0, -1, 1i128 << length.saturating_sub(p + 1)].map(|rest| at_length(x, length, rest))
        })
    });
    vec![
        directed(
            "all-bits",
            "a bit that is not connected, a word of the last record that stays",
            within([[most], [1]].concat().into_iter().chain(stripes).chain(turned).collect()),
        ),
        directed("range-ends", "the smallest and the largest integer", within(ends.to_vec())),
        directed(
            "powers-of-two",
            "a normalisation that is off by one, a leading one that is not found",
            within(powers.collect()),
        ),
        directed(
            "every-entry",
            "an entry of the table that is wrong, an index that is off by one or cut",
            within(entries.collect()),
        ),
        directed(
            "operand-cut",
            "an operand that is rounded instead of cut, or has a bit more or less",
            within(cuts.collect()),
        ),
    ]
}

/// Any integer, every number of bits as likely.
pub(super) fn random_operand(port: &ReciprocalPort, mut words: Words) -> [i128; 2] {
    let bits = 1 + words.below(port.width.into());
    let any = wide(&mut words) & low_ones(u32::try_from(bits).unwrap_or(port.width));
    [any.max(1), 0]
}

fn wide(words: &mut Words) -> i128 {
    (u128::from(words.draw()) << 64 | u128::from(words.draw())).cast_signed()
}

/// What is to be met at a divider.
pub(super) fn goals(corrector: &Corrector) -> Vec<Goal> {
    let signed = corrector.config().signed;
    let unsigned = || "0 <= P: codes have no sign".to_owned();
    let mut goals: Vec<Goal> =
        ["q.zero", "clamp.above", "value.largest", "value.smallest"].map(Goal::new).to_vec();
    for cell in ["p.negative", "clamp.below"] {
        goals.push(if signed { Goal::new(cell) } else { Goal::never(cell, "CH-2", unsigned()) });
    }
    goals
}

/// The numbers of a division.
struct Division<'a> {
    corrector: &'a Corrector,
    read: ReadOut,
    w: ReadOut,
    low: i128,
    high: i128,
    /// Places that P is moved up by.
    below: u32,
}

impl<'a> Division<'a> {
    fn new(corrector: &'a Corrector) -> Self {
        let (read, w) = (corrector.read_out(), super::inverse(corrector));
        let (low, high) = corrector.config().range();
        Self { corrector, read, w, low, high, below: w.integer() + w.fraction() }
    }

    /// P as near below the code `twice / 2` as it comes, for this Q.
    fn numerator(&self, twice: i128, q: i128) -> i128 {
        // Of the widest words only the small products are tried.
        let product = twice.checked_mul(q).unwrap_or(0);
        let shift = self.below + 1;
        let f = self.read.fraction();
        if shift >= f { product >> (shift - f) } else { product << (f - shift) }
    }

    fn q_top(&self) -> i128 {
        self.w.top() - 1
    }

    /// Some Q, near and far.
    fn some_q(&self) -> Vec<i128> {
        let bits = self.below;
        let list =
            [1, 2, 3, low_ones(bits), 1 << (bits - 1), low_ones(bits) / 3, low_ones(bits) / 5];
        let far = (0..bits).step_by(3).map(|bit| (1i128 << bit) + (1i128 << bit) / 3);
        list.into_iter().chain(far).filter(|q| (1..=self.q_top()).contains(q)).collect()
    }

    /// Accumulators that are exactly between two results.
    fn ties(&self) -> Vec<[i128; 2]> {
        let mut list = Vec::new();
        let codes = [0, 1, 2, self.high - 1, self.high, self.low, self.low + 1, -1, -2];
        let codes: Vec<i128> =
            codes.into_iter().filter(|code| (self.low..=self.high).contains(code)).collect();
        let f = self.read.fraction();
        if let Some(unit) = self.corrector.unit() {
            for q in self.some_q() {
                let found = unit.of(q);
                let places = f + found.exponent;
                if places <= self.below {
                    continue;
                }
                // P m is an odd multiple of half of what is dropped.
                let zeros = found.mantissa.trailing_zeros();
                let Some(up) = (places - self.below - 1).checked_sub(zeros) else { continue };
                if up < self.read.integer() + f {
                    list.extend([1, 3, 5, 7, -1, -3].map(|odd| [odd << up, q]));
                    let top = (self.read.top() >> up) | 1;
                    list.extend([top - 2, top - 4].map(|odd| [odd << up, q]));
                }
            }
        } else {
            let zeros = (self.below + 1).saturating_sub(f).min(self.below - 1);
            for odd in [1, 3, 5, 7, 11, (self.q_top() >> zeros) | 1] {
                let q = (odd << zeros).min(self.q_top());
                for code in &codes {
                    let p = self.numerator(2 * code + 1, q);
                    list.extend([-1, 0, 1].map(|miss| [p + miss, q]));
                }
            }
        }
        list
    }
}

/// Directed tests of a divider.
pub(super) fn divider(corrector: &Corrector) -> Vec<Directed<[i128; 2]>> {
    let own = Division::new(corrector);
    let (read, w) = (own.read, own.w);
    let f = read.fraction();
    let (floor, top) = (own.low << f, (own.high + 1) << f);
    let ends = [0, 1, -1, floor, floor - 1, top - 1, top, top + 1, 1 << f, floor + 1];
    let q_ends = [own.q_top(), 0, 1, 2, -1, w.top(), w.top() + 1, own.q_top() - 1];
    let cross = |list: &[i128], others: &[i128]| -> Vec<[i128; 2]> {
        list.iter().flat_map(|p| others.iter().map(|q| [*p, *q])).collect()
    };
    let stripes = [0, 1, 2].map(|n| {
        let [a, b] = [STRIPES[n], STRIPES[(n + 1) % 3]].map(u128::cast_signed);
        [a & low_ones(read.width()), b & low_ones(w.width())]
    });
    let turned = stripes.map(|[a, b]| [a ^ low_ones(read.width()), b ^ low_ones(w.width())]);
    let powers: Vec<i128> =
        (0..own.below).flat_map(|bit| [-1, 0, 1].map(|miss| (1i128 << bit) + miss)).collect();
    let middle = own.numerator(own.high, own.q_top());
    let mut clamps = Vec::new();
    for q in own.some_q() {
        for twice in [
            2 * own.high - 1,
            2 * own.high,
            2 * own.high + 1,
            2 * own.high + 2,
            2 * own.low - 1,
            2 * own.low,
            2 * own.low - 2,
            2 * own.low + 1,
            4 * own.high,
            own.high,
        ] {
            let p = own.numerator(twice, q);
            clamps.extend([-1, 0, 1].map(|miss| [p + miss, q]));
        }
    }
    let mut guards = Vec::new();
    for pattern in 0..1i128 << read.guard().min(4) {
        for inside in [0, 1, top / 2, top - 1] {
            guards.push([
                (pattern << (read.width() - read.guard())) + floor + inside,
                own.q_top() / 3,
            ]);
        }
    }
    for pattern in 0..1i128 << w.guard().min(4) {
        for inside in [0, 1, w.top() / 2, w.top() - 1] {
            guards.push([middle, (pattern << (w.width() - w.guard())) + inside]);
        }
    }
    let edge = |read: ReadOut, offset: i128| {
        let lowest = (read.top() >> 1) - (1i128 << (read.width() - 1)) - offset;
        [-1, 0, 1].map(|miss| lowest + miss)
    };
    guards.extend(edge(read, -floor).map(|p| [p, own.q_top()]));
    guards.extend(edge(w, 0).map(|q| [middle, q]));
    vec![
        directed(
            "all-bits",
            "a bit that is not connected, a word of the last record that stays",
            [turned, stripes].concat(),
        ),
        directed(
            "range-ends",
            "ends of both ranges against each other, 1/w = 0",
            cross(&ends, &q_ends),
        ),
        directed(
            "powers-of-two",
            "a normalisation that is off by one, a shift by another distance",
            cross(&[middle, top - 1, floor + 1], &powers),
        ),
        directed("ties", "a product or a quotient that is rounded in another way", own.ties()),
        directed(
            "clamps",
            "a result that is not clamped, or clamped one too early or too late",
            clamps,
        ),
        directed("guard-patterns", "a wrong guard decode of u/w or of 1/w", guards),
    ]
}

/// Half of the pairs are those of a code in its range, a quarter any words, a quarter of any size.
pub(super) fn random_pair(corrector: &Corrector, mut words: Words) -> [i128; 2] {
    let own = Division::new(corrector);
    let kind = words.below(4);
    let size = u32::try_from(words.below(own.below.into())).unwrap_or(0);
    let q = (wide(&mut words) & low_ones(own.below)) >> size;
    let any = wide(&mut words);
    match kind {
        0 => [any, wide(&mut words)],
        1 => {
            let bits = 1 + words.below((own.read.integer() + own.read.fraction()).into());
            let p = any & low_ones(u32::try_from(bits).unwrap_or(1));
            [if own.low < 0 && words.below(2) == 1 { -p } else { p }, q]
        }
        _ => {
            // Twice a code, and some more below it.
            let span = u64::try_from(2 * (own.high - own.low)).unwrap_or(u64::MAX);
            let twice = 2 * own.low + i128::from(words.below(span.saturating_add(2)));
            let p = own.numerator(twice, q.max(1));
            let blur = low_ones(own.read.fraction().min(6));
            [p + (any & blur) - blur / 2, q]
        }
    }
}
