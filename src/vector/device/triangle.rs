//! The reference model of a triangle engine: set-up words in; spans, depths and counts out.

use super::Device;
use crate::bits::Event;
use crate::cover::SampleGrid;
use crate::model::{Drawing, Model, Span};
use crate::setup::Triangle;
use crate::vector::bench::{Coverage, TriangleAnswers, TriangleTest};
use crate::vector::table::Table;
use std::sync::Arc;

/// The engine of a model.
pub(in crate::vector) struct Drawer {
    model: Arc<Model>,
}

/// The sample grid of a valid model.
pub(in crate::vector) fn grid(model: &Model) -> SampleGrid {
    let grid = model.profile().grid();
    grid.unwrap_or_else(|error| unreachable!("a valid profile: {error}"))
}

/// Draws a triangle; one that the profile refuses has no rows, nor has one outside the vertex field of
/// another profile.
pub(in crate::vector) fn draw(model: &Model, triangle: &Triangle, drawing: &mut Drawing) {
    let placed = model.place(*triangle);
    if placed.is_ok_and(|triangle| !model.draw_own(&triangle, drawing)) {
        drawing.spans.clear();
        drawing.depth.clear();
    }
}

/// A row of `triangle.exp`.
pub(in crate::vector) fn summary(
    test: u64,
    (spans, samples): (usize, u64),
    drawing: &Drawing,
) -> [i128; 8] {
    let count = |event| i128::from(drawing.events.total.count(event));
    [
        i128::from(test),
        spans as i128,
        i128::from(samples),
        count(Event::Wrap),
        count(Event::ClampAbove),
        count(Event::ClampBelow),
        count(Event::Inexact),
        i128::from(drawing.zero_area),
    ]
}

impl TriangleAnswers<Table> {
    /// A row of `span.exp`.
    pub(in crate::vector) fn span(&mut self, test: u64, span: &Span) {
        let row = [span.y, span.x0, span.x1].map(i128::from);
        self.spans.push(&[i128::from(test), row[0], row[1], row[2]]);
    }

    /// A row of `depth.exp` for each sample of a span.
    pub(in crate::vector) fn depths(&mut self, test: u64, span: &Span, values: &[u64]) {
        if let Some(depths) = &mut self.depths {
            for (x, z) in (span.x0..span.x1).zip(values) {
                depths.push(&[test.into(), span.y.into(), x.into(), i128::from(*z)]);
            }
        }
    }
}

impl Drawer {
    /// The engine of a model.
    pub(in crate::vector) fn new(model: Arc<Model>) -> Self {
        Self { model }
    }

    /// Depths and masks where pixels have several samples.
    fn masked(&self, test: u64, drawing: &Drawing, rows: &mut TriangleAnswers<Table>) {
        let test = i128::from(test);
        let by_sample = self.model.ports().by_sample;
        let pixels = drawing.spans.iter().flat_map(|span| (span.x0..span.x1).map(|x| (x, span.y)));
        let mut values = drawing.depth.iter().map(|z| i128::from(*z));
        let mut value = || {
            values
                .next()
                .unwrap_or_else(|| unreachable!("a depth for each covered sample or pixel"))
        };
        for ((x, y), mask) in pixels.zip(&drawing.masks) {
            let [x, y] = [x, y].map(i128::from);
            if let Some(masks) = &mut rows.masks {
                masks.push(&[test, y, x, i128::from(*mask)]);
            }
            let Some(depths) = &mut rows.depths else { continue };
            if by_sample {
                for sample in (0..32).filter(|sample| mask >> sample & 1 == 1) {
                    depths.push(&[test, y, x, sample, value()]);
                }
            } else {
                depths.push(&[test, y, x, value()]);
            }
        }
    }

    fn met(&self, triangle: &Triangle, drawing: &Drawing, met: &mut Coverage) {
        let triangle = triangle.normalised();
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        if drawing.spans.is_empty() {
            return;
        }
        let plane = depth.plane(&triangle, z, &grid(&self.model));
        let read = depth.read_out();
        let octant = Coverage::octant(plane.dx().raw(), plane.dy().raw());
        for span in &drawing.spans {
            for x in span.x0..span.x1 {
                let value = plane.at(i128::from(x), i128::from(span.y)).raw();
                let remainder = Coverage::remainder(value.cast_unsigned(), read.fraction());
                met.note(octant, read.zone(value), remainder);
            }
        }
    }
}

impl Device<TriangleTest> for Drawer {
    fn answer(
        &mut self,
        test: &TriangleTest,
        rows: &mut TriangleAnswers<Table>,
        met: &mut Coverage,
    ) {
        let mut drawing = Drawing::default();
        draw(&self.model, &test.triangle, &mut drawing);
        let number = test.test;
        rows.exp.push(&summary(number, (drawing.spans.len(), drawing.samples()), &drawing));
        for span in &drawing.spans {
            rows.span(number, span);
        }
        if self.model.ports().mask.is_some() {
            self.masked(number, &drawing, rows);
            return;
        }
        if rows.depths.is_some() {
            let mut left = &drawing.depth[..];
            for span in &drawing.spans {
                // A value for each covered sample; a span without its values stops here.
                let (values, later) = left.split_at((span.x1 - span.x0) as usize);
                rows.depths(number, span, values);
                left = later;
            }
        }
        self.met(&test.triangle, &drawing, met);
    }
}
