//! Who is in front: neighbours in depth at each sample, and whether an evaluator keeps their order.
//! Spec clause `M-7`.

use super::stage::{Face, Stage, Surface};
use super::value::Reach;
use crate::exact::integer;
use crate::setup::Plane;
use crate::value::Depth;
use std::cmp::Ordering;

/// Two faces that are neighbours in depth at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// The nearer face, in [`Stage::faces`].
    pub near: u32,
    /// The farther one.
    pub far: u32,
    /// The sample's pixel.
    pub x: u32,
    /// Its row.
    pub y: u32,
    /// How far apart they are, in ULP, rounded down a little.
    pub gap: f64,
}

/// A face at a sample.
struct Layer {
    face: u32,
    code: f64,
}

/// What the faces of a stage are to each other.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    /// Pairs, closest first. Faces at one depth are no pair.
    pub(super) pairs: Vec<Pair>,
    /// How many pairs had the other order before snapping.
    pub(super) exchanged: u64,
    /// How many neighbours came to one depth by snapping, and the first of them.
    pub(super) levelled: u64,
    pub(super) first_levelled: Option<Pair>,
}

/// The pairs of a stage, and what snapping did to them.
pub(super) fn neighbours(stage: &Stage) -> Neighbours {
    let mut by_row: Vec<(u32, u32, u32, u32)> = Vec::new();
    for (n, face) in (0u32..).zip(&stage.faces) {
        if face.depth.is_some() {
            let runs = &stage.runs[face.runs.clone()];
            by_row.extend(runs.iter().map(|run| (run.y, run.x0, run.x1, n)));
        }
    }
    by_row.sort_unstable();
    let mut found = Neighbours::default();
    let mut hits: Vec<(u32, u32)> = Vec::new();
    let mut layers = Vec::new();
    for row in by_row.chunk_by(|a, b| a.0 == b.0) {
        hits.clear();
        hits.extend(row.iter().flat_map(|&(_, x0, x1, face)| (x0..x1).map(move |x| (x, face))));
        hits.sort_unstable();
        let y = row[0].0;
        for pixel in hits.chunk_by(|a, b| a.0 == b.0).filter(|pixel| pixel.len() > 1) {
            let x = pixel[0].0;
            sort_layers(stage, [x, y], pixel.iter().map(|hit| hit.1), &mut layers);
            for two in layers.windows(2) {
                let [near, far] = [two[0].face, two[1].face];
                let gap = (two[1].code - two[0].code) * (1.0 - 1e-9) - close(stage);
                let pair = Pair { near, far, x, y, gap };
                let before = before_snapping(stage, [x, y], [near, far]);
                if order(stage, [x, y], &two[0], &two[1]) == Ordering::Equal {
                    if before.is_some_and(Ordering::is_ne) {
                        found.levelled += 1;
                        found.first_levelled.get_or_insert(pair);
                    }
                    continue;
                }
                found.exchanged += u64::from(before == Some(Ordering::Greater));
                found.pairs.push(pair);
            }
        }
    }
    found.pairs.sort_unstable_by(|a, b| {
        a.gap.total_cmp(&b.gap).then((a.y, a.x, a.near).cmp(&(b.y, b.x, b.near)))
    });
    found
}

fn sort_layers(
    stage: &Stage,
    [x, y]: [u32; 2],
    faces: impl Iterator<Item = u32>,
    layers: &mut Vec<Layer>,
) {
    layers.clear();
    layers.extend(faces.filter_map(|face| {
        let code = surface(stage, face)?.code.at(x, y);
        Some(Layer { face, code })
    }));
    layers.sort_unstable_by(|a, b| order(stage, [x, y], a, b).then(a.face.cmp(&b.face)));
}

fn surface(stage: &Stage, face: u32) -> Option<&Surface> {
    stage.faces[face as usize].depth.as_ref()
}

/// Codes closer than this are compared as rationals. A real code is off by some 2^-50 of the whole
/// range however small it is itself, as it is a sum of larger ones.
fn close(stage: &Stage) -> f64 {
    1e-6 * (1.0 + stage.world.top * 1e-6)
}

/// The exact order of two layers: by their real codes where those are clearly apart, by rationals
/// where they are not.
fn order(stage: &Stage, [x, y]: [u32; 2], a: &Layer, b: &Layer) -> Ordering {
    let apart = a.code - b.code;
    if apart.abs() > close(stage) {
        return apart.total_cmp(&0.0);
    }
    let at = stage.grid.position(x.into(), y.into());
    let (Some(p), Some(q)) = (surface(stage, a.face), surface(stage, b.face)) else {
        return Ordering::Equal;
    };
    let (p, q) = (p.exact, q.exact);
    match (p.at(at).checked_mul(q.whole), q.at(at).checked_mul(p.whole)) {
        (Some(left), Some(right)) => left.cmp(&right),
        _ => (integer(p.at(at)) * integer(q.whole)).cmp(&(integer(q.at(at)) * integer(p.whole))),
    }
}

/// The order of two faces at a sample before snapping, the one that is nearer now named first.
pub(super) fn before_snapping(
    stage: &Stage,
    [x, y]: [u32; 2],
    faces: [u32; 2],
) -> Option<Ordering> {
    let depth = |face: u32| Some(surface(stage, face)?.before?.at(x, y));
    Some(depth(faces[0])?.total_cmp(&depth(faces[1])?))
}

/// Pairs that a depth evaluator exchanges, pairs that it makes equal, and the accumulators that
/// decided. `worst` bounds its error at every sample in ULP; infinity where there is no bound.
pub(super) fn broken(stage: &Stage, depth: &Depth, worst: f64) -> (u64, u64, Reach) {
    // Codes are floors: equal ones are less than 1 apart, each off by `worst` at most. Those of a
    // format of its own may be any distance apart, and so may those that a depth bias moves.
    let reach = if depth.config().moves_codes() { f64::INFINITY } else { 1.0 + 2.0 * worst };
    let pairs = &stage.pairs[..stage.pairs.partition_point(|pair| pair.gap <= reach)];
    let (mut inversions, mut ties, mut reach) = (0, 0, Reach::default());
    for (_, order, accumulators) in pairs_in_order(stage, depth, pairs) {
        reach.widen(accumulators);
        match order {
            Ordering::Less => {}
            Ordering::Equal => ties += 1,
            Ordering::Greater => inversions += 1,
        }
    }
    (inversions, ties, reach)
}

/// Pairs of a stage, the order that a depth evaluator gives each, and its accumulators there.
pub(super) fn pairs_in_order<'a>(
    stage: &'a Stage,
    depth: &'a Depth,
    pairs: &'a [Pair],
) -> impl Iterator<Item = (&'a Pair, Ordering, Reach)> {
    let plane = |face: &Face| {
        let vertex = face.depth.as_ref()?.vertex;
        Some(depth.plane(&face.triangle, vertex, &stage.grid))
    };
    // Few pairs are close enough as a rule; where most are, each face is set up once.
    let many = pairs.len() > stage.faces.len();
    let prepared: Vec<Option<Plane>> =
        if many { stage.faces.iter().map(plane).collect() } else { Vec::new() };
    pairs.iter().map(move |pair| {
        let code = |face: u32| {
            let index = face as usize;
            let made = prepared.get(index).copied();
            let plane = made.unwrap_or_else(|| plane(&stage.faces[index]))?;
            let accumulator = plane.at(pair.x.into(), pair.y.into()).raw();
            let held = depth.held(&plane, pair.x, pair.y);
            Some((depth.code(held), accumulator))
        };
        let (near, far) = (code(pair.near), code(pair.far));
        let mut reach = Reach::default();
        for (_, accumulator) in [near, far].into_iter().flatten() {
            reach.widen(Reach(Some((accumulator, accumulator))));
        }
        let order = near.map(|near| near.0).cmp(&far.map(|far| far.0));
        (pair, if depth.is_reversed() { order.reverse() } else { order }, reach)
    })
}
