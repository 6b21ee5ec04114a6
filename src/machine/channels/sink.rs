//! The sink between a machine and what it draws to: it adds the channels.

use super::set_up::{Scratch, SetUp};
use super::{Channels, Places};
use crate::bits::SpanEvents;
use crate::cover::SampleGrid;
use crate::format::Unreduced;
use crate::machine::{Sink, Work};

/// Adds the channels to what a machine draws.
pub(super) struct ChannelSink<'a> {
    pub(super) channels: &'a Channels,
    pub(super) set_up: Option<SetUp>,
    pub(super) out: &'a mut dyn Sink,
    /// The run whose masks have not come yet.
    pub(super) open: Option<[u32; 3]>,
    pub(super) buffers: Buffers,
}

/// Codes on their way.
#[derive(Debug, Default)]
pub(super) struct Buffers {
    scratch: Scratch,
    /// By place, then component.
    at: Vec<Vec<Vec<i64>>>,
    /// By place: whether those of this run are there.
    known: Vec<bool>,
    /// Those that leave, by component.
    chosen: Vec<Vec<i64>>,
}

impl ChannelSink<'_> {
    fn needs_masks(places: Places) -> bool {
        !matches!(places, Places::One(_))
    }

    /// The values of one run, of the channels that need masks or of the others.
    fn run(&mut self, run: [u32; 3], masks: Option<&[u32]>) {
        let Some(set_up) = &self.set_up else { return };
        let Buffers { scratch, at, known, chosen } = &mut self.buffers;
        at.resize_with(self.channels.grids.len(), Vec::new);
        for (number, channel) in self.channels.list.iter().enumerate() {
            if Self::needs_masks(channel.places) != masks.is_some() {
                continue;
            }
            let mut fill = |place: usize, out: &mut Vec<Vec<i64>>| {
                let processor = self.channels.processor;
                channel.run(processor, (set_up, place), run, scratch, out);
            };
            let width = channel.corrector.config().components.len();
            chosen.resize_with(width, Vec::new);
            if masks.is_some() {
                chosen.iter_mut().for_each(Vec::clear);
            }
            match (channel.places, masks) {
                (Places::One(place), _) => fill(place, chosen),
                (Places::Samples { samples, count }, Some(masks)) => {
                    let samples = samples..samples + count as usize;
                    for (codes, place) in at[samples.clone()].iter_mut().zip(samples.clone()) {
                        fill(place, codes);
                    }
                    let at = &at[samples];
                    for (pixel, mask) in masks.iter().enumerate() {
                        let own = at.iter().enumerate().filter(|(n, _)| mask >> n & 1 == 1);
                        own.for_each(|(_, codes)| take(chosen, codes, pixel));
                    }
                }
                (Places::Centroid { centre, samples, count }, Some(masks)) => {
                    known.clear();
                    known.resize(at.len(), false);
                    for (pixel, mask) in masks.iter().enumerate() {
                        let place = self.channels.centroid(*mask, (centre, samples, count));
                        if !known[place] {
                            fill(place, &mut at[place]);
                            known[place] = true;
                        }
                        take(chosen, &at[place], pixel);
                    }
                }
                _ => continue,
            }
            self.out.channel(number, run[0], run[1], chosen);
        }
    }
}

/// Adds the codes of a pixel.
fn take(to: &mut [Vec<i64>], from: &[Vec<i64>], pixel: usize) {
    to.iter_mut().zip(from).for_each(|(to, from)| to.push(from[pixel]));
}

impl Channels {
    /// The place of a pixel that is evaluated at its centroid. Spec clause `CH-7`.
    pub(super) fn centroid(
        &self,
        mask: u32,
        (centre, samples, count): (usize, usize, u32),
    ) -> usize {
        if mask.count_ones() == count {
            return centre;
        }
        // A unit that holds every place whole.
        let unit = SampleGrid::common_parts(&self.grids);
        let middle = self.grids[centre].offset;
        let far = |n: &u32| {
            let grid = &self.grids[samples + *n as usize];
            let apart = |axis: usize| {
                (grid.offset[axis] - middle[axis]) * unit + grid.part[axis] * (unit / grid.parts)
            };
            (0..2).map(|axis| apart(axis).pow(2)).sum::<i128>()
        };
        let covered = (0..count).filter(|n| mask >> n & 1 == 1);
        samples + covered.min_by_key(far).unwrap_or_default() as usize
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
