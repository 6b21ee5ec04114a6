//! The sink between a machine and what it draws to: it adds the channels.

use super::set_up::SetUp;
use super::{Channels, Places};
use crate::bits::SpanEvents;
use crate::format::Unreduced;
use crate::machine::{Sink, Work};

/// Adds the channels to what a machine draws.
pub(super) struct ChannelSink<'a> {
    pub(super) channels: &'a Channels,
    pub(super) set_up: Option<SetUp>,
    pub(super) out: &'a mut dyn Sink,
    /// The run whose masks have not come yet.
    pub(super) open: Option<[u32; 3]>,
}

impl ChannelSink<'_> {
    fn needs_masks(places: Places) -> bool {
        !matches!(places, Places::One(_))
    }

    /// The values of one run, of the channels that need masks or of the others.
    fn run(&mut self, run: [u32; 3], masks: Option<&[u32]>) {
        let Some(set_up) = &self.set_up else { return };
        for (n, channel) in self.channels.list.iter().enumerate() {
            if Self::needs_masks(channel.places) != masks.is_some() {
                continue;
            }
            let at = |place: usize| channel.run(n, set_up, place, run);
            let width = channel.corrector.config().components.len();
            let values = match (channel.places, masks) {
                (Places::One(place), _) => at(place),
                (Places::Samples { samples, count }, Some(masks)) => {
                    let by_sample: Vec<_> = (samples..samples + count as usize).map(at).collect();
                    let mut values = Vec::new();
                    for (pixel, mask) in masks.iter().enumerate() {
                        for (_, own) in
                            by_sample.iter().enumerate().filter(|(n, _)| mask >> n & 1 == 1)
                        {
                            values.extend_from_slice(&own[pixel * width..][..width]);
                        }
                    }
                    values
                }
                (Places::Centroid { centre, samples, count }, Some(masks)) => {
                    let grids = &self.channels.grids;
                    let chosen = |mask: u32| {
                        if mask.count_ones() == count {
                            return centre;
                        }
                        let middle = grids[centre].offset;
                        let far = |n: &u32| {
                            let offset = grids[samples + *n as usize].offset;
                            (0..2).map(|axis| (offset[axis] - middle[axis]).pow(2)).sum::<i128>()
                        };
                        let covered = (0..count).filter(|n| mask >> n & 1 == 1);
                        samples + covered.min_by_key(far).unwrap_or_default() as usize
                    };
                    let mut known: Vec<Option<Vec<i64>>> = vec![None; grids.len()];
                    let mut values = Vec::new();
                    for (pixel, mask) in masks.iter().enumerate() {
                        let place = chosen(*mask);
                        let own = known[place].get_or_insert_with(|| at(place));
                        values.extend_from_slice(&own[pixel * width..][..width]);
                    }
                    values
                }
                _ => continue,
            };
            self.out.channel(n, run[0], run[1], &values);
        }
    }
}

impl Sink for ChannelSink<'_> {
    fn wants_setup(&self) -> bool {
        self.out.wants_setup()
    }

    fn setup(&mut self, values: &[Unreduced]) {
        let mut values = values.to_vec();
        if let Some(set_up) = &self.set_up {
            values.extend(set_up.words());
        } else {
            let columns = self.channels.columns.iter();
            values.extend(columns.map(|column| Unreduced::new(0, column.fraction)));
        }
        self.out.setup(&values);
    }

    fn zero_area(&mut self) {
        self.out.zero_area();
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.out.span(y, x0, x1, depth);
        self.open = Some([y, x0, x1]);
        self.run([y, x0, x1], None);
    }

    fn masks(&mut self, y: u32, x0: u32, masks: &[u32]) {
        self.out.masks(y, x0, masks);
        if let Some(run) = self.open.take() {
            self.run(run, Some(masks));
        }
    }

    fn wants_events(&self) -> bool {
        self.out.wants_events()
    }

    fn events(&mut self, events: &SpanEvents) {
        self.out.events(events);
    }

    fn wants_held(&self) -> bool {
        self.out.wants_held()
    }

    fn held(&mut self, y: u32, x0: u32, accumulators: &[i128]) {
        self.out.held(y, x0, accumulators);
    }

    fn wants_records(&self) -> bool {
        self.out.wants_records()
    }

    fn record(&mut self, kind: usize, values: &[i64]) {
        self.out.record(kind, values);
    }

    fn work(&mut self, work: &Work) {
        self.out.work(work);
    }
}
