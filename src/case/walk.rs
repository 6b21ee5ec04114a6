//! Walks of a planar DDA or an edge stepper: directed ones aimed at the boundaries of the word and
//! of its read-out, and random ones. Spec clause `X-2`.

use super::{Class, Directed, Words};
use crate::dda::Op;
use crate::format::ReadOut;

/// Rows of a random walk.
pub const RANDOM_ROWS: u32 = 64;
/// Rows of a walk along a triangle of the scene.
pub const SCENE_ROWS: u32 = 32;

/// Which operations follow the load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// Steps by dx only.
    Right,
    /// Two steps by dx, two by dy, and again.
    Pairs,
    /// dx, hold, dy, hold, and again.
    Held,
    /// This many steps by dx, then one by dy, and again.
    Raster(u32),
    /// Drawn from the words of a case: half dx, a third dy, the rest hold.
    Random(Words),
}

/// One walk: what a bench loads, and how it then moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Walk {
    /// Start value, taken mod 2^N.
    pub init: i128,
    /// Step to the right, taken mod 2^N.
    pub dx: i128,
    /// Step downward, taken mod 2^N.
    pub dy: i128,
    /// The moves.
    pub pattern: Pattern,
    /// Rows, the load included.
    pub rows: u32,
}

impl Walk {
    /// The operation of row `n`; row 0 is the load.
    #[inline]
    pub fn op(&self, n: u32) -> Op {
        if n == 0 {
            return Op::Load;
        }
        let n = n - 1;
        match self.pattern {
            Pattern::Right => Op::StepX,
            Pattern::Pairs => {
                if n & 2 == 0 {
                    Op::StepX
                } else {
                    Op::StepY
                }
            }
            Pattern::Held => [Op::StepX, Op::Hold, Op::StepY, Op::Hold][n as usize & 3],
            Pattern::Raster(width) => {
                if n % (width + 1) == width {
                    Op::StepY
                } else {
                    Op::StepX
                }
            }
            Pattern::Random(words) => {
                // Sixteen nibbles a word.
                let nibble = words.word(8 + u64::from(n >> 4)) >> (4 * (n & 15)) & 15;
                [Op::StepX, Op::StepY, Op::Hold][usize::from(nibble > 7) + usize::from(nibble > 12)]
            }
        }
    }
}

/// The ends of an N-bit signed word.
fn ends(width: u32) -> (i128, i128) {
    let half = 1 << (width - 1);
    (-half, half - 1)
}

fn back_and_forth(init: i128, step: i128) -> Walk {
    Walk { init, dx: step, dy: -step, pattern: Pattern::Pairs, rows: 8 }
}

/// Starts and slopes at both ends of the word, and at what `marks` holds.
fn range_ends(width: u32, marks: &[i128]) -> Directed<Walk> {
    let (low, high) = ends(width);
    let mut walks = Vec::new();
    for &init in [low, low + 1, -1, 0, 1, high - 1, high].iter().chain(marks) {
        for step in [0, 1, -1, low, high] {
            walks.push(back_and_forth(init, step));
        }
    }
    let catches = "registers a bit short, sign extension, swapped slopes";
    Directed { class: Class { tag: "range-ends", catches }, tests: walks }
}

/// Sums that reach 2^N and 2^(N-1), and miss them by one.
fn wrap(width: u32) -> Directed<Walk> {
    let (low, high) = ends(width);
    let mut walks = Vec::new();
    for init in [high / 3, -high / 3, high / 2 + 1] {
        for miss in [-1, 0, 1] {
            for target in [high + 1, low, high, 2 * (high / 2), 0] {
                walks.push(back_and_forth(init, target - init + miss));
            }
        }
    }
    let catches = "an adder that saturates or carries into the guard bits instead of wrapping";
    Directed { class: Class { tag: "wrap", catches }, tests: walks }
}

/// The widest slopes in both directions.
fn widest(width: u32) -> Directed<Walk> {
    let (low, high) = ends(width);
    let mut walks = Vec::new();
    for dx in [low, low + 1, high, high - 1] {
        for dy in [low, high, 1, -1] {
            for pattern in [Pattern::Pairs, Pattern::Held] {
                walks.push(Walk { init: high / 5, dx, dy, pattern, rows: 16 });
            }
        }
    }
    let catches = "slopes cut short, a hold that steps";
    Directed { class: Class { tag: "widest-slopes", catches }, tests: walks }
}

/// A direction in each octant, x to the right and y down.
pub(super) const DIRECTIONS: [[i128; 2]; 8] =
    [[2, 1], [1, 2], [-1, 2], [-2, 1], [-2, -1], [-1, -2], [1, -2], [2, -1]];

/// Walks in every octant from each of `starts`, by steps of `unit`.
fn every_octant(starts: &[i128], unit: i128) -> Directed<Walk> {
    let mut walks = Vec::new();
    for [dx, dy] in DIRECTIONS {
        for &init in starts {
            let (dx, dy) = (dx * unit, dy * unit);
            walks.push(Walk { init, dx, dy, pattern: Pattern::Pairs, rows: 4 });
        }
    }
    let catches = "a combination of slope signs, zone and remainder that goes its own way";
    Directed { class: Class { tag: "every-octant", catches }, tests: walks }
}

/// Alternating bits, and alternating pairs and fours of bits.
pub(crate) const STRIPES: [u128; 3] = [u128::MAX / 3, u128::MAX / 5, u128::MAX / 17];

/// Words with every bit in use, each walk's the complement of those before it.
fn all_bits(width: u32) -> Directed<Walk> {
    let word = |pattern: u128| pattern.cast_signed() << (128 - width) >> (128 - width);
    let mut walks = Vec::new();
    for n in 0..6 {
        for flip in [0, u128::MAX] {
            let [init, dx, dy] = [0, 1, 2].map(|k| word(STRIPES[(n + k) % 3] << (k % 2) ^ flip));
            let pattern = [Pattern::Pairs, Pattern::Held][n % 2];
            walks.push(Walk { init, dx, dy, pattern, rows: 6 });
        }
    }
    let catches = "a bit that is not connected, a word of the last record that stays";
    Directed { class: Class { tag: "all-bits", catches }, tests: walks }
}

/// Starts and slopes that carry through every bit, and stop one short of it.
fn carries(width: u32) -> Directed<Walk> {
    let mut walks = Vec::new();
    for bit in 1..width {
        let below = (1i128 << bit) - 1;
        walks.push(Walk { init: below, dx: 1, dy: -1, pattern: Pattern::Pairs, rows: 4 });
        walks.push(Walk { init: below + 1, dx: -1, dy: below, pattern: Pattern::Pairs, rows: 4 });
    }
    let catches = "a carry or a borrow that is lost between two bits, a field cut off";
    Directed { class: Class { tag: "carries", catches }, tests: walks }
}

/// Directed walks for a depth DDA.
pub fn depth(read: ReadOut) -> Vec<Directed<Walk>> {
    let (width, fraction) = (read.width(), read.fraction());
    let half = 1i128 << (read.integer() + fraction - 1);
    // The guard split whatever the mode: a wrong decode shows at these values.
    let lowest = half - (1i128 << (width - 1));
    let boundaries = [lowest, 0, read.top(), lowest + (1i128 << width)];
    let mut guard = Vec::new();
    for boundary in boundaries {
        for step in [1, 1i128 << fraction] {
            for miss in [-2, -1, 0, 1] {
                guard.push(back_and_forth(boundary + miss * step, step));
                guard.push(back_and_forth(boundary + miss * step, -step));
            }
        }
    }
    let top_step = 1i128 << (read.integer() + fraction);
    for pattern in 0..1i128 << read.guard().min(6) {
        for inside in [0, half, top_step - 1] {
            let init = pattern * top_step + inside;
            guard.push(Walk { init, dx: top_step, dy: 1, pattern: Pattern::Pairs, rows: 12 });
        }
    }
    let catches = "a wrong guard decode: every guard pattern, and each boundary from both sides";
    let guard = Directed { class: Class { tag: "guard-boundary", catches }, tests: guard };
    // All remainders of a narrow fraction, the top six bits of a wide one, each side of a step.
    let fine = fraction.min(6);
    let step = 1i128 << (fraction - fine);
    let rows = (1 << fine) + 2;
    let remainders = [0, 1, -1, half, read.top() - (1 << fraction), -(1i128 << fraction)]
        .into_iter()
        .flat_map(|init| {
            [step, -step, step + 1].map(|dx| Walk {
                init,
                dx,
                dy: 1,
                pattern: Pattern::Right,
                rows,
            })
        })
        .collect();
    let catches = "a read-out that rounds, or drops the wrong number of bits";
    let remainders =
        Directed { class: Class { tag: "every-remainder", catches }, tests: remainders };
    // Inside, above and below, with nothing dropped, less than a half, a half, more.
    let one = 1i128 << fraction;
    let starts: Vec<i128> = [half, read.top() + half.min(4 * one), -4 * one]
        .into_iter()
        .flat_map(|zone| [0, one / 4, one / 2, one - 1].map(|rest| zone + rest))
        .collect();
    let octants = every_octant(&starts, one);
    vec![
        all_bits(width),
        range_ends(width, &boundaries),
        guard,
        wrap(width),
        carries(width),
        widest(width),
        remainders,
        octants,
    ]
}

/// Directed walks for an edge stepper.
pub fn edge(width: u32) -> Vec<Directed<Walk>> {
    let mut walks = Vec::new();
    for init in -2..=2 {
        for dx in -2..=2 {
            for dy in [-1, 1] {
                walks.push(Walk { init, dx, dy, pattern: Pattern::Pairs, rows: 10 });
            }
        }
    }
    let catches = "a sample on the edge put on the wrong side: sign test, tie rule, bias";
    let crossing = Directed { class: Class { tag: "sample-on-edge", catches }, tests: walks };
    let octants = every_octant(&[-2, -1, 0, 1], 1);
    vec![
        all_bits(width),
        range_ends(width, &[]),
        crossing,
        wrap(width),
        carries(width),
        widest(width),
        octants,
    ]
}

/// The class of random walks.
pub const RANDOM: Class = Class {
    tag: "random",
    catches: "what nobody thought of: starts and slopes of every magnitude",
};

/// The class of walks along the scene.
pub const SCENE: Class =
    Class { tag: "scene", catches: "what a real scene meets: planes and edges of its triangles" };

/// A random walk of an N-bit word: starts and slopes of every magnitude, so that wraps are common
/// but not all there is.
pub fn random(width: u32, words: Words) -> Walk {
    let wide = |n: u64| {
        let bits = u128::from(words.word(2 * n)) << 64 | u128::from(words.word(2 * n + 1));
        bits.cast_signed() >> (128 - width)
    };
    // Three sixteenths of a word, from its low end, say how far each value is shifted.
    let scales = words.word(6);
    let [b0, b1, b2, b3, b4, b5, ..] = scales.to_le_bytes();
    let scale = [[b0, b1], [b2, b3], [b4, b5]].map(|b| u32::from(u16::from_le_bytes(b)) % width);
    Walk {
        // Every other walk starts anywhere, the rest at a random magnitude.
        init: wide(0) >> if scales >> 63 == 0 { 0 } else { scale[0] },
        dx: wide(1) >> scale[1],
        dy: wide(2) >> scale[2],
        pattern: Pattern::Random(words),
        rows: RANDOM_ROWS,
    }
}
