//! The words of a triangle test: columns, vertices, bounding box.

use super::{FileSpec, TriangleAnswers};
use crate::cover::Rect;
use crate::format::{Clamp, Column};
use crate::model::{Model, View};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::device::grid;

/// The model of a valid profile, that draws or, for a set-up alone, draws nothing.
pub(in crate::vector) fn ready(profile: &Profile, draws: bool) -> Model {
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
    let (clip, grid) = (model.clip(), grid(model));
    let (x0, x1) = clip.clip(0, grid.pixels(0, triangle.extent(0)));
    let (y0, y1) = clip.clip(1, grid.pixels(1, triangle.extent(1)));
    [x0, y0, x1, y1]
}

/// The words of the vertices.
pub(super) fn input_words(triangle: &Triangle, has_depth: bool) -> Vec<i128> {
    let depth = |n: usize| {
        let z = triangle.z.unwrap_or_else(|| unreachable!("a test of a depth plane has depth"));
        z[n]
    };
    let vertices = triangle.xy.iter().enumerate();
    vertices
        .flat_map(|(n, [x, y])| [Some(*x), Some(*y), has_depth.then(|| depth(n))])
        .flatten()
        .collect()
}

/// Set-up words and the flag of no area.
pub(super) fn setup_columns(model: &Model) -> Vec<Column> {
    let meaning = "1 when the triangle has no area and draws nothing.";
    let mut columns = model.ports().setup.clone();
    columns.push(Column::new("zero_area", 1, false, 0, meaning));
    columns
}

/// The files that an engine answers.
pub(super) fn answer_files(model: &Model) -> TriangleAnswers<FileSpec> {
    let ports = model.ports();
    let test = || Column::new("test", 32, false, 0, "Number of the test, from 0.");
    let pixel = |name, meaning| Column::new(name, 17, false, 0, meaning);
    let count = |name, meaning| Column::new(name, 32, false, 0, meaning);
    let spec = |stem: &str, columns| FileSpec { stem: stem.to_owned(), columns };
    let counts = vec![
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
    let place = || vec![test(), pixel("x", "Column."), pixel("y", "Row.")];
    let depths = ports.depth.as_ref().map(|z| {
        let mut columns = place();
        if ports.by_sample {
            columns.push(Column::new("sample", 5, false, 0, "Number of the sample."));
        }
        columns.push(z.clone());
        spec("depth.exp", columns)
    });
    let masks = ports.mask.as_ref().map(|mask| {
        let mut columns = place();
        columns.push(mask.clone());
        spec("mask.exp", columns)
    });
    TriangleAnswers {
        exp: spec("triangle.exp", counts),
        spans: spec("span.exp", span),
        depths,
        masks,
    }
}
