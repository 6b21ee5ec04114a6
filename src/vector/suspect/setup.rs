//! Suspects of the set-up.

use super::fault::Path;
use super::unit::Unit;
use super::{Suspect, Suspects};
use crate::cover::EdgeWordConfig;
use crate::model::Model;
use crate::profile::neighbours;
use crate::setup::{Division, Triangle};
use crate::vector::bench::{Coverage, SetupBench, SetupTest, Single, ready};
use crate::vector::device::{Device, SetUp, grid, setup_words};
use crate::vector::table::Table;
use std::sync::Arc;

impl Suspects for SetupBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let mut list = Vec::new();
        for neighbour in neighbours(self.model().profile()) {
            let model = Arc::new(ready(&neighbour.profile, false));
            // Columns stay those of the set: a device is compared in the set's own widths, and
            // narrower words may come with their sign or with zeros above them.
            let (ours, theirs) = (&self.model().ports().setup, &model.ports().setup);
            if theirs.len() != ours.len() {
                continue;
            }
            if theirs.iter().zip(ours).any(|(a, b)| a.width < b.width) {
                let device = ZeroExtended { model: Arc::clone(&model) };
                list.push(Suspect::new(self, neighbour.change.clone(), device));
            }
            list.push(Suspect::new(self, neighbour.change, SetUp::new(model)));
        }
        if self.model().ports().mask.is_none() {
            let device = Unturned { model: Arc::clone(self.model()) };
            list.push(Suspect::new(self, NO_SWAP, device));
        }
        if is_plain(self.model()) {
            let faults = Path::faults(|path| {
                let triangle = Triangle { xy: [[0, 0], [2, 0], [0, 2]], z: Some([0; 3]) };
                unit(self.model()).words(path, &triangle, [0; 3]);
            });
            list.extend(faults.into_iter().map(|fault| {
                let device = Faulty { path: Path::with(&fault), model: Arc::clone(self.model()) };
                Suspect::at(self, &fault, device)
            }));
        }
        list
    }
}

/// A defect of the set-up that a device of whole triangles can have too.
pub(super) const NO_SWAP: &str =
    "triangles of negative area are not reversed: v1 and v2 are not exchanged";

/// A set-up whose words are narrower than the set's, with zeros above them.
struct ZeroExtended {
    model: Arc<Model>,
}

impl Device<SetupTest> for ZeroExtended {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let mut words = setup_words(&self.model, &test.triangle);
        for (word, column) in words.iter_mut().zip(&self.model.ports().setup) {
            *word &= (u128::MAX >> (128 - column.width)).cast_signed();
        }
        rows.exp.push(&words);
    }
}

/// A set-up without the swap of two vertices.
struct Unturned {
    model: Arc<Model>,
}

impl Unturned {
    /// Set-up words of a triangle of negative area, edges in the order given. The plane is the same.
    fn words(&self, triangle: &Triangle) -> Vec<i128> {
        let (grid, mut words) = (grid(&self.model), Vec::new());
        let form = &self.model.profile().form;
        if let Some(edges) = form.edge() {
            let edges = edges.words(triangle, &grid);
            for k in 0..3 {
                words.extend(edges.raw(k));
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
            words.extend(plane.raw());
        }
        words.resize(self.model.ports().setup.len(), 0);
        words.push(0);
        words
    }
}

impl Device<SetupTest> for Unturned {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, _: &mut Coverage) {
        let words = if test.triangle.area2() < 0 {
            self.words(&test.triangle)
        } else {
            setup_words(&self.model, &test.triangle)
        };
        rows.exp.push(&words);
    }
}

/// Whether a plain unit does what the profile says: edge functions of samples, a depth plane, an exact quotient, no
/// depth bias.
fn is_plain(model: &Model) -> bool {
    let exact = |depth: &crate::value::Depth| {
        let config = depth.config();
        config.division == Division::Quotient && config.bias.is_none()
    };
    let samples = |edge: EdgeWordConfig| edge.conservative.is_none();
    model.profile().plain_edges().is_some_and(samples) && model.depth().is_some_and(exact)
}

/// The plain unit of a model that has one.
fn unit(model: &Model) -> Unit<'_> {
    let Some((edge, depth)) = model.profile().plain_edges().zip(model.depth()) else {
        unreachable!("only a plain unit is suspected of a fault")
    };
    let field = &model.ports().input[0];
    let columns = &model.ports().setup;
    let signed = model.profile().vertex.signed;
    Unit { edge, depth, grid: grid(model), coordinate: field.width, signed, columns }
}

/// A plain unit with a fault.
struct Faulty {
    path: Path,
    model: Arc<Model>,
}

impl Device<SetupTest> for Faulty {
    fn answer(&mut self, test: &SetupTest, rows: &mut Single<Table>, _: &mut Coverage) {
        self.path.next_record();
        let z = test.triangle.z.unwrap_or_default();
        rows.exp.push(&unit(&self.model).words(&self.path, &test.triangle, z));
    }
}
