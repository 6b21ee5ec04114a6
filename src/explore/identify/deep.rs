//! Depth of a triangle with many words of depth. Spec clause `ID-3`.

use super::case::{Answer, Case};
use super::hypothesis::Root;
use crate::cover::SampleGrid;
use crate::dda::Processor;
use crate::model::Model;
use crate::scene;
use crate::setup::Triangle as LatticeTriangle;
use crate::value::DepthConfig;

/// A triangle of a root, ready for many words of depth. The machines of this search walk depth planes.
pub(super) struct Deep<'a> {
    root: &'a Root,
    triangle: LatticeTriangle,
    z: [i128; 3],
    grid: SampleGrid,
}

impl<'a> Deep<'a> {
    /// None for a triangle without depth or area, or one that the machine refuses.
    pub(super) fn new(
        root: &'a Root,
        primitive: &scene::Primitive,
        depths: &[DepthConfig],
    ) -> Option<Self> {
        let scene::Primitive::Triangle(triangle) = primitive else { return None };
        // All words have as many integer bits, which alone decide the codes of the vertices.
        let profile = root.profile(None, depths.first().copied());
        let triangle: LatticeTriangle = *Model::new(&profile).ok()?.snap(triangle).ok()?;
        if profile.culls(&triangle) || !profile.form.walks_a_plane() {
            return None;
        }
        let triangle = triangle.normalised();
        Some(Self { root, z: triangle.z?, grid: profile.whole_grid().ok()?, triangle })
    }

    /// The codes at pixels; none where these words cannot be.
    pub(super) fn codes<'b>(
        &self,
        depth: DepthConfig,
        at: impl Iterator<Item = &'b (u32, u32)>,
    ) -> Option<impl Iterator<Item = u64>> {
        let profile = self.root.model.profile();
        let depth = profile.evaluator_of(depth, Processor::default()).ok()?;
        let plane = depth.plane(&self.triangle, self.z, &self.grid);
        Some(at.map(move |(x, y)| depth.code(depth.held(&plane, *x, *y))))
    }
}

/// Whether a machine with these words of depth gives the depth of a case.
pub(super) fn depth_agrees(root: &Root, depth: DepthConfig, case: &Case) -> bool {
    let Answer::Picture { depth: expected, .. } = &case.answer else { return true };
    expected.is_empty()
        || Deep::new(root, &case.primitive, &[depth])
            .and_then(|deep| {
                Some(deep.codes(depth, expected.keys())?.eq(expected.values().copied()))
            })
            .unwrap_or(false)
}
