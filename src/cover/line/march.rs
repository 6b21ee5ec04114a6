//! Every cell a segment touches. Spec clause `L-6`.

use super::Segment;

/// The next border on one axis: when it is met, as a fraction of the way, and whether the point on it
/// is already in the next cell (travelling up the axis) or still in this one.
#[derive(Clone, Copy)]
struct Border {
    numerator: i128,
    denominator: i128,
    at_once: bool,
}

fn border(from: i128, by: i128, cell: i128, side: i128) -> Option<Border> {
    match by.signum() {
        1 => Some(Border { numerator: (cell + 1) * side - from, denominator: by, at_once: true }),
        -1 => Some(Border { numerator: from - cell * side, denominator: -by, at_once: false }),
        _ => None,
    }
}

/// Calls `visit` for every cell with a point of the segment in it, in order, each once. Cells are
/// squares of `side` units, half-open: a cell has its upper and left borders.
pub fn march([from, to]: Segment, side: i128, visit: &mut dyn FnMut([i128; 2])) {
    let by = [to[0] - from[0], to[1] - from[1]];
    let mut cell = from.map(|value| value.div_euclid(side));
    loop {
        visit(cell);
        let next = [0, 1].map(|k| border(from[k], by[k], cell[k], side));
        let met = next.map(|border| {
            // A border at the very end counts where its point is in the next cell.
            border.filter(|b| {
                b.numerator < b.denominator || (b.at_once && b.numerator == b.denominator)
            })
        });
        let moves = match met {
            [None, None] => return,
            [Some(_), None] => [true, false],
            [None, Some(_)] => [false, true],
            [Some(a), Some(b)] => {
                let order = (a.numerator * b.denominator).cmp(&(b.numerator * a.denominator));
                // What happens at a point comes before what happens just after it.
                let order = order.then(b.at_once.cmp(&a.at_once));
                [order.is_le(), order.is_ge()]
            }
        };
        for k in 0..2 {
            cell[k] += if moves[k] { by[k].signum() } else { 0 };
        }
    }
}
