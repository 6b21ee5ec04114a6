//! Test stimulus, determined by (seed, class, index). Spec clauses `X-1` to `X-5`.
//!
//! Counter-based: every word is a pure function of its key, so any case can be drawn alone, in any
//! order, on any number of threads, and an implementation in another language has four lines.

pub mod engine;
pub mod triangle;
pub mod walk;

/// A group of tests of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// Short tag, part of every test's id.
    pub tag: &'static str,
    /// The kind of defect it catches, in one sentence.
    pub catches: &'static str,
}

/// A directed class and its tests.
#[derive(Clone, Debug)]
pub struct Directed<T> {
    /// What they are for.
    pub class: Class,
    /// The tests.
    pub tests: Vec<T>,
}

/// A short selection of the other classes, which comes first: see [`Directed::core`].
pub const CORE: Class = Class {
    tag: "core",
    catches: "most defects, in the first thousand rows: a few tests of each directed class",
};

/// Rows of the core that a bench aims at.
pub const CORE_ROWS: u64 = 1000;

impl<T: Clone> Directed<T> {
    /// Tests of these classes, taken evenly from each, with about [`CORE_ROWS`] rows in all; `rows`
    /// says how many a test has. The first test is that of the first class. No seed decides it.
    pub fn core(classes: &[Self], rows: impl Fn(&T) -> u64) -> Self {
        let mut tests = Vec::new();
        for (n, Self { tests: all, .. }) in classes.iter().enumerate() {
            // What one class does not use is left to those after it.
            let used: u64 = tests.iter().map(&rows).sum();
            let share = CORE_ROWS.saturating_sub(used) / (classes.len() - n) as u64;
            let whole: u64 = all.iter().map(&rows).sum();
            let mut taken = 0;
            let mut before = 0;
            for test in all {
                // Every part of the class in proportion.
                let due = u128::from(before) * u128::from(share) / u128::from(whole.max(1));
                before += rows(test);
                if u128::from(taken) <= due && taken + rows(test) <= share.max(1) {
                    taken += rows(test);
                    tests.push(test.clone());
                }
            }
        }
        Self { class: CORE, tests }
    }
}

/// The 64-bit golden ratio, the increment of SplitMix64.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// SplitMix64's finaliser: a bijection of 64-bit words.
const fn mix(word: u64) -> u64 {
    let word = (word ^ word >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ word >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ word >> 31
}

/// One step of the key schedule: `mix((state ^ word) + GOLDEN)`, mod 2^64.
const fn absorb(state: u64, word: u64) -> u64 {
    mix((state ^ word).wrapping_add(GOLDEN))
}

/// Word `n` of case `index` of `class` under `seed`.
///
/// Four steps from a state of zero absorb the seed, the class, the index and n; the state is then
/// the word. Each step is a bijection of the state for a given word and of the word for a given
/// state, so two keys that differ in one part never give the same word.
///
/// ```
/// use guardbit::case::mix64;
/// assert_eq!(mix64(0, 0, 0, 0), 0x2130_748a_aac8_0268);
/// ```
pub const fn mix64(seed: u64, class: u64, index: u64, n: u64) -> u64 {
    absorb(absorb(absorb(absorb(0, seed), class), index), n)
}

/// The words of one case, by number or in turn.
///
/// ```
/// use guardbit::case::{Words, mix64};
/// let mut words = Words::new(7, 1, 42);
/// assert_eq!(words.draw(), mix64(7, 1, 42, 0));
/// assert_eq!(words.draw(), words.word(1));
/// assert!((-3..=3).contains(&words.between(-3, 3)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// The state after seed, class and index.
    state: u64,
    next: u64,
}

impl Words {
    /// The words of case `index` of `class` under `seed`.
    pub const fn new(seed: u64, class: u64, index: u64) -> Self {
        Self { state: absorb(absorb(absorb(0, seed), class), index), next: 0 }
    }

    /// Word `n`, 64 bits.
    pub const fn word(&self, n: u64) -> u64 {
        absorb(self.state, n)
    }

    /// The next word, starting from word 0.
    pub const fn draw(&mut self) -> u64 {
        let word = self.word(self.next);
        self.next = self.next.wrapping_add(1);
        word
    }

    /// An integer in `[0, limit)`: the top 64 bits of the next word times the limit; 0 for a limit
    /// of 0. Each value's share is right to within 2^-64.
    pub fn below(&mut self, limit: u64) -> u64 {
        let top = self.scaled(limit);
        u64::try_from(top).unwrap_or_else(|_| unreachable!("{top} < 2^64: the top of 128 bits"))
    }

    /// An integer in `[low, high]`; `low` for an empty range. Ranges wider than 2^64 - 1 are cut to
    /// that many values from `low`.
    pub fn between(&mut self, low: i64, high: i64) -> i128 {
        let count = if low > high { 0 } else { high.abs_diff(low).saturating_add(1) };
        i128::from(low) + self.scaled(count).cast_signed()
    }

    /// The top 64 bits of the next word times a limit.
    fn scaled(&mut self, limit: u64) -> u128 {
        (u128::from(self.draw()) * u128::from(limit)) >> 64
    }
}

/// The place of item `n` of a list that is in memory.
pub(crate) fn place(n: u64) -> usize {
    usize::try_from(n).unwrap_or_else(|_| unreachable!("item {n} of a list that is in memory"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finaliser_is_splitmix64() {
        // Its published stream for seed 1234567: outputs are mix(seed + n GOLDEN), n from 1.
        let stream: Vec<u64> =
            (1..=3).map(|n: u64| mix(1_234_567_u64.wrapping_add(n.wrapping_mul(GOLDEN)))).collect();
        let published =
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(stream, published);
    }

    #[test]
    fn parts_of_the_key_do_not_stand_in_for_one_another() {
        let keys = [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0, 0, 0, 0)];
        let mut words: Vec<u64> = keys.iter().map(|k| mix64(k.0, k.1, k.2, k.3)).collect();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), keys.len());
    }

    #[test]
    fn a_range_is_covered_and_kept() {
        let mut seen = [0; 7];
        for index in 0..7000 {
            let value = Words::new(1, 2, index).between(-3, 3);
            seen[usize::try_from(value + 3).unwrap()] += 1;
        }
        // 1000 each; 150 is five standard deviations.
        assert!(seen.iter().all(|count| (850..1150).contains(count)), "{seen:?}");
        assert_eq!(Words::new(0, 0, 0).between(5, 5), 5);
        assert_eq!(Words::new(0, 0, 0).between(5, 4), 5);
        let whole = Words::new(0, 0, 0).between(i64::MIN, i64::MAX);
        assert!(i64::try_from(whole).is_ok());
    }
}
