//! What errors add up to, while they are counted and as they are reported. Spec clause `M-2`.

use super::channel_tally::ChannelError;
use super::moment::{Moments, Spread};
use super::world::World;
use serde::{Deserialize, Serialize};

/// Errors of one interpolated value, in two units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ValueTally {
    /// In units of the value's last place.
    pub ulp: Moments,
    /// In the units of the world: distances for depth, parts of the range for an attribute.
    pub world: Moments,
}

/// What one cause of error, snapping or arithmetic, did to a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Samples that should have been covered and were not, triangle by triangle.
    pub missing: u64,
    /// Samples covered that should not have been.
    pub extra: u64,
    /// Samples of the whole scene hit less often than they should be.
    pub holes: u64,
    /// Samples hit more often.
    pub double_hits: u64,
    /// Depth at the samples that both cover.
    pub depth: ValueTally,
    /// An attribute that runs over its whole range along one side of each triangle.
    pub attribute: ValueTally,
    /// Neighbours in depth at a sample that change places.
    pub inversions: u64,
    /// Neighbours in depth at a sample that become equal.
    pub ties: u64,
    /// Samples whose depth left the range that guard bits tell apart.
    pub wraps: u64,
    /// Samples whose depth read as an end of its range because it lay beyond it.
    pub clamps: u64,
    /// Triangles that could not be drawn at all: a vertex outside its field.
    pub refused: u64,
    /// Triangles that lost their area.
    pub vanished: u64,
}

/// Errors of one interpolated value, as reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueError {
    /// In units of the value's last place.
    pub ulp: Spread,
    /// In the units of the world: see [`Accuracy::world`].
    pub world: Spread,
}

/// What one cause of error did, as reported. See [`Tally`] for the counts.
#[allow(missing_docs, reason = "the fields of `Tally`, under their names")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deviation {
    pub misclassified: u64,
    pub missing: u64,
    pub extra: u64,
    pub holes: u64,
    pub double_hits: u64,
    /// Absent when nothing has depth.
    pub depth: Option<ValueError>,
    /// Absent without a value plane.
    pub attribute: Option<ValueError>,
    pub inversions: u64,
    pub ties: u64,
    pub wraps: u64,
    pub clamps: u64,
    pub refused: u64,
    pub vanished: u64,
}

/// The accuracy of a profile on scenes, both causes apart.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Samples that the snapped scenes cover, hits counted one by one.
    pub samples: u64,
    /// What a distance of 1 is: `mesh unit`, or `depth range` for scenes without a camera.
    pub world: String,
    /// From the scene as given to the scene on the profile's grid.
    pub snap: Deviation,
    /// From the exact picture of the scene on the grid to what is drawn.
    pub arithmetic: Deviation,
    /// The codes of channels, where the scene has values for them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<ChannelError>,
}

impl ValueTally {
    /// Adds a run of errors in ULP and parts of the range, both in equal steps between their ends.
    /// In a flat world [`ValueTally::settle`] has to follow.
    #[inline]
    pub fn run(&mut self, world: &World, ulp: [f64; 2], part: [f64; 2], count: u32) {
        self.ulp.run(ulp[0], ulp[1], count);
        if !world.is_flat() {
            world.depth_run(ulp, part, count, &mut self.world);
        }
    }

    /// Adds one error in ULP at a part of the range. In a flat world [`ValueTally::settle`] has to
    /// follow.
    #[inline]
    pub fn note(&mut self, world: &World, ulp: f64, part: f64) {
        self.ulp.note(ulp);
        if !world.is_flat() {
            self.world.note(world.depth(ulp, part));
        }
    }

    /// Makes the distances of a flat world: there they are the errors in another unit.
    #[inline]
    pub fn settle(&mut self, world: &World) {
        if world.is_flat() {
            self.world = self.ulp.scaled(world.depth(1.0, 0.0));
        }
    }

    /// Adds what another tally has.
    pub fn merge(&mut self, other: &Self) {
        self.ulp.merge(&other.ulp);
        self.world.merge(&other.world);
    }

    fn report(&self) -> Option<ValueError> {
        let seen = self.ulp.count > 0;
        seen.then(|| ValueError { ulp: self.ulp.spread(), world: self.world.spread() })
    }
}

impl Tally {
    /// Adds what another tally has.
    pub fn merge(&mut self, other: &Self) {
        self.depth.merge(&other.depth);
        self.attribute.merge(&other.attribute);
        let counts = [
            (&mut self.missing, other.missing),
            (&mut self.extra, other.extra),
            (&mut self.holes, other.holes),
            (&mut self.double_hits, other.double_hits),
            (&mut self.inversions, other.inversions),
            (&mut self.ties, other.ties),
            (&mut self.wraps, other.wraps),
            (&mut self.clamps, other.clamps),
            (&mut self.refused, other.refused),
            (&mut self.vanished, other.vanished),
        ];
        for (to, from) in counts {
            *to += from;
        }
    }

    /// The report of these sums.
    pub fn report(&self) -> Deviation {
        let Self { missing, extra, holes, double_hits, inversions, ties, wraps, .. } = *self;
        let Self { clamps, refused, vanished, .. } = *self;
        Deviation {
            misclassified: missing + extra,
            missing,
            extra,
            holes,
            double_hits,
            depth: self.depth.report(),
            attribute: self.attribute.report(),
            inversions,
            ties,
            wraps,
            clamps,
            refused,
            vanished,
        }
    }
}
