//! The words of a triangle test: columns, set-up, bounding box.

use crate::cover::Rect;
use crate::format::{Clamp, Column};
use crate::model::{Drawing, Model, View};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::bench::FileSpec;

/// Scene triangle number `index`, scattered over the whole scene: a stride that shares no factor
/// with the length visits each once a lap, whatever the size of the set.
pub(super) fn scattered(index: u64, length: usize) -> usize {
    let length = length.max(1) as u64;
    let stride = (length * 5 / 8..=length).find(|n| num_integer::gcd(*n, length) == 1).unwrap_or(1);
    let place = u128::from(index) * u128::from(stride) % u128::from(length);
    usize::try_from(place).unwrap_or(0)
}

/// The model of a valid profile; the set-up bench draws nothing.
pub(super) fn ready(profile: &Profile, draws: bool) -> Model {
    let nothing = Rect { x0: 0, y0: 0, x1: 0, y1: 0 };
    let mut profile = profile.clone();
    if let Some(depth) = profile.depth.as_mut().filter(|depth| depth.clamp == Clamp::Error) {
        // A device cannot refuse a triangle; outside the guard range it decodes as the guard does.
        depth.clamp = Clamp::Guard;
    }
    let view = View { scissor: (!draws).then_some(nothing), ..View::default() };
    Model::with_view(&profile, view)
        .unwrap_or_else(|error| unreachable!("a valid profile: {error}"))
}

/// The bounding box of a triangle in the window: x0 y0 x1 y1, half-open.
pub(super) fn bounds(model: &Model, triangle: &Triangle) -> [u32; 4] {
    let clip = model.clip();
    let Ok(grid) = model.profile().grid() else { return [0; 4] };
    let (x0, x1) = clip.clip(0, grid.pixels(0, triangle.extent(0)));
    let (y0, y1) = clip.clip(1, grid.pixels(1, triangle.extent(1)));
    [x0, y0, x1, y1]
}

pub(super) fn samples(model: &Model, triangle: &Triangle) -> i128 {
    let [x0, y0, x1, y1] = bounds(model, triangle);
    i128::from(x1 - x0) * i128::from(y1 - y0)
}

pub(super) fn input_words(triangle: &Triangle, has_depth: bool) -> Vec<i128> {
    let z = triangle.z.unwrap_or_default();
    let vertices = triangle.xy.iter().zip(z);
    vertices
        .flat_map(|([x, y], z)| [Some(*x), Some(*y), has_depth.then_some(z)])
        .flatten()
        .collect()
}

/// Set-up words and the zero-area flag; a degenerate triangle has zeros.
pub(super) fn setup_words(model: &Model, drawing: &Drawing) -> Vec<i128> {
    let mut words = drawing.setup.clone();
    words.resize(model.ports().setup.len(), 0);
    words.push(i128::from(drawing.zero_area));
    words
}

pub(super) fn file_specs(model: &Model, draws: bool) -> Vec<FileSpec> {
    let ports = model.ports();
    let mut setup = ports.setup.clone();
    setup.push(Column::new(
        "zero_area",
        1,
        false,
        0,
        "1 when the triangle has no area and draws nothing.",
    ));
    let spec = |stem: &str, columns| FileSpec { stem: stem.to_owned(), columns };
    if !draws {
        return vec![spec("setup.cfg", ports.input.clone()), spec("setup.exp", setup)];
    }
    let test = || Column::new("test", 32, false, 0, "Number of the test, from 0.");
    let pixel = |name, meaning| Column::new(name, 17, false, 0, meaning);
    let count = |name, meaning| Column::new(name, 32, false, 0, meaning);
    let mut cfg = vec![test()];
    cfg.extend(setup);
    cfg.extend([
        pixel("x0", "First column of the bounding box in the window."),
        pixel("y0", "First row of the bounding box."),
        pixel("x1", "One past its last column."),
        pixel("y1", "One past its last row."),
    ]);
    let exp = vec![
        test(),
        count("spans", "Maximal runs of covered samples."),
        count("samples", "Covered samples."),
        count("wrap", "Covered samples whose depth left the guard range."),
        count("clamp_above", "Covered samples held at the maximum."),
        count("clamp_below", "Covered samples held at zero."),
        count("inexact", "Covered samples whose read-out dropped a fraction."),
        Column::new("zero_area", 1, false, 0, "1 when the triangle has no area."),
    ];
    let span = vec![
        test(),
        pixel("y", "Row."),
        pixel("x0", "First covered column."),
        pixel("x1", "One past the last covered column."),
    ];
    let mut files =
        vec![spec("triangle.cfg", cfg), spec("triangle.exp", exp), spec("span.exp", span)];
    let place = || vec![test(), pixel("x", "Column."), pixel("y", "Row.")];
    if let Some(z) = &ports.depth {
        let mut columns = place();
        if ports.by_sample {
            columns.push(Column::new("sample", 5, false, 0, "Number of the sample."));
        }
        columns.push(z.clone());
        files.push(spec("depth.exp", columns));
    }
    if let Some(mask) = &ports.mask {
        let mut columns = place();
        columns.push(mask.clone());
        files.push(spec("mask.exp", columns));
    }
    files
}
