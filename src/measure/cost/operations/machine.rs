//! Operations of the machines beside plain edge functions and walked edges. Spec clause `A-11`.

use super::{AREA, CLIP, Count, EXTENT, JUMP, Operations, PIXELS, STEP, TEST, edge_setup};
use crate::cover::FillRule;

/// Bounding box on both axes.
fn bounds() -> Count {
    (EXTENT + PIXELS + CLIP).times(2) + TEST
}

/// Three edge words stepped to the next sample, and their signs.
fn sample() -> Count {
    (STEP + TEST).times(3)
}

/// Three edge words stepped to the next tile; of each the corner that decides either way.
fn block() -> Count {
    (STEP + STEP.times(2) + TEST.times(2)).times(3)
}

/// The offsets of an edge's two deciding corners: two steps times the side, kept once a triangle.
fn corners() -> Count {
    Count::new(2, 2, 0, 4)
}

/// Any order of visits: what it looks at depends on what it finds, and is measured.
pub(super) fn traversed(rule: FillRule) -> Operations {
    let edge = edge_setup(rule) + JUMP + corners();
    Operations {
        triangle: AREA + bounds() + edge.times(3),
        tile: block(),
        visit: sample(),
        ..Operations::default()
    }
}

/// No bounding box: the tree reaches every engine, where its last adder and a test are.
pub(super) fn engine_per_pixel(rule: FillRule) -> Operations {
    Operations {
        triangle: AREA + edge_setup(rule).times(3),
        visit: sample(),
        ..Operations::default()
    }
}

pub(super) fn tiles(rule: FillRule) -> Operations {
    let edge = edge_setup(rule) + JUMP + corners();
    Operations {
        triangle: AREA + bounds() + edge.times(3),
        tile: block(),
        visit: sample(),
        ..Operations::default()
    }
}

/// One side of a walk: direction, differences, rows, start and slope.
fn side() -> Count {
    let rows = Count::new(1, 0, 0, 0) + PIXELS + TEST;
    TEST + Count::new(2, 0, 0, 0) + rows + Count::new(2, 0, 0, 0) + Count::new(1, 2, 2, 0)
}

/// The approximate walk leaves candidates; each is decided by the edge words.
pub(super) fn barycentric(rule: FillRule) -> Operations {
    let rows = EXTENT + PIXELS + CLIP;
    // Both ends of both sides: the step, the slack, the sample's offset.
    let ends = Count::new(4, 0, 0, 2).times(2);
    Operations {
        triangle: AREA + rows + side().times(3) + edge_setup(rule).times(3),
        row: ends + CLIP + JUMP.times(3),
        visit: sample(),
        ..Operations::default()
    }
}

/// Depth from two shares: their planes once a triangle, two products and two sums a fragment.
pub(super) fn weighted_depth(operations: &mut Operations) {
    // Of a share: gradient by differences, offset to the first sample, three quotients.
    let share = Count::new(2, 0, 0, 0) + Count::new(4, 3, 0, 0) + Count::new(0, 0, 3, 0);
    operations.triangle = operations.triangle + share.times(2) + Count::new(2, 0, 0, 0);
    operations.run = JUMP.times(2);
    operations.fragment = STEP.times(2) + Count::new(2, 2, 0, 0);
}

/// Depth down the edges and along the span: a start and a slope an edge, a slope a span.
pub(super) fn walked_depth(operations: &mut Operations) {
    let edge = Count::new(2, 2, 2, 0);
    operations.triangle = operations.triangle + edge.times(3);
    operations.row = operations.row + STEP.times(2);
    // The span's slope, and the part of a pixel to its first sample.
    operations.run = Count::new(2, 0, 1, 0) + Count::new(2, 1, 0, 0);
    operations.fragment = STEP;
}

/// Cross products and a determinant, no projection, no clipping, no bounding box.
pub(super) fn homogeneous(rule: FillRule) -> Operations {
    let cross = Count::new(3, 6, 0, 0);
    let determinant = Count::new(2, 3, 0, 2);
    let owns = match rule {
        FillRule::TopLeft | FillRule::Shadow => TEST.times(3) + Count::new(1, 0, 0, 0),
    };
    Operations {
        triangle: (cross + owns).times(3) + determinant,
        // The value at the block's corner, how far it goes either way, and two signs.
        tile: (JUMP + Count::new(4, 2, 0, 4) + TEST.times(2)).times(3),
        visit: (JUMP + TEST).times(3),
        ..Operations::default()
    }
}

/// Three vertices sorted, three sides cut by quotient and remainder; a row is two steps with carry.
pub(super) fn scanline() -> Operations {
    let side = Count::new(5, 2, 2, 2);
    let step = Count::new(2, 0, 0, 1) + Count::new(2, 0, 0, 0);
    Operations {
        triangle: AREA + TEST.times(3) + PIXELS.times(3) + CLIP + side.times(3),
        row: step.times(2) + CLIP,
        ..Operations::default()
    }
}
