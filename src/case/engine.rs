//! Set-up words for an engine that no vertices give, with their boxes. Spec clause `X-5`.

use super::{Class, Directed};
use crate::format::ReadOut;

/// Set-up words and the box they are drawn over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// Value at pixel (0, 0), step right and step down of each edge.
    pub edges: [[i128; 3]; 3],
    /// The same of the depth plane, if there is one.
    pub depth: Option<[i128; 3]>,
    /// The flag of no area: nothing is drawn whatever the words say.
    pub zero_area: bool,
    /// The box: x0 y0 x1 y1, half-open.
    pub bounds: [u32; 4],
}

impl Drawn {
    /// Samples of the box.
    pub fn samples(&self) -> u64 {
        let [x0, y0, x1, y1] = self.bounds;
        u64::from(x1.saturating_sub(x0)) * u64::from(y1.saturating_sub(y0))
    }
}

/// The engine that is given the words.
#[derive(Clone, Copy, Debug)]
pub struct Engine {
    /// Bits of an edge word.
    pub edge: u32,
    /// Depth accumulator and read-out, if there is depth.
    pub read: Option<ReadOut>,
    /// Width and height of the window in pixels.
    pub window: [u32; 2],
}

impl Engine {
    /// The directed classes. `most` bounds the covered samples of `run-lengths`: longer runs than it
    /// allows are left out, the longest first.
    pub fn directed(&self, most: u64) -> Vec<Directed<Drawn>> {
        let mut list = vec![self.all_bits(), self.box_cuts(), self.edge_signs()];
        list.extend(self.read.map(|read| self.guard_patterns(read)));
        list.extend(self.read.map(|read| self.guard_splits(read)));
        list.push(self.run_lengths(most));
        list
    }

    /// A signed word of the low bits of a pattern.
    fn word(width: u32, pattern: u128) -> i128 {
        pattern.cast_signed() << (128 - width) >> (128 - width)
    }

    /// An edge whose word is far inside and does not move.
    fn inside(&self) -> [i128; 3] {
        [1 << (self.edge - 2), 0, 0]
    }

    /// A plane in the middle of its range, with a step of one code and one unit either way.
    fn plane(&self) -> Option<[i128; 3]> {
        let read = self.read?;
        Some([read.top() / 2, (1 << read.fraction()) + 1, -(1 << read.fraction()) - 1])
    }

    /// Words at pixel (0, 0) that have these values at the corner of the box.
    fn from_corner([value, dx, dy]: [i128; 3], [x0, y0, ..]: [u32; 4]) -> [i128; 3] {
        let across = dx.wrapping_mul(x0.into()).wrapping_add(dy.wrapping_mul(y0.into()));
        [value.wrapping_sub(across), dx, dy]
    }

    /// A box of this size whose corner is as near to a place as the window allows.
    fn box_at(&self, [x, y]: [u32; 2], [w, h]: [u32; 2]) -> [u32; 4] {
        let [width, height] = self.window;
        let (w, h) = (w.min(width), h.min(height));
        let (x0, y0) = (x.min(width - w), y.min(height - h));
        [x0, y0, x0 + w, y0 + h]
    }

    /// The words of a case at its corner.
    fn case(&self, edges: [[i128; 3]; 3], depth: Option<[i128; 3]>, bounds: [u32; 4]) -> Drawn {
        let reduced = |width: u32, words: [i128; 3]| {
            Self::from_corner(words, bounds).map(|word| Self::word(width, word.cast_unsigned()))
        };
        let edges = edges.map(|words| reduced(self.edge, words));
        let depth = depth.zip(self.read).map(|(words, read)| reduced(read.width(), words));
        Drawn { edges, depth, zero_area: false, bounds }
    }

    /// Records with every bit in use, each the complement of the one before it.
    fn all_bits(&self) -> Directed<Drawn> {
        let mut cases = Vec::new();
        let (low, high) = ([u32::MAX / 3; 2], [u32::MAX / 3 * 2; 2]);
        for n in 0..12usize {
            let flip = if n % 2 == 0 { 0 } else { u128::MAX };
            let word = |width: u32, k: usize| {
                Self::word(width, super::walk::STRIPES[(k + n / 2) % 3] << (k % 2) ^ flip)
            };
            let corner = if n % 2 == 0 { low } else { high };
            let bounds = self.box_at(
                std::array::from_fn(|axis| corner[axis] & (self.window[axis] - 1)),
                if n % 2 == 0 { [3, 2] } else { [2, 3] },
            );
            // At the corner the edges are inside: the complement is taken of the bits below the sign.
            let sign = 1u128 << (self.edge - 1);
            let edges = [0, 1, 2].map(|edge: usize| {
                let [value, dx, dy] = [0, 1, 2].map(|k| word(self.edge, 3 * edge + k));
                [Self::word(self.edge, value.cast_unsigned() & !sign), dx, dy]
            });
            let depth = self.read.map(|read| [0, 1, 2].map(|k| word(read.width(), 9 + k)));
            let mut case = self.case(edges, depth, bounds);
            // The seventh and eighth have no area.
            case.zero_area = n / 2 == 3;
            cases.push(case);
        }
        let catches = "a bit that is not connected, a word of the last record that stays";
        Directed { class: Class { tag: "word-bits", catches }, tests: cases }
    }

    /// Samples covered beyond each side of the box, boxes of one column or row, and empty ones.
    fn box_cuts(&self) -> Directed<Drawn> {
        let [width, height] = self.window;
        let mut cases = Vec::new();
        let places = [[0, 0], [width, 0], [0, height], [width, height], [width / 2, height / 2]];
        for place in places {
            for size in [[4, 3], [1, 5], [5, 1], [1, 1]] {
                let bounds = self.box_at(place, size);
                cases.push(self.case([self.inside(); 3], self.plane(), bounds));
            }
        }
        // Outside at the first column, at the last, in between, at the first row, at the last.
        let bounds = self.box_at([width / 3, height / 3], [5, 4]);
        for [value, dx, dy] in
            [[-1, 1, 0], [3, -1, 0], [-3, 1, 0], [1, -1, 0], [-1, 0, 1], [2, 0, -1], [-2, 1, 1]]
        {
            let mut edges = [self.inside(); 3];
            edges[cases.len() % 3] = [value, dx, dy];
            cases.push(self.case(edges, self.plane(), bounds));
        }
        // A run that ends at each column, and one that begins there.
        for column in 0..5 {
            let mut edges = [self.inside(); 3];
            edges[cases.len() % 3] = [-column, 1, 0];
            edges[(cases.len() + 1) % 3] = [4 - column, -1, 0];
            cases.push(self.case(edges, self.plane(), bounds));
        }
        let [x0, y0, x1, y1] = bounds;
        for empty in [[x0, y0, x0, y1], [x0, y0, x1, y0], [x1, y0, x0, y1], [x0, y1, x1, y0]] {
            cases.push(self.case([self.inside(); 3], self.plane(), empty));
            // What comes after an empty box is drawn.
            cases.push(self.case([self.inside(); 3], self.plane(), bounds));
        }
        let catches = "a column or row too many or too few at any side of the box, an empty box";
        Directed { class: Class { tag: "box-cuts", catches }, tests: cases }
    }

    /// Each edge alone about zero and about both ends of its word.
    fn edge_signs(&self) -> Directed<Drawn> {
        let mut cases = Vec::new();
        let half = 1i128 << (self.edge - 1);
        let bounds = self.box_at([self.window[0] / 5, self.window[1] / 7], [4, 3]);
        for edge in 0..3 {
            for [dx, dy] in [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1], [1, -1], [-2, 3], [3, -2]] {
                for value in [-1, 0, 1, half - 1, half - 3, half / 2, -half, -half / 2] {
                    let mut edges = [self.inside(); 3];
                    edges[edge] = [value, dx, dy];
                    cases.push(self.case(edges, self.plane(), bounds));
                }
            }
        }
        // Steps so wide that the sign comes and goes: several runs in a row.
        let bounds = self.box_at([self.window[0] / 4, self.window[1] / 2], [8, 3]);
        for edge in 0..3 {
            for [dx, dy] in [[half / 2, 1], [-half / 2, 0], [-half, half / 2]] {
                let mut edges = [self.inside(); 3];
                edges[edge] = [1, dx, dy];
                cases.push(self.case(edges, self.plane(), bounds));
            }
        }
        let catches = "an edge that is not tested or not stepped, its sign read from another bit";
        Directed { class: Class { tag: "edge-signs", catches }, tests: cases }
    }

    /// Every guard pattern, in every octant of slopes.
    fn guard_patterns(&self, read: ReadOut) -> Directed<Drawn> {
        let mut cases = Vec::new();
        let (code, top) = (1i128 << read.fraction(), read.top());
        let size = [3, 2];
        for pattern in 0..1i128 << read.guard().min(4) {
            for [a, b] in super::walk::DIRECTIONS {
                let bounds = self.box_at([self.window[0] / 2, 3], size);
                // Both halves of the pattern, and every remainder, which whole codes keep.
                for n in 0..8 {
                    let half = if n % 2 == 0 { top / 8 } else { top - top / 8 };
                    let inside = half + [0, code / 4, code / 2, code - 1][n / 2];
                    let plane = [pattern * top + inside, a * code, b * code];
                    cases.push(self.case([self.inside(); 3], Some(plane), bounds));
                }
            }
        }
        let catches = "a read-out that decodes a guard pattern wrongly, whatever way it is reached";
        Directed { class: Class { tag: "guard-patterns", catches }, tests: cases }
    }

    /// Each boundary of the read-out from both sides: both ends of the integer range, and where the
    /// guard range is split.
    fn guard_splits(&self, read: ReadOut) -> Directed<Drawn> {
        let mut cases = Vec::new();
        let (code, top) = (1i128 << read.fraction(), read.top());
        let lowest = top / 2 - (1i128 << (read.width() - 1));
        let bounds = self.box_at([5, self.window[1] / 2], [4, 2]);
        for boundary in [lowest, 0, top, lowest + (1i128 << read.width())] {
            for step in [1, code] {
                for sign in [1, -1] {
                    let plane = [boundary - 2 * sign * step, sign * step, -sign * step];
                    cases.push(self.case([self.inside(); 3], Some(plane), bounds));
                    // Down the left side of the box, not along its rows.
                    let plane = [boundary - sign * step, 0, sign * step];
                    cases.push(self.case([self.inside(); 3], Some(plane), bounds));
                }
            }
        }
        let catches =
            "an engine without a clamp, with another decode, or with its split off by one";
        Directed { class: Class { tag: "guard-splits", catches }, tests: cases }
    }

    /// Runs and columns of every power of two up to the window, and one beside it.
    fn run_lengths(&self, most: u64) -> Directed<Drawn> {
        let mut cases = Vec::new();
        let [width, height] = self.window;
        let mut left = most;
        let side = width.max(height);
        let powers = (0..u32::BITS - side.leading_zeros()).map(|power| 1u32 << power);
        // One beside a power tells a length from its last bit; beside a long one it would take as many
        // samples again.
        let beside = powers.clone().filter(|two| *two <= 256);
        let beside = beside.flat_map(|two| [two - 1, two + 1]).filter(|length| *length > 2);
        let mut lengths: Vec<u32> = powers.chain([side]).chain(beside).collect();
        lengths.sort_unstable();
        lengths.dedup();
        for length in lengths {
            for across in [true, false] {
                let (size, limit) =
                    if across { ([length, 1], width) } else { ([1, length], height) };
                if length > limit || u64::from(length) > left {
                    continue;
                }
                left -= u64::from(length);
                // Short ones end where the window does.
                let place = if length % 2 == 1 { [width, height] } else { [0, 0] };
                let bounds = self.box_at(place, size);
                // A sliver of the edges' range: they stay inside all along the run.
                let mut edges = [self.inside(); 3];
                edges[0] = [i128::from(length - 1), -i128::from(across), -i128::from(!across)];
                cases.push(self.case(edges, self.plane(), bounds));
            }
        }
        let catches = "a coordinate, a length or a count of samples in too few bits";
        Directed { class: Class { tag: "run-lengths", catches }, tests: cases }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Clamp;

    #[test]
    fn every_case_fits_its_words_and_its_window() {
        for (edge, read, window) in [
            (35, ReadOut::new(2, 24, 13, Clamp::Guard).ok(), [4096, 4096]),
            (8, ReadOut::new(1, 3, 0, Clamp::Guard).ok(), [4, 4]),
            (20, None, [1, 7]),
        ] {
            let engine = Engine { edge, read, window };
            let cases: Vec<Drawn> =
                engine.directed(10_000).into_iter().flat_map(|class| class.tests).collect();
            assert!(cases.len() > 250, "{}", cases.len());
            let fits =
                |width: u32, word: i128| (-(1 << (width - 1))..1 << (width - 1)).contains(&word);
            for case in cases {
                assert!(case.edges.iter().flatten().all(|word| fits(edge, *word)), "{case:?}");
                let depth = case.depth.zip(read);
                assert_eq!(depth.is_some(), read.is_some());
                assert!(depth.is_none_or(|(d, r)| d.iter().all(|word| fits(r.width(), *word))));
                let [x0, y0, x1, y1] = case.bounds;
                assert!(x0.max(x1) <= window[0] && y0.max(y1) <= window[1], "{case:?}");
            }
        }
    }

    #[test]
    fn run_lengths_are_the_powers_of_two_of_both_sides_and_stay_within_their_budget() {
        let engine = Engine { edge: 35, read: None, window: [4096, 1024] };
        let lengths = |most, side: usize| -> Vec<u32> {
            let cases = engine.run_lengths(most).tests;
            let size = |case: &Drawn| case.bounds[side + 2] - case.bounds[side];
            cases.iter().filter(|case| size(case) > 1).map(size).collect()
        };
        let all: Vec<u32> = lengths(u64::MAX, 0);
        for power in 1..=12u32 {
            assert!(all.contains(&(1 << power)), "{all:?}");
            assert!(power > 8 || all.contains(&((1 << power) + 1)), "{all:?}");
        }
        assert_eq!(lengths(u64::MAX, 1).iter().max(), Some(&1024));
        let few = engine.run_lengths(300).tests;
        let samples: u32 =
            few.iter().map(|c| (c.bounds[2] - c.bounds[0]) * (c.bounds[3] - c.bounds[1])).sum();
        assert!((200..=300).contains(&samples), "{samples}");
    }
}
