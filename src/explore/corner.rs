//! The extremes of an edge function over boxes, from their corners. Spec clause `B-2`.
//!
//! E is linear in each of the six coordinates of its two vertices and its sample, so its extremes
//! over boxes lie at box corners: 4 x 4 x 4 evaluations settle a width of any size.

use crate::bits::Rounding;
use crate::cover::FillRule;
use crate::setup::EdgeCoefficients;

/// A box of coordinates in sub-pixels, closed on all sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) low: [i128; 2],
    pub(super) high: [i128; 2],
}

impl Area {
    /// The same interval on both axes.
    #[cfg(feature = "laboratory")]
    pub(super) const fn square(low: i128, high: i128) -> Self {
        Self { low: [low; 2], high: [high; 2] }
    }

    /// A box of one point.
    pub(super) const fn point(at: [i128; 2]) -> Self {
        Self { low: at, high: at }
    }

    pub(super) fn corners(self) -> [[i128; 2]; 4] {
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        [[x0, y0], [x1, y0], [x0, y1], [x1, y1]]
    }

    /// Whether a point lies in the box.
    pub(super) fn holds(self, at: [i128; 2]) -> bool {
        (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&at[axis]))
    }
}

/// The bias of a fill rule for an edge: -1 unless it owns its samples.
pub(super) fn bias(rule: FillRule, edge: &EdgeCoefficients) -> i128 {
    -i128::from(!rule.owns(edge.direction()))
}

/// The bias of the top-left rule.
#[cfg(feature = "laboratory")]
pub(super) fn top_left_bias(edge: &EdgeCoefficients) -> i128 {
    bias(FillRule::TopLeft, edge)
}

/// Every edge between corners of the box.
pub(super) fn edges_at_corners(
    vertices: Area,
) -> impl Iterator<Item = ([[i128; 2]; 2], EdgeCoefficients)> {
    vertices.corners().into_iter().flat_map(move |from| {
        let between = move |to| ([from, to], EdgeCoefficients::between(from, to));
        vertices.corners().into_iter().map(between)
    })
}

/// Every (edge, E at a sample) over the corners of both boxes.
pub(super) fn at_corners(
    vertices: Area,
    samples: Area,
) -> impl Iterator<Item = (EdgeCoefficients, i128)> {
    edges_at_corners(vertices)
        .flat_map(move |(_, edge)| samples.corners().map(move |[x, y]| (edge, edge.at(x, y))))
}

/// The smallest two's complement width that holds every value.
pub(super) fn signed_bits(values: impl IntoIterator<Item = i128>) -> u32 {
    // A negative value needs as many bits as its complement; one more is the sign.
    let magnitude = values.into_iter().fold(0, |seen: i128, v| seen | (v ^ (v >> 127)));
    i128::BITS - magnitude.leading_zeros() + 1
}

/// Bits of the biased E and of the same without its low `s` bits. Spec clause `C-4`.
pub(super) fn widths(vertices: Area, samples: Area, s: u32, rule: FillRule) -> (u32, u32) {
    let values: Vec<i128> =
        at_corners(vertices, samples).map(|(edge, e)| e + bias(rule, &edge)).collect();
    let stored = values.iter().map(|e| Rounding::Floor.shift_right(*e, s).0);
    (signed_bits(values.iter().copied()), signed_bits(stored))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_of_small_ranges() {
        assert_eq!(signed_bits([0]), 1);
        assert_eq!(signed_bits([-1]), 1);
        assert_eq!(signed_bits([1]), 2);
        assert_eq!(signed_bits([-8, 7]), 4);
        assert_eq!(signed_bits([-9]), 5);
        assert_eq!(signed_bits([8]), 5);
    }
}
