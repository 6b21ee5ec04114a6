//! Rows of the engine `sub-scanlines`: which part of four sub-scanlines is drawn, coverage on a
//! checkerboard of 8 samples a pixel, and values at the first covered one. Spec clauses `RG-17` to `RG-19`.

use super::{Attributes, SubScanlines, product};
use crate::value::{Channel, leading_ones};

/// Four sub-scanlines of a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// Ends on the long and the short edge, in eighths of a pixel.
    long: [i64; 4],
    short: [i64; 4],
    invalid: [bool; 4],
    /// Leftmost and rightmost pixel of the valid ones.
    least: i64,
    most: i64,
    over: bool,
    under: bool,
}

impl Default for Span {
    fn default() -> Self {
        let (long, short, invalid) = ([0; 4], [0; 4], [true; 4]);
        Self { long, short, invalid, least: 0xfff, most: 0, over: true, under: true }
    }
}

impl Span {
    /// Takes a sub-scanline: its ends on the long and the short edge, and whether it is drawn at all.
    pub(super) fn sub_line(
        &mut self,
        n: usize,
        [(long, long_over, long_under), (short, short_over, short_under)]: [(i64, bool, bool); 2],
        invalid: bool,
        rightward: bool,
    ) {
        (self.long[n], self.short[n], self.invalid[n]) = (long, short, invalid);
        self.over &= long_over && short_over;
        self.under &= long_under && short_under;
        if !invalid {
            let (left, right) = if rightward { (long, short) } else { (short, long) };
            self.least = self.least.min(left >> 3);
            self.most = self.most.max(right >> 3);
        }
    }

    /// Whether anything of it is inside the scissor and valid.
    pub(super) fn is_drawn(&self) -> bool {
        self.invalid.contains(&false) && !self.over && !self.under
    }

    /// The covered samples of a pixel, two a sub-scanline, the uppermost in the upper bits.
    fn mask(&self, x: i64, rightward: bool) -> u32 {
        let mut mask = 0;
        for n in (0..4).filter(|n| !self.invalid[*n]) {
            let (left, right) = if rightward {
                (self.long[n], self.short[n])
            } else {
                (self.short[n], self.long[n])
            };
            mask |= samples(n, x, left, right) << (if n < 2 { 4 } else { 0 });
        }
        mask
    }
}

/// The samples of a sub-scanline, of the four columns of a pixel.
const fn board(n: usize) -> u32 {
    if n.is_multiple_of(2) { 0xa } else { 0x5 }
}

/// The covered samples of a sub-scanline in pixel x.
const fn samples(n: usize, x: i64, left: i64, right: i64) -> u32 {
    let from = 0xf >> (((left & 7) + 1) >> 1);
    let until = 0xf0 >> (((right & 7) + 1) >> 1);
    let (first, last) = (left >> 3, right >> 3);
    let all = board(n);
    if x < first || x > last || last < first {
        0
    } else if first == last {
        all & from & until
    } else if x == first {
        all & from
    } else if x == last {
        all & until
    } else {
        all
    }
}

/// Column and row, in quarters, of the first covered sample: the uppermost, then the leftmost.
fn first_sample(mask: u32) -> [i64; 2] {
    for n in 0..4usize {
        let here = mask >> (if n < 2 { 4 } else { 0 }) & board(n);
        if here != 0 {
            return [i64::from(here.leading_zeros()) - 28, i64::try_from(n).unwrap_or(0)];
        }
    }
    [0, 0]
}

/// A row about to be drawn.
#[derive(Debug, Default)]
pub(super) struct Line {
    pub(super) y: i64,
    /// The long edge's pixel, before the scissor.
    edge_x: i64,
    /// Values where the row starts.
    start: Vec<i64>,
    values: Vec<i64>,
}

impl Line {
    /// Takes the start of the row where the long edge is at `x`.
    pub(super) fn start(&mut self, engine: &SubScanlines, held: &Attributes, x: i64) {
        self.edge_x = x << (64 - 28) >> (64 - 12);
        let fraction = x >> 8 & 0xff;
        self.start.clear();
        for (n, channel) in engine.channels.iter().enumerate() {
            let slope = held.along[n] >> 8 & !1;
            let back = product(engine.config.product, slope, fraction);
            let moved = (held.start[n] & !0x1ff) + held.offset[n] - back;
            self.start.push(channel.wrap(moved & !0x3ff));
        }
    }

    /// Writes the line and its pixels.
    pub(super) fn draw(
        &mut self,
        engine: &SubScanlines,
        span: &Span,
        held: &Attributes,
        rightward: bool,
        emit: &mut dyn FnMut(usize, &[i64]),
    ) {
        // A row runs from the long edge to the short one.
        let (first, last) =
            if rightward { (span.least, span.most) } else { (span.most, span.least) };
        self.values.clear();
        self.values.extend([self.y, last, first, self.edge_x]);
        self.values.extend(&self.start);
        self.values.extend(span.long);
        self.values.extend(span.short);
        self.values.extend(span.invalid.map(i64::from));
        emit(0, &self.values);
        let run = if rightward { 1 } else { -1 };
        let skipped = engine.distance((first - self.edge_x) * run);
        let mut values = self.start.clone();
        for (n, channel) in engine.channels.iter().enumerate() {
            // The sign turns within the slope's 32 bits: the lowest slope keeps it.
            let along = channel.wrap(held.along[n] * run);
            let moved = product(engine.config.product, along, skipped);
            values[n] = channel.wrap(values[n].wrapping_add(moved));
        }
        let mut x = first;
        while (last - x) * run >= 0 {
            let mask = span.mask(x, rightward);
            let at = first_sample(mask);
            self.values.clear();
            self.values.extend([x, self.y, i64::from(mask.count_ones()), held.slope_code, 0]);
            for (n, channel) in engine.channels.iter().enumerate() {
                let whole = mask.count_ones() == 8;
                let value = if channel.correction == 0 || whole {
                    values[n]
                } else {
                    corrected(channel, values[n], [held.along[n], held.down[n]], at)
                };
                self.values.push(channel.value(value));
                values[n] = channel.wrap(values[n].wrapping_add(held.along[n] * run));
            }
            self.values.extend([i64::from(mask), i64::from(mask >> 7 & 1)]);
            let depth = self.values[5 + engine.depth];
            self.values[4] = i64::from(leading_ones(u32::try_from(depth).unwrap_or(0)));
            emit(1, &self.values);
            x += run;
        }
    }
}

/// A value at a sub-sample: so many bits below the integer are kept of value and slopes, and two more of
/// the sum.
fn corrected(channel: &Channel, value: i64, slopes: [i64; 2], at: [i64; 2]) -> i64 {
    let drop = channel.read.fraction() - channel.correction;
    let [dx, dy] = slopes.map(|slope| slope >> drop);
    let sum = ((value >> drop) << 2) + at[0] * dx + at[1] * dy;
    (sum >> 2) << drop
}
