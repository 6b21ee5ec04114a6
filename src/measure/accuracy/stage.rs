//! A scene on a profile's grid: its exact picture, and what snapping did to it.
//!
//! Everything here depends on the vertex field, the window, the sample position, the fill rule and
//! the depth bits alone, so that the budgets of a sweep that share these share a stage.

use super::affine::Affine;
use super::order::{Pair, neighbours};
use super::reference::{REFERENCE_BITS, Reference, Truth, covered_runs, misplaced, real};
use super::run::{Hits, Side, compare};
use super::shade::Shades;
use super::tally::Tally;
use super::world::World;
use crate::cover::{Rect, SampleGrid};
use crate::exact::{PlaneNumerator, Rule};
use crate::measure::error::exact_rule;
use crate::model::{Model, Span};
use crate::profile::{InvalidProfile, Profile};
use crate::setup::{Snapped, Triangle};
use std::ops::Range;

/// A scene on a grid.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Sample positions.
    pub grid: SampleGrid,
    /// The window.
    pub clip: Rect,
    /// Triangles with an area, in drawing order.
    pub faces: Vec<Face>,
    /// Exact runs, face by face.
    pub runs: Vec<Span>,
    /// Samples of those runs.
    pub samples: u64,
    /// Those of them that have depth.
    pub depth_samples: u64,
    /// What snapping did.
    pub snap: Tally,
    /// Neighbours in depth, those closest to each other first.
    pub pairs: Vec<Pair>,
    /// Two neighbours that came to one depth by snapping, if any did.
    pub levelled: Option<Pair>,
    /// What a depth error is worth.
    pub world: World,
    /// What the channels of the profile should be, where the scene has values for them.
    pub shades: Option<Shades>,
}

/// A triangle of a stage.
#[derive(Clone, Debug)]
pub struct Face {
    /// On the grid, normalised.
    pub triangle: Snapped<Triangle>,
    /// Its place in the scene, from 0.
    pub source: usize,
    /// Its exact runs, in [`Stage::runs`].
    pub runs: Range<usize>,
    /// Its depth, if it has one.
    pub depth: Option<Surface>,
    /// Whether two vertices have changed places.
    pub turned: bool,
    /// Its attribute, if it has depth: both go through the profile's value plane.
    pub attribute: Option<Surface>,
}

/// An interpolated value over a face that covers a sample.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Codes at the vertices of the normalised triangle.
    pub vertex: [i128; 3],
    /// The exact plane.
    pub exact: PlaneNumerator,
    /// The same in real numbers, in ULP.
    pub code: Affine,
    /// The plane before snapping, in ULP; `None` where the triangle had no area.
    pub before: Option<Affine>,
}

impl Stage {
    /// Brings a scene to a profile's grid. `truth` is what the scene covers before that.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(
        reference: &Reference,
        truth: &Truth,
        profile: &Profile,
    ) -> Result<Self, InvalidProfile> {
        if profile.conservative().is_some() {
            return Err(InvalidProfile::Squares);
        }
        if profile.cull.is_some() {
            return Err(InvalidProfile::Culled);
        }
        let model = Model::new(profile)?;
        let (grid, clip) = (profile.whole_grid()?, profile.window()?);
        let world = World::new(profile.depth_max(), reference.lens);
        let mut stage = Self {
            grid,
            clip,
            faces: Vec::with_capacity(reference.triangles.len()),
            runs: Vec::new(),
            samples: 0,
            depth_samples: 0,
            snap: Tally::default(),
            pairs: Vec::new(),
            levelled: None,
            world,
            shades: None,
        };
        let (rule, mut hits) = (exact_rule(&profile.form), Hits::default());
        for source in 0..reference.triangles.len() {
            stage.add(reference, truth, &model, source, rule, &mut hits);
        }
        (stage.snap.holes, stage.snap.double_hits) = hits.holes_and_doubles();
        let found = neighbours(&stage);
        (stage.snap.inversions, stage.snap.ties) = (found.exchanged, found.levelled);
        (stage.pairs, stage.levelled) = (found.pairs, found.first_levelled);
        stage.shades = Shades::new(reference, &stage, &model);
        Ok(stage)
    }

    fn add(
        &mut self,
        reference: &Reference,
        truth: &Truth,
        model: &Model,
        source: usize,
        rule: Rule,
        hits: &mut Hits,
    ) {
        let given = reference.triangle(source, model.profile());
        let Ok(snapped) = model.snap(&given) else {
            self.snap.refused += 1;
            return;
        };
        let begin = self.runs.len();
        covered_runs(snapped.xy, &self.grid, self.clip, rule, &mut self.runs);
        compare(truth.runs(source), &self.runs[begin..], |side, run| {
            misplaced(side, run, &mut self.snap.missing, &mut self.snap.extra);
            hits.note(side, run);
        });
        let triangle = snapped.normalised();
        let real_face = reference.face(source);
        if triangle.area2() == 0 {
            let had_area =
                real_face.is_some_and(|real| PlaneNumerator::new(real.xy, [0; 3]).is_some());
            self.snap.vanished += u64::from(had_area);
            return;
        }
        let runs = begin..self.runs.len();
        let turned = snapped.area2() < 0;
        let mut face = Face { triangle, source, runs, depth: None, turned, attribute: None };
        // A face without a sample needs no values.
        if let (Some(first), Some(z)) = (self.runs.get(begin), triangle.z) {
            let base = [first.x0, first.y];
            let up = REFERENCE_BITS - self.grid.sub_pixel;
            let stays =
                real_face.is_some_and(|real| real.xy == snapped.xy.map(|v| v.map(|n| n << up)));
            let surface = |vertex, given: Option<[f64; 3]>, is_same: bool| {
                let exact = PlaneNumerator::new(triangle.xy, vertex)?;
                let code = Affine::exact(&exact, &self.grid, base);
                let before = || {
                    let plane = Affine::before(real_face?, given?, &self.grid, base);
                    Some(plane?.scaled(self.world.top))
                };
                // What did not move has no error, not one of 2^-50.
                let before = if stays && is_same { Some(code) } else { before() };
                Some(Surface { vertex, exact, code, before })
            };
            let part = real_face.and_then(|real| real.part);
            let kept = part == snapped.z.map(|z| z.map(|code| real(code) / self.world.top));
            face.depth = surface(z, part, kept);
            #[allow(clippy::cast_possible_truncation, reason = "an integer below 2^64")]
            let codes = ATTRIBUTE.map(|part| (part * self.world.top) as i128);
            // The attribute changes places with its vertex.
            let attribute = Triangle { z: Some(codes), ..*snapped }.normalised();
            face.attribute = attribute.z.and_then(|vertex| surface(vertex, Some(ATTRIBUTE), true));
        }
        self.note_snapped_values(truth.runs(source), &face);
        let samples = self.runs[begin..].iter().map(|run| u64::from(run.x1 - run.x0)).sum::<u64>();
        self.samples += samples;
        self.depth_samples += if face.depth.is_some() { samples } else { 0 };
        self.faces.push(face);
    }

    /// How far depth and attribute moved, at the samples covered before and after.
    fn note_snapped_values(&mut self, before: &[Span], face: &Face) {
        let moved = |surface: &Option<Surface>| {
            let surface = surface.as_ref()?;
            Some((surface.code, surface.code.minus(surface.before?)))
        };
        let (depth, attribute) = (moved(&face.depth), moved(&face.attribute));
        let (world, snap) = (self.world, &mut self.snap);
        compare(before, &self.runs[face.runs.clone()], |side, run| {
            if side != Side::Both {
                return;
            }
            let (count, ends) = (run.x1 - run.x0, [run.x0, run.x1 - 1]);
            if let Some((code, moved)) = &depth {
                let error = ends.map(|x| moved.at(x, run.y));
                let parts = ends.map(|x| code.at(x, run.y) / world.top);
                snap.depth.run(&world, error, parts, count);
            }
            if let Some((_, moved)) = &attribute {
                let error = ends.map(|x| moved.at(x, run.y));
                snap.attribute.run(&world.flat(), error, [0.0; 2], count);
            }
        });
        snap.depth.settle(&world);
        snap.attribute.settle(&world.flat());
    }
}

/// The attribute at the vertices as given, as a part of its range. Spec clause `M-5`.
const ATTRIBUTE: [f64; 3] = [0.0, 1.0, 0.0];
