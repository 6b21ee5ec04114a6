//! Random registers, answered by the model.

mod anchored;
mod quads;
mod slopes;
mod sub_scanlines;

pub(in crate::vector::reference) use anchored::Anchored;
pub(in crate::vector::reference) use quads::{GivenQuads, VertexQuads};
pub(in crate::vector::reference) use slopes::Slopes;
pub(in crate::vector::reference) use sub_scanlines::SubScanlines;

use super::rich::Cases;
use super::{Digest, Stimulus};
use crate::format::Layout;
use crate::model::Model;
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::device::records;

/// Records that are looked at.
const MOST: u64 = 1024;

/// What is written into the registers of an engine.
pub(in crate::vector::reference) trait Registers {
    /// Puts the values of a case into registers by name; the others hold anything.
    fn put(&self, given: &mut Cases<'_>, kind: u64, put: &mut dyn FnMut(&str, i128));
}

/// The digest of what random registers draw: the number of the records, and their words.
pub(in crate::vector::reference) fn digest(
    profile: &Profile,
    model: &Model,
    engine: &dyn Registers,
    seed: u64,
    cases: u64,
) -> u64 {
    let registers = model.registers().unwrap_or_else(|| unreachable!("it begins at registers"));
    let mut given = Cases::new(Stimulus::new(profile, seed), None);
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for n in 0..cases {
        let words = words(&registers.input, &mut given, n & 7, engine);
        let drawn = records(model, &words, MOST);
        digest.number(drawn.total);
        for (kind, values) in drawn.kept {
            if registers.records.len() > 1 {
                digest.number(i128::try_from(kind).unwrap_or(0));
            }
            for word in registers.records[kind].words(&values) {
                digest.number(word);
            }
        }
    }
    digest.0
}

/// The words of a case: anything, but for what the engine puts there.
fn words(input: &Layout, given: &mut Cases<'_>, kind: u64, engine: &dyn Registers) -> Vec<u32> {
    let any = |given: &mut Cases<'_>| {
        let high = given.random().next() << 31;
        u32::try_from((high | given.random().next()) & u64::from(u32::MAX)).unwrap_or(0)
    };
    let mut words: Vec<u32> = (0..input.len()).map(|_| any(given)).collect();
    engine.put(given, kind, &mut |name, value| {
        if let Some(gather) = input.find(name) {
            gather.scatter(value, &mut words);
        }
    });
    words
}

fn vertices(triangle: &Triangle, put: &mut dyn FnMut(&str, i128)) {
    for (n, [x, y]) in triangle.xy.into_iter().enumerate() {
        put(&format!("x{n}"), x);
        put(&format!("y{n}"), y);
    }
}
