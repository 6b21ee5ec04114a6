//! The reference model of the set-up: vertices in, set-up words out.

use super::Device;
use crate::model::{Drawing, Model};
use crate::setup::{Gradient, Triangle};
use crate::vector::bench::{Coverage, SetupTest, Single};
use crate::vector::table::Table;
use std::cmp::Ordering;
use std::sync::Arc;

/// The set-up of a model.
pub(in crate::vector) struct SetUp {
    model: Arc<Model>,
}

impl SetUp {
    /// The set-up of a model that draws nothing.
    pub(in crate::vector) fn new(model: Arc<Model>) -> Self {
        Self { model }
    }

    fn met(&self, triangle: &Triangle, met: &mut Coverage) {
        let triangle = triangle.normalised();
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        if triangle.area2() == 0 {
            return;
        }
        let gradient = Gradient::new(&triangle, z);
        let grid = super::triangle::grid(&self.model);
        let plane = depth.plane(&triangle, z, &grid);
        let scaled = gradient.x << (grid.sub_pixel + depth.read_out().fraction());
        let rest = scaled.rem_euclid(gradient.area2);
        let remainder = match (rest, (2 * rest).cmp(&gradient.area2)) {
            (0, _) => 0,
            (_, Ordering::Less) => 1,
            (_, Ordering::Equal) => 2,
            (_, Ordering::Greater) => 3,
        };
        let octant = Coverage::octant(gradient.x, gradient.y);
        met.note(octant, depth.read_out().zone(plane.start().raw()), remainder);
    }
}

/// Set-up words and the flag of no area; a triangle without area has zeros.
pub(in crate::vector) fn setup_words(model: &Model, triangle: &Triangle) -> Vec<i128> {
    let mut drawing = Drawing::default();
    super::triangle::draw(model, triangle, &mut drawing);
    // Raw, for the set's columns to cut: a suspect of another profile may count other units, and writes
    // its own bits all the same.
    let mut words = drawing.raw_setup();
    words.resize(model.ports().setup.len(), 0);
    words.push(i128::from(drawing.zero_area));
    words
}

impl Device<SetupTest> for SetUp {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, met: &mut Coverage) {
        rows.exp.push(&setup_words(&self.model, &test.triangle));
        self.met(&test.triangle, met);
    }
}
