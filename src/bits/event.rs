//! Where numeric events go: a sink trait, and the log that keeps counts and first places.
//! Spec clauses `V-2` and `V-3`.

use super::status::{Event, Status};

/// A pixel, in window coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Row, downward from the window's top.
    pub y: i64,
    /// Column, rightward from the window's left side.
    pub x: i64,
}

/// Smallest and largest unwrapped value seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Extent {
    /// Smallest.
    pub minimum: i128,
    /// Largest.
    pub maximum: i128,
}

/// The events of one horizontal run of samples, whichever way they were counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SpanEvents {
    /// How many samples raised each event, in the order of [`Event::ALL`].
    pub counts: [u64; 4],
    /// The first (leftmost) place of each.
    pub first: [Option<Place>; 4],
    /// Extremes of the unwrapped values; `None` for an empty run.
    pub extent: Option<Extent>,
}

impl SpanEvents {
    /// Adds one sample: the per-sample twin of the closed form.
    #[inline]
    pub fn note(&mut self, place: Place, status: Status, value: i128) {
        for event in Event::ALL {
            if status.has(event) {
                self.counts[event as usize] += 1;
                self.first[event as usize].get_or_insert(place);
            }
        }
        self.widen(Extent { minimum: value, maximum: value });
    }

    /// Adds a run that comes after this one.
    pub fn append(&mut self, later: &Self) {
        for index in 0..4 {
            self.counts[index] += later.counts[index];
            self.first[index] = self.first[index].or(later.first[index]);
        }
        if let Some(extent) = later.extent {
            self.widen(extent);
        }
    }

    /// How often `event` happened.
    pub fn count(&self, event: Event) -> u64 {
        self.counts[event as usize]
    }

    fn widen(&mut self, extent: Extent) {
        self.extent = Some(self.extent.map_or(extent, |seen| Extent {
            minimum: seen.minimum.min(extent.minimum),
            maximum: seen.maximum.max(extent.maximum),
        }));
    }
}

/// A sink of numeric events; `()` is off and costs nothing.
pub trait Events {
    /// Whether anybody listens: callers skip the counting when not.
    const ON: bool;
    /// Takes the events of a run. Runs come in drawing order.
    fn span(&mut self, events: &SpanEvents);
}

impl Events for () {
    const ON: bool = false;
    #[inline]
    fn span(&mut self, _: &SpanEvents) {}
}

/// Counts, minimum, maximum and the first place of each event. Spec clause `V-3`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EventLog {
    /// Everything seen so far.
    pub total: SpanEvents,
}

impl Events for EventLog {
    const ON: bool = true;
    #[inline]
    fn span(&mut self, events: &SpanEvents) {
        self.total.append(events);
    }
}
