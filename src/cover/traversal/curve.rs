//! Traversals along space-filling curves, over the smallest aligned square of stamps that holds
//! the area; squares outside it are left out whole.

use super::Visitor;
use super::sweep::Area;

/// The stamps of a square from (x, y) with some in the area, in Z order: the bits of x and y
/// interleaved, those of x below.
pub(super) fn morton(area: &Area, visitor: &mut dyn Visitor) {
    let (x, y, side) = square(area);
    morton_square(area, [x, y], side, visitor);
}

fn morton_square(area: &Area, [x, y]: [u32; 2], side: u32, visitor: &mut dyn Visitor) {
    if misses(area, [x, y], side) {
        return;
    }
    if side == 1 {
        area.stamp(x, y, visitor);
        return;
    }
    let half = side / 2;
    for (right, down) in [(0, 0), (half, 0), (0, half), (half, half)] {
        morton_square(area, [x + right, y + down], half, visitor);
    }
}

/// The same along the Hilbert curve that begins at a square's upper left and ends at its upper right.
pub(super) fn hilbert(area: &Area, visitor: &mut dyn Visitor) {
    let (x, y, side) = square(area);
    hilbert_square(area, [x, y], side, Turn { flipped: false, turned: false }, visitor);
}

/// How a square's curve lies: mirrored along its diagonal (x and y exchanged), or turned by 180
/// degrees.
#[derive(Clone, Copy)]
struct Turn {
    flipped: bool,
    turned: bool,
}

fn hilbert_square(area: &Area, [x, y]: [u32; 2], side: u32, turn: Turn, visitor: &mut dyn Visitor) {
    if misses(area, [x, y], side) {
        return;
    }
    if side == 1 {
        area.stamp(x, y, visitor);
        return;
    }
    let half = side / 2;
    let Turn { flipped, turned } = turn;
    // Down the left side, across, up the right side; the first square mirrored along the falling
    // diagonal, the last along the rising one.
    let path = [
        ([0, 0], Turn { flipped: !flipped, turned }),
        ([0, half], turn),
        ([half, half], turn),
        ([half, 0], Turn { flipped: !flipped, turned: !turned }),
    ];
    for ([right, down], inner) in path {
        let [right, down] = if flipped { [down, right] } else { [right, down] };
        let [right, down] = if turned { [half - right, half - down] } else { [right, down] };
        hilbert_square(area, [x + right, y + down], half, inner, visitor);
    }
}

/// The smallest aligned square of stamps around the area: its corner and side, a power of two.
fn square(area: &Area) -> (u32, u32, u32) {
    let mut bits = 0;
    while area.x0 >> bits != (area.x1 - 1) >> bits || area.y0 >> bits != (area.y1 - 1) >> bits {
        bits += 1;
    }
    (area.x0 >> bits << bits, area.y0 >> bits << bits, 1 << bits)
}

fn misses(area: &Area, [x, y]: [u32; 2], side: u32) -> bool {
    x >= area.x1 || y >= area.y1 || x + side <= area.x0 || y + side <= area.y0
}
