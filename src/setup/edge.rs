//! Exact edge functions. Spec clauses `E-1` to `E-4`.

use super::triangle::Triangle;

/// `E(p) = a x + b y + c`, exact, p in sub-pixels, E in sub-pixels squared; inside is positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeCoefficients {
    /// Change of E per sub-pixel to the right.
    pub a: i128,
    /// Change of E per sub-pixel downward.
    pub b: i128,
    /// E at the window origin.
    pub c: i128,
}

impl EdgeCoefficients {
    /// The edge from `from` to `to`: `E(p) = cross(to - from, p - from)`.
    pub fn between(from: [i128; 2], to: [i128; 2]) -> Self {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        Self { a: -dy, b: dx, c: dy * from[0] - dx * from[1] }
    }

    /// E at a point in sub-pixels. Growth: at most (W + G - 1/2)(W + 2G) 4^s over a window of W
    /// pixels with a guard band of G, `2k + 2s + 1` bits for G = 0.
    pub fn at(&self, x: i128, y: i128) -> i128 {
        self.a * x + self.b * y + self.c
    }

    /// The direction of travel along the edge, `[dx, dy]`.
    pub const fn direction(&self) -> [i128; 2] {
        [self.b, -self.a]
    }
}

/// The edges v0v1, v1v2, v2v0 of a normalised triangle.
pub fn edges(triangle: &Triangle) -> [EdgeCoefficients; 3] {
    let v = triangle.xy;
    std::array::from_fn(|k| EdgeCoefficients::between(v[k], v[(k + 1) % 3]))
}
