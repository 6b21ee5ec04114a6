//! The words behind a channel's codes at one sample, to be shown: the same accumulators and coordinates that
//! the codes are made of. Spec clauses `CH-2` to `CH-7`.

use super::{Channels, Places, is_drawn};
use crate::format::ReadOut;
use crate::machine::{Input, Machine, Sink};
use crate::setup::{Snapped, Triangle};
use crate::value::{Corrector, VertexValues};

/// What a component's code is made of at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentWords {
    /// The code of a vertex.
    Flat,
    /// The coordinates of vertices 1 and 2; `None` where 1/w has come to zero.
    Weighed(Option<[i128; 2]>),
    /// The unwrapped accumulator.
    Affine(i128),
    /// The unwrapped accumulators of u/w and of 1/w.
    Divided([i128; 2]),
}

/// Finds the run of a pixel.
struct Find {
    pixel: [u32; 2],
    run: Option<[u32; 3]>,
    mask: u32,
    /// Whether the run just given is the one.
    open: bool,
}

impl Sink for Find {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        let [x, wanted] = self.pixel;
        self.open = y == wanted && (x0..x1).contains(&x);
        if self.open {
            self.run = Some([y, x0, x1]);
        }
    }

    fn masks(&mut self, _: u32, x0: u32, masks: &[u32]) {
        if self.open {
            self.mask = masks[(self.pixel[0] - x0) as usize];
        }
    }
}

impl Channels {
    /// The words of each component of channel `number` at a covered sample of pixel (x, y); `sample` is
    /// needed where a pixel has a code a sample. `None` if no code is drawn there.
    ///
    /// The triangle is drawn for each call: this is for a person who looks at a row, not for a loop.
    pub fn words(
        &self,
        (machine, triangle): (&dyn Machine, &Snapped<Triangle>),
        values: &VertexValues,
        number: usize,
        (pixel, sample): ([u32; 2], Option<u32>),
    ) -> Option<Vec<ComponentWords>> {
        let normalised = triangle.normalised();
        if !is_drawn(machine, &normalised) || !self.takes(values) {
            return None;
        }
        let mut find = Find { pixel, run: None, mask: 0, open: false };
        machine.draw(&Input::Triangle(triangle), &mut find).ok()?;
        let channel = self.list.get(number)?;
        let place = match channel.places {
            Places::One(place) => place,
            Places::Samples { samples, .. } => samples + sample? as usize,
            Places::Centroid { centre, samples, count } => {
                self.centroid(find.mask, (centre, samples, count))
            }
        };
        let turned = triangle.area2() < 0;
        let set_up = self.set_up(machine.carrier()?, &normalised, values, turned, &|n| n == number);
        Some(channel.words((&set_up, place), find.run?, pixel[0]))
    }

    /// The accumulator of 1/w, where a channel walks it.
    pub fn w_read_out(&self) -> Option<ReadOut> {
        self.w.map(|words| words.read)
    }

    /// What makes the codes of channel `number` of its accumulators.
    pub fn corrector(&self, number: usize) -> Option<&Corrector> {
        self.list.get(number).map(|channel| &channel.corrector)
    }
    /// The accumulator that a set-up column of start and slopes is for.
    pub fn accumulator(&self, column: &str) -> Option<ReadOut> {
        let of = |name: &str| {
            let rest = column.strip_prefix(name)?;
            ["_init", "_dx", "_dy"].iter().any(|what| rest.starts_with(what)).then_some(())
        };
        let w = self.w_read_out().filter(|_| of("w").is_some());
        let mut carried = self.list.iter().filter(|channel| channel.carries().is_some());
        w.or_else(|| {
            carried.find_map(|channel| {
                let config = channel.corrector.config();
                let mut names =
                    config.components.iter().map(|part| format!("{}_{part}", config.name));
                names.find_map(|name| of(&name)).map(|()| channel.words.read)
            })
        })
    }
}
