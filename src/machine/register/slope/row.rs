//! Rows of the engine `slopes`: which pixels they hold. Spec clauses `RG-13` and `RG-24`.

use super::edge::Walk;
use super::{ClipEnds, Slopes};
use crate::value::Channel;

/// The pixels that may be drawn to: `[low, high)` on each axis.
pub(super) struct Window {
    pub(super) x: [i64; 2],
    pub(super) y: [i64; 2],
}

/// The pixels of a row, in the direction in which it runs.
pub(super) struct Span {
    /// Its first pixel, clipped or not.
    pub(super) unclipped: i64,
    /// Its first pixel that is not clipped.
    pub(super) first: i64,
    pub(super) count: i64,
    /// From a pixel to the next.
    pub(super) step: i64,
}

/// Rows that are looked at for how many pixels they have; nobody allows as many.
const MOST_ROWS: u64 = 1 << 28;

impl Slopes {
    /// Rows, and the pixels in them; where the longest rows take no more than `most`, those.
    pub(super) fn steps(&self, words: &[u32], most: u64) -> u128 {
        let walk = self.edges.walk(words, self.sub_pixel);
        let (window, mut steps) = (self.window(words), 0);
        if walk.count() > MOST_ROWS {
            return walk.count().into();
        }
        // As many pixels as x has, and the one at its end.
        let longest = self.config.pixel_bits.unwrap_or(32 - self.edges.fraction);
        let all = u128::from(walk.count()) * ((1 << longest) + 2);
        if all <= u128::from(most) {
            return all;
        }
        walk.rows(|_, _, start, end| {
            let span = self.span(&walk, [start, end], &window);
            steps += 1 + span.map_or(0, |span| u128::from(span.count.unsigned_abs()));
        });
        steps
    }

    pub(super) fn window(&self, words: &[u32]) -> Window {
        let on = self.clips.as_ref().is_none_or(|clips| clips.unsigned(words) != 0);
        let Some(clip) = self.clip.as_ref().filter(|_| on) else {
            return Window { x: [i64::MIN, i64::MAX], y: [i64::MIN, i64::MAX] };
        };
        let [left, right, top, bottom] =
            clip.each_ref().map(|gather| gather.unsigned(words).cast_signed());
        let past = i64::from(self.config.clip == Some(ClipEnds::Closed));
        Window { x: [left, right + past], y: [top, bottom + past] }
    }

    /// The number of a pixel or a row: its low bits, with their sign, where it has a width.
    pub(super) fn number(&self, value: i64) -> i64 {
        self.config.pixel_bits.map_or(value, |bits| value << (64 - bits) >> (64 - bits))
    }

    /// The pixels between the x of both ends; `None` for an empty row.
    pub(super) fn span(&self, walk: &Walk, ends: [i32; 2], window: &Window) -> Option<Span> {
        // Both ends are rounded alike and the right one is outside, whichever way a row runs.
        let step: i64 = if walk.leftward { -1 } else { 1 };
        let back = i64::from(walk.leftward);
        let [unclipped, mut end] =
            ends.map(|x| self.number(walk.pixel(x, self.config.pixel_bias) - back));
        if let Some(bits) = self.config.pixel_bits {
            // The counter has no sign: ends that have changed places are far apart.
            let count = ((end - unclipped) * step) & ((1 << bits) - 1);
            return (count > 0).then_some(Span { unclipped, first: unclipped, count, step });
        }
        let first;
        if walk.leftward {
            end = end.max(window.x[0].saturating_sub(1));
            first = unclipped.min(window.x[1] - 1);
        } else {
            end = end.min(window.x[1]);
            first = unclipped.max(window.x[0]);
        }
        let count = (end - first) * step;
        (count > 0).then_some(Span { unclipped, first, count, step })
    }

    /// Where channels start, in units of the fraction of x; the y of the first row where there is no register.
    pub(super) fn point(&self, words: &[u32], top: i64) -> Option<[i64; 2]> {
        let (x, y) = self.point.as_ref()?;
        let y = y.as_ref().map(|y| y.signed(words));
        Some([x.signed(words), y.unwrap_or(top << self.edges.fraction)])
    }

    /// A channel at a pixel, by its distance from a point in words of 32 bits.
    pub(super) fn at_point(
        &self,
        channel: &Channel,
        [start, along, down]: [i64; 3],
        (point, at): ([i64; 2], [i64; 2]),
    ) -> i64 {
        let distance = |axis: usize| {
            let whole = at[axis] << self.edges.fraction;
            whole.wrapping_sub(point[axis]) << 32 >> 32
        };
        let moved = distance(0).wrapping_mul(along).wrapping_add(distance(1).wrapping_mul(down));
        channel.wrap(start.wrapping_add(moved))
    }
}
