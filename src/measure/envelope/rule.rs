//! Rules for samples on edges: a sample goes to the triangle that it would be in after a step without length.
//! Spec clause `EN-5`.

use std::fmt;

/// A consistent rule. A sample on an edge belongs to the triangle that it enters by an infinitesimal step `toward`; on
/// an edge along `toward`, by an infinitesimal part of this step `then`. So exactly one of the triangles around a
/// sample has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    /// The direction of the step, y down.
    pub toward: [i128; 2],
    /// The direction of the second step, which is not parallel to it.
    pub then: [i128; 2],
}

impl Rule {
    /// Left edges and horizontal top edges own their samples.
    pub const TOP_LEFT: Self = Self { toward: [1, 0], then: [0, 1] };
    /// Right edges and horizontal top edges.
    pub const TOP_RIGHT: Self = Self { toward: [-1, 0], then: [0, 1] };
    /// Left edges and horizontal bottom edges.
    pub const BOTTOM_LEFT: Self = Self { toward: [1, 0], then: [0, -1] };
    /// Right edges and horizontal bottom edges.
    pub const BOTTOM_RIGHT: Self = Self { toward: [-1, 0], then: [0, -1] };
    /// Those with a name.
    pub const NAMED: [(Self, &'static str); 4] = [
        (Self::TOP_LEFT, "top-left"),
        (Self::TOP_RIGHT, "top-right"),
        (Self::BOTTOM_LEFT, "bottom-left"),
        (Self::BOTTOM_RIGHT, "bottom-right"),
    ];

    /// Whether an edge of a normalised triangle, travelling by `[dx, dy]`, owns its samples.
    ///
    /// ```
    /// use guardbit::measure::envelope::Rule;
    /// use guardbit::cover::FillRule;
    /// for d in [[1, 0], [-1, 0], [0, 1], [3, -2], [-5, 7]] {
    ///     assert_eq!(Rule::TOP_LEFT.owns(d), FillRule::TopLeft.owns(d));
    ///     assert_eq!(Rule::TOP_RIGHT.owns(d), FillRule::Shadow.owns(d));
    /// }
    /// ```
    pub const fn owns(&self, direction: [i128; 2]) -> bool {
        let first = change(direction, self.toward);
        first > 0 || (first == 0 && change(direction, self.then) > 0)
    }

    /// Whether it is one with a name.
    pub(super) fn is_named(&self) -> bool {
        Self::NAMED.iter().any(|(rule, _)| rule == self)
    }

    /// Whether a sample on two edges of a triangle belongs to it; the two may be the same.
    pub(super) const fn takes(&self, edges: Edges) -> bool {
        self.owns(edges[0]) && self.owns(edges[1])
    }

    /// Rules of which one stands for each answer that all rules can give for these edges: the ones with names, and
    /// for each edge those that step a little to the one or the other side of it.
    pub(super) fn enough(edges: impl IntoIterator<Item = [i128; 2]>) -> Vec<Self> {
        let mut rules: Vec<Self> = Self::NAMED.map(|(rule, _)| rule).to_vec();
        let mut seen = Vec::new();
        for edge in edges {
            let edge = reduced(edge);
            if seen.contains(&edge) {
                continue;
            }
            seen.push(edge);
            let across = [-edge[1], edge[0]];
            for toward in [edge, negative(edge)] {
                rules.extend([across, negative(across)].map(|then| Self { toward, then }));
            }
        }
        rules
    }
}

/// The directions of the edges that a sample lies on: two at a vertex, else one twice.
pub(super) type Edges = [[i128; 2]; 2];

/// How E changes by a step.
const fn change(edge: [i128; 2], step: [i128; 2]) -> i128 {
    edge[0] * step[1] - edge[1] * step[0]
}

const fn negative([x, y]: [i128; 2]) -> [i128; 2] {
    [-x, -y]
}

/// A direction in lowest terms, the same for both ways along an edge.
fn reduced([x, y]: [i128; 2]) -> [i128; 2] {
    let divisor = num_integer::gcd(x, y).max(1);
    let sign = if x < 0 || (x == 0 && y < 0) { -1 } else { 1 };
    [sign * x / divisor, sign * y / divisor]
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = Self::NAMED.iter().find(|(rule, _)| rule == self) {
            return f.write_str(name);
        }
        let [[x, y], [u, v]] = [self.toward, self.then];
        write!(f, "toward ({x}, {y}) then ({u}, {v})")
    }
}
