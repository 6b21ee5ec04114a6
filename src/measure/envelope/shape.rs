//! The triangles of a scene as reals that every way can snap.

use super::{EnvelopeError, Shape};
use crate::scene::{Scene, Triangle};

/// Bits below the pixel of a scene's integer coordinates, as of the profiles for these APIs.
pub const LATTICE_BITS: u32 = 8;
/// The largest coordinate in pixels: a field of 16 integer bits holds it however it is snapped.
pub const REACH: i32 = 32767;

/// The triangles of a scene, each coordinate rounded to binary32 as on its way through an API.
///
/// # Errors
/// [`EnvelopeError`] names the first triangle with a coordinate outside every field.
pub fn shapes(scene: &Scene) -> Result<Vec<Shape>, EnvelopeError> {
    if scene.triangles.is_empty() {
        return Err(EnvelopeError::Empty { name: scene.name.clone() });
    }
    let shape = |(n, triangle): (usize, &Triangle)| {
        let xy = pixels(triangle);
        for (vertex, xy) in xy.iter().enumerate() {
            for (axis, value) in ['x', 'y'].into_iter().zip(*xy) {
                let place = || format!("{}: {}", scene.name, scene.place(n));
                if !value.is_finite() {
                    return Err(EnvelopeError::NotFinite { place: place(), vertex, axis, value });
                }
                if value.abs() > f64::from(REACH) {
                    return Err(EnvelopeError::Outside { place: place(), vertex, axis, value });
                }
            }
        }
        Ok(xy)
    };
    scene.triangles.iter().enumerate().map(shape).collect()
}

/// Coordinates in pixels.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "the rounding to binary32 is the point; an integer that a double does not hold is far outside"
)]
fn pixels(triangle: &Triangle) -> Shape {
    match triangle {
        Triangle::Real { xy, .. } => xy.map(|vertex| vertex.map(|value| f64::from(value as f32))),
        Triangle::Lattice { xy, .. } => {
            xy.map(|vertex| vertex.map(|value| value as f64 / f64::from(1u32 << LATTICE_BITS)))
        }
    }
}
