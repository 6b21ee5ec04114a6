//! Coordinates, areas, edge words, and who covers what.

use super::{Bits, Evaluator, Extremes, Requirements, real, triangle};
use crate::measure::accuracy::{Face, Stage, bounding_box, needed_width};
use crate::profile::Profile;

pub(super) fn require(stage: &Stage, profile: &Profile, found: &mut Requirements) {
    let pixel = real(1 << stage.grid.sub_pixel);
    for (axis, name) in [(0, "x"), (1, "y")] {
        let ends = stage.faces.iter().flat_map(|face| {
            let (low, high) = face.triangle.extent(axis);
            [(low, face), (high, face)]
        });
        found.ranges.extend(Extremes::of(ends).range(
            name,
            "pixels",
            |value| real(value) / pixel,
            triangle,
        ));
    }
    let areas = stage.faces.iter().map(|face| (face.triangle.area2(), face));
    let mut areas = Extremes::of(areas).range("twice area", "sub-pixels squared", real, triangle);
    if let (Some(areas), lost @ 1..) = (&mut areas, stage.snap.vanished) {
        let others = format!("; {lost} more triangles have no area on this grid");
        areas.evidence += &others;
    }
    found.ranges.extend(areas);
    found.bits.extend(vertex_bits(stage, profile));
    found.bits.extend(edge_bits(stage, profile));
    found.evaluators.push(Evaluator {
        name: "coverage",
        needed: stage.samples > 0,
        evidence: match stage.runs.first() {
            Some(run) => format!("pixel ({}, {}) is covered", run.x0, run.y),
            None => "no sample is covered".to_owned(),
        },
    });
    found.evaluators.push(sub_pixels(stage));
    found.evaluators.push(scissor(stage));
}

/// Integer and sub-pixel bits that the coordinates take.
fn vertex_bits(stage: &Stage, profile: &Profile) -> Vec<Bits> {
    let vertex = profile.vertex;
    let s = stage.grid.sub_pixel;
    let coordinates = || {
        stage
            .faces
            .iter()
            .flat_map(|face| face.triangle.xy.into_iter().flatten().map(move |value| (value, face)))
    };
    let mut bits = Vec::new();
    let fits = |integer: u32, value: i128| {
        let mut field = vertex;
        field.integer = integer;
        let (low, high) = field.range();
        (low..=high).contains(&value)
    };
    let lowest = u32::from(vertex.signed);
    let needs = |value: i128| (lowest..=vertex.integer).find(|n| fits(*n, value));
    let most = Extremes::of(coordinates().filter_map(|(v, face)| Some((needs(v)?, (v, face)))));
    if let Some((needs, (value, face))) = most.high {
        let place = real(value) / real(1 << s);
        let evidence = format!("a coordinate of {place} pixels in {}", triangle(face));
        bits.push(Bits { field: "vertex-integer", needs, has: vertex.integer, evidence });
    }
    let fine = |value: i128| s - value.trailing_zeros().min(s);
    let most = Extremes::of(coordinates().map(|(value, face)| (fine(value), (value, face))));
    if let Some((needs, (value, face))) = most.high {
        let evidence = format!("a coordinate of {value} / 2^{s} pixels in {}", triangle(face));
        bits.push(Bits { field: "sub-pixel", needs, has: s, evidence });
    }
    bits
}

/// Bits of the edge word: the widest that any triangle meets in its bounding box.
fn edge_bits(stage: &Stage, profile: &Profile) -> Option<Bits> {
    let edges = *profile.form.edge()?;
    let widths = stage.faces.iter().map(|face| (needed_width(stage, face, edges), face));
    let (needs, face) = Extremes::of(widths).high?;
    let evidence = format!("an edge of {} in its bounding box", triangle(face));
    Some(Bits { field: "edge-width", needs, has: edges.width, evidence })
}

fn sub_pixels(stage: &Stage) -> Evaluator {
    let name = "sub-pixel positions";
    let mask = (1 << stage.grid.sub_pixel) - 1;
    let off = |face: &&Face| face.triangle.xy.iter().flatten().any(|value| value & mask != 0);
    match stage.faces.iter().find(off) {
        Some(face) => Evaluator {
            name,
            needed: true,
            evidence: format!("{} has a vertex that is not on the pixel grid", triangle(face)),
        },
        None => Evaluator {
            name,
            needed: false,
            evidence: "every vertex lies on the corner of a pixel".to_owned(),
        },
    }
}

/// Whether a triangle reaches beyond the window.
fn scissor(stage: &Stage) -> Evaluator {
    let name = "scissor";
    let beyond = |face: &&Face| {
        let axis = |axis| {
            let (first, end) = stage.grid.pixels(axis, face.triangle.extent(axis));
            i128::from(u32::MAX).min(end - first).max(0)
        };
        let [x0, y0, x1, y1] = bounding_box(stage, face);
        axis(0) * axis(1) > i128::from(x1 - x0) * i128::from(y1 - y0)
    };
    match stage.faces.iter().find(beyond) {
        Some(face) => Evaluator {
            name,
            needed: true,
            evidence: format!("{} extends beyond the window", triangle(face)),
        },
        None => Evaluator {
            name,
            needed: false,
            evidence: "no triangle covers a sample outside the window".to_owned(),
        },
    }
}
