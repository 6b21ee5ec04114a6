//! Suspects of a triangle engine.

use super::engine::{Answer, Engine, EngineSlip};
use super::setup::NO_SWAP;
use super::{Suspect, Suspects};
use crate::format::Clamp;
use crate::model::{Drawing, Model, Span};
use crate::profile::neighbours;
use crate::value::Depth;
use crate::vector::bench::{Coverage, TriangleAnswers, TriangleBench, TriangleTest, ready};
use crate::vector::device::{Device, Drawer, drawing, grid, summary};
use crate::vector::table::Table;
use std::sync::Arc;

impl Suspects for TriangleBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let mut list = Vec::new();
        let model = || Arc::clone(self.model());
        for neighbour in neighbours(self.model().profile()) {
            let other = Arc::new(ready(&neighbour.profile, true));
            // Columns stay those of the set.
            if other.ports().setup.len() == self.model().ports().setup.len() {
                list.push(Suspect::new(self, neighbour.change, Drawer::new(other)));
            }
        }
        // What a slip at the end of a run does to masks is not told by the profile.
        if self.model().ports().mask.is_none() {
            list.extend(MOVES.map(|(moved, change)| {
                Suspect::new(self, change, Moved { moved, model: model() })
            }));
            list.push(Suspect::new(self, NO_SWAP, Unturned { drawer: Drawer::new(model()) }));
        }
        if let Some(engine) = plain(self.model()) {
            for (slip, change) in EngineSlip::all(engine.edge_width, engine.read) {
                let engine = Engine { slip, ..engine };
                list.push(Suspect::new(
                    self,
                    change,
                    Slipped { engine, model: model(), counted: 0 },
                ));
            }
        }
        list
    }
}

/// How a run of covered samples may be told wrongly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Move {
    RightEndIncluded,
    LeftEndExcluded,
    RowsLate,
}

const MOVES: [(Move, &str); 3] = [
    (Move::RightEndIncluded, "spans include the pixel at their right end (off by one)"),
    (Move::LeftEndExcluded, "spans leave out the pixel at their left end (off by one)"),
    (Move::RowsLate, "rows are numbered one too high (off by one)"),
];

/// An engine that tells its runs wrongly.
struct Moved {
    moved: Move,
    model: Arc<Model>,
}

impl Moved {
    /// Depths of a span: those drawn, and beyond them what the plane goes on to give.
    fn depths(&self, test: &TriangleTest, span: &Span) -> Vec<u64> {
        let mut values = vec![0; (span.x1 - span.x0) as usize];
        let Some(triangle) = &test.triangle else {
            let words = &test.setup[9..12];
            let y = i128::from(span.y - u32::from(self.moved == Move::RowsLate));
            for (x, value) in (span.x0..).zip(&mut values) {
                let at = words[0] + i128::from(x) * words[1] + y * words[2];
                *value = self.model.depth().map_or(0, |depth| depth.read_out().read(at));
            }
            return values;
        };
        let turned = triangle.normalised();
        if let (Some(depth), Some(z)) = (self.model.depth(), turned.z) {
            let grid = grid(&self.model);
            // A slip of the row's number leaves the row itself where it was.
            let y = span.y - u32::from(self.moved == Move::RowsLate);
            depth.span(&depth.plane(&turned, z, &grid), y, span.x0, &mut values);
        }
        values
    }
}

impl Device<TriangleTest> for Moved {
    fn answer(&mut self, test: &TriangleTest, rows: &mut TriangleAnswers<Table>, _: &mut Coverage) {
        let drawing = drawing(&self.model, test);
        let moved = drawing.spans.iter().map(|span| match self.moved {
            Move::RightEndIncluded => Span { x1: span.x1 + 1, ..*span },
            Move::LeftEndExcluded => Span { x0: span.x0 + 1, ..*span },
            Move::RowsLate => Span { y: span.y + 1, ..*span },
        });
        let spans: Vec<Span> = moved.filter(|span| span.x0 < span.x1).collect();
        let samples = spans.iter().map(|span| u64::from(span.x1 - span.x0)).sum();
        rows.exp.push(&summary(test.test, (spans.len(), samples), &drawing));
        for span in &spans {
            rows.span(test.test, span);
            if rows.depths.is_some() {
                rows.depths(test.test, span, &self.depths(test, span));
            }
        }
    }
}

/// An engine behind a set-up without the swap: it sees a negative area and, inside being positive, no
/// samples.
struct Unturned {
    drawer: Drawer,
}

impl Device<TriangleTest> for Unturned {
    fn answer(
        &mut self,
        test: &TriangleTest,
        rows: &mut TriangleAnswers<Table>,
        met: &mut Coverage,
    ) {
        if test.triangle.is_some_and(|triangle| triangle.area2() < 0) {
            rows.exp.push(&summary(test.test, (0, 0), &Drawing::default()));
        } else {
            self.drawer.answer(test, rows, met);
        }
    }
}

/// The plain engine of a model without a slip worth the name; `None` where none draws the profile.
fn plain(model: &Model) -> Option<Engine> {
    let edge = model.profile().plain_edges()?;
    let read = model.depth().map(Depth::read_out);
    // A sticky accumulator depends on the way, and a refused triangle has no rows.
    let told = read.is_none_or(|r| !matches!(r.clamp(), Clamp::Saturate | Clamp::Error));
    told.then_some(Engine { slip: EngineSlip::LastRow, edge_width: edge.width, read })
}

/// A plain engine with a slip.
struct Slipped {
    engine: Engine,
    /// Counts the events, which no word of an engine tells.
    model: Arc<Model>,
    /// Samples so far, of an engine that goes on counting.
    counted: u64,
}

impl Device<TriangleTest> for Slipped {
    fn answer(&mut self, test: &TriangleTest, rows: &mut TriangleAnswers<Table>, _: &mut Coverage) {
        let drawing = drawing(&self.model, test);
        let Answer { spans, depths, mut samples } = if drawing.zero_area {
            Answer::default()
        } else {
            self.engine.draw(&test.setup, test.bounds)
        };
        match self.engine.slip {
            EngineSlip::CountLarge => samples += 1,
            EngineSlip::CountKept => {
                self.counted += samples;
                samples = self.counted;
            }
            _ => {}
        }
        rows.exp.push(&summary(test.test, (spans.len(), samples), &drawing));
        for span in &spans {
            rows.span(test.test, span);
        }
        if let Some(table) = &mut rows.depths {
            for (x, y, z) in depths {
                table.push(&[test.test.into(), y.into(), x.into(), i128::from(z)]);
            }
        }
    }
}
