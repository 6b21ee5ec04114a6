use super::kernel::Edges;
use crate::bits::{Place, SpanEvents};
use crate::format::ReadOut;

use super::closed::Line;

/// Twin of [`super::row_values`]: reads each value of a row by [`ReadOut::read`].
pub fn row_values(read: ReadOut, start: i128, slope: i128, out: &mut [u64]) {
    let mut value = start;
    for slot in out {
        *slot = read.read(value);
        value += slope;
    }
}

/// Twin of [`Line::events`]: looks at every sample.
pub fn span_events(read: ReadOut, line: Line, place: Place) -> SpanEvents {
    let mut events = SpanEvents::default();
    for n in 0..line.count {
        let here = Place { x: place.x + n.cast_signed(), ..place };
        events.note(here, read.status(line.at(n)), line.at(n));
    }
    events
}

/// Twin of [`super::row_inside`]: the sign of each edge word, reduced mod 2^N sample by sample.
pub fn row_inside(edges: Edges<i128>, width: u32, count: u32) -> Vec<bool> {
    let unused = 128 - width;
    let sign_clear = |value: i128| value << unused >= 0;
    (0..i128::from(count))
        .map(|x| {
            (0..3).all(|k| sign_clear(edges.value[k].wrapping_add(edges.step_x[k].wrapping_mul(x))))
        })
        .collect()
}
