//! One profile seen through each machine.

use super::Profile;
use crate::cover::{ConservativeConfig, ConservativeDepth, Degenerate, EdgeWordConfig};
use crate::dda::Processor;
use crate::format::{ReadOut, Role};
use crate::machine::{RasterState, triangle_machines};
use crate::setup::Triangle;
use crate::value::{Depth, DepthConfig, DepthError};

impl Profile {
    /// What the profile says beside its machine.
    pub const fn state(&self) -> RasterState {
        RasterState {
            window: (self.window.width, self.window.height),
            vertex: self.vertex,
            sample: self.sample,
            multisample: self.multisample,
            traversal: self.traversal,
            depth: self.depth,
        }
    }

    /// The same profile without a depth bias, for values that are no depth.
    #[must_use]
    pub fn unbiased(&self) -> Self {
        let mut profile = self.clone();
        profile.depth.iter_mut().for_each(|depth| depth.bias = None);
        profile
    }

    /// Conservative coverage, of a profile that has it.
    pub fn conservative(&self) -> Option<ConservativeConfig> {
        self.form.edge()?.conservative
    }

    /// How the model reads a set-up word of this name, where a clamp says it: the x of a walked edge. Spec clause
    /// `K-3`.
    pub fn read_of(&self, column: &str) -> Option<ReadOut> {
        let walk = self.form.walk()?;
        let role = Role::find(column)?.role;
        let read = walk.validate(&self.vertex).ok()?;
        (role == Role::EDGE_X_INIT).then_some(read)
    }

    /// How far a bounding box reaches beyond the vertices, in sub-pixels. Spec clause `CR-3`.
    pub fn box_reach(&self) -> i128 {
        self.form.edge().map_or(0, |edge| edge.box_reach(self.vertex.sub_pixel))
    }

    /// The depth evaluator; `None` without depth. Spec clauses `P-1` and `CR-6`.
    ///
    /// # Errors
    /// [`DepthError`] names the violated inequality.
    pub fn evaluator(&self, processor: Processor) -> Result<Option<Depth>, DepthError> {
        self.depth.map(|config| self.evaluator_of(config, processor)).transpose()
    }

    /// The evaluator of other words of depth.
    ///
    /// # Errors
    /// [`DepthError`] names the violated inequality.
    pub fn evaluator_of(
        &self,
        config: DepthConfig,
        processor: Processor,
    ) -> Result<Depth, DepthError> {
        let depth = Depth::new(config, &self.vertex, processor)?;
        let at = self.conservative().map(|config| config.depth);
        let nearest = at == Some(ConservativeDepth::Nearest);
        Ok(if nearest { depth.at_nearest_corner() } else { depth })
    }

    /// Whether a triangle draws nothing, because it has no area, or by `[cull]`. Spec clauses `T-3`, `CR-4`,
    /// `FP-10` and `FP-11`.
    pub fn culls(&self, triangle: &Triangle) -> bool {
        let drawn = self.conservative().map(|config| config.degenerate) == Some(Degenerate::Draw);
        triangle.area2() == 0 && !drawn
            || self.cull.is_some_and(|cull| cull.culls(triangle, self.vertex.sub_pixel))
    }

    /// The edge words of a plain engine: edge functions over a box and one sample a pixel, and with
    /// depth a plane whose integer part is stored. `None` for any other profile.
    pub fn plain_edges(&self) -> Option<EdgeWordConfig> {
        let edge = self.form.edge().filter(|_| self.form.visits_the_box())?;
        let stored = self.depth.is_some_and(|depth| depth.format.is_some());
        let other = stored || self.multisample.is_some() || self.traversal.is_some();
        (!other).then_some(*edge)
    }

    /// The edge width that holds every edge value of the vertex field and the window, rounded up to
    /// whole tiles where tiles are tested by their corners; `None` for a machine without edge words,
    /// or where vertex field or sample are malformed.
    pub fn exact_edge_width(&self) -> Option<u32> {
        self.form.exact_edge_width(&self.state())
    }

    /// Whether coverage is exact by construction: words that hold every value, or none at all.
    pub fn covers_exactly(&self) -> bool {
        self.form.covers_exactly(&self.state())
    }

    /// The same profile with another machine, by its name: the same fill rule, and words of the
    /// same width where the machine has such words. `None` for an unknown name, and for conservative coverage on a
    /// machine without edge words.
    ///
    /// Where there is nothing to go by, the machine's `adopt` chooses: edge words are as wide as exact
    /// coverage asks, a walk has one guard bit, the integer bits of the vertex field and as many bits as an
    /// edge word in all, an approximate walk the vertex field's integer bits as fraction, a barycentric
    /// coordinate one bit more than depth has below its guard, a tile 16 pixels on a side or as many as a
    /// smaller window has, and W as many bits as fit, at most 16.
    pub fn with_machine(&self, name: &str) -> Option<Self> {
        let mut profile = self.clone();
        if name != self.form.name() {
            let kind = triangle_machines().find(|kind| kind.name == name)?;
            profile.form = (kind.adopt)(&self.form, &self.state())?;
            // A machine without edge words would cover samples instead of squares.
            let squares = [&profile, self].map(|profile| profile.conservative().is_some());
            (squares[0] == squares[1]).then_some(())?;
        }
        if !profile.form.visits_the_box() {
            profile.traversal = None;
        }
        Some(profile)
    }
}
