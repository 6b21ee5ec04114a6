//! A triangle's channels, set up, and their values along a run.

use super::{Channel, Channels};
use crate::bits::bounded;
use crate::cover::SampleGrid;
use crate::format::Unreduced;
use crate::machine::{Carried, CarriedWords, Carrier, LinearValue};
use crate::setup::{EdgeCoefficients, Triangle, edges};
use crate::value::{Correction, Provoking, VertexValues};

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
    /// Sets all values up; `turned` says that two vertices have changed places.
    pub(super) fn set_up(
        &self,
        carrier: &dyn Carrier,
        triangle: &Triangle,
        values: &VertexValues,
        turned: bool,
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
                if !channel.places.has(place) {
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

impl Channel {
    /// The values of a run at one place, component by component in each pixel.
    pub(super) fn run(
        &self,
        number: usize,
        set_up: &SetUp,
        place: usize,
        [y, x0, x1]: [u32; 3],
    ) -> Vec<i64> {
        let at = &set_up.places[place];
        let (length, components) = ((x1 - x0) as usize, &at.components[number]);
        let mut out = vec![0; length * components.len()];
        let mut accumulators = vec![0; length];
        let mut inverse = Vec::new();
        if let Some(w) = at.w.as_ref().filter(|_| self.corrector.config().correction.walks_w()) {
            inverse.resize(length, 0);
            w.run(y, x0, &mut inverse);
            if matches!(self.corrector.config().correction, Correction::ConstantW { .. }) {
                let middle = inverse[(length - 1) / 2];
                inverse.fill(middle);
            }
        }
        for (n, component) in components.iter().enumerate() {
            let slots = out.iter_mut().skip(n).step_by(components.len());
            match component {
                Component::Flat(value) => slots.for_each(|slot| *slot = bounded(*value)),
                Component::Weighed(values) => {
                    for (slot, x) in slots.zip(x0..) {
                        let weights = set_up.weights(at.grid.position(x.into(), y.into()));
                        *slot = self.corrector.weighed(weights, *values);
                    }
                }
                Component::Carried(carried) => {
                    carried.run(y, x0, &mut accumulators);
                    if inverse.is_empty() {
                        let values = accumulators.iter().map(|value| self.corrector.affine(*value));
                        slots.zip(values).for_each(|(slot, value)| *slot = value);
                    } else {
                        for ((slot, over), w) in slots.zip(&accumulators).zip(&inverse) {
                            *slot = self.corrector.divided(*over, *w);
                        }
                    }
                }
            }
        }
        out
    }
}
