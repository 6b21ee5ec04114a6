//! One profile seen through each machine.

use super::Profile;
use crate::cover::EdgeWordConfig;
use crate::machine::{RasterState, triangle_machines};

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
    /// same width where the machine has such words. `None` for an unknown name.
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
        }
        if !profile.form.visits_the_box() {
            profile.traversal = None;
        }
        Some(profile)
    }
}
