//! The rasterizers that an API allows.

use super::api::Api;
use super::error::EnvelopeError;
use super::rule::Rule;
use super::snap::Snap;
use super::{Shape, raster};
use std::fmt;

/// The most sub-pixel bits: with 16 integer bits, a vertex field has 32.
const MOST_BITS: u32 = 16;
/// The most sub-pixel bits that are tried where the text has no limit, unless more are asked for.
const USUAL_BITS: u32 = 12;

/// What decides where vertices lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// Sub-pixel bits.
    pub bits: u32,
    /// How a coordinate is rounded to them.
    pub snap: Snap,
}

impl Way {
    /// A triangle on the grid. Coordinates that no grid has, which `shapes` refuses, are at the origin.
    pub(super) fn place(self, shape: &Shape) -> raster::Placed {
        shape.map(|vertex| vertex.map(|value| self.snap.apply(value, self.bits).unwrap_or(0)))
    }
}

/// A rasterizer: where vertices lie, and who has the samples on edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rasterizer {
    /// Where vertices lie.
    pub way: Way,
    /// Who has the samples on edges.
    pub rule: Rule,
}

impl fmt::Display for Rasterizer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { way: Way { bits, snap }, rule } = self;
        write!(f, "{bits} bits, {snap}, {rule}")
    }
}

/// The ways that an API allows, and its rule if it has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Family {
    /// The API.
    pub api: Api,
    /// The ways: by bits, then by snap. At most 130.
    pub ways: Vec<Way>,
}

impl Family {
    /// All that the text allows, up to 12 sub-pixel bits where it has no limit; or only these bits, and only the
    /// snaps of these names.
    ///
    /// # Errors
    /// [`EnvelopeError`] for bits or snaps that the API does not allow.
    pub fn new(
        api: Api,
        bits: Option<(u32, u32)>,
        snaps: &[String],
    ) -> Result<Self, EnvelopeError> {
        let (least, limit) = api.bits();
        let most = limit.unwrap_or(MOST_BITS);
        let (low, high) = bits.unwrap_or((least, most.min(USUAL_BITS)));
        if low > high {
            return Err(EnvelopeError::Reversed { low, high });
        }
        if low < least || high > most {
            let (api, fixed) = (api.name(), limit.is_some());
            return Err(EnvelopeError::Bits { low, high, api, least, most, fixed });
        }
        let allowed = api.snaps();
        let find = |name: &String| {
            allowed.iter().copied().find(|snap| snap.to_string() == *name).ok_or_else(|| {
                let names: Vec<String> = allowed.iter().map(Snap::to_string).collect();
                let (name, allowed) = (name.clone(), names.join(", "));
                EnvelopeError::Snap { name, api: api.name(), allowed }
            })
        };
        let chosen: Vec<Snap> = snaps.iter().map(find).collect::<Result<_, _>>()?;
        let snaps = if chosen.is_empty() { allowed.clone() } else { chosen };
        let ways = (low..=high).flat_map(|bits| snaps.iter().map(move |&snap| Way { bits, snap }));
        Ok(Self { api, ways: ways.collect() })
    }

    /// Rules that stand for all that the API allows, where samples lie on these edges.
    pub(super) fn rules(&self, edges: impl IntoIterator<Item = [i128; 2]>) -> Vec<Rule> {
        self.api.rule().map_or_else(|| Rule::enough(edges), |rule| vec![rule])
    }

    /// The largest distance in pixels that a way moves a vertex.
    pub fn snap_error(&self) -> f64 {
        let error = |way: &Way| way.snap.error() / f64::from(1u32 << way.bits);
        // Both axes at once.
        self.ways.iter().map(error).fold(0.0, f64::max) * std::f64::consts::SQRT_2
    }
}
