//! A triangle's channels, set up, and their values along a run.

use super::{Channel, Channels};
use crate::bits::bounded;
use crate::cover::SampleGrid;
use crate::dda::Processor;
use crate::format::Unreduced;
use crate::machine::{Carried, CarriedWords, Carrier, LinearValue};
use crate::setup::{EdgeCoefficients, Triangle, edges};
use crate::value::{Correction, InverseRun, Line, Provoking, VertexValues};
use std::iter;

/// A triangle's channels, set up.
#[derive(Debug)]
pub(super) struct SetUp {
    places: Vec<Place>,
    edges: [EdgeCoefficients; 3],
    q: [i128; 3],
}

#[derive(Debug)]
struct Place {
    w: Option<Box<dyn Carried>>,
    /// By channel.
    components: Vec<Vec<Component>>,
    grid: SampleGrid,
}

#[derive(Debug)]
enum Component {
    Carried(Box<dyn Carried>),
    Flat(i128),
    Weighed([i128; 3]),
}

impl SetUp {
    /// The edge function opposite each vertex, times its 1/w.
    fn weights(&self, [x, y]: [i128; 2]) -> [i128; 3] {
        // Opposite v0 lies the edge from v1 to v2.
        let part = |k: usize, n: usize| self.edges[k].at(x, y) * self.q[n];
        [part(1, 0), part(2, 1), part(0, 2)]
    }

    pub(super) fn words(&self) -> Vec<Unreduced> {
        let mut words = Vec::new();
        for place in &self.places {
            words.extend(place.w.iter().flat_map(|w| w.setup()));
            for component in place.components.iter().flatten() {
                match component {
                    Component::Carried(carried) => words.extend(carried.setup()),
                    Component::Flat(value) => words.push(Unreduced::new(*value, 0)),
                    Component::Weighed(values) => {
                        words.extend(values.map(|value| Unreduced::new(value, 0)));
                    }
                }
            }
        }
        words
    }
}

impl Channels {
    /// Sets up the values of the channels that are wanted, and 1/w; `turned` says that two vertices have
    /// changed places.
    pub(super) fn set_up(
        &self,
        carrier: &dyn Carrier,
        triangle: &Triangle,
        values: &VertexValues,
        turned: bool,
        wanted: &dyn Fn(usize) -> bool,
    ) -> SetUp {
        let turn = |[a, b, c]: [i128; 3]| if turned { [a, c, b] } else { [a, b, c] };
        let q = values.inverse_w().map_or([1; 3], turn);
        let scale = self.scale();
        let carry = |grid: &SampleGrid, values, scale, words: &CarriedWords| {
            carrier.carry(&LinearValue { triangle, values, scale, grid }, words)
        };
        let place = |(place, grid): (usize, &SampleGrid)| {
            let w = self.w.as_ref().map(|words| carry(grid, q, 0, words));
            let components = self.list.iter().map(|channel| {
                if !channel.places.has(place) || !wanted(channel.number) {
                    return Vec::new();
                }
                let component = |given: &[i128; 3]| {
                    let values = turn(*given);
                    match channel.carries() {
                        Some(true) => {
                            let over = [0, 1, 2].map(|n| values[n] * q[n]);
                            Component::Carried(carry(grid, over, scale, &channel.words))
                        }
                        Some(false) => Component::Carried(carry(grid, values, 0, &channel.words)),
                        None => match channel.corrector.config().correction {
                            Correction::Flat { provoking: Provoking::First } => {
                                Component::Flat(given[0])
                            }
                            Correction::Flat { provoking: Provoking::Last } => {
                                Component::Flat(given[2])
                            }
                            _ => Component::Weighed(values),
                        },
                    }
                };
                let count = channel.corrector.config().components.len();
                values.components()[channel.first..][..count].iter().map(component).collect()
            });
            Place { w, components: components.collect(), grid: *grid }
        };
        SetUp {
            places: self.grids.iter().enumerate().map(place).collect(),
            edges: edges(triangle),
            q,
        }
    }
}

/// What runs of one triangle share, so that no run asks for memory.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    inverse: InverseRun,
    /// The run, the place and whether 1/w is constant, of which `inverse` is.
    of: Option<([u32; 3], usize, bool)>,
    lines: Vec<Line>,
    accumulators: Vec<i128>,
    inverses: Vec<i128>,
    coordinates: Vec<Option<[i128; 2]>>,
}

impl Channel {
    /// The codes of a run at one place, for each component.
    pub(super) fn run(
        &self,
        processor: Processor,
        (set_up, place): (&SetUp, usize),
        run: [u32; 3],
        scratch: &mut Scratch,
        out: &mut Vec<Vec<i64>>,
    ) {
        let (at, [y, x0, x1]) = (&set_up.places[place], run);
        let (length, components) = ((x1 - x0) as usize, &at.components[self.number]);
        out.resize_with(components.len(), Vec::new);
        for codes in out.iter_mut() {
            codes.resize(length, 0);
        }
        let config = self.corrector.config();
        match &components[..] {
            [Component::Carried(_), ..] => {
                let carried = components.iter().filter_map(|component| match component {
                    Component::Carried(carried) => Some(&**carried),
                    _ => None,
                });
                scratch.lines.clear();
                scratch.lines.extend(carried.clone().map_while(|value| value.line(y, x0)));
                if scratch.lines.len() < components.len() {
                    self.carried_run(carried, at, run, scratch, out);
                } else if !config.correction.walks_w() {
                    for (line, out) in scratch.lines.iter().zip(out.iter_mut()) {
                        self.corrector.affine_run(processor, *line, out);
                    }
                } else if let (Some(w), Some(read)) = (&at.w, self.corrector.w_read_out()) {
                    let constant = matches!(config.correction, Correction::ConstantW { .. });
                    if scratch.of != Some((run, place, constant)) {
                        let [mut start, mut step] = w.line(y, x0).unwrap_or_default();
                        if constant {
                            start += step * i128::from((x1 - x0 - 1) / 2);
                            step = 0;
                        }
                        scratch.inverse.begin(processor, read, [start, step], length);
                        scratch.of = Some((run, place, constant));
                    }
                    let Scratch { inverse, lines, .. } = scratch;
                    self.corrector.divided_run(processor, lines, inverse, out);
                }
            }
            [Component::Weighed(_), ..] => {
                let weights = (x0..x1).map(|x| {
                    let weights = set_up.weights(at.grid.position(x.into(), y.into()));
                    self.corrector.coordinates(weights)
                });
                scratch.coordinates.clear();
                scratch.coordinates.extend(weights);
            }
            _ => {}
        }
        for (component, out) in components.iter().zip(out.iter_mut()) {
            match component {
                Component::Flat(value) => out.fill(bounded(*value)),
                Component::Weighed(values) => {
                    for (slot, coordinates) in out.iter_mut().zip(&scratch.coordinates) {
                        *slot = self.corrector.weighed(*coordinates, *values);
                    }
                }
                Component::Carried(_) => {}
            }
        }
    }

    /// The codes of a run whose accumulators are on no line.
    fn carried_run<'a>(
        &self,
        components: impl Iterator<Item = &'a dyn Carried>,
        at: &Place,
        [y, x0, x1]: [u32; 3],
        scratch: &mut Scratch,
        out: &mut [Vec<i64>],
    ) {
        let length = (x1 - x0) as usize;
        let Scratch { accumulators, inverses, .. } = scratch;
        let correction = &self.corrector.config().correction;
        let w = at.w.as_ref().filter(|_| correction.walks_w());
        if let Some(w) = w {
            inverses.resize(length, 0);
            w.run(y, x0, inverses);
            if matches!(correction, Correction::ConstantW { .. }) {
                let middle = inverses[(length - 1) / 2];
                inverses.fill(middle);
            }
        }
        accumulators.resize(length, 0);
        for (component, out) in components.zip(out) {
            component.run(y, x0, accumulators);
            let values = accumulators.iter().zip(inverses.iter().chain(iter::repeat(&0)));
            for (slot, (over, inverse)) in out.iter_mut().zip(values) {
                *slot = match w {
                    Some(_) => self.corrector.divided(*over, *inverse),
                    None => self.corrector.affine(*over),
                };
            }
        }
    }
}
