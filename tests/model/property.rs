//! Properties on random cases. Every expectation comes from big integers, brute force, or the plain
//! twin that a fast kernel must equal; none from the code it judges.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod coverage;
mod depth;
mod events;
mod import;
mod kernels;
mod rounding;
mod stimulus;
mod walk;
mod words;

use guardbit::cover::SampleConfig;
use guardbit::model::{Drawing, Model, Span};
use guardbit::profile::{Profile, WindowConfig};
use guardbit::setup::Triangle;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// So many random cases, and no files left behind.
fn cases(count: u32) -> ProptestConfig {
    ProptestConfig { cases: count, failure_persistence: None, ..ProptestConfig::default() }
}

/// A profile to change: signed vertices of 6 integer bits around a small window.
fn base(sub_pixel: u32, offset: [u32; 2]) -> Profile {
    let mut profile = guardbit::profile::load("tiny").unwrap();
    profile.window = WindowConfig { width: 16, height: 12 };
    profile.vertex.integer = 6;
    profile.vertex.sub_pixel = sub_pixel;
    profile.vertex.signed = true;
    profile.sample = Some(SampleConfig::sub_pixels(offset[0], offset[1]));
    profile
}

/// Sub-pixel bits and a sample offset.
fn grids() -> impl Strategy<Value = (u32, [u32; 2])> {
    (0..=4u32).prop_flat_map(|s| (Just(s), [0..1u32 << s, 0..1u32 << s]))
}

/// A vertex of [`base`]'s field, on a sample every other time.
fn vertex(sub_pixel: u32, offset: [u32; 2]) -> impl Strategy<Value = [i128; 2]> {
    let end = 1i32 << (5 + sub_pixel);
    let axis = move |axis: usize| {
        let on_sample = (-8..24i32)
            .prop_map(move |pixel| (pixel << sub_pixel) + i32::try_from(offset[axis]).unwrap());
        prop_oneof![on_sample, -end..end].prop_map(i128::from)
    };
    [axis(0), axis(1)]
}

/// The covered pixels of a drawing, after a look at its form: clause C-7.
fn pixels(drawing: &Drawing) -> BTreeSet<(u32, u32)> {
    let mut last: Option<Span> = None;
    for span in &drawing.spans {
        assert!(span.x0 < span.x1);
        // Rows in order, runs in order, and never two runs that touch.
        let after = |before: Span| (before.y, before.x1) < (span.y, span.x0);
        assert!(last.is_none_or(after), "{:?}", drawing.spans);
        last = Some(*span);
    }
    drawing.spans.iter().flat_map(|s| (s.x0..s.x1).map(|x| (s.y, x))).collect()
}

fn draw(model: &Model, triangle: &Triangle) -> Drawing {
    let mut drawing = Drawing::default();
    model.draw(&model.place(*triangle).unwrap(), &mut drawing).unwrap();
    drawing
}
