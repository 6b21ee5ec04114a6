//! Suspects of reciprocal units and of dividers: other units and channels, and every single fault.

use super::channel::{changed, other_units, other_w};
use super::fault::{Operator, Path, Relation, low_ones, sign_extend};
use super::reciprocal::{self, distance, up};
use super::{Suspect, Suspects};
use crate::format::{Clamp, ReadOut};
use crate::value::{AttributeConfig, Correction, Corrector, InverseWConfig, ReciprocalConfig};
use crate::vector::bench::{Coverage, Single, UnitBench, UnitKind, UnitTest};
use crate::vector::device::{Computes, Device, NamedWord, in_order};
use crate::vector::table::Table;
use crate::vector::units::{ReciprocalPort, divides};

const MODULE: &str = "perspective_divider";

impl Suspects for UnitBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let (names, kind) = (self.answered(), self.kind());
        let mut list = Vec::new();
        for (change, other, module) in neighbours(self) {
            let device = Computes { kind: other, names: names.clone() };
            // Of two that say the same of one module, this is the simpler one.
            let place = Some((module, "its words"));
            list.push(Suspect { place, ..Suspect::new(self, change, device) });
        }
        let faults = Path::faults(|path| {
            words(path, kind, [1, 1]);
        });
        list.extend(faults.into_iter().map(|fault| {
            let path = Path::with(&fault);
            Suspect::at(self, &fault, Faulty { path, kind, names: names.clone() })
        }));
        list
    }
}

/// Units that differ in one thing, what it is, and the module that it is in.
fn neighbours(bench: &UnitBench) -> Vec<(String, UnitKind, &'static str)> {
    let mut list = Vec::new();
    match bench.kind() {
        UnitKind::Reciprocal(port) => {
            let ready = |config: &ReciprocalConfig| {
                let unit = config.unit().ok()?;
                Some(UnitKind::Reciprocal(ReciprocalPort { unit, width: port.width }))
            };
            for (what, config) in other_units(port.unit.config()) {
                list.extend(ready(&config).map(|kind| (what, kind, reciprocal::MODULE)));
            }
        }
        UnitKind::Divider(corrector) => {
            let (profile, own) = (bench.profile(), corrector.config());
            let ready = |config: &AttributeConfig, w: Option<&InverseWConfig>| {
                let made = Corrector::new(config, w, &profile.vertex).ok()?;
                Some(UnitKind::Divider(Box::new(made)))
            };
            let divider = |config: &AttributeConfig| {
                config.correction.walks_w() && divides(config) != divides(own)
            };
            let others = changed(own).into_iter().filter(|(_, config)| divider(config));
            for (what, config) in others {
                let unit = |config: &AttributeConfig| match &config.correction {
                    Correction::Reciprocal { unit, .. } => Some(unit.clone()),
                    _ => None,
                };
                let module = if unit(&config) == unit(own) { MODULE } else { reciprocal::MODULE };
                list.extend(ready(&config, profile.w.as_ref()).map(|kind| (what, kind, module)));
            }
            for (what, other) in other_w(profile) {
                list.extend(ready(own, other.w.as_ref()).map(|kind| (what, kind, MODULE)));
            }
            let clamps = [Clamp::Wrap, Clamp::Guard, Clamp::Sign];
            for (clamp, w) in clamps.into_iter().zip([profile.w; 3]) {
                let Some(w) = w.filter(|w| w.clamp != clamp) else { continue };
                let what = format!("w.clamp is {}", clamp.name());
                let other = InverseWConfig { clamp, ..w };
                list.extend(ready(own, Some(&other)).map(|kind| (what, kind, MODULE)));
                // Both read-outs can be one module.
                let both = AttributeConfig { clamp, ..own.clone() };
                let what = format!("clamp and w.clamp are {}", clamp.name());
                list.extend(ready(&both, Some(&other)).map(|kind| (what, kind, MODULE)));
            }
        }
    }
    list
}

/// A unit with a fault.
struct Faulty<'a> {
    path: Path,
    kind: &'a UnitKind,
    names: Vec<String>,
}

impl Device<UnitTest> for Faulty<'_> {
    fn answer(&mut self, test: &UnitTest, rows: &mut Single<Table>, _: &mut Coverage) {
        self.path.next_record();
        let named = words(&self.path, self.kind, test.words);
        rows.exp.push(&in_order(&named, &self.names));
    }
}

fn words(path: &Path, kind: &UnitKind, [first, second]: [i128; 2]) -> Vec<NamedWord> {
    match kind {
        UnitKind::Reciprocal(port) => reciprocal::words(path, port, first),
        UnitKind::Divider(corrector) => {
            path.within(MODULE, || divide(path, corrector, [first, second]))
        }
    }
}

/// What the parts of a read-out are called.
struct Names {
    input: &'static str,
    lift: &'static str,
    outside: &'static str,
    upper: &'static str,
    low: &'static str,
    high: &'static str,
    out: &'static str,
    word: &'static str,
}

const P: Names = Names {
    input: "the accumulator of u/w",
    lift: "what lifts a signed P to its read-out",
    outside: "above the range of P",
    upper: "in the upper half of the guard range of P",
    low: "clamp of P from below",
    high: "clamp of P from above",
    out: "what is read out as P",
    word: "P",
};

const Q: Names = Names {
    input: "the accumulator of 1/w",
    lift: "what lifts Q to its read-out",
    outside: "above the range of Q",
    upper: "in the upper half of the guard range of Q",
    low: "clamp of Q from below",
    high: "clamp of Q from above",
    out: "what is read out as Q",
    word: "Q",
};

/// What a read-out sees of an accumulator, as the bits of a pattern.
fn held(path: &Path, names: &Names, read: ReadOut, offset: i128, acc: i128) -> i128 {
    let bits = read.integer() + read.fraction();
    let mut word = path.word(names.input, acc, read.width());
    if offset != 0 {
        word = path.sum(names.lift, Operator::Add, [word, offset], read.width());
    }
    let u = word & low_ones(read.width());
    let whole = 1i128 << bits;
    let outside = path.compare(names.outside, u, Relation::GreaterOrEqual, whole);
    let upper = if read.clamp() == Clamp::Sign {
        path.when(names.upper, u >> (read.width() - 1) & 1 == 1)
    } else {
        let middle = (1i128 << read.width() >> 1) + (whole >> 1);
        let upper = path.compare(names.upper, u, Relation::GreaterOrEqual, middle);
        outside && upper
    };
    let clamps = read.clamp() != Clamp::Wrap;
    let low = path.when(names.low, clamps && upper);
    let high = path.when(names.high, clamps && outside && !low);
    let pick = if low {
        0
    } else if high {
        1
    } else {
        2
    };
    let operands = [("zero", 0), ("the largest", low_ones(bits)), ("the bits below", u)];
    let near = [("the largest less one", low_ones(bits) - 1), ("one", 1)];
    let out = path.choose_near(names.out, pick, operands, near) - offset;
    path.word(names.word, out, bits)
}

fn divide(path: &Path, corrector: &Corrector, [acc, acc_w]: [i128; 2]) -> Vec<NamedWord> {
    let (config, read) = (corrector.config(), corrector.read_out());
    let w = corrector.w_read_out().unwrap_or_else(|| unreachable!("a divider takes 1/w"));
    let (f, below) = (read.fraction(), w.integer() + w.fraction());
    let p = held(path, &P, read, config.offset() << f, acc);
    let p = if config.signed { sign_extend(p, config.integer + f) } else { p };
    let q = held(path, &Q, w, 0, acc_w);
    let none = path.compare("Q is zero", q, Relation::Equal, 0);
    let negative = path.compare("P is negative", p, Relation::Less, 0);
    let places = path.number("the places that P is moved up by", below.into());
    let numerator = up(path, "P of the division", p, distance(places));
    let own = i128::from(f);
    let mut named = vec![("p", p), ("q", q)];
    let exact = if let (Correction::Reciprocal { rounding, .. }, Some(unit)) =
        (&config.correction, corrector.unit())
    {
        let port = ReciprocalPort { unit: unit.clone(), width: below };
        let words = reciprocal::words(path, &port, q);
        let word = |name: &str| {
            words.iter().find(|(known, _)| *known == name).map_or(0, |(_, word)| *word)
        };
        let (mantissa, exponent) = (word("mantissa"), word("exponent"));
        let shown = |name: &'static str, word: i128, bits: u32| {
            let near =
                [("what the unit gives where Q is zero", word), ("all ones", low_ones(bits))];
            let operands = [("its word", word), ("zero where Q is zero", 0)];
            path.choose_near(name, usize::from(none), operands, near)
        };
        let widest = u32::BITS - (unit.bits() + below - 1).leading_zeros();
        named.push(("mantissa", shown("the mantissa that is shown", mantissa, unit.bits())));
        named.push(("exponent", shown("the exponent that is shown", exponent, widest)));
        let product = path.product("the product of P and the mantissa", numerator, mantissa);
        let bits = config.integer + f + 1 + below + unit.bits();
        let product = path.signed("the product", product, bits.min(127));
        let down = [own, exponent];
        let down = path.sum("the places that the product is moved down by", Operator::Add, down, 8);
        let down = path.word("the distance that the product is moved", down, 8);
        let value = rounding.shift_right(product, distance(down)).0;
        // Without the rounding, and moved the other way.
        let near = [
            ("moved up and rounded", product << distance(down)),
            ("the product where it was", product),
        ];
        path.only("the product on its way to the value", ("moved down and rounded", value), near)
    } else {
        let rounding = match &config.correction {
            Correction::Quotient { rounding } | Correction::ConstantW { rounding } => *rounding,
            _ => crate::bits::Rounding::Floor,
        };
        let fraction = path.number("the places that Q is moved up by", own);
        let divisor = up(path, "Q of the division", q, distance(fraction));
        rounding.divide(numerator, divisor).map_or(0, |(value, _)| value)
    };
    let near = [
        ("P alone, not corrected for perspective,", p >> f),
        ("P with its fraction", p),
        ("minus P over Q", exact.wrapping_neg()),
    ];
    let value = path.only("what is divided", ("P over Q", exact), near);
    let value = path.choose(
        "the value",
        usize::from(none),
        [("the rounded one", value), ("zero where Q is zero", 0)],
    );
    let value = path.signed("the value before the clamp", value, config.integer + below + 2);
    let all = 1i128 << config.integer;
    let ranges = [
        ("of codes without a sign", (0, all - 1)),
        ("of codes with a sign", (-(all >> 1), (all >> 1) - 1)),
    ];
    let [low, high] = ["the smallest code", "the largest code"]
        .map(|name| path.choose(name, usize::from(config.signed), ranges));
    let (low, high) = (low.0, high.1);
    let wide = config.integer + below + 2;
    let low = path.signed("the limit of the code below", low, wide);
    let high = path.signed("the limit of the code above", high, wide);
    let above = path.compare("above the largest code", value, Relation::Greater, high);
    let under = path.compare("below the smallest code", value, Relation::Less, low);
    let above = path.when("the code is held from above", if none { !negative } else { above });
    let under = path.when("the code is held from below", if none { negative } else { under });
    let pick = match (none, above, under) {
        (true, true, _) => 2,
        (true, false, true) => 3,
        (false, true, _) => 0,
        (false, false, true) => 1,
        (_, false, false) => 4,
    };
    let code = path.choose_near(
        "what the code is",
        pick,
        [
            ("the largest code above the range", high),
            ("the smallest code below it", low),
            ("the largest code where Q is zero", high),
            ("the smallest code where Q is zero", low),
            ("the value", value),
        ],
        [("zero", 0), ("one", 1), ("the largest code less one", high - 1), ("the bits of P", p)],
    );
    let code = path.word("the code", code, config.integer);
    named.extend([("value", value), ("code", code)]);
    named
}
