//! What a host writes for the engine `quads`: vertices, or coefficients normalised by the larger one. Spec
//! clause `RG-4`.

use super::Source;
use super::engine::Quads;
use crate::bits::Rounding;
use crate::setup::Triangle;

impl Quads {
    /// The words of a triangle: one list, or one a tile.
    pub(super) fn host_words(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let clip = self.target.clip;
        match &self.source {
            Source::Vertices { vertices, range, .. } => {
                // This hardware has no culling of its own: a host turns triangles to one side.
                let [p, q, r] = triangle.xy;
                let flipped = (q[0] - p[0]) * (r[1] - p[1]) < (r[0] - p[0]) * (q[1] - p[1]);
                let xy = if flipped { [p, r, q] } else { [p, q, r] };
                let mut words = vec![0; count];
                for (vertex, at) in vertices.iter().zip(xy) {
                    for (gather, value) in vertex.iter().zip(at) {
                        gather.scatter(value, &mut words);
                    }
                }
                let [x0, y0, x1, y1] = self.target.bounds(&Triangle { xy, z: None });
                let s = self.target.grid.sub_pixel;
                let ends = [x0 & !1, y0 & !1, x1, y1].map(|pixel| i64::from(pixel) << s);
                for (n, gather) in range.iter().enumerate() {
                    gather.scatter(i128::from(ends[n]) - i128::from(n >= 2), &mut words);
                }
                if x0 < x1 && y0 < y1 { vec![words] } else { Vec::new() }
            }
            Source::Given { tile, range, edges, fraction } => {
                let Some(descent) = self.config.descent else { return Vec::new() };
                let [x0, y0, x1, y1] = self.target.bounds(triangle);
                let whole = |at: u32| at / descent.tile * descent.tile;
                let mut lists = Vec::new();
                for y in (whole(y0)..y1).step_by(descent.tile as usize) {
                    for x in (whole(x0)..x1).step_by(descent.tile as usize) {
                        let mut words = vec![0; count];
                        for (gather, value) in tile.iter().zip([x, y]) {
                            gather.scatter(i128::from(value), &mut words);
                        }
                        let [cx0, cx1] = clip.clip(0, (0, i128::MAX >> 1)).into();
                        let [cy0, cy1] = clip.clip(1, (0, i128::MAX >> 1)).into();
                        for (gather, value) in range.iter().zip([cx0, cx1, cy0, cy1]) {
                            gather.scatter(i128::from(value), &mut words);
                        }
                        for (gathers, edge) in
                            edges.iter().zip(self.normalised(triangle, *fraction, [x, y]))
                        {
                            for (gather, value) in gathers.iter().zip(edge) {
                                gather.scatter(value.into(), &mut words);
                            }
                        }
                        lists.push(words);
                    }
                }
                lists
            }
        }
    }

    /// a, b and c of each edge at the sample of pixel `origin`, the larger of |a| and |b| at 1.0.
    fn normalised(&self, triangle: &Triangle, fraction: u32, origin: [u32; 2]) -> [[i64; 3]; 3] {
        let at = self.target.grid.position(i128::from(origin[0]), i128::from(origin[1]));
        let s = self.target.grid.sub_pixel;
        crate::setup::edges(&triangle.normalised()).map(|edge| {
            let largest = edge.a.abs().max(edge.b.abs()).max(1);
            let part = |value: i128, shift: u32| {
                let nearest = Rounding::NearestEven.divide(
                    value << (fraction - shift.min(fraction)),
                    largest << (shift - shift.min(fraction)),
                );
                nearest.and_then(|(value, _)| i64::try_from(value).ok()).unwrap_or(0)
            };
            // E in sub-pixels squared, over a in sub-pixels, is in sub-pixels: c moves down by s.
            [part(edge.a, 0), part(edge.b, 0), part(edge.at(at[0], at[1]), s)]
        })
    }
}
