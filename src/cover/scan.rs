//! Exact spans of a triangle, row by row: each side is cut by a quotient and a remainder that step
//! downward together, so that no row needs a division and none is wrong. Spec clause `A-9`.

use super::rect::Rect;
use super::rule::FillRule;
use super::sample::SampleGrid;
use crate::bits::bounded;
use num_traits::PrimInt;

/// The first pixel right of one side, row after row: `cut = floor((N + bias) / D)` with
/// `N = (x - ox) dy + (y - y_top) dx` and `D = 2^s dy`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<T> {
    pub(super) cut: T,
    rest: T,
    step: T,
    step_rest: T,
    whole: T,
}

/// Floor and remainder for a positive divisor.
#[inline]
fn divide<T: PrimInt>(numerator: T, divisor: T) -> (T, T) {
    let (quotient, rest) = (numerator / divisor, numerator % divisor);
    if rest < T::zero() { (quotient - T::one(), rest + divisor) } else { (quotient, rest) }
}

impl<T: PrimInt> Side<T> {
    /// The side from `top` down to `bottom`, at the row of samples at `y`.
    #[inline]
    pub(super) fn new(top: [T; 2], bottom: [T; 2], y: T, grid: &Grid<T>, rule: FillRule) -> Self {
        let (dx, dy) = (bottom[0] - top[0], bottom[1] - top[1]);
        let whole = dy << grid.sub_pixel;
        // An owner of its left side takes a sample on it, any other takes the one after.
        let bias = match rule {
            FillRule::TopLeft => whole - T::one(),
            FillRule::Shadow => whole,
        };
        let above = (top[0] - grid.offset[0]) * dy + (y - top[1]) * dx;
        let (cut, rest) = divide(above + bias, whole);
        let (step, step_rest) = divide(dx, dy);
        Self { cut, rest, step, step_rest: step_rest << grid.sub_pixel, whole }
    }

    #[inline]
    pub(super) fn down(&mut self) {
        self.cut = self.cut + self.step;
        self.rest = self.rest + self.step_rest;
        if self.rest >= self.whole {
            self.rest = self.rest - self.whole;
            self.cut = self.cut + T::one();
        }
    }
}

/// The sample grid in a lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<T> {
    pub(super) offset: [T; 2],
    pub(super) sub_pixel: usize,
}

/// Calls `row(y, x0, x1)` for every span of a triangle inside `clip`, top to bottom; either winding.
///
/// Growth: with vertex differences of m bits a cut forms numbers below 2^(2m + 1), and coordinates
/// in `i64` (see [`fits_narrow`]) or `i128` hold them.
fn rows<T: PrimInt>(
    xy: [[T; 2]; 3],
    grid: Grid<T>,
    clip: Rect,
    rule: FillRule,
    mut row: impl FnMut(u32, u32, u32),
) {
    let [mut a, mut b, mut c] = xy;
    if b[1] < a[1] {
        std::mem::swap(&mut a, &mut b);
    }
    if c[1] < b[1] {
        std::mem::swap(&mut b, &mut c);
        if b[1] < a[1] {
            std::mem::swap(&mut a, &mut b);
        }
    }
    // The first row whose sample is not above a height, within the clip.
    let lane = |value: u32| T::from(value).unwrap_or_else(T::zero);
    let (clip_y0, clip_y1) = (lane(clip.y0), lane(clip.y1));
    let pixel = T::one() << grid.sub_pixel;
    let first = |y: T| {
        let first = (y - grid.offset[1] + pixel - T::one()) >> grid.sub_pixel;
        first.max(clip_y0).min(clip_y1)
    };
    let (top, middle, bottom) = (first(a[1]), first(b[1]), first(c[1]));
    if top >= bottom {
        return;
    }
    let sample = |row: T| (row << grid.sub_pixel) + grid.offset[1];
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if area == T::zero() {
        return;
    }
    // The middle vertex lies right of the long side, or left of it.
    let bends_right = area > T::zero();
    let (clip_x0, clip_x1) = (lane(clip.x0), lane(clip.x1));
    let mut long = Side::new(a, c, sample(top), &grid, rule);
    let mut y = top.to_u32().unwrap_or(0);
    for (from, to, begin, end) in [(a, b, top, middle), (b, c, middle, bottom)] {
        if begin >= end {
            continue;
        }
        let mut short = Side::new(from, to, sample(begin), &grid, rule);
        for _ in 0..(end - begin).to_u32().unwrap_or(0) {
            let (left, right) =
                if bends_right { (long.cut, short.cut) } else { (short.cut, long.cut) };
            let (x0, x1) = (left.max(clip_x0), right.min(clip_x1));
            if x0 < x1 {
                // Inside the clip, so both are column numbers.
                row(y, x0.to_u32().unwrap_or(0), x1.to_u32().unwrap_or(0));
            }
            y += 1;
            long.down();
            short.down();
        }
    }
}

/// Whether every product that cutting a triangle forms fits 64 bits: differences of `difference`
/// bits, twice that and the row's own bits.
pub const fn fits_narrow(difference: u32) -> bool {
    2 * difference + 3 < 63
}

/// The exact spans of a triangle inside `clip`, top to bottom, as `row(y, x0, x1)`. `narrow` says
/// that [`fits_narrow`] holds for the vertex field.
pub fn scan(
    xy: &[[i128; 2]; 3],
    grid: &SampleGrid,
    clip: Rect,
    rule: FillRule,
    narrow: bool,
    row: impl FnMut(u32, u32, u32),
) {
    let sub_pixel = grid.sub_pixel as usize;
    if narrow {
        let lane = |value: i128| -> i64 { bounded(value) };
        let grid = Grid { offset: grid.offset.map(lane), sub_pixel };
        rows::<i64>(xy.map(|v| v.map(lane)), grid, clip, rule, row);
    } else {
        rows::<i128>(*xy, Grid { offset: grid.offset, sub_pixel }, clip, rule, row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_toy_triangle_is_cut_where_the_edges_say() {
        // Plain half planes, sample by sample, in a window of 4 x 3 pixels with one sub-pixel bit.
        let clip = Rect { x0: 1, y0: 0, x1: 4, y1: 3 };
        let grid = SampleGrid::at([1, 1], 1);
        let points: Vec<[i128; 2]> = (0..=6).flat_map(|y| (-1..=8).map(move |x| [x, y])).collect();
        let mut drawn = 0;
        for (i, a) in points.iter().enumerate().step_by(3) {
            for (j, b) in points.iter().enumerate() {
                for c in points.iter().step_by(if (i + j) % 2 == 0 { 4 } else { 7 }) {
                    for rule in FillRule::ALL {
                        let [got, wide] = [true, false].map(|narrow| {
                            let mut got = [[false; 4]; 3];
                            scan(&[*a, *b, *c], &grid, clip, rule, narrow, |y, x0, x1| {
                                for x in x0..x1 {
                                    got[y as usize][x as usize] = true;
                                }
                            });
                            got
                        });
                        assert_eq!(got, wide, "{a:?} {b:?} {c:?} {rule:?}");
                        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
                        let v = if area < 0 { [*a, *c, *b] } else { [*a, *b, *c] };
                        for (y, row) in got.iter().enumerate() {
                            for (x, covered) in row.iter().enumerate() {
                                let p = [2 * x as i128 + 1, 2 * y as i128 + 1];
                                let inside = (0..3).all(|k| {
                                    let (f, t) = (v[k], v[(k + 1) % 3]);
                                    let d = [t[0] - f[0], t[1] - f[1]];
                                    let e = d[0] * (p[1] - f[1]) - d[1] * (p[0] - f[0]);
                                    e > 0 || (e == 0 && rule.owns(d))
                                });
                                let wanted = area != 0 && inside && x >= 1;
                                assert_eq!(*covered, wanted, "{a:?} {b:?} {c:?} {rule:?} {p:?}");
                                drawn += u32::from(wanted);
                            }
                        }
                    }
                }
            }
        }
        assert!(drawn > 10_000);
    }
}
