//! What machines share once a run of samples is found: values, read-out and events.

use super::{DrawError, Sink, Target};
use crate::bits::{Event, Place, SpanEvents, bounded};
use crate::format::{Clamp, ReadOut, Unreduced};
use crate::setup::{Plane, Triangle};
use crate::value::Depth;

/// The normalised triangle, or `None` after reporting that it has no area. Spec clause `T-3`.
pub fn drawable(triangle: &Triangle, out: &mut dyn Sink) -> Option<Triangle> {
    let triangle = triangle.normalised();
    if triangle.area2() == 0 {
        out.zero_area();
        return None;
    }
    Some(triangle)
}

/// Values and events of the spans of one triangle, where depth is a plane.
#[derive(Debug)]
pub struct Painter<'a> {
    depth: Option<(&'a Depth, Option<Plane>)>,
    values: Vec<u64>,
}

impl<'a> Painter<'a> {
    /// The painter of a normalised triangle on a machine with this depth evaluator, or without one.
    pub fn new(depth: Option<&'a Depth>, triangle: &Triangle, target: &Target) -> Self {
        Self::over(depth, |depth| Some(depth.plane(triangle, triangle.z?, &target.grid)))
    }

    /// A painter of a plane that the machine sets up by other means; `None` for a primitive without depth.
    pub(super) fn over(
        depth: Option<&'a Depth>,
        plane: impl FnOnce(&Depth) -> Option<Plane>,
    ) -> Self {
        Self { depth: depth.map(|depth| (depth, plane(depth))), values: Vec::new() }
    }

    /// Hands the set-up values to a sink that wants them, in the order of [`super::Ports::triangle`]: those
    /// of coverage, and on a machine with depth those of depth; a triangle without depth has zeros there.
    pub fn announce(&self, coverage: impl FnOnce() -> Vec<Unreduced>, out: &mut dyn Sink) {
        if !out.wants_setup() {
            return;
        }
        let mut values = coverage();
        if let Some((depth, plane)) = &self.depth {
            let zero = Plane::zero(depth.read_out().fraction());
            values.extend(plane.as_ref().unwrap_or(&zero).values());
        }
        out.setup(&values);
    }

    /// Draws the covered samples `[x0, x1)` of row y: values, read-out and events.
    ///
    /// # Errors
    /// [`DrawError::GuardRange`] under the clamp mode `error`.
    pub fn span(&mut self, y: u32, x0: u32, x1: u32, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some((depth, Some(plane))) = &self.depth else {
            out.span(y, x0, x1, &[]);
            return Ok(());
        };
        let strict = depth.read_out().clamp() == Clamp::Error;
        if strict || out.wants_events() {
            report(depth.read_out(), depth.events(plane, y, x0, x1 - x0), out)?;
        }
        self.values.resize((x1 - x0) as usize, 0);
        depth.span(plane, y, x0, &mut self.values);
        out.span(y, x0, x1, &self.values);
        if out.wants_held() {
            let held: Vec<i128> = (x0..x1).map(|x| depth.held(plane, x, y)).collect();
            out.held(y, x0, &held);
        }
        Ok(())
    }
}

/// Passes the events of a run on; under the clamp mode `error` a wrap refuses the primitive.
pub(super) fn report(
    read: ReadOut,
    events: SpanEvents,
    out: &mut dyn Sink,
) -> Result<(), DrawError> {
    if let (Clamp::Error, Some(place)) = (read.clamp(), events.first[Event::Wrap as usize]) {
        return Err(DrawError::GuardRange { x: place.x, y: place.y });
    }
    out.events(&events);
    Ok(())
}

/// A run whose unwrapped accumulators a machine found by other means than a plane.
pub(super) fn accumulated_span(
    depth: &Depth,
    (y, x0): (u32, u32),
    accumulators: &[i128],
    out: &mut dyn Sink,
) -> Result<(), DrawError> {
    let read = depth.read_out();
    if read.clamp() == Clamp::Error || out.wants_events() {
        let mut events = SpanEvents::default();
        for (value, x) in accumulators.iter().zip(i64::from(x0)..) {
            events.note(Place { y: i64::from(y), x }, read.status(*value), *value);
        }
        report(read, events, out)?;
    }
    let held = |value: &i128| read.reduce(*value).clamp(0, read.top() - 1);
    let values: Vec<u64> = accumulators.iter().map(|value| depth.code(held(value))).collect();
    let length: u32 = bounded(values.len());
    out.span(y, x0, x0 + length, &values);
    if out.wants_held() {
        out.held(y, x0, &accumulators.iter().map(held).collect::<Vec<_>>());
    }
    Ok(())
}
