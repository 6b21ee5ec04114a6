//! Whether what a machine draws stays within the bounds that its clauses state: `A-3`, `A-5`, `A-6`, and
//! for a plane the rounding of its start and of each step.

use crate::bits::Rounding;
use crate::exact::PlaneNumerator;
use crate::measure::accuracy::{Face, Inspected, Inspector, Stage, bounding_box};
use crate::measure::error::SampleError;
use crate::profile::{Form, InvalidProfile, Profile};

/// How much of its bounds a machine used on a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Used {
    /// Largest depth error over its bound; 0 without depth.
    pub(super) depth: f64,
    /// Samples misplaced beyond what a walk can be off.
    pub(super) beyond: u64,
}

/// The largest error of one rounding, in units of the last place.
fn unit(rounding: Rounding) -> f64 {
    if rounding.is_nearest() { 0.5 } else { 1.0 }
}

/// The bound of a face's depth error in ULP, over all samples of its bounding box.
fn depth_bound(stage: &Stage, profile: &Profile, face: &Face, exact: &PlaneNumerator) -> f64 {
    let Some(depth) = profile.depth else { return 0.0 };
    let [x0, y0, x1, y1] = bounding_box(stage, face).map(f64::from);
    let ulp = unit(depth.rounding) * (-f64::from(depth.interpolation)).exp2();
    match profile.form {
        Form::Gouraud(walk) => {
            let (rows, columns) = (y1 - y0 + 2.0, x1 - x0 + 2.0);
            let pixel = f64::from(1u32 << stage.grid.sub_pixel);
            let slope = (real(exact.slope[0]) * pixel / real(exact.whole)).abs();
            let x_off = unit(walk.rounding) * (-f64::from(walk.fraction)).exp2();
            rows * (ulp + slope * x_off) + columns * ulp
        }
        Form::Barycentric(machine) => {
            let share = unit(machine.rounding) * (-f64::from(machine.coordinate)).exp2();
            let z = face.triangle.z.unwrap_or_default();
            let rise = real((z[1] - z[0]).abs() + (z[2] - z[0]).abs());
            rise * (1.0 + x1 + y1) * share + (-f64::from(depth.interpolation)).exp2()
        }
        _ => (1.0 + x1 + y1) * ulp,
    }
}

/// Whether a sample lies nearer to a walked edge, along its row, than its x can be off.
fn near_an_edge(stage: &Stage, profile: &Profile, face: &Face, x: u32, y: u32) -> bool {
    let Some(walk) = profile.form.walk() else { return false };
    let at = stage.grid.position(x.into(), y.into());
    let (v, s) = (face.triangle.xy, stage.grid.sub_pixel);
    (0..3).any(|k| {
        let (a, b) = (v[k], v[(k + 1) % 3]);
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let off = ((at[0] - a[0]) * dy - (at[1] - a[1]) * dx).abs();
        let rows = (dy.abs() >> s) + 2;
        off << walk.fraction <= (rows * dy.abs()) << s
    })
}

/// Looks at every sample of a stage through a profile.
pub(super) fn used(stage: &Stage, profile: &Profile) -> Result<Used, InvalidProfile> {
    // A division by reciprocals and a clamp other than the guard's have errors of their own.
    let bounded = profile.depth.is_none_or(|depth| {
        depth.division == crate::setup::Division::Quotient
            && depth.clamp == crate::format::Clamp::Guard
    });
    let inspector = Inspector::new(stage, profile)?;
    let mut used = Used::default();
    for face in &stage.faces {
        let bound = face
            .depth
            .as_ref()
            .map_or(0.0, |surface| depth_bound(stage, profile, face, &surface.exact));
        inspector.face(face, Inspected::Depth, |x, y, error| match error {
            SampleError::Depth(ulp) if bounded && bound > 0.0 => {
                used.depth = used.depth.max(ulp.abs() / bound);
            }
            SampleError::Depth(_) => {}
            SampleError::Missing | SampleError::Extra => {
                used.beyond += u64::from(!near_an_edge(stage, profile, face, x, y));
            }
        });
    }
    Ok(used)
}

#[allow(clippy::cast_precision_loss, reason = "bounds are reported as real numbers")]
fn real(value: i128) -> f64 {
    value as f64
}
