//! One triangle through a profile: its set-up words, its spans and depths, and its log of numeric events.
#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use guardbit::model::{Drawing, Model};
use guardbit::profile;
use guardbit::scene::Triangle;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut profile = profile::load("sgi-4k")?;
    // Too few interpolation bits, so that the log has something to say.
    if let Some(depth) = &mut profile.depth {
        depth.interpolation = 4;
    }
    let model = Model::new(&profile)?;
    // Real coordinates in pixels, y down; depth in codes.
    let xy = [[1.25, 0.5], [9.0, 2.0], [3.0, 6.75]];
    let z = Some([0.0, 16_777_215.0, 9_000_000.0]);
    let triangle = model.snap(&Triangle::Real { xy, z })?;
    let mut drawing = Drawing::default();
    model.draw(&triangle, &mut drawing)?;

    for (column, word) in model.ports().setup.iter().zip(&drawing.setup) {
        println!("{:<5} {word:>16}   {}", column.name, column.meaning);
    }
    let mut depths = drawing.depth.iter();
    for span in &drawing.spans {
        let row: Vec<&u64> = depths.by_ref().take((span.x1 - span.x0) as usize).collect();
        println!("row {} columns {}..{}: depth {row:?}", span.y, span.x0, span.x1);
    }
    println!("{} samples", drawing.samples());
    for (event, count) in drawing.event_counts() {
        println!("event {event}: {count}");
    }
    Ok(())
}
