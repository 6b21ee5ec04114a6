//! A sink that keeps everything of one primitive: what `eval`, `trace` and the tests look at.

use crate::bits::{Event, EventLog, Events, SpanEvents};
use crate::format::Unreduced;
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
    /// Set-up values, before they are cut to words; [`Ports::words`] does that.
    ///
    /// [`Ports::words`]: crate::machine::Ports::words
    pub setup: Vec<Unreduced>,
    /// Covered runs, in y then x order.
    pub spans: Vec<Span>,
    /// Depth of each covered sample, run by run; empty when the primitive has none. With several
    /// samples a pixel it is in pixel and then sample order, or one a pixel: `Ports::by_sample`.
    pub depth: Vec<u64>,
    /// Values of each channel, run by run: at each place the components in their order. There is a place a
    /// pixel, or one a covered sample: `ChannelPort::by_sample`.
    pub channels: Vec<Vec<i64>>,
    /// Coverage mask of each pixel of the runs, where pixels have several samples.
    pub masks: Vec<u32>,
    /// Numeric events of the depth values.
    pub events: EventLog,
    /// Whether the primitive had no area.
    pub zero_area: bool,
    /// Whether the profile leaves the triangle out.
    pub culled: bool,
}

impl Drawing {
    /// Empties the drawing and keeps its memory.
    pub fn clear(&mut self) {
        self.setup.clear();
        self.spans.clear();
        self.depth.clear();
        self.masks.clear();
        self.channels.iter_mut().for_each(Vec::clear);
        self.events = EventLog::default();
        self.zero_area = false;
        self.culled = false;
    }

    /// The set-up values in units of their own last place.
    pub fn raw_setup(&self) -> Vec<i128> {
        self.setup.iter().map(|value| value.raw()).collect()
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
            .chain([("zero_area", u64::from(self.zero_area)), ("culled", u64::from(self.culled))])
            .filter(|(_, count)| *count > 0)
    }
}

impl Sink for Drawing {
    fn wants_setup(&self) -> bool {
        true
    }

    fn setup(&mut self, values: &[Unreduced]) {
        self.setup.extend_from_slice(values);
    }

    fn zero_area(&mut self) {
        self.zero_area = true;
    }

    fn culled(&mut self) {
        self.culled = true;
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.spans.push(Span { y, x0, x1 });
        self.depth.extend_from_slice(depth);
    }

    fn channel(&mut self, channel: usize, _: u32, _: u32, components: &[Vec<i64>]) {
        if self.channels.len() <= channel {
            self.channels.resize(channel + 1, Vec::new());
        }
        let places = components.first().map_or(0, Vec::len);
        let codes = (0..places).flat_map(|n| components.iter().map(move |codes| codes[n]));
        self.channels[channel].extend(codes);
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

/// The records that registers draw, kept up to a number and counted beyond it.
#[derive(Clone, Debug)]
pub struct Records {
    /// Kind and values of each.
    pub kept: Vec<(usize, Vec<i64>)>,
    /// How many were drawn.
    pub total: u64,
    most: u64,
}

impl Records {
    /// The most that an answer to somebody from outside should hold, so that a few words cannot fill
    /// the memory: 2048 x 2048 pixels.
    pub const MOST: u64 = 1 << 22;

    /// None yet, and at most so many.
    pub const fn up_to(most: u64) -> Self {
        Self { kept: Vec::new(), total: 0, most }
    }

    /// Whether every record was kept.
    pub const fn is_whole(&self) -> bool {
        self.total <= self.most
    }
}

impl Sink for Records {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn wants_records(&self) -> bool {
        true
    }

    /// Words that draw so much more than is kept are not worth their time.
    fn most_steps(&self) -> u64 {
        if self.most > Self::MOST { 1 << 28 } else { 1 << 26 }
    }

    fn record(&mut self, kind: usize, values: &[i64]) {
        self.total += 1;
        if self.is_whole() {
            self.kept.push((kind, values.to_vec()));
        }
    }
}
