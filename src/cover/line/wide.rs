//! Lines with an area. Spec clause `L-7`.

use super::Segment;
use crate::cover::rect::Rect;
use crate::cover::sample::SampleGrid;

/// Samples inside the rectangle of `width` sub-pixels around a segment, row by row: projected onto
/// it, from the start inclusive to the end exclusive; beside it, up to half the width inclusive on
/// its left (y down: where the cross product is negative), exclusive on its right.
pub(super) fn rectangle(
    [from, to]: Segment,
    width: u32,
    grid: &SampleGrid,
    clip: Rect,
    plot: &mut dyn FnMut(u32, u32),
) {
    let d = [to[0] - from[0], to[1] - from[1]];
    let length2 = d[0] * d[0] + d[1] * d[1];
    if length2 == 0 {
        return;
    }
    let width = i128::from(width);
    let reach = (width + 1) / 2;
    let rows = (from[1].min(to[1]) - reach, from[1].max(to[1]) + reach);
    let columns = (from[0].min(to[0]) - reach, from[0].max(to[0]) + reach);
    let (y0, y1) = clip.clip(1, grid.pixels(1, rows));
    let (x0, x1) = clip.clip(0, grid.pixels(0, columns));
    // Four conditions, each of which is monotone along a row: a pair of ends, a pair of sides.
    let test = |k: usize, x: u32, y: u32| {
        let at = grid.position(i128::from(x), i128::from(y));
        let q = [at[0] - from[0], at[1] - from[1]];
        let along = q[0] * d[0] + q[1] * d[1];
        let cross = d[0] * q[1] - d[1] * q[0];
        // Twice the distance against the width, by their squares.
        let side = 4 * cross * cross;
        let limit = width * width * length2;
        match k {
            0 => along >= 0,
            1 => along < length2,
            2 => cross >= 0 || side <= limit,
            _ => cross < 0 || side < limit,
        }
    };
    for y in y0..y1 {
        let (mut left, mut right) = (x0, x1);
        for k in 0..4 {
            if left >= right {
                break;
            }
            let (at_left, at_right) = (test(k, left, y), test(k, right - 1, y));
            match (at_left, at_right) {
                (true, true) => {}
                (false, false) => right = left,
                // The first column where it changes.
                _ => {
                    let (mut from, mut to) = (left, right - 1);
                    while to - from > 1 {
                        let middle = from + (to - from) / 2;
                        if test(k, middle, y) == at_left { from = middle } else { to = middle }
                    }
                    if at_left { right = to } else { left = to }
                }
            }
        }
        (left..right).for_each(|x| plot(x, y));
    }
}
