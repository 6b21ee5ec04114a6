//! Where a figure comes from: the triangle and the sample behind it.

use super::drawn::Drawn;
use super::inspect::{Inspector, Value};
use super::order;
use super::reference::Truth;
use super::run::{Side, compare};
use super::stage::{Face, Stage, Surface};
use crate::bits::Event;
use crate::measure::error::SampleError;
use crate::profile::Profile;
use std::cmp::Ordering;

/// A sample, the triangle that matters there, and what happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The triangle's place in the scene, from 0.
    pub triangle: usize,
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// What happened there.
    pub what: What,
}

/// What happened at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum What {
    /// It should be covered.
    Missing,
    /// It should not be covered.
    Extra,
    /// A value is off by so many ULP.
    Ulp(f64),
    /// An event was raised.
    Event(Event),
    /// It comes before a surface that it should be behind, or is level with one that it is not
    /// level with: the place of that other triangle.
    Order(Ordering, usize),
}

fn surface(face: &Face, value: Value) -> Option<&Surface> {
    match value {
        Value::Depth => face.depth.as_ref(),
        Value::Attribute => face.attribute.as_ref(),
    }
}

/// Keeps the largest of what it is shown.
struct Largest(Option<(f64, Place)>);

impl Largest {
    fn show(&mut self, size: f64, triangle: usize, [x, y]: [u32; 2], ulp: f64) {
        if self.0.is_none_or(|(largest, _)| size > largest) {
            self.0 = Some((size, Place { triangle, x, y, what: What::Ulp(ulp) }));
        }
    }

    fn place(self) -> Option<Place> {
        self.0.map(|(_, place)| place)
    }
}

impl Stage {
    fn weigh(&self, ulp: f64, surface: &Surface, [x, y]: [u32; 2], value: Value) -> f64 {
        match value {
            Value::Depth => self.world.depth(ulp, surface.code.at(x, y) / self.world.top).abs(),
            Value::Attribute => ulp.abs(),
        }
    }

    /// Where a profile's arithmetic puts a value off furthest, in ULP or as a distance.
    pub fn worst(&self, profile: &Profile, value: Value, as_distance: bool) -> Option<Place> {
        let (inspector, mut largest) = (Inspector::new(self, profile).ok()?, Largest(None));
        for face in &self.faces {
            let Some(surface) = surface(face, value) else { continue };
            inspector.face(face, value, |x, y, error| {
                if let SampleError::Depth(ulp) = error {
                    let distance = || self.weigh(ulp, surface, [x, y], value);
                    let size = if as_distance { distance() } else { ulp.abs() };
                    largest.show(size, face.source, [x, y], ulp);
                }
            });
        }
        largest.place()
    }

    /// The first sample that a profile draws and should not, or the other way round.
    pub fn misclassified(&self, profile: &Profile) -> Option<Place> {
        let inspector = Inspector::new(self, profile).ok()?;
        let (mut wrong, mut first) = (None, None);
        Drawn::until(self, profile, &mut |n, tally| {
            let good = tally.missing + tally.extra == 0;
            wrong = (!good).then(|| &self.faces[n]);
            good
        })
        .ok()?
        .err()?;
        let face = wrong?;
        inspector.face(face, Value::Depth, |x, y, error| {
            let what = match error {
                SampleError::Missing => What::Missing,
                SampleError::Extra => What::Extra,
                SampleError::Depth(_) => return,
            };
            first.get_or_insert(Place { triangle: face.source, x, y, what });
        });
        first
    }

    /// The first sample whose depth raises an event.
    pub fn raised(&self, profile: &Profile, event: Event) -> Option<Place> {
        let depth = super::depth_of(profile)?;
        self.faces.iter().find_map(|face| {
            let surface = face.depth.as_ref()?;
            let plane = depth.plane(&face.triangle, surface.vertex, &self.grid);
            self.runs[face.runs.clone()].iter().find_map(|run| {
                let events = depth.events(&plane, run.y, run.x0, run.x1 - run.x0);
                let place = events.first[event as usize]?;
                let x = u32::try_from(place.x).ok()?;
                Some(Place { triangle: face.source, x, y: run.y, what: What::Event(event) })
            })
        })
    }

    /// The closest pair that a profile exchanges (`Greater`) or makes level (`Equal`).
    pub fn broken(&self, profile: &Profile, wanted: Ordering) -> Option<Place> {
        let depth = super::depth_of(profile)?;
        let pair = order::pairs_in_order(self, &depth, &self.pairs)
            .find(|(_, order, _)| *order == wanted)
            .map(|(pair, ..)| pair)?;
        Some(self.pair_place(pair, wanted))
    }

    fn pair_place(&self, pair: &order::Pair, found: Ordering) -> Place {
        let source = |face: u32| self.faces[face as usize].source;
        let what = What::Order(found, source(pair.far));
        Place { triangle: source(pair.near), x: pair.x, y: pair.y, what }
    }

    /// The closest pair that snapping exchanged (`Greater`), or two that it made level (`Equal`).
    pub fn exchanged(&self, wanted: Ordering) -> Option<Place> {
        let before = |pair: &&order::Pair| {
            order::before_snapping(self, [pair.x, pair.y], [pair.near, pair.far]) == Some(wanted)
        };
        let pair = match wanted {
            Ordering::Equal => self.levelled.as_ref(),
            _ => self.pairs.iter().find(before),
        };
        pair.map(|pair| self.pair_place(pair, wanted))
    }

    /// Where snapping moved a value furthest, in ULP or as a distance.
    pub fn moved(&self, truth: &Truth, value: Value, as_distance: bool) -> Option<Place> {
        let mut largest = Largest(None);
        for face in &self.faces {
            let Some(surface) = surface(face, value) else { continue };
            let Some(before) = surface.before else { continue };
            let moved = surface.code.minus(before);
            compare(truth.runs(face.source), &self.runs[face.runs.clone()], |side, run| {
                if side != Side::Both {
                    return;
                }
                for x in run.x0..run.x1 {
                    let ulp = moved.at(x, run.y);
                    let distance = || self.weigh(ulp, surface, [x, run.y], value);
                    let size = if as_distance { distance() } else { ulp.abs() };
                    largest.show(size, face.source, [x, run.y], ulp);
                }
            });
        }
        largest.place()
    }

    /// The first sample that snapping won or lost.
    pub fn displaced(&self, truth: &Truth) -> Option<Place> {
        self.faces.iter().find_map(|face| {
            let mut first = None;
            compare(truth.runs(face.source), &self.runs[face.runs.clone()], |side, run| {
                let what = match side {
                    Side::Both => return,
                    Side::Missing => What::Missing,
                    Side::Extra => What::Extra,
                };
                first.get_or_insert(Place { triangle: face.source, x: run.x0, y: run.y, what });
            });
            first
        })
    }
}
