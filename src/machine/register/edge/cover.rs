//! Edge words and what is inside of them. Spec clauses `RE-1` to `RE-4`.

use crate::cover::SampleGrid;
use std::ops::Range;

/// A number mod 2^width, as a signed number of at most 64 bits.
pub(super) fn fold(value: i128, width: u32) -> i64 {
    let above = 128 - width.min(64);
    crate::bits::bounded(value << above >> above)
}

/// An edge through two vertices whose word does not change by equal steps: it is cut at every pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exact {
    pub(super) from: [i128; 2],
    pub(super) delta: [i128; 2],
    pub(super) sign: i128,
    /// Places that products and their difference are cut by.
    pub(super) cuts: [u32; 2],
    pub(super) grid: SampleGrid,
}

impl Exact {
    /// The word at a pixel before it wraps. Clause `RE-1`.
    pub(super) fn at(&self, pixel: [i64; 2]) -> i128 {
        self.at_sample(self.grid.position(pixel[0].into(), pixel[1].into()))
    }

    /// The same at a place in sub-pixels.
    pub(super) fn at_sample(&self, sample: [i128; 2]) -> i128 {
        let down = (self.delta[0] * (sample[1] - self.from[1])) >> self.cuts[0];
        let right = (self.delta[1] * (sample[0] - self.from[0])) >> self.cuts[0];
        (self.sign * (down - right)) >> self.cuts[1]
    }

    /// The changes to the next pixel, if they are the same everywhere.
    pub(super) fn steps(&self) -> Option<[i128; 2]> {
        let places = self.cuts[0] + self.cuts[1];
        let step =
            [-self.delta[1], self.delta[0]].map(|delta| (self.sign * delta) << self.grid.sub_pixel);
        let whole = |step: &i128| step & ((1 << places) - 1) == 0;
        step.iter().all(whole).then(|| step.map(|step| step >> places))
    }
}

/// One edge word over the pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Where it has its value.
    pub(super) origin: [i64; 2],
    pub(super) value: i64,
    pub(super) step: [i64; 2],
    /// In place of all these.
    pub(super) exact: Option<Exact>,
    /// Signs of the changes as they are, and not as a word holds them.
    pub(super) leans: [i128; 2],
    /// Whether the word is negated.
    pub(super) negated: bool,
}

/// Three edge words and the test of a pixel.
#[derive(Clone, Debug)]
pub(super) struct Cover {
    pub(super) width: u32,
    pub(super) edges: [Edge; 3],
    /// Whether the test is turned: inside is where words are negative.
    pub(super) turned: bool,
    /// Whether words that all pass the turned test are inside too.
    pub(super) either: bool,
    pub(super) strict: bool,
    /// 1 for an edge that does not own its samples; by the test as it is, and turned.
    pub(super) bias: [[i64; 3]; 2],
}

impl Cover {
    /// A value mod 2^width, as a signed number.
    #[inline]
    pub(super) const fn wrap(&self, value: i64) -> i64 {
        let above = 64 - self.width;
        value << above >> above
    }

    /// One edge word at a pixel.
    #[inline]
    fn word(&self, edge: &Edge, at: [i64; 2]) -> i64 {
        let value = match &edge.exact {
            None => {
                let x = edge.step[0].wrapping_mul(at[0] - edge.origin[0]);
                let y = edge.step[1].wrapping_mul(at[1] - edge.origin[1]);
                edge.value.wrapping_add(x).wrapping_add(y)
            }
            Some(exact) => fold(exact.at(at), self.width),
        };
        self.wrap(if edge.negated { value.wrapping_neg() } else { value })
    }

    /// The edge words at a pixel.
    #[inline]
    pub(super) fn words(&self, at: [i64; 2]) -> [i64; 3] {
        self.edges.each_ref().map(|edge| self.word(edge, at))
    }

    /// Whether a word passes the test of its edge.
    #[inline]
    fn passes(&self, k: usize, word: i64, turned: bool) -> bool {
        let bias = self.bias[usize::from(turned)][k];
        match (self.strict, turned) {
            (true, false) => word > 0,
            (true, true) => word < 0,
            (false, false) => self.wrap(word.wrapping_sub(bias)) >= 0,
            (false, true) => self.wrap(word.wrapping_add(bias)) <= 0,
        }
    }

    /// Whether words are those of a pixel inside. Clauses `RE-3` and `RE-4`.
    #[inline]
    pub(super) fn inside(&self, words: [i64; 3]) -> bool {
        let all = |turned: bool| (0..3).all(|k| self.passes(k, words[k], turned));
        all(self.turned) || self.either && all(!self.turned)
    }

    /// Whether all of these pixels are outside of one and the same edge.
    pub(super) fn all_beyond_one(&self, pixels: [[i64; 2]; 4]) -> bool {
        let words = pixels.map(|at| self.words(at));
        let beyond = |turned: bool| {
            (0..3).any(|k| words.iter().all(|words| !self.passes(k, words[k], turned)))
        };
        beyond(self.turned) && (!self.either || beyond(!self.turned))
    }

    /// The part of a row outside of which nothing is inside, and whether all of it is. An edge word that wraps
    /// within the row, or is cut at every pixel, bounds nothing.
    pub(super) fn span(&self, y: i64, range: Range<i64>) -> (Range<i64>, bool) {
        let (mut low, mut high, mut known) = (range.start, range.end, !self.either);
        if low >= high {
            return (low..low, true);
        }
        let (bottom, top) = (-1i64 << (self.width - 1), i64::MAX >> (64 - self.width));
        for (k, edge) in self.edges.iter().enumerate() {
            let bounded = !self.either && edge.exact.is_none();
            // Inside is where first + step n >= 0, n pixels from the start of the row.
            let sign = if self.turned { -1 } else { 1 };
            let less = if self.strict { 1 } else { self.bias[usize::from(self.turned)][k] };
            let word = self.word(edge, [range.start, y]);
            let step =
                self.wrap(if edge.negated { edge.step[0].wrapping_neg() } else { edge.step[0] });
            let last = step.checked_mul(range.end - 1 - range.start);
            let ends = last.and_then(|last| Some((word, word.checked_add(last)?)));
            let held = |word: i64| word > bottom + 1 && word < top && step != i64::MIN;
            let Some((word, _)) = ends.filter(|ends| bounded && held(ends.0) && held(ends.1))
            else {
                known = false;
                continue;
            };
            let (first, step) = (sign * word - less, sign * step);
            if step > 0 && first < 0 {
                low = low.max(range.start.saturating_add((-first - 1) / step + 1));
            } else if step < 0 && first >= 0 {
                high = high.min(range.start.saturating_add(first / -step + 1));
            } else if step <= 0 && first < 0 {
                return (low..low, true);
            }
        }
        (low..high.max(low), known)
    }
}
