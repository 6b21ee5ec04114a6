//! The grammar of single faults: every operator, operand, word, condition and register of a unit can
//! be wrong in the ways that its kind can be. A unit is written once, as hardware computes it, over a
//! [`Path`]; the list of its suspects is what the path meets. Nothing here knows a remembered bug.

mod operator;
mod site;

pub(super) use operator::{Operator, Relation};
use site::{Kind, Site};
use std::cell::{Cell, RefCell};

/// What is wrong at a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    /// The operator is another.
    Operator(Operator),
    /// The carry into this bit is lost.
    CarryLost(u32),
    /// A bit is stuck.
    Stuck(u32, bool),
    /// This many of the highest bits are lost.
    Short(u32),
    /// Shifted to the left by so many bits; to the right if negative.
    Shifted(i32),
    /// Off by a constant.
    Off(i128),
    /// Its sign is turned.
    Negated,
    /// Every bit is turned.
    Complement,
    /// It is this constant.
    Constant(i128),
    /// What the record before had.
    Stale,
    /// What it was a clock ago.
    Late,
    /// The relation of a comparison is another.
    Relation(Relation),
    /// A condition that is always the same.
    Always(bool),
    /// A condition that is turned.
    Turned,
    /// Where the first of these belongs, the second is taken.
    Instead(usize, usize),
    /// Each of four codes is taken for another.
    Map([usize; 4]),
    /// What three codes are decoded to.
    Decoded([usize; 3]),
    /// Two operands have changed places.
    Exchanged(usize, usize),
    /// Any one of several conditions is enough.
    Any,
    /// One of several conditions is not looked at.
    Unseen(usize),
}

/// A single fault of a unit.
#[derive(Clone, Debug)]
pub(super) struct Fault {
    /// Where: what the datapath calls it.
    pub(super) site: &'static str,
    /// The module that it is in.
    pub(super) module: &'static str,
    pub(super) wrong: Wrong,
    /// In words.
    pub(super) text: String,
}

impl Fault {
    /// How simple it is to say, and so to make: a decision before a number before a bit.
    pub(super) fn rank(&self) -> u8 {
        match self.wrong {
            Wrong::Off(_) | Wrong::Constant(_) | Wrong::Stale | Wrong::Shifted(_) => 2,
            Wrong::CarryLost(_) => 3,
            // One code taken for another is as simple as a choice.
            Wrong::Map(map) if (0..4).filter(|code| map[*code] != *code).count() > 1 => 2,
            Wrong::Short(_) => 4,
            Wrong::Negated | Wrong::Complement | Wrong::Stuck(..) => 5,
            _ => 1,
        }
    }

    /// Whether it keeps something from one clock or record for the next.
    pub(super) fn remembers(&self) -> bool {
        matches!(self.wrong, Wrong::Stale | Wrong::Late)
    }

    /// Whether another operand, or another operation, is taken.
    pub(super) fn chooses(&self) -> bool {
        matches!(
            self.wrong,
            Wrong::Instead(..) | Wrong::Exchanged(..) | Wrong::Map(_) | Wrong::Decoded(_)
        )
    }

    /// Rows at the start of a file that it leaves open.
    pub(super) fn unsettled(&self) -> u64 {
        u64::from(self.wrong == Wrong::Late)
    }
}

/// The way of words through a unit, right or with one fault.
pub(super) struct Path {
    fault: Option<(&'static str, Wrong)>,
    /// The sites met, for a path that looks for them.
    met: Option<RefCell<Vec<Site>>>,
    /// The module that the words are in.
    module: Cell<&'static str>,
    /// What the faulty word was in this record and in the one before.
    kept: Cell<[i128; 2]>,
}

impl Path {
    /// A path with a fault.
    pub(super) fn with(fault: &Fault) -> Self {
        Self { fault: Some((fault.site, fault.wrong)), ..Self::right() }
    }

    /// A path without a fault.
    pub(super) fn right() -> Self {
        Self { fault: None, met: None, module: Cell::new(""), kept: Cell::default() }
    }

    /// The faults of a unit: `run` takes the unit through something that meets all of its sites.
    pub(super) fn faults(run: impl FnOnce(&Self)) -> Vec<Fault> {
        let path = Self { met: Some(RefCell::default()), ..Self::right() };
        run(&path);
        let sites = path.met.unwrap_or_default().into_inner();
        sites.iter().flat_map(Site::faults).collect()
    }

    fn at(&self, name: &'static str, kind: impl FnOnce() -> Kind) -> Option<Wrong> {
        if let Some(met) = &self.met {
            let mut met = met.borrow_mut();
            if met.iter().all(|site| site.name != name) {
                met.push(Site { name, module: self.module.get(), kind: kind() });
            }
        }
        // The lengths tell nearly all names apart, and a set is gone through for thousands of faults.
        self.fault
            .filter(|(site, _)| site.len() == name.len() && *site == name)
            .map(|(_, wrong)| wrong)
    }

    /// Takes words through a part that is a module of its own.
    pub(super) fn within<T>(&self, module: &'static str, part: impl FnOnce() -> T) -> T {
        let outer = self.module.replace(module);
        let made = part();
        self.module.set(outer);
        made
    }

    /// A sum or a difference, of which `width` bits count.
    pub(super) fn sum(
        &self,
        name: &'static str,
        operator: Operator,
        [a, b]: [i128; 2],
        width: u32,
    ) -> i128 {
        match self.at(name, || Kind::Sum(operator, width)) {
            Some(Wrong::Operator(other)) => other.apply(a, b),
            Some(Wrong::Off(by)) => operator.apply(a, b).wrapping_add(by),
            Some(Wrong::CarryLost(bit)) => {
                let below = (1i128 << bit) - 1;
                // A difference adds the complement and one.
                let (b, one) = if operator == Operator::Subtract { (!b, 1) } else { (b, 0) };
                let low = (a & below).wrapping_add(b & below).wrapping_add(one) & below;
                (a & !below).wrapping_add(b & !below) | low
            }
            _ => operator.apply(a, b),
        }
    }

    /// A product.
    pub(super) fn product(&self, name: &'static str, a: i128, b: i128) -> i128 {
        match self.at(name, || Kind::Product) {
            Some(Wrong::Operator(other)) => other.apply(a, b),
            Some(Wrong::Constant(value)) => value,
            _ => a.wrapping_mul(b),
        }
    }

    /// The low `width` bits of a word, as an unsigned pattern.
    pub(super) fn word(&self, name: &'static str, value: i128, width: u32) -> i128 {
        let ones = low_ones(width);
        let value = value & ones;
        let Some(wrong) = self.at(name, || Kind::Word(width)) else { return value };
        ones & match wrong {
            Wrong::Stuck(bit, true) => value | 1 << bit,
            Wrong::Stuck(bit, false) => value & !(1 << bit),
            Wrong::Short(bits) => value & low_ones(width - bits),
            Wrong::Shifted(by) if by > 0 => value << by,
            Wrong::Shifted(by) => value >> -by,
            Wrong::Off(by) => value.wrapping_add(by),
            Wrong::Negated => value.wrapping_neg(),
            Wrong::Complement => !value,
            Wrong::Constant(constant) => constant,
            Wrong::Stale => {
                let [_, before] = self.kept.get();
                self.kept.set([value, before]);
                before
            }
            _ => value,
        }
    }

    /// A signed word of `width` bits.
    pub(super) fn signed(&self, name: &'static str, value: i128, width: u32) -> i128 {
        sign_extend(self.word(name, value, width), width)
    }

    /// A number that can be off by one, such as a distance or an end.
    pub(super) fn number(&self, name: &'static str, value: i128) -> i128 {
        match self.at(name, || Kind::Number) {
            Some(Wrong::Off(by)) => value + by,
            Some(Wrong::Constant(constant)) => constant,
            _ => value,
        }
    }

    /// What comes in at a clock.
    pub(super) fn clocked(&self, name: &'static str, value: i128) -> i128 {
        if self.at(name, || Kind::Clocked) != Some(Wrong::Late) {
            return value;
        }
        let [before, _] = self.kept.replace([value, 0]);
        before
    }

    /// A comparison.
    pub(super) fn compare(&self, name: &'static str, a: i128, relation: Relation, b: i128) -> bool {
        match self.at(name, || Kind::Comparison(relation)) {
            Some(Wrong::Relation(other)) => other.holds(a, b),
            Some(Wrong::Off(by)) => relation.holds(a, b.wrapping_add(by)),
            Some(Wrong::Always(value)) => value,
            _ => relation.holds(a, b),
        }
    }

    /// A condition.
    pub(super) fn when(&self, name: &'static str, condition: bool) -> bool {
        match self.at(name, || Kind::Condition) {
            Some(Wrong::Always(value)) => value,
            Some(Wrong::Turned) => !condition,
            _ => condition,
        }
    }

    /// Whether all of several conditions hold.
    pub(super) fn all<const N: usize>(&self, name: &'static str, conditions: [bool; N]) -> bool {
        match self.at(name, || Kind::All(N)) {
            Some(Wrong::Any) => conditions.contains(&true),
            Some(Wrong::Unseen(n)) => (0..N).all(|k| k == n || conditions[k]),
            _ => !conditions.contains(&false),
        }
    }

    /// One of several operands, each of which belongs somewhere.
    pub(super) fn choose<T: Copy, const N: usize>(
        &self,
        name: &'static str,
        pick: usize,
        operands: [(&'static str, T); N],
    ) -> T {
        self.choose_near(name, pick, operands, [])
    }

    /// The one operand that belongs here, where others are near.
    pub(super) fn only<T: Copy, const M: usize>(
        &self,
        name: &'static str,
        own: (&'static str, T),
        near: [(&'static str, T); M],
    ) -> T {
        self.choose_near(name, 0, [own], near)
    }

    /// One of several operands, where others are near that belong nowhere.
    pub(super) fn choose_near<T: Copy, const N: usize, const M: usize>(
        &self,
        name: &'static str,
        pick: usize,
        operands: [(&'static str, T); N],
        near: [(&'static str, T); M],
    ) -> T {
        let names = || {
            let names = operands.iter().chain(&near).map(|(name, _)| *name);
            Kind::Choice(names.collect(), N)
        };
        let picked = match self.at(name, names) {
            Some(Wrong::Instead(belongs, taken)) if pick == belongs => taken,
            Some(Wrong::Exchanged(a, b)) if pick == a => b,
            Some(Wrong::Exchanged(a, b)) if pick == b => a,
            _ => pick,
        };
        if picked < N { operands[picked].1 } else { near[picked - N].1 }
    }

    /// A code of four.
    pub(super) fn code(&self, name: &'static str, code: usize, names: [&'static str; 4]) -> usize {
        match self.at(name, || Kind::Code(names)) {
            Some(Wrong::Map(map)) => map[code & 3],
            _ => code,
        }
    }

    /// What one of three codes is decoded to.
    pub(super) fn decoded(
        &self,
        name: &'static str,
        code: usize,
        right: [usize; 3],
        (codes, names): ([&'static str; 3], [&'static str; 4]),
    ) -> usize {
        match self.at(name, || Kind::Decoded(codes, right, names)) {
            Some(Wrong::Decoded(map)) => map[code],
            _ => right[code],
        }
    }

    /// The next record begins: what words were is now what they were before.
    pub(super) fn next_record(&self) {
        let [now, _] = self.kept.get();
        self.kept.set([now, now]);
    }
}

/// This many ones.
pub(super) fn low_ones(width: u32) -> i128 {
    if width == 0 { 0 } else { (u128::MAX >> (128 - width)).cast_signed() }
}

/// The signed value of the low `width` bits.
pub(super) fn sign_extend(value: i128, width: u32) -> i128 {
    value << (128 - width) >> (128 - width)
}
