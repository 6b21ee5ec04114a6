//! A plain set-up unit as hardware has it, over a [`Path`]: an exchange of two vertices, edge
//! functions, a gradient, and three quotients divided bit by bit. Clauses `T-3`, `E-1` to `E-4`, `P-2`,
//! `P-3` and `R-1`.

mod plane;

use super::fault::{Operator, Path, Relation, low_ones, sign_extend};
use crate::cover::{EdgeStorage, EdgeWordConfig, SampleGrid};
use crate::format::Column;
use crate::setup::Triangle;
use crate::value::Depth;

/// A set-up unit.
pub(super) struct Unit<'a> {
    pub(super) edge: EdgeWordConfig,
    pub(super) depth: &'a Depth,
    pub(super) grid: SampleGrid,
    /// Bits of a coordinate, and whether it has a sign.
    pub(super) coordinate: u32,
    pub(super) signed: bool,
    /// The columns that it answers.
    pub(super) columns: &'a [Column],
}

/// What the three uses of a part are called.
type Three = [&'static str; 3];

const VERTEX_X: Three = ["v0_x", "v1_x", "v2_x"];
const VERTEX_Y: Three = ["v0_y", "v1_y", "v2_y"];
const VERTEX_Z: Three = ["v0_z", "v1_z", "v2_z"];
const ABOVE_Z: Three = ["the bit above v0_z", "the bit above v1_z", "the bit above v2_z"];
const EDGE_FROM_X: Three =
    ["x that edge 0 begins at", "x that edge 1 begins at", "x that edge 2 begins at"];
const EDGE_FROM_Y: Three =
    ["y that edge 0 begins at", "y that edge 1 begins at", "y that edge 2 begins at"];
const EDGE_TO_X: Three =
    ["x that edge 0 ends at", "x that edge 1 ends at", "x that edge 2 ends at"];
const EDGE_TO_Y: Three =
    ["y that edge 0 ends at", "y that edge 1 ends at", "y that edge 2 ends at"];
const STEP_A: Three = ["step a of edge 0", "step a of edge 1", "step a of edge 2"];
const STEP_B: Three = ["step b of edge 0", "step b of edge 1", "step b of edge 2"];
const OUTPUTS: [&str; 12] = [
    "output edge0_init",
    "output edge0_dx",
    "output edge0_dy",
    "output edge1_init",
    "output edge1_dx",
    "output edge1_dy",
    "output edge2_init",
    "output edge2_dx",
    "output edge2_dy",
    "output depth_init",
    "output depth_dx",
    "output depth_dy",
];

const VERTICES: Three = ["the first vertex's", "the second vertex's", "the third vertex's"];

/// The two vertices beside one.
fn others(own: usize) -> [usize; 2] {
    [(own + 1) % 3, (own + 2) % 3]
}

/// The difference of two vertices in one coordinate; either may be that of another vertex, or another
/// coordinate.
fn difference(
    path: &Path,
    [name, first, second]: [&'static str; 3],
    v: [i128; 3],
    [from, less]: [usize; 2],
    other: i128,
    width: u32,
) -> i128 {
    let near = |own: usize| {
        let [a, b] = others(own).map(|n| (VERTICES[n], v[n]));
        [a, b, ("another coordinate", other), ("zero", 0)]
    };
    let a = path.only(first, (VERTICES[from], v[from]), near(from));
    let b = path.only(second, (VERTICES[less], v[less]), near(less));
    path.sum(name, Operator::Subtract, [a, b], width)
}

/// A determinant: the first two factors' product less that of the others.
fn determinant(
    path: &Path,
    [name, first, second]: [&'static str; 3],
    [a, b, c, d]: [i128; 4],
    width: u32,
) -> i128 {
    let products = [path.product(first, a, b), path.product(second, c, d)];
    path.sum(name, Operator::Subtract, products, width)
}

impl Unit<'_> {
    /// Its words and the flag of no area.
    pub(super) fn words(&self, path: &Path, triangle: &Triangle, z: [i128; 3]) -> Vec<i128> {
        path.within("triangle_setup", || self.set_up(path, triangle, z))
    }

    fn set_up(&self, path: &Path, triangle: &Triangle, z: [i128; 3]) -> Vec<i128> {
        let bits = self.coordinate;
        let signed = path.when("coordinates have a sign", self.signed);
        let extended = |value| {
            if signed { sign_extend(value, bits) } else { value & low_ones(bits) }
        };
        let coordinate = |name: &'static str, value| path.signed(name, extended(value), bits + 1);
        let depth_bits = self.depth.read_out().integer();
        let taken: [[i128; 3]; 3] = [
            [0, 1, 2].map(|k| coordinate(VERTEX_X[k], triangle.xy[k][0])),
            [0, 1, 2].map(|k| coordinate(VERTEX_Y[k], triangle.xy[k][1])),
            [0, 1, 2].map(|k| {
                let above = path.only(ABOVE_Z[k], ("zero", 0), [("one", 1i128)]);
                path.word(VERTEX_Z[k], z[k], depth_bits) - (above << depth_bits)
            }),
        ];
        let held: [(&'static str, i128); 9] = std::array::from_fn(|n| {
            ([VERTEX_X, VERTEX_Y, VERTEX_Z][n / 3][n % 3], taken[n / 3][n % 3])
        });
        let holds = |n: usize| path.choose("which part of a vertex is held", n, held);
        let [mut x, mut y, mut z] = [0, 3, 6].map(|n| [holds(n), holds(n + 1), holds(n + 2)]);
        let side = |names: [&'static str; 3], v: [i128; 3], from: usize, other: i128| {
            difference(path, names, v, [from, 0], other, bits + 2)
        };
        let x01 = side(["x1 - x0", "x1 in x1 - x0", "x0 in x1 - x0"], x, 1, y[1]);
        let y01 = side(["y1 - y0", "y1 in y1 - y0", "y0 in y1 - y0"], y, 1, x[1]);
        let x02 = side(["x2 - x0", "x2 in x2 - x0", "x0 in x2 - x0"], x, 2, y[2]);
        let y02 = side(["y2 - y0", "y2 in y2 - y0", "y0 in y2 - y0"], y, 2, x[2]);
        let names = ["twice the area", "(x1 - x0) (y2 - y0)", "(x2 - x0) (y1 - y0)"];
        let area2 = determinant(path, names, [x01, y02, x02, y01], 2 * bits + 4);
        let turned = path.compare("negative area", area2, Relation::Less, 0);
        let area = path.choose(
            "magnitude of the area",
            usize::from(turned),
            [("the area", area2), ("minus the area", area2.wrapping_neg())],
        );
        let zero = path.compare("no area", area2, Relation::Equal, 0);
        // The exchange can leave out a part of the vertices.
        let [turns_x, turns_y, turns_z] = [
            "the exchange of two vertices takes x along",
            "the exchange of two vertices takes y along",
            "the exchange of two vertices takes z along",
        ]
        .map(|name| path.when(name, turned));
        let exchanged = |turned, name, v: [i128; 3], second: bool| {
            let own = ("vertex 1", v[1]);
            let other = ("vertex 2", v[2]);
            let operands = if second { [other, own] } else { [own, other] };
            path.choose(name, usize::from(turned), operands)
        };
        x = [
            x[0],
            exchanged(turns_x, "x of the second vertex after the exchange", x, false),
            exchanged(turns_x, "x of the third vertex after the exchange", x, true),
        ];
        y = [
            y[0],
            exchanged(turns_y, "y of the second vertex after the exchange", y, false),
            exchanged(turns_y, "y of the third vertex after the exchange", y, true),
        ];
        z = [
            z[0],
            exchanged(turns_z, "z of the second vertex after the exchange", z, false),
            exchanged(turns_z, "z of the third vertex after the exchange", z, true),
        ];
        let mut words = Vec::new();
        for k in 0..3 {
            words.extend(self.edge(path, k, [x, y]));
        }
        words.extend(self.plane(path, [x, y, z], area));
        let live = !path.when("words of a triangle without area are zero", zero);
        for ((word, name), column) in words.iter_mut().zip(OUTPUTS).zip(self.columns) {
            *word = path.signed(name, if live { *word } else { 0 }, column.width);
        }
        // One output in the place of another.
        let swaps = [
            ("columns of edge 0", [0, 1, 2]),
            ("columns of edge 1", [3, 4, 5]),
            ("columns of edge 2", [6, 7, 8]),
            ("columns of the plane", [9, 10, 11]),
        ];
        for (name, at) in swaps {
            let operands = [("init", words[at[0]]), ("dx", words[at[1]]), ("dy", words[at[2]])];
            for (pick, place) in at.into_iter().enumerate() {
                words[place] = path.choose(name, pick, operands);
            }
        }
        words.push(path.choose("output zero_area", usize::from(zero), [("0", 0), ("1", 1)]));
        words
    }

    /// An edge function at the sample of pixel (0, 0), and its steps.
    fn edge(&self, path: &Path, k: usize, [x, y]: [[i128; 3]; 2]) -> [i128; 3] {
        let end = |name, v: [i128; 3], own: usize| {
            let near = others(own).map(|n| (VERTICES[n], v[n]));
            path.only(name, (VERTICES[own], v[own]), near)
        };
        let next = (k + 1) % 3;
        let (fx, fy) = (end(EDGE_FROM_X[k], x, k), end(EDGE_FROM_Y[k], y, k));
        let (tx, ty) = (end(EDGE_TO_X[k], x, next), end(EDGE_TO_Y[k], y, next));
        let bits = self.coordinate + 2;
        let minus = |name, a, b| path.sum(name, Operator::Subtract, [a, b], bits);
        let (ex, ey) =
            (minus("ex = tx - fx of an edge", tx, fx), minus("ey = ty - fy of an edge", ty, fy));
        // Two conditions and what they meet: a left edge, or a horizontal one on top.
        let left = match self.edge.rule {
            crate::cover::FillRule::TopLeft => path.compare("left edge: ey", ey, Relation::Less, 0),
            crate::cover::FillRule::Shadow => {
                path.compare("owning side: ey", ey, Relation::Greater, 0)
            }
        };
        let level = path.compare("horizontal edge: ey", ey, Relation::Equal, 0);
        let top = path.compare("top edge: ex", ex, Relation::Greater, 0);
        let top = path.all("top edge (horizontal, ex > 0)", [level, top]);
        let owns = path.when("an edge owns its samples as a left edge", left)
            || path.when("an edge owns its samples as a top edge", top);
        let owns = path.when("an edge owns its samples", owns);
        let bias = path.choose("bias of an edge", usize::from(owns), [("one", 1), ("none", 0)]);
        let [sx, sy] = self.grid.offset;
        let (sx, sy) = (
            path.number("x of the sample in the edge function", sx),
            path.number("y of the sample in the edge function", sy),
        );
        let down = minus("sample y - fy of an edge", sy, fy);
        let across = minus("sample x - fx of an edge", sx, fx);
        let names = ["the edge function", "ex (sample y - fy)", "ey (sample x - fx)"];
        let value = determinant(path, names, [ex, down, ey, across], 2 * bits);
        let value =
            path.sum("the bias of an edge function", Operator::Subtract, [value, bias], 2 * bits);
        let (shift, scale) = match self.edge.storage {
            EdgeStorage::Full => (0, self.grid.sub_pixel),
            EdgeStorage::Shifted => (self.grid.sub_pixel, 0),
        };
        let shift = path.number("low bits of an edge value that are dropped", shift.into());
        let a = path.sum("step a = fy - ty of an edge", Operator::Subtract, [fy, ty], bits);
        let b = path.sum("step b = tx - fx of an edge", Operator::Subtract, [tx, fx], bits);
        let (own_a, own_b) = (("fy - ty", a), ("tx - fx", b));
        let a = path.only(STEP_A[k], own_a, [own_b, ("ty - fy", a.wrapping_neg())]);
        let b = path.only(STEP_B[k], own_b, [own_a, ("fx - tx", b.wrapping_neg())]);
        let steps = [("a", a), ("b", b)];
        let [a, b] = [0, 1].map(|pick| path.choose("steps a and b of every edge", pick, steps));
        let low = shift.clamp(0, 100);
        // The bias belongs before the shift (clause `C-4`).
        let early = ((value + bias) >> low) - bias;
        let near = [("after the shift", early)];
        let value = path.only("the bias of an edge word", ("before the shift", value >> low), near);
        [value, a << scale, b << scale]
    }
}
