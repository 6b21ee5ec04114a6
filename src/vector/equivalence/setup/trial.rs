//! The words of triangles in a module's netlist, beside those of the model.

use super::Output;
use crate::model::Model;
use crate::setup::{Gradient, Triangle};
use crate::vector::bench::ready;
use crate::vector::device::setup_words;
use crate::vector::equivalence::clauses::Want;
use crate::vector::equivalence::netlist::Flat;
use crate::vector::equivalence::simulate::Simulation;
use crate::vector::equivalence::{Asked, Counterexample, Differing, EquivalenceError};
use crate::vector::reference::triangles;
use num_bigint::BigInt;
use num_traits::One;

/// Clocks after which vertices that stand still have come through a module.
pub(super) const CLOCKS: u32 = 400;
/// Triangles at the corners of the field and of a sub-pixel or two: three of six places, twice.
pub(super) const CORNERS: usize = 2 * 6 * 6 * 6;
/// Triangles that go through it one after the other.
const RECORDS: usize = 4;

/// A module's outputs, and the model they are compared with.
pub(super) struct Trial<'a> {
    asked: &'a Asked<'a>,
    outputs: &'a [Output<'a>],
    model: Model,
}

impl<'a> Trial<'a> {
    pub(super) fn new(asked: &'a Asked<'a>, outputs: &'a [Output<'a>]) -> Self {
        Self { asked, outputs, model: ready(asked.profile, false) }
    }

    fn triangles(&self, count: usize) -> Vec<Triangle> {
        triangles(self.asked.profile, self.asked.devices, count as u64)
    }

    /// Words for a triangle that are not the model's, with registers as wires.
    pub(super) fn differing(
        &self,
        flat: &Flat,
        cases: usize,
    ) -> Result<Option<Counterexample>, EquivalenceError> {
        let mut simulation = Simulation::new(flat);
        for triangle in self.triangles(cases).into_iter().chain(self.corners()) {
            let reset = self.reset(false);
            simulation.set(self.inputs(&triangle).chain(reset));
            let words = self.words(flat, &mut simulation, &triangle)?;
            if !words.is_empty() {
                return Ok(Some(Counterexample { triangle, words }));
            }
        }
        Ok(None)
    }

    /// Whether triangles come through the registers, each one standing before them until its words are there.
    pub(super) fn flows(&self, flat: &Flat) -> Result<bool, EquivalenceError> {
        let mut simulation = Simulation::new(flat).clocked();
        let known = |name: &str| {
            let constants = self.asked.map.constants.contains_key(name);
            constants
                || self.asked.wiring.clock.as_deref() == Some(name)
                || self.asked.map.ports.values().any(|port| port == name)
        };
        let free = flat
            .ports
            .iter()
            .filter(|(name, port)| !port.output && port.bits.len() == 1 && !known(name));
        // A valid or a ready that nothing is said of is high.
        let free: Vec<(&str, i128)> = free.map(|(name, _)| (name.as_str(), 1)).collect();
        simulation.set(free.iter().copied().chain(self.reset(true)));
        simulation.clock();
        for triangle in self.triangles(RECORDS) {
            let mut came = false;
            for _ in 0..CLOCKS {
                let free = free.iter().copied();
                simulation.set(free.chain(self.inputs(&triangle)).chain(self.reset(false)));
                came = self.words(flat, &mut simulation, &triangle)?.is_empty();
                if came {
                    break;
                }
                simulation.clock();
            }
            if !came {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn reset(&self, active: bool) -> impl Iterator<Item = (&str, i128)> {
        let level = move |low: bool| i128::from(low != active);
        self.asked.map.reset.iter().map(move |reset| (reset.port.as_str(), level(reset.active_low)))
    }

    /// A triangle at the module's inputs.
    fn inputs(&self, triangle: &Triangle) -> impl Iterator<Item = (&str, i128)> {
        let numbers = triangle.xy.into_iter().zip(triangle.z.unwrap_or_default()).enumerate();
        let numbers = numbers.flat_map(|(k, ([x, y], z))| {
            [(format!("v{k}_x"), x), (format!("v{k}_y"), y), (format!("v{k}_z"), z)]
        });
        let ports = numbers
            .filter_map(|(name, value)| Some((self.asked.map.ports.get(&name)?.as_str(), value)));
        let constants = self.asked.map.constants.iter();
        ports.chain(constants.map(|(port, value)| (port.as_str(), i128::from(*value))))
    }

    /// The outputs that are not the model's.
    fn words(
        &self,
        flat: &Flat,
        simulation: &mut Simulation<'_>,
        triangle: &Triangle,
    ) -> Result<Vec<Differing>, EquivalenceError> {
        let known = self.model_words(triangle);
        let mut words = Vec::new();
        for Output { want: Want { name, .. }, port, .. } in self.outputs {
            let got = flat.wire(port).and_then(|bits| Some((bits.len(), simulation.number(bits)?)));
            let (width, got) =
                got.ok_or_else(|| self.asked.design(format!("{name}: a bit of it has no value")))?;
            let Some((_, want)) = known.iter().find(|(known, _)| known == name) else { continue };
            let want = want & ((BigInt::one() << width) - 1u32);
            if got != want {
                words.push(Differing { name, got, want });
            }
        }
        Ok(words)
    }

    /// What the model says of a triangle's words; where there is no area, numerators may be anything.
    fn model_words(&self, triangle: &Triangle) -> Vec<(&'static str, BigInt)> {
        const EDGES: [&str; 9] = [
            "edge0_init",
            "edge0_dx",
            "edge0_dy",
            "edge1_init",
            "edge1_dx",
            "edge1_dy",
            "edge2_init",
            "edge2_dx",
            "edge2_dy",
        ];
        let words = setup_words(&self.model, triangle);
        let mut list: Vec<_> =
            EDGES.into_iter().zip(words.iter().map(|word| BigInt::from(*word))).collect();
        list.extend(words.last().map(|flag| ("zero_area", BigInt::from(*flag))));
        let normalised = triangle.normalised();
        if let Some(z) = normalised.z.filter(|_| triangle.area2() != 0) {
            let Gradient { x, y, area2, anchor: ([x0, y0], z0) } = Gradient::new(&normalised, z);
            let [at_x, at_y] = self.asked.devices.setup.sample;
            let start = BigInt::from(z0) * area2
                + BigInt::from(x) * (at_x - x0)
                + BigInt::from(y) * (at_y - y0);
            list.extend([
                ("area", area2.into()),
                ("plane_x", x.into()),
                ("plane_y", y.into()),
                ("plane_start", start),
            ]);
        }
        list
    }

    /// Triangles of the ends of the field and their neighbours, and of a sub-pixel or two: where a word is one bit
    /// short, and where an area is 1.
    fn corners(&self) -> impl Iterator<Item = Triangle> {
        let (low, high) = self.asked.profile.vertex.range();
        let most = (1i128 << self.asked.devices.depth.integer) - 1;
        let middle = low + (high - low) / 2;
        let ends = [
            [low, low],
            [high, low],
            [low, high],
            [high, high],
            [high - 1, low + 1],
            [middle, high],
        ];
        let near = [[0, 0], [1, 0], [0, 1], [1, 1], [2, 1], [1, 3]]
            .map(|step: [i128; 2]| step.map(|d| (middle + d).min(high)));
        let sets = [ends, near];
        (0..CORNERS).map(move |n| {
            let set = sets[usize::from(n >= 216)];
            let xy = [set[n % 6], set[n / 6 % 6], set[n / 36 % 6]];
            let z = [0, 1, 2].map(|k| if n >> k & 1 == 1 { most } else { 0 });
            Triangle { xy, z: Some(z) }
        })
    }
}
