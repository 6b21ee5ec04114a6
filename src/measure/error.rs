//! Arithmetic error: what the model drew against the exact truth of the snapped triangle.
//!
//! Depth is compared as the accumulator holds it, after the clamp and before the read-out drops
//! its fraction: that is the error a budget of interpolation bits answers for.
//!
//! Snap error, the distance between a scene and its snapped self, is another thing and is not
//! counted here.
#![allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]

use crate::cover::FillRule;
use crate::exact::{self, PlaneNumerator, Rule};
use crate::machine::Sink;
use crate::model::{Model, Span};
use crate::profile::Form;
use crate::setup::{Snapped, Triangle};

/// How one sample differs from the exact truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleError {
    /// Covered by both; the depth differs by this many ULP (0 without depth).
    Depth(f64),
    /// Covered by the exact triangle only.
    Missing,
    /// Covered by the model only.
    Extra,
}

/// Sums over samples.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Samples covered by both.
    pub samples: u64,
    /// Samples that only the exact triangle covers.
    pub missing: u64,
    /// Samples that only the model covers.
    pub extra: u64,
    /// Largest depth error in ULP.
    pub worst: f64,
    /// Sum of signed depth errors in ULP.
    pub sum: f64,
}

impl Tally {
    /// Counts a sample.
    pub fn note(&mut self, error: SampleError) {
        match error {
            SampleError::Missing => self.missing += 1,
            SampleError::Extra => self.extra += 1,
            SampleError::Depth(ulp) => {
                self.samples += 1;
                self.worst = self.worst.max(ulp.abs());
                self.sum += ulp;
            }
        }
    }

    /// Mean signed depth error in ULP.
    pub fn mean(&self) -> f64 {
        if self.samples == 0 { 0.0 } else { self.sum / self.samples as f64 }
    }
}

/// The exact rule that a coverage form is judged by.
pub fn exact_rule(form: &Form) -> Rule {
    match form.rule() {
        FillRule::TopLeft => Rule::TopLeft,
        FillRule::Shadow => Rule::Shadow,
    }
}

/// How far an accumulator of `fraction` fraction bits lies above the plane, in ULP.
pub(super) fn above(
    plane: &PlaneNumerator,
    at: [i128; 2],
    accumulator: i128,
    fraction: u32,
) -> f64 {
    let above = accumulator * plane.whole - (plane.at(at) << fraction);
    above as f64 / (plane.whole << fraction) as f64
}

/// Runs and depth accumulators as drawn.
#[derive(Default)]
struct Accumulators {
    spans: Vec<Span>,
    held: Vec<i128>,
    zero_area: bool,
}

impl Sink for Accumulators {
    fn zero_area(&mut self) {
        self.zero_area = true;
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.spans.push(Span { y, x0, x1 });
    }

    fn wants_held(&self) -> bool {
        true
    }

    fn held(&mut self, _: u32, _: u32, accumulators: &[i128]) {
        self.held.extend_from_slice(accumulators);
    }
}

/// Compares what the model draws with the exact triangle, sample by sample, within the model's
/// clip. Calls `each` with column, row and error; returns the tally.
pub fn triangle_error(
    model: &Model,
    triangle: &Snapped<Triangle>,
    mut each: impl FnMut(u32, u32, SampleError),
) -> Tally {
    let mut tally = Tally::default();
    let mut drawing = Accumulators::default();
    let Ok(grid) = model.profile().whole_grid() else { return tally };
    if !model.draw_own(triangle, &mut drawing) || drawing.zero_area {
        return tally;
    }
    let rule = exact_rule(&model.profile().form);
    let clip = model.clip();
    let (y0, y1) = clip.clip(1, grid.pixels(1, triangle.extent(1)));
    // Rows of a wrong width can reach beyond the triangle: take what was drawn there, too.
    let drawn_rows =
        drawing.spans.first().map_or(y0..y0, |s| s.y..drawing.spans[drawing.spans.len() - 1].y + 1);
    let plane = triangle.z.and_then(|z| PlaneNumerator::new(triangle.xy, z)).zip(model.depth());
    let turned = triangle.normalised();
    let gain = model.depth().zip(turned.z).map_or(0, |(depth, z)| depth.gain(&turned, z, &grid));
    let pitch = 1 << grid.sub_pixel;
    let (mut next, mut held) = (0, drawing.held.iter());
    for y in y0.min(drawn_rows.start)..y1.max(drawn_rows.end) {
        let [x, at_y] = grid.position(0, i128::from(y));
        let exact = exact::covered_row(triangle.xy, (x, at_y), pitch, rule)
            .map_or((0, 0), |range| clip.clip(0, range));
        let begin = next;
        while drawing.spans.get(next).is_some_and(|span| span.y == y) {
            next += 1;
        }
        let drawn = &drawing.spans[begin..next];
        let left = drawn.first().map_or(exact.0, |span| span.x0.min(exact.0));
        let right = drawn.last().map_or(exact.1, |span| span.x1.max(exact.1));
        for x in left..right {
            let is_drawn = drawn.iter().any(|span| (span.x0..span.x1).contains(&x));
            // Runs, and so their accumulators, come in the order of y then x.
            let accumulator = if is_drawn { held.next() } else { None };
            let belongs = (exact.0..exact.1).contains(&x);
            let error = match (is_drawn, belongs) {
                (false, false) => continue,
                (false, true) => SampleError::Missing,
                (true, false) => SampleError::Extra,
                (true, true) => SampleError::Depth(match (&plane, accumulator) {
                    (Some((exact, depth)), Some(held)) => {
                        // What wraps reads as what it wrapped to; what is clamped, as the clamp.
                        let at = grid.position(i128::from(x), i128::from(y));
                        above(exact, at, held - gain, depth.read_out().fraction())
                    }
                    _ => 0.0,
                }),
            };
            tally.note(error);
            each(x, y, error);
        }
    }
    tally
}
