//! The set-up words of a triangle as polynomials of its vertices: the spec's clauses, read once more.

use super::polynomial::{Algebra, Polynomial};
use crate::vector::package::SetupParameters;
use crate::vector::write::Devices;

/// A vertex.
pub(super) struct Vertex {
    pub(super) x: Polynomial,
    pub(super) y: Polynomial,
    pub(super) z: Polynomial,
}

/// What an output has to be.
pub(super) struct Want {
    pub(super) name: &'static str,
    pub(super) value: Polynomial,
    pub(super) range: Range,
}

/// What a triangle's words have to be.
pub(super) struct Wants {
    /// 1 where there is an area.
    pub(super) live: Polynomial,
    pub(super) words: Vec<Want>,
}

/// How many bits a port of it needs.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Range {
    /// A word of the profile: a pattern of so many bits.
    Word(u32),
    /// A number that must fit: one that is not below zero, or one in two's complement. It is looked at where the
    /// triangle has an area.
    Unsigned,
    Signed,
}

/// Clauses T-1, T-3, E-1 to E-4, C-2 to C-4, P-2.
pub(super) fn clauses(algebra: &mut Algebra, devices: &Devices, vertices: [Vertex; 3]) -> Wants {
    let Devices { setup, edge, .. } = devices;
    let [v0, v1, v2] = vertices;
    let area2 = determinant(algebra, [&v0, &v1, &v2]);
    let turned = algebra.negative(&area2);
    let none = algebra.zero(&area2);
    let live = &Polynomial::constant(1) - &none;
    let either = |algebra: &Algebra, here: &Polynomial, there: &Polynomial| {
        here + &algebra.product(&turned, &(there - here))
    };
    let exchanged = |algebra: &Algebra, here: &Vertex, there: &Vertex| Vertex {
        x: either(algebra, &here.x, &there.x),
        y: either(algebra, &here.y, &there.y),
        z: either(algebra, &here.z, &there.z),
    };
    let b = exchanged(algebra, &v1, &v2);
    let c = exchanged(algebra, &v2, &v1);
    let a = v0;
    let area = either(algebra, &area2, &-&area2);
    let mut list = Vec::new();
    let names = [
        ["edge0_init", "edge0_dx", "edge0_dy"],
        ["edge1_init", "edge1_dx", "edge1_dy"],
        ["edge2_init", "edge2_dx", "edge2_dy"],
    ];
    for (names, [from, to]) in names.into_iter().zip([[&a, &b], [&b, &c], [&c, &a]]) {
        let start = edge_start(algebra, setup, from, to);
        let start = algebra.bits(&start, setup.shift, edge.width);
        let up = setup.sub_pixel - setup.shift;
        let steps = [(&from.y - &to.y).shifted(up), (&to.x - &from.x).shifted(up)];
        let [dx, dy] = steps;
        for (name, value) in names.into_iter().zip([start, dx, dy]) {
            let value = algebra.product(&live, &value);
            list.push(Want { name, value, range: Range::Word(edge.width) });
        }
    }
    list.push(Want { name: "zero_area", value: none, range: Range::Word(1) });
    let [xb, yb, zb] = [&b.x - &a.x, &b.y - &a.y, &b.z - &a.z];
    let [xc, yc, zc] = [&c.x - &a.x, &c.y - &a.y, &c.z - &a.z];
    let x = &algebra.product(&zb, &yc) - &algebra.product(&zc, &yb);
    let y = &algebra.product(&xb, &zc) - &algebra.product(&xc, &zb);
    let [to_x, to_y] = setup.sample.map(Polynomial::constant);
    let start = &(&algebra.product(&a.z, &area) + &algebra.product(&x, &(&to_x - &a.x)))
        + &algebra.product(&y, &(&to_y - &a.y));
    for (name, value, range) in [
        ("area", area, Range::Unsigned),
        ("plane_x", x, Range::Signed),
        ("plane_y", y, Range::Signed),
        ("plane_start", start, Range::Signed),
    ] {
        list.push(Want { name, value: algebra.product(&live, &value), range });
    }
    Wants { live, words: list }
}

/// Twice the signed area (T-1).
fn determinant(algebra: &Algebra, [v0, v1, v2]: [&Vertex; 3]) -> Polynomial {
    &algebra.product(&(&v1.x - &v0.x), &(&v2.y - &v0.y))
        - &algebra.product(&(&v2.x - &v0.x), &(&v1.y - &v0.y))
}

/// An edge at the sample of pixel (0, 0), less one unless it owns its samples (E-1, C-2 to C-4).
fn edge_start(
    algebra: &mut Algebra,
    setup: &SetupParameters,
    from: &Vertex,
    to: &Vertex,
) -> Polynomial {
    let [x, y] = [&to.x - &from.x, &to.y - &from.y];
    let side = if setup.shadow { algebra.negative(&-&y) } else { algebra.negative(&y) };
    let level = algebra.zero(&y);
    let right = algebra.negative(&-&x);
    let owns = &side + &algebra.product(&level, &right);
    let [at_x, at_y] = setup.sample.map(Polynomial::constant);
    let value = &algebra.product(&x, &(&at_y - &from.y)) - &algebra.product(&y, &(&at_x - &from.x));
    &(&value + &owns) - &Polynomial::constant(1)
}
