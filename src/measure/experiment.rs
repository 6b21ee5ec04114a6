//! What the lectures warn of, measured: T-vertices, acute triangles, a sample grid moved off the vertex
//! grid, outlines of filled triangles. Spec clause `Y-7`.
#![allow(clippy::cast_precision_loss, reason = "rates are reported as real numbers")]

use crate::bits::Rounding;
use crate::case::Words;
use crate::cover::{FillRule, LineConfig, Rect, SampleGrid, scan};
use crate::exact::PlaneNumerator;
use crate::format::{Clamp, Unreduced};
use crate::machine::EdgeWalkConfig;
use crate::setup::{Gradient, Triangle};
use crate::value::DepthBias;
use serde::Serialize;
use std::collections::BTreeSet;

/// All experiments.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Experiments {
    /// A vertex on an edge, by sub-pixel bits.
    pub t_vertices: Vec<TVertexRow>,
    /// Slivers, by width.
    pub acute: Vec<AcuteRow>,
    /// Samples on vertices and on edges, by where the samples lie.
    pub offset_grid: Vec<OffsetRow>,
    /// Outlines, by what gives them depth.
    pub outlines: Vec<OutlineRow>,
}

/// A vertex meant to lie on an edge, rounded to a grid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TVertexRow {
    /// Sub-pixel bits.
    pub sub_pixel: u32,
    /// Edges tried.
    pub edges: u32,
    /// Samples of the edges' neighbourhoods that no triangle covers.
    pub holes: u64,
    /// Samples that two cover.
    pub double_hits: u64,
}

/// Triangles that get thinner.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AcuteRow {
    /// Width of the sliver in sub-pixels of 1/1024.
    pub width: i128,
    /// Samples that the exact sliver covers.
    pub samples: u64,
    /// Samples that an edge walk of 12 fraction bits misplaces.
    pub misplaced: u64,
    /// The largest depth slope met, in depth ranges a pixel.
    pub slope: f64,
}

/// Where samples lie to vertices.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OffsetRow {
    /// `on the vertex grid`, or `half a sub-pixel off it`.
    pub samples: &'static str,
    /// Samples that coincide with a vertex.
    pub on_vertices: u64,
    /// Samples that lie on an edge.
    pub on_edges: u64,
}

/// An outline drawn over its own triangle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutlineRow {
    /// What gives the outline its depth.
    pub depth: &'static str,
    /// Pixels of outlines that lie on covered samples.
    pub pixels: u64,
    /// Those that fail a less-or-equal test against the filled triangle.
    pub hidden: u64,
}

const SIDE: u32 = 64;

/// Runs all of them.
pub fn experiments() -> Experiments {
    Experiments {
        t_vertices: [0, 2, 4, 6, 8, 10].map(t_vertices).to_vec(),
        acute: [4096, 1024, 256, 64, 16, 4, 1].map(acute).to_vec(),
        offset_grid: vec![offset(false), offset(true)],
        outlines: outlines(),
    }
}

fn grid(sub_pixel: u32) -> SampleGrid {
    // Without sub-pixel bits samples lie on the lattice.
    SampleGrid::at([1i128 << sub_pixel >> 1; 2], sub_pixel)
}

/// Covered samples of a triangle as places in a square window.
fn covered(xy: [[i128; 2]; 3], grid: &SampleGrid) -> Vec<u32> {
    let clip = Rect { x0: 0, y0: 0, x1: SIDE, y1: SIDE };
    let mut places = Vec::new();
    scan(&xy, grid, clip, FillRule::TopLeft, true, |y, x0, x1| {
        places.extend((x0..x1).map(|x| y * SIDE + x));
    });
    places
}

/// An edge from A to B with one triangle above; below it two that meet at its middle, rounded.
fn t_vertices(sub_pixel: u32) -> TVertexRow {
    const EDGES: u32 = 2000;
    let (grid, unit) = (grid(sub_pixel), 1i128 << sub_pixel);
    let (mut holes, mut double_hits) = (0, 0);
    for index in 0..EDGES {
        let mut words = Words::new(41, u64::from(sub_pixel), index.into());
        let scale = 1i64 << sub_pixel;
        let mut at = |low: i64, high: i64| words.between(low * scale, high * scale);
        let a = [at(1, 12), at(20, 44)];
        let b = [at(50, 62), at(20, 44)];
        let halved = |k: usize| Rounding::NearestEven.shift_right(a[k] + b[k], 1).0;
        let middle = [halved(0), halved(1)];
        let (above, below) = ([32 * unit, 0], [32 * unit, 63 * unit]);
        let mut hits = vec![0u8; (SIDE * SIDE) as usize];
        for shape in [[a, b, above], [a, middle, below], [middle, b, below]] {
            for place in covered(shape, &grid) {
                hits[place as usize] += 1;
            }
        }
        // What the same quadrilateral covers when it shares the whole edge.
        let mut whole = BTreeSet::new();
        whole.extend(covered([a, b, above], &grid));
        whole.extend(covered([a, b, below], &grid));
        holes += whole.iter().filter(|place| hits[**place as usize] == 0).count() as u64;
        double_hits += hits.iter().filter(|hits| **hits > 1).count() as u64;
    }
    TVertexRow { sub_pixel, edges: EDGES, holes, double_hits }
}

/// Slivers of one width, in every direction: the exact spans against walked ones, and the depth slope
/// over the whole range.
fn acute(width: i128) -> AcuteRow {
    let grid = grid(10);
    let walk = EdgeWalkConfig {
        guard: 1,
        integer: 12,
        fraction: 12,
        rounding: Rounding::NearestEven,
        clamp: Clamp::Guard,
    };
    let (mut samples, mut misplaced, mut slope) = (0, 0, 0.0f64);
    for index in 0..400 {
        let mut words = Words::new(42, 1, index);
        let mut at = || [words.between(0, 65_535), words.between(0, 65_535)];
        let (a, b) = (at(), at());
        let d = [b[0] - a[0], b[1] - a[1]];
        let longer = d[0].abs().max(d[1].abs()).max(1);
        let c = [b[0] - d[1] * width / longer, b[1] + d[0] * width / longer];
        let triangle = Triangle { xy: [a, b, c], z: Some([0, 0, (1 << 24) - 1]) }.normalised();
        if triangle.area2() == 0 {
            continue;
        }
        let exact: BTreeSet<u32> = covered(triangle.xy, &grid).into_iter().collect();
        let mut walked = BTreeSet::new();
        let v = triangle.xy;
        let edges: Vec<_> = (0..3).filter_map(|k| walk.edge(v[k], v[(k + 1) % 3], &grid)).collect();
        for y in 0..SIDE {
            let row = i128::from(y);
            let side = |left: bool| {
                let edge = edges
                    .iter()
                    .find(|e| e.left == left && (e.first_row..e.end_row).contains(&row))?;
                Some(walk.pixel(edge.start + edge.slope * (row - edge.first_row), &grid))
            };
            if let (Some(x0), Some(x1)) = (side(true), side(false)) {
                let clip = Rect { x0: 0, y0: 0, x1: SIDE, y1: SIDE };
                let (x0, x1) = clip.clip(0, (x0, x1));
                walked.extend((x0..x1).map(|x| y * SIDE + x));
            }
        }
        samples += exact.len() as u64;
        misplaced += exact.symmetric_difference(&walked).count() as u64;
        let gradient = Gradient::new(&triangle, triangle.z.unwrap_or_default());
        let steepest = gradient.x.abs().max(gradient.y.abs()) as f64 * 1024.0;
        slope = slope.max(steepest / gradient.area2 as f64 / f64::from(1 << 24));
    }
    AcuteRow { width, samples, misplaced, slope }
}

/// Triangles with vertices on a grid of two sub-pixel bits: on twice that grid their vertices are even
/// and samples moved by half a sub-pixel odd.
fn offset(moved: bool) -> OffsetRow {
    let (mut on_vertices, mut on_edges) = (0, 0);
    let shift = i128::from(moved);
    for index in 0..20_000 {
        let mut words = Words::new(43, 1, index);
        let mut at = || [words.between(0, 32) * 2, words.between(0, 32) * 2];
        let v = [at(), at(), at()];
        for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))) {
            let p = [x * 8 + 4 + shift, y * 8 + 4 + shift];
            on_vertices += u64::from(v.contains(&p));
            on_edges += (0..3)
                .filter(|k| {
                    let (a, b) = (v[*k], v[(k + 1) % 3]);
                    let cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
                    let within = |k: usize| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]);
                    cross == 0 && within(0) && within(1) && p != a && p != b
                })
                .count() as u64;
        }
    }
    let samples = if moved { "half a sub-pixel off it" } else { "on the vertex grid" };
    OffsetRow { samples, on_vertices, on_edges }
}

/// Outlines of tilted triangles: each edge as a line by the diamond rule, its depth interpolated along
/// its major axis, offset, or taken from the triangle's own plane (a hollow polygon).
fn outlines() -> Vec<OutlineRow> {
    let (grid, clip) = (grid(8), Rect { x0: 0, y0: 0, x1: SIDE, y1: SIDE });
    let mut counts = [[0u64; 2]; 3];
    for index in 0..400 {
        let mut words = Words::new(44, 1, index);
        let mut at = || [words.between(0, 16_383), words.between(0, 16_383)];
        let v = [at(), at(), at()];
        let z = [(); 3].map(|()| words.between(0, (1 << 24) - 1));
        let Some(plane) = PlaneNumerator::new(v, z) else { continue };
        // A sliver's slope is beyond any offset.
        if plane.whole < 1 << 22 {
            continue;
        }
        let filled: BTreeSet<u32> = covered(v, &grid).into_iter().collect();
        let slope = |k: usize| {
            Unreduced::new((plane.slope[k] << grid.sub_pixel).div_euclid(plane.whole), 0)
        };
        let walked = crate::setup::Plane::new(Unreduced::new(0, 0), slope(0), slope(1))
            .unwrap_or_else(|error| unreachable!("{error}"));
        let bias = DepthBias { constant: 1, unit: 1, slope: 256, clamp: 0 };
        let bias = bias.of(&walked, (1, 1), Rounding::Ceiling);
        for k in 0..3 {
            let (a, b) = (v[k], v[(k + 1) % 3]);
            let d = [b[0] - a[0], b[1] - a[1]];
            let major = usize::from(d[1].abs() > d[0].abs());
            LineConfig::default().pixels([a, b], &grid, clip, &mut |x, y| {
                if !filled.contains(&(y * SIDE + x)) || d[major] == 0 {
                    return;
                }
                let at = grid.position(x.into(), y.into());
                let surface = plane.at(at).div_euclid(plane.whole);
                let along = at[major] - a[major];
                let own = z[k] + ((z[(k + 1) % 3] - z[k]) * along).div_euclid(d[major]);
                for (count, depth) in counts.iter_mut().zip([own, own - bias.raw(), surface]) {
                    count[0] += 1;
                    count[1] += u64::from(depth > surface);
                }
            });
        }
    }
    ["the line's own", "the line's own, offset by one slope and one unit", "the triangle's plane"]
        .into_iter()
        .zip(counts)
        .map(|(depth, [pixels, hidden])| OutlineRow { depth, pixels, hidden })
        .collect()
}
