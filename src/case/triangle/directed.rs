//! The directed classes of triangles.

use super::Stimulus;

impl Stimulus {
    /// Vertices with every bit of their fields in use, each triangle's the complement of the one
    /// before it: large ones, and small ones far from zero.
    pub(super) fn all_bits(&self) -> Kind {
        let (low, high) = self.range;
        let span = high - low;
        // All ones of as many bits as the field holds.
        let ones = (1i128 << (span + 1).ilog2()) - 1;
        let stripes = crate::case::walk::STRIPES.map(|stripe| stripe.cast_signed() & ones);
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
    pub(super) fn beyond_window(&self) -> Kind {
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

    pub(super) fn zero_area(&self) -> Kind {
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
    pub(super) fn shared_edges(&self) -> Kind {
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
    pub(super) fn on_samples(&self) -> Kind {
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

    pub(super) fn slivers(&self) -> Kind {
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
    pub(super) fn widest_slopes(&self) -> Kind {
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
    pub(super) fn ends(&self) -> Kind {
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
    pub(super) fn remainders(&self) -> Kind {
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
        let [x, y] = [0, 1].map(|axis| ((self.window[axis] * self.pixel / 2) & !1) + odd[axis]);
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
    pub(super) fn guard_boundary(&self) -> Kind {
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
}

/// Tag, what it catches, and triangles with depths as [`Stimulus::part`] takes them.
pub(super) type Kind = (&'static str, &'static str, Vec<([[i128; 2]; 3], [i128; 3])>);
