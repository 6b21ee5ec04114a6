//! The places of a unit where a fault can be, and what can be wrong at each.

use super::{Fault, Operator, Relation, Wrong};

/// What stands at a site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A sum or difference of so many bits.
    Sum(Operator, u32),
    Product,
    /// A word of so many bits.
    Word(u32),
    /// A number, such as a distance in a shift or an end of a range.
    Number,
    /// What a register takes at each clock.
    Clocked,
    Comparison(Relation),
    Condition,
    /// A choice between operands of these names, and how many of them ever belong somewhere: the others are
    /// near, and wrong everywhere.
    Choice(Vec<&'static str>, usize),
    /// A code of four.
    Code([&'static str; 4]),
    /// What three codes, by name, are decoded to: which of four.
    Decoded([&'static str; 3], [usize; 3], [&'static str; 4]),
    /// So many conditions that must all hold.
    All(usize),
}

/// A place in a unit where a fault can be.
#[derive(Clone, Debug)]
pub(super) struct Site {
    pub(super) name: &'static str,
    pub(super) module: &'static str,
    pub(super) kind: Kind,
}

impl Site {
    /// What can be wrong here.
    pub(super) fn faults(&self) -> Vec<Fault> {
        let (name, module) = (self.name, self.module);
        let fault = |wrong: Wrong, text: String| Fault { site: name, module, wrong, text };
        let said = |wrong: Wrong, text: &str| fault(wrong, format!("{name} {text}"));
        let mut list = Vec::new();
        match &self.kind {
            Kind::Sum(right, width) => {
                for other in Operator::SUMS.into_iter().filter(|other| other != right) {
                    let text = format!("{name} {}; it {} if right", other.text(), right.text());
                    list.push(fault(Wrong::Operator(other), text));
                }
                list.push(said(Wrong::Off(1), "gives one too much"));
                list.push(said(Wrong::Off(-1), "gives one too little"));
                list.extend((1..*width).map(|bit| {
                    fault(Wrong::CarryLost(bit), format!("{name} loses the carry into bit {bit}"))
                }));
            }
            Kind::Product => {
                for other in Operator::PRODUCTS {
                    let text = format!("{name} {}; it multiplies if right", other.text());
                    list.push(fault(Wrong::Operator(other), text));
                }
                list.push(said(Wrong::Constant(0), "is zero"));
            }
            Kind::Word(width) => {
                list.push(said(Wrong::Constant(0), "is always zero"));
                list.push(said(Wrong::Constant(-1), "is always all ones"));
                list.push(said(Wrong::Negated, "has the wrong sign"));
                list.push(said(Wrong::Complement, "has all bits inverted"));
                list.push(said(Wrong::Off(1), "is one too large"));
                list.push(said(Wrong::Off(-1), "is one too small"));
                list.push(said(Wrong::Shifted(1), "is shifted left by one bit"));
                list.push(said(Wrong::Shifted(-1), "is shifted right by one bit"));
                list.push(said(Wrong::Stale, "is that of the record before"));
                for bit in 0..*width {
                    for value in [false, true] {
                        let text = format!("bit {bit} of {name} is stuck at {}", u8::from(value));
                        list.push(fault(Wrong::Stuck(bit, value), text));
                    }
                }
                list.extend((2..*width).map(|bits| {
                    fault(Wrong::Short(bits), format!("{name} has lost its top {bits} bits"))
                }));
            }
            Kind::Number => {
                list.push(said(Wrong::Off(1), "is one too large"));
                list.push(said(Wrong::Off(-1), "is one too small"));
                list.push(said(Wrong::Constant(0), "is zero"));
            }
            Kind::Clocked => list.push(said(Wrong::Late, "takes effect one clock late")),
            Kind::Comparison(right) => {
                for other in Relation::ALL.into_iter().filter(|other| other != right) {
                    let text = format!("{name}: {} instead of {}", other.text(), right.text());
                    list.push(fault(Wrong::Relation(other), text));
                }
                list.push(fault(Wrong::Off(-1), format!("{name}: compared with one less")));
                list.push(fault(Wrong::Off(1), format!("{name}: compared with one more")));
                list.push(fault(Wrong::Always(true), format!("{name}: always true")));
                list.push(fault(Wrong::Always(false), format!("{name}: never true")));
            }
            Kind::Condition => {
                list.push(fault(Wrong::Always(true), format!("{name}: always true")));
                list.push(fault(Wrong::Always(false), format!("{name}: never true")));
                list.push(fault(Wrong::Turned, format!("{name}: inverted")));
            }
            Kind::All(count) => {
                list.push(fault(Wrong::Any, format!("{name}: any one is enough")));
                let unseen =
                    |n| fault(Wrong::Unseen(n), format!("{name}: number {n} is not looked at"));
                list.extend((0..*count).map(unseen));
            }
            Kind::Code(names) => {
                list.extend(
                    maps(*names)
                        .map(|(map, text)| fault(Wrong::Map(map), format!("{name}: {text}"))),
                );
            }
            Kind::Decoded(codes, right, names) => {
                let maps = (0..64).map(|map| [map & 3, map >> 2 & 3, map >> 4]);
                let maps = maps.filter(|map| map != right);
                list.extend(maps.map(|map| {
                    let text = decoded(*codes, [map, *right], *names);
                    fault(Wrong::Decoded(map), format!("{name}: {text}"))
                }));
            }
            Kind::Choice(names, right) => {
                for (belongs, own) in names.iter().enumerate().take(*right) {
                    for (taken, wrong) in names.iter().enumerate().filter(|(n, _)| *n != belongs) {
                        let text = format!("{name}: {wrong} where {own} belongs");
                        list.push(fault(Wrong::Instead(belongs, taken), text));
                        if belongs < taken && taken < *right {
                            let text = format!("{name}: {own} and {wrong} are exchanged");
                            list.push(fault(Wrong::Exchanged(belongs, taken), text));
                        }
                    }
                }
            }
        }
        list
    }
}

/// What codes are decoded to, and what belongs there.
fn decoded(codes: [&str; 3], [map, right]: [[usize; 3]; 2], names: [&str; 4]) -> String {
    let changed = (0..3).filter(|code| map[*code] != right[*code]);
    let changes = changed.map(|code| {
        let [is, belongs] = [map[code], right[code]].map(|n| names[n]);
        format!("{is} where {belongs} {} belongs", codes[code])
    });
    changes.collect::<Vec<_>>().join("; ")
}

/// Codes that act as others: each map but the right one, in words.
fn maps(names: [&'static str; 4]) -> impl Iterator<Item = ([usize; 4], String)> {
    let all = (0..256usize).map(|map| [map & 3, map >> 2 & 3, map >> 4 & 3, map >> 6]);
    all.filter(|map| *map != [0, 1, 2, 3]).map(move |map| {
        let changed = (0..4).filter(|code| map[*code] != *code);
        let changes = changed.map(|code| format!("{} acts as {}", names[code], names[map[code]]));
        (map, changes.collect::<Vec<_>>().join(", "))
    })
}
