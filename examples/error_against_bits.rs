//! The largest depth error of one triangle against the number of interpolation bits, as a plot in text.
#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use guardbit::exact::PlaneNumerator;
use guardbit::model::{Drawing, Model};
use guardbit::profile;
use guardbit::scene::Triangle;

/// Vertices in sub-pixels of 1/1024, and depth codes.
const XY: [[i128; 2]; 3] = [[0, 0], [1000 << 10, 37 << 10], [333 << 10, 999 << 10]];
const Z: [i128; 3] = [3, 16_777_215, 5_000_001];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let base = profile::load("sgi-4k")?;
    let exact = PlaneNumerator::new(XY, Z).ok_or("the triangle has an area")?;
    println!("bits  largest error in codes");
    for bits in (2..=16).step_by(2) {
        let mut profile = base.clone();
        if let Some(depth) = &mut profile.depth {
            depth.interpolation = bits;
        }
        let (model, grid) = (Model::new(&profile)?, profile.grid()?);
        let mut drawing = Drawing::default();
        model.draw(&model.snap(&Triangle::Lattice { xy: XY, z: Some(Z) })?, &mut drawing)?;
        let mut depths = drawing.depth.iter();
        let mut worst = 0.0f64;
        for span in &drawing.spans {
            for (x, depth) in (span.x0..span.x1).zip(&mut depths) {
                let at = grid.position(x.into(), span.y.into());
                // Exact depth as numerator over the triangle's area: the read-out cuts, so half a code is fair.
                let off = i128::from(*depth) * exact.whole - exact.at(at);
                worst = worst.max((real(off) / real(exact.whole) + 0.5).abs());
            }
        }
        // One mark for each doubling above half a code.
        let marks = (worst / 0.5).log2().max(0.0).ceil();
        println!("{bits:>4}  {worst:>12.3}  {}", "#".repeat(marks_of(marks)));
    }
    Ok(())
}

#[allow(clippy::cast_precision_loss, reason = "an error is plotted")]
fn real(value: i128) -> f64 {
    value as f64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few marks")]
fn marks_of(marks: f64) -> usize {
    marks as usize
}
