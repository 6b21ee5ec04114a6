//! What a host would write: attributes over a triangle that every machine can be compared by, and their
//! gradients. Spec clause `RG-4`.

use crate::setup::Triangle;
use crate::value::Channel;

/// A channel over a triangle: codes at its vertices.
///
/// The first three channels rise to their maximum at one vertex each, so that any two machines show the
/// same picture; the others have quarters of theirs, another at each vertex. Wide channels stay far below
/// their maximum, as what they hold does.
pub(super) fn attributes(channel: &Channel, index: usize) -> [i128; 3] {
    let top = match channel.read.integer() {
        0..=24 => i128::from(channel.read.maximum()),
        wide => 1 << (wide / 2 + 8),
    };
    std::array::from_fn(|vertex| match index {
        0..=2 if index == vertex => top,
        0..=2 => 0,
        _ => top * [1, 3, 2][(index + vertex) % 3] / 4,
    })
}

/// Gradient of an attribute as numerators over one denominator, which is positive; `None` without area.
pub(super) fn gradient(triangle: &Triangle, values: [i128; 3]) -> Option<([i128; 2], i128)> {
    let [p, q, r] = triangle.xy;
    let (dx1, dy1) = (q[0] - p[0], q[1] - p[1]);
    let (dx2, dy2) = (r[0] - p[0], r[1] - p[1]);
    let (dv1, dv2) = (values[1] - values[0], values[2] - values[0]);
    let area = dx1 * dy2 - dx2 * dy1;
    let sign = area.signum();
    let along = dv1 * dy2 - dv2 * dy1;
    let down = dx1 * dv2 - dx2 * dv1;
    (area != 0).then_some(([along * sign, down * sign], area * sign))
}
