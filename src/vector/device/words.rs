//! An engine that is given set-up words and a box, sample by sample as clauses `C-5`, `P-2` and `G-1`
//! have it: no step, no accumulator, so that nothing here can slip.

use crate::bits::Place;
use crate::case::engine::Engine;
use crate::model::{Drawing, Span};
use crate::vector::bench::{Coverage, TriangleTest};

/// Draws the words of a test: three edges, a depth plane if there is depth, the flag of no area.
pub(in crate::vector) fn draw_words(engine: Engine, test: &TriangleTest) -> Drawing {
    let zero_area = test.setup.last().is_some_and(|flag| *flag != 0);
    let mut drawing = Drawing { zero_area, ..Drawing::default() };
    if drawing.zero_area {
        return drawing;
    }
    let [x0, y0, x1, y1] = test.bounds;
    let at = |first: usize, x: u32, y: u32| {
        let words = &test.setup[first..first + 3];
        words[0] + i128::from(x) * words[1] + i128::from(y) * words[2]
    };
    for y in y0..y1 {
        let mut begin = None;
        for x in x0..x1.max(x0) {
            let inside = |edge: usize| at(3 * edge, x, y) >> (engine.edge - 1) & 1 == 0;
            if (0..3).all(inside) {
                begin.get_or_insert(x);
                if let Some(read) = engine.read {
                    let value = at(9, x, y);
                    drawing.depth.push(read.read(value));
                    let place = Place { y: y.into(), x: x.into() };
                    drawing.events.total.note(place, read.status(value), value);
                }
            } else if let Some(x0) = begin.take() {
                drawing.spans.push(Span { y, x0, x1: x });
            }
        }
        drawing.spans.extend(begin.map(|x0| Span { y, x0, x1 }));
    }
    drawing
}

/// What words met: where covered samples stood, edges that decided, sides of the box, lengths.
pub(in crate::vector) fn met(
    engine: Engine,
    test: &TriangleTest,
    drawing: &Drawing,
    met: &mut Coverage,
) {
    let [x0, y0, x1, y1] = test.bounds;
    if x0 >= x1 || y0 >= y1 {
        met.meet("box.empty");
    }
    let at = |first: usize, x: u32, y: u32| {
        let words = &test.setup[first..first + 3];
        words[0] + i128::from(x) * words[1] + i128::from(y) * words[2]
    };
    let edge = |edge: usize, x, y| super::signed(at(3 * edge, x, y), engine.edge);
    let inside = |x, y| (0..3).all(|n| edge(n, x, y) >= 0);
    let full = |length: u32| length.is_power_of_two() || (length - 1).is_power_of_two();
    if drawing.spans.windows(2).any(|pair| pair[0].y == pair[1].y) {
        met.meet("row.several-runs");
    }
    for span in &drawing.spans {
        let length = span.x1 - span.x0;
        if full(length) {
            met.meet(&format!("run.x.{length}"));
        }
        let y = span.y;
        let cuts = [
            ("cut.left", span.x0 == x0 && x0 > 0 && inside(x0 - 1, y)),
            ("cut.right", span.x1 == x1 && inside(x1, y)),
            ("cut.top", y == y0 && y0 > 0 && inside(span.x0, y0 - 1)),
            ("cut.bottom", y + 1 == y1 && inside(span.x0, y1)),
        ];
        cuts.iter().filter(|(_, cut)| *cut).for_each(|(cell, _)| met.meet(cell));
        for x in span.x0..span.x1 {
            for n in (0..3).filter(|n| edge(*n, x, y) == 0) {
                met.meet(&format!("edge{n}.zero"));
            }
            let Some(read) = engine.read else { continue };
            let value = at(9, x, y);
            let octant = Coverage::octant(test.setup[10], test.setup[11]);
            let remainder = Coverage::remainder(value.cast_unsigned(), read.fraction());
            met.note(octant, read.zone(value), remainder);
            let pattern = value.cast_unsigned() & (u128::MAX >> (128 - read.width()));
            met.note_guard(octant, super::guard(read, pattern));
        }
    }
    // Columns of the same number of rows as the box, as runs go down.
    let column = u32::try_from(drawing.spans.len()).unwrap_or(u32::MAX);
    if drawing.spans.iter().all(|span| span.x1 - span.x0 == 1)
        && column == y1 - y0.min(y1)
        && column > 0
        && full(column)
    {
        met.meet(&format!("run.y.{column}"));
    }
    if !drawing.zero_area && test.samples() <= 64 {
        for y in y0..y1 {
            for x in x0..x1.max(x0) {
                let outside: Vec<usize> = (0..3).filter(|n| edge(*n, x, y) < 0).collect();
                if let [n] = outside[..]
                    && edge(n, x, y) == -1
                {
                    met.meet(&format!("edge{n}.minus-one"));
                }
            }
        }
    }
}
