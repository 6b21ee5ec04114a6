//! Whether a model agrees with a case. Spec clause `ID-3`.

use super::case::{Answer, Case, Undone};
use super::picture::Picture;
use crate::machine::Sink;
use crate::model::{Model, Primitive};
use crate::scene::{self, Triangle};

/// A triangle without its depth.
pub(super) fn flat(primitive: &scene::Primitive) -> Option<Triangle> {
    match primitive {
        scene::Primitive::Triangle(Triangle::Real { xy, .. }) => {
            Some(Triangle::Real { xy: *xy, z: None })
        }
        scene::Primitive::Triangle(Triangle::Lattice { xy, .. }) => {
            Some(Triangle::Lattice { xy: *xy, z: None })
        }
        _ => None,
    }
}

/// The primitive, ready for a model without depth.
pub(super) fn prepared(model: &Model, primitive: &scene::Primitive) -> Option<Primitive> {
    let flat = flat(primitive).map(scene::Primitive::Triangle);
    model.prepare(flat.as_ref().unwrap_or(primitive)).ok()
}

/// Whether a model covers what a case says, by capture. What the model refuses it does not draw.
pub(super) fn agrees(model: &Model, case: &Case, undone: &Undone) -> Vec<bool> {
    match &case.answer {
        Answer::Picture { covered, .. } => {
            let mut picture = Picture::empty(covered.size());
            let drawn = prepared(model, &case.primitive)
                .is_some_and(|primitive| model.draw(&primitive, &mut picture).is_ok());
            let pictures = undone.pictures.iter();
            let agrees = |[covered, known]: &[Picture; 2]| drawn && picture.agrees(covered, known);
            pictures.map(|picture| agrees(&picture.shown)).collect()
        }
        Answer::Records(records) => {
            let mut seen = Recorded { model, records: Vec::new(), most: records.len() };
            let drawn = model
                .prepare(&case.primitive)
                .is_ok_and(|primitive| model.draw(&primitive, &mut seen).is_ok());
            vec![drawn && seen.records == *records]
        }
    }
}

/// Records as `eval` writes them; one more than wanted at most.
struct Recorded<'a> {
    model: &'a Model,
    records: Vec<Vec<String>>,
    most: usize,
}

impl Sink for Recorded<'_> {
    fn span(&mut self, _: u32, _: u32, _: u32, _: &[u64]) {}

    fn wants_records(&self) -> bool {
        true
    }

    fn record(&mut self, kind: usize, values: &[i64]) {
        if self.records.len() > self.most {
            return;
        }
        let mut text = String::new();
        if let Some(registers) = self.model.registers() {
            registers.push_record(kind, values, " ", &mut text);
        }
        self.records.push(text.split(' ').map(str::to_owned).collect());
    }
}
