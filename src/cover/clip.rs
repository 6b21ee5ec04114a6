//! Clipping to rectangles: lines, polygons, and the guard band that makes it rare.
//! Spec clauses `Y-4` to `Y-6`.

use super::line::Segment;
use crate::bits::Rounding;

/// A closed rectangle in sub-pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClipRect {
    /// Smallest x and y.
    pub low: [i128; 2],
    /// Largest x and y.
    pub high: [i128; 2],
}

/// What a guard band leaves to do for a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuardBand {
    /// All of it lies on one far side of the window: nothing to draw.
    Outside,
    /// It lies in the band: drawn as it is, the scissor cuts it.
    Inside,
    /// It leaves the band, where words would wrap: it has to be clipped.
    Clip,
}

impl ClipRect {
    /// The outcode of Cohen and Sutherland: left 1, right 2, above 4, below 8.
    pub fn outcode(&self, [x, y]: [i128; 2]) -> u8 {
        u8::from(x < self.low[0])
            | u8::from(x > self.high[0]) << 1
            | u8::from(y < self.low[1]) << 2
            | u8::from(y > self.high[1]) << 3
    }

    /// Where the line through two points meets a side, rounded once to the grid; the points lie on
    /// different sides of it.
    fn meet(&self, [a, b]: Segment, side: u8, rounding: Rounding) -> [i128; 2] {
        let axis = usize::from(side >= 4);
        let to = if side == 1 || side == 4 { self.low[axis] } else { self.high[axis] };
        let (along, across) = (b[axis] - a[axis], b[1 - axis] - a[1 - axis]);
        let by = rounding.divide(across * (to - a[axis]), along).map_or(0, |(by, _)| by);
        let mut point = [to; 2];
        point[1 - axis] = a[1 - axis] + by;
        point
    }

    /// The part of a segment inside, by Cohen and Sutherland: its new ends lie on the sides, each
    /// rounded once from the segment as given.
    pub fn line(&self, segment: Segment, rounding: Rounding) -> Option<Segment> {
        let mut ends = segment;
        // Four sides cut each end at most once.
        for _ in 0..8 {
            let codes = ends.map(|end| self.outcode(end));
            if codes[0] & codes[1] != 0 {
                return None;
            }
            let Some(k) = codes.iter().position(|code| *code != 0) else { return Some(ends) };
            let side = 1 << codes[k].trailing_zeros();
            let from = if k == 0 { segment } else { [segment[1], segment[0]] };
            ends[k] = self.meet(from, side, rounding);
        }
        None
    }

    /// A polygon cut by the four sides in turn, by Sutherland and Hodgman. A convex polygon stays
    /// convex but for the rounding of its new vertices; a concave one may get edges along a side that
    /// run back over themselves, which parity does not see.
    pub fn polygon(&self, vertices: &[[i128; 2]], rounding: Rounding) -> Vec<[i128; 2]> {
        let mut shape = vertices.to_vec();
        for side in [1u8, 2, 4, 8] {
            let inside = |point: [i128; 2]| self.outcode(point) & side == 0;
            let mut cut = Vec::with_capacity(shape.len() + 2);
            for (k, to) in shape.iter().enumerate() {
                let from = shape[(k + shape.len() - 1) % shape.len()];
                if inside(from) != inside(*to) {
                    // From the inner end, so that both travels over a shared edge agree.
                    let ends = if inside(from) { [from, *to] } else { [*to, from] };
                    cut.push(self.meet(ends, side, rounding));
                }
                if inside(*to) {
                    cut.push(*to);
                }
            }
            shape = cut;
        }
        shape
    }

    /// What a triangle needs, this being the window and `band` the largest rectangle whose vertices
    /// the words hold.
    pub fn guard_band(&self, band: &Self, triangle: &[[i128; 2]; 3]) -> GuardBand {
        let all = triangle.iter().fold(15, |all, point| all & self.outcode(*point));
        if all != 0 {
            GuardBand::Outside
        } else if triangle.iter().all(|point| band.outcode(*point) == 0) {
            GuardBand::Inside
        } else {
            GuardBand::Clip
        }
    }
}
