//! A scene before any profile snaps it: what snap error is measured against. Spec clause `M-1`.

use super::run::Side;
use crate::bits::Rounding;
use crate::cover::{Rect, SampleGrid};
use crate::exact::{Outline, Rule};
use crate::model::Span;
use crate::profile::Profile;
use crate::scene::{self, Attributes, Lens, Scene};
use crate::setup::snap_f64;

/// Bits below the pixel of the reference grid: fine enough that no vertex field is finer.
pub const REFERENCE_BITS: u32 = 32;

/// Pixels beyond which a vertex has no place on the reference grid; every window and field ends
/// long before.
const REACH: i128 = 1 << (20 + REFERENCE_BITS);

/// A scene as it was given, and on the reference grid.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Name of the scene.
    pub name: String,
    /// The camera's planes, if it was seen through one.
    pub lens: Option<Lens>,
    /// The triangles, in the units of the profile that the scene was loaded for.
    pub triangles: Vec<scene::Triangle>,
    /// The same on the reference grid; `None` where a coordinate has no place there.
    faces: Vec<Option<RealFace>>,
    /// Bits below the pixel of its integer coordinates.
    sub_pixel: u32,
    depth_max: u64,
    /// What the vertices carry beside their place.
    pub attributes: Attributes,
}

/// A triangle on the reference grid.
#[derive(Clone, Copy, Debug)]
pub struct RealFace {
    /// Vertices, in 2^-32 pixels.
    pub xy: [[i128; 2]; 3],
    /// Depth of each vertex as a part of the range.
    pub part: Option<[f64; 3]>,
}

impl Reference {
    /// The scene, as loaded for a profile.
    pub fn new(scene: Scene, base: &Profile) -> Self {
        let (sub_pixel, depth_max) = (base.vertex.input_bits(), base.depth_max());
        let top = real(depth_max.into()).max(1.0);
        let faces = scene.triangles.iter().map(|triangle| {
            let (xy, part) = match triangle {
                scene::Triangle::Lattice { xy, z } => (
                    xy.map(|v| v.map(|value| value.checked_mul(1 << (REFERENCE_BITS - sub_pixel)))),
                    z.map(|z| z.map(|code| real(code) / top)),
                ),
                scene::Triangle::Real { xy, z } => (
                    xy.map(|v| {
                        v.map(|value| snap_f64(value, REFERENCE_BITS, Rounding::NearestEven))
                    }),
                    z.map(|z| z.map(|code| code / top)),
                ),
            };
            let mut placed = [[0; 2]; 3];
            for (to, from) in placed.iter_mut().flatten().zip(xy.into_iter().flatten()) {
                *to = from.filter(|value| (-REACH..REACH).contains(value))?;
            }
            Some(RealFace { xy: placed, part })
        });
        let faces = faces.collect();
        let Scene { name, triangles, lens, attributes, .. } = scene;
        Self { name, lens, triangles, faces, sub_pixel, depth_max, attributes }
    }

    /// Triangle `index` on the reference grid.
    pub fn face(&self, index: usize) -> Option<&RealFace> {
        self.faces.get(index)?.as_ref()
    }

    /// Hands every number of the scene to a digest, in drawing order.
    pub fn digest(&self, digest: &mut dyn FnMut(&[u8])) {
        for triangle in &self.triangles {
            match triangle {
                scene::Triangle::Lattice { xy, z } => {
                    digest(b"v");
                    xy.iter().flatten().for_each(|value| digest(&value.to_le_bytes()));
                    z.iter().flatten().for_each(|value| digest(&value.to_le_bytes()));
                }
                scene::Triangle::Real { xy, z } => {
                    digest(b"f");
                    xy.iter().flatten().for_each(|value| digest(&value.to_le_bytes()));
                    z.iter().flatten().for_each(|value| digest(&value.to_le_bytes()));
                }
            }
        }
    }

    /// Triangle `index` in the units of another profile: an integer coordinate stays one where the
    /// units are the same, and is the real number it stood for where they are not.
    pub fn triangle(&self, index: usize, profile: &Profile) -> scene::Triangle {
        let given = &self.triangles[index];
        let (from, to) = (self.depth_max, profile.depth_max());
        // The end of one range is exactly the end of the other.
        let rescale = |code: f64| {
            if from == to || from == 0 { code } else { code / real(from.into()) * real(to.into()) }
        };
        match given {
            scene::Triangle::Lattice { xy, z }
                if self.sub_pixel == profile.vertex.input_bits() && from == to =>
            {
                scene::Triangle::Lattice { xy: *xy, z: *z }
            }
            // A finer grid has every point of this one; a code of 64 bits is no real number.
            scene::Triangle::Lattice { xy, z }
                if from == to && self.sub_pixel < profile.vertex.input_bits() =>
            {
                let finer = 1 << (profile.vertex.input_bits() - self.sub_pixel);
                scene::Triangle::Lattice {
                    xy: xy.map(|v| v.map(|value: i128| value.saturating_mul(finer))),
                    z: *z,
                }
            }
            scene::Triangle::Lattice { xy, z } => {
                let pixel = real(1 << self.sub_pixel);
                scene::Triangle::Real {
                    xy: xy.map(|v| v.map(|value| real(value) / pixel)),
                    z: z.map(|z| z.map(|code| rescale(real(code)))),
                }
            }
            scene::Triangle::Real { xy, z } => {
                scene::Triangle::Real { xy: *xy, z: z.map(|z| z.map(rescale)) }
            }
        }
    }
}

impl RealFace {
    /// The weights of the three vertices at a point of the reference grid; they sum to 1. Not
    /// finite without area.
    pub fn weights(&self, [x, y]: [i128; 2]) -> [f64; 3] {
        let area = |[ax, ay]: [i128; 2], [bx, by]: [i128; 2]| {
            real((ax - x) * (by - y) - (ay - y) * (bx - x))
        };
        let [a, b, c] = self.xy;
        let areas = [area(b, c), area(c, a), area(a, b)];
        let whole = areas[0] + areas[1] + areas[2];
        areas.map(|area| area / whole)
    }

    /// The change of each weight per `step` units rightward and downward.
    pub fn slopes(&self, step: i128) -> [[f64; 3]; 2] {
        let [a, b, c] = self.xy;
        let whole = real((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
        let opposite = [(b, c), (c, a), (a, b)];
        [
            opposite.map(|(from, to)| real((from[1] - to[1]) * step) / whole),
            opposite.map(|(from, to)| real((to[0] - from[0]) * step) / whole),
        ]
    }
}

/// What a scene covers before it is snapped: runs of samples, triangle by triangle.
#[derive(Clone, Debug)]
pub struct Truth {
    runs: Vec<Span>,
    ends: Vec<usize>,
}

/// Sample positions on the reference grid.
pub(in crate::measure) fn reference_grid(grid: &SampleGrid) -> SampleGrid {
    let up = REFERENCE_BITS - grid.sub_pixel;
    SampleGrid::at(grid.offset.map(|value| value << up), REFERENCE_BITS)
}

impl Truth {
    /// The covered samples of a scene on the reference grid, inside a window.
    pub fn new(reference: &Reference, grid: &SampleGrid, clip: Rect, rule: Rule) -> Self {
        let grid = reference_grid(grid);
        let (mut runs, mut ends) = (Vec::new(), Vec::with_capacity(reference.faces.len()));
        for face in &reference.faces {
            if let Some(face) = face {
                covered_runs(face.xy, &grid, clip, rule, &mut runs);
            }
            ends.push(runs.len());
        }
        Self { runs, ends }
    }

    /// The runs of triangle `index`.
    pub fn runs(&self, index: usize) -> &[Span] {
        let begin = index.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.runs[begin..self.ends[index]]
    }
}

/// The exact runs of a triangle, added to a list.
pub(super) fn covered_runs(
    xy: [[i128; 2]; 3],
    grid: &SampleGrid,
    clip: Rect,
    rule: Rule,
    runs: &mut Vec<Span>,
) {
    let outline = Outline::new(xy);
    let [a, b, c] = xy.map(|vertex| vertex[1]);
    let (y0, y1) = clip.clip(1, grid.pixels(1, (a.min(b).min(c), a.max(b).max(c))));
    for y in y0..y1 {
        let [first, at] = grid.position(0, i128::from(y));
        if let Some(cut) = outline.row(at, (first, 1 << grid.sub_pixel), rule) {
            let (x0, x1) = clip.clip(0, cut);
            if x0 < x1 {
                runs.push(Span { y, x0, x1 });
            }
        }
    }
}

/// An integer as a real number, for error reports.
#[allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]
pub(super) fn real(value: i128) -> f64 {
    // Most are small, and a 64-bit conversion is one instruction.
    i64::try_from(value).map_or(value as f64, |value| value as f64)
}

/// Counts the samples of a stretch that only one side has.
pub(super) fn misplaced(side: Side, run: Span, missing: &mut u64, extra: &mut u64) {
    let samples = u64::from(run.x1 - run.x0);
    match side {
        Side::Both => {}
        Side::Missing => *missing += samples,
        Side::Extra => *extra += samples,
    }
}
