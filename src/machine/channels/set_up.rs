//! A triangle's channels, set up, and their values along a run.

use super::words::ComponentWords;
use super::{Channel, Channels};
use crate::bits::bounded;
use crate::cover::SampleGrid;
use crate::dda::Processor;
use crate::format::Unreduced;
use crate::machine::{Accumulators, Carried, CarriedWords, Carrier, LinearValue};
use crate::setup::{EdgeCoefficients, Triangle, edges};
use crate::value::{Correction, InverseRun, Line, Provoking, VertexValues};

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
    /// The edge function opposite each vertex at pixel (x, y) of a grid, times its 1/w: only their ratios
    /// count, so parts of a sub-pixel are as good a unit.
    fn weights(&self, grid: &SampleGrid, x: u32, y: u32) -> [i128; 3] {
        let [x, y] = grid.position_in_parts(x.into(), y.into());
        let at = |edge: &EdgeCoefficients| edge.a * x + edge.b * y + edge.c * grid.parts;
        // Opposite v0 lies the edge from v1 to v2.
        let part = |k: usize, n: usize| at(&self.edges[k]) * self.q[n];
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

/// What runs of one triangle share, so that few runs ask for memory.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    inverse: InverseRun,
    /// The run, the place and whether 1/w is constant, of which `inverse` is.
    of: Option<([u32; 3], usize, bool)>,
    lines: Vec<Line>,
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
        scratch.lines.clear();
        if matches!(components[..], [Component::Weighed(_), ..]) {
            let weights = (x0..x1).map(|x| {
                let weights = set_up.weights(&at.grid, x, y);
                self.corrector.coordinates(weights)
            });
            scratch.coordinates.clear();
            scratch.coordinates.extend(weights);
        }
        for (component, out) in components.iter().zip(out.iter_mut()) {
            match component {
                Component::Flat(value) => out.fill(bounded(*value)),
                Component::Weighed(values) => {
                    for (slot, coordinates) in out.iter_mut().zip(&scratch.coordinates) {
                        *slot = self.corrector.weighed(*coordinates, *values);
                    }
                }
                Component::Carried(carried) => match carried.run(y, x0, length) {
                    Accumulators::Line(line) => scratch.lines.push(line),
                    Accumulators::Each(over) => self.each(at, run, &over, out),
                },
            }
        }
        if !scratch.lines.is_empty() {
            self.along_lines(processor, (at, place), run, scratch, out);
        }
    }

    /// The codes of components whose accumulators are on straight lines.
    fn along_lines(
        &self,
        processor: Processor,
        (at, place): (&Place, usize),
        run: [u32; 3],
        scratch: &mut Scratch,
        out: &mut [Vec<i64>],
    ) {
        let [y, x0, x1] = run;
        let length = (x1 - x0) as usize;
        let Scratch { inverse, of, lines, .. } = scratch;
        let (Some(w), Some(read)) = (self.inverse(at), self.corrector.w_read_out()) else {
            for (line, out) in lines.iter().zip(out) {
                self.corrector.affine_run(processor, *line, out);
            }
            return;
        };
        let constant = self.is_constant();
        if *of != Some((run, place, constant)) {
            let Accumulators::Line([mut start, mut step]) = w.run(y, x0, length) else {
                unreachable!("1/w is carried as u/w is")
            };
            if constant {
                start += step * i128::from((x1 - x0 - 1) / 2);
                step = 0;
            }
            inverse.begin(processor, read, [start, step], length);
            *of = Some((run, place, constant));
        }
        self.corrector.divided_run(processor, lines, inverse, out);
    }

    /// The codes of a component whose accumulators are given one by one.
    fn each(&self, at: &Place, [y, x0, _]: [u32; 3], over: &[i128], out: &mut [i64]) {
        let Some(w) = self.inverse(at) else {
            for (slot, over) in out.iter_mut().zip(over) {
                *slot = self.corrector.affine(*over);
            }
            return;
        };
        let Accumulators::Each(inverse) = w.run(y, x0, over.len()) else {
            unreachable!("1/w is carried as u/w is")
        };
        let middle = self.is_constant().then(|| inverse[(over.len() - 1) / 2]);
        for ((slot, over), inverse) in out.iter_mut().zip(over).zip(inverse) {
            *slot = self.corrector.divided(*over, middle.unwrap_or(inverse));
        }
    }

    /// 1/w, where the channel is divided by it.
    fn inverse<'a>(&self, at: &'a Place) -> Option<&'a dyn Carried> {
        let walks = self.corrector.config().correction.walks_w();
        at.w.as_deref().filter(|_| walks)
    }

    fn is_constant(&self) -> bool {
        matches!(self.corrector.config().correction, Correction::ConstantW { .. })
    }

    /// What is behind the code of each component at pixel x of a run.
    pub(super) fn words(
        &self,
        (set_up, place): (&SetUp, usize),
        [y, x0, x1]: [u32; 3],
        x: u32,
    ) -> Vec<ComponentWords> {
        let (at, length) = (&set_up.places[place], (x1 - x0) as usize);
        let value = |carried: &dyn Carried, x: u32| match carried.run(y, x0, length) {
            Accumulators::Line([start, step]) => start + step * i128::from(x - x0),
            Accumulators::Each(all) => all[(x - x0) as usize],
        };
        let middle = x0 + (x1 - x0 - 1) / 2;
        let w = self.inverse(at).map(|w| value(w, if self.is_constant() { middle } else { x }));
        let words = |component: &Component| match component {
            Component::Flat(_) => ComponentWords::Flat,
            Component::Weighed(_) => {
                let weights = set_up.weights(&at.grid, x, y);
                ComponentWords::Weighed(self.corrector.coordinates(weights))
            }
            Component::Carried(carried) => {
                let over = value(&**carried, x);
                w.map_or(ComponentWords::Affine(over), |w| ComponentWords::Divided([over, w]))
            }
        };
        at.components[self.number].iter().map(words).collect()
    }
}
