//! What a scene requires of a profile: ranges, bits and evaluators, each with its evidence, from one
//! pass over the scene on the profile's grid. Spec clause `M-8`.

mod channel;
mod depth;
mod edge;

pub use channel::{ChannelNeed, Interpolation};

use crate::bits::Rounding;
use crate::measure::accuracy::{Face, Reference, Stage, Truth};
use crate::measure::error::exact_rule;
use crate::profile::{InvalidProfile, Profile};
use serde::Serialize;

/// What a scene requires.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Requirements {
    /// The scene.
    pub scene: String,
    /// Triangles of it that have an area on the grid.
    pub triangles: usize,
    /// Samples that they cover, hits counted one by one.
    pub samples: u64,
    /// How far quantities reach.
    pub ranges: Vec<Range>,
    /// How many bits that takes.
    pub bits: Vec<Bits>,
    /// What has to be built.
    pub evaluators: Vec<Evaluator>,
    /// How channels change, where the scene has values for them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<ChannelNeed>,
}

/// How far a quantity reaches.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Range {
    /// Which.
    pub name: &'static str,
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// Unit.
    pub unit: &'static str,
    /// Where the extremes are met.
    pub evidence: String,
}

/// Bits that a scene takes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Bits {
    /// The field, as searches name it.
    pub field: &'static str,
    /// The fewest that do.
    pub needs: u32,
    /// What the profile has.
    pub has: u32,
    /// What takes them.
    pub evidence: String,
}

/// A part of a rasterizer that a scene needs or not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Evaluator {
    /// Which.
    pub name: &'static str,
    /// Whether the scene needs it.
    pub needed: bool,
    /// Why, or why not.
    pub evidence: String,
}

/// What a scene requires of a profile.
///
/// # Errors
/// [`InvalidProfile`] names the violated inequality.
pub fn require(reference: &Reference, profile: &Profile) -> Result<Requirements, InvalidProfile> {
    let (grid, clip) = (profile.whole_grid()?, profile.window()?);
    let truth = Truth::new(reference, &grid, clip, exact_rule(&profile.form));
    let stage = Stage::new(reference, &truth, profile)?;
    let mut found = Requirements {
        scene: reference.name.clone(),
        triangles: stage.faces.len(),
        samples: stage.samples,
        ..Requirements::default()
    };
    edge::require(&stage, profile, &mut found);
    depth::require(&stage, profile, &mut found);
    found.evaluators.push(perspective(&stage, reference));
    channel::require(&stage, profile, &mut found)?;
    Ok(found)
}

/// The smallest and the largest of a quantity, each with what has it. The first one counts.
struct Extremes<T, V> {
    low: Option<(V, T)>,
    high: Option<(V, T)>,
}

impl<T: Copy, V: PartialOrd + Copy> Extremes<T, V> {
    fn of(values: impl Iterator<Item = (V, T)>) -> Self {
        let mut found = Self { low: None, high: None };
        for (value, place) in values {
            if found.low.is_none_or(|(least, _)| value < least) {
                found.low = Some((value, place));
            }
            if found.high.is_none_or(|(most, _)| value > most) {
                found.high = Some((value, place));
            }
        }
        found
    }

    /// A range with both places in words.
    fn range(
        &self,
        name: &'static str,
        unit: &'static str,
        real: impl Fn(V) -> f64,
        place: impl Fn(T) -> String,
    ) -> Option<Range> {
        let ((low, at), (high, to)) = (self.low?, self.high?);
        let (at, to) = (place(at), place(to));
        let evidence = if at == to { at } else { format!("{at}; {to}") };
        Some(Range { name, low: real(low), high: real(high), unit, evidence })
    }
}

fn triangle(face: &Face) -> String {
    format!("triangle {}", face.source)
}

/// Whether attributes need a division: only where w changes over a triangle. Depth never does: Z/w
/// is linear in the window.
///
/// w is that of the lens at the depth as it is on the grid, or else that of the scene.
fn perspective(stage: &Stage, reference: &Reference) -> Evaluator {
    let name = "perspective";
    let w = |triangle| reference.attributes.w(triangle);
    if reference.lens.is_none() && (0..reference.triangles.len()).all(|n| w(n).is_none()) {
        let evidence = "the scene has no w, so w is constant".to_owned();
        return Evaluator { name, needed: false, evidence };
    }
    let ratio = |face: &Face| {
        let w = if let Some(lens) = reference.lens {
            let parts = face.triangle.z?.map(|code| real(code) / stage.world.top);
            parts.map(|part| lens.distance(part))
        } else {
            w(face.source)?
        };
        let (low, high) = (w[0].min(w[1]).min(w[2]), w[0].max(w[1]).max(w[2]));
        Some(high / low)
    };
    let ratios = stage.faces.iter().filter_map(|face| Some((ratio(face)?, face)));
    let Some((most, face)) = Extremes::of(ratios).high.filter(|(most, _)| *most > 1.0) else {
        let evidence = "w is the same at all vertices of each triangle".to_owned();
        return Evaluator { name, needed: false, evidence };
    };
    // Along an edge with w from 1 to r the affine value is furthest off where the two weights
    // balance: by (sqrt r - 1) / (sqrt r + 1) of the change.
    let root = most.sqrt();
    let off = (root - 1.0) / (root + 1.0);
    let evidence = format!(
        "w changes by a factor of {most:.4} over {}: an attribute interpolated without w has an error \
         of up to {:.3} % of its change there; depth has no such error, because it is Z/w",
        triangle(face),
        100.0 * off
    );
    Evaluator { name, needed: true, evidence }
}

/// The fewest interpolation bits whose bound keeps a walk below half an ULP. Spec clause `B-5`.
fn fraction_bits(steps: u64, rounding: Rounding) -> u32 {
    // One rounding of the start and one for each step, each of half a unit at most or below one.
    let roundings = u128::from(steps) + 1;
    let nearest = rounding.is_nearest();
    (0..64)
        .find(|fraction| {
            let half = 1u128 << fraction;
            if nearest { roundings < half } else { 2 * roundings <= half }
        })
        .unwrap_or(64)
}

#[allow(clippy::cast_precision_loss, reason = "ranges are reported as real numbers")]
fn real(value: i128) -> f64 {
    value as f64
}
