//! Triangles back into lines.

use super::Triangle;

/// The line that [`super::parse_line`] reads back to the same triangle, without a line end.
///
/// Reals are written as the shortest decimal that gives the same double, NaN and infinities as
/// their 16-digit pattern.
pub fn to_line(id: u64, triangle: &Triangle) -> String {
    let (key, vertices) = match triangle {
        Triangle::Lattice { xy, z } => ("v", join(xy, z.as_ref(), i128::to_string)),
        Triangle::Real { xy, z } => ("f", join(xy, z.as_ref(), real)),
    };
    format!(r#"{{"id":{id},"{key}":[{vertices}]}}"#)
}

fn join<T>(xy: &[[T; 2]; 3], z: Option<&[T; 3]>, number: impl Fn(&T) -> String) -> String {
    let vertex = |(index, [x, y]): (usize, &[T; 2])| {
        let mut text = format!("[{},{}", number(x), number(y));
        if let Some(z) = z.and_then(|z| z.get(index)) {
            text.push(',');
            text.push_str(&number(z));
        }
        text.push(']');
        text
    };
    xy.iter().enumerate().map(vertex).collect::<Vec<_>>().join(",")
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the shape `join` calls, as `i128::to_string`"
)]
fn real(value: &f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        format!(r#"{{"bits":"{:016x}"}}"#, value.to_bits())
    }
}
