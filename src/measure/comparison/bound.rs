//! Whether what a machine draws stays within the bounds that its clauses state: `A-3`, `A-5`, `A-6`, and
//! for a plane the rounding of its start and of each step.

use crate::exact::PlaneNumerator;
use crate::machine::Face;
use crate::measure::accuracy::{self, Inspected, Inspector, Stage, bounding_box};
use crate::measure::error::SampleError;
use crate::profile::{InvalidProfile, Profile};
use num_traits::ToPrimitive;

/// How much of its bounds a machine used on a scene; `None` where it states no bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Used {
    /// Largest depth error over its bound; 0 without depth.
    pub(super) depth: Option<f64>,
    /// Samples misplaced beyond what a walk can be off.
    pub(super) beyond: Option<u64>,
}

/// The stated bound of a face's depth error in ULP, over all samples of its bounding box.
fn depth_bound(profile: &Profile, face: &Face<'_>, exact: &PlaneNumerator) -> Option<f64> {
    let bound = profile.form.depth_bound(&profile.state(), face, exact)?;
    Some(bound.numer().to_f64()? / bound.denom().to_f64()?)
}

/// A face as machines see it for their bounds.
fn bounded<'a>(stage: &'a Stage, face: &'a accuracy::Face) -> Face<'a> {
    Face { triangle: &face.triangle, grid: &stage.grid, bounds: bounding_box(stage, face) }
}

/// Looks at every sample of a stage through a profile.
pub(super) fn used(stage: &Stage, profile: &Profile) -> Result<Used, InvalidProfile> {
    // No bound is stated for a division by reciprocals and a clamp other than the guard's, which have errors of their
    // own; what a depth bias moves beyond the range is clamped.
    let holds = profile.depth.is_none_or(|depth| {
        depth.division == crate::setup::Division::Quotient
            && depth.clamp == crate::format::Clamp::Guard
            && depth.bias.is_none()
    });
    let inspector = Inspector::new(stage, profile)?;
    let mut used = Used { depth: holds.then_some(0.0), beyond: Some(0) };
    for face in &stage.faces {
        let seen = bounded(stage, face);
        let surface = face.depth.as_ref().filter(|_| holds);
        let bound = surface.map(|surface| depth_bound(profile, &seen, &surface.exact));
        if let (Some(None), true) = (bound, profile.depth.is_some()) {
            used.depth = None;
        }
        let bound = bound.flatten().filter(|bound| *bound > 0.0);
        inspector.face(face, Inspected::Depth, |x, y, error| match error {
            SampleError::Depth(ulp) => {
                if let (Some(depth), Some(bound)) = (&mut used.depth, bound) {
                    *depth = depth.max(ulp.abs() / bound);
                }
            }
            SampleError::Missing | SampleError::Extra => {
                let at = stage.grid.position(x.into(), y.into());
                let beyond = profile.form.may_misplace(&seen, at).map(|may| u64::from(!may));
                used.beyond = used.beyond.zip(beyond).map(|(sum, one)| sum + one);
            }
        });
    }
    Ok(used)
}
