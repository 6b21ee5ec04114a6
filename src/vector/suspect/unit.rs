//! A plain set-up unit with a slip: edge functions and an exact quotient, divided bit by bit.

use crate::cover::{EdgeStorage, EdgeWordConfig, SampleGrid};
use crate::setup::{EdgeCoefficients, Gradient, Triangle};
use crate::value::Depth;
use std::cmp::Ordering;

/// A defect of a set-up unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SetupSlip {
    SignLost,
    OneBitShort,
    StrictFit,
    TiesToOdd,
    NoBias,
    AlwaysBias,
    BottomOwns,
    Unturned,
    SlopesSwapped,
    StepsSwapped,
    StepSignA,
    StepSignB,
    ZeroAreaWords,
    SlopesShort,
}

impl SetupSlip {
    pub(super) const ALL: [(Self, &'static str); 14] = [
        (Self::SignLost, "quotients lose their sign"),
        (Self::OneBitShort, "the divider stops one bit early"),
        (
            Self::StrictFit,
            "the divider subtracts only if the remainder is strictly above the divisor: exact quotients are one too small before rounding",
        ),
        (Self::TiesToOdd, "in division, ties go to the odd neighbour"),
        (Self::NoBias, "no bias: edges own their samples on both sides"),
        (Self::AlwaysBias, "every edge is biased: no edge owns its samples"),
        (Self::BottomOwns, "horizontal edges: bottom edges own instead of top edges"),
        (
            Self::Unturned,
            "triangles of negative area are not reversed, and their area loses its sign",
        ),
        (Self::SlopesSwapped, "dz/dx and dz/dy are swapped"),
        (Self::StepsSwapped, "edge steps a and b are swapped"),
        (Self::StepSignA, "edge steps a have the wrong sign"),
        (Self::StepSignB, "edge steps b have the wrong sign"),
        (Self::ZeroAreaWords, "a triangle of no area keeps its edge words"),
        (Self::SlopesShort, "slopes have one interpolation bit too few"),
    ];
}

/// A set-up unit with a slip.
pub(super) struct Unit<'a> {
    pub(super) slip: SetupSlip,
    pub(super) edge: EdgeWordConfig,
    pub(super) depth: &'a Depth,
    pub(super) grid: SampleGrid,
}

impl Unit<'_> {
    /// Its words, unreduced, and the flag of no area.
    pub(super) fn words(&self, triangle: &Triangle, z: [i128; 3]) -> Vec<i128> {
        let (mut xy, mut z) = (triangle.xy, z);
        let area2 = triangle.area2();
        if area2 < 0 && self.slip != SetupSlip::Unturned {
            xy.swap(1, 2);
            z.swap(1, 2);
        }
        let mut words = Vec::new();
        for k in 0..3 {
            words.extend(self.edge(xy[k], xy[(k + 1) % 3]));
        }
        words.extend(if area2 == 0 { [0; 3] } else { self.plane(xy, z, area2.abs()) });
        if area2 == 0 && self.slip != SetupSlip::ZeroAreaWords {
            words.fill(0);
        }
        words.push(i128::from(area2 == 0));
        words
    }

    fn edge(&self, from: [i128; 2], to: [i128; 2]) -> [i128; 3] {
        let edge = EdgeCoefficients::between(from, to);
        let [ex, ey] = edge.direction();
        let owns = match self.slip {
            SetupSlip::NoBias => true,
            SetupSlip::AlwaysBias => false,
            // A horizontal edge turned round.
            SetupSlip::BottomOwns if ey == 0 => self.edge.rule.owns([-ex, ey]),
            _ => self.edge.rule.owns([ex, ey]),
        };
        let [x, y] = self.grid.offset;
        let value = edge.at(x, y) - i128::from(!owns);
        let (shift, scale) = match self.edge.storage {
            EdgeStorage::Full => (0, self.grid.sub_pixel),
            EdgeStorage::Shifted => (self.grid.sub_pixel, 0),
        };
        let (a, b) = (edge.a << scale, edge.b << scale);
        let (a, b) = match self.slip {
            SetupSlip::StepsSwapped => (b, a),
            SetupSlip::StepSignA => (-a, b),
            SetupSlip::StepSignB => (a, -b),
            _ => (a, b),
        };
        [value >> shift, a, b]
    }

    fn plane(&self, xy: [[i128; 2]; 3], z: [i128; 3], area2: i128) -> [i128; 3] {
        let gradient = Gradient::new(&Triangle { xy, z: Some(z) }, z);
        let ([x0, y0], z0) = gradient.anchor;
        let [x, y] = self.grid.offset;
        let start = z0 * area2 + gradient.x * (x - x0) + gradient.y * (y - y0);
        let fraction = self.depth.read_out().fraction();
        let short = u32::from(self.slip == SetupSlip::SlopesShort);
        let scale = (self.grid.sub_pixel + fraction).saturating_sub(short);
        let start = self.divide(start << fraction, area2) + self.depth.start_bias();
        let slope = |numerator: i128| self.divide(numerator << scale, area2);
        let (dx, dy) = (slope(gradient.x), slope(gradient.y));
        if self.slip == SetupSlip::SlopesSwapped { [start, dy, dx] } else { [start, dx, dy] }
    }

    /// Restoring division of magnitudes, then the rounding by sign and remainder.
    fn divide(&self, numerator: i128, divisor: i128) -> i128 {
        let (d, negative) = (divisor.unsigned_abs(), numerator < 0);
        let n = numerator.unsigned_abs();
        let last = u32::from(self.slip == SetupSlip::OneBitShort);
        let (mut q, mut r) = (0u128, 0u128);
        for bit in (last..128).rev() {
            r = r.wrapping_shl(1) | n >> bit & 1;
            let fits = if self.slip == SetupSlip::StrictFit { r > d } else { r >= d };
            if fits {
                r -= d;
            }
            q = q << 1 | u128::from(fits);
        }
        // The rounding of q + r / d is that of its parity and of a remainder in quarters.
        let quarters = match (r, r.wrapping_mul(2).cmp(&d)) {
            (0, _) => 0,
            (_, Ordering::Less) => 1,
            (_, Ordering::Equal) => 2,
            (_, Ordering::Greater) => 3,
        };
        let odd =
            (q & 1).cast_signed() ^ i128::from(self.slip == SetupSlip::TiesToOdd && quarters == 2);
        let near = if negative { -(4 * odd + quarters) } else { 4 * odd + quarters };
        let rounded =
            self.depth.config().rounding.divide(near, 4).map_or(odd, |(near, _)| near.abs());
        let magnitude = q.cast_signed() + rounded - odd;
        if negative && self.slip != SetupSlip::SignLost { -magnitude } else { magnitude }
    }
}
