//! Traversals by rows and by tiles.

use super::{Block, Outside, TILE, Visitor};

/// Stamps `[x0, x1)` by `[y0, y1)`, and the pixels of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) x0: u32,
    pub(super) y0: u32,
    pub(super) x1: u32,
    pub(super) y1: u32,
    pub(super) size: [u32; 2],
}

impl Area {
    pub(super) fn stamp(&self, x: u32, y: u32, visitor: &mut dyn Visitor) -> Outside {
        visitor.stamp(x * self.size[0], y * self.size[1])
    }

    /// The stamps of this area inside a block of pixels.
    fn within(&self, x: u32, y: u32, side: u32) -> Self {
        let [width, height] = self.size;
        Self {
            x0: self.x0.max(x / width),
            y0: self.y0.max(y / height),
            x1: self.x1.min((x + side) / width),
            y1: self.y1.min((y + side) / height),
            size: self.size,
        }
    }
}

pub(super) fn bounding_box(area: &Area, visitor: &mut dyn Visitor) {
    for y in area.y0..area.y1 {
        for x in area.x0..area.x1 {
            area.stamp(x, y, visitor);
        }
    }
}

/// Each row begins under the leftmost stamp of the row above that was not left of the primitive.
pub(super) fn backtrack(area: &Area, visitor: &mut dyn Visitor) {
    let mut begin = area.x0;
    for y in area.y0..area.y1 {
        let mut x = begin;
        let mut here = area.stamp(x, y, visitor);
        // Back, until everything further left is outside.
        while !here.left && x > area.x0 {
            x -= 1;
            here = area.stamp(x, y, visitor);
        }
        let mut first = None;
        loop {
            if !here.left {
                first.get_or_insert(x);
            }
            if here.right || x + 1 >= area.x1 {
                break;
            }
            x += 1;
            here = area.stamp(x, y, visitor);
        }
        begin = first.unwrap_or(x);
    }
}

/// A row is left where everything further on is outside, and the next one is entered beyond its
/// own end on that side.
pub(super) fn zigzag(area: &Area, visitor: &mut dyn Visitor) {
    let (mut x, mut rightward) = (area.x0, true);
    for y in area.y0..area.y1 {
        let mut here = area.stamp(x, y, visitor);
        // Out, until nothing is behind.
        loop {
            let (clear, at_end) =
                if rightward { (here.left, x == area.x0) } else { (here.right, x + 1 == area.x1) };
            if clear || at_end {
                break;
            }
            x = if rightward { x - 1 } else { x + 1 };
            here = area.stamp(x, y, visitor);
        }
        // Across, until nothing is ahead.
        loop {
            let (clear, at_end) =
                if rightward { (here.right, x + 1 == area.x1) } else { (here.left, x == area.x0) };
            if clear || at_end {
                break;
            }
            x = if rightward { x + 1 } else { x - 1 };
            here = area.stamp(x, y, visitor);
        }
        rightward = !rightward;
    }
}

/// Blocks of `side` pixels, left to right and down, with what `inner` does to those not left out.
fn blocks(area: &Area, side: u32, visitor: &mut dyn Visitor, inner: fn(&Area, &mut dyn Visitor)) {
    let [width, height] = area.size;
    let first = |from: u32, size: u32| from * size / side * side;
    for y in (first(area.y0, height)..area.y1 * height).step_by(side as usize) {
        for x in (first(area.x0, width)..area.x1 * width).step_by(side as usize) {
            // A block taken whole needs no tests; its samples still have values to be walked to.
            if visitor.block(x, y, side) != Block::Outside {
                inner(&area.within(x, y, side), visitor);
            }
        }
    }
}

pub(super) fn tiles(area: &Area, side: u32, visitor: &mut dyn Visitor) {
    blocks(area, side, visitor, bounding_box);
}

pub(super) fn binned(area: &Area, visitor: &mut dyn Visitor) {
    blocks(area, TILE * TILE, visitor, |bin, visitor| tiles(bin, TILE, visitor));
}
