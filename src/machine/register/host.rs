//! What a host would write: attributes over a triangle that every machine can be compared by, and their
//! gradients. Spec clause `RG-4`.

use crate::format::Gather;
use crate::machine::Target;
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

/// Left, top, right and bottom of a target, as the registers of a rectangle hold them: its last pixels if it is
/// `closed`, and those past them otherwise. An end that its register does not hold is the largest that it holds.
pub(super) fn target_ends(target: &Target, closed: bool, registers: [&Gather; 4]) -> [i128; 4] {
    let [x, y] = [0, 1].map(|axis| target.clip.clip(axis, (0, i128::MAX >> 1)));
    let past = u32::from(closed);
    let ends = [x.0, y.0, x.1.saturating_sub(past), y.1.saturating_sub(past)];
    std::array::from_fn(|n| held(registers[n], ends[n].into()))
}

/// A number without a sign as its register holds it, at most the largest that it holds.
pub(super) fn held(register: &Gather, value: i128) -> i128 {
    value.min((1 << register.bits()) - 1)
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
