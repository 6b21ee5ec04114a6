//! Lists of covered runs: what two of them share, and what only one of them has.

use crate::model::Span;
use std::cmp::Ordering;

/// Where a stretch of samples belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// To both lists.
    Both,
    /// To the first list alone: missing from the second.
    Missing,
    /// To the second list alone: more than the first has.
    Extra,
}

/// Walks two lists of runs, each in y then x order and without overlap, and calls `each` for every
/// stretch, in the same order.
pub(super) fn compare(first: &[Span], second: &[Span], mut each: impl FnMut(Side, Span)) {
    let (mut first, mut second) = (first.iter().copied(), second.iter().copied());
    let (mut one, mut other) = (first.next(), second.next());
    loop {
        let (side, stretch) = match (one, other) {
            (None, None) => return,
            (Some(a), None) => (Side::Missing, a),
            (None, Some(b)) => (Side::Extra, b),
            (Some(a), Some(b)) => {
                let (start_a, start_b) = ((a.y, a.x0), (b.y, b.x0));
                // Up to where the other begins, if that is in this row.
                let until = |run: Span, other: Span| {
                    let end = if run.y == other.y { run.x1.min(other.x0) } else { run.x1 };
                    Span { x1: end, ..run }
                };
                match start_a.cmp(&start_b) {
                    Ordering::Less => (Side::Missing, until(a, b)),
                    Ordering::Greater => (Side::Extra, until(b, a)),
                    Ordering::Equal => (Side::Both, Span { x1: a.x1.min(b.x1), ..a }),
                }
            }
        };
        each(side, stretch);
        let rest = |run: Option<Span>| {
            run.map(|run| Span { x0: stretch.x1, ..run }).filter(|run| run.x0 < run.x1)
        };
        if side != Side::Extra {
            one = rest(one).or_else(|| first.next());
        }
        if side != Side::Missing {
            other = rest(other).or_else(|| second.next());
        }
    }
}

/// How many samples are hit less or more often than they should be. Spec clause `M-4`.
#[derive(Clone, Debug, Default)]
pub(super) struct Hits {
    /// Row, column, and by how much the surplus changes from there on.
    changes: Vec<(u32, u32, i32)>,
}

impl Hits {
    /// Notes a stretch.
    pub(super) fn note(&mut self, side: Side, run: Span) {
        let surplus = match side {
            Side::Both => return,
            Side::Missing => -1,
            Side::Extra => 1,
        };
        self.changes.extend([(run.y, run.x0, surplus), (run.y, run.x1, -surplus)]);
    }

    /// Samples with fewer hits than they should have, and samples with more.
    pub(super) fn holes_and_doubles(mut self) -> (u64, u64) {
        self.changes.sort_unstable();
        let (mut holes, mut doubles, mut surplus) = (0, 0, 0);
        for pair in self.changes.windows(2) {
            surplus += pair[0].2;
            // Every row ends with a surplus of nothing, so a stretch never leaves its row.
            let length = u64::from(if surplus == 0 { 0 } else { pair[1].1 - pair[0].1 });
            match surplus {
                0 => {}
                ..0 => holes += length,
                _ => doubles += length,
            }
        }
        (holes, doubles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Words;
    use std::collections::BTreeMap;

    /// Random runs in three rows of twelve samples.
    fn runs(words: &mut Words) -> Vec<Span> {
        let mut found: Vec<Span> = Vec::new();
        for y in 0..3 {
            let mut x = 0;
            while x < 12 {
                let x0 = x + u32::try_from(words.below(4)).unwrap();
                let x1 = x0 + 1 + u32::try_from(words.below(4)).unwrap();
                if words.below(3) > 0 {
                    found.push(Span { y, x0, x1 });
                }
                x = x1 + 1;
            }
        }
        found
    }

    fn samples(runs: &[Span]) -> Vec<(u32, u32)> {
        runs.iter().flat_map(|run| (run.x0..run.x1).map(|x| (run.y, x))).collect()
    }

    #[test]
    fn stretches_are_the_samples_of_either_list() {
        for index in 0..500 {
            let mut words = Words::new(5, 0, index);
            let (a, b) = (runs(&mut words), runs(&mut words));
            let (in_a, in_b) = (samples(&a), samples(&b));
            let mut last = None;
            let mut seen = Vec::new();
            compare(&a, &b, |side, run| {
                assert!(run.x0 < run.x1 && last <= Some((run.y, run.x0)), "in order");
                last = Some((run.y, run.x1));
                for sample in samples(&[run]) {
                    let wanted = match (in_a.contains(&sample), in_b.contains(&sample)) {
                        (true, true) => Side::Both,
                        (true, false) => Side::Missing,
                        (false, _) => Side::Extra,
                    };
                    assert_eq!(side, wanted, "{sample:?}");
                    seen.push(sample);
                }
            });
            let mut all: Vec<_> = in_a.into_iter().chain(in_b).collect();
            all.sort_unstable();
            all.dedup();
            assert_eq!(seen, all);
        }
    }

    #[test]
    fn holes_and_doubles_are_counted_sample_by_sample() {
        for index in 0..300 {
            let mut words = Words::new(6, 0, index);
            let mut hits = Hits::default();
            let mut surplus: BTreeMap<(u32, u32), i32> = BTreeMap::new();
            for _ in 0..3 {
                let (a, b) = (runs(&mut words), runs(&mut words));
                compare(&a, &b, |side, run| hits.note(side, run));
                for (runs, change) in [(&a, -1), (&b, 1)] {
                    for sample in samples(runs) {
                        *surplus.entry(sample).or_default() += change;
                    }
                }
            }
            let count =
                |wanted: i32| surplus.values().filter(|n| n.signum() == wanted).count() as u64;
            assert_eq!(hits.holes_and_doubles(), (count(-1), count(1)));
        }
    }
}
