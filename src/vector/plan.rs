//! Which tests of a bench are written, and which file rows that makes. Spec clause `N-6`.

use super::bench::{Bench, TestAt, locate, tests};

/// A part of a set: `index` of `parts`, counted from 0, cut between tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 0.
    pub index: u64,
    /// Of how many.
    pub parts: u64,
}

impl Shard {
    /// The whole set.
    pub const WHOLE: Self = Self { index: 0, parts: 1 };

    /// The half-open range of tests of this part.
    pub fn range(self, tests: u64) -> (u64, u64) {
        let cut = |part: u64| {
            let cut = u128::from(tests) * u128::from(part) / u128::from(self.parts);
            u64::try_from(cut).unwrap_or_else(|_| unreachable!("part {part} ends by test {tests}"))
        };
        (cut(self.index), cut(self.index + 1))
    }
}

/// The id of a test: bench, class and index in the class. It does not depend on the set's size.
pub fn test_id(bench: &dyn Bench, at: TestAt) -> String {
    let tag = bench.groups().get(at.group).map_or("?", |group| group.class.tag);
    format!("{}/{tag}/{}", bench.name(), at.index)
}

/// Finds a test by its id; any index of an open-ended class will do.
pub fn find_test(bench: &dyn Bench, id: &str) -> Option<TestAt> {
    let mut parts = id.split('/');
    let (name, tag, index) = (parts.next()?, parts.next()?, parts.next()?.parse::<u64>().ok()?);
    if name != bench.name() || parts.next().is_some() {
        return None;
    }
    let group = bench.groups().iter().position(|group| group.class.tag == tag)?;
    let before: u64 = bench.groups()[..group].iter().map(|group| group.tests).sum();
    // Random tests exist beyond the set's own share of them.
    let open_ended = tag == crate::case::walk::RANDOM.tag;
    let exists = open_ended || index < bench.groups()[group].tests;
    exists.then_some(TestAt { group, index, test: before.saturating_add(index) })
}

/// The tests of a part, in order, with the rows each may give.
pub fn walk_tests(
    bench: &dyn Bench,
    shard: Shard,
    count: u64,
) -> impl Iterator<Item = (TestAt, u64)> {
    let groups = bench.groups();
    let (first, end) = shard.range(tests(groups));
    // Rows before this part, for the cut of the last walk: every group has one length of test,
    // or a short list.
    let mut rows: u64 = 0;
    let mut number = 0;
    for (group, entry) in groups.iter().enumerate() {
        let here = first.clamp(number, number + entry.tests) - number;
        let same_length = entry.class.tag == crate::case::walk::RANDOM.tag
            || entry.class.tag == crate::case::walk::SCENE.tag;
        if same_length && here > 0 {
            let at = TestAt { group, index: 0, test: number };
            // Tests of as many rows as they have samples are not cut.
            if let Some(each) = bench.rows(at) {
                rows += each * here;
            }
        } else {
            let tests = (0..here).map(|index| TestAt { group, index, test: number + index });
            rows += tests.filter_map(|at| bench.rows(at)).sum::<u64>();
        }
        number += entry.tests;
    }
    let mut left = count.saturating_sub(rows);
    (first..end).filter_map(move |test| {
        let at = locate(groups, test)?;
        match bench.rows(at) {
            // Triangles give as many rows as they have samples.
            None => Some((at, u64::MAX)),
            Some(_) if left == 0 => None,
            Some(rows) => {
                let taken = rows.min(left);
                left -= taken;
                Some((at, taken))
            }
        }
    })
}
