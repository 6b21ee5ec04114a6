//! What a device draws and shows, as specified or with a slip.

use super::TriangleBench;
use super::quirk::Quirk;
use super::word::setup_words;
use crate::model::{Drawing, Span};
use crate::setup::Triangle;

impl TriangleBench {
    pub(super) fn drawn(&self, triangle: &Triangle) -> Drawing {
        let mut drawing = Drawing::default();
        // A device without the swap sees a negative area and, inside being positive, no samples.
        if self.quirk == Quirk::NoSwap && triangle.area2() < 0 {
            drawing.setup = self.unturned(triangle);
            return drawing;
        }
        // The clamp mode `error` refuses a triangle: it then has no rows.
        if self.model.draw(triangle, &mut drawing).is_err() {
            drawing.spans.clear();
            drawing.depth.clear();
        }
        drawing
    }

    /// Set-up words of a triangle of negative area, edges in the order given. The plane is the same.
    fn unturned(&self, triangle: &Triangle) -> Vec<i128> {
        let Ok(grid) = self.model.profile().grid() else { return Vec::new() };
        let mut words = Vec::new();
        let form = &self.model.profile().form;
        if let Some(edges) = form.edge() {
            let edges = edges.words(triangle, &grid);
            for k in 0..3 {
                words.extend([edges.value[k], edges.step_x[k], edges.step_y[k]]);
            }
        } else if let Some(walk) = form.walk() {
            for k in 0..3 {
                let edge = walk.edge(triangle.xy[k], triangle.xy[(k + 1) % 3], &grid);
                words.extend(edge.map_or([0; 4], |edge| edge.words()));
            }
        }
        let turned = triangle.normalised();
        if let (Some(depth), Some(z)) = (self.model.depth(), turned.z) {
            let plane = depth.plane(&turned, z, &grid);
            words.extend([plane.start, plane.dx, plane.dy]);
        }
        words
    }

    /// Depths of a span: those drawn, and beyond them what the plane goes on to give.
    pub(super) fn depths(&self, triangle: &Triangle, span: &Span) -> Vec<u64> {
        let mut values = vec![0; (span.x1 - span.x0) as usize];
        let turned = triangle.normalised();
        let grid = self.model.profile().grid();
        if let (Some(depth), Some(z), Ok(grid)) = (self.model.depth(), turned.z, grid) {
            // A quirk of the row's number leaves the row itself where it was.
            let y = span.y - u32::from(self.quirk == Quirk::RowsLate);
            depth.span(&depth.plane(&turned, z, &grid), y, span.x0, &mut values);
        }
        values
    }

    /// Set-up words as the device under this hypothesis shows them.
    pub(super) fn device_words(&self, drawing: &Drawing) -> Vec<i128> {
        let mut words = setup_words(&self.model, drawing);
        if self.quirk == Quirk::ZeroExtended {
            for (word, column) in words.iter_mut().zip(&self.model.ports().setup) {
                *word &= (u128::MAX >> (128 - column.width)).cast_signed();
            }
        }
        words
    }
}
