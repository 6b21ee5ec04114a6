//! Triangles on the sub-pixel grid: directed classes and random ones. Spec clause `X-3`.

use super::{Class, Directed, Words};
use crate::profile::Profile;
use crate::setup::Triangle;

/// The class of random triangles.
pub const RANDOM: Class =
    Class { tag: "random", catches: "what nobody thought of: triangles of every size and shape" };

/// The class of triangles searched for cells that the directed classes left open; no seed decides it.
pub const CLOSING: Class = Class {
    tag: "closing",
    catches: "combinations that no directed class meets: ties by octant and zone",
};

/// The class of the scene's own triangles.
pub const SCENE: Class = Class { tag: "scene", catches: "what a real scene meets" };

/// Stimulus for one profile: its grid, window and depth range.
#[derive(Clone, Copy, Debug)]
pub struct Stimulus {
    range: (i128, i128),
    pixel: i128,
    /// Bits that a slope's numerator is scaled by before it is divided.
    scale: u32,
    /// Bits that the start's numerator is scaled by.
    fraction: u32,
    centre: [i128; 2],
    window: [i128; 2],
    depth: Option<i128>,
}

impl Stimulus {
    /// Stimulus for a valid profile.
    pub fn new(profile: &Profile) -> Self {
        let grid = profile.grid().map_or([0; 2], |grid| grid.offset);
        Self {
            range: profile.vertex.range(),
            pixel: 1 << profile.vertex.sub_pixel,
            scale: profile.vertex.sub_pixel + profile.depth.map_or(0, |depth| depth.interpolation),
            fraction: profile.depth.map_or(0, |depth| depth.interpolation),
            centre: grid,
            window: [i128::from(profile.window.width), i128::from(profile.window.height)],
            depth: profile.depth.map(|_| i128::from(profile.depth_max())),
        }
    }

    /// The directed classes; what does not fit the vertex field is left out.
    pub fn directed(&self) -> Vec<Directed<Triangle>> {
        [
            self.all_bits(),
            self.zero_area(),
            self.shared_edges(),
            self.on_samples(),
            self.slivers(),
            self.widest_slopes(),
            self.ends(),
            self.remainders(),
            self.guard_boundary(),
            self.beyond_window(),
        ]
        .into_iter()
        .map(|(tag, catches, list)| {
            let triangles = list.into_iter().filter_map(|(xy, z)| self.fit(xy, z)).collect();
            Directed { class: Class { tag, catches }, tests: triangles }
        })
        .filter(|class| !class.tests.is_empty())
        .collect()
    }

    /// The triangle, if it fits the field; depths are fractions of the range: 0 to 16.
    fn fit(&self, xy: [[i128; 2]; 3], z: [i128; 3]) -> Option<Triangle> {
        let (low, high) = self.range;
        let fits = xy.iter().flatten().all(|value| (low..=high).contains(value));
        let z = self.depth.map(|maximum| z.map(|part| Self::part(part, maximum)));
        fits.then_some(Triangle { xy, z })
    }

    /// `part` sixteenths of the depth range; negative parts count codes down from the top, parts
    /// above 16 are codes plus 17.
    fn part(part: i128, maximum: i128) -> i128 {
        match part {
            0..=16 => maximum * part / 16,
            17.. => (part - 17).min(maximum),
            _ => (maximum + 1 + part).max(0),
        }
    }

    /// The sample nearest the middle of the window's upper left part.
    fn middle(&self) -> [i128; 2] {
        std::array::from_fn(|axis| (self.window[axis].min(16) / 2) * self.pixel + self.centre[axis])
    }

    /// Vertices with every bit of their fields in use, each triangle's the complement of the one
    /// before it: large ones, and small ones far from zero.
    fn all_bits(&self) -> Kind {
        let (low, high) = self.range;
        let span = high - low;
        // All ones of as many bits as the field holds.
        let ones = (1i128 << (span + 1).ilog2()) - 1;
        let stripes = super::walk::STRIPES.map(|stripe| stripe.cast_signed() & ones);
        let mut list = Vec::new();
        for n in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| stripes[(n + k) % 3]);
            // Within the window too.
            let [w, h] = self.window.map(|side| (1i128 << (side * self.pixel).ilog2()) - 1);
            let p = self.pixel;
            let small = [
                [a & w, b & h],
                [(a ^ (3 * p + 5)) & w, (b ^ 1) & h],
                [(a ^ 9) & w, (b ^ (2 * p + 3)) & h],
            ];
            for xy in [[[a, b], [c, a], [b, ones ^ c]], small.map(|v| v.map(|c| c - low))] {
                let z = self.depth.map_or(0, |maximum| maximum / 3);
                let depths = [17 + z, 17 + 2 * z, 17 + z / 5];
                list.push((xy.map(|v| v.map(|c| low + c)), depths));
                // The complement of every bit, in the same order and turned.
                let other = xy.map(|v| v.map(|c| high - c));
                let depths =
                    depths.map(|z| 17 + self.depth.map_or(0, |maximum| maximum - (z - 17)));
                list.push((other, depths));
                list.push(([xy[0], xy[2], xy[1]].map(|v| v.map(|c| low + c)), depths));
            }
        }
        ("all-bits", "a bit that is not connected, a word of the last record that stays", list)
    }

    /// Small triangles across each side and each corner of the window, as far as the vertex field
    /// reaches beyond it.
    fn beyond_window(&self) -> Kind {
        let (low, high) = self.range;
        let p = self.pixel;
        let reach = [4 * p, p];
        let mut list = Vec::new();
        let [w, h] = self.window.map(|side| side * p);
        let middle = [w / 2, h / 2];
        for [x, y] in [
            [0, middle[1]],
            [w, middle[1]],
            [middle[0], 0],
            [middle[0], h],
            [0, 0],
            [w, 0],
            [0, h],
            [w, h],
        ] {
            for reach in reach {
                let at = |dx: i128, dy: i128| {
                    [(x + dx * reach).clamp(low, high), (y + dy * reach).clamp(low, high)]
                };
                list.push(([at(-1, -1), at(1, -1), at(0, 1)], [0, 16, 8]));
                list.push(([at(1, 1), at(-1, 1), at(-1, -1)], [16, 0, 8]));
            }
        }
        (
            "beyond-window",
            "a column or row drawn beyond the window, or one before its side lost",
            list,
        )
    }

    fn zero_area(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let list = [
            [[x, y]; 3],
            [[x, y], [x, y], [x + p, y + p]],
            [[x - p, y], [x, y], [x + p, y]],
            [[x, y - p], [x, y + p], [x, y]],
            [[x - p, y - p], [x + p, y + p], [x, y]],
            [[0, 0], [p, p], [2 * p, 2 * p]],
        ];
        let catches = "a division by zero area, or a degenerate triangle that draws";
        ("zero-area", catches, list.into_iter().map(|xy| (xy, [0, 16, 3])).collect())
    }

    /// Both sides of edges through sample points, in sixteen directions, both windings.
    fn shared_edges(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let directions = [[2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [-1, 2], [-1, 1], [-2, 1]];
        let mut list = Vec::new();
        for [dx, dy] in directions {
            let (from, to) = ([x - dx * p, y - dy * p], [x + dx * p, y + dy * p]);
            // The third vertex on either side, off the sample grid where there is a grid finer.
            for side in [1, -1] {
                let apex = [x - side * dy * p + p / 2, y + side * dx * p + p / 4];
                list.push(([from, to, apex], [0, 16, 8]));
                list.push(([to, from, apex], [3, 1, 16]));
            }
        }
        ("shared-edges", "holes and double hits along shared edges: the fill rule's tie", list)
    }

    /// Samples on vertices and on edges, every vertex order.
    fn on_samples(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let shapes = [
            [[x, y], [x + p, y], [x, y + p]],
            [[x, y], [x - p, y + p], [x + p, y + p]],
            [[x, y], [x + p, y - p], [x + p, y + p]],
            [[x, y], [x - p, y - p], [x - p, y + p]],
            [[x, y], [x + p, y - p], [x - p, y - p]],
            [[x - p, y], [x + p, y], [x, y - p]],
        ];
        let list = shapes
            .iter()
            .flat_map(|shape| orders.map(|order| (order.map(|n: usize| shape[n]), [0, 8, 16])))
            .collect();
        ("sample-on-vertex", "a vertex or edge through a sample, in every vertex order", list)
    }

    fn slivers(&self) -> Kind {
        let [x, y] = self.middle();
        let (p, last) =
            (self.pixel, [0, 1].map(|axis| (self.window[axis].min(64) - 1) * self.pixel));
        let list = vec![
            ([[0, y], [last[0], y], [last[0], y + 1]], [0, 16, 16]),
            ([[0, y], [last[0], y + 1], [0, y + 1]], [16, 0, 16]),
            ([[x, 0], [x, last[1]], [x + 1, last[1]]], [0, 16, 0]),
            ([[x, 0], [x + 1, 0], [x, last[1]]], [0, 16, 8]),
            ([[0, 0], [last[0], last[1]], [last[0], last[1] - 1]], [0, 16, 0]),
            ([[0, last[1]], [last[0], 0], [last[0], 1]], [16, 0, 16]),
            ([[1, p], [last[0], p + 1], [last[0] - 1, p + 2]], [0, 1, 16]),
        ];
        ("slivers", "precision lost in long thin triangles", list)
    }

    /// Areas of 1/2, 1 and so on square sub-pixels, with the whole depth range across them.
    fn widest_slopes(&self) -> Kind {
        let [x, y] = self.middle();
        let list = [
            [[x, y], [x + 1, y], [x, y + 1]],
            [[x - 1, y], [x + 1, y], [x, y + 1]],
            [[x - 1, y - 1], [x + 1, y], [x, y + 1]],
            [[x + 1, y], [x, y + 1], [x - 1, y - 1]],
        ]
        .into_iter()
        .flat_map(|xy| [[0, 16, 0], [16, 0, 0], [0, 0, 16], [16, 16, 0]].map(|z| (xy, z)))
        .collect();
        ("widest-slopes", "slope words too narrow, a divider that overflows", list)
    }

    /// Both ends of every range: the whole window, its corners, one pixel, depth 0 and maximum.
    fn ends(&self) -> Kind {
        let (low, high) = self.range;
        let p = self.pixel;
        let [w, h] = self.window.map(|side| (side * self.pixel).min(high));
        let mut list = vec![
            ([[0, 0], [w, 0], [0, h]], [0, 16, 16]),
            ([[w, h], [0, h], [w, 0]], [16, 0, 8]),
            ([[low, low], [high, low], [low, high]], [0, 16, 0]),
            ([[high, high], [low, high], [high, low]], [16, 16, 16]),
        ];
        for [x, y] in [[0, 0], [w - p, 0], [0, h - p], [w - p, h - p]] {
            list.push(([[x, y], [x + p, y], [x, y + p]], [0, 0, 0]));
            list.push(([[x + p, y + p], [x, y + p], [x + p, y]], [16, 16, 16]));
            list.push(([[x, y], [x + p, y], [x + p, y + p]], [0, -1, 18]));
        }
        ("range-ends", "both ends of every field: window, vertex range, depth range", list)
    }

    /// Small areas with every depth difference: every remainder of the slope's rounding.
    fn remainders(&self) -> Kind {
        let [x, y] = self.middle();
        let mut list = Vec::new();
        for area in 1..=12 {
            for z in 0..=area {
                list.push(([[x, y], [x + area, y], [x, y + 1]], [17, 17 + z, 17]));
                list.push(([[x, y], [x + 1, y], [x, y + area]], [17 + z, 17, 17]));
            }
        }
        // Twice the area 2^(scale + 1) under an odd numerator: the slope lies half way between two
        // words. In every octant, and for either slope.
        let ties = self.scale + 1;
        let (p, q) = (1i128 << ties.div_ceil(2), 1i128 << (ties / 2));
        let [x, y] = self.window.map(|side| side * self.pixel / 2);
        // From the window's corner too, for fields too small for those about its middle.
        let turns = [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(|turn| ([x, y], turn));
        for ([x, y], [dx, dy]) in turns.into_iter().chain([([0, 0], [1, 1])]) {
            let at = |u: i128, v: i128| [[x + dx * u, y + dy * v], [x + dx * v, y + dy * u]];
            let (b, c) = (at(p, 1), at(p, 1 + q));
            for axes in 0..2 {
                for z in [[17, 18, 17], [18, 17, 18], [17, 20, 18], [20, 17, 19]] {
                    list.push(([[x, y], b[axes], c[axes]], z));
                }
                // In every octant, with a start inside, below and above the depth range.
                let top = self.depth.unwrap_or_default();
                for base in [17 + 10.min(top), 17 + top / 2, 17 + (top - 10).max(0)] {
                    for [b_z, c_z] in [[0, 1], [0, -1], [4, 3], [-4, -3]] {
                        let z = [base, base + b_z, base + c_z];
                        list.push(([[x, y], b[axes], c[axes]], z.map(|z| z.max(17))));
                    }
                }
                // Every quotient mod 4 under a tie, of either sign.
                for odd in [1, 3, 5, 7] {
                    for z in [[27, 27, 27 - odd], [27, 27, 27 + odd], [27, 26, 26 + odd]] {
                        list.push(([[x, y], b[axes], c[axes]], z));
                    }
                }
            }
        }
        // The start's numerator is scaled by fewer bits: twice the area 2^(F + 1), at an odd distance
        // from the sample of pixel (0, 0).
        let ties = self.fraction + 1;
        let (p, q) = (1i128 << ties.div_ceil(2), 1i128 << (ties / 2));
        let odd = self.centre.map(|offset| 1 - offset.rem_euclid(2));
        let [x, y] = [0, 1].map(|axis| (self.window[axis] * self.pixel / 2 & !1) + odd[axis]);
        for ([x, y], [dx, dy]) in [
            ([x, y], [1, 1]),
            ([x, y], [-1, -1]),
            (odd, [1, 1]),
            ([x, y], [1, -1]),
            ([x, y], [-1, 1]),
        ] {
            let at = |u: i128, v: i128| [[x + dx * u, y + dy * v], [x + dx * v, y + dy * u]];
            let (b, c) = (at(p, 1), at(p, 1 + q));
            for axes in 0..2 {
                for step in [1, 3, 5, 7] {
                    for z in [[27, 27, 27 - step], [27, 27, 27 + step], [28, 28, 28 + step]] {
                        list.push(([[x, y], b[axes], c[axes]], z));
                    }
                }
            }
        }
        ("every-remainder", "a rounding other than the profile's, ties above all", list)
    }

    /// Samples whose plane runs just below zero and just above the maximum.
    fn guard_boundary(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let list = [1, 3, 5, 7]
            .into_iter()
            .flat_map(|size| {
                let xy = [[x, y], [x + size * p, y], [x, y + size * p]];
                [[17, 18, 17], [17, 17, 18], [-1, -2, -1], [-1, -1, -2], [17, -1, 18]]
                    .map(|z| (xy, z))
            })
            .collect();
        (
            "guard-boundary",
            "a missing guard bit: covered samples just outside the depth range",
            list,
        )
    }

    /// A triangle that may close what the directed classes left open: small, or with an area that makes
    /// ties, anywhere in the window and of any depths.
    pub fn closing(&self, mut words: Words) -> Triangle {
        let bounded = |words: &mut Words, high: i128| words.between(0, within_i64(high));
        let (low, high) = self.range;
        let corner: [i128; 2] =
            std::array::from_fn(|axis| bounded(&mut words, self.window[axis] * self.pixel));
        let xy = match bounded(&mut words, 2) {
            0 => std::array::from_fn(|_| corner.map(|at| at + bounded(&mut words, 8))),
            kind => {
                let ties = if kind == 1 { self.scale } else { self.fraction } + 1;
                let (p, q) = (1i128 << ties.div_ceil(2), 1i128 << (ties / 2));
                let [dx, dy] = [(); 2].map(|()| 1 - 2 * bounded(&mut words, 1));
                let turned = bounded(&mut words, 1) == 1;
                let [x, y] = corner;
                let at = |u: i128, v: i128| {
                    let [u, v] = if turned { [v, u] } else { [u, v] };
                    [x + dx * u, y + dy * v]
                };
                [[x, y], at(p, 1), at(p, 1 + q)]
            }
        };
        let z = self.depth.map(|maximum| {
            std::array::from_fn(|_| {
                let bits = i128::from(i128::BITS - maximum.leading_zeros());
                let size = maximum >> bounded(&mut words, bits - 1);
                let part = bounded(&mut words, size);
                if bounded(&mut words, 1) == 0 { part } else { maximum - part }
            })
        });
        Triangle { xy: xy.map(|v: [i128; 2]| v.map(|c| c.clamp(low, high))), z }
    }

    /// A random triangle; `reach` bounds its extent in pixels when given.
    pub fn random(&self, mut words: Words, reach: Option<i128>) -> Triangle {
        let (low, high) = self.range;
        // Depth codes of 64 bits are drawn from the lower half of their range: the ends of it are
        // drawn by name below.
        let mut between = |low: i128, high: i128| {
            let [low, high] = [low, high].map(within_i64);
            words.between(low, high.max(low))
        };
        // Sizes of every magnitude, from a sub-pixel to the window.
        let largest = reach.map_or(high - low, |pixels| pixels * self.pixel);
        let bits = i128::BITS - largest.leading_zeros();
        let size = largest >> between(0, i128::from(bits) - 1);
        let corner: [i128; 2] =
            std::array::from_fn(|axis| between(0, (self.window[axis] * self.pixel - size).max(0)));
        let xy = std::array::from_fn(|_| {
            corner.map(|at| (at + between(0, size.max(1))).clamp(low, high))
        });
        let z = self.depth.map(|maximum| {
            std::array::from_fn(|_| match between(0, 7) {
                0 => 0,
                1 => maximum,
                _ => between(0, maximum),
            })
        });
        Triangle { xy, z }
    }
}

/// The nearest value that 64 bits hold.
fn within_i64(value: i128) -> i64 {
    let value = value.clamp(i64::MIN.into(), i64::MAX.into());
    i64::try_from(value).unwrap_or_else(|_| unreachable!("{value} was held in the range"))
}

/// Tag, what it catches, and triangles with depths as [`Stimulus::part`] takes them.
type Kind = (&'static str, &'static str, Vec<([[i128; 2]; 3], [i128; 3])>);
