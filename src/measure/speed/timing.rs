//! Interleaved pairs and their medians.

use std::hint::black_box;
use std::time::Instant;

/// Median times of a pair of passes over the same work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Nanoseconds of a pass of the loop under test.
    pub(super) fast_ns: f64,
    /// Nanoseconds of a pass of what it is held against.
    pub(super) plain_ns: f64,
    /// Median of the pairs' ratios.
    pub(super) ratio: f64,
}

/// Runs `plain` and `fast` in turn: whatever slows the machine down for a while slows both.
pub(super) fn versus(
    repeats: usize,
    mut plain: impl FnMut() -> u64,
    mut fast: impl FnMut() -> u64,
) -> Pair {
    let time = |work: &mut dyn FnMut() -> u64| {
        let begin = Instant::now();
        black_box(work());
        begin.elapsed().as_secs_f64() * 1e9
    };
    // One pass of each warms caches and clocks.
    time(&mut plain);
    time(&mut fast);
    let pairs: Vec<[f64; 3]> = (0..repeats.max(1))
        .map(|_| {
            let (slow, quick) = (time(&mut plain), time(&mut fast));
            [quick, slow, quick / slow]
        })
        .collect();
    let [fast_ns, plain_ns, ratio] =
        std::array::from_fn(|n| median(pairs.iter().map(|pair| pair[n])));
    Pair { fast_ns, plain_ns, ratio }
}

/// The middle value, or the upper of the middle two; NaN of nothing.
pub(super) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert!((median([3.0, 1.0, 2.0]) - 2.0).abs() < 1e-12);
        assert!((median([9.0]) - 9.0).abs() < 1e-12);
        assert!(median([]).is_nan());
    }

    #[test]
    fn pairs_take_turns_after_a_warm_pass() {
        let order = std::cell::RefCell::new(String::new());
        let note = |letter| {
            order.borrow_mut().push(letter);
            1
        };
        let pair = versus(3, || note('p'), || note('f'));
        assert_eq!(*order.borrow(), "pfpfpfpf");
        assert!(pair.fast_ns >= 0.0 && pair.plain_ns >= 0.0);
    }
}
