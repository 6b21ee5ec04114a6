//! A sample of all mutants of a set's devices: uniform over modules first, then over operators, then
//! over places, so that no operator swamps it.

use super::operator::{Mutant, Places, mutants};
use super::source::Module;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// The devices of a set, `dut.sv`.
pub(super) struct Devices {
    shipped: String,
}

/// The divider of hardware, with its steps: as shipped the devices divide in one clock.
const AT_ONCE: &str = "parameter int SERIAL = 0";
const IN_STEPS: &str = "parameter int SERIAL = 1";

impl Devices {
    pub(super) fn read(set: &Path) -> Self {
        let devices = Self::of_units(set);
        assert_eq!(devices.shipped.matches(AT_ONCE).count(), 1, "the set-up says it");
        devices
    }

    /// Devices whose set-up is left alone.
    pub(super) fn of_units(set: &Path) -> Self {
        Self { shipped: std::fs::read_to_string(set.join("dut.sv")).unwrap() }
    }

    pub(super) fn names(&self) -> Vec<String> {
        names(&self.shipped)
    }

    /// The sound devices of the mutant. A defect of the set-up meets the divider of hardware.
    pub(super) fn sound(&self, mutant: &Mutant) -> String {
        if mutant.module == "setup_divider" || mutant.module == "triangle_setup" {
            self.shipped.replace(AT_ONCE, IN_STEPS)
        } else {
            self.shipped.clone()
        }
    }

    pub(super) fn with(&self, mutant: &Mutant) -> String {
        let devices = self.sound(mutant);
        let (begin, end) = span(&devices, &mutant.module);
        let mut module = devices[begin..end].to_owned();
        for (at, new) in mutant.edits.iter().rev() {
            module.replace_range(at.clone(), new);
        }
        format!("{}{module}{}", &devices[..begin], &devices[end..])
    }

    /// The lines that the mutant changes, before and after.
    pub(super) fn lines(&self, mutant: &Mutant) -> (String, String) {
        let (sound, mutated) = (self.sound(mutant), self.with(mutant));
        let (mut before, mut after): (Vec<&str>, Vec<&str>) =
            (sound.lines().collect(), mutated.lines().collect());
        while !before.is_empty() && before.first() == after.first() {
            before.remove(0);
            after.remove(0);
        }
        while before.last().is_some() && before.last() == after.last() {
            before.pop();
            after.pop();
        }
        let join =
            |lines: Vec<&str>| lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n");
        (join(before), join(after))
    }

    /// The tops that have this module in them.
    pub(super) fn tops<'a>(&self, module: &str, tops: &'a [String]) -> Vec<&'a str> {
        // Of several sets, not each has every top.
        let known = names(&self.shipped);
        let tops = tops.iter().filter(|top| known.contains(top)).map(String::as_str);
        tops.filter(|top| self.has(top, module)).collect()
    }

    fn has(&self, outer: &str, module: &str) -> bool {
        let (begin, end) = span(&self.shipped, outer);
        let text = &self.shipped[begin..end];
        let inner = names(&self.shipped)
            .into_iter()
            .filter(|name| name != outer && text.contains(&format!("\n    {name} #(")));
        outer == module || inner.into_iter().any(|name| self.has(&name, module))
    }
}

fn names(devices: &str) -> Vec<String> {
    let heads = devices.lines().filter_map(|line| line.strip_prefix("module "));
    heads.map(|rest| rest.split(' ').next().unwrap().to_owned()).collect()
}

/// Bytes of a module, from its head to its `endmodule`.
fn span(devices: &str, module: &str) -> (usize, usize) {
    let begin = 1 + devices.find(&format!("\nmodule {module} ")).expect("the module is there");
    let end = "\nendmodule";
    (begin, begin + devices[begin..].find(end).expect("it ends") + end.len())
}

pub(super) struct Sample {
    left: BTreeMap<String, Places>,
    pub(super) possible: usize,
    state: u64,
}

impl Sample {
    pub(super) fn new(devices: &Devices, seed: u64, of: impl Fn(&str) -> bool) -> Self {
        let modules = names(&devices.shipped).into_iter().filter(|name| of(name)).map(|name| {
            let (begin, end) = span(&devices.shipped, &name);
            (name, mutants(&Module::read(&devices.shipped[begin..end])))
        });
        let left: BTreeMap<String, Places> = modules.collect();
        let places = left.values().flat_map(BTreeMap::values).flat_map(BTreeMap::values);
        let possible = places.map(Vec::len).sum();
        Self { left, possible, state: seed }
    }

    /// The next mutant; none comes twice.
    pub(super) fn draw(&mut self) -> Option<Mutant> {
        let module = pick(&mut self.state, &self.left)?;
        let operators = self.left.get_mut(&module)?;
        let operator = pick(&mut self.state, operators)?;
        let places = operators.get_mut(operator)?;
        let place = pick(&mut self.state, places)?;
        let variants = places.get_mut(&place)?;
        let mutant = variants.swap_remove(below(&mut self.state, variants.len()));
        if variants.is_empty() {
            places.remove(&place);
        }
        if places.is_empty() {
            operators.remove(operator);
        }
        if operators.is_empty() {
            self.left.remove(&module);
        }
        Some(mutant)
    }
}

/// A key, each as likely.
fn pick<K: Clone, V>(state: &mut u64, map: &BTreeMap<K, V>) -> Option<K> {
    if map.is_empty() {
        return None;
    }
    map.keys().nth(below(state, map.len())).cloned()
}

/// SplitMix64, scaled to a range.
fn below(state: &mut u64, bound: usize) -> usize {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut word = *state;
    word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^= word >> 31;
    let scaled = (u128::from(word) * u128::try_from(bound).unwrap()) >> 64;
    usize::try_from(scaled).unwrap()
}

/// ISO year and week, as `date +%G%V` prints them: a sample a week.
pub(crate) fn week(now: SystemTime) -> u64 {
    let days = now.duration_since(UNIX_EPOCH).unwrap().as_secs() / 86_400;
    // A week belongs to the year of its Thursday, and day 0 was one.
    let mut thursday = days + 3 - (days + 3) % 7;
    let mut year = 1970;
    let length = |year: u64| {
        365 + u64::from(
            year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400)),
        )
    };
    while thursday >= length(year) {
        thursday -= length(year);
        year += 1;
    }
    year * 100 + thursday / 7 + 1
}
