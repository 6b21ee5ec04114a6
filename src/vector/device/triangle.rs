//! The reference model of a triangle engine: set-up words in; spans, depths and counts out.

use super::Device;
use super::words::draw_words;
use crate::bits::Event;
use crate::cover::SampleGrid;
use crate::model::{Drawing, Model, Span};
use crate::setup::Triangle;
use crate::vector::bench::{Coverage, TriangleAnswers, TriangleTest, word_engine};
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

/// What a device of this model answers to a test; words of their own it reads by its own widths.
pub(in crate::vector) fn drawing(model: &Model, test: &TriangleTest) -> Drawing {
    let mut drawing = Drawing::default();
    if let Some(triangle) = &test.triangle {
        draw(model, triangle, &mut drawing);
    } else if let Some(engine) = word_engine(model) {
        drawing = draw_words(engine, test);
    }
    drawing
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

    fn met(&self, test: &TriangleTest, drawing: &Drawing, met: &mut Coverage) {
        if drawing.zero_area {
            met.meet("zero-area");
        }
        let engine = word_engine(&self.model);
        if let Some(engine) = engine {
            super::words::met(engine, test, drawing, met);
        }
        let Some(triangle) = test.triangle.map(Triangle::normalised) else { return };
        self.sides(&triangle, drawing, met);
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        if drawing.spans.is_empty() || engine.is_some() || self.model.ports().mask.is_some() {
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

    /// Sides of the window that the triangle covers a sample at and goes beyond.
    fn sides(&self, triangle: &Triangle, drawing: &Drawing, met: &mut Coverage) {
        let (clip, grid) = (self.model.clip(), grid(&self.model));
        let reach = self.model.profile().box_reach();
        let [(x0, x1), (y0, y1)] = [0, 1].map(|axis| {
            let (low, high) = triangle.extent(axis);
            grid.pixels(axis, (low - reach, high + reach))
        });
        let whole = (i64::MIN.into(), i64::MAX.into());
        let ((left, right), (top, bottom)) = (clip.clip(0, whole), clip.clip(1, whole));
        let any = |at: &dyn Fn(&Span) -> bool| drawing.spans.iter().any(at);
        let met_at = [
            ("beyond.left", x0 < i128::from(left) && any(&|span| span.x0 == left)),
            ("beyond.right", x1 > i128::from(right) && any(&|span| span.x1 == right)),
            ("beyond.top", y0 < i128::from(top) && any(&|span| span.y == top)),
            ("beyond.bottom", y1 > i128::from(bottom) && any(&|span| span.y + 1 == bottom)),
        ];
        met_at.iter().filter(|(_, here)| *here).for_each(|(cell, _)| met.meet(cell));
    }
}

impl Device<TriangleTest> for Drawer {
    fn answer(
        &mut self,
        test: &TriangleTest,
        rows: &mut TriangleAnswers<Table>,
        met: &mut Coverage,
    ) {
        let drawing = drawing(&self.model, test);
        let number = test.test;
        rows.exp.push(&summary(number, (drawing.spans.len(), drawing.samples()), &drawing));
        for span in &drawing.spans {
            rows.span(number, span);
        }
        self.met(test, &drawing, met);
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
    }
}
