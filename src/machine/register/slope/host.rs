//! What a host writes for the engine `slopes`: vertices or the slopes of sides, and channels whose slopes are
//! nearest to the exact ones. Spec clause `RG-4`.

use super::edge::Source;
use super::{ClipEnds, Plane, RowCounts, RowOrder, Slopes};
use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::format::Gather;
use crate::machine::register::host::{attributes, gradient, target_ends};
use crate::setup::Triangle;

/// A place in sub-pixels: x as numerator and positive denominator, and y.
type Origin = ((i128, i128), i128);

/// A side in sub-pixels, from the end that is drawn first.
type Side = ([i128; 2], [i128; 2]);

/// Writes a value into its register.
type Put<'a> = &'a mut dyn FnMut(&Gather, i128);

/// The quotient nearest to the exact one; the denominator is not zero.
fn nearest(numerator: i128, denominator: i128) -> i128 {
    let sign = denominator.signum();
    let exact = Rounding::NearestEven.divide(numerator * sign, denominator * sign);
    exact.map_or(0, |(quotient, _)| quotient)
}

/// The rows of the samples between two ends: the one drawn first, and how many.
fn rows(grid: &SampleGrid, (p, q): Side) -> (i128, i128) {
    let (first, last) = grid.pixels(1, (p[1].min(q[1]), p[1].max(q[1]) - 1));
    (if p[1] > q[1] { last - 1 } else { first }, (last - first).max(0))
}

impl Slopes {
    /// The words of a triangle: one list, or none without area.
    pub(super) fn host_words(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let upward = matches!(self.edges.source, Source::Given { rows: RowOrder::Up, .. });
        let mut v = triangle.xy;
        v.sort_by_key(|at| if upward { -at[1] } else { at[1] });
        let [a, b, c] = v;
        // Which side of the long edge the third vertex is on, as seen while it is walked.
        let cross = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if cross == 0 {
            return Vec::new();
        }
        let leftward = (cross < 0) != upward;
        let mut words = vec![0; count];
        let mut put = |gather: &Gather, value: i128| {
            gather.scatter(value, &mut words);
        };
        let (direction, says_left) = &self.edges.direction;
        put(direction, i128::from(leftward == *says_left));
        let Some(mut origin) = self.host_edges(v, &mut put) else { return Vec::new() };
        if let Some((x, y)) = &self.point {
            origin = self.host_point(a, (x, y.as_ref()), origin.1, &mut put);
        }
        self.host_channels(triangle, (a, c), leftward, origin, &mut put);
        if let Some([left, right, top, bottom]) = &self.clip {
            let registers = [left, top, right, bottom];
            let closed = self.config.clip == Some(ClipEnds::Closed);
            let ends = target_ends(&self.target, closed, registers);
            registers.into_iter().zip(ends).for_each(|(gather, end)| put(gather, end));
        }
        for flag in self.clips.iter().chain(&self.adjust) {
            put(flag, 1);
        }
        vec![words]
    }

    /// Writes the sides; where channels start, or `None` where a count of rows cannot say that there are none.
    fn host_edges(&self, [a, b, c]: [[i128; 2]; 3], put: Put<'_>) -> Option<Origin> {
        let (grid, fraction) = (&self.target.grid, self.edges.fraction);
        match &self.edges.source {
            Source::Divided { vertices, .. } => {
                for (gathers, at) in vertices.iter().zip([a, b, c]) {
                    gathers.iter().zip(at).for_each(|(gather, value)| put(gather, value));
                }
                Some(((a[0], 1), a[1]))
            }
            Source::Given { start, slope, ends, counts, .. } => {
                let one = 1i128 << self.sub_pixel;
                let x_at = |(p, q): Side, row: i128| {
                    let (along, height) = (q[0] - p[0], q[1] - p[1]);
                    let down = grid.position(0, row)[1] - p[1];
                    let x = (p[0] - grid.offset[0]) * height + along * down;
                    nearest(x << fraction, height * one)
                };
                let slope_of =
                    |(p, q): Side| nearest((q[0] - p[0]) << fraction, (p[1] - q[1]).abs());
                let (row, all) = rows(grid, (a, c));
                if all == 0 && *counts == RowCounts::All {
                    return None;
                }
                put(&start[0], x_at((a, c), row));
                put(&start[1], row);
                put(slope, slope_of((a, c)));
                for (gathers, side) in ends.iter().zip([(a, b), (b, c)]) {
                    let (first, count) = rows(grid, side);
                    if count > 0 {
                        put(&gathers[0], x_at(side, first));
                        put(&gathers[1], slope_of(side));
                        put(&gathers[2], count);
                    }
                }
                if *counts == RowCounts::All {
                    put(&ends[1][2], all);
                }
                let (y, height) = (grid.position(0, row)[1], c[1] - a[1]);
                let x = a[0] * height + (c[0] - a[0]) * (y - a[1]);
                Some(((x * height.signum(), height.abs()), y))
            }
        }
    }

    /// Writes the point that channels start at: the first vertex, as its registers hold it. The y of the first row
    /// where there is no register of y.
    fn host_point(
        &self,
        a: [i128; 2],
        (x, y): (&Gather, Option<&Gather>),
        top: i128,
        put: Put<'_>,
    ) -> Origin {
        let (s, fraction) = (self.sub_pixel, self.edges.fraction);
        let mut held = |gather: &Gather, axis: usize| {
            let low = gather.lowest();
            // What a register drops is dropped before channels start there.
            let place =
                (((a[axis] - self.target.grid.offset[axis]) << fraction) >> s) >> low << low;
            put(gather, place);
            place + ((self.target.grid.offset[axis] << fraction) >> s)
        };
        let x = held(x, 0);
        let y = y.map(|y| held(y, 1));
        ((x << s, 1 << fraction), y.map_or(top, |y| (y << s) >> fraction))
    }

    /// Writes starts and slopes of the channels.
    fn host_channels(
        &self,
        triangle: &Triangle,
        (a, c): Side,
        leftward: bool,
        ((x, part), y): Origin,
        put: Put<'_>,
    ) {
        let one = 1i128 << self.sub_pixel;
        let at_edge = matches!(self.config.plane, Plane::AtEdge { .. });
        // Distances from a point have the fraction bits of x, which registers then lack.
        let up = if self.point.is_some() { self.edges.fraction } else { 0 };
        let p = triangle.xy[0];
        for (n, (channel, input)) in self.channels.iter().enumerate() {
            let values = attributes(channel, n);
            let Some(([dx, dy], area)) = gradient(triangle, values) else { continue };
            // Along the row as it runs, and down the long edge where channels start there.
            let run = if at_edge && leftward { -1 } else { 1 };
            let (down, over) = if at_edge {
                let change = dx * (c[0] - a[0]) + dy * (c[1] - a[1]);
                (change * one, area * (c[1] - a[1]).abs())
            } else {
                (dy * one, area)
            };
            let start = values[0] * area * part + dx * (x - p[0] * part) + dy * (y - p[1]) * part;
            let mut register = |gather, numerator, denominator, shift| {
                put(gather, i128::from(channel.register(numerator, denominator, shift)));
            };
            register(&input.start, start, area * part, channel.shift + up);
            register(&input.along, dx * one * run, area, channel.shift_along + up);
            register(&input.down, down, over, channel.shift + up);
        }
    }
}
