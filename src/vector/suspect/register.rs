//! Suspects of a machine that begins at registers: the neighbours of its profile.

use super::{Suspect, Suspects};
use crate::model::Model;
use crate::profile::neighbours;
use crate::vector::bench::RegisterBench;
use std::sync::Arc;

impl Suspects for RegisterBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let suspect = |neighbour: crate::profile::Neighbour| {
            let model = Arc::new(Model::new(&neighbour.profile).ok()?);
            Some(Suspect::new(self, neighbour.change, self.recorder(model)))
        };
        neighbours(self.profile()).into_iter().filter_map(suspect).collect()
    }
}
