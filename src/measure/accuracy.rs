//! How accurate a profile is on a scene: snap error and arithmetic error apart, coverage, depth,
//! an attribute, and the order of surfaces. Spec clauses `M-1` to `M-7`.
//!
//! The work is shared out by what it depends on. A [`Reference`] is the scene as given, a [`Truth`]
//! its exact picture, a [`Stage`] the scene on one grid with its exact picture and all snap errors,
//! a [`Drawn`] one coverage form on a stage, and [`measure`] adds one depth budget to that. A sweep
//! makes each of them once for all budgets that share it.

mod affine;
mod channel_tally;
mod drawn;
mod find;
mod inspect;
mod moment;
mod order;
mod own;
mod reference;
mod run;
mod shade;
mod stage;
mod tally;
mod value;
mod world;

pub use affine::Affine;
pub use channel_tally::{ChannelError, ChannelTally, WorstCode};
pub use drawn::{Drawn, bounding_box, needed_width};
pub use find::{Place, What};
pub use inspect::{Inspector, Value as Inspected};
pub use moment::{Moments, Spread};
pub use order::Pair;
pub(super) use reference::reference_grid;
pub use reference::{REFERENCE_BITS, RealFace, Reference, Truth};
pub use shade::{Change, Shades, measure_channels};
pub use stage::{Face, Stage, Surface};
pub use tally::{Accuracy, Deviation, Tally, ValueError, ValueTally};
pub use value::{Reach, Values, face_values};
pub use world::World;

use crate::dda::Processor;
use crate::format::{Clamp, ReadOut};
use crate::profile::Profile;
use crate::value::Depth;

/// The depth evaluator of a validated profile.
pub fn depth_of(profile: &Profile) -> Option<Depth> {
    profile.evaluator(Processor::default()).ok()?
}

/// The arithmetic error of one profile on a stage.
#[derive(Clone, Copy, Debug)]
pub struct Measured {
    /// The errors.
    pub tally: Tally,
    /// How far the depth accumulators reached, unwrapped.
    pub depth: Reach,
    /// The same of the attribute.
    pub attribute: Reach,
    /// The same of the depth accumulators that decided an order, drawn or not.
    pub order: Reach,
}

impl Measured {
    /// Whether a read-out told all accumulators apart: the errors are then those of every number
    /// of guard bits that does so, unless the clamp is sticky. Spec clause `Q-8`.
    pub fn held_by(&self, read: ReadOut) -> bool {
        let holds = |reach: &Reach| reach.within(read.range());
        read.clamp() != Clamp::Saturate
            && [&self.depth, &self.attribute, &self.order].into_iter().all(holds)
    }
}

/// The arithmetic error of one profile, on a stage and a coverage that were made for it.
pub fn measure(stage: &Stage, drawn: &Drawn, profile: &Profile) -> Measured {
    let none = Reach::default();
    let mut measured = Measured { tally: drawn.tally, depth: none, attribute: none, order: none };
    let Some(depth) = depth_of(profile) else { return measured };
    if !profile.form.walks_a_plane() {
        return own::measure(stage, drawn, profile, &depth);
    }
    let mut values = Values::default();
    for (n, face) in stage.faces.iter().enumerate() {
        face_values(stage, &depth, face, drawn.runs(stage, n), &mut values);
    }
    let order = finish(stage, &depth, &values, &mut measured.tally);
    let (depth, attribute) = (values.depth_extent, values.attribute_extent);
    Measured { depth, attribute, order, ..measured }
}

/// Puts values and the order of surfaces into a tally; the depth accumulators that decided the
/// order.
pub fn finish(stage: &Stage, depth: &Depth, values: &Values, tally: &mut Tally) -> Reach {
    // A sample that is not drawn still has its place in the order, and a wrap knows no bound.
    let bounded = !values.wrapped() && values.depth.ulp.count == stage.depth_samples;
    let worst = if bounded { values.depth.ulp.worst } else { f64::INFINITY };
    let order;
    (tally.inversions, tally.ties, order) = order::broken(stage, depth, worst);
    tally.depth = values.depth;
    tally.attribute = values.attribute;
    tally.wraps = values.wraps;
    tally.clamps = values.clamps;
    order
}
