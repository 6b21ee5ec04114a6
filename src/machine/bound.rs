//! Bounds of the depth error, stated exactly. Spec clauses `A-3`, `A-6` and `B-5`.

use super::{Face, RasterState};
use crate::bits::Rounding;
use crate::exact::{Rational, dyadic, integer};
use crate::value::DepthConfig;

/// The largest error of one rounding to so many fraction bits.
pub fn rounding_error(rounding: Rounding, fraction: u32) -> Rational {
    dyadic(1, fraction + u32::from(rounding.is_nearest()))
}

/// The bound of a plane that is rounded at its start and at each slope, and walked on the sample grid from
/// pixel (0, 0); `None` without depth.
pub fn plane_bound(state: &RasterState, face: &Face<'_>) -> Option<Rational> {
    let DepthConfig { rounding, interpolation, .. } = state.depth?;
    let [_, _, x1, y1] = face.bounds.map(i128::from);
    Some(integer(1 + x1 + y1) * rounding_error(rounding, interpolation))
}
