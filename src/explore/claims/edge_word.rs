//! The stored edge word on toy formats: every edge, every sample.

use super::statement::Statement;
use crate::bits::{Rounding, RunTime, Word};
use crate::dda::Planar;
use crate::exact::{Position, Rule, classify, covers};
use crate::explore::corner::{Area, at_corners, signed_bits, top_left_bias};
use crate::setup::{EdgeCoefficients, Triangle, edges};

/// Toy windows of 2^k pixels on a grid of s bits.
const TOYS: [(u32, u32); 5] = [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1)];

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "edge.stored-word",
            "walking (E + bias) >> s in 2k+s+1 bits: number of wrong samples over every edge and \
             centre of windows of 2^k pixels with s sub-pixel bits, (k,s) = (1,1) (1,2) (2,1) (2,2) \
             (3,1); and how many of these five windows fail with one bit fewer",
            "0 wrong, 5 of 5 fail with 2k+s",
            || {
                let wrong: usize = TOYS.into_iter().map(|(k, s)| wrong_walks(k, s, 0, true)).sum();
                let fail =
                    TOYS.into_iter().filter(|(k, s)| wrong_walks(*k, *s, 1, false) > 0).count();
                format!("{wrong} wrong, {fail} of 5 fail with 2k+s")
            },
        )
        .slow(),
        Statement::exact(
            "edge.low-bits",
            "number of edges for (k,s) = (2,2) where the low s bits of E differ between two pixel \
             centres",
            "0",
            low_bits_differ,
        ),
        Statement::exact(
            "edge.down-step",
            "for the edge of lecture O (inside is negative), E(x, y+1) = E - dX and C = Y dX - X \
             dY, not E + dX; number of edges for (k,s) = (2,1) where this fails",
            "0",
            || {
                pairs(9)
                    .filter(|(from, to)| {
                        let edge = EdgeCoefficients::between(*from, *to);
                        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                        let value = |x, y| -edge.at(x, y);
                        value(3, 4) - value(3, 3) != -dx
                            || value(0, 0) != from[1] * dx - from[0] * dy
                    })
                    .count()
            },
        ),
        Statement::exact(
            "edge.any-sample",
            "2k+s+1 bits hold the biased word for every sample on the grid in [0, W)^2; tested for \
             every edge and sample for (k,s) = (1,1) (1,2) (2,1), and for the corners for k = 12, s \
             = 10; then the same without bias",
            "biased 4, 5, 6, 35; unbiased 5, 6, 7, 36",
            any_sample,
        ),
        Statement::exact(
            "cover.exact",
            "coverage with biased edge functions against exact row crossings, for every triangle \
             and grid sample of a 4 x 4 sub-pixel lattice; number of differences",
            "0",
            || lattice_triangles(4).map(differences).sum::<usize>(),
        )
        .slow(),
        Statement::exact(
            "plane.pick",
            "smallest twice-area of a lattice triangle with a lattice point strictly inside (3 by \
             Pick's theorem), and of a lattice triangle with a lattice point that the top-left rule \
             covers; over every triangle on a 4 x 4 lattice",
            "3, 1",
            smallest_areas,
        )
        .slow(),
        Statement::exact(
            "plane.smallest-covered",
            "triangle (1,1) (2,1) (1,2) with one sub-pixel bit: twice its area, and the number of \
             covered pixel centres",
            "1, 1",
            || {
                let triangle = Triangle { xy: [[1, 1], [2, 1], [1, 2]], z: None };
                let covered =
                    (0..4).filter(|n| inside(&triangle, [2 * (n % 2) + 1, 2 * (n / 2) + 1]));
                format!("{}, {}", triangle.area2(), covered.count())
            },
        ),
    ]
}

/// Whether a normalised triangle covers a lattice point, by biased edge functions.
pub(super) fn inside(triangle: &Triangle, [x, y]: [i128; 2]) -> bool {
    triangle.area2() != 0
        && edges(&triangle.normalised()).iter().all(|edge| edge.at(x, y) + top_left_bias(edge) >= 0)
}

fn lattice(side: i128) -> impl Iterator<Item = [i128; 2]> + Clone {
    (0..side * side).map(move |n| [n % side, n / side])
}

/// Every ordered pair of points of a `side` by `side` lattice.
fn pairs(side: i128) -> impl Iterator<Item = ([i128; 2], [i128; 2])> {
    lattice(side).flat_map(move |a| lattice(side).map(move |b| (a, b)))
}

fn low_bits_differ() -> usize {
    pairs(17)
        .filter(|(from, to)| {
            let edge = EdgeCoefficients::between(*from, *to);
            let low = |n: i128| edge.at(4 * (n % 4) + 2, 4 * (n / 4) + 2) & 3;
            (1..16).any(|n| low(n) != low(0))
        })
        .count()
}

/// Every ordered triple of points of a `side` by `side` lattice.
fn lattice_triangles(side: i128) -> impl Iterator<Item = [[i128; 2]; 3]> {
    lattice(side)
        .flat_map(move |a| lattice(side).flat_map(move |b| lattice(side).map(move |c| [a, b, c])))
}

fn differences(xy: [[i128; 2]; 3]) -> usize {
    let triangle = Triangle { xy, z: None };
    lattice(4).filter(|p| inside(&triangle, *p) != covers(xy, *p, Rule::TopLeft)).count()
}

fn smallest_areas() -> String {
    let area = |xy: [[i128; 2]; 3]| Triangle { xy, z: None }.area2();
    let positive = || lattice_triangles(4).filter(|xy| area(*xy) > 0);
    let strict =
        positive().filter(|xy| lattice(4).any(|p| classify(*xy, p) == Position::Inside)).map(area);
    let covered = positive()
        .filter(|xy| lattice(4).any(|p| inside(&Triangle { xy: *xy, z: None }, p)))
        .map(area);
    format!("{}, {}", strict.min().unwrap_or(0), covered.min().unwrap_or(0))
}

/// Samples whose stored, walked word has the wrong sign, in 2k+s+1-`less` bits.
fn wrong_walks(k: u32, s: u32, less: u32, count_all: bool) -> usize {
    let width = RunTime::new(2 * k + s + 1 - less).unwrap_or_else(|error| unreachable!("{error}"));
    let (half, side) = (1 << (s - 1), 1 << (k + s));
    let mut wrong = 0;
    for (from, to) in pairs(side + 1) {
        let edge = EdgeCoefficients::between(from, to);
        let bias = top_left_bias(&edge);
        let word = |value| Word::wrapping(width, value);
        // A step of one pixel changes E by a 2^s, the stored word by a.
        let start = word(Rounding::Floor.shift_right(edge.at(half, half) + bias, s).0);
        let plane = Planar::try_new(start, word(edge.a), word(edge.b))
            .unwrap_or_else(|error| unreachable!("words of one width: {error}"));
        for y in 0..1 << k {
            for x in 0..1 << k {
                let exact = edge.at((x << s) + half, (y << s) + half) + bias;
                wrong += usize::from((plane.at(x, y).to_i128() >= 0) != (exact >= 0));
            }
        }
        if wrong > 0 && !count_all {
            return wrong;
        }
    }
    wrong
}

fn any_sample() -> String {
    let toys = [(1, 1), (1, 2), (2, 1)];
    let widths = [true, false].map(|bias| {
        let stored = |edge: &EdgeCoefficients, e: i128, s: u32| {
            let biased = if bias { e + top_left_bias(edge) } else { e };
            Rounding::Floor.shift_right(biased, s).0
        };
        let mut list: Vec<String> = toys
            .iter()
            .map(|(k, s)| {
                let side = 1i128 << (k + s);
                let values = pairs(side + 1).flat_map(|(a, b)| {
                    let edge = EdgeCoefficients::between(a, b);
                    lattice(side).map(move |[x, y]| stored(&edge, edge.at(x, y), *s))
                });
                signed_bits(values).to_string()
            })
            .collect();
        let vertices = Area::square(0, 1 << 22);
        let samples = Area::square(0, (1 << 22) - 1);
        let corners = at_corners(vertices, samples).map(|(edge, e)| stored(&edge, e, 10));
        list.push(signed_bits(corners).to_string());
        list.join(", ")
    });
    format!("biased {}; unbiased {}", widths[0], widths[1])
}
