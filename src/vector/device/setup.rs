//! The reference model of the set-up: vertices in, set-up words out.

use super::Device;
use crate::format::Role;
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

    /// Counts what a triangle meets.
    pub(in crate::vector) fn met(&self, given: &Triangle, met: &mut Coverage) {
        let triangle = given.normalised();
        met.meet(match given.area2().cmp(&0) {
            Ordering::Less => "winding.negative",
            Ordering::Equal => "winding.zero",
            Ordering::Greater => "winding.positive",
        });
        let (Some(depth), Some(z)) = (self.model.depth(), triangle.z) else { return };
        if triangle.area2() == 0 {
            return;
        }
        let gradient = Gradient::new(&triangle, z);
        let grid = super::triangle::grid(&self.model);
        let plane = depth.plane(&triangle, z, &grid);
        let fraction = depth.read_out().fraction();
        let scale = grid.sub_pixel + fraction;
        let ([start, x, y], whole) = depth.place(&gradient, &grid).numerators(&gradient);
        for (role, numerator) in [
            (Role::DEPTH_INIT, start << fraction),
            (Role::DEPTH_DX, x << scale),
            (Role::DEPTH_DY, y << scale),
        ] {
            let magnitude = numerator.unsigned_abs();
            let divisor = whole.unsigned_abs();
            if 2 * (magnitude % divisor) == divisor {
                let sign = if numerator < 0 { "negative" } else { "positive" };
                let quotient = (magnitude / divisor) & 3;
                met.meet(&format!("tie.{}.{sign}.q{quotient}", role.pattern));
            }
        }
        let rest = (x << scale).rem_euclid(whole);
        let remainder = match (rest, (2 * rest).cmp(&whole)) {
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
    words.push(i128::from(drawing.zero_area || drawing.culled));
    words
}

impl Device<SetupTest> for SetUp {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, met: &mut Coverage) {
        rows.exp.push(&setup_words(&self.model, &test.triangle));
        self.met(&test.triangle, met);
    }
}
