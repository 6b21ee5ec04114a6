//! Machines that begin at registers, on toy formats and exhaustively, against plain twins written from the
//! clauses; and the built-in profiles of real ones.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod anchored;
mod channel;
mod edge_functions;
mod lines;
mod profiles;
mod quads;
mod slopes;
mod sub_scanlines;

use guardbit::model::{Model, Records};
use guardbit::profile::{Profile, parse};

/// The records that words draw, as values in the engine's order.
fn records(model: &Model, words: &[u32]) -> Vec<(usize, Vec<i64>)> {
    let mut records = Records::up_to(u64::MAX);
    model.draw(words, &mut records).unwrap();
    records.kept
}

/// A toy profile: a vertex field and sample, then what is under `[form.registers]`.
fn toy(integer: u32, sub_pixel: u32, sample: [u32; 2], registers: &str) -> Profile {
    let [x, y] = sample;
    let text = format!(
        "schema = 1
name = \"toy\"
window = {{ width = 8, height = 8 }}
vertex = {{ integer = {integer}, sub-pixel = {sub_pixel}, signed = true, closed = false, snap = \"floor\", \
         source = \"f64\", endless = \"refuse\" }}
sample = {{ x = {x}, y = {y} }}
[form.registers]
{registers}"
    );
    parse(&text, "toy").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn model(integer: u32, sub_pixel: u32, sample: [u32; 2], registers: &str) -> Model {
    Model::new(&toy(integer, sub_pixel, sample, registers)).unwrap()
}

/// A value mod 2^width, as a signed number: the plain twin of every wrap.
fn wrap(value: i128, width: u32) -> i128 {
    let reduced = value.rem_euclid(1 << width);
    if reduced >= 1 << (width - 1) { reduced - (1 << width) } else { reduced }
}

/// A signed number as a register.
fn word(value: i128) -> u32 {
    u32::try_from(value.rem_euclid(1 << 32)).unwrap()
}
