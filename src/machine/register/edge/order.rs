//! The order in which pixels are looked at. Spec clause `RE-6`.

use super::cover::Cover;
use super::part::{EdgeOrder, TilePlace};
use std::ops::Range;

/// Draws a pixel: its place and its edge words.
pub(super) type Draw<'a> = &'a mut dyn FnMut([i64; 2], [i64; 3]);

/// Pixels, half-open: first column, first row, and the ends of both.
pub(super) type Bounds = [i64; 4];

/// The pixels of a part of a row that are inside.
fn segment(cover: &Cover, y: i64, range: Range<i64>, leftward: bool, draw: Draw<'_>) {
    let (span, known) = cover.span(y, range);
    let mut pixel = |x: i64| {
        let words = cover.words([x, y]);
        if known || cover.inside(words) {
            draw([x, y], words);
        }
    };
    if leftward { span.rev().for_each(pixel) } else { span.for_each(&mut pixel) }
}

/// Looks at the pixels of a box in an order.
pub(super) fn visit(cover: &Cover, order: EdgeOrder, bounds: Bounds, draw: Draw<'_>) {
    let [x0, y0, x1, y1] = bounds;
    match order {
        EdgeOrder::Rows => (y0..y1).for_each(|y| segment(cover, y, x0..x1, false, draw)),
        EdgeOrder::Serpentine => {
            (y0..y1).for_each(|y| segment(cover, y, x0..x1, (y - y0) & 1 == 1, draw));
        }
        EdgeOrder::Zigzag => zigzag(cover, bounds, draw),
        EdgeOrder::Tiles { width, height, place, reject_corners, beyond_box } => {
            let size = [i64::from(width), i64::from(height)];
            let tiles = Tiles { size, place, reject: reject_corners, beyond: beyond_box };
            tiles.visit(cover, bounds, draw);
        }
    }
}

/// A walker that steps out of the triangle, down, and turns where it has to.
fn zigzag(cover: &Cover, [x0, y0, x1, y1]: Bounds, draw: Draw<'_>) {
    let (mut at, mut leftward) = (x0, false);
    for y in y0..y1 {
        let (span, known) = cover.span(y, x0..x1);
        let is_in = |x: &i64| known || cover.inside(cover.words([*x, y]));
        let ends = span.clone().find(is_in).zip(span.clone().rev().find(is_in));
        let came = leftward;
        match ends {
            // Beyond the row it stands outside, and turns.
            None if y == y0 => (at, leftward) = (x0, true),
            None => {
                // From an end it has seen the whole row after one walk, otherwise after two.
                leftward = if at <= x0 { false } else { at >= x1 || came };
                at = if leftward { x0 } else { x1 };
            }
            Some((first, last)) => {
                if y > y0 {
                    leftward = !came;
                    let ahead = if leftward { first < at } else { last > at };
                    let lands_inside = span.contains(&at) && is_in(&at);
                    if !lands_inside && !ahead {
                        leftward = came;
                    }
                }
                segment(cover, y, first..last + 1, leftward, draw);
                at = if leftward { first - 1 } else { last + 1 };
            }
        }
    }
}

/// Tiles of pixels.
struct Tiles {
    size: [i64; 2],
    place: TilePlace,
    reject: bool,
    beyond: bool,
}

impl Tiles {
    /// The first pixels of the tiles along an axis.
    fn along(&self, axis: usize, low: i64, high: i64) -> impl Iterator<Item = i64> + use<> {
        let size = self.size[axis];
        let on_grid = || (high - 1).div_euclid(size) - low.div_euclid(size) + 1;
        let (first, count) = match self.place {
            TilePlace::Grid => (low.div_euclid(size) * size, on_grid()),
            TilePlace::Box => (low, (high - low + size - 1).div_euclid(size)),
            TilePlace::BoxCountedByGrid => (low, on_grid()),
        };
        (0..count).map(move |n| first + n * size)
    }

    fn visit(&self, cover: &Cover, [x0, y0, x1, y1]: Bounds, draw: Draw<'_>) {
        let [width, height] = self.size;
        for top in self.along(1, y0, y1) {
            for left in self.along(0, x0, x1) {
                let (right, bottom) = (left + width - 1, top + height - 1);
                let corners = [[left, top], [right, top], [left, bottom], [right, bottom]];
                if self.reject && cover.all_beyond_one(corners) {
                    continue;
                }
                let (mut rows, mut columns) = (top..bottom + 1, left..right + 1);
                if !self.beyond {
                    rows = rows.start.max(y0)..rows.end.min(y1);
                    columns = columns.start.max(x0)..columns.end.min(x1);
                }
                rows.for_each(|y| segment(cover, y, columns.clone(), false, draw));
            }
        }
    }
}
