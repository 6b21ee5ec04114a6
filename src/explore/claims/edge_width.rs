//! How many bits an exact edge function takes.

use super::statement::Statement;
use crate::bits::Rounding;
use crate::cover::FillRule;
use crate::explore::corner::{Area, at_corners, signed_bits, top_left_bias, widths};
use crate::setup::{EdgeCoefficients, Endless, Source, VertexConfig};

/// A window from `low` to `high` pixels with a guard band, on a grid of `s` sub-pixel bits.
#[derive(Clone, Copy)]
pub(super) struct Case {
    pub(super) low: i128,
    pub(super) high: i128,
    pub(super) guard: i128,
    pub(super) s: u32,
}

impl Case {
    pub(super) fn vertices(self) -> Area {
        Area::square((self.low - self.guard) << self.s, (self.high + self.guard) << self.s)
    }

    pub(super) fn centres(self) -> Area {
        let half = 1 << (self.s - 1);
        Area::square((self.low << self.s) + half, (self.high << self.s) - half)
    }

    /// Bits of the biased E and of the same without its low `s` bits.
    pub(super) fn bits(self) -> (u32, u32) {
        widths(self.vertices(), self.centres(), self.s, FillRule::TopLeft)
    }

    /// The closed form (W + G - 1/2)(W + 2G) 4^s.
    fn formula(self) -> i128 {
        let (w, g) = (self.high - self.low, self.guard);
        ((2 * (w + g) - 1) * (w + 2 * g)) << (2 * self.s - 1)
    }
}

/// A window at the origin.
pub(super) const fn window(w: i128, guard: i128, s: u32) -> Case {
    Case { low: 0, high: w, guard, s }
}

const TABLE: [(&str, &str, Case, &str); 11] = [
    ("4096-s10", "4096 wide, s = 10, no guard band", window(4096, 0, 10), "45 / 35"),
    ("4096-s10-g2048", "4096 wide, s = 10, guard band 2048", window(4096, 2048, 10), "47 / 37"),
    ("4096-s10-g4096", "4096 wide, s = 10, guard band 4096", window(4096, 4096, 10), "48 / 38"),
    ("4096-s8", "4096 wide, s = 8", window(4096, 0, 8), "41 / 33"),
    (
        "d3d",
        "Direct3D's -32768 to 32768, s = 8",
        Case { low: -32768, high: 32768, guard: 0, s: 8 },
        "49 / 41",
    ),
    ("16k", "-16384 to 16384, s = 8", Case { low: -16384, high: 16384, guard: 0, s: 8 }, "47 / 39"),
    ("2048-s8", "2048 wide, s = 8", window(2048, 0, 8), "39 / 31"),
    ("8192-s4", "8192 wide, s = 4", window(8192, 0, 4), "35 / 31"),
    ("1024-s4", "1024 wide, s = 4, by 2k+2s+1 and 2k+s+1", window(1024, 0, 4), "29 / 25"),
    ("2048-s9", "2048 wide, s = 9, the largest s in 32 bits", window(2048, 0, 9), "41 / 32"),
    ("8192-s5", "8192 wide, s = 5, the largest s in 32 bits", window(8192, 0, 5), "37 / 32"),
];

pub(super) fn statements() -> Vec<Statement> {
    let mut list: Vec<Statement> = TABLE
        .into_iter()
        .map(|(name, place, case, expected)| {
            Statement::exact(
                format!("edge.width.{name}"),
                format!(
                    "bits of the biased edge function, full / stored without its low s bits: \
                    {place}; the edge function at all 64 box corners, samples at centres"
                ),
                expected,
                move || {
                    let (full, stored) = case.bits();
                    format!("{full} / {stored}")
                },
            )
        })
        .collect();
    list.extend([
        Statement::exact(
            "edge.maximum",
            "the maximum of |E| over a window W with guard band G is (W + G - 1/2)(W + 2G) 4^s; \
             number of cases where the corners and the formula differ, for W = 2 to 8192, G = 0, \
             W/2, W, 5W, s = 1 to 10",
            "0",
            || {
                cases()
                    .filter(|case| {
                        let corners = at_corners(case.vertices(), case.centres());
                        corners.map(|(_, e)| e.abs()).max() != Some(case.formula())
                    })
                    .count()
            },
        ),
        Statement::exact(
            "edge.coefficients",
            "bits of A and B for k = 12, s = 10 with half-open / closed vertices (k+s+1 and k+s+2), \
             first from real edges, then from the vertex field",
            "23 / 24, 23 / 24",
            || {
                let real = [(1 << 22) - 1, 1 << 22].map(|high| {
                    let edges = at_corners(Area::square(0, high), Area::square(0, 0));
                    signed_bits(edges.flat_map(|(edge, _)| [edge.a, edge.b]))
                });
                let field = [false, true].map(|closed| sgi_field(closed).difference_bits());
                format!("{} / {}, {} / {}", real[0], real[1], field[0], field[1])
            },
        ),
        Statement::exact(
            "edge.constant",
            "the maximum of |C| is (W + G)(W + 2G) 4^s if C is taken at the corner of the window, \
             and (W + 2G)^2 / 2 4^s at its centre; number of mismatches for W = 2 to 8192, G = 0, \
             W/2, W, 5W, s = 1 to 10",
            "0",
            || cases().filter(|case| !constant_agrees(*case)).count(),
        ),
        Statement::exact(
            "edge.twice-plus-one",
            "an edge function of unsigned p-bit coordinates needs 2p + 1 bits, not 2p + 2; tested \
             for every vertex pair and sample for p = 2, 3, and for the box corners for p = 4 to 24",
            "2p+1 for p = 2 to 24",
            twice_plus_one,
        ),
    ]);
    list
}

fn cases() -> impl Iterator<Item = Case> {
    (1..=13).flat_map(|k| {
        let w = 1 << k;
        [0, w / 2, w, 5 * w]
            .into_iter()
            .flat_map(move |guard| (1..=10).map(move |s| window(w, guard, s)))
    })
}

fn sgi_field(closed: bool) -> VertexConfig {
    VertexConfig {
        integer: 12,
        sub_pixel: 10,
        signed: false,
        closed,
        snap: Rounding::NearestEven,
        source: Source::F64,
        endless: Endless::Refuse,
        lattice: None,
    }
}

fn constant_agrees(case: Case) -> bool {
    let (w, g, scale) = (case.high, case.guard, 1 << (2 * case.s));
    let largest =
        |at: i128| at_corners(case.vertices(), Area::square(at, at)).map(|(_, e)| e.abs()).max();
    let middle = (w << case.s) / 2;
    largest(0) == Some((w + g) * (w + 2 * g) * scale)
        && largest(middle) == Some((w + 2 * g) * (w + 2 * g) * scale / 2)
}

fn twice_plus_one() -> String {
    let wrong = (2..=24_u32).find(|p| {
        let square = Area::square(0, (1 << p) - 1);
        let bits = if *p <= 3 {
            signed_bits(everywhere(square))
        } else {
            signed_bits(at_corners(square, square).map(|(edge, e)| e + top_left_bias(&edge)))
        };
        bits != 2 * p + 1
    });
    wrong.map_or("2p+1 for p = 2 to 24".to_owned(), |p| format!("not at p = {p}"))
}

/// The biased E of every vertex pair and sample of a square.
fn everywhere(square: Area) -> impl Iterator<Item = i128> {
    let points = move || {
        (square.low[1]..=square.high[1])
            .flat_map(move |y| (square.low[0]..=square.high[0]).map(move |x| [x, y]))
    };
    points().flat_map(move |from| {
        points().flat_map(move |to| {
            let edge = EdgeCoefficients::between(from, to);
            points().map(move |[x, y]| edge.at(x, y) + top_left_bias(&edge))
        })
    })
}
