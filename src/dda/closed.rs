//! Event counts of a linear run of samples without looking at one of them.
//! Spec clause `V-4`; the per-sample twin is [`super::twin::span_events`].

use crate::bits::{Event, Extent, Place, SpanEvents, bounded};
use crate::format::ReadOut;

/// A run of unwrapped accumulator values: `start + n * slope` for `0 <= n < count`.
///
/// Range and growth: `|start| + count * |slope| < 2^126`; set-up refuses profiles beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// Value at the first sample.
    pub start: i128,
    /// Change from sample to sample.
    pub slope: i128,
    /// Samples.
    pub count: u64,
}

impl Line {
    /// The value at sample `n`.
    #[inline]
    pub fn at(self, n: u64) -> i128 {
        self.start + self.slope * i128::from(n)
    }

    /// The half-open run of samples with a value below `limit`.
    fn below(self, limit: i128) -> (u64, u64) {
        let distance = limit - self.start;
        let cut = |numerator: i128, slope: i128| {
            // The first n with n * slope >= numerator.
            let n = (numerator + slope - 1).div_euclid(slope);
            u64::try_from(n.max(0)).unwrap_or(u64::MAX).min(self.count)
        };
        match self.slope.signum() {
            1 => (0, cut(distance, self.slope)),
            -1 => (cut(1 - distance, -self.slope), self.count),
            _ => (0, if distance > 0 { self.count } else { 0 }),
        }
    }

    /// The half-open run of samples with a value of at least `limit`.
    fn at_least(self, limit: i128) -> (u64, u64) {
        match self.below(limit) {
            (0, end) => (end, self.count),
            (start, _) => (0, start),
        }
    }

    /// Samples whose value is a multiple of 2^bits: how many, and the first sample that is not.
    fn multiples(self, bits: u32) -> (u64, Option<u64>) {
        let mask = (1i128 << bits) - 1;
        let (start, slope) = (self.start & mask, self.slope & mask);
        if slope == 0 {
            let all = start == 0;
            return (if all { self.count } else { 0 }, (!all && self.count > 0).then_some(0));
        }
        // Two neighbours are never both multiples here, so one of the first two is not.
        let first = u64::from(start == 0);
        let first = (first < self.count).then_some(first);
        let shared = slope.trailing_zeros();
        if start & ((1 << shared) - 1) != 0 {
            return (0, first);
        }
        // n * odd == target (mod 2^period): Newton's iteration doubles the right bits each time.
        let period = bits - shared;
        let odd = slope >> shared;
        let mut inverse = odd;
        for _ in 0..6 {
            inverse = inverse.wrapping_mul(2i128.wrapping_sub(odd.wrapping_mul(inverse)));
        }
        let target = (-(start >> shared)).wrapping_mul(inverse) & ((1 << period) - 1);
        let remaining = i128::from(self.count) - target;
        let hits = if remaining > 0 { ((remaining - 1) >> period) + 1 } else { 0 };
        (bounded(hits), first)
    }

    /// The events of the run as read through `read`, samples lying at `place` and rightward.
    pub fn events(self, read: ReadOut, place: Place) -> SpanEvents {
        let mut events = SpanEvents::default();
        if self.count == 0 {
            return events;
        }
        let last = self.at(self.count - 1);
        let extent = Extent { minimum: self.start.min(last), maximum: self.start.max(last) };
        events.extent = Some(extent);
        let mut add = |event: Event, (start, end): (u64, u64)| {
            if start < end {
                let index = event as usize;
                events.counts[index] += end - start;
                let here = Place { x: place.x + start.cast_signed(), ..place };
                let first = events.first[index].get_or_insert(here);
                *first = (*first).min(here);
            }
        };
        let (lowest, limit) = read.range();
        if extent.minimum < lowest {
            add(Event::Wrap, self.below(lowest));
        }
        if extent.maximum >= limit {
            add(Event::Wrap, self.at_least(limit));
        }
        if read.clamps() && extent.maximum >= read.top() {
            add(Event::ClampAbove, self.at_least(read.top()));
        }
        if read.clamps() && extent.minimum < 0 {
            add(Event::ClampBelow, self.below(0));
        }
        let (exact, first_inexact) = self.multiples(read.fraction());
        events.counts[Event::Inexact as usize] = self.count - exact;
        events.first[Event::Inexact as usize] =
            first_inexact.map(|n| Place { x: place.x + n.cast_signed(), ..place });
        events
    }
}
