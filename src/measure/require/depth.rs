//! Depths, slopes, walks, guard bits, and whether anything overlaps.

use super::{Bits, Evaluator, Extremes, Range, Requirements, fraction_bits, real, triangle};
use crate::format::{Clamp, ReadOut};
use crate::measure::accuracy::{Face, Reach, Stage, depth_of};
use crate::profile::Profile;
use crate::value::Depth;

pub(super) fn require(stage: &Stage, profile: &Profile, found: &mut Requirements) {
    let deep = || stage.faces.iter().filter(|face| face.depth.is_some());
    found.evaluators.push(overlap(stage));
    let codes =
        deep().flat_map(|face| face.triangle.z.into_iter().flatten().map(move |z| (z, face)));
    let codes = Extremes::of(codes);
    found.ranges.extend(codes.range("depth", "ULP", real, triangle));
    for (axis, name) in [(0, "depth slope right"), (1, "depth slope down")] {
        let slopes = deep().filter_map(|face| {
            let exact = face.depth.as_ref()?.exact;
            let slope = real(exact.slope[axis]) * real(1 << stage.grid.sub_pixel);
            Some((slope / real(exact.whole), face))
        });
        found.ranges.extend(Extremes::of(slopes).range(name, "ULP per pixel", |v| v, triangle));
    }
    let walks = stage.faces.iter().flat_map(|face| {
        let runs = stage.runs[face.runs.clone()].iter();
        runs.map(move |run| (u64::from(run.x1 - 1) + u64::from(run.y), (run.x1 - 1, run.y, face)))
    });
    let walks = Extremes::of(walks);
    let sample =
        |(x, y, face): (u32, u32, &Face)| format!("pixel ({x}, {y}) of {}", triangle(face));
    #[allow(clippy::cast_precision_loss, reason = "at most 2^17 steps")]
    found.ranges.extend(walks.range("walk", "steps", |steps| steps as f64, sample));
    let (Some(depth), Some(config)) = (depth_of(profile), profile.depth) else { return };
    if let Some((most, face)) = codes.high {
        let needs = u128::BITS - most.unsigned_abs().leading_zeros();
        let evidence = format!("a depth of {most} in {}", triangle(face));
        found.bits.push(Bits { field: "integer", needs, has: config.integer, evidence });
    }
    if !profile.form.walks_a_plane() {
        // Bits of interpolation and guard follow from the accumulators of a plane.
        found.evaluators.push(own_means(stage, profile));
        return;
    }
    if let Some((steps, place)) = walks.high {
        let needs = fraction_bits(steps, config.rounding);
        let evidence = format!(
            "the error of {} roundings ({}) in a walk to {} stays below half an ULP",
            steps + 1,
            config.rounding,
            sample(place)
        );
        found.bits.push(Bits {
            field: "interpolation",
            needs,
            has: config.interpolation,
            evidence,
        });
    }
    found.evaluators.push(plane(stage));
    guard(stage, &depth, config.guard, found);
}

/// Whether depth is to be walked at all.
fn plane(stage: &Stage) -> Evaluator {
    let name = "depth plane";
    let sloped = |face: &&Face| {
        let exact = face.depth.as_ref().map(|depth| depth.exact.slope);
        exact.is_some_and(|slope| slope != [0, 0])
    };
    match stage.faces.iter().find(sloped) {
        Some(face) => Evaluator {
            name,
            needed: true,
            evidence: format!("depth changes over {}", triangle(face)),
        },
        None => Evaluator {
            name,
            needed: false,
            evidence: "depth is constant over each triangle that covers a sample".to_owned(),
        },
    }
}

/// Depth as a machine makes it that walks no plane.
fn own_means(stage: &Stage, profile: &Profile) -> Evaluator {
    let Evaluator { name, needed, evidence } = plane(stage);
    let machine = profile.form.name();
    let evidence = format!(
        "{evidence}; {machine} makes it by its own means, so bits of interpolation and guard are not stated: \
         compare and explore measure them"
    );
    Evaluator { name, needed, evidence }
}

/// Whether any sample is covered twice: without that nothing has to be compared.
fn overlap(stage: &Stage) -> Evaluator {
    let name = "depth test";
    let mut rows: Vec<(u32, u32, u32, usize)> = Vec::with_capacity(stage.runs.len());
    for face in &stage.faces {
        let runs = stage.runs[face.runs.clone()].iter();
        rows.extend(runs.map(|run| (run.y, run.x0, run.x1, face.source)));
    }
    rows.sort_unstable();
    let meets = |two: &&[(u32, u32, u32, usize)]| two[0].0 == two[1].0 && two[1].1 < two[0].2;
    match rows.windows(2).find(meets) {
        Some(two) => Evaluator {
            name,
            needed: true,
            evidence: format!(
                "triangles {} and {} both cover pixel ({}, {})",
                two[0].3, two[1].3, two[1].1, two[1].0
            ),
        },
        None => {
            Evaluator { name, needed: false, evidence: "no sample is covered twice".to_owned() }
        }
    }
}

/// How far the accumulators leave the depth range at covered samples, and the guard bits for that.
fn guard(stage: &Stage, depth: &Depth, has: u32, found: &mut Requirements) {
    let ends = stage.faces.iter().filter_map(|face| {
        let plane = depth.plane(&face.triangle, face.depth.as_ref()?.vertex, &stage.grid);
        let runs = stage.runs[face.runs.clone()].iter();
        Some(runs.flat_map(move |run| {
            [run.x0, run.x1 - 1].map(|x| (plane.at(x.into(), run.y.into()).raw(), (x, run.y, face)))
        }))
    });
    let ends = Extremes::of(ends.flatten());
    let (Some((low, at)), Some((high, to))) = (ends.low, ends.high) else { return };
    let read = depth.read_out();
    let unit = real(1 << read.fraction());
    let sample =
        |(x, y, face): (u32, u32, &Face)| format!("pixel ({x}, {y}) of {}", triangle(face));
    found.ranges.push(Range {
        name: "depth accumulator",
        low: real(low) / unit,
        high: real(high) / unit,
        unit: "ULP",
        evidence: format!("{}; {}", sample(at), sample(to)),
    });
    let reach = Reach(Some((low, high)));
    let holds = |guard: &u32| {
        let read = ReadOut::new(*guard, read.integer(), read.fraction(), Clamp::Guard);
        read.is_ok_and(|read| reach.within(read.range()))
    };
    let needs = (0..=64).find(holds).unwrap_or(64);
    let (needed, evidence) = if needs == 0 {
        (false, "no covered sample leaves the depth range".to_owned())
    } else if low < 0 {
        (true, format!("{:.4} ULP, below the range, at {}", real(low) / unit, sample(at)))
    } else {
        (true, format!("{:.4} ULP, above the range, at {}", real(high) / unit, sample(to)))
    };
    found.bits.push(Bits { field: "guard", needs, has, evidence: evidence.clone() });
    found.evaluators.push(Evaluator { name: "guard clamp", needed, evidence });
}
