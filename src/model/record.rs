//! A sink that keeps everything of one primitive: what `eval`, `trace` and the tests look at.

use crate::bits::{Event, EventLog, Events, SpanEvents};
use crate::machine::Sink;

/// A maximal run of covered samples `[x0, x1)` in row y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Row.
    pub y: u32,
    /// First column.
    pub x0: u32,
    /// One past the last column.
    pub x1: u32,
}

/// All that drawing one primitive gave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Drawing {
    /// Set-up words, unreduced.
    pub setup: Vec<i128>,
    /// Covered runs, in y then x order.
    pub spans: Vec<Span>,
    /// Depth of each covered sample, run by run; empty when the primitive has none. With several
    /// samples a pixel it is in pixel and then sample order, or one a pixel: `Ports::by_sample`.
    pub depth: Vec<u64>,
    /// Coverage mask of each pixel of the runs, where pixels have several samples.
    pub masks: Vec<u32>,
    /// Numeric events of the depth values.
    pub events: EventLog,
    /// Whether the primitive had no area.
    pub zero_area: bool,
}

impl Drawing {
    /// Empties the drawing and keeps its memory.
    pub fn clear(&mut self) {
        self.setup.clear();
        self.spans.clear();
        self.depth.clear();
        self.masks.clear();
        self.events = EventLog::default();
        self.zero_area = false;
    }

    /// Covered samples.
    pub fn samples(&self) -> u64 {
        self.spans.iter().map(|span| u64::from(span.x1 - span.x0)).sum()
    }

    /// Event counts by key, those that happened.
    pub fn event_counts(&self) -> impl Iterator<Item = (&'static str, u64)> {
        let numeric = Event::ALL.map(|event| (event.key(), self.events.total.count(event)));
        numeric
            .into_iter()
            .chain([("zero_area", u64::from(self.zero_area))])
            .filter(|(_, count)| *count > 0)
    }
}

impl Sink for Drawing {
    fn setup(&mut self, words: &[i128]) {
        self.setup.extend_from_slice(words);
    }

    fn zero_area(&mut self) {
        self.zero_area = true;
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.spans.push(Span { y, x0, x1 });
        self.depth.extend_from_slice(depth);
    }

    fn masks(&mut self, _: u32, _: u32, masks: &[u32]) {
        self.masks.extend_from_slice(masks);
    }

    fn wants_events(&self) -> bool {
        true
    }

    fn events(&mut self, events: &SpanEvents) {
        self.events.span(events);
    }
}
