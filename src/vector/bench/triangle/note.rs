//! Rows of pixels with several samples, and what a triangle's values meet of the coverage cells.

use super::TriangleBench;
use crate::model::Drawing;
use crate::setup::{Gradient, Triangle};
use crate::vector::bench::Coverage;
use crate::vector::table::Table;

impl TriangleBench {
    pub(super) fn note_setup(&self, triangle: &Triangle, coverage: &mut Coverage) {
        let triangle = triangle.normalised();
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        if triangle.area2() == 0 {
            return;
        }
        let gradient = Gradient::new(&triangle, z);
        let Ok(grid) = self.model.profile().grid() else { return };
        let plane = depth.plane(&triangle, z, &grid);
        let scaled = gradient.x << (grid.sub_pixel + depth.read_out().fraction());
        let rest = scaled.rem_euclid(gradient.area2);
        let remainder = match (rest, (2 * rest).cmp(&gradient.area2)) {
            (0, _) => 0,
            (_, std::cmp::Ordering::Less) => 1,
            (_, std::cmp::Ordering::Equal) => 2,
            (_, std::cmp::Ordering::Greater) => 3,
        };
        let octant = Coverage::octant(gradient.x, gradient.y);
        coverage.note(octant, depth.read_out().zone(plane.start().raw()), remainder);
    }

    /// Depths and masks where pixels have several samples.
    pub(super) fn emit_samples(&self, test: i128, drawing: &Drawing, tables: &mut [Table]) {
        let by_sample = self.model.ports().by_sample;
        let (depths, masks) = match tables {
            [depths, masks] => (Some(depths), masks),
            [masks] => (None, masks),
            _ => return,
        };
        let pixels = drawing.spans.iter().flat_map(|span| (span.x0..span.x1).map(|x| (x, span.y)));
        let pixels: Vec<([i128; 2], u32)> = pixels
            .map(|(x, y)| [x, y].map(i128::from))
            .zip(drawing.masks.iter().copied())
            .collect();
        for ([x, y], mask) in &pixels {
            masks.push(&[test, *x, *y, i128::from(*mask)]);
        }
        let Some(depths) = depths else { return };
        let mut values = drawing.depth.iter().map(|z| i128::from(*z));
        for ([x, y], mask) in pixels {
            if by_sample {
                for sample in (0..32).filter(|sample| mask >> sample & 1 == 1) {
                    let Some(z) = values.next() else { return };
                    depths.push(&[test, x, y, sample, z]);
                }
            } else if let Some(z) = values.next() {
                depths.push(&[test, x, y, z]);
            }
        }
    }

    pub(super) fn note_samples(
        &self,
        triangle: &Triangle,
        drawing: &Drawing,
        coverage: &mut Coverage,
    ) {
        let triangle = triangle.normalised();
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        let Ok(grid) = self.model.profile().grid() else { return };
        if drawing.spans.is_empty() {
            return;
        }
        let plane = depth.plane(&triangle, z, &grid);
        let read = depth.read_out();
        let octant = Coverage::octant(plane.dx().raw(), plane.dy().raw());
        for span in &drawing.spans {
            for x in span.x0..span.x1 {
                let value = plane.at(i128::from(x), i128::from(span.y)).raw();
                let remainder = Coverage::remainder(value.cast_unsigned(), read.fraction());
                coverage.note(octant, read.zone(value), remainder);
            }
        }
    }
}
