//! An edge walked by its x slope: how many fraction bits, and what goes wrong with fewer.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::format::Clamp;
use crate::machine::{EdgeWalkConfig, WalkedEdge};

/// A walk down one edge by the edge-walk machine, beside its exact x.
pub(super) struct Walk {
    pub(super) config: EdgeWalkConfig,
    grid: SampleGrid,
    edge: WalkedEdge,
    /// Exact x in pixels is `(numerator + n step) / denominator` on row `n` of the walk.
    numerator: i128,
    step: i128,
    pub(super) denominator: i128,
}

impl Walk {
    /// The edge between two points with `s` bits below the pixel; `None` where it crosses no row.
    pub(super) fn new(
        ends: [[i128; 2]; 2],
        s: u32,
        fraction: u32,
        rounding: Rounding,
    ) -> Option<Self> {
        // Half sub-pixels: centres are on the grid even for s = 0.
        let [a, b] = ends.map(|p| p.map(|n| 2 * n));
        let [top, bottom] = if a[1] <= b[1] { [a, b] } else { [b, a] };
        let grid = SampleGrid::at([1 << s; 2], s + 1);
        let config =
            EdgeWalkConfig { guard: 1, integer: 12, fraction, rounding, clamp: Clamp::Guard };
        let edge = config.edge(top, bottom, &grid)?;
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        let below_top = grid.position(0, edge.first_row)[1] - top[1];
        Some(Self {
            config,
            grid,
            edge,
            numerator: top[0] * dy + below_top * dx,
            step: dx << (s + 1),
            denominator: dy << (s + 1),
        })
    }

    pub(super) fn rows(&self) -> i128 {
        self.edge.end_row - self.edge.first_row
    }

    /// The walked x on row `n`, in 2^-fraction pixels.
    fn x(&self, n: i128) -> i128 {
        self.edge.start + self.edge.slope * n
    }

    fn pixel(&self, n: i128) -> i128 {
        self.config.pixel(self.x(n), &self.grid)
    }

    /// Whether that is the pixel that the exact x gives: p - 1 < x - 1/2 <= p.
    pub(super) fn right(&self, n: i128) -> bool {
        let twice_x = 2 * (self.numerator + n * self.step);
        let p = self.pixel(n);
        (2 * p - 1) * self.denominator < twice_x && twice_x <= (2 * p + 1) * self.denominator
    }

    /// Walked x minus exact x in pixels, as numerator over `denominator 2^fraction`.
    pub(super) fn error(&self, n: i128) -> i128 {
        let exact = (self.numerator + n * self.step) << self.config.fraction;
        self.x(n) * self.denominator - exact
    }
}

pub(super) fn statements() -> Vec<Statement> {
    vec![
        Statement::exact(
            "walk.exact-fraction",
            "number of fraction bits for exact coverage with floor and ceil(x - 1/2), for every \
             edge of a window of 2^k pixels with s sub-pixel bits; (k,s) = (1,1) is the exception \
             to 2k+2s, and with s = 0 the centres are not on the lattice",
            "(1,1) 3, (1,2) 6, (1,3) 8, (2,1) 6, (2,2) 8, (3,1) 8, (3,2) 10, (4,1) 10, (3,0) 7, \
             (4,0) 9",
            || {
                let sizes = [
                    (1, 1),
                    (1, 2),
                    (1, 3),
                    (2, 1),
                    (2, 2),
                    (3, 1),
                    (3, 2),
                    (4, 1),
                    (3, 0),
                    (4, 0),
                ];
                let texts = sizes.map(|(k, s)| format!("({k},{s}) {}", exact_fraction(k, s)));
                texts.join(", ")
            },
        )
        .slow(),
        Statement::exact(
            "walk.ties",
            "numbers of fraction bits from 0 to 60 for which an edge walk is exact in a window of 8 \
             pixels, s = 1: rounding to nearest / toward zero",
            "none / none",
            || [Rounding::NearestEven, Rounding::TowardZero].map(never_exact).join(" / "),
        ),
        Statement::exact(
            "walk.tie-example",
            "edge (0, 1/2) to (1, 6 1/2), row 3, exact x = 1/2, F = 22, rounding to nearest: \
             accumulator minus 2^21, pixel of the accumulator, correct pixel",
            "1, pixel 1, right 0",
            tie_example,
        ),
        Statement::exact(
            "walk.half-sub-pixel",
            "number of fraction bits that keep every accumulated x within half a sub-pixel, \
             rounding to nearest / floor (s+k and s+k+1), for every edge of these windows; for \
             (1,1), 2 bits are enough with floor",
            "(1,2) 3 / 4, (2,1) 3 / 4, (2,2) 4 / 5, (3,1) 4 / 5, (3,2) 5 / 6, (4,1) 5 / 6",
            || {
                [(1, 2), (2, 1), (2, 2), (3, 1), (3, 2), (4, 1)]
                    .map(|(k, s)| {
                        let [near, floor] = [Rounding::NearestEven, Rounding::Floor]
                            .map(|r| half_fraction(k, s, r));
                        format!("({k},{s}) {near} / {floor}")
                    })
                    .join(", ")
            },
        )
        .slow(),
    ]
}

fn points(k: u32, s: u32) -> impl Iterator<Item = [i128; 2]> + Clone {
    let side = (1 << (k + s)) + 1;
    (0..side * side).map(move |n| [n % side, n / side])
}

/// Every walk down an edge of the closed window.
fn walks(k: u32, s: u32, fraction: u32, rounding: Rounding) -> impl Iterator<Item = Walk> {
    points(k, s).flat_map(move |a| {
        points(k, s)
            .filter(move |b| a[1] < b[1])
            .filter_map(move |b| Walk::new([a, b], s, fraction, rounding))
    })
}

fn is_exact(k: u32, s: u32, fraction: u32, rounding: Rounding) -> bool {
    walks(k, s, fraction, rounding).all(|walk| (0..walk.rows()).all(|n| walk.right(n)))
}

/// Floor approaches the exact x from below as bits are added, so the first that works is the least.
fn exact_fraction(k: u32, s: u32) -> String {
    (0..30)
        .find(|f| is_exact(k, s, *f, Rounding::Floor))
        .map_or("none".to_owned(), |f| f.to_string())
}

fn never_exact(rounding: Rounding) -> String {
    let exact: Vec<String> =
        (0..=60).filter(|f| is_exact(3, 1, *f, rounding)).map(|f| f.to_string()).collect();
    if exact.is_empty() { "none".to_owned() } else { exact.join(" ") }
}

fn half_fraction(k: u32, s: u32, rounding: Rounding) -> String {
    let within = |fraction: &u32| {
        walks(k, s, *fraction, rounding).all(|walk| {
            // A line in n: its extremes are at the ends. Half a sub-pixel is 2^-(s+1) pixels.
            [0, walk.rows() - 1]
                .iter()
                .all(|n| walk.error(*n).abs() << (s + 1) < walk.denominator << walk.config.fraction)
        })
    };
    (0..20).find(within).map_or("none".to_owned(), |f| f.to_string())
}

fn tie_example() -> String {
    Walk::new([[0, 1], [2, 13]], 1, 22, Rounding::NearestEven).map_or(
        "no rows".to_owned(),
        |walk| {
            let n = 3 - walk.edge.first_row;
            let right = (0..2).find(|p| {
                let twice_x = 2 * (walk.numerator + n * walk.step);
                (2 * p - 1) * walk.denominator < twice_x
                    && twice_x <= (2 * p + 1) * walk.denominator
            });
            let right = right.map_or("none".to_owned(), |p| p.to_string());
            format!("{}, pixel {}, right {right}", walk.x(n) - (1 << 21), walk.pixel(n))
        },
    )
}
