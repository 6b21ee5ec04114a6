//! The words of a triangle test: columns, vertices, bounding box.

use super::{FileSpec, TriangleAnswers};
use crate::cover::Rect;
use crate::format::{Clamp, Column, Role, WordFormat};
use crate::machine::Target;
use crate::model::{Model, View};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::vector::device::grid;

/// The model of a valid profile, that draws or, for a set-up alone, draws nothing.
pub(in crate::vector) fn ready(profile: &Profile, draws: bool) -> Model {
    let nothing = Rect { x0: 0, y0: 0, x1: 0, y1: 0 };
    let mut profile = profile.clone();
    // Channels have a bench of their own.
    (profile.channel, profile.w) = (Vec::new(), None);
    if let Some(depth) = profile.depth.as_mut().filter(|depth| depth.clamp == Clamp::Error) {
        // A device cannot refuse a triangle; outside the guard range it decodes as the guard does.
        depth.clamp = Clamp::Guard;
    }
    let view = View { scissor: (!draws).then_some(nothing), ..View::default() };
    Model::with_view(&profile, view)
        .unwrap_or_else(|error| unreachable!("a valid profile: {error}"))
}

/// The bounding box of a triangle in the window: x0 y0 x1 y1, half-open.
pub(in crate::vector) fn bounds(model: &Model, triangle: &Triangle) -> [u32; 4] {
    bounds_within(model, triangle, model.profile().box_reach())
}

/// The same, if the box reaches so many sub-pixels beyond the vertices.
pub(in crate::vector) fn bounds_within(
    model: &Model,
    triangle: &Triangle,
    reach: i128,
) -> [u32; 4] {
    Target { grid: grid(model), clip: model.clip(), reach }.bounds(triangle)
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
    let mut columns = model.ports().setup.clone();
    columns.push(Role::ZERO_AREA.column(WordFormat::unsigned(1)));
    columns
}

/// The columns that say where a row belongs: its test, its row of pixels, and its pixel or its run.
pub(super) fn place_columns(roles: &[Role]) -> Vec<Column> {
    let test = Role::TEST.column(Role::TEST_WORD);
    std::iter::once(test).chain(roles.iter().map(|role| role.column(Role::PIXEL_WORD))).collect()
}

/// A run of covered samples.
pub(super) const RUN: &[Role] = &[Role::Y, Role::X_BEGIN, Role::X_END];
/// A pixel.
pub(super) const PIXEL: &[Role] = &[Role::Y, Role::X];

/// The files that an engine answers.
pub(super) fn answer_files(model: &Model) -> TriangleAnswers<FileSpec> {
    let ports = model.ports();
    let counts = [
        Role::SPANS,
        Role::SAMPLES,
        Role::WRAP,
        Role::CLAMP_ABOVE,
        Role::CLAMP_BELOW,
        Role::INEXACT,
    ];
    let mut exp = counts.map(|role| role.column(Role::COUNT_WORD)).to_vec();
    exp.push(Role::ZERO_AREA.column(WordFormat::unsigned(1)));
    let depths = ports.depth.as_ref().map(|depth| {
        let mut key = place_columns(PIXEL);
        key.extend(ports.by_sample.then(|| Role::SAMPLE.column(WordFormat::unsigned(5))));
        FileSpec::keyed("depth.exp", key, vec![depth.clone()])
    });
    let masks = ports.mask.as_ref();
    let masks =
        masks.map(|mask| FileSpec::keyed("mask.exp", place_columns(PIXEL), vec![mask.clone()]));
    TriangleAnswers {
        exp: FileSpec::keyed("triangle.exp", place_columns(&[]), exp),
        spans: FileSpec::keyed("span.exp", place_columns(RUN), Vec::new()),
        depths,
        masks,
    }
}
