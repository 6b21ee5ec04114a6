//! A drawing that ends where an answer does: a short line must not fill the memory.

use guardbit::bits::SpanEvents;
use guardbit::machine::Sink;
use guardbit::model::Drawing;

/// The most numbers of an answer without `--limit`: a triangle of half a window of 4096 x 4096, with depth.
pub(super) const NUMBERS: u64 = 1 << 24;

/// Keeps up to so many numbers, and counts the rest: three a run, and one a depth, code and mask.
pub(super) struct Limited<'a> {
    drawing: &'a mut Drawing,
    most: u64,
    numbers: u64,
}

impl<'a> Limited<'a> {
    pub(super) fn new(drawing: &'a mut Drawing, most: u64) -> Self {
        Self { drawing, most, numbers: 0 }
    }

    /// Refuses an answer that is too long.
    pub(super) fn check(&self) -> Result<(), String> {
        let Self { most, numbers, .. } = self;
        if numbers > most {
            return Err(format!(
                "the answer has {numbers} numbers, but at most {most} are allowed; --limit N allows more"
            ));
        }
        Ok(())
    }

    /// Counts, and says whether these are still kept.
    fn keep(&mut self, numbers: usize) -> bool {
        self.numbers += numbers as u64;
        self.numbers <= self.most
    }
}

impl Sink for Limited<'_> {
    fn zero_area(&mut self) {
        self.drawing.zero_area();
    }

    fn culled(&mut self) {
        self.drawing.culled();
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        if self.keep(3 + depth.len()) {
            self.drawing.span(y, x0, x1, depth);
        }
    }

    fn channel(&mut self, channel: usize, y: u32, x0: u32, components: &[Vec<i64>]) {
        if self.keep(components.iter().map(Vec::len).sum()) {
            self.drawing.channel(channel, y, x0, components);
        }
    }

    fn masks(&mut self, y: u32, x0: u32, masks: &[u32]) {
        if self.keep(masks.len()) {
            self.drawing.masks(y, x0, masks);
        }
    }

    fn wants_events(&self) -> bool {
        true
    }

    fn events(&mut self, events: &SpanEvents) {
        self.drawing.events(events);
    }
}
