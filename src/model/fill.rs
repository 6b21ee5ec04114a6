//! The quickest exact path: coverage as a bitmask and depth as values, written to memory.
//! Spec clause `A-14`.

use super::Model;
use crate::cover::{Bitmask, FillRule, Rect, fits_narrow, scan};
use crate::machine::{DrawError, Sink};
use crate::setup::{Snapped, Triangle};
use crate::value::{Depth, DepthBuffer};

/// Coverage and depth of a window, in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Raster {
    /// Covered pixels.
    pub mask: Bitmask,
    depth: Vec<u64>,
    pitch: usize,
}

impl Raster {
    /// Nothing covered; pixels `[0, x1)` by `[0, y1)` of a window.
    pub fn new(window: Rect) -> Self {
        let pitch = window.x1 as usize;
        Self { mask: Bitmask::new(window), depth: vec![0; pitch * window.y1 as usize], pitch }
    }

    /// The depth written last at each pixel of row y; 0 where none was.
    pub fn depth(&self, y: u32) -> &[u64] {
        &self.depth[y as usize * self.pitch..][..self.pitch]
    }

    fn run(&mut self, y: u32, x0: u32, x1: u32) -> &mut [u64] {
        self.mask.fill(y, x0, x1);
        let begin = y as usize * self.pitch;
        &mut self.depth[begin + x0 as usize..begin + x1 as usize]
    }
}

impl Sink for Raster {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        let run = self.run(y, x0, x1);
        if depth.len() == run.len() {
            run.copy_from_slice(depth);
        }
    }
}

/// Fragments without depth do not reach it.
impl Sink for DepthBuffer {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        if depth.len() == (x1 - x0) as usize {
            self.test(y, x0, depth);
        }
    }
}

impl Sink for Bitmask {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.fill(y, x0, x1);
    }
}

/// What a model knows about the quickest path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quick {
    rule: FillRule,
    narrow: bool,
    /// Whether depth is a plane that no sample refuses; `None` without depth.
    depth: Option<Depth>,
}

impl Quick {
    /// `None` where coverage is not exact, or depth is not a plane, or a sample can refuse the
    /// triangle: such machines have to draw.
    pub(super) fn new(profile: &crate::profile::Profile, depth: Option<Depth>) -> Option<Self> {
        let strict = depth.is_some_and(|d| d.read_out().clamp() == crate::format::Clamp::Error);
        let plain = profile.covers_exactly()
            && profile.form.walks_a_plane()
            && profile.traversal.is_none()
            && profile.multisample.is_none()
            && profile.cull.is_none()
            && profile.grid().is_ok_and(|grid| grid.is_on_the_grid())
            && !strict;
        plain.then(|| Self {
            rule: profile.form.rule(),
            narrow: fits_narrow(profile.vertex.difference_bits()),
            depth,
        })
    }
}

impl Model {
    /// Covers in `mask`, at least as large as the window, what [`Model::draw`] covers.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    pub fn cover(&self, triangle: &Snapped<Triangle>, mask: &mut Bitmask) -> Result<(), DrawError> {
        self.check(Some(triangle.field()))?;
        let Some(quick) = &self.quick else { return self.draw(triangle, mask) };
        scan(&triangle.xy, &self.grid, self.clip, quick.rule, quick.narrow, |y, x0, x1| {
            mask.fill(y, x0, x1);
        });
        Ok(())
    }

    /// Writes coverage and depth of what [`Model::draw`] draws into `raster`, at least as large as
    /// the window.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    pub fn fill(&self, triangle: &Snapped<Triangle>, raster: &mut Raster) -> Result<(), DrawError> {
        self.check(Some(triangle.field()))?;
        let Some(quick) = &self.quick else { return self.draw(triangle, raster) };
        let Some((depth, z)) = quick.depth.as_ref().zip(triangle.z) else {
            return self.cover(triangle, &mut raster.mask);
        };
        let turned = Triangle { z: Some(z), ..**triangle }.normalised();
        let Some(z) = turned.z.filter(|_| turned.area2() != 0) else { return Ok(()) };
        let plane = depth.plane(&turned, z, &self.grid);
        scan(&turned.xy, &self.grid, self.clip, quick.rule, quick.narrow, |y, x0, x1| {
            depth.span(&plane, y, x0, raster.run(y, x0, x1));
        });
        Ok(())
    }
}
