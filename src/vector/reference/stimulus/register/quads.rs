//! Random registers of the engine `quads`.

use super::Registers;
use crate::setup::Triangle;
use crate::vector::reference::stimulus::rich::Cases;

/// A triangle of a kind, and whether its vertices were moved to whole pixels: thin ones and ones without area.
fn sampled(given: &mut Cases<'_>, kind: u64) -> (Triangle, bool) {
    let mut triangle = given.triangle(kind);
    let sampled = matches!(kind, 5 | 6) && given.random().below(2) == 0;
    if sampled {
        let s = given.profile().vertex.sub_pixel;
        triangle.xy = triangle.xy.map(|xy| xy.map(|at| at >> s << s));
    }
    (triangle, sampled)
}

/// Edges that are given from a tile on, which has so many pixels on a side.
pub(in crate::vector::reference) struct GivenQuads {
    pub(in crate::vector::reference) tile: i128,
    /// Bits of an edge word.
    pub(in crate::vector::reference) edge: i128,
}

impl Registers for GivenQuads {
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128)) {
        let (triangle, _) = sampled(given, kind);
        let mut tile = given.pixel(2, &triangle).map(i128::from);
        if given.random().below(4) != 0 {
            tile = tile.map(|at| at - at % self.tile);
        }
        for (name, at) in ["tile_x", "tile_y"].into_iter().zip(tile) {
            put(name, at);
        }
        let one = 1i128 << given.profile().vertex.sub_pixel;
        for k in (0..3).filter(|_| kind != 0) {
            let (p, q) = (triangle.xy[(k + 1) % 3], triangle.xy[(k + 2) % 3]);
            let [dx, dy] = [q[0] - p[0], q[1] - p[1]];
            let c = dx * (tile[1] * one - p[1]) - dy * (tile[0] * one - p[0]);
            for (name, mut value) in [("a", -dy * one), ("b", dx * one), ("c", c)] {
                if matches!(kind, 3 | 7) {
                    value >>= 13;
                }
                if kind == 7 && given.random().below(4) == 0 {
                    // The least and the largest word, 0 and -1.
                    let half = 1 << (self.edge - 1);
                    value = match given.random().below(4) {
                        0 => -half,
                        1 => half - 1,
                        2 => 0,
                        _ => -1,
                    };
                }
                put(&format!("{name}{k}"), value);
            }
        }
        let mut range = [[0, 0], given.size()];
        if given.random().below(4) == 0 {
            for axis in 0..2 {
                range[0][axis] = tile[axis] + given.random().below(self.tile);
                range[1][axis] = range[0][axis] + given.random().below(self.tile);
            }
        }
        for (names, ends) in [["x_min", "y_min"], ["x_max", "y_max"]].into_iter().zip(range) {
            for (name, end) in names.into_iter().zip(ends) {
                put(name, end);
            }
        }
    }
}

/// Vertices and a range.
pub(in crate::vector::reference) struct VertexQuads {
    /// The largest end of a range.
    pub(in crate::vector::reference) largest: i128,
    /// The sample in its pixel.
    pub(in crate::vector::reference) sample: [i128; 2],
}

impl Registers for VertexQuads {
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128)) {
        let (mut triangle, sampled) = sampled(given, kind);
        if kind == 3 {
            // As steep as may be.
            let (low, high) = given.profile().vertex.range();
            let ends = if given.random().below(2) == 0 { [high, low] } else { [low, high] };
            [triangle.xy[1][1], triangle.xy[2][1]] = ends;
        }
        super::vertices(&triangle, put);
        let size = if matches!(kind, 0 | 3) { [300, 2] } else { [16, 16] };
        let at = given.pixel(2, &triangle).map(i128::from);
        let before = [16, size[1]];
        let from = [0, 1].map(|axis| (at[axis] - given.random().below(before[axis])).max(0));
        let to = [0, 1].map(|axis| at[axis] + given.random().below(size[axis]));
        let one = 1i128 << given.profile().vertex.sub_pixel;
        let [mut left, mut top] = from.map(|at| at * one);
        let [mut right, mut bottom] = to.map(|at| (at + 1) * one - 1);
        if sampled {
            left += one - self.sample[0];
            top += one - self.sample[1];
        } else if given.random().below(2) == 0 {
            // It begins and ends within a pixel, and vertex 1 is at the place of a sample.
            left += (triangle.xy[1][0] - self.sample[0]).rem_euclid(one);
            top += (triangle.xy[1][1] - self.sample[1]).rem_euclid(one);
            right = (right - given.random().below(2 * one)).max(0);
            bottom = (bottom - given.random().below(2 * one)).max(0);
        }
        if matches!(kind, 0 | 7) && given.random().below(2) == 0 {
            // The first sample is vertex 1.
            let first = [0, 1].map(|axis| triangle.xy[1][axis] - self.sample[axis]);
            [left, top] = first.map(|at| at.clamp(0, self.largest));
            right = left + given.random().below(24 * one);
            bottom = top + given.random().below(24 * one);
        }
        if kind == 3 {
            // Anywhere: edge words wrap along a row.
            [left, top] = [(); 2].map(|()| given.random().below(self.largest + 1));
            right = left + given.random().below(1000 * one);
            bottom = top + given.random().below(one);
        }
        if kind == 7 && given.random().below(2) == 0 {
            left = self.largest - given.random().below(64 * one);
            right = left + given.random().below(24 * one);
        }
        for (name, end) in
            ["left", "top", "right", "bottom"].into_iter().zip([left, top, right, bottom])
        {
            put(name, end);
        }
    }
}
