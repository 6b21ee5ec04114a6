//! Suspects of a triangle engine.

use super::engine::{COUNTERS, Engine, Kept, remembers};
use super::fault::{Fault, Path};
use super::setup::NO_SWAP;
use super::{Suspect, Suspects};
use crate::model::{Drawing, Model, Span};
use crate::profile::neighbours;
use crate::vector::bench::{
    Coverage, TriangleAnswers, TriangleBench, TriangleTest, bounds_within, ready, word_engine,
};
use crate::vector::device::{Device, Drawer, draw_words, drawing, grid, summary};
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
        if let Some(widths) = word_engine(self.model()) {
            if self.model().profile().conservative().is_some() {
                list.extend(OtherBox::ALL.map(|wrong| {
                    let (model, change) = (model(), wrong.change());
                    Suspect::new(self, change, Boxed { wrong, model, widths })
                }));
            }
            let engine = Engine { widths };
            for fault in faults(engine) {
                let device = Faulty {
                    engine,
                    path: Path::with(&fault),
                    model: model(),
                    kept: Kept::default(),
                };
                let suspect = Suspect::at(self, &fault, device);
                // Counters and steppers go on from where the record before has left them.
                let keeps = COUNTERS.contains(&fault.site) || remembers(fault.site);
                let steps = ["dda", "edge_stepper"].contains(&fault.module) && fault.chooses();
                let forgets = suspect.forgets && !keeps && !steps;
                // An operand that is missing is simpler to say than a load from elsewhere.
                let rank = suspect.rank + u8::from(remembers(fault.site));
                list.push(Suspect { rank, forgets, ..suspect });
            }
        }
        list
    }
}

/// The faults of an engine: those of every part that a small triangle of two rows meets.
fn faults(engine: Engine) -> Vec<Fault> {
    Path::faults(|path| {
        let edge = [2, -1, 0];
        let inside = [1, 0, 0];
        let mut words = [edge, inside, inside].concat();
        words.extend(engine.widths.read.iter().flat_map(|_| [0, 0, 0]));
        words.push(0);
        engine.draw(path, &mut Kept::default(), &words, [0, 0, 4, 2]);
    })
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

/// A bounding box that is not that of the squares. Spec clause `CR-3`.
#[derive(Clone, Copy, Debug)]
enum OtherBox {
    AtVertices,
    PixelMore,
}

impl OtherBox {
    const ALL: [Self; 2] = [Self::AtVertices, Self::PixelMore];

    const fn change(self) -> &'static str {
        match self {
            Self::AtVertices => {
                "the bounding box ends at the vertices: it is not moved by the half side of a square"
            }
            Self::PixelMore => "the bounding box is a pixel larger on each side",
        }
    }

    fn reach(self, model: &Model) -> i128 {
        match self {
            Self::AtVertices => 0,
            Self::PixelMore => {
                model.profile().box_reach() + (1 << model.profile().vertex.sub_pixel)
            }
        }
    }
}

/// The right words in a wrong box.
struct Boxed {
    wrong: OtherBox,
    model: Arc<Model>,
    widths: crate::case::engine::Engine,
}

impl Device<TriangleTest> for Boxed {
    fn answer(&mut self, test: &TriangleTest, rows: &mut TriangleAnswers<Table>, _: &mut Coverage) {
        let drawn = match &test.triangle {
            Some(triangle) => {
                let reach = self.wrong.reach(&self.model);
                let bounds = bounds_within(&self.model, &triangle.normalised(), reach);
                draw_words(self.widths, &TriangleTest { bounds, ..test.clone() })
            }
            None => drawing(&self.model, test),
        };
        let spans = drawn.spans.len();
        rows.exp.push(&summary(test.test, (spans, drawn.samples()), &drawn));
        let mut left = &drawn.depth[..];
        for span in &drawn.spans {
            rows.span(test.test, span);
            if rows.depths.is_some() {
                let (values, later) = left.split_at((span.x1 - span.x0) as usize);
                rows.depths(test.test, span, values);
                left = later;
            }
        }
    }
}

/// A plain engine with a fault.
struct Faulty {
    engine: Engine,
    path: Path,
    /// Counts the events, which no word of an engine tells.
    model: Arc<Model>,
    kept: Kept,
}

impl Device<TriangleTest> for Faulty {
    fn answer(&mut self, test: &TriangleTest, rows: &mut TriangleAnswers<Table>, _: &mut Coverage) {
        let right = drawing(&self.model, test);
        let Some(answer) = self.engine.draw(&self.path, &mut self.kept, &test.setup, test.bounds)
        else {
            // It hangs: nothing comes any more.
            return;
        };
        let right = Drawing { zero_area: answer.zero_area, ..right };
        let spans = usize::try_from(answer.span_count).unwrap_or(usize::MAX);
        rows.exp.push(&summary(test.test, (spans, answer.sample_count), &right));
        for span in &answer.spans {
            rows.span(test.test, span);
        }
        if let Some(table) = &mut rows.depths {
            for (x, y, z) in answer.depths {
                table.push(&[test.test.into(), y.into(), x.into(), i128::from(z)]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Square;
    use crate::setup::Triangle;
    use crate::vector::bench::{Source, TestBench};
    use crate::vector::device::setup_words;
    use crate::vector::table::RowFormat;

    /// Clause CR-3: a box that ends at the vertices loses squares, one that is larger covers what the words alone
    /// do not exclude.
    #[test]
    fn a_wrong_box_shows_in_the_runs() {
        let mut profile = crate::profile::load("d3d12-outer").unwrap();
        profile.window = crate::profile::WindowConfig { width: 8, height: 8 };
        let source =
            Source { profile, scene: Arc::default(), values: Arc::default(), seed: 1, count: 64 };
        let bench = TriangleBench::new(&source);
        let (model, widths) = (Arc::clone(bench.model()), word_engine(bench.model()).unwrap());
        // The left vertex lies right of the square of pixel (1, 1), whose lower and upper corners are inside of
        // all three edges.
        let xy = [[520, 384], [1900, 300], [1900, 470]];
        let triangle = Triangle { xy, z: Some([0; 3]) };
        let square = |x: u32, y: u32| Square {
            middle: [x, y].map(|at| 512 * i128::from(at) + 256),
            half_side: 256 + 2,
        };
        let touched = |x, y| square(x, y).touches(xy.map(|v| v.map(|at| 2 * at)));
        let at_vertices = |x, y| touched(x, y) && (2..7).contains(&x) && y == 1;
        let runs = |covered: &dyn Fn(u32, u32) -> bool| -> Vec<[u32; 2]> {
            let pixels = (0..8).flat_map(|y| (0..8).map(move |x| [x, y]));
            pixels.filter(|[x, y]| covered(*x, *y)).collect()
        };
        let drawn = |wrong| {
            let setup = setup_words(&model, &triangle);
            let bounds = bounds_within(&model, &triangle, model.profile().box_reach());
            let test = TriangleTest { test: 0, triangle: Some(triangle), setup, bounds };
            let (_, mut rows) = bench.tables(RowFormat::Tv);
            let mut device = Boxed { wrong, model: Arc::clone(&model), widths };
            device.answer(&test, &mut rows, &mut Coverage::default());
            let text = String::from_utf8(rows.spans.buffer).unwrap();
            let pixels = text.lines().flat_map(|line| {
                let words: Vec<u32> =
                    line.split('_').map(|word| u32::from_str_radix(word, 16).unwrap()).collect();
                (words[2]..words[3]).map(move |x| [x, words[1]])
            });
            pixels.collect::<Vec<_>>()
        };
        let right = runs(&touched);
        assert_eq!(drawn(OtherBox::AtVertices), runs(&at_vertices));
        assert!(right.contains(&[7, 1]) && !runs(&at_vertices).contains(&[7, 1]));
        let more = drawn(OtherBox::PixelMore);
        assert!(more.contains(&[1, 1]) && !right.contains(&[1, 1]));
        assert!(right.iter().all(|pixel| more.contains(pixel)));
    }
}
