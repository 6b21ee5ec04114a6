//! `verify --dut` of a register device: its records lined up, and its defects named.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use crate::set::profile;
use crate::verify::Golden;
use guardbit::machine::Sink;
use guardbit::model::Model;
use std::fmt::Write as _;

/// Clause N-13: the records of a register machine are lined up by test and by order in it: a row too much, or one
/// missing, is one mismatch, in the first test and in a later one.
#[test]
fn a_record_too_much_or_too_little_is_one_mismatch() {
    let golden = Golden::named("ps1", 400);
    let name = "words-p.exp.tv";
    let text = golden.set.text(name);
    let lines: Vec<&str> = text.lines().collect();
    // A row whose neighbours are of the same test.
    let test = |n: usize| lines[n].split('_').next();
    let inner = (1..lines.len() - 1).filter(|n| test(n - 1) == test(*n) && test(*n) == test(n + 1));
    let inner: Vec<usize> = inner.collect();
    for at in [inner[0], inner[inner.len() / 2]] {
        let mut more = lines.clone();
        more.insert(at, lines[at]);
        let report = golden.compare(name, &(more.join("\n") + "\n")).unwrap();
        assert_eq!((report.total, report.disagrees), (1, true), "{:?}", report.mismatches);
        assert!(report.mismatches[0].text.starts_with("extra row: "), "{:?}", report.mismatches);
        let mut less = lines.clone();
        less.remove(at);
        let report = golden.compare(name, &(less.join("\n") + "\n")).unwrap();
        assert_eq!((report.total, report.short), (1, false), "{:?}", report.mismatches);
        assert!(report.mismatches[0].text.starts_with("missing: "), "{:?}", report.mismatches);
        assert!(report.lost, "every row that came agrees");
    }
    let swapped = inner.iter().find(|at| lines[**at] != lines[**at + 1]).unwrap();
    let mut turned = lines.clone();
    turned.swap(*swapped, swapped + 1);
    assert_eq!(golden.compare(name, &(turned.join("\n") + "\n")).unwrap().total, 2);
}

/// Clause N-14: a device that only draws too many pixels, or the same ones in another order, has a place and a cause.
#[test]
fn a_register_device_with_rows_too_many_is_diagnosed() {
    for (name, from, to, cause) in [
        ("psp", "rule = \"truncated-side\"", "rule = \"both\"", "rule is both"),
        ("rasterix", "order = \"zigzag\"", "order = \"serpentine\"", "order is serpentine"),
    ] {
        let golden = Golden::named(name, 700);
        let text = profile(name).to_toml();
        assert!(text.contains(from), "{text}");
        let changed = guardbit::profile::parse(&text.replace(from, to), "changed.toml").unwrap();
        let model = Model::new(&changed).unwrap();
        let registers = model.registers().unwrap();
        let mut dump = String::new();
        for row in golden.set.text("words.cfg.tv").lines() {
            let mut words = row.split('_').map(|word| u32::from_str_radix(word, 16).unwrap());
            let test = words.next().unwrap();
            let words: Vec<u32> = words.collect();
            let mut seen = Seen(Vec::new());
            model.draw(words.as_slice(), &mut seen).unwrap();
            for values in seen.0 {
                let mut record = String::new();
                registers.push_record(0, &values, " ", &mut record);
                let (_, words) = record.split_once(' ').unwrap();
                writeln!(dump, "{test:x} {words}").unwrap();
            }
        }
        let report = golden.compare("words-p.exp.dut.tv", &dump).unwrap();
        assert!(report.total > 0 && !report.placed.columns.is_empty(), "{name}");
        assert!(report.causes.iter().any(|found| found.contains(cause)), "{:?}", report.causes);
    }
}

/// Records of one kind, kept.
struct Seen(Vec<Vec<i64>>);

impl Sink for Seen {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn wants_records(&self) -> bool {
        true
    }

    fn record(&mut self, _: usize, values: &[i64]) {
        self.0.push(values.to_vec());
    }
}
